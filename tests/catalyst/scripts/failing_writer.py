# script-version: 2.0
"""Its extractor cannot make its file."""
from paraview import catalyst
from paraview.simple import CreateExtractor, TrivialProducer

surface = TrivialProducer(registrationName="surface")
extract = CreateExtractor("VTP", surface, registrationName="extract")
extract.Writer.FileName = "not_a_folder/surface_{timestep:06d}.pvtp"
options = catalyst.Options()
