"""A couple: the box of a contactor and its face planes, both enlarged by the buffer."""
from drawing import *

d = Drawing(660, 310)
t = [(110, 215), (260, 200), (165, 80)]
b = 34
low = (min(p[0] for p in t), min(p[1] for p in t))
high = (max(p[0] for p in t), max(p[1] for p in t))


def offset_line(p, q, away, dist):
    import math
    ex, ey = q[0] - p[0], q[1] - p[1]
    length = math.hypot(ex, ey)
    nx, ny = ey / length, -ex / length
    if (away[0] - p[0]) * nx + (away[1] - p[1]) * ny > 0:
        nx, ny = -nx, -ny
    return (p[0] + dist * nx, p[1] + dist * ny), (q[0] + dist * nx, q[1] + dist * ny)


def cross(l, m):
    (x1, y1), (x2, y2) = l
    (x3, y3), (x4, y4) = m
    den = (x1 - x2) * (y3 - y4) - (y1 - y2) * (x3 - x4)
    a, c = x1 * y2 - y1 * x2, x3 * y4 - y3 * x4
    return ((a * (x3 - x4) - (x1 - x2) * c) / den, (a * (y3 - y4) - (y1 - y2) * c) / den)


lines = [offset_line(t[i], t[(i + 1) % 3], t[(i + 2) % 3], b) for i in range(3)]
outer = [cross(lines[i], lines[i - 1]) for i in range(3)]
box = [(low[0] - b, low[1] - b), (high[0] + b, low[1] - b), (high[0] + b, high[1] + b), (low[0] - b, high[1] + b)]


def clip(polygon, inside, meet):
    out = []
    for i, q in enumerate(polygon):
        p = polygon[i - 1]
        if inside(p) != inside(q):
            out.append(meet(p, q))
        if inside(q):
            out.append(q)
    return out


region = outer
for axis, sign, bound in ((0, 1, box[0][0]), (0, -1, box[1][0]), (1, 1, box[0][1]), (1, -1, box[2][1])):
    def meet(p, q, axis=axis, bound=bound):
        s = (bound - p[axis]) / (q[axis] - p[axis])
        return (p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1]))
    region = clip(region, lambda p, axis=axis, sign=sign, bound=bound: sign * (p[axis] - bound) >= 0, meet)
d.area(region, FILLS[GREEN], GREEN, 1.5)
d.box(box[0][0], box[0][1], box[1][0] - box[0][0], box[2][1] - box[0][1], color=BLUE, line=1.4, dash="6 4")
d.area(t, PALE, INK, 1.8)
d.text((160, 165), "contactor", size=12)
for p, yes in (((232, 120), True), ((285, 90), False), ((108, 165), True), ((340, 150), False)):
    d.dot(p, RED if yes else GREY, 4.5)
d.arrow((260, 200), (294, 200), INK, 1.2, both=True)
d.text((272, 194), "b", size=12)
d.text((250, 118), "couple", RED, 12)
d.text((300, 78), "in the box, beyond a plane", GREY, 12)
d.text((350, 155), "no couple", GREY, 12)
x = 350
d.text((x, 196), "(1) in the box, enlarged by the buffer b", BLUE, 12)
d.text((x, 216), "(2) at most b outside each face plane", GREEN, 12)
d.text((x, 246), "While no node has moved by more than b/2\nsince the search, every point inside a\ntetrahedron is in a couple.", size=12)
d.save(__file__)
