"""A ParaView without windows that watches a run: connects, receives channels, pauses, continues, takes a picture, and dies without goodbye.

usage: pvpython live_client.py PORT FOLDER [--briefly | --freeze]
--briefly: dies as soon as it has received the channels. --freeze: stops as soon as it is connected, as by Ctrl-Z.
Writes FOLDER/client.log; FOLDER/step is written by the run; FOLDER/done says that it was killed on purpose.
"""

import os
import signal
import sys
import time

from paraview import live
from paraview.simple import ColorBy, CreateRenderView, Render, SaveScreenshot, Show

PORT, FOLDER = int(sys.argv[1]), sys.argv[2]
PATIENCE = 60.0  # s, for each thing waited for
log = open(os.path.join(FOLDER, "client.log"), "w", encoding="utf-8", buffering=1)


def wait(what, condition):
    """Handles what the run sends until the condition holds."""
    end = time.time() + PATIENCE
    while not condition():
        if time.time() > end:
            print("waited in vain for", what, file=log)
            sys.exit(1)
        live.ProcessServerNotifications()
        time.sleep(0.02)


def cells(source):
    source.UpdatePipeline()
    return source.GetDataInformation().GetNumberOfCells()


def step():
    with open(os.path.join(FOLDER, "step"), encoding="utf-8") as file:
        return int(file.read() or -1)


def die():
    with open(os.path.join(FOLDER, "done"), "w", encoding="utf-8"):
        pass
    os.kill(os.getpid(), signal.SIGKILL)


link = live.ConnectToCatalyst("localhost", PORT)
proxies = link.GetInsituProxyManager
wait("sources", lambda: proxies() and proxies().GetNumberOfProxies("sources") >= 3)
if "--freeze" in sys.argv:
    os.kill(os.getpid(), signal.SIGSTOP)
    os._exit(0)
print("connected at step", step(), file=log)
extracts = {name: live.ExtractCatalystData(link, name) for name in ("elements", "fractures", "domains")}
for name, extract in extracts.items():
    wait(name, lambda: cells(extract) > 0)
    print(name, cells(extract), "cells", extract.CellData.keys(), file=log)
if "--briefly" in sys.argv:
    die()
first = cells(extracts["fractures"])
wait("other fractures", lambda: cells(extracts["fractures"]) != first)
print("fractures changed", file=log)

live.PauseCatalyst(link, True)
time.sleep(0.5)
live.ProcessServerNotifications()
before = step()
time.sleep(2.0)
live.ProcessServerNotifications()
print("stood still" if step() == before else f"ran on from {before} to {step()}", file=log)
live.PauseCatalyst(link, False)
wait("the run to go on", lambda: step() > before + 3)
print("went on", file=log)

view = CreateRenderView(ViewSize=[320, 240])
display = Show(extracts["fractures"], view)
ColorBy(display, ("CELLS", "damage"))
Show(extracts["domains"], view).SetRepresentationType("Wireframe")
view.ResetCamera()
Render(view)
picture = os.path.join(FOLDER, "live.png")
SaveScreenshot(picture, view)
from vtkmodules.vtkIOImage import vtkPNGReader
reader = vtkPNGReader()
reader.SetFileName(picture)
reader.Update()
low, high = reader.GetOutput().GetScalarRange()
print("picture shows something" if high - low > 50 else "picture is blank", file=log)
die()
