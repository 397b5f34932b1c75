# script-version: 2.0
"""Von Mises stress on the bodies' surface and on the faces of cracks, which are edged dark.

Parameters besides those of every picture (breccia_pictures.py): lower, upper, ends of the colours, Pa; default: 0, and the largest 99 %
quantile so far.
"""

import numpy
from paraview.simple import Calculator, TrivialProducer
from vtkmodules.util.numpy_support import vtk_to_numpy

import breccia_insitu
import breccia_pictures as pictures

surface = TrivialProducer(registrationName="surface")
fractures = TrivialProducer(registrationName="fractures")
stress = Calculator(Input=surface, AttributeType="Cell Data", ResultArrayName="von Mises [MPa]", Function="von_mises*0.000001")

picture = pictures.Picture()
colours = picture.coloured(stress, "von Mises [MPa]", pictures.SEQUENTIAL, "von Mises [MPa]")
picture.lines(fractures)
lower, upper = breccia_insitu.parameter("lower", 0.0), breccia_insitu.parameter("upper", 0.0)
largest_so_far = 0.0


def upper_end():
    global largest_so_far
    values = pictures.data_of(surface).GetCellData().GetArray("von_mises")
    mine = 0.0
    if values is not None and values.GetNumberOfTuples() > 0:
        mine = float(numpy.quantile(vtk_to_numpy(values), 0.99))
    largest_so_far = max(largest_so_far, pictures.largest(mine))
    return upper or largest_so_far


def catalyst_execute(info):
    surface.UpdatePipeline()
    fractures.UpdatePipeline()
    pictures.table_range(colours, lower * 1e-6, upper_end() * 1e-6)
    picture.say(info, f"{pictures.cells_of(fractures):,} broken joints")
    picture.place_camera(surface)


def catalyst_finalize():
    picture.list_pictures()
