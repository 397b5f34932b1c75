"""Which side counts: a point of a block that slides on a floor, and the angle of the facing rule."""
import math

from drawing import *

d = Drawing(680, 306)
# Block that slides to the right on the floor; a point of the floor lies in its front, just beside the edge.
d.area([(20, 190), (330, 190), (330, 236), (20, 236)], PALE, GREY)
d.text((30, 252), "floor: its points face upwards", size=12)
block = [(60, 80), (225, 80), (225, 196), (60, 196)]
d.area(block, FILLS[BLUE], BLUE, 1.8, 0.85)
d.text((75, 105), "block", BLUE, 13, bold=True)
d.arrow((90, 132), (150, 132), BLUE, 2)
d.text((100, 124), "v", BLUE)
p = (214, 190)
d.dot(p, RED, 4.5)
d.arrow(p, (214, 150), RED, 1.8)
d.text((196, 146), "n_{p}", RED)
d.arrow((225, 105), (268, 105), ORANGE, 1.8)
d.text((232, 96), "front side", ORANGE, 12)
d.text((232, 126), "n_{side} · n_{p} = 0: away", ORANGE, 12)
d.arrow((110, 196), (110, 234), GREEN, 1.8)
d.text((118, 216), "base: n_{side} · n_{p} = −1: well", GREEN, 12)
d.text((20, 276), "The base counts for this point, although the front is nearer:", size=12)
d.text((20, 292), "the force is normal, the block is not stopped.", size=12)
# Scale of the facing.
cx, cy, r = 500, 165, 95
a1, a2 = math.acos(-0.01), math.acos(-0.1)
def sector(first, last, fill, color):
    arc = [(cx + r * math.cos(math.pi / 2 - t), cy - r * math.sin(math.pi / 2 - t)) for t in span(first, last, 30)]
    d.area([(cx, cy), *arc], fill, color, 1)
sector(0, a1, PALE, LIGHT)
sector(a1, a2, FILLS[ORANGE], ORANGE)
sector(a2, math.pi, FILLS[GREEN], GREEN)
d.dot((cx, cy), RED, 4)
d.arrow((cx, cy), (cx, cy - r - 22), RED, 2)
d.text((cx - 30, cy - r - 10), "n_{p}", RED)
d.text((cx + 16, cy - 38), "away", GREY, 12)
d.text((cx + 12, cy + 48), "well", GREEN, 12)
d.text((cx + r - 20, cy + 36), "barely", ORANGE, 12)
d.line((cx + 80, cy + 5), (cx + r + 2, cy + 24), ORANGE, 1)
d.text((405, 24), "normal of the side against n_{p}", bold=True)
d.text((405, 281), "barely from cos = −0.01 (90.6°) on,\nwell from −0.1 (95.7°) on", size=12)
d.save(__file__)
