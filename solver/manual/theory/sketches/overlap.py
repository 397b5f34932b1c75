"""Overlap of points in a wall one element thick: the least of one linear function for each side of the surface."""
from drawing import *

d = Drawing(680, 320)
left, top, width, height = 40, 50, 360, 150
n = 6
cell = width / n
# Isolines of the distance to the nearer side.
for k in range(1, 6):
    depth = height / 2 * k / 5
    shade = ("#f3f7fb", "#e3edf6", "#cfe0f0", "#b6d0e8", "#9cbfe0")[k - 1]
    d.box(left, top + depth - height / 10, width, height - 2 * depth + height / 5, shade, "none", 0)
for i in range(n):
    x = left + i * cell
    d.line((x, top), (x, top + height), GREY, 1)
    d.line((x, top + height), (x + cell, top), GREY, 1)
d.line((left + width, top), (left + width, top + height), GREY, 1)
d.line((left, top), (left + width, top), INK, 2.5)
d.line((left, top + height), (left + width, top + height), INK, 2.5)
d.line((left, top + height / 2), (left + width, top + height / 2), ORANGE, 1.5, "6 4")
for x, depth, sign in ((left + 1.35 * cell, 45, 1), (left + 3.4 * cell, 50, -1)):
    y = top + depth if sign > 0 else top + height - depth
    d.arrow((x, y), (x, top if sign > 0 else top + height), RED, 2)
    d.dot((x, y), RED, 4)
    d.text((x + 8, y - sign * 18 + 4), "g", RED, 14)
d.text((left, 38), "free surface, upper side: set S_{1} of corners", size=12)
d.text((left, top + height + 20), "free surface, lower side: set S_{2}", size=12)
d.text((left + width + 6, top + height / 2 - 2), "medial surface:", ORANGE, 12)
d.text((left + width + 6, top + height / 2 + 14), "the least function changes", ORANGE, 12)
d.text((left, top + height + 58), "g = min over S of Σ_{a ∉ S} λ_{a} D_{a}", BLUE, 15)
d.text((left, top + height + 82), "λ_{a}: barycentric coordinates; D_{a}: depth of corner a below the surface", BLUE, 12)
d.text((left, top + height + 100), "gradient ∇g points inwards, the force on the point is −w σ ∇g", BLUE, 12)
d.save(__file__)
