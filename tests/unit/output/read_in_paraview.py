"""pvpython read_in_paraview.py RUN_FOLDER CUBES FRAMES: what make_synthetic_run wrote, seen through ParaView.

The expected numbers are those of the plate and block themselves, not read from the files."""
import sys

import numpy
from paraview import servermanager
from paraview.simple import OpenDataFile
from vtkmodules.util.numpy_support import vtk_to_numpy

END = 100e-6                                # s
VOLUME = 0.1 * 0.1 * 0.005 + 0.012**3       # m3, plate and block
FALL = 0.003                                # m, of the block
TIME_TOLERANCE = 1e-15                      # relative: times go through 17 decimal digits
VOLUME_TOLERANCE = 1e-12                    # relative: points are kept in double precision
FIELD_TOLERANCE = 1e-6                      # relative: fields are kept in single precision
ARRAYS = {
    "elements": {"id": 1, "body": 1, "material": 1, "rank": 1, "fragment": 1, "stress": 6, "von_mises": 1, "cost": 1,
                 "principal": 3, "velocity": 3, "displacement": 3, "mass": 1, "neighbour": 4},
    "joints": {"id": 1, "damage": 1, "mode": 1, "opening": 1, "slip": 1, "broken": 1, "time_of_failure": 1, "state": 1,
               "energy": 1},
    "contacts": {"id": 1, "point": 1, "force": 3, "normal_force": 3, "tangential_force": 3, "slip_velocity": 3, "body": 1,
                 "other_body": 1, "other_element": 1},
}
failures = []


def expect(condition, text):
    if not condition:
        failures.append(text)


def opened(folder, part, frames):
    """The part's reader, opened as a user does, with its times checked."""
    reader = OpenDataFile(f"{folder}/frames/{part}.hdf.series")
    times = numpy.array(reader.TimestepValues)
    expected = END * numpy.arange(frames) / (frames - 1)
    expect(times.shape == expected.shape and numpy.all(abs(times - expected) <= TIME_TOLERANCE * END),
           f"{part}: times {times}, expected {expected}")
    return reader


def grid_at(reader, time):
    reader.UpdatePipeline(time)
    return servermanager.Fetch(reader)


def check_arrays(reader, part):
    arrays = {array.Name: array.GetNumberOfComponents() for array in reader.CellData}
    expect(arrays == ARRAYS[part], f"{part}: arrays {arrays}")


def check_elements(folder, cubes, frames):
    reader = opened(folder, "elements", frames)
    for time in reader.TimestepValues:
        grid = grid_at(reader, time)
        expect(grid.GetNumberOfCells() == 24 * (cubes**2 + 8), f"{grid.GetNumberOfCells()} elements at {time}")
        corners = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
        x = vtk_to_numpy(grid.GetPoints().GetData())[corners].reshape(-1, 4, 3)
        normal = numpy.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0])
        volumes = numpy.einsum("ij,ij->i", normal, x[:, 3] - x[:, 0]) / 6
        expect(volumes.min() > 0 and abs(volumes.sum() - VOLUME) < VOLUME_TOLERANCE * VOLUME,
               f"volume {volumes.sum()} at {time}")
        moved = vtk_to_numpy(grid.GetCellData().GetArray("displacement"))[-1]
        expected = FALL * (1 - time / END)
        expect(abs(moved - [0, expected, 0]).max() <= FIELD_TOLERANCE * FALL, f"block moved by {moved}, not {expected}")
    check_arrays(reader, "elements")
    stress = reader.CellData["stress"]
    names = [stress.GetComponentName(i) for i in range(stress.GetNumberOfComponents())]
    expect(names == ["XX", "YY", "ZZ", "XY", "YZ", "XZ"], f"stress components {names}")


def check_changing_part(folder, part, frames):
    reader = opened(folder, part, frames)
    expect(grid_at(reader, 0.0).GetNumberOfCells() == 0, f"{part} before anything happens")
    expect(grid_at(reader, END).GetNumberOfCells() > 0, f"no {part} at the end")
    check_arrays(reader, part)


run, cubes, frames = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
check_elements(run, cubes, frames)
check_changing_part(run, "joints", frames)
check_changing_part(run, "contacts", frames)
for text in failures:
    print("FAILED:", text)
sys.exit(1 if failures else 0)
