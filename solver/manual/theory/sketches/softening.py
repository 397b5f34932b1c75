"""Normal traction over opening of the default law: rise, softening z(D), unloading to the origin, compression."""
import math

from drawing import *

A, B, C = 0.63, 1.8, 6.0


def z(damage):
    s = A + B
    k = (A + C * B) / (s * (1 - s))
    return (1 - (s - 1) / s * math.exp(damage * k)) * (A * (1 - damage) + B * (1 - damage) ** C)


onset, width = 1.0, 7.0  # d_nt and D_n, in units of d_nt: drawn with a soft joint so that the rise can be seen
d = Drawing(640, 360)
axes = Axes(d, (60, 20, 540, 300), (-1.4, 9.2), (-0.95, 1.25), (0, 0))
curve = [(onset + width * t, z(t)) for t in span(0, 1, 80)]
axes.area([(0, 0), (onset, 1), *curve], FILLS[BLUE])
unload = curve[22]
axes.curve([(-0.85, -0.85), (0, 0)], GREEN)
axes.curve([(0, 0), (onset, 1), *curve], BLUE, 2.4)
axes.curve([(0, 0), unload], RED, 2)
d.dot(axes.at(*unload), RED, 4)
d.arrow(axes.at(unload[0] * 0.75, unload[1] * 0.75 + 0.09), axes.at(unload[0] * 0.4, unload[1] * 0.4 + 0.09), RED, 1.4)
axes.tick_x(onset, "d_{nt} = f_{t}/k", 0)
axes.tick_x(onset + width, "d_{nt} + D_{n}", 0)
axes.tick_y(1, "f_{t}", 0)
d.text(axes.at(9.15, -0.11), "δ_{n}", anchor="end")
d.text(axes.at(0.12, 1.17), "σ")
d.text(axes.at(2.7, 0.80), "softening: σ = z(D) f_{t},  D = (δ_{n} − d_{nt}) / D_{n}", BLUE)
d.text(axes.at(3.45, 0.50), "unloading and reloading: σ = (1 − d) k δ_{n}", RED)
d.text(axes.at(1.05, 0.10), "area = G_{I}", BLUE, 12)
d.text(axes.at(0.25, -0.72), "compression: σ = k δ_{n}, without damage", GREEN)
d.line(axes.at(onset, 0), axes.at(onset, 1), GREY, 1, "3 3")
d.save(__file__)
