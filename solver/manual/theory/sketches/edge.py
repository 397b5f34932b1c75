"""A point beside an edge, a point at a corner over a seam, and a gap of an opening joint: three rules of contact."""
from drawing import *

d = Drawing(700, 300)
# (1) Beside an edge: every element there has the distances to both sides.
x, y = 20, 70
d.text((x, 24), "1  edge", bold=True)
d.area([(x, y), (x + 170, y), (x + 170, y + 130), (x, y + 130)], PALE, GREY, 1)
d.area([(x + 170, y), (x + 170, y + 130), (x + 95, y + 130)], FILLS[ORANGE], ORANGE, 1.2)
d.area([(x + 170, y), (x + 95, y + 130), (x + 20, y)], FILLS[GREEN], GREEN, 1.2)
d.dot((x + 152, y + 50), RED, 4)
d.arrow((x + 152, y + 50), (x + 152, y + 2), BLUE, 1.6)
d.arrow((x + 152, y + 50), (x + 169, y + 50), BLUE, 1.6)
d.text((x + 118, y + 30), "D_{1}", BLUE, 12)
d.text((x + 154, y + 70), "D_{2}", BLUE, 12)
d.text((x + 60, y + 30), "B", GREEN, 12)
d.text((x + 118, y + 118), "A", ORANGE, 12)
d.text((x, 222), "A has the face on the right, B the\nface on top. Both have the distances\nto both sides, so g is continuous.", size=12)
# (2) The lower corner of a block comes over a seam.
x = 250
d.text((x, 24), "2  corner over a seam", bold=True)
d.area([(x, y + 80), (x + 88, y + 80), (x + 88, y + 130), (x, y + 130)], PALE, GREY, 1)
d.area([(x + 92, y + 80), (x + 180, y + 80), (x + 180, y + 130), (x + 92, y + 130)], PALE, GREY, 1)
d.area([(x + 10, y + 10), (x + 102, y + 10), (x + 102, y + 88), (x + 10, y + 88)], FILLS[BLUE], BLUE, 1.6, 0.8)
d.dot((x + 102, y + 88), RED, 4)
d.arrow((x + 102, y + 88), (x + 144, y + 88), RED, 1.8)
d.arrow((x + 102, y + 88), (x + 130, y + 116), ORANGE, 1.8)
d.text((x + 146, y + 92), "n_{p}", RED, 12)
d.text((x + 132, y + 122), "m", ORANGE, 12)
d.arrow((x + 20, y + 40), (x + 64, y + 40), BLUE, 2)
d.text((x, 222), "The front faces the seam, the mean\nnormal m of the corner the top too.\nThe nearest side counts: the top.\nThe seam does not stop the block.", size=12)
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
