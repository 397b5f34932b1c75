# script-version: 2.0
"""Forces where bodies and fragments touch: an arrow at every contact point, normal forces red, friction blue; bodies opened.

Parameters besides those of every picture (breccia_pictures.py): upper, the force of the longest arrow, N; default: the next of 1, 2, 5,
10, ... above the largest so far.
"""

from paraview.simple import CellCenters, Glyph, TrivialProducer
from vtkmodules.util.numpy_support import vtk_to_numpy

import breccia_insitu
import breccia_pictures as pictures

NORMAL, FRICTION = [0.78, 0.20, 0.22], [0.15, 0.35, 0.75]
LONGEST = 0.2  # arrow, of the model's size
# The longest arrow is at least the strength on the square of so much of the model's size: no round-off is drawn.
LEAST = 0.01

surface = TrivialProducer(registrationName="surface")
contacts = TrivialProducer(registrationName="contacts")
points = CellCenters(Input=contacts, VertexCells=1)

picture = pictures.Picture("Forces where bodies and fragments touch; bodies opened")
picture.opened(surface)


def arrows(array, colour):
    glyph = Glyph(Input=points, GlyphType="Arrow", GlyphMode="All Points")
    glyph.OrientationArray = ["POINTS", array]
    glyph.ScaleArray = ["POINTS", array]
    glyph.VectorScaleMode = "Scale by Magnitude"
    picture.solid(glyph, colour)
    return glyph


glyphs = [arrows("normal_force", NORMAL), arrows("tangential_force", FRICTION)]
for shade in (NORMAL, FRICTION):
    picture.key(shade)
upper = breccia_insitu.parameter("upper", 0.0)
largest_so_far = 0.0
range_of_forces = None


def largest_force():
    forces = pictures.data_of(contacts).GetCellData().GetArray("force")
    if forces is None or forces.GetNumberOfTuples() == 0:
        return pictures.largest(0.0)
    return pictures.largest(float((vtk_to_numpy(forces) ** 2).sum(axis=1).max() ** 0.5))


def model_size():
    """Largest extent of the surface, m."""
    low, high = pictures.bounds_of(surface)
    return max(high[i] - low[i] for i in range(3))


def catalyst_execute(info):
    global largest_so_far, range_of_forces
    surface.UpdatePipeline()
    contacts.UpdatePipeline()
    size = model_size()
    if range_of_forces is None:
        range_of_forces = pictures.Range("arrows", "N", upper, breccia_insitu.strength() * (LEAST * size) ** 2)
    now = largest_force()
    largest_so_far = max(largest_so_far, now)
    force = range_of_forces.include(largest_so_far, info.time)
    for glyph in glyphs:
        glyph.ScaleFactor = LONGEST * size / force
    picture.say(info, f"{pictures.cells_of(contacts):,} contact points, largest force {pictures.quantity(now, 'N')}, "
                f"so far {pictures.quantity(largest_so_far, 'N')}", range_of_forces.news())
    picture.place_camera(surface)
    words = pictures.quantity(force, "N")
    picture.set_keys((LONGEST * size, "normal force " + words), (LONGEST * size, "friction " + words))


def catalyst_finalize():
    picture.list_pictures()
