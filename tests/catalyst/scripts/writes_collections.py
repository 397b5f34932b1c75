# script-version: 2.0
"""All extractors that write collections of grids, and those of one grid, on channels and on what a filter makes of one."""
from paraview import catalyst
from paraview.simple import CreateExtractor, GroupDatasets, Threshold, TrivialProducer

elements = TrivialProducer(registrationName="elements")
surface = TrivialProducer(registrationName="surface")
part = Threshold(registrationName="part", Input=elements, Scalars=["CELLS", "id"], LowerThreshold=0, UpperThreshold=99)
group = GroupDatasets(registrationName="group", Input=surface, OutputType="vtkPartitionedDataSetCollection")


def extract(kind, source, file):
    CreateExtractor(kind, source, registrationName=f"{kind} of {file}").Writer.FileName = file


extract("VTPD", elements, "elements_{timestep:06d}.vtpd")
extract("VTPD", part, "part_{timestep:06d}.vtpd")
extract("VTPC", surface, "surface_{timestep:06d}.vtpc")
extract("VTPC", group, "group_{timestep:06d}.vtpc")
extract("VTM", elements, "elements_{timestep:06d}.vtm")
extract("VTU", elements, "elements_{timestep:06d}.pvtu")
extract("VTP", surface, "surface_{timestep:06d}.pvtp")
extract("CSV", surface, "surface_{timestep:06d}.csv")
extract("PLY", surface, "surface_{timestep:06d}.ply")
extract("CGNS", elements, "elements_{timestep:06d}.cgns")
options = catalyst.Options()
