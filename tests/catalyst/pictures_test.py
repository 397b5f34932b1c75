"""pvpython pictures_test.py PIPELINES FOLDER: what the picture pipelines share."""
import math
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
