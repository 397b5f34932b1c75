# script-version: 2.0
"""The last rank raises; the others would enter a collective operation."""
from paraview import catalyst
from paraview.simple import CreateExtractor, TrivialProducer
from paraview.vtk.vtkParallelCore import vtkMultiProcessController

surface = TrivialProducer(registrationName="surface")
extract = CreateExtractor("VTP", surface, registrationName="extract")
extract.Writer.FileName = "surface_{timestep:06d}.pvtp"
options = catalyst.Options()


def catalyst_execute(info):
    controller = vtkMultiProcessController.GetGlobalController()
    if controller.GetLocalProcessId() == controller.GetNumberOfProcesses() - 1:
        raise RuntimeError("only here")
