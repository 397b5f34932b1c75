"""Yield surface of the Drucker-Prager law in the plane of mean stress and shear: cone, cut-off, cap, returns."""
from drawing import *

d = Drawing(640, 310)
axes = Axes(d, (40, 25, 430, 235), (-3.3, 1.1), (0, 2.6), (0, 0))
eta, xi_c, cut, cap = 0.55, 0.75, 0.7, 2.6
top = xi_c + eta * cap
surface = [(-cap, 0), (-cap, top), (cut, xi_c - eta * cut), (cut, 0)]
axes.area(surface, FILLS[BLUE])
axes.curve(surface, BLUE, 2.4)
axes.curve([(-cap, top + 0.0), (-3.2, xi_c + eta * 3.2)], BLUE, 1, "4 3")
axes.curve([(cut, xi_c - eta * cut), (xi_c / eta, 0)][:1] + [(1.05, xi_c - eta * 1.05)], BLUE, 1, "4 3")
for trial, end in (((-1.0, 2.2), (-1.14, 1.377)), ((-3.1, 0.8), (-cap, 0.8)), ((1.0, 0.2), (cut, 0.2)), ((-3.15, 2.45), (-cap, top))):
    d.arrow(axes.at(*trial), axes.at(*end), RED, 1.5)
    d.dot(axes.at(*trial), RED, 3.5)
d.text(axes.at(1.1, -0.16), "m", anchor="end")
d.text(axes.at(0.08, 2.5), "s = √J_{2}")
d.text(axes.at(-2.45, 1.3), "cone: s + η m = ξ c", BLUE, 12)
d.text(axes.at(-2.5, 0.35), "cap: m = −p_{c}", BLUE, 12)
axes.tick_x(cut, "T", 0)
axes.tick_x(-cap, "−p_{c}", 0)
x = 485
for i, (text, color) in enumerate((("red: trial stress and", RED), ("its return", RED), ("flow on the cone:", INK), ("deviator, and volume", INK),
                                   ("by η_{g} ≤ η", INK), ("cap: volume lost", INK), ("cut-off: volume gained", INK), ("corners: both flow", INK))):
    d.text((x, 60 + 22 * i), text, color, 12)
d.save(__file__)
