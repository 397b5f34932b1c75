# script-version: 2.0
from paraview import catalyst
from paraview.simple import TrivialProducer
from paraview.vtk.vtkParallelCore import vtkMultiProcessController

surface = TrivialProducer(registrationName="surface")
options = catalyst.Options()
controller = vtkMultiProcessController.GetGlobalController()
if controller.GetLocalProcessId() == controller.GetNumberOfProcesses() - 1:
    raise ValueError("cannot be read here")
