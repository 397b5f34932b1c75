# script-version: 2.0
from paraview.simple import TrivialProducer

surface = TrivialProducer(registrationName="surface")
options = None


def catalyst_execute(info):
    surface.UpdatePipeline()
