# script-version: 2.0
from paraview import catalyst
from paraview.simple import TrivialProducer

elements = TrivialProducer(registrationName="elements")
options = catalyst.Options()


def catalyst_execute(info):
    if info.timestep >= 2:
        raise ValueError("enough")
