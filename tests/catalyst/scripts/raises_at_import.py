# script-version: 2.0
from paraview.simple import TrivialProducer

surface = TrivialProducer(registrationName="surface")
raise ValueError("this cannot\ncontinue")
