"""pvpython bad_data_test.py RUN SCRATCH: what is missing or broken is told by name, and nothing crashes."""
import os
import shutil
import sys

import broken_box as b
from vtkmodules.vtkCommonCore import vtkFileOutputWindow, vtkOutputWindow

simple = b.load()
run, scratch = sys.argv[1:3]
shutil.rmtree(scratch, ignore_errors=True)
os.makedirs(scratch)
log = f"{scratch}/log"
window = vtkFileOutputWindow()
window.SetFileName(log)
window.FlushOn()
vtkOutputWindow.SetInstance(window)


def told(action):
    """What is said while an action runs."""
    open(log, "a").close()
    before = os.path.getsize(log)
    try:
        action()
    except RuntimeError:
        pass
    return open(log).read()[before:]


def copy(name):
    folder = f"{scratch}/{name}"
    shutil.copytree(run, folder)
    return folder


def opened(folder):
    def action():
        reader = simple.BrecciaReader(FileName=folder)
        reader.UpdatePipelineInformation()
        reader.UpdatePipeline(reader.TimestepValues[-1] if len(reader.TimestepValues) else 0.0)
    return action


def expect_told(what, action, *words):
    text = told(action)
    for word in words:
        b.expect(word in text, f"{what}: '{word}' is not in: {text or '(nothing)'}")


os.makedirs(f"{scratch}/empty")
expect_told("an empty folder", opened(f"{scratch}/empty"), "is no Breccia run", "history.csv")
expect_told("a folder that is not there", opened(f"{scratch}/nowhere/status.jsonl"), "is no Breccia run")

# A folder that comes from somebody else: no link is followed, no pipe waited for.
folder = copy("linked")
last = sorted(n for n in os.listdir(f"{folder}/frames") if n.startswith("elements_"))[-1]
for make in (lambda at: os.symlink(f"{run}/frames/{last}", at), os.mkfifo):
    os.unlink(f"{folder}/frames/{last}")
    make(f"{folder}/frames/{last}")
    expect_told("a frame that is no regular file", opened(folder), last, "left out")
for make in (lambda at: os.symlink(f"{run}/history.csv", at), os.mkfifo):
    os.unlink(f"{folder}/history.csv")
    make(f"{folder}/history.csv")
    expect_told("a history that is no regular file", opened(folder), "history.csv")

