# script-version: 2.0
"""A source and an array that no run has, and an array of another channel."""
from paraview import catalyst
from paraview.simple import Calculator, Threshold, TrivialProducer

surface = TrivialProducer(registrationName="surface")
fractures = TrivialProducer(registrationName="fractrues")
stressed = Threshold(Input=surface, Scalars=["CELLS", "von_misses"])
opened = Threshold(Input=surface, Scalars=["CELLS", "opening"])
scaled = Calculator(Input=surface, AttributeType="Cell Data", ResultArrayName="von_mises_MPa", Function="von_mises/1e6")
made = Threshold(Input=scaled, Scalars=["CELLS", "von_mises_MPa"])
options = catalyst.Options()
