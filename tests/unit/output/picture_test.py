"""pvpython picture_test.py BRECCIA_PICTURE RUN_FOLDER WORK_FOLDER: does meshes/breccia-picture draw the synthetic plate?

Seen from the top, the whole plate is a square of known share of the picture and without dark lines inside; cracked, it
is crossed by dark lines where the cracks are."""
import subprocess
import sys

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

render, run, work = sys.argv[1:4]
WIDTH, HEIGHT = 480, 300
DARK = 90          # of 255: cracks and outlines; every other colour of the picture is lighter
OUTLINE = 195      # also the edges of the plate, thin and half transparent
BLOCK = 0.006 / 0.05   # half width of the block that hides the plate's middle, of the plate's half width
failures = []


def picture(*options):
    file = f"{work}/picture.png"
    subprocess.run([render, run, file, "--view", "top", "--size", f"{WIDTH}x{HEIGHT}", *options], check=True)
    reader = vtkPNGReader()
    reader.SetFileName(file)
    reader.Update()
    image = reader.GetOutput()
    if image.GetDimensions() != (WIDTH, HEIGHT, 1):
        failures.append(f"picture of {image.GetDimensions()} pixels")
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(HEIGHT, WIDTH, 3).max(axis=2)


def square_of(dark):
    """Lowest and highest row and column of the plate's outline: rows and columns that are dark over most of its length."""
    rows, columns = numpy.nonzero(dark.sum(axis=1) > 0.5 * HEIGHT)[0], numpy.nonzero(dark.sum(axis=0) > 0.5 * HEIGHT)[0]
    return rows.min(), rows.max(), columns.min(), columns.max()


whole = picture("--time", "0", "--field", "body", "--hide", "1") < OUTLINE
bottom, top, left, right = square_of(whole)
if abs((top - bottom) - (right - left)) > 2:
    failures.append(f"the square plate is drawn {right - left} wide and {top - bottom} high")
inside = numpy.s_[bottom + 4 : top - 3, left + 4 : right - 3]
if whole[inside].any():
    failures.append("dark lines on a plate without cracks")

cracked = picture("--last", "--field", "body", "--hide", "1") < DARK
if not 0.01 < cracked[inside].mean() < 0.25:
    failures.append(f"{cracked[inside].mean():.1%} of the cracked plate is dark")
# Every circle around the middle beyond the block's place crosses the cracks between the sectors.
rows, columns = numpy.indices(cracked.shape)
radius = numpy.hypot(rows - (top + bottom) / 2, columns - (left + right) / 2) / ((top - bottom) / 2)
for inner in numpy.arange(BLOCK, 0.8, 0.1):
    if not cracked[(radius >= inner) & (radius < inner + 0.1)].any():
        failures.append(f"no crack between {inner:.2f} and {inner + 0.1:.2f} of the plate's half width")

refused = subprocess.run([render, work, f"{work}/none.png"], capture_output=True, text=True, check=False)
if refused.returncode != 2 or "holds no frames" not in refused.stderr:
    failures.append(f"a folder without frames: exit code {refused.returncode}, {refused.stderr}")

for text in failures:
    print("FAILED:", text)
sys.exit(1 if failures else 0)
