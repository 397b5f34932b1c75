# script-version: 2.0
# Like a state that ParaView exports: sources named after the files that were open, extractors, a folder of its own.
from paraview import catalyst
from paraview.simple import CreateExtractor, Threshold, XMLPartitionedPolydataReader

surfacepvd = XMLPartitionedPolydataReader(registrationName="surface.pvd", FileName=["/home/nobody/surface.pvtp"])
threshold1 = Threshold(registrationName="Threshold1", Input=surfacepvd)
threshold1.Scalars = ["CELLS", "body"]
threshold1.LowerThreshold = 0
threshold1.UpperThreshold = 500
vTU1 = CreateExtractor("VTU", threshold1, registrationName="VTU1")
vTU1.Trigger = "TimeStep"
vTU1.Writer.FileName = "Threshold1_{timestep:06d}.pvtu"
options = catalyst.Options()
options.GlobalTrigger = "TimeStep"
options.CatalystLiveTrigger = "TimeStep"
options.ExtractsOutputDirectory = "datasets"
