"""pvpython views_test.py RUN: how ParaView shows what the plugin makes of a run, the five usual pictures, and the help of all there is. Needs a screen."""
import os
import sys
import tempfile

import numpy as np
from paraview import servermanager
from vtkmodules.vtkIOImage import vtkPNGReader

import broken_box as b

simple = b.load()
run, plugin = sys.argv[1], os.environ["BRECCIA_PARAVIEW_PLUGIN"]
sys.path.insert(0, os.path.dirname(plugin))
import breccia_pictures as pictures  # noqa: E402: beside the plugin

SHOWN = {"Fragments": ("CELLS", "fragment_diameter", "fragment diameter [m]", "Surface"),
         "FractureSurface": ("CELLS", "time_of_failure", "time of failure [s]", "Surface"),
         "CrackEvents": ("POINTS", "time", "time [s]", "Point Gaussian"),
         "ContactNetwork": ("POINTS", "force", "contact force [N]", "Surface"),
         "RankView": ("CELLS", "load", "cost over the mean", "Wireframe")}
PORTS = {"Fragments": 3, "FractureSurface": 4, "CrackEvents": 3, "ContactNetwork": 3, "RankView": 3}
reader = simple.BrecciaReader(FileName=run)
reader.UpdatePipelineInformation()
last = reader.TimestepValues[-1]


def colours(proxy, view):
    """What a proxy is shown by when nothing is said: association, array, title of the scalar bar, representation."""
    shown = simple.Show(proxy, view)
    association, array = shown.ColorArrayName
    shown.SetScalarBarVisibility(view, True)
    return association, array, simple.GetScalarBar(simple.GetColorTransferFunction(array), view).Title, str(shown.Representation).strip("'")


def things_are_shown_by_what_they_are_of():
    view = simple.CreateView("RenderView")
    reader.UpdatePipeline(0.0)
    found = colours(reader, view)  # as it is opened: at the first frame
    b.expect(found == ("CELLS", "von_mises", "von Mises stress [Pa]", "Surface"), f"a run is shown by {found}")
    simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    simple.GetAnimationScene().AnimationTime = view.ViewTime = last  # ParaView colours nothing that is empty
    controller = servermanager.vtkSMParaViewPipelineControllerWithRendering()
    b.expect(controller.GetPreferredViewType(reader.SMProxy, 1) == "None", "the history opens no view of its own")
    for name, expected in SHOWN.items():
        proxy = getattr(simple, name)(Input=reader)
        proxy.UpdatePipeline(last)
        if proxy.GetDataInformation().GetNumberOfCells() > 0:
            found = colours(proxy, view)
            b.expect(found == expected, f"{name} is shown by {found}")
        b.expect(proxy.SMProxy.GetNumberOfOutputPorts() == PORTS[name], f"{name} has {proxy.SMProxy.GetNumberOfOutputPorts()} outputs")
        for port in range(1, PORTS[name]):
            b.expect(controller.GetPreferredViewType(proxy.SMProxy, port) == "None", f"output {port} of {name} opens no view of its own")
    balance = simple.EnergyBalance(Input=simple.OutputPort(reader, 1))
    b.expect(controller.GetPreferredViewType(balance.SMProxy, 0) == "XYChartView", "energies are a chart")
    mode = simple.GetColorTransferFunction("mode")
    b.expect(mode.InterpretValuesAsCategories and "mode II" in list(mode.Annotations), f"modes have names: {mode.Annotations}")


def everything_has_its_help():
    balance = simple.EnergyBalance(Input=simple.OutputPort(reader, 1))
    for proxy in [reader, balance] + [getattr(simple, name)(Input=reader) for name in SHOWN]:
        help_of = proxy.SMProxy.GetDocumentation()
        b.expect(len(help_of.GetShortHelp() or "") > 10 and len(help_of.GetLongHelp() or "") > 20, f"help of {proxy.GetXMLName()}")
        b.expect(len(help_of.GetDescription() or "") > 100, f"description of {proxy.GetXMLName()}")
        iterator = proxy.SMProxy.NewPropertyIterator()
        iterator.Begin()
        while not iterator.IsAtEnd():
            text = iterator.GetProperty().GetDocumentation()
            b.expect(iterator.GetProperty().GetInformationOnly() or (text is not None and len(text.GetDescription() or "") > 5),
                     f"help of {iterator.GetKey()} of {proxy.GetXMLName()}")
            iterator.Next()


def painted(file):
    """How many colours a picture has."""
    image = vtkPNGReader()
    image.SetFileName(file)
    image.Update()
    return len(np.unique(b.vtk_to_numpy(image.GetOutput().GetPointData().GetScalars()), axis=0))


def the_five_pictures_are_drawn():
    pictures.SIZE = [400, 280]
    with tempfile.TemporaryDirectory() as folder:
        for name, draw in pictures.PICTURES.items():
            views = draw(reader)
            b.expect(len(views) == {"cracks": 2, "fragments": 2}.get(name, 1), f"{name}: {len(views)} views")
            for view in views:
                simple.SaveScreenshot(f"{folder}/{name}.png", view, ImageResolution=[400, 280])
                b.expect(painted(f"{folder}/{name}.png") > 20, f"{name} has {painted(f'{folder}/{name}.png')} colours")


def refused(name, *arguments):
    try:
        pictures.PICTURES[name](*arguments)
    except pictures.NoPicture as why:
        return str(why)
    return ""


def pictures_of_nothing_are_refused():
    b.expect("no joint has failed" in refused("cracks", reader, 0.0), f"cracks before any: {refused('cracks', reader, 0.0)}")
    b.expect("choose another time" in refused("contacts", reader, 0.0), f"contacts before any: {refused('contacts', reader, 0.0)}")
    for source in simple.GetSources().values():
        simple.Delete(source)
    b.expect("no run is open" in refused("stress"), f"no run: {refused('stress')}")


things_are_shown_by_what_they_are_of()
everything_has_its_help()
the_five_pictures_are_drawn()
pictures_of_nothing_are_refused()
b.finish()
