"""Frames with a known answer: a wall normal to x whose right half moves away from START on, in proportion to the time, opening and sliding along y. Its
joints fail between the frames; elements of uneven ids are another rank's, and cost more by the time. In the last frame everything has turned a quarter about z and flown far apart."""
import numpy as np
from paraview import simple

import broken_box as b

SPEED, START = np.array([2.0, 3.0, 0.0]), 1e-6  # m/s, s
FAILURE = np.array([2.25e-6, 2.5e-6, 3.5e-6, 3.75e-6])  # s, of the wall's four joints
TIMES = [0.0, 1e-6, 2e-6, 3e-6, 4e-6, 9e-6]
WALL, ENERGY = 0.01, 0.25  # m; J in each joint
asked = []  # times of the frames that were read


def frame(time):
    """This rank's part."""
    rank, ranks = b.rank()
    box = b.Box((2, 2, 1))
    face = box.points[box.joint // 4][np.arange(len(box.joint))[:, None], b.FACES[box.joint % 4]].mean(axis=1)
    plane = box.joint[abs(face[:, 0] - WALL) < 1e-9]
    right = box.points.mean(axis=1)[:, 0] > WALL
    box.points = box.points + np.where(right[:, None, None], np.maximum(time - START, 0.0) * SPEED, 0)
    if time == TIMES[-1]:
        x, y, z = np.moveaxis(box.points, 2, 0)
        box.points = np.stack([-y, x, z], axis=2) + np.where(right[:, None, None], 1.0, 0)
    broken = (time > FAILURE).astype(np.int32)
    joints = box.joints(plane, np.arange(len(plane)) % ranks == rank, broken=broken, energy=np.full(len(plane), ENERGY),
                        time_of_failure=np.where(broken, FAILURE, -1.0))
    mine = np.arange(box.count) % ranks == rank
    elements = box.elements(mine)
    for name, values in (("rank", box.id % 2), ("cost", 1 + box.id % 2 * time / START)):
        array = b.numpy_to_vtk(np.ascontiguousarray(values[mine]), deep=1)
        array.SetName(name)
        elements.GetCellData().AddArray(array)
    return b.blocks(elements=elements, joints=joints)


def fill(algorithm):
    """What a source of ParaView's runs for its data."""
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as keys
    info = algorithm.GetOutputInformation(0)
    time = info.Get(keys.UPDATE_TIME_STEP()) if info.Has(keys.UPDATE_TIME_STEP()) else 0.0
    time = [t for t in TIMES if t <= time][-1]
    asked.append(time)
    algorithm.GetOutputDataObject(0).ShallowCopy(frame(time))


def announce(algorithm):
    """What a source of ParaView's runs to tell its times."""
    from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as keys
    info = algorithm.GetOutputInformation(0)
    info.Set(keys.TIME_STEPS(), TIMES, len(TIMES))
    info.Set(keys.TIME_RANGE(), [TIMES[0], TIMES[-1]], 2)
    info.Set(vtkAlgorithm.CAN_HANDLE_PIECE_REQUEST(), 1)


def source():
    made = simple.ProgrammableSource(OutputDataSetType="vtkMultiblockDataSet")
    made.ScriptRequestInformation = "import flying_wall\nflying_wall.announce(self)"
    made.Script = "import flying_wall\nflying_wall.fill(self)"
    return made
