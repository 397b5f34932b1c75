"""pvpython blank_rim.py FOLDER: whether the left and right rims of the pictures of a folder are blank, where neither model nor captions are."""
import glob
import sys

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

RIM = 4  # pixels

for file in sorted(glob.glob(f"{sys.argv[1]}/*.png")):
    reader = vtkPNGReader()
    reader.SetFileName(file)
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)
    if pixels[:, :RIM, :3].min() < 250 or pixels[:, -RIM:, :3].min() < 250:
        sys.exit(f"FAILED: a line leaves {file}")
