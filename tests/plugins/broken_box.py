"""Synthetic data as a run's channels give them, with known answers; and how the tests load the plugin and say what failed."""
import os
import sys

import numpy as np
from paraview.simple import LoadPlugin, TrivialProducer
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_ID_TYPE, vtkPoints
from vtkmodules.vtkCommonDataModel import (VTK_TETRA, VTK_TRIANGLE, VTK_VERTEX, vtkCellArray, vtkMultiBlockDataSet,
                                           vtkUnstructuredGrid)
from vtkmodules.vtkParallelCore import vtkMultiProcessController

FACES = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])  # opposite to each corner, outward
_failures = []


def load():
    """The filters, into the modules of paraview.simple."""
    import paraview.simple as simple
    names = {}
    LoadPlugin(os.environ["BRECCIA_PARAVIEW_PLUGIN"], remote=False, ns=names)
    for name, value in names.items():
        setattr(simple, name, value)
    return simple


def rank():
    controller = vtkMultiProcessController.GetGlobalController()
    return controller.GetLocalProcessId(), controller.GetNumberOfProcesses()


def expect(condition, text):
    if not condition:
        _failures.append(text)


def finish():
    for text in _failures:
        print("FAILED:", text)
    sys.stdout.flush()
    if _failures:
        os._exit(1)


def grid(points, kind, arrays):
    """Cells with points of their own. points: (cells, corners, 3)"""
    out = vtkUnstructuredGrid()
    cells, corners = points.shape[:2]
    place = vtkPoints()
    place.SetDataTypeToDouble()
    place.SetData(numpy_to_vtk(np.ascontiguousarray(points.reshape(-1, 3), dtype=float), deep=1))
    out.SetPoints(place)
    connections = vtkCellArray()
    connections.SetData(numpy_to_vtk(np.arange(0, corners * cells + 1, corners), 1, VTK_ID_TYPE),
                        numpy_to_vtk(np.arange(corners * cells), 1, VTK_ID_TYPE))
    out.SetCells(kind, connections)
    for name, values in arrays.items():
        values = np.ascontiguousarray(values)
        array = numpy_to_vtk(values, deep=1)
        array.SetName(name)
        out.GetCellData().AddArray(array)
    return out


def blocks(**parts):
    out = vtkMultiBlockDataSet()
    for i, (name, part) in enumerate(parts.items()):
        out.SetBlock(i, part)
        out.GetMetaData(i).Set(out.NAME(), name)
    return out


def producer(data):
    source = TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    return source


def output(proxy, port=0):
    """What a filter has made on this rank."""
    return proxy.GetClientSideObject().GetOutputDataObject(port)


def column(table, name):
    return vtk_to_numpy(table.GetRowData().GetArray(name)) if table.GetNumberOfRows() else np.zeros(0)


def words(table, name):
    """A column of text."""
    array = table.GetRowData().GetAbstractArray(name)
    return [array.GetValue(i) for i in range(array.GetNumberOfValues())]


def fact(data, name):
    return data.GetFieldData().GetArray(name).GetValue(0)


def words_of_fact(data, name):
    """A text in the field data; "" when there is none."""
    array = data.GetFieldData().GetAbstractArray(name)
    return "" if array is None else array.GetValue(0)


class Box:
    """A box of cubes cut into tetrahedra (six a cube), with the joints between them."""

    def __init__(self, cells, size=0.01, density=2000.0):
        nx, ny, nz = cells
        corner = np.array([(i, j, k) for k in (0, 1) for j in (0, 1) for i in (0, 1)])
        paths = [(0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7), (0, 4, 5, 7), (0, 5, 1, 7)]
        base = np.array([(i, j, k) for k in range(nz) for j in range(ny) for i in range(nx)])
        nodes = (base[:, None, None, :] + corner[np.array(paths)][None]).reshape(-1, 4, 3)
        self.points = nodes * size
        sign = np.einsum("ij,ij->i", np.cross(self.points[:, 1] - self.points[:, 0], self.points[:, 2] - self.points[:, 0]),
                         self.points[:, 3] - self.points[:, 0])
        flip = sign < 0
        nodes[flip] = nodes[flip][:, [0, 2, 1, 3]]
        self.points = nodes * size
        self.count = len(nodes)
        self.id = np.arange(self.count, dtype=np.int64)
        key = (nodes[..., 0] * (ny + 1) + nodes[..., 1]) * (nz + 1) + nodes[..., 2]
        faces = np.sort(key[:, FACES], axis=2).reshape(-1, 3)
        order = np.lexsort(faces.T)
        same = np.all(faces[order][1:] == faces[order][:-1], axis=1)
        first, second = order[:-1][same], order[1:][same]
        self.neighbour = np.full(4 * self.count, -1, dtype=np.int64)
        self.neighbour[first], self.neighbour[second] = second // 4, first // 4
        self.joint = np.sort(np.minimum(first, second))  # 4 element + face of the element of lower id
        self.neighbour = self.neighbour.reshape(-1, 4)
        self.mass = density * abs(sign) / 6 * size**3 / size**3
        self.velocity = np.zeros((self.count, 3))

    def elements(self, part=slice(None)):
        return grid(self.points[part], VTK_TETRA, {"id": self.id[part], "neighbour": self.neighbour[part],
                                                   "mass": self.mass[part], "velocity": self.velocity[part]})

    def joints(self, chosen, part=slice(None), **arrays):
        """Triangles of the chosen joints; those whose `broken` is not given are."""
        chosen = np.asarray(chosen, dtype=np.int64)
        corners = self.points[chosen // 4][np.arange(len(chosen))[:, None], FACES[chosen % 4]] if len(chosen) else np.zeros((0, 3, 3))
        ones = np.ones(len(chosen))
        values = {"id": chosen, "broken": ones.astype(np.int32), "mode": ones.astype(np.int32), "time_of_failure": 0 * ones,
                  "opening": 0 * ones, "slip": 0 * ones, "energy": 0 * ones}
        values.update(arrays)
        return grid(corners[part], VTK_TRIANGLE, {name: np.asarray(v)[part] for name, v in values.items()})
