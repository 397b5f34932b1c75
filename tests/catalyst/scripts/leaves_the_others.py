# script-version: 2.0
"""The last rank raises while the others wait for it."""
from paraview.simple import TrivialProducer
from paraview.vtk.vtkParallelCore import vtkMultiProcessController

surface = TrivialProducer(registrationName="surface")


def catalyst_execute(info):
    controller = vtkMultiProcessController.GetGlobalController()
    if controller.GetLocalProcessId() == controller.GetNumberOfProcesses() - 1:
        raise RuntimeError("on my own")
    controller.Barrier()
