# script-version: 2.0
"""The plugin in a run: fragments while it goes on; a line for each trigger goes into BRECCIA_TEST_OUTPUT: time, fragments, mass."""
import os

from paraview import print_info
from paraview.simple import *  # noqa: F403: ParaView's way

LoadPlugin(os.environ["BRECCIA_PARAVIEW_PLUGIN"], remote=False, ns=globals())
elements = TrivialProducer(registrationName="elements")
joints = TrivialProducer(registrationName="joints")
fragments = Fragments(Input=elements, Joints=joints)


def catalyst_execute(info):
    from vtkmodules.vtkParallelCore import vtkMultiProcessController
    fragments.UpdatePipeline(info.time)
    table = fragments.GetClientSideObject().GetOutputDataObject(1)
    if vtkMultiProcessController.GetGlobalController().GetLocalProcessId() != 0:
        return
    mass = sum(table.GetColumnByName("mass").GetValue(i) for i in range(table.GetNumberOfRows()))
    with open(os.environ["BRECCIA_TEST_OUTPUT"], "a" if info.timestep else "w") as out:
        out.write(f"{info.time!r} {table.GetNumberOfRows()} {mass!r}\n")
    print_info("%d fragments", table.GetNumberOfRows())
