"""pvpython fragments_over_time.py RUN FOLDER [--follow ELEMENT ...]: tables of the fragments at the last frame and of their sieve curve, and one with a line
for each frame: how many there are, the largest one's mass, d50 and d80. --follow: the path of the fragments that hold these elements. No screen is
needed."""
import argparse
import csv
import os
import sys

from paraview import simple

parser = argparse.ArgumentParser(prog="fragments_over_time.py")
parser.add_argument("run")
parser.add_argument("folder")
parser.add_argument("--follow", type=int, nargs="*", default=[])
arguments = parser.parse_args()
root = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
plugin = os.environ.get("BRECCIA_PARAVIEW_PLUGIN", os.path.join(root, "build/release/plugins/lib/breccia/paraview/Breccia/Breccia.so"))
if not os.path.exists(plugin):
    sys.exit(f"fragments_over_time.py: {plugin} is missing: ./run build makes it, BRECCIA_PARAVIEW_PLUGIN names another")
simple.LoadPlugin(plugin, remote=False, ns=globals())
os.makedirs(arguments.folder, exist_ok=True)


def table(source, port):
    return source.GetClientSideObject().GetOutputDataObject(port)


def column(rows, name):
    array = rows.GetRowData().GetArray(name)
    return [array.GetTuple(i) if array.GetNumberOfComponents() > 1 else array.GetComponent(i, 0) for i in range(rows.GetNumberOfRows())]


def fact(rows, name):
    return rows.GetFieldData().GetArray(name).GetValue(0)


run = BrecciaReader(FileName=arguments.run)  # noqa: F821: LoadPlugin has made it
run.UpdatePipelineInformation()
fragments = Fragments(Input=run)  # noqa: F821
with open(os.path.join(arguments.folder, "fragments_over_time.csv"), "w", newline="") as file:
    out = csv.writer(file)
    out.writerow(["time [s]", "fragments", "largest mass [kg]", "d50 [m]", "d80 [m]"])
    for time in run.TimestepValues:
        fragments.UpdatePipeline(time)
        mass = column(table(fragments, 1), "mass")
        out.writerow([time, len(mass), max(mass), fact(table(fragments, 2), "d50"), fact(table(fragments, 2), "d80")])
for port, name in ((1, "fragments.csv"), (2, "sieve_curve.csv")):
    simple.SaveData(os.path.join(arguments.folder, name), simple.OutputPort(fragments, port))
if arguments.follow:
    fragments.FollowedElements = arguments.follow
    with open(os.path.join(arguments.folder, "followed.csv"), "w", newline="") as file:
        out = csv.writer(file)
        out.writerow(["time [s]", "fragment", "mass [kg]", "x [m]", "y [m]", "z [m]", "vx [m/s]", "vy [m/s]", "vz [m/s]"])
        for time in run.TimestepValues:
            fragments.UpdatePipeline(time)
            rows = table(fragments, 1)
            for each in zip(column(rows, "fragment"), column(rows, "mass"), column(rows, "centroid"), column(rows, "velocity")):
                out.writerow([time, int(each[0]), each[1], *each[2], *each[3]])
print(arguments.folder)
