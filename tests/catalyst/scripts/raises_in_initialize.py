# script-version: 2.0
from paraview import catalyst
from paraview.simple import CreateExtractor, TrivialProducer

surface = TrivialProducer(registrationName="surface")
extract = CreateExtractor("VTP", surface, registrationName="extract")
options = catalyst.Options()
options.GenerateCinemaSpecification = 1


def catalyst_initialize():
    raise ValueError("cannot begin")


def catalyst_finalize():
    print("the end of what has not begun")
