"""pvpython compare_extracts.py RECORDS EXTRACTS PIECES: whether the extracts of the script that export_script.py has made, written on PIECES
ranks, are those of the recorded instants: a file and its pieces for each instant, with the values recorded at that instant."""
import csv
import glob
import hashlib
import os
import re
import sys

import numpy
from paraview import servermanager
from paraview.simple import OpenDataFile, ResampleToImage, UpdatePipeline
from paraview.vtk.util.numpy_support import vtk_to_numpy
from paraview.vtk.vtkIOXML import vtkXMLPImageDataReader, vtkXMLPPolyDataReader, vtkXMLPUnstructuredGridReader

INSIDE = 0.9  # share of an image's points that do not lie on the rim of a rank's elements, where either rank may sample them

records, extracts, ranks = sys.argv[1], sys.argv[2], int(sys.argv[3])


def expect(true, what):
    if not true:
        sys.exit(f"FAILED: {what}")


def listed(pattern):
    return sorted(glob.glob(os.path.join(extracts, pattern)))


def read(reader, file):
    reader.SetFileName(file)
    reader.Update()
    expect(reader.GetErrorCode() == 0, f"{file} cannot be read")
    return reader.GetOutput()


def rows(data):
    """Values of a grid's cells, sorted, so that the number of its pieces does not matter."""
    return numpy.sort(vtk_to_numpy(data.GetCellData().GetArray("von_mises")))


def recorded(channel):
    """By step: the time and the data."""
    with open(os.path.join(records, channel, channel + ".pvd"), encoding="utf-8") as file:
        entries = re.findall(r'timestep="([^"]+)".*file="([^"]+_(\d+)\.\w+)"', file.read())
    expect(entries, f"no instants of {channel}")
    reader = vtkXMLPPolyDataReader if channel == "surface" else vtkXMLPUnstructuredGridReader
    return {int(step): (float(time), read(reader(), os.path.join(records, channel, file))) for time, file, step in entries}


surface, elements = recorded("surface"), recorded("elements")
steps = sorted(surface)
expect(len(steps) >= 7 and sorted(elements) == steps, f"instants {steps}")
expect(len({rows(surface[step][1]).tobytes() for step in steps}) == len(steps), "the recorded instants differ")


def check_pieces(stem, extension, reader, instants):
    """A summary and a file a rank for each instant, all of them different, and the values of the recording."""
    files = listed(f"{stem}*.p{extension}")
    expect(len(files) == len(steps), f"{stem}: {files}")
    pieces = listed(f"{stem}*/*.{extension}")
    expect(len(pieces) == ranks * len(steps), f"pieces of {stem}: {pieces}")
    contents = {hashlib.sha256(open(piece, "rb").read()).digest() for piece in pieces}
    expect(len(contents) == len(pieces), f"{stem}: {len(contents)} contents of {len(pieces)} pieces")
    for file, step in zip(files, steps):
        data = read(reader(), file)
        if instants is not None:
            expect(numpy.array_equal(rows(data), rows(instants[step][1])), f"{file} has other values than step {step}")
        else:
            expect(same_image(data, step), f"{file} is another image than that of step {step}")


image_source = ResampleToImage(Input=OpenDataFile(f"{records}/elements/elements.pvd"), SamplingDimensions=[9, 7, 5])


def same_image(data, step):
    image_source.UseInputBounds, image_source.SamplingBounds = 0, data.GetBounds()
    UpdatePipeline(elements[step][0], image_source)
    expected = servermanager.Fetch(image_source)
    mine, other = (vtk_to_numpy(grid.GetPointData().GetArray("von_mises")) for grid in (data, expected))
    return len(mine) == len(other) and numpy.mean(numpy.isclose(mine, other, rtol=1e-4)) >= (1 if ranks == 1 else INSIDE)


def check_tables():
    """Two extractors for which ParaView proposes one name."""
    tables = {}
    for file in listed("*dataset_*.csv"):
        with open(file, encoding="utf-8") as stream:
            tables[file] = numpy.sort([float(row["von_mises"]) for row in csv.DictReader(stream)])
    expect(len(tables) == 2 * len(steps), f"tables: {list(tables)}")
    for step in steps:
        expected = [rows(instants[step][1]) for instants in (surface, elements)]
        found = [values for file, values in tables.items() if file.endswith(f"_{step:06d}.csv")]
        for values in expected:
            expect(any(len(other) == len(values) and numpy.allclose(other, values, rtol=1e-4) for other in found), f"no table of step {step}")


check_pieces("surface_pvd_", "vtp", vtkXMLPPolyDataReader, surface)
check_pieces("at_", "vtp", vtkXMLPPolyDataReader, surface)
check_pieces("elements_pvd_", "vtu", vtkXMLPUnstructuredGridReader, elements)
check_pieces("image_of_elements_", "vti", vtkXMLPImageDataReader, None)
check_tables()
pictures = listed("RenderView1_*.png")
expect(len(pictures) == len(steps), f"pictures: {pictures}")
expect(len({open(picture, "rb").read() for picture in pictures}) == len(pictures), "the pictures differ")
