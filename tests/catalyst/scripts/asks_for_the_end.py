# script-version: 2.0
"""Asks the run to stop at its third call."""
import breccia_insitu
from paraview import catalyst
from paraview.simple import TrivialProducer

surface = TrivialProducer(registrationName="surface")
options = catalyst.Options()
calls = 0


def catalyst_execute(info):
    global calls
    calls += 1
    if calls == 3:
        breccia_insitu.request(info, stop=1)
