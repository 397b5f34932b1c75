# script-version: 2.0
from paraview import catalyst
from paraview.simple import TrivialProducer

surface = TrivialProducer(registrationName="surface")
options = catalyst.Options()


def catalyst_initialize(info):
    pass
