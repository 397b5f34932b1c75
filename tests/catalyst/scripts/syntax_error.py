# script-version: 2.0
from paraview import catalyst
options = catalyst.Options(
def
