# script-version: 2.0
"""The last rank raises; the others would enter a collective operation."""
from paraview import catalyst
from paraview.simple import CreateExtractor, TrivialProducer
from paraview.vtk.vtkParallelCore import vtkMultiProcessController

surface = TrivialProducer(registrationName="surface")
extract = CreateExtractor("VTP", surface, registrationName="extract")
options = catalyst.Options()


def catalyst_initialize():
    controller = vtkMultiProcessController.GetGlobalController()
    if controller.GetLocalProcessId() == controller.GetNumberOfProcesses() - 1:
        raise ValueError("cannot begin here")
