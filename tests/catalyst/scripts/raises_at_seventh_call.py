# script-version: 2.0
from paraview import catalyst
from paraview.simple import TrivialProducer

surface = TrivialProducer(registrationName="surface")
options = catalyst.Options()
calls = 0


def catalyst_execute(info):
    global calls
    calls += 1
    if calls == 7:
        raise KeyError("seven")
