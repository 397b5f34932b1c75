"""A point beside an edge, a far side, and a gap of an opening joint: three rules of contact."""
from drawing import *

d = Drawing(700, 300)
# (1) Beside an edge: the element of the point has only the side; its neighbour with the top replaces it.
x, y = 20, 70
d.text((x, 24), "1  edge", bold=True)
d.area([(x, y), (x + 170, y), (x + 170, y + 130), (x, y + 130)], PALE, GREY, 1)
d.area([(x + 170, y), (x + 170, y + 130), (x + 95, y + 130)], FILLS[ORANGE], ORANGE, 1.2)
d.area([(x + 170, y), (x + 95, y + 130), (x + 20, y)], FILLS[GREEN], GREEN, 1.2)
d.dot((x + 166, y + 14), RED, 4)
d.arrow((x + 166, y + 14), (x + 166, y - 24), RED, 1.8)
d.text((x + 60, y + 30), "B: has the top", GREEN, 12)
d.text((x + 118, y + 118), "A", ORANGE, 12)
d.text((x, 222), "The point lies in A, which has only\nthe right side. B reaches to it within\nλ ≥ −0.01 and replaces A.", size=12)
# (2) A side far away.
x = 250
d.text((x, 24), "2  far side", bold=True)
d.area([(x, y), (x + 150, y), (x + 150, y + 130), (x, y + 130)], PALE, GREY, 1)
d.line((x, y), (x + 150, y), BLUE, 2.5)
d.line((x + 150, y), (x + 150, y + 130), ORANGE, 2.5)
d.dot((x + 143, y + 90), RED, 4)
d.arrow((x + 143, y + 90), (x + 143, y + 2), BLUE, 1.4, dash="5 4")
d.arrow((x + 143, y + 90), (x + 168, y + 90), ORANGE, 1.6)
d.text((x + 60, y + 60), "g (faces)", BLUE, 12)
d.text((x + 156, y + 80), "< g/2", ORANGE, 12)
d.text((x + 164, y + 110), "nearer\nside", ORANGE, 12)
d.text((x, 222), "No force starts if the facing side is\ndeeper than 0.1 of the element's\ndepth, and another one is nearer\nthan half of it.", size=12)
# (3) A joint opens under a pressing point.
x = 485
d.text((x, 24), "3  gap of a joint", bold=True)
d.area([(x, y), (x + 85, y), (x + 70, y + 130), (x, y + 130)], FILLS[BLUE], BLUE, 1.2)
d.area([(x + 100, y), (x + 185, y), (x + 185, y + 130), (x + 88, y + 130)], FILLS[BLUE], BLUE, 1.2)
d.dot((x + 89, y + 20), RED, 4)
d.arrow((x + 89, y - 28), (x + 89, y + 12), RED, 1.4)
d.text((x + 96, y - 14), "force of the couple", RED, 12)
d.line((x + 83.5, y), (x + 90, y - 5), GREY, 1, "2 2")
d.text((x, 222), "A point that pressed stays with its\nelement up to a hundredth of the\nelement's height outside. Farther\nout its stored energy is dissipated.", size=12)
d.save(__file__)
