"""Draws what the filters make of a run; for pvpython. BRECCIA_PICTURE_RUNS names a run and one on several ranks, separated by a colon, BRECCIA_PICTURES the
folder to draw into, BRECCIA_PARAVIEW_PLUGIN the plugin."""
import os

from paraview.simple import *  # noqa: F403: ParaView's way

LoadPlugin(os.environ["BRECCIA_PARAVIEW_PLUGIN"], remote=False, ns=globals())
RUN, RUN_ON_RANKS = os.environ["BRECCIA_PICTURE_RUNS"].split(":")
FOLDER = os.environ["BRECCIA_PICTURES"]
SIZE = [800, 560]
GREY = [0.35, 0.38, 0.42]


def opened(path):
    reader = BrecciaReader(registrationName=os.path.basename(path.rstrip("/")), FileName=path + "/status.jsonl")
    reader.UpdatePipelineInformation()
    return reader


def room(time):
    """A view in three dimensions at a time; y is up."""
    view = CreateView("RenderView")
    AssignViewToLayout(view=view, layout=CreateLayout(f"view {len(GetLayouts()) + 1}"))
    view.ViewSize = SIZE
    view.OrientationAxesVisibility = 1
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesLabelColor = GREY
    view.ViewTime = time
    return view


def coloured(shown, view, array, title, association="CELLS", preset="Viridis (matplotlib)", height=(0.2, 0.6)):
    """height: lower end and length of the key, of the view's"""
    ColorBy(shown, (association, array))
    shown.RescaleTransferFunctionToDataRange(False, True)
    table = GetColorTransferFunction(array)
    table.ApplyPreset(preset, True)
    bar = GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = title, ""
    bar.TitleColor = bar.LabelColor = GREY
    bar.WindowLocation, bar.Position, bar.ScalarBarLength = "Any Location", [0.85, height[0]], height[1]  # its title runs beside it, whole
    shown.SetScalarBarVisibility(view, True)
    shown.Ambient = 0.3


def saved(view, name, look=(0.5, 0.9, 1.2), zoom=1.15):
    if view.GetXMLName() == "RenderView":
        view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = list(look), [0, 0, 0], [0, 1, 0]
        view.ResetCamera()
        GetActiveCamera().Dolly(zoom)
    Render(view)
    SaveScreenshot(f"{FOLDER}/{name}.png", view, ImageResolution=SIZE, CompressionLevel="9")


def chart(source, port, x, columns, name, titles, logarithmic=(0, 0)):
    view = CreateView("XYChartView")
    AssignViewToLayout(view=view, layout=CreateLayout(f"view {len(GetLayouts()) + 1}"))
    view.ViewSize = SIZE
    shown = Show(OutputPort(source, port), view, "XYChartRepresentation")
    shown.UseIndexForXAxis = 0
    shown.XArrayName = x
    shown.SeriesVisibility = [c for c, _ in columns]
    shown.SeriesLabel = [text for pair in columns for text in pair]
    view.BottomAxisTitle, view.LeftAxisTitle = titles
    view.BottomAxisLogScale, view.LeftAxisLogScale = logarithmic
    saved(view, name)


run = opened(RUN)
time = run.TimestepValues[-1]
scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.AnimationTime = time
run.UpdatePipeline(time)

view = room(time)
stressed = ExtractBlock(registrationName="elements", Input=run, Selectors=["/Root/elements"])
coloured(Show(stressed, view), view, "von_mises", "von Mises stress [Pa]")
saved(view, "reader")

fragments = Fragments(registrationName="Fragments", Input=run)
view = room(time)
coloured(Show(fragments, view), view, "fragment_diameter", "diameter of the fragment [m]", preset="Plasma (matplotlib)")
saved(view, "fragments", look=(0.4, -1.2, 0.6), zoom=1)
chart(fragments, 2, "size", [("passing", "mass that passes"), ("rosin_rammler", "Rosin-Rammler"), ("swebrec", "Swebrec")],
      "sieve", ["size [m]", "share of the mass"], logarithmic=(1, 0))

cracks = FractureSurface(registrationName="Fracture Surface", Input=run, Up="Y")
view = room(time)
coloured(Show(cracks, view), view, "time_of_failure", "time of failure [s]", preset="Inferno (matplotlib)")
saved(view, "fracture_surface")

events = CrackEvents(registrationName="Crack Events", Input=run, YoungsModulus=75e9)
view = room(time)
balls = Glyph(registrationName="events", Input=events, GlyphType="Sphere", ScaleArray=["POINTS", "area"], GlyphMode="All Points")
balls.UpdatePipeline(time)
areas = events.PointData["area"].GetRange()
balls.ScaleFactor = 0.008 / areas[1]
coloured(Show(balls, view), view, "time", "time of the event [s]", "POINTS", "Inferno (matplotlib)")
outline = Show(stressed, view)
outline.Representation = "Outline"
outline.ColorArrayName = ["CELLS", ""]
outline.AmbientColor = outline.DiffuseColor = GREY
saved(view, "crack_events")
chart(events, 2, "magnitude", [("events_of_it_or_more", "events of it or more"), ("gutenberg_richter", "Gutenberg-Richter")],
      "magnitudes", ["magnitude", "events"], logarithmic=(0, 1))

scene.AnimationTime = run.TimestepValues[5]
network = ContactNetwork(registrationName="Contact Network", Input=run)
view = room(run.TimestepValues[5])  # while the projectile presses on the plate
coloured(Show(network, view), view, "force", "contact force [N]", "POINTS", "Plasma (matplotlib)")
ghost = Show(stressed, view)
ghost.ColorArrayName = ["CELLS", ""]
ghost.Representation = "Outline"
ghost.AmbientColor = ghost.DiffuseColor = GREY
saved(view, "contact_network")

scene.AnimationTime = time
balance = EnergyBalance(registrationName="Energy Balance", Input=OutputPort(run, 1))
balance.UpdatePipeline()
rows = balance.GetDataInformation().DataInformation.GetRowDataInformation()
names = [rows.GetArrayInformation(i).GetName() for i in range(rows.GetNumberOfArrays())]
terms = [name for name in names if name.startswith("up to")]
chart(balance, 0, "time [s]", [(name, name) for name in terms], "energy_balance", ["time [s]", "energy, stacked [J]"])

on_ranks = opened(RUN_ON_RANKS)
on_ranks.UpdatePipeline(time)
ranks = RankView(registrationName="Rank View", Input=on_ranks)
view = room(time)
boxes = Show(ranks, view)
boxes.Opacity = 0.4
boxes.Representation = "Surface With Edges"
coloured(boxes, view, "load", "cost over the mean", height=(0.1, 0.35))
coloured(Show(ExtractBlock(Input=on_ranks, Selectors=["/Root/elements"]), view), view, "rank", "rank", height=(0.55, 0.35))
saved(view, "rank_view")
