# script-version: 2.0
"""Which rank owns what: the bodies' surface in a colour for each rank, the box of each domain, and how evenly the ranks are loaded.

Parameters: those of every picture (breccia_pictures.py).
"""

from paraview.simple import TrivialProducer

import breccia_pictures as pictures

# Twelve colours that stay apart, also for most who see colours differently; ranks beyond them begin anew.
COLOURS = [0.40, 0.62, 0.85, 0.96, 0.70, 0.35, 0.55, 0.78, 0.52, 0.85, 0.47, 0.45, 0.68, 0.60, 0.82, 0.75, 0.66, 0.55,
           0.93, 0.68, 0.80, 0.62, 0.62, 0.62, 0.82, 0.83, 0.42, 0.45, 0.80, 0.82, 0.30, 0.42, 0.58, 0.72, 0.50, 0.28]

surface = TrivialProducer(registrationName="surface")
fractures = TrivialProducer(registrationName="fractures")
domains = TrivialProducer(registrationName="domains")

picture = pictures.Picture("Which rank owns what; boxes of the domains")
ranks = picture.coloured(surface, "rank", [0, 0, 0, 0, 1, 1, 1, 1], "owner")
ranks.InterpretValuesAsCategories = 1
ranks.IndexedColors = COLOURS
picture.lines(fractures, pictures.FRACTURE, 1.5)
picture.lines(domains, pictures.INK, 2.5)
named = 0


def name_ranks(count):
    """As many categories as ranks; more ranks than colours share them in turn."""
    global named
    if count == named:
        return
    named = count
    ranks.Annotations = [text for rank in range(count) for text in (str(rank), f"rank {rank}")]
    ranks.IndexedColors = [COLOURS[(3 * rank + k) % len(COLOURS)] for rank in range(count) for k in range(3)]


def imbalance():
    """Largest over mean load of the ranks that own something."""
    loads = pictures.data_of(domains).GetCellData().GetArray("load")
    mine = loads.GetValue(0) if loads is not None and loads.GetNumberOfTuples() > 0 else 0.0
    owners = pictures.over_ranks(float(mine > 0))
    mean = pictures.over_ranks(mine) / owners if owners > 0 else 0.0
    return pictures.largest(mine) / mean if mean > 0 else 1.0


def catalyst_execute(info):
    for channel in (surface, fractures, domains):
        channel.UpdatePipeline()
    count = pictures.cells_of(domains)
    name_ranks(count)
    picture.say(info, f"{count} rank{'s' if count != 1 else ''}, largest load {imbalance():.2f} of the mean")
    picture.place_camera(surface)


def catalyst_finalize():
    picture.list_pictures()
