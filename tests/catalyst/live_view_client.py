"""The view of `breccia live` without ParaView's window: watches a run, pauses it, lets it go on, sees it end, and watches the next one.

usage: pvpython live_view_client.py FOLDER    (PYTHONPATH and BRECCIA_LIVE_... as `breccia live` sets them)
Appends lines to FOLDER/client.log; those that begin with "ready" say that the next run may come, or that this one may end.
"""

import os
import sys
import time

import live_steering
import live_view
from paraview.simple import Render, SaveScreenshot
from vtkmodules.vtkIOImage import vtkPNGReader

FOLDER = sys.argv[1]
PATIENCE = 150.0  # s, for each thing waited for
log = open(os.path.join(FOLDER, "client.log"), "w", encoding="utf-8", buffering=1)

live_view.start()
link = live_view.link
bodies, plot = link._bodies, link._plot


def words():
    return bodies._source.Text


def rows():
    return plot._table.GetNumberOfRows()


def step():
    return int(next((line.split("step ")[1] for line in words().split("\n") if "step " in line), "-1").replace(",", ""))


def wait(what, condition):
    end = time.time() + PATIENCE
    while not condition():
        if time.time() > end:
            print("waited in vain for", what, "-", words().replace("\n", " | "), file=log)
            os._exit(1)
        link.look()
        time.sleep(0.02)


def coloured_part(file):
    """Part of a picture whose pixels are neither white, grey nor black."""
    reader = vtkPNGReader()
    reader.SetFileName(file)
    reader.Update()
    pixels = reader.GetOutput().GetPointData().GetScalars()
    number = pixels.GetNumberOfTuples()
    colours = [pixels.GetTuple(i)[:3] for i in range(0, number, 7)]
    return sum(max(colour) - min(colour) > 60 for colour in colours) / len(colours)


print("ready", words().replace("\n", " | "), file=log)
wait("a run", lambda: rows() >= 3)
print("first", words().replace("\n", " | "), file=log)

link.pause(True)
held = -2
while held != step():  # what was under way still comes
    held = step()
    end = time.time() + 1.5
    wait("nothing", lambda: time.time() > end)
print("held" if "the run pauses" in words() else "not told", file=log)
link.pause(False)
wait("the run to go on", lambda: step() > held)
print("went on", file=log)
last = plot._table.GetValue(rows() - 1, 0).ToDouble()

print("ready for its end", file=log)
wait("its end", lambda: "the run has ended" in words())
print("ended", words().replace("\n", " | "), "cells", live_view.pictures.cells_of(bodies.sources["surface"]), file=log)

print("ready for the next", file=log)
wait("another run", lambda: "the run has ended" not in words() and rows() >= 2)
print("began again" if plot._table.GetValue(0, 0).ToDouble() < last else "curves of both runs", file=log)
wait("cracks", lambda: live_view.pictures.cells_of(bodies.sources["fractures"]) > 0)
Render(bodies.view)
picture = os.path.join(FOLDER, "view.png")
SaveScreenshot(picture, bodies.view, ImageResolution=[640, 480])
print("second", words().replace("\n", " | "), "coloured", "yes" if coloured_part(picture) > 0.02 else coloured_part(picture), file=log)
SaveScreenshot(os.path.join(FOLDER, "plot.png"), plot.view, ImageResolution=[640, 480])
print("curves", "coloured" if coloured_part(os.path.join(FOLDER, "plot.png")) > 0.001 else "not drawn", file=log)

# The panel: what stands in the proxy when Apply has been pressed.
steering, panel = link.steering, link.steering.panel.SMProxy


def ask(name, value, answer):
    panel.GetProperty(name).SetElement(0, value)
    wait(answer, lambda: answer in words())
    print("answered", answer, file=log)


ask("Request", live_steering.REQUESTS.index("stop"), "this view was not opened by `breccia live`")
steering._program = os.environ["STEERING"]
print("folder", steering.folder, file=log)
ask("FrameInterval", "1 ms", "frame_interval 1 ms: done")
ask("FrameInterval", "soon", "frame_interval")
wait("a refusal", lambda: "requested: " not in words() and "frame_interval soon: " in words())
print("refused", " ".join(words().split("frame_interval soon: ")[1].split()), file=log)
ask("Request", live_steering.REQUESTS.index("pause"), "pause: done")
end = time.time() + 1.0
wait("nothing", lambda: time.time() > end)  # what was under way still comes
held, end = step(), time.time() + 1.0
wait("nothing", lambda: time.time() > end)
print("stood" if step() == held else "ran on", file=log)
ask("Request", live_steering.REQUESTS.index("resume"), "resume: done")
wait("further steps", lambda: step() > held)
ask("Request", live_steering.REQUESTS.index("extract"), "extract: done")
fractures = live_view.pictures.cells_of(bodies.sources["fractures"])
ask("Opening", "far", "'far' is no length")
panel.GetProperty("Opening").SetElement(0, "1000 m")
wait("no cracks", lambda: live_view.pictures.cells_of(bodies._cracks) == 0)
wait("words", lambda: "this view shows cracks open by more than 1000 m; the run and its pipelines stay as they are" in " ".join(words().split()))
panel.GetProperty("Opening").SetElement(0, "")
wait("all cracks", lambda: live_view.pictures.cells_of(bodies._cracks) >= fractures > 0)
print("cracks by opening", file=log)
ask("Request", live_steering.REQUESTS.index("stop"), "requested: stop")
wait("the end", lambda: "the run has ended" in words())
print("ready with all", file=log)
os._exit(0)
