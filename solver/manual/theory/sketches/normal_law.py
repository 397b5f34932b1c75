"""Normal contact law: loading up to a plateau, unloading along a power, energy dissipated."""
from drawing import *

b, d_max, plateau = 2, 1.6, 1.0
d = Drawing(640, 325)
axes = Axes(d, (70, 20, 500, 255), (0, 2.1), (0, 1.35))
loading = [(0, 0), (1, 1), (d_max, plateau)]
unloading = [(x, plateau * (x / d_max) ** b) for x in span(0, d_max, 50)]
axes.area([*loading, *reversed(unloading)], FILLS[RED])
axes.area([*unloading, (d_max, 0)], FILLS[BLUE])
axes.curve([*loading, (2.0, plateau)], INK, 1.2, "5 4")
axes.curve(loading, RED, 2.4)
axes.curve(unloading, BLUE, 2.4)
d.dot(axes.at(d_max, plateau), INK, 4)
axes.tick_y(plateau, "σ_{T}")
axes.tick_x(1, "σ_{T}/σ_{p}")
axes.tick_x(d_max, "d_{max}")
d.text(axes.at(2.1, -0.19), "d = (g − offset)/H", anchor="end", size=12)
d.text(axes.at(0.04, 1.27), "σ")
d.text(axes.at(0.2, 0.55), "σ_{p} d", RED, anchor="end")
d.text(axes.at(0.75, 0.66), "dissipated", RED)
d.text(axes.at(1.12, 0.2), "returned", BLUE)
d.text(axes.at(1.72, 0.62), "σ_{max} (d/d_{max})^{b}\nunloading and\nreloading", BLUE, 12)
d.arrow(axes.at(0.44, 0.56), axes.at(0.64, 0.76), RED, 1.4)
d.arrow(axes.at(1.46, 0.74), axes.at(1.3, 0.57), BLUE, 1.4)
d.save(__file__)
