# script-version: 2.0
"""Writes, at each execution, step, time and the cells of a channel on this rank, and asks the solver for things."""
import breccia_insitu
from paraview import catalyst
from paraview.simple import TrivialProducer, UpdatePipeline
from paraview.vtk.vtkParallelCore import vtkMultiProcessController

elements = TrivialProducer(registrationName="elements")
options = catalyst.Options()


def catalyst_execute(info):
    UpdatePipeline(info.time, elements)
    data = elements.GetClientSideObject().GetOutputDataObject(0)
    rank = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
    with open(f"{breccia_insitu.folder()}/rank_{rank}.txt", "a", encoding="utf-8") as file:
        print(info.timestep, data.GetNumberOfCells(), breccia_insitu.parameter("factor", 1.0),
              *breccia_insitu.parameter("label", "").split(), file=file)
    if info.timestep == 2:
        breccia_insitu.request(info, stop=1, frame_interval=2.5e-6)
