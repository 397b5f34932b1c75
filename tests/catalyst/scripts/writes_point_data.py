# script-version: 2.0
"""Writes, at each execution, what is at the corners of elements, gradients included, and the size of an isosurface; each rank for itself, numbers
as Python tells them apart."""
import breccia_insitu
from paraview import catalyst
from paraview.simple import Contour, Gradient, TrivialProducer, UpdatePipeline
from paraview.vtk.vtkParallelCore import vtkMultiProcessController

elements = TrivialProducer(registrationName="elements")
contour = Contour(registrationName="contour", Input=elements, ContourBy=["POINTS", "von_mises"], Isosurfaces=[2e4])
gradient = Gradient(registrationName="gradient", Input=elements, ScalarArray=["POINTS", "displacement"])
options = catalyst.Options()


def data_of(source):
    return source.GetClientSideObject().GetOutputDataObject(0)


def catalyst_execute(info):
    for source in (elements, contour, gradient):
        UpdatePipeline(info.time, source)
    rank = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
    grid, at_points = data_of(elements), data_of(elements).GetPointData()
    ids = grid.GetCellData().GetArray("id")
    gradients = data_of(gradient).GetPointData().GetArray("Gradient")
    with open(f"{breccia_insitu.folder()}/rank_{rank}.txt", "a", encoding="utf-8") as file:
        for point in range(grid.GetNumberOfPoints()):
            values = [at_points.GetArray(name).GetTuple(point) for name in ("von_mises", "stress", "displacement")]
            print(info.timestep, ids.GetValue(point // 4), point % 4, *values, gradients.GetTuple(point), file=file)
    with open(f"{breccia_insitu.folder()}/cells_{rank}.txt", "a", encoding="utf-8") as file:
        print(data_of(contour).GetNumberOfCells(), at_points.GetNumberOfArrays(), file=file)
