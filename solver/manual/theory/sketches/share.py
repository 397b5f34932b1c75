"""Which of two surfaces presses: a ball of flat triangles on a flat plate."""
import math

from drawing import *

d = Drawing(680, 250)
for x0, title, points_of_plate in ((20, "both alike", True), (360, "the sharper one presses", False)):
    d.text((x0, 22), title, bold=True)
    d.area([(x0, 150), (x0 + 290, 150), (x0 + 290, 200), (x0, 200)], PALE, GREY)
    cx, cy, r = x0 + 140, 60, 108
    angles = [math.radians(a) for a in (-75, -48, -20, 10, 38, 66)]
    corners = [(cx + r * math.sin(a), cy + r * math.cos(a)) for a in angles]
    d.area([(corners[0][0], 40), *corners, (corners[-1][0], 40)], FILLS[BLUE], BLUE, 1.6, 0.8)
    if points_of_plate:
        a, b = corners[2], corners[3]
        for t in (0.3, 0.6):
            p = (a[0] + t * (b[0] - a[0]), 150)
            length = math.hypot(b[0] - a[0], b[1] - a[1])
            n = (-(b[1] - a[1]) / length, (b[0] - a[0]) / length)
            d.dot(p, RED, 4)
            d.arrow(p, (p[0] + 45 * n[0], p[1] + 45 * n[1]), RED, 1.8)
    for p in corners[2:4]:
        d.dot(p, ORANGE, 4)
        d.arrow(p, (p[0], p[1] - 48), ORANGE, 1.8)
d.text((20, 222), "Points of the plate push along the normal of\nthe triangle that they are in: sideways too.", size=12)
d.text((360, 222), "All forces are along the normal of the plate.", size=12)
d.save(__file__)
