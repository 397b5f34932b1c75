# script-version: 2.0
"""Writes, at each execution, which contact points carry a force in which element; each rank for itself."""
import breccia_insitu
from paraview import catalyst
from paraview.simple import TrivialProducer, UpdatePipeline
from paraview.vtk.vtkParallelCore import vtkMultiProcessController

contacts = TrivialProducer(registrationName="contacts")
options = catalyst.Options()


def catalyst_execute(info):
    UpdatePipeline(info.time, contacts)
    rank = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
    cells = contacts.GetClientSideObject().GetOutputDataObject(0).GetCellData()
    with open(f"{breccia_insitu.folder()}/rank_{rank}.txt", "a", encoding="utf-8") as file:
        for contact in range(cells.GetNumberOfTuples()):
            print(info.timestep, *(cells.GetArray(name).GetValue(contact) for name in ("id", "point", "other_element")), file=file)
