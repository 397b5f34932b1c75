"""Volumetric part of the neo-Hookean law over the volume ratio, and its continuation below J_min."""
from drawing import *

mu, lam, j_min = 1.0, 1.0, 0.1


def slope(j):
    return 0.5 * lam * j - (mu + 0.5 * lam) / j


def continued(j):
    curvature = (mu + 0.5 * lam) / j_min**2 + 0.5 * lam
    return slope(j) if j >= j_min else slope(j_min) + curvature * (j - j_min)


d = Drawing(640, 330)
axes = Axes(d, (60, 20, 420, 270), (-0.12, 0.9), (-45, 6), (0, 0))
axes.curve([(j, slope(j)) for j in span(0.035, j_min, 30)], GREY, 1.5, "5 4")
axes.curve([(j, continued(j)) for j in span(j_min, 0.88, 60)], BLUE, 2.4)
axes.curve([(j, continued(j)) for j in span(-0.09, j_min, 20)], RED, 2.4)
d.dot(axes.at(j_min, slope(j_min)), INK, 4)
d.line(axes.at(j_min, 0), axes.at(j_min, slope(j_min)), GREY, 1, "3 3")
d.text((axes.at(j_min, 0)[0] + 4, axes.at(j_min, 0)[1] - 6), "J_{min} = 0.1", size=12)
d.text(axes.at(0.88, 1.2), "J", anchor="end")
d.text(axes.at(-0.115, 3.4), "ψ'(J)")
d.text(axes.at(0.3, -8), "neo-Hookean: ψ'(J)", BLUE)
d.text(axes.at(0.12, -23), "continued along its tangent:\nfinite and growing, also for\ninverted elements (J < 0)", RED, 12)
d.text(axes.at(0.3, -41), "without: → −∞ at J = 0", GREY, 12)
d.save(__file__)
