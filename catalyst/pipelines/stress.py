# script-version: 2.0
"""Von Mises stress on the bodies' surface and on the faces of cracks, which are edged dark.

Parameters besides those of every picture (breccia_pictures.py): lower, upper, ends of the colours, Pa; default: 0, and the next of 1, 2,
5, 10, ... above the largest strength of the joints and the largest 99 % quantile so far.
"""

from paraview.simple import Calculator, TrivialProducer

import breccia_insitu
import breccia_pictures as pictures

surface = TrivialProducer(registrationName="surface")
fractures = TrivialProducer(registrationName="fractures")

lower = breccia_insitu.parameter("lower", 0.0)
range_of_stress = pictures.Range("colours", "Pa", breccia_insitu.parameter("upper", 0.0), breccia_insitu.strength())
unit, size = pictures.unit_of(range_of_stress.upper or 1e6, "Pa")
STRESS = f"von Mises stress [{unit}]"
stress = Calculator(Input=surface, AttributeType="Cell Data", ResultArrayName=STRESS, Function=f"von_mises/{size!r}")

picture = pictures.Picture("Stress, and cracks (dark)")
colours = picture.coloured(stress, STRESS, pictures.SEQUENTIAL, STRESS)
picture.lines(fractures)


def catalyst_execute(info):
    surface.UpdatePipeline()
    fractures.UpdatePipeline()
    upper = range_of_stress.include(pictures.quantile_of(surface, "von_mises", 0.99), info.time)
    pictures.table_range(colours, lower / size, upper / size)
    picture.say(info, f"{pictures.cells_of(fractures):,} broken joints", range_of_stress.news())
    picture.place_camera(surface)


def catalyst_finalize():
    picture.list_pictures()
