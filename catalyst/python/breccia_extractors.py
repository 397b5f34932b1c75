"""ParaView's extractors of data for channels, which are plain grids: those that write collections of grids get the collection of that one."""

GROUPS = {"VTPD": "vtkPartitionedDataSet", "VTPC": "vtkPartitionedDataSetCollection", "VTM": "vtkMultiBlockDataSet"}
REFUSED = {"VTH": "adaptively refined boxes"}  # of anything else it reads memory that it does not have


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
