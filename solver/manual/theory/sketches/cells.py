"""Cells and half masks: lists of rows and columns (NBS), the sorted list with running pointers (MR)."""
from drawing import *

d = Drawing(770, 310)
cell = 36


def grid(x, y, nx, ny):
    for i in range(nx + 1):
        d.line((x + i * cell, y), (x + i * cell, y + ny * cell), LIGHT, 1)
    for j in range(ny + 1):
        d.line((x, y + j * cell), (x + nx * cell, y + j * cell), LIGHT, 1)


def at(x, y, ny, i, j):
    return (x + (i + 0.5) * cell, y + (ny - j - 0.5) * cell)


# NBS
x, y, nx, ny = 70, 50, 6, 5
d.text((20, 24), "NBS: lists of rows, then of columns", bold=True)
target = (3, 2)
for i, j in ((3, 2), (2, 2), (2, 1), (3, 1), (4, 1)):
    d.box(x + i * cell, y + (ny - j - 1) * cell, cell, cell, FILLS[ORANGE], "none", 0)
grid(x, y, nx, ny)
bodies = [(3, 2, "7"), (2, 2, "2"), (4, 1, "5"), (3, 1, "0"), (0, 4, "1"), (5, 3, "3"), (1, 0, "4"), (0, 2, "6")]
for i, j, name in bodies:
    c = at(x, y, ny, i, j)
    d.circle(c, 11, FILLS[BLUE] if (i, j) != target else FILLS[RED], BLUE if (i, j) != target else RED)
    d.text((c[0], c[1] + 4), name, size=11, anchor="middle")
for j in range(ny):
    d.text((x - 8, y + (ny - j - 0.5) * cell + 4), f"iy = {j}", size=11, anchor="end")
r = at(x, y, ny, 5, 2)
d.arrow((x + nx * cell + 6, r[1]), (x + nx * cell + 30, r[1]), GREY, 1.2)
d.text((x + nx * cell + 34, r[1] + 4), "row 2: 7 → 6 → 2", size=11)
r = at(x, y, ny, 5, 1)
d.arrow((x + nx * cell + 6, r[1]), (x + nx * cell + 30, r[1]), GREY, 1.2)
d.text((x + nx * cell + 34, r[1] + 4), "row 1: 5 → 0", size=11)
d.text((20, 256), "A body pairs with its own cell and the earlier half\nof the touching cells (orange): each pair is found once.", size=12)
d.text((20, 294), "Heads by slot, links by body: O(N) time and memory.", size=12)
# MR
x0 = 440
d.text((x0, 24), "MR: one sorted list (iy, then ix)", bold=True)
order = sorted(bodies, key=lambda b: (b[1], b[0]))
for k, (i, j, name) in enumerate(order):
    c = (x0 + 16 + 33 * k, 150)
    d.circle(c, 11, FILLS[BLUE] if (i, j) != target else FILLS[RED], BLUE if (i, j) != target else RED)
    d.text((c[0], c[1] + 4), name, size=11, anchor="middle")
    d.text((c[0], c[1] + 28), f"{i},{j}", GREY, 10, "middle")
    if k:
        d.arrow((c[0] - 21, 150), (c[0] - 12, 150), GREY, 1, head=5)
target_k = [k for k, b in enumerate(order) if (b[0], b[1]) == target][0]
own_k = [k for k, b in enumerate(order) if (b[0], b[1]) == (2, 2)][0]
row_k = [k for k, b in enumerate(order) if (b[0], b[1]) == (3, 1)][0]
for k, color, text, level in ((target_k, RED, "target", 60), (own_k, ORANGE, "own row", 82), (row_k, GREEN, "row below", 60)):
    px = x0 + 16 + 33 * k
    d.arrow((px, level + 8), (px, 136), color, 1.5)
    d.text((px, level), text, color, 11, "middle")
d.text((x0, 215), "Each pointer only advances: O(N) for the search.\nMR-sort moves the bodies that are out of order.", size=12)
d.save(__file__)
