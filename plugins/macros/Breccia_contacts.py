"""Macro of ParaView's: the picture 'contacts' of the run that is open, by the plugin Breccia, which must be loaded."""
import os
import sys

from paraview import servermanager

plugins = servermanager.vtkSMProxyManager.GetProxyManager().GetPluginManager().GetLocalInformation()
for i in range(plugins.GetNumberOfPlugins()):
    if plugins.GetPluginName(i) == "Breccia" and plugins.GetPluginFileName(i):
        sys.path.insert(0, os.path.dirname(plugins.GetPluginFileName(i)))
import breccia_pictures  # noqa: E402: beside the plugin

breccia_pictures.contacts()
