"""paraview --script=window_test.py: both plugins in ParaView's window, and every macro there. Says "window: done" and ends the program."""
import glob
import os
import sys
import traceback

from paraview import simple

toolbar, run, folder = (os.environ[name] for name in ("BRECCIA_TOOLBAR", "BRECCIA_TEST_RUN", "BRECCIA_TEST_OUTPUT"))
sys.stdout = sys.stderr = open(os.path.join(folder, "words"), "w")  # the window keeps its own words for its user
try:
    plugin = os.environ["BRECCIA_PARAVIEW_PLUGIN"]
    simple.LoadPlugin(plugin, remote=False)
    simple.LoadPlugin(toolbar, remote=False)
    reader = simple.OpenDataFile(os.path.join(run, "status.jsonl"))
    reader.UpdatePipelineInformation()
    macros = sorted(glob.glob(os.path.join(os.path.dirname(plugin), "Breccia_*.py")))
    if len(macros) != 5:
        print("FAILED: macros", macros)
    for macro in macros:
        before = len(simple.GetLayouts())
        simple.SetActiveSource(reader)
        try:
            exec(compile(open(macro).read(), macro, "exec"), {"__name__": "__main__"})
        except Exception as why:
            if type(why).__name__ != "NoPicture":
                raise
            print(os.path.basename(macro), "says", why)
            continue
        if len(simple.GetLayouts()) != before + 1:
            print("FAILED:", os.path.basename(macro), "has made no layout")
    print("window: done")
except BaseException:
    traceback.print_exc()
sys.stdout.flush()
os._exit(0)  # the window would wait for a user
