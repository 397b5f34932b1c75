"""pvpython figures.py RUN FOLDER [--time SECONDS] [--pictures cracks,stress] [--size 1600x1120]: the five usual pictures of a run as PNG files, one for
each view. Without a screen: xvfb-run -a -s "-screen 0 1600x1000x24 -noreset" pvpython figures.py ..."""
import argparse
import os
import sys

parser = argparse.ArgumentParser(prog="figures.py")
parser.add_argument("run")
parser.add_argument("folder")
parser.add_argument("--time", type=float, help="s; without it the last frame")
parser.add_argument("--pictures", default="cracks,fragments,stress,contacts,energy")
parser.add_argument("--size", default="1600x1120")
parser.add_argument("--plugin", default=os.environ.get("BRECCIA_PARAVIEW_PLUGIN"), help="Breccia.so; the one of build/release where not given")
arguments = parser.parse_args()
root = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
plugin = arguments.plugin or os.path.join(root, "build/release/plugins/lib/breccia/paraview/Breccia/Breccia.so")
if not os.path.exists(plugin):
    sys.exit(f"figures.py: {plugin} is missing: ./run build makes it, --plugin names another")
sys.path.insert(0, os.path.dirname(plugin))
import breccia_pictures  # noqa: E402: beside the plugin
from paraview import simple  # noqa: E402

wanted = arguments.pictures.split(",")
for name in wanted:
    if name not in breccia_pictures.PICTURES:
        sys.exit(f"figures.py: there is no picture '{name}'; there are {', '.join(breccia_pictures.PICTURES)}")
breccia_pictures.SIZE = [800, 560]  # letters are of a size to match; pictures are as large as asked for
run = breccia_pictures.made("BrecciaReader", FileName=arguments.run)
os.makedirs(arguments.folder, exist_ok=True)
size = [int(n) for n in arguments.size.split("x")]
for name in wanted:
    try:
        views = breccia_pictures.PICTURES[name](run, arguments.time)
    except breccia_pictures.NoPicture as why:
        print(f"{name}: {why}")
        continue
    for i, view in enumerate(views):
        file = os.path.join(arguments.folder, f"{name}_{i + 1}.png" if len(views) > 1 else f"{name}.png")
        simple.SaveScreenshot(file, view, ImageResolution=size)
        print(file)
