"""ParaView's extractors of data for channels, which are plain grids: those that write collections of grids get the collection of that one; and
names of files that are unique, of each extractor, instant and piece."""

import os
import re

import breccia_insitu

GROUPS = {"VTPD": "vtkPartitionedDataSet", "VTPC": "vtkPartitionedDataSetCollection", "VTM": "vtkMultiBlockDataSet"}
REFUSED = {"VTH": "adaptively refined boxes"}  # of anything else it reads memory that it does not have

# Their pieces are named after what stands before the first dot of the name: surface.pvd_000120.pvtp and surface.pvd_000240.pvtp have the same ones.
IN_PIECES = {"VTI", "VTP", "VTR", "VTS", "VTU"}
TIME = re.compile(r"\{(?:[A-Z]+_)?time(:[^{}]*)?\}")  # 0.5 has a dot too

_created = {}  # by the folder of their script: [kind, extractor, name as the script has it, name as it is written]


def install():
    """Wraps ParaView's CreateExtractor, before scripts import it."""
    from paraview import simple

    simple.CreateExtractor = _grouping(simple.CreateExtractor)


def _grouping(create):
    def CreateExtractor(name, proxy=None, registrationName=None):
        from paraview import simple

        source = proxy or simple.GetActiveSource()
        if source is not None and name in {**GROUPS, **REFUSED}:
            source = _grouped(source, name)
        extractor = create(name, source, registrationName)
        # Not appended: ParaView 5.11 cannot read what is, with the libexpat of Debian 12.
        if extractor is not None and "DataMode" in extractor.Writer.ListProperties():
            extractor.Writer.DataMode = "Binary"
        if extractor is not None:
            _created.setdefault(breccia_insitu.folder(), []).append([name, extractor, None, None])
        return extractor

    return CreateExtractor


def _grouped(source, name):
    """The source itself where it makes a collection already."""
    from paraview import simple

    source.UpdatePipeline()
    if source.GetDataInformation().DataInformation.GetCompositeDataSetType() >= 0:
        return source
    if name in REFUSED:
        raise ValueError(f"the extractor {name} writes {REFUSED[name]}, which no channel is")
    active = simple.GetActiveSource()
    group = simple.GroupDatasets(Input=source)
    group.OutputType = GROUPS[name]
    simple.SetActiveSource(active)
    return group


def name_files(time):
    """Gives the files of the active script's extractors names that are theirs alone, for the instant that is about to be written. Names without
    a fault stay as they are."""
    taken = set()
    for entry in _created.get(breccia_insitu.folder(), ()):
        kind, extractor, given, written = entry
        present = extractor.Writer.FileName
        if present != written:  # the script has changed it
            given = present
        folder, name = os.path.split(given)
        if kind in IN_PIECES:
            name = _without_dots(TIME.sub(lambda field: format(time, (field[1] or ":")[1:]), name))
        if os.path.join(folder, name) in taken:  # the default of some kinds is dataset_{timestep:06d}, whatever the source
            name = f"{_registered_name(extractor)}_{name}"
        taken.add(os.path.join(folder, name))
        entry[2:] = given, os.path.join(folder, name)
        if entry[3] != present:
            extractor.Writer.FileName = entry[3]


def _without_dots(name):
    """surface.pvd_{timestep:06d}.pvtp -> surface_pvd_{timestep:06d}.pvtp."""
    stem, extension = re.fullmatch(r"(.*?)(\.p?vt[iprsu])?", name).groups("")
    return re.sub(r"[.*]+(?![^{}]*\})", "_", stem) + extension


def _registered_name(extractor):
    from paraview import servermanager

    return servermanager.ProxyManager().GetProxyName("extractors", extractor.SMProxy)
