# script-version: 2.0
"""Cracks as they grow: failed joints in the colour of the time at which they failed, the bodies around them opened.

Parameters besides those of every picture (breccia_pictures.py): upper, the time of the newest colour, s; default: the present.
"""

from paraview.simple import TrivialProducer

import breccia_insitu
import breccia_pictures as pictures

surface = TrivialProducer(registrationName="surface")
fractures = TrivialProducer(registrationName="fractures")

picture = pictures.Picture()
picture.opened(surface)
ages = picture.coloured(fractures, "time_of_failure", pictures.AGES, "time of failure [s]", "%-#6.2e")
upper = breccia_insitu.parameter("upper", 0.0)


def catalyst_execute(info):
    surface.UpdatePipeline()
    fractures.UpdatePipeline()
    pictures.table_range(ages, 0.0, upper or info.time or 1e-12)
    picture.say(info, f"{pictures.cells_of(fractures):,} broken joints")
    picture.place_camera(surface)


def catalyst_finalize():
    picture.list_pictures()
