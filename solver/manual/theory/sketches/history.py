"""History of a couple: handover between elements, first offset, field after fracture, pull after separation."""
from drawing import *

d = Drawing(800, 500)


def panel(x, y, title):
    d.text((x, y), title, bold=True)


# (1) Handover.
x, y = 20, 24
panel(x, y, "4  handover")
top = y + 50
for k in range(3):
    a = x + 100 * k
    d.area([(a, top), (a + 100, top), (a + 50, top + 85)], FILLS[BLUE] if k == 0 else FILLS[GREEN] if k == 1 else PALE, GREY, 1)
    if k < 2:
        d.area([(a + 100, top), (a + 150, top + 85), (a + 50, top + 85)], PALE, GREY, 1)
d.dot((x + 70, top + 16), RED, 4)
d.dot((x + 130, top + 16), RED, 4)
d.arrow((x + 76, top + 16), (x + 124, top + 16), RED, 1.6, dash="4 3")
d.text((x + 28, top - 10), "d_{max}, spring, offset, age", RED, 12)
d.text((x, top + 112), "A point that slides into a neighbour keeps its history\nif both elements share a mesh vertex.", size=12)
# (2) First offset.
x = 400
panel(x, y, "5  first overlap")
d.area([(x, top), (x + 110, top), (x + 110, top + 90), (x, top + 90)], FILLS[BLUE], BLUE, 1.2)
d.area([(x + 126, top), (x + 236, top), (x + 236, top + 90), (x + 126, top + 90)], FILLS[BLUE], BLUE, 1.2)
d.dot((x + 118, top + 55), GREY, 4)
d.arrow((x + 118, top + 55), (x + 92, top + 55), RED, 1.6)
d.dot((x + 89, top + 55), RED, 4)
d.arrow((x + 89, top + 50), (x + 89, top + 2), BLUE, 1.3, dash="4 3")
d.text((x + 70, top + 30), "g", BLUE)
d.text((x + 62, top + 76), "Δu", RED)
d.text((x, top + 112), "A point from the gap of a joint is deep at once: deeper\nthan it moved inwards. The excess is the offset, no force.", size=12)
# (3) Ramp of the field.
x, y = 20, 262
panel(x, y, "6  freed face")
axes = Axes(d, (x + 30, y + 20, 270, 130), (0, 70), (0, 1.25))
axes.curve([(0, 1), (10, 1), (60, 0), (68, 0)], BLUE, 2.2)
axes.tick_x(10, "released")
axes.tick_x(60, "50 steps later")
axes.tick_y(1, "D_{a}")
d.text(axes.at(36, 0.75), "depth of the corners\nof the new set", BLUE, 12)
d.text((x, y + 200), "Where the field rises, the offset follows: no force. Where it\nsinks below the offset, stored energy is dissipated.", size=12)
# (4) Pull after separation.
x = 400
panel(x, y, "7  after separation")
axes = Axes(d, (x + 30, y + 20, 290, 150), (0, 10), (-0.45, 1.25), (0, 0))
force = [(0.5, 0), (1.5, 0.55), (2.5, 0.95), (3.5, 1.05), (4.5, 0.85), (5.5, 0.45), (6.5, -0.2), (7.5, -0.1), (8.5, 0)]
axes.curve(force[:6], RED, 2)
axes.curve(force[5:], GREEN, 2)
for t, f in force:
    d.dot(axes.at(t, f), RED if f >= 0 and t < 6 else GREEN, 3.5)
d.text(axes.at(10, -0.4), "steps", anchor="end", size=12)
d.text(axes.at(0.2, 1.18), "force", size=12)
d.text(axes.at(5.9, 0.62), "at most ¼ k D:\nremoves the gain", GREEN, 12)
d.text((x, y + 200), "An overlap that ends within a step has gained energy.\nA small tensile force removes it over the next steps.", size=12)
d.save(__file__)
