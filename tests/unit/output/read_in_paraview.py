"""pvpython read_in_paraview.py RUN_FOLDER CUBES FRAMES: what make_synthetic_run wrote, seen through ParaView.

The expected numbers are those of the plate and block themselves, not read from the files."""
import sys

import numpy
from paraview import servermanager
from paraview.simple import OpenDataFile
from vtkmodules.util.numpy_support import vtk_to_numpy

folder, cubes, frames = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
END = 100e-6                           # s
VOLUME = 0.1 * 0.1 * 0.005 + 0.012**3  # m3, plate and block
TIME_TOLERANCE = 1e-15                 # of the end: a time is a sum of a few roundings
VOLUME_TOLERANCE = 1e-11               # relative: points are kept in double precision
FIELD_TOLERANCE = 1e-6                 # relative: fields are kept in single precision
failures = []


def expect(condition, text):
    if not condition:
        failures.append(text)


def opened(part):
    reader = OpenDataFile(f"{folder}/frames/{part}.hdf.series")
    times = numpy.array(reader.TimestepValues)
    expected = END * numpy.arange(frames) / (frames - 1)
    expect(times.shape == expected.shape and numpy.all(abs(times - expected) <= TIME_TOLERANCE * END),
           f"{part}: times {times}, expected {expected}")
    return reader


def grid_at(reader, time):
    reader.UpdatePipeline(time)
    return servermanager.Fetch(reader)


def volumes_of(grid):
    x = vtk_to_numpy(grid.GetPoints().GetData())[vtk_to_numpy(grid.GetCells().GetConnectivityArray())].reshape(-1, 4, 3)
    return numpy.einsum("ij,ij->i", numpy.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]), x[:, 3] - x[:, 0]) / 6


elements = opened("elements")
for time in elements.TimestepValues:
    grid = grid_at(elements, time)
    expect(grid.GetNumberOfCells() == 24 * (cubes**2 + 8), f"{grid.GetNumberOfCells()} elements at {time}")
    volumes = volumes_of(grid)
    expect(volumes.min() > 0 and abs(volumes.sum() - VOLUME) < VOLUME_TOLERANCE * VOLUME, f"volume {volumes.sum()} at {time}")
    fall = 0.003 * (1 - time / END)
    moved = vtk_to_numpy(grid.GetCellData().GetArray("displacement"))[-1]
    expect(abs(moved - [0, fall, 0]).max() <= FIELD_TOLERANCE * 0.003, f"block moved by {moved}, expected {fall} along y")

arrays = {array.Name: array for array in elements.CellData}
components = {name: array.GetNumberOfComponents() for name, array in arrays.items()}
expected_components = {"id": 1, "body": 1, "material": 1, "rank": 1, "fragment": 1, "stress": 6, "von_mises": 1, "principal": 3,
                       "velocity": 3, "displacement": 3}
expect(components == expected_components, f"arrays {components}")
names = [arrays["stress"].GetComponentName(i) for i in range(6)]
expect(names == ["XX", "YY", "ZZ", "XY", "YZ", "XZ"], f"stress components {names}")

for part in ("joints", "contacts"):
    reader = opened(part)
    expect(grid_at(reader, 0.0).GetNumberOfCells() == 0, f"{part} before anything happens")
    expect(grid_at(reader, END).GetNumberOfCells() > 0, f"no {part} at the end")

for text in failures:
    print("FAILED:", text)
sys.exit(1 if failures else 0)
