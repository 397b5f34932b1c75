"""pvpython export_script.py RECORDS SCRIPT: opens recordings as a user of ParaView does, adds extractors, and lets ParaView's own code for
*File > Save Catalyst State* write the script. Names of files are those that ParaView proposes, but for VTP2's, which has the time."""
import sys

from paraview import catalyst
from paraview.detail import catalyst_export
from paraview.simple import ColorBy, CreateExtractor, CreateView, GetColorTransferFunction, GetExtractors, OpenDataFile, ResampleToImage, Show

records, script = sys.argv[1:3]
surface = OpenDataFile(f"{records}/surface/surface.pvd", registrationName="surface.pvd")
elements = OpenDataFile(f"{records}/elements/elements.pvd", registrationName="elements.pvd")
image = ResampleToImage(registrationName="image.of.elements", Input=elements, SamplingDimensions=[9, 7, 5])
view = CreateView("RenderView", ViewSize=[200, 150])
ColorBy(Show(surface, view), ("CELLS", "von_mises"))
view.CameraPosition, view.CameraFocalPoint = [0.02, 0.01, 0.09], [0.02, 0.01, 0]
GetColorTransferFunction("von_mises").RescaleTransferFunction(0, 2e4)
for kind, source in (("VTP", surface), ("VTU", elements), ("VTI", image), ("CSV", surface), ("PNG", view)):
    CreateExtractor(kind, source, registrationName=f"{kind}1")
CreateExtractor("VTP", surface, registrationName="VTP2").Writer.FileName = "at_{time:.5f}.pvtp"
CreateExtractor("CSV", elements, registrationName="CSV2")
for extractor in GetExtractors():
    if "FieldAssociation" in extractor.Writer.ListProperties():
        extractor.Writer.FieldAssociation = "Cell Data"
catalyst_export.save_catalyst_state(script, catalyst.Options())
