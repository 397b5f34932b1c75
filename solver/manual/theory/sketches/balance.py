"""Work of a step in which the overlap begins: by central differences, and the energy that the law stores."""
from drawing import *

d = Drawing(730, 300)
axes = Axes(d, (50, 30, 260, 200), (-0.9, 2.3), (0, 2.2), (-0.9, 0))
# A motion D from -0.5 to 0.5: the overlap at its end is D/2.
axes.area([(-0.5, 0), (0.5, 0.5), (0.5, 0)], FILLS[RED])
axes.area([(0, 0), (0.5, 0.5), (0.5, 0)], FILLS[BLUE])
axes.curve([(-0.9, 0), (0, 0), (2.1, 2.1)], INK, 1.6)
axes.curve([(-0.5, 0), (0.5, 0.5), (1.5, 1.5)], RED, 2.2)
for x in (-0.5, 0.5, 1.5):
    d.dot(axes.at(x, max(x, 0)), RED, 4)
d.line(axes.at(0.5, 0), axes.at(0.5, 0.5), GREY, 1, "3 3")
px, py = axes.at(-0.5, 0)
qx, _ = axes.at(0.5, 0)
d.arrow((px, py + 26), (qx, py + 26), INK, 1.2, both=True)
d.text(((px + qx) / 2, py + 44), "motion D of the step", size=12, anchor="middle")
d.text((axes.at(0, 0)[0] + 2, py + 15), "0", size=12, anchor="middle")
d.text(axes.at(2.3, -0.16), "overlap d", anchor="end", size=12)
d.text(axes.at(-0.84, 2.1), "force k d", size=12)
x = 350
d.text((x, 50), "central differences: ½ k d D", RED)
d.text((x, 70), "the law stores:  ½ k d^{2}", BLUE)
d.text((x, 98), "error: ½ k d (D − d) ≤ k D^{2}/8, largest at d = D/2")
d.text((x, 120), "lost where an overlap begins, gained where it ends")
d.text((x, 160), "Each couple counts its error (gained) and\nchanges its normal force, half in this step and\nhalf in the next, so that the count returns to 0.", size=12)
d.text((x, 225), "The change is at most half of the force and\nat most the largest error of such a step.", size=12)
d.save(__file__)
