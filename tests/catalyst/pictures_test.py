"""pvpython pictures_test.py PIPELINES FOLDER: what the picture pipelines share."""
import math
import os
import re
import sys
import types

from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkCommonDataModel import vtkPolyData

sys.path.insert(0, sys.argv[1])
sys.modules["breccia_insitu"] = types.ModuleType("breccia_insitu")  # the adaptor brings it
import breccia_pictures  # noqa: E402


class Producer:
    """A channel with one cell array."""

    def __init__(self, values):
        self.data, array = vtkPolyData(), vtkDoubleArray()
        array.SetName("von_mises")
        for value in values:
            array.InsertNextValue(value)
        self.data.GetCellData().AddArray(array)

    def GetClientSideObject(self):
        return self

    def GetOutputDataObject(self, _):
        return self.data


def expect(true, what):
    if not true:
        sys.exit(f"FAILED: {what}")


sound = [1e6 * i for i in range(1, 101)]
quantile = breccia_pictures.quantile_of(Producer(sound), "von_mises", 0.5)
expect(50e6 <= quantile <= 50e6 * 2 ** (1 / 8), f"the median is {quantile}")
spoilt = breccia_pictures.quantile_of(Producer(sound + [math.nan, math.inf, -math.inf] * 50), "von_mises", 0.5)
expect(spoilt == quantile, f"values that are not finite count: {spoilt}")
expect(breccia_pictures.quantile_of(Producer([math.nan]), "von_mises", 0.5) == 0, "of nothing")
expect(breccia_pictures.quantile_of(Producer([]), "von_mises", 0.5) == 0, "of an empty channel")

os.makedirs(sys.argv[2], exist_ok=True)
table, pattern = os.path.join(sys.argv[2], "data.csv"), re.compile(r"view_(\d{9})(\D*([-\d.]+)\D+([-\d.]+)\D*)?\.png")
with open(table, "w", encoding="utf-8") as file:
    file.write("time,phi,theta,FILE\n1e-06,0,90,view_000000010_phi=0_theta=90.png\n0.0025,view_000000020.png\n0,other_000000030.png\n")
expect(breccia_pictures.listed_times(table, pattern) == {10: 1e-6, 20: 0.0025}, "times of a table")
expect(breccia_pictures.listed_times(table + ".none", pattern) == {}, "times of no table")
