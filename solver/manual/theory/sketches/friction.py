"""Friction spring and slider, its force over the motion, and the delay of the normal force."""
import math

from drawing import *

d = Drawing(700, 300)
# Spring and slider.
y = 95
d.text((20, 24), "spring k_{t} and slider μ f", bold=True)
d.line((30, y - 30), (30, y + 30), INK, 2)
for i in range(5):
    d.line((30, y - 30 + 12 * i + 8), (20, y - 30 + 12 * i + 16), GREY, 1)
zigzag = [(30, y), (45, y)] + [(50 + 8 * i, y + (-10 if i % 2 == 0 else 10)) for i in range(7)] + [(106, y), (122, y)]
d.path(zigzag, BLUE, 2)
d.box(122, y - 18, 52, 36, FILLS[ORANGE], ORANGE)
d.line((116, y + 20), (180, y + 20), INK, 2)
d.arrow((148, y - 60), (148, y - 20), RED, 2)
d.text((154, y - 44), "f (delayed f_{n})", RED, 12)
d.arrow((174, y), (215, y), INK, 1.8)
d.text((184, y + 18), "v_{t} dt", size=12)
d.text((60, y + 32), "ξ", BLUE, 14)
d.text((20, 170), "ξ ← ξ + (I − n n^{T}) v dt", BLUE, 12)
d.text((20, 188), "f_{t} = −k_{t} ξ", BLUE, 12)
d.text((20, 206), "|f_{t}| > μ f: shorten ξ, the rest slips", ORANGE, 12)
d.text((20, 232), "ξ turns with n and with the mean\nrotation of the two elements.", size=12)
# Force over motion with a reversal.
axes = Axes(d, (275, 45, 175, 190), (0, 3), (-1.35, 1.35), (0, 0))
path = [(0, 0), (1, 1), (2.2, 1), (0.2, -1)]
axes.area([(1, 1), (2.2, 1), (1.2, 0), (0, 0)], FILLS[ORANGE])
axes.curve(path, BLUE, 2.2)
axes.tick_y(1, "μ f", 0)
axes.tick_y(-1, "−μ f", 0)
d.text(axes.at(0.62, 0.42), "slip work", ORANGE, 12)
d.text(axes.at(3, -0.2), "motion", anchor="end", size=12)
d.text(axes.at(0.1, 1.3), "−f_{t}", size=12)
d.text((275, 274), "sticks along k_{t}, slides at μ f,\nsticks when the motion reverses", size=12)
# Delay: a step of the normal force.
axes = Axes(d, (500, 45, 175, 190), (0, 2.4), (0, 1.3))
t_delay, dt = 1.0, 0.004
h = f = 0.0
curve, half = [(0, 0)], []
for i in range(1, 600):
    t = i * dt
    n = 1.0 if t > 0.2 else 0.0
    h += (n - h) * dt / (t_delay / 2)
    f += (h - f) * dt / (t_delay / 2)
    if i % 12 == 0:
        curve.append((t, f))
        half.append((t, h))
axes.curve([(0, 0), (0.2, 0), (0.2, 1), (2.3, 1)], INK, 1.5)
axes.curve(half, ORANGE, 1.5, "5 4")
axes.curve(curve, RED, 2.2)
d.text(axes.at(0.3, 1.08), "f_{n}")
d.text(axes.at(0.62, 0.42), "f", RED, 14)
d.text(axes.at(0.35, 0.62), "h", ORANGE, 14)
d.text(axes.at(2.35, -0.11), "time", anchor="end", size=12)
d.text((500, 274), "two stages of t/2 each; t grows\nwith the age of the overlap", size=12)
d.save(__file__)
