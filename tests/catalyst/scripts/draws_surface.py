# script-version: 2.0
from paraview import catalyst
from paraview.simple import ColorBy, CreateExtractor, CreateRenderView, Show, TrivialProducer

surface = TrivialProducer(registrationName="surface")
view = CreateRenderView()
view.ViewSize = [320, 200]
display = Show(surface, view)
ColorBy(display, ("CELLS", "von_mises"))
picture = CreateExtractor("PNG", view, registrationName="picture")
picture.Writer.FileName = "surface_{timestep:06d}{camera}.png"
picture.Writer.ImageResolution = [320, 200]
options = catalyst.Options()
