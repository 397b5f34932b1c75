# script-version: 2.0
"""What it writes and warns of is no failure."""
import logging
import sys
import warnings

from paraview import catalyst, print_warning
from paraview.simple import TrivialProducer
from paraview.vtk.vtkCommonCore import vtkOutputWindow
from paraview.vtk.vtkParallelCore import vtkMultiProcessController

surface = TrivialProducer(registrationName="surface")
options = catalyst.Options()
print("read")


def catalyst_initialize():
    print("begun")


def catalyst_execute(info):
    print("cells of", info.timestep, end=": ")
    print("some")
    print("on stderr", file=sys.stderr)
    warnings.warn("by Python")
    logging.warning("by logging")
    print_warning("by ParaView")
    vtkOutputWindow.GetInstance().DisplayWarningText("by VTK")
    if vtkMultiProcessController.GetGlobalController().GetLocalProcessId() == 1:
        print("by the second rank")
    for number in range(12):
        print("line", number)


def catalyst_finalize():
    print("ended", end="")
