# script-version: 2.0
"""Cracks as they grow, in the colour of the time at which their joints failed: as they are seen from outside, and with the bodies opened.

Parameters besides those of every picture (breccia_pictures.py): upper, the time of the newest colour, s; default: the end of the run.
"""

from paraview.simple import Calculator, TrivialProducer

import breccia_insitu
import breccia_pictures as pictures

surface = TrivialProducer(registrationName="surface")
fractures = TrivialProducer(registrationName="fractures")

range_of_ages = pictures.Range("colours", "s", breccia_insitu.parameter("upper", 0.0) or breccia_insitu.end(), 0.0)
unit, size = pictures.unit_of(range_of_ages.upper or 1e-6, "s")
AGE = f"time of failure [{unit}]"
# Two of the same: a source has one look in a view.
inside, traces = (Calculator(Input=fractures, AttributeType="Cell Data", ResultArrayName=AGE, Function=f"time_of_failure/{size!r}")
                  for _ in range(2))

picture = pictures.Picture("Cracks by the time at which they opened", ("from outside", "bodies opened"))
picture.bodies(surface)
picture.opened(surface, copy=1)
ages = picture.coloured(inside, AGE, pictures.AGES, AGE, copy=1)
picture.coloured_lines(traces, AGE)


def catalyst_execute(info):
    surface.UpdatePipeline()
    fractures.UpdatePipeline()
    pictures.table_range(ages, 0.0, range_of_ages.include(info.time, info.time) / size)
    picture.say(info, f"{pictures.cells_of(fractures):,} broken joints", range_of_ages.news())
    picture.place_camera(surface)


def catalyst_finalize():
    picture.list_pictures()
