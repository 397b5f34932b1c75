"""Onset of damage in the plane of normal and shear traction, and the curve along one ray of opening."""
import math

from drawing import *

d = Drawing(640, 320)
axes = Axes(d, (40, 20, 340, 265), (-2.4, 1.5), (0, 3.1), (0, 0))
f_t, c, mu = 1.0, 1.5, 0.6
ellipse = [(f_t * math.cos(t), c * math.sin(t)) for t in span(0, math.pi / 2, 40)]
line = [(0, c), (-2.2, c + 2.2 * mu)]
axes.area([(0, 0), *ellipse, *line, (-2.2, 0)], FILLS[BLUE], 0.8)
axes.curve(ellipse, BLUE, 2.4)
axes.curve(line, GREEN, 2.4)
axes.curve([(0, 0), (-2.2, 2.2 * mu)], ORANGE, 2, "6 4")
ray = 0.9
axes.curve([(0, 0), (1.35 * math.cos(ray), 1.35 * math.sin(ray))], RED, 1.5, "4 3")
r = 1 / math.sqrt(math.cos(ray) ** 2 / f_t**2 + math.sin(ray) ** 2 / c**2)
d.dot(axes.at(r * math.cos(ray), r * math.sin(ray)), RED, 4)
axes.tick_x(f_t, "f_{t}", 0)
axes.tick_y(c, "c", 0)
d.text(axes.at(1.5, -0.19), "σ", anchor="end")
d.text(axes.at(0.08, 2.97), "|τ|")
d.text(axes.at(-2.3, 2.95), "|τ| = c + μ p", GREEN)
d.text(axes.at(-2.3, 0.48), "|τ| = μ p:\nbroken, closed", ORANGE, 12)
d.text(axes.at(-1.45, 1.42), "elastic", BLUE)
d.text(axes.at(0.62, 1.5), "r = 1", BLUE)
x = 415
for i, (text, color) in enumerate((
        ("open joint:", INK), ("r^{2} = x_{n}^{2} + x_{s}^{2}", BLUE), ("x_{n} = ⟨δ_{n}⟩ / d_{nt}", BLUE),
        ("x_{s} = |δ_{s}| / d_{st}", BLUE), ("closed joint, p = −k δ_{n}:", INK), ("d_{st} = (c + μ p) / k", GREEN),
        ("along a ray of opening (red):", INK), ("D = (r − 1) Q,  d = 1 − z(D) / R", RED),
        ("Q weighs d_{nt}/D_{n} and d_{st}/D_{s}", RED), ("with x_{n}^{2}/r^{2} and x_{s}^{2}/r^{2}", RED))):
    d.text((x, 45 + 25 * i), text, color, 12)
d.save(__file__)
