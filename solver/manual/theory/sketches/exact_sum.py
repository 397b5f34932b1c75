"""The fixed-point number of an exact sum: 68 limbs of 32 bits, a term of 53 bits in three of them."""
from drawing import *

d = Drawing(680, 230)
x, y, w, h = 30, 60, 62, 40
names = ["limb 67", "…", "k + 3", "k + 2", "k + 1", "k", "k − 1", "…", "limb 0"]
for i, name in enumerate(names):
    inside = name in ("k + 2", "k + 1", "k")
    d.box(x + i * w, y, w, h, FILLS[ORANGE] if inside else PALE, GREY, 1)
    d.text((x + (i + 0.5) * w, y + 25), name, size=12, anchor="middle")
d.text((x, y - 28), "2^{1056}", size=12, anchor="start")
d.text((x + 9 * w, y - 28), "2^{−1088}", size=12, anchor="end")
d.text((x, y - 10), "limb k holds multiples of 2^{32k − 1088} in a 64-bit integer", size=12)
left, right = x + 3 * w + 26, x + 6 * w - 22
d.box(left, y + 62, right - left, 24, FILLS[RED], RED, 1.4)
d.text(((left + right) / 2, y + 79), "53 bits of a term", size=12, anchor="middle")
d.arrow(((left + right) / 2, y + 60), ((left + right) / 2, y + 42), RED, 1.5)
d.text((x, y + 120), "An addition changes a limb by less than 2^{32}: carries are passed on once in 2^{30} additions.", size=12)
d.text((x, y + 140), "Integers add without rounding: the sum is the same in any order and from any number of ranks.", BLUE, 12)
d.text((x, y + 160), "value(): one rounding, to the nearest double.", size=12)
d.save(__file__)
