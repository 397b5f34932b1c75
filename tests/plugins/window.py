"""window.py FRAMEBUFFER PICTURE: what stands on the screen of a running Xvfb -fbdir, as a PNG; for pvpython."""
import struct
import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter

content = open(sys.argv[1], "rb").read()
header = struct.unpack(">25I", content[:100])  # XWDFileHeader of X11
header_size, width, height, colours, row = header[0], header[4], header[5], header[19], header[12]
start = header_size + 12 * colours
pixels = np.frombuffer(content, np.uint8, row * height, start).reshape(height, row // 4, 4)[::-1, :width, 2::-1]
image = vtkImageData()
image.SetDimensions(width, height, 1)
image.GetPointData().SetScalars(numpy_to_vtk(np.ascontiguousarray(pixels).reshape(-1, 3), deep=1))
writer = vtkPNGWriter()
writer.SetInputData(image)
writer.SetFileName(sys.argv[2])
writer.SetCompressionLevel(9)
writer.Write()
