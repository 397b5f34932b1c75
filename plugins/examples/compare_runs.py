"""pvpython compare_runs.py PICTURE COLUMN RUN RUN ...: one column of the histories of several runs over time, in one chart. Columns are those of
history.csv: "fragments", "broken area [m2]", "kinetic [J]", ... Without a screen: xvfb-run -a -s "-screen 0 1600x1000x24 -noreset" pvpython ..."""
import os
import sys

from paraview import simple

if len(sys.argv) < 4:
    sys.exit(__doc__)
picture, wanted, runs = sys.argv[1], sys.argv[2], sys.argv[3:]
root = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
plugin = os.environ.get("BRECCIA_PARAVIEW_PLUGIN", os.path.join(root, "build/release/plugins/lib/breccia/paraview/Breccia/Breccia.so"))
if not os.path.exists(plugin):
    sys.exit(f"compare_runs.py: {plugin} is missing: ./run build makes it, BRECCIA_PARAVIEW_PLUGIN names another")
simple.LoadPlugin(plugin, remote=False, ns=globals())

COLOURS = ((0.00, 0.45, 0.70), (0.90, 0.62, 0.00), (0.00, 0.62, 0.45), (0.80, 0.40, 0.00), (0.34, 0.71, 0.91), (0.80, 0.47, 0.65))
view = simple.CreateView("XYChartView")
view.ViewSize = [1000, 640]
view.BottomAxisTitle, view.LeftAxisTitle = "time [s]", wanted
for i, name in enumerate(runs):
    run = BrecciaReader(FileName=name)  # noqa: F821: LoadPlugin has made it
    run.UpdatePipeline()
    history = run.GetClientSideObject().GetOutputDataObject(1)
    columns = [history.GetColumnName(c) for c in range(history.GetNumberOfColumns())]
    if wanted not in columns:
        print(f"compare_runs.py: the history of {name} has no column '{wanted}'; it has {', '.join(columns)}", file=sys.stderr, flush=True)
        os._exit(1)  # readers that are still open would have HDF5 complain
    shown = simple.Show(simple.OutputPort(run, 1), view, "XYChartRepresentation")
    shown.UseIndexForXAxis, shown.XArrayName = 0, "time [s]"
    shown.SeriesVisibility = [wanted]
    shown.SeriesLabel = [wanted, os.path.basename(os.path.abspath(name))]
    shown.SeriesColor = [wanted, *(str(c) for c in COLOURS[i % len(COLOURS)])]
simple.Render(view)
simple.SaveScreenshot(picture, view, ImageResolution=[1000, 640])
print(picture)