folder = copy("cut")
last = sorted(n for n in os.listdir(f"{folder}/frames") if n.startswith("elements_"))[-1]
os.truncate(f"{folder}/frames/{last}", os.path.getsize(f"{folder}/frames/{last}") // 2)
expect_told("a frame that is cut off", opened(folder), last, "left out")
reader = simple.BrecciaReader(FileName=folder)
reader.UpdatePipeline(reader.TimestepValues[-1])
b.expect(b.output(reader).GetBlock(0).GetNumberOfCells() > 0, "the frame before one that is cut off is shown")

folder = copy("foreign")
for name in os.listdir(f"{folder}/frames"):
    if name.endswith(".vtkhdf"):
        open(f"{folder}/frames/{name}", "w").write("no frame" * 100)
expect_told("files that are no frames", opened(folder), "no frame of", "is whole", "_000000.vtkhdf")

folder = copy("damaged")  # as long as it should be, with nothing behind the first bytes
path = f"{folder}/frames/elements_000000.vtkhdf"
whole = open(path, "rb").read()
open(path, "wb").write(whole[:96] + b"\0" * (len(whole) - 96))
def first():
    reader = simple.BrecciaReader(FileName=folder)
    reader.UpdatePipeline(0.0)
expect_told("a frame whose inside is damaged", first, "elements_000000.vtkhdf", "can be read")

# Filters that read all frames: what is damaged is named, and the next look is as if nothing had been.
folder = copy("hole")
path = f"{folder}/frames/elements_000002.vtkhdf"
whole = open(path, "rb").read()
open(path, "wb").write(whole[:96] + b"\0" * (len(whole) - 96))
reader = simple.BrecciaReader(FileName=folder)
reader.UpdatePipelineInformation()
end = reader.TimestepValues[-1]
walks = {simple.RankView(Input=reader, OverTime=1): ("OverTime", 0), simple.CrackEvents(Input=reader): ("MomentAt", "Time shown")}
for walk, (name, without) in walks.items():
    expect_told(f"{walk.GetXMLName()} over a damaged frame", lambda: walk.UpdatePipeline(end), "elements_000002.vtkhdf", "can be read")
    walk.SetPropertyWithName(name, without)
    b.expect("ERR" not in told(lambda: walk.UpdatePipeline(end)), f"{walk.GetXMLName()} of a whole frame")
    b.expect(b.output(walk, 1).GetNumberOfRows() > 0, f"rows of {walk.GetXMLName()}")

folder = copy("killed")  # in the middle of a line of the history; the last frame is named by the index, and not there
with open(f"{folder}/history.csv", "r+") as history:
    text = history.read()
    history.seek(0)
    history.truncate()
    history.write(text[:-40])
os.remove(f"{folder}/frames/{last}")
os.remove(f"{folder}/summary.json")
expect_told("a run that was killed", opened(folder), last, "left out")
reader = simple.BrecciaReader(FileName=folder)
reader.UpdatePipeline(0.0)
b.expect(b.output(reader, 1).GetNumberOfRows() == text.count("\n") - 2, "the line that is not complete is left out")

os.remove(f"{folder}/frames/joints.hdf.series")
def without_joints():
    found = simple.Fragments(Input=simple.BrecciaReader(FileName=folder))
    found.UpdatePipeline(0.0)
expect_told("no joints", without_joints, "no joints", "time_of_failure")

box = b.Box((2, 1, 1))
for missing, from_part in (("neighbour", "elements"), ("mass", "elements"), ("id", "elements"), ("broken", "joints"),
                           ("time_of_failure", "joints")):
    elements, joints = box.elements(), box.joints(box.joint[:3])
    {"elements": elements, "joints": joints}[from_part].GetCellData().RemoveArray(missing)
    def action(data=b.blocks(elements=elements, joints=joints)):
        simple.Fragments(Input=b.producer(data)).UpdatePipeline()
    expect_told(f"no array {missing}", action, f"'{missing}'")

def without_cells():
    simple.Fragments(Input=b.producer(b.blocks(elements=box.elements(slice(0)), joints=box.joints([])))).UpdatePipeline()
expect_told("no elements", without_cells, "no elements")

def without_history():
    simple.EnergyBalance(Input=b.producer(b.blocks(elements=box.elements()))).UpdatePipeline()
expect_told("energies of a run's first output", without_history, "a table is needed", "second output")

for missing in ("rank", "cost"):
    elements = box.elements()
    for name in {"rank", "cost"} - {missing}:
        array = b.numpy_to_vtk(box.mass, deep=1)
        array.SetName(name)
        elements.GetCellData().AddArray(array)
    def action(data=b.blocks(elements=elements)):
        simple.RankView(Input=b.producer(data)).UpdatePipeline()
    expect_told(f"no array {missing}", action, f"'{missing}'")

def with_ids(part, ids):
    array = b.numpy_to_vtk(ids, deep=1)
    array.SetName("id")
    part.GetCellData().AddArray(array)
    return part


# Ids of a file of another kind: below 0, and as far apart as they can be.
def negative_joint(data=b.blocks(elements=box.elements(), joints=with_ids(box.joints(box.joint[:3]), b.np.array([-1, -2, -3])))):
    simple.Fragments(Input=b.producer(data)).UpdatePipeline()
expect_told("negative ids of joints", negative_joint, "'id' has the value -1")

far = b.np.arange(len(box.mass), dtype=b.np.int64)
far[0], far[-1] = b.np.iinfo(b.np.int64).min, b.np.iinfo(b.np.int64).max
def far_apart(data=b.blocks(elements=with_ids(box.elements(), far), joints=box.joints(box.joint[:3]))):
    simple.Fragments(Input=b.producer(data)).UpdatePipeline()
b.expect("ERR" not in told(far_apart), "ids that are far apart")

joints = box.joints(box.joint[:3])
joints.GetCellData().RemoveArray("energy")
def without_energy():
    simple.CrackEvents(Input=b.producer(b.blocks(elements=box.elements(), joints=joints))).UpdatePipeline()
expect_told("no energies", without_energy, "'energy'")

def without_contacts():
    reader = simple.BrecciaReader(FileName=run)
    reader.UpdatePipelineInformation()
    simple.ContactNetwork(Input=simple.Fragments(Input=reader), Joints=reader).UpdatePipeline(reader.TimestepValues[-1])
expect_told("a filter before that leaves contacts out", without_contacts, "no block 'contacts'", "output.contacts")
network = simple.ContactNetwork(Input=simple.BrecciaReader(FileName=run))
b.expect("ERR" not in told(lambda: network.UpdatePipeline(0.0)), "contacts before any")

# A number that is none spoils those of its fragment that depend on it, and nothing else.
for value in (b.np.nan, b.np.inf):
    box = b.Box((3, 1, 1))
    apart = [j for j in box.joint if j // 4 // 6 != box.neighbour[j // 4, j % 4] // 6]
    whole = simple.Fragments(Input=b.producer(b.blocks(elements=box.elements(), joints=box.joints(apart))))
    whole.UpdatePipeline()
    box.mass[7], box.velocity[13] = value, value
    spoilt = simple.Fragments(Input=b.producer(b.blocks(elements=box.elements(), joints=box.joints(apart))))
    b.expect(told(spoilt.UpdatePipeline) == "", f"messages of {value}")
    good, bad = b.output(whole, 1), b.output(spoilt, 1)
    b.expect(list(b.np.isnan(b.column(bad, "mass"))) == [False, True, False], f"masses {b.column(bad, 'mass')}")
    b.expect(list(b.np.isnan(b.column(bad, "speed"))) == [False, True, True], f"speeds {b.column(bad, 'speed')}")
    for name in ("mass", "centroid", "speed", "spin", "semi_axes", "volume"):
        b.expect(b.np.array_equal(b.column(bad, name)[0], b.column(good, name)[0]), f"{name} of a fragment without {value}")
    passing = b.column(b.output(spoilt, 2), "passing")  # of the two others
    b.expect(len(passing) > 0 and passing[-1] == 1.0, f"the sieve curve is of those with a mass: {passing}")

def sphere():
    simple.Fragments(Input=simple.Sphere()).UpdatePipeline()
expect_told("a sphere", sphere, "no elements", "no cell array")
b.finish()
