"""paraview --script=window_pictures.py: shows in ParaView's window what BRECCIA_WINDOW names (a filter by its name in Python, as it is shown by default, or
"toolbar": pictures of the toolbar) of the run BRECCIA_PICTURE_RUN, and makes the file BRECCIA_PICTURE_WINDOW when done. See gui.sh."""
import os
import sys

from paraview.simple import *  # noqa: F403: ParaView's way

plugin, what = os.environ["BRECCIA_PARAVIEW_PLUGIN"], os.environ["BRECCIA_WINDOW"]
LoadPlugin(plugin, remote=False, ns=globals())
toolbar = plugin.replace("Breccia/Breccia.so", "BrecciaToolbar/BrecciaToolbar.so")
if os.path.exists(toolbar):
    LoadPlugin(toolbar, remote=False)
run = BrecciaReader(registrationName="glass", FileName=os.environ["BRECCIA_PICTURE_RUN"] + "/status.jsonl")
run.UpdatePipelineInformation()
scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
time = run.TimestepValues[5 if what == "ContactNetwork" else -1]
if what not in ("BrecciaReader", "RankView"):  # a run is opened at its first frame
    scene.AnimationTime = time
if what == "toolbar":
    sys.path.insert(0, os.path.dirname(plugin))
    import breccia_pictures
    for name in ("energy", "stress", "cracks", "fragments"):
        breccia_pictures.PICTURES[name](run)
else:
    view = GetActiveViewOrCreate("RenderView")
    shown = run
    if what == "EnergyBalance":
        shown = EnergyBalance(registrationName="Energy Balance", Input=OutputPort(run, 1))
    elif what != "BrecciaReader":
        shown = globals()[what](registrationName=what, Input=run)
    UpdatePipeline(scene.AnimationTime, shown)
    if what == "RankView":
        Show(run, view).SetScalarBarVisibility(view, True)
    if what == "EnergyBalance":
        view = CreateView("XYChartView")
        AssignViewToLayout(view=view, layout=GetLayout(), hint=0)
    display = Show(shown, view)
    if what != "EnergyBalance":
        display.SetScalarBarVisibility(view, True)
        view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0.5, 0.8, 1.1], [0, 0, 0], [0, 1, 0]
        view.ResetCamera()
    scene.AnimationTime = time
    Render(view)
    SetActiveSource(shown)
open(os.environ["BRECCIA_PICTURE_WINDOW"], "w").close()
