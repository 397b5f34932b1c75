"""Central differences: positions at whole steps, velocities at half steps, forces in between."""
from drawing import *

d = Drawing(680, 210)
y, x0, h = 110, 70, 180
d.arrow((30, y), (650, y), INK, 1.2)
d.text((655, y + 4), "t")
for k, name in enumerate(("t_{n−1}", "t_{n}", "t_{n+1}")):
    x = x0 + 90 + k * h
    d.line((x, y - 5), (x, y + 5), INK, 1.5)
    d.text((x - 20, y + 22), name, anchor="middle")
    d.dot((x, y - 42), BLUE, 5)
    d.text((x, y - 54), ("x_{n−1}", "x_{n}", "x_{n+1}")[k], BLUE, anchor="middle")
for k, name in enumerate(("v_{n−1/2}", "v_{n+1/2}")):
    x = x0 + 90 + (k + 0.5) * h
    d.dot((x, y + 44), GREEN, 5)
    d.text((x, y + 64), name, GREEN, anchor="middle")
x = x0 + 90 + h
d.arrow((x, y - 36), (x, y + 84), RED, 1.6)
d.text((x + 8, y + 84), "f(x_{n}), v_{n−1/2}", RED, 12)
d.arrow((x0 + 90 + 0.5 * h + 8, y + 44), (x0 + 90 + 1.5 * h - 8, y + 44), GREEN, 1.6, dash="5 4")
d.arrow((x0 + 90 + h + 8, y - 42), (x0 + 90 + 2 * h - 8, y - 42), BLUE, 1.6, dash="5 4")
d.text((x0 + 90 + 1.5 * h, y - 72), "dt v_{n+1/2}", BLUE, 12, "middle")
d.text((470, 190), "kick = (dt_{before} + dt) / 2", GREEN, 12)
d.save(__file__)
