"""Where energy goes in a run: put in, stored, dissipated."""
from drawing import *

d = Drawing(740, 400)


def node(x, y, w, text, color, column, h=30):
    d.box(x, y, w, h, FILLS[color], color, 1.3)
    d.text((x + w / 2, y + 13), text, INK, 12, "middle")
    d.text((x + w / 2, y + 26), column, GREY, 10, "middle")


d.text((10, 24), "put in", bold=True)
node(10, 40, 180, "loads, gravity, constraints", GREEN, "external_work", 32)
node(10, 90, 180, "energy at the start", GREEN, "first sample", 32)
node(10, 140, 180, "change of the time step", GREEN, "step_change", 32)
d.text((255, 24), "stored", bold=True)
stored = (("kinetic", "kinetic"), ("elements", "elastic"), ("joints", "joint_elastic"), ("contact and its springs", "contact_stored"))
for i, (text, column) in enumerate(stored):
    node(255, 40 + 50 * i, 170, text, BLUE, column, 32)
d.text((520, 24), "dissipated", bold=True)
lost = (("fracture, mode I", "joint_mode_1"), ("fracture, mode II", "joint_mode_2"), ("friction in joints", "joint_friction"),
        ("contact: plateau, damping", "contact_dissipated"), ("friction in contact", "contact_friction"),
        ("plastic flow", "plastic"), ("viscosity, damaged joints", "viscous"), ("damping, absorbed waves", "damping"))
for i, (text, column) in enumerate(lost):
    node(520, 34 + 35 * i, 180, text, RED, column, 31)
d.arrow((190, 56), (253, 56), GREEN, 2)
d.arrow((190, 106), (253, 106), GREEN, 2)
d.arrow((190, 156), (253, 90), GREEN, 1.4, dash="4 3")
for i, (y, to) in enumerate(((106, (49, 260, 295)), (156, (84, 119)), (206, (154, 189)), (56, (225,)))):
    for t in to:
        d.arrow((425, y), (518, t), RED, 1.1, head=6)
d.text((20, 342), "residual = energy at the start + external work + step change − stored − dissipated", BLUE, 12)
d.text((20, 364), "gain = stored − energy at the start − external work", BLUE, 12)
d.text((20, 386), "both as shares of the largest term", size=12)
d.save(__file__)
