"""Two ranks: originals, proxies, a joint across the border, and the messages of a step."""
from drawing import *

d = Drawing(720, 330)


def strip(x, y, first, last, own, color, border):
    w, h = 46, 46
    for k in range(first, last):
        fill = FILLS[color] if own(k) else "#fff"
        a, b, c, e = (x + k * w, y), (x + (k + 1) * w, y), (x + (k + 1) * w, y + h), (x + k * w, y + h)
        edge = color if own(k) else GREY
        d.area([a, b, e], fill, edge, 1.4)
        d.area([b, c, e], fill, edge, 1.4)
        if not own(k):
            d.text((x + k * w + 23, y + 28), "p", GREY, 12, "middle")
    d.line((x + border * w, y - 12), (x + border * w, y + h + 12), ORANGE, 2, "6 4")


d.text((20, 40), "rank 0", BLUE, bold=True)
strip(90, 30, 0, 6, lambda k: k < 4, BLUE, 4)
d.text((20, 140), "rank 1", GREEN, bold=True)
strip(90, 130, 2, 8, lambda k: k >= 4, GREEN, 4)
d.text((400, 58), "p: proxies, elements whose originals are\non the other rank", size=12)
d.arrow((250, 82), (250, 126), BLUE, 1.8)
d.arrow((298, 126), (298, 82), GREEN, 1.8)
d.text((90, 108), "x, v of near proxies", size=12)
d.text((308, 108), "one message a neighbour and step", size=12)
d.text((20, 215), "The joint across the border is evaluated on both ranks, from the same numbers in the same order.", size=12)
# Time line of a step.
y = 262
d.text((20, y - 18), "a step on each rank", bold=True)
parts = [("loads, joints, contact", 180, PALE), ("sweep: sent first", 120, FILLS[ORANGE]), ("sweep: the others", 220, FILLS[BLUE]),
         ("receive", 70, PALE)]
x = 20
for text, w, fill in parts:
    d.box(x, y, w, 30, fill, GREY, 1)
    d.text((x + w / 2, y + 20), text, size=12, anchor="middle")
    x += w
d.arrow((200, y + 46), (200, y + 31), RED, 1.6)
d.text((196, y + 60), "reduction leaves", RED, 12, "end")
d.arrow((320, y + 46), (320, y + 31), BLUE, 1.6)
d.text((326, y + 60), "messages leave, travel during the sweep", BLUE, 12)
d.save(__file__)
