"""pvbatch --symmetric reader_test.py RUN: a run as the reader shows it, against what the run's own files say."""
import csv
import json
import math
import sys

import numpy as np

import broken_box as b

simple = b.load()
RANK, RANKS = b.rank()
run = sys.argv[1]


def gathered(values):
    """Sum over the ranks."""
    from vtkmodules.vtkCommonCore import vtkDoubleArray
    if RANKS == 1:
        return values
    mine, total = vtkDoubleArray(), vtkDoubleArray()
    for v in values:
        mine.InsertNextValue(v)
    total.SetNumberOfValues(len(values))
    b.vtkMultiProcessController.GetGlobalController().AllReduce(mine, total, 2)
    return [total.GetValue(i) for i in range(len(values))]


summary = json.load(open(f"{run}/summary.json"))
index = json.load(open(f"{run}/frames/elements.hdf.series"))["files"]
for name in ("status.jsonl", "summary.json", "history.csv", "frames/joints.hdf.series", ""):
    reader = simple.BrecciaReader(FileName=f"{run}/{name}")
    reader.UpdatePipelineInformation()
    b.expect(list(reader.TimestepValues) == [f["time"] for f in index], f"times by {name}")
b.expect(simple.OpenDataFile(f"{run}/status.jsonl").GetXMLName() == "BrecciaReader", "status.jsonl is opened as a run")

last = index[-1]["time"]
fresh = simple.BrecciaReader(FileName=run)
simple.EnergyBalance(Input=simple.OutputPort(fresh, 1)).UpdatePipeline(last)
cells = simple.FractureSurface(Input=fresh)
cells.UpdatePipeline(last)
found = gathered([float(b.output(cells).GetNumberOfCells())])
b.expect(found == [summary["broken_joints"]], f"{found} failed joints after the history was asked for first")

reader.UpdatePipeline(last)
data = b.output(reader)
names = [data.GetMetaData(i).Get(data.NAME()) for i in range(data.GetNumberOfBlocks())]
b.expect(names == ["elements", "contacts", "joints"], f"blocks {names}")
elements, joints = data.GetBlock(0), data.GetBlock(2)
broken = b.vtk_to_numpy(joints.GetCellData().GetArray("broken")).sum() if joints.GetNumberOfCells() else 0
counts = gathered([float(elements.GetNumberOfCells()), float(broken)])
b.expect(counts == [summary["elements"], summary["broken_joints"]], f"elements and broken joints {counts}")

history = b.output(reader, 1)
if RANK == 0:
    rows = list(csv.reader(open(f"{run}/history.csv")))
    b.expect([history.GetColumnName(i) for i in range(history.GetNumberOfColumns())] == rows[0], "columns of the history")
    for i, name in enumerate(rows[0]):
        b.expect(np.array_equal(b.column(history, name), [float(row[i]) for row in rows[1:]]), f"column {name}")
else:
    b.expect(history.GetNumberOfRows() == 0, "the history is on the first rank")

if RANKS == 1:  # a gauge's name may have commas and quotes
    import shutil
    import tempfile
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(run, f"{folder}/run")
        text = open(f"{run}/history.csv").read().replace(",kinetic [J],", ',"a, ""b"" [J]",', 1)
        open(f"{folder}/run/history.csv", "w").write(text)
        quoted = simple.BrecciaReader(FileName=f"{folder}/run")
        quoted.UpdatePipeline(index[-1]["time"])
        b.expect(b.output(quoted, 1).GetColumnName(3) == 'a, "b" [J]', f"column {b.output(quoted, 1).GetColumnName(3)}")

reader.Channels = ["joints"]
reader.UpdatePipeline(index[-1]["time"])
b.expect(b.output(reader).GetNumberOfBlocks() == 1, "one channel is asked for")
reader.Channels = names

