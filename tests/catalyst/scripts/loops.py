# script-version: 2.0
"""Never ends."""
from paraview.simple import TrivialProducer

surface = TrivialProducer(registrationName="surface")


def catalyst_execute(info):
    while True:
        pass
