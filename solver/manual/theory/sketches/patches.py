"""Patches of free faces for the stable step of contact: cells, boxes, and the distance within which they count."""
from drawing import *

d = Drawing(720, 280)
# Two bodies, their free faces in cells.
x, y, c = 30, 40, 46
for i in range(6):
    for j in range(4):
        d.box(x + i * c, y + j * c, c, c, "none", LIGHT, 0.8)
body_a = [(36, 62), (150, 52), (160, 130), (44, 150)]
body_b = [(186, 118), (296, 104), (300, 200), (192, 214)]
d.area(body_a, FILLS[BLUE], BLUE, 1.8, 0.8)
d.area(body_b, FILLS[GREEN], GREEN, 1.8, 0.8)
d.text((80, 104), "body a", BLUE, 12)
d.text((228, 166), "body b", GREEN, 12)
d.box(146, 86, 18, 48, "none", RED, 2)
d.box(184, 112, 16, 50, "none", RED, 2)
d.arrow((165, 140), (183, 140), RED, 1.4, both=True, head=5)
d.text((150, 248), "patches that may meet", RED, 12)
d.line((172, 236), (174, 146), RED, 1)
d.arrow((120, 30), (160, 38), BLUE, 1.6)
d.text((84, 28), "v_{a}", BLUE, 12)
tx = 350
for i, (text, color) in enumerate((
        ("patch: free faces of one body, group", INK), ("and size in one cell; of all ranks the", INK),
        ("largest A_{i}/m_{i}, 1/m_{i}, G^{2}, w, 1/H", INK), ("", INK), ("two patches count if their gap is at most", RED),
        ("2 v_{rel} t + ¼ face size", RED), ("t: time to the next evaluation", RED), ("", INK),
        ("the same for any number of ranks:", INK), ("no couple and no search enters", INK))):
    d.text((tx, 60 + 21 * i), text, color, 12)
d.save(__file__)
