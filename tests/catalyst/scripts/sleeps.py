# script-version: 2.0
"""Does not come back from a library."""
import time

from paraview.simple import TrivialProducer

surface = TrivialProducer(registrationName="surface")


def catalyst_execute(info):
    time.sleep(1000)
