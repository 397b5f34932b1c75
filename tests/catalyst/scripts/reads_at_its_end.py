# script-version: 2.0
"""Its end executes a filter on the channel, whose last data are no more."""
import breccia_insitu
from paraview import catalyst
from paraview.simple import Calculator, TrivialProducer

elements = TrivialProducer(registrationName="elements")
options = catalyst.Options()


def catalyst_execute(info):
    elements.UpdatePipeline()


def catalyst_finalize():
    doubled = Calculator(Input=elements, AttributeType="Cell Data", ResultArrayName="doubled", Function="von_mises*2")
    doubled.UpdatePipeline()
    with open(breccia_insitu.folder() + "/cells.txt", "w", encoding="utf-8") as file:
        file.write(str(doubled.GetDataInformation().GetNumberOfCells()))
