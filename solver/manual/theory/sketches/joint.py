"""Two tetrahedra and the joint between them: corners, mid-surface, opening."""
from drawing import *

d = Drawing(620, 330)
# Side a (lower) and side b (upper): faces with corners 0, 1, 2; apexes below and above.
a = [(150, 190), (330, 225), (395, 165)]
b = [(138, 140), (325, 172), (402, 118)]
below, above = (285, 315), (262, 25)
for i, j in ((0, 1), (1, 2)):
    d.area([a[i], a[j], below], FILLS[BLUE], opacity=0.9)
    d.area([b[i], b[j], above], FILLS[GREEN], opacity=0.9)
for i in range(3):
    d.line(a[i], below, BLUE)
    d.line(b[i], above, GREEN)
for face, color in ((a, BLUE), (b, GREEN)):
    d.path([face[0], face[1], face[2]], color, 2)
    d.line(face[2], face[0], color, 1.5, "5 4")
middle = [((p[0] + q[0]) / 2, (p[1] + q[1]) / 2) for p, q in zip(a, b)]
d.area(middle, FILLS[ORANGE], ORANGE, 1.2, 0.7)
for i in range(3):
    d.arrow(a[i], b[i], RED, 1.8)
centre = (sum(p[0] for p in middle) / 3, sum(p[1] for p in middle) / 3)
d.arrow(centre, (centre[0] - 8, centre[1] - 62), ORANGE, 2)
d.text((centre[0] - 24, centre[1] - 52), "n", ORANGE, 14)
d.text((48, 170), "δ_{0} = b_{0} − a_{0}", RED)
d.text((334, 202), "δ_{1}", RED)
d.text((406, 146), "δ_{2}", RED)
for i, (dx, dy) in enumerate(((-22, 14), (6, 18), (8, 10))):
    d.text((a[i][0] + dx, a[i][1] + dy), f"a_{{{i}}}", BLUE)
for i, (dx, dy) in enumerate(((-24, -2), (6, -5), (8, -2))):
    d.text((b[i][0] + dx, b[i][1] + dy), f"b_{{{i}}}", GREEN)
x = 450
d.text((x, 60), "element b", GREEN, 13, bold=True)
d.text((x, 180), "mid-surface", ORANGE, 13, bold=True)
d.text((x, 198), "m_{i} = (a_{i} + b_{i}) / 2", ORANGE, 12)
d.text((x, 300), "element a", BLUE, 13, bold=True)
d.text((x, 225), "δ_{n} = δ · n", INK, 12)
d.text((x, 243), "δ_{s} = δ − δ_{n} n", INK, 12)
d.save(__file__)
