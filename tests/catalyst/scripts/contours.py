# script-version: 2.0
from paraview import catalyst
from paraview.simple import Contour, CreateExtractor, TrivialProducer

surface = TrivialProducer(registrationName="surface")
contour = Contour(registrationName="contour", Input=surface, ContourBy=["POINTS", "von_mises"], Isosurfaces=[1e6])
CreateExtractor("VTP", contour, registrationName="VTP1")
options = catalyst.Options()