# The solver's own labels are the oracle of the filter's.
fragments = simple.Fragments(Input=reader)
for entry in index:
    fragments.UpdatePipeline(entry["time"])
    mass = b.vtk_to_numpy(b.output(reader).GetBlock(0).GetCellData().GetArray("mass")) if b.output(reader).GetBlock(0).GetNumberOfCells() else []
    model = gathered([math.fsum(mass)])[0]
    if RANK == 0:
        total = math.fsum(b.column(b.output(fragments, 1), "mass"))
        b.expect(abs(total - model) <= 1e-12 * model, f"masses of fragments {total!r} of the model's {model!r} at {entry['time']}")
    found = b.output(fragments)
    own = b.output(reader).GetBlock(0)
    if found.GetNumberOfCells():
        label = b.vtk_to_numpy(found.GetCellData().GetArray("fragment"))
        b.expect(np.array_equal(label, b.vtk_to_numpy(own.GetCellData().GetArray("fragment"))), f"labels at {entry['time']}")

# Bodies by their names: those of the groups of the case.
called = [row["name"] for row in csv.DictReader(open(f"{run}/bodies.csv"))]
b.expect(called[0] == "glass" and "projectile" in called and sum(n.startswith("support (body ") for n in called) == 4, f"bodies {called}")
network, touched = simple.ContactNetwork(Input=reader), 0
for entry in index:
    network.UpdatePipeline(entry["time"])
    if RANK != 0:
        continue
    touching, walls = b.output(network, 1), b.output(network, 2)
    touched += walls.GetNumberOfRows()
    for table, number, name in ((touching, "body", "body_name"), (walls, "body", "body_name"), (walls, "other_body", "other_body_name")):
        b.expect(b.words(table, name) == [called[int(i)] for i in b.column(table, number)], f"{name} {b.words(table, name)}")
b.expect(touched > 0 or RANK != 0, "bodies touch")
if RANK == 0:
    table = b.output(fragments, 1)
    b.expect(b.words(table, "body_name") == [called[i] for i in b.column(table, "body")], f"fragments of {b.words(table, 'body_name')}")
    b.expect(len(set(b.words(table, "body_name"))) == len(called), f"fragments of {set(b.words(table, 'body_name'))}")


def best_of(squares, size, exponent):
    """Least squares once more, by a search of ever finer steps about the filter's result."""
    at, least, step = np.log([size, exponent]), squares(size, exponent), 0.1
    while step > 1e-9:
        tried = [at + step * np.array(way) for way in ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (-1, -1), (1, -1), (-1, 1))]
        values = [squares(*np.exp(other)) for other in tried]
        if min(values) < least:
            at, least = tried[int(np.argmin(values))], min(values)
        else:
            step /= 2
    return np.exp(at)


sieve = b.output(fragments, 2)
if RANK == 0 and sieve.GetNumberOfRows() > 2:
    x, p = (b.column(sieve, name) for name in ("size", "passing"))
    largest, mass = x[-1], np.diff(p, prepend=0)
    fits = {"rosin_rammler": ("size", lambda size, n: -np.expm1(-(x / size) ** n)),
            "swebrec": ("median", lambda median, n: 1 / (1 + (np.log(largest / x) / np.log(largest / median)) ** n))}
    for name, (size, curve) in fits.items():
        if reason := b.words_of_fact(sieve, f"{name}_left_out"):
            print(f"{name} is left out: {reason}")
            continue
        found = [b.fact(sieve, f"{name}_{what}") for what in (size, "exponent")]
        best = best_of(lambda *parameters: np.sum(mass * (curve(*parameters) - p) ** 2), *found)
        b.expect(np.allclose(found, best, rtol=1e-5), f"{name}: {found}, the best are {best}")
        miss = abs(curve(*found) - p).max()
        print(f"{name}: R2 {b.fact(sieve, f'{name}_r2'):.4f}, largest deviation {miss:.3f} of {len(x)} sizes")
        b.expect(np.isclose(b.fact(sieve, f"{name}_deviation"), miss, rtol=1e-9), f"deviation of {name}: {miss}")
    half = np.interp(0.5, b.column(sieve, "passing"), b.column(sieve, "size"))
    b.expect(np.isclose(b.fact(sieve, "d50"), half, rtol=1e-9), f"d50 {half}")
if RANK == 0:
    count = b.output(fragments, 1).GetNumberOfRows()
    b.expect(count == summary["fragments"], f"{count} fragments of {summary['fragments']}")
b.finish()
