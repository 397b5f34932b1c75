# script-version: 2.0
from paraview import catalyst
from paraview.simple import CreateExtractor, TrivialProducer

elements = TrivialProducer(registrationName="elements")
CreateExtractor("VTH", elements, registrationName="VTH1")
options = catalyst.Options()
