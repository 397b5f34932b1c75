"""Experiments on friction."""

import math

from cases import GRAVITY, at, balance, complete, contact, driven, fixed, material, output, ramp, stage, text, thrown
from meshes import Mesh


def deviation(values):
    """Standard deviation over mean."""
    mean = sum(values) / len(values)
    return math.sqrt(sum((value - mean) ** 2 for value in values) / len(values)) / abs(mean)


class Rig:
    """A plate is pressed on another one and driven along it: friction over normal force is the coefficient."""

    STEADY = 0.2  # standard deviation over mean of the normal force, above which the plates vibrate

    def __init__(self, name, coefficients):
        self.name, self.coefficients = name, coefficients

    @staticmethod
    def mesh():
        mesh = Mesh()
        mesh.box("upper", [0, 0, 1e-9], [0.04, 0.015, 0.01], [8, 3, 2], jitter=0.2, seed=1)
        mesh.box("lower", [-0.015, -0.0075, -0.015], [0.07, 0.0225, 0], [14, 5, 3], jitter=0.2, seed=2)
        mesh.surface("top", lambda x: abs(x[2] - 0.01) < 1e-8)
        return mesh.text()

    def cases(self):
        return {str(friction): (text(
            material(["upper", "lower"], 10e9),
            contact(["upper", "lower"], 10e9, f"friction = {friction}", 'points_on = "first"'),
            stage(3e-3), ["[[stage.pressure]]", 'surface = "top"', f"value = {ramp(2e6, 0, 0.5e-3)}"],
            fixed("lower"), driven("top", f"x = {ramp(0.5, 0.5e-3, 1e-3)}, y = 0"),
            output(5e-6, ["upper"])), self.mesh()) for friction in self.coefficients}

    def figures(self, results):
        figures = {**balance(results), "friction": 0.0, "unsteady": 0.0}
        for label, result in complete(results).items():
            history = result["history"]
            x, z = (history[f"upper force {axis}"][at(history, 1.5e-3):] for axis in "xz")
            spread = deviation(z)
            figures["friction"] = max(figures["friction"], abs(abs(sum(x) / sum(z)) / float(label) - 1))
            figures["unsteady"] = max(figures["unsteady"], spread)
            if spread > self.STEADY:
                figures["failures"].append(f"{label}: vibrates by {spread:.0%} of the normal force")
        return figures


class Slopes:
    """A block on a slope just below and above its angle of friction, and for longer on a steeper one; two floors."""

    name = "slopes"
    YOUNG, FRICTION, STILL = 20e6, 0.5, 1e-3  # Pa, -, m/s
    STEADY = 0.2  # as of Rig

    @staticmethod
    def mesh(end, cells):
        mesh = Mesh()
        mesh.box("block", [0, -0.01, 1e-8], [0.04, 0.03, 0.02], [4, 4, 2], jitter=0.2, seed=1)
        mesh.box("floor", [-0.04, -0.03, -0.02], [end, 0.05, 0], cells, jitter=0.2, seed=2)
        return mesh.text()

    def cases(self):
        cases = {}
        for degrees in (26, 28, 30):
            long = degrees == 30
            meshes = {"coarse": self.mesh(0.32, [9, 2, 1]), "fine": self.mesh(0.32, [36, 7, 1])} if long else {
                "coarse": self.mesh(0.08, [3, 2, 1]), "fine": self.mesh(0.08, [11, 7, 2])}
            for floor, mesh in meshes.items():
                angle = math.radians(degrees)
                x, z = (ramp(GRAVITY * math.sin(angle), 0.04, 0.06), ramp(-GRAVITY * math.cos(angle), 0, 0.04))
                cases[f"{degrees} {floor}"] = (text(
                    material(["block", "floor"], self.YOUNG),
                    contact(["block", "floor"], self.YOUNG, f"friction = {self.FRICTION}", 'points_on = "first"'),
                    stage(0.5 if long else 0.13, [x, 0, z]), fixed("floor"), output(1e-3, ["block"])), mesh)
        return cases

    def figures(self, results):
        figures = {**balance(results), "friction": 0.0, "unsteady": 0.0}
        for label, result in complete(results).items():
            history, angle = result["history"], math.radians(float(label.split()[0]))
            t, x = history["time"], history["block displacement x"]
            a, c = at(history, 0.07), len(t) - 1
            b = at(history, t[a] + 0.495 * (t[c] - t[a]))
            acceleration = 2 * ((x[c] - x[b]) / (t[c] - t[b]) - (x[b] - x[a]) / (t[b] - t[a])) / (t[c] - t[a])
            right = GRAVITY * (math.sin(angle) - self.FRICTION * math.cos(angle))
            if right > 0:
                error = abs(right - acceleration) / (self.FRICTION * GRAVITY * math.cos(angle))
                figures["friction"] = max(figures["friction"], error)
            elif abs(x[c] - x[b]) / (t[c] - t[b]) > self.STILL:
                figures["failures"].append(f"{label}: slides with {(x[c] - x[b]) / (t[c] - t[b]):.2g} m/s")
            spread = deviation(history["block force z"][b:])
            figures["unsteady"] = max(figures["unsteady"], spread)
            if spread > self.STEADY:
                figures["failures"].append(f"{label}: vibrates by {spread:.0%} of the normal force")
        return figures


class Slides:
    """A block that is thrown along a floor stops after v^2 / (2 mu g)."""

    name = "slides"

    @staticmethod
    def mesh(floor):
        mesh = Mesh()
        mesh.box("block", [0, -0.01, 1e-8], [0.04, 0.03, 0.02], [4, 4, 2], jitter=0.2, seed=1)
        mesh.box("floor", [-0.04, -0.03, -0.02], [0.2, 0.05, 0], floor, jitter=0.2, seed=2)
        return mesh.text()

    CASES = {"0.5 coarse": (0.5, 0.9, [6, 2, 1]), "0.3 fine": (0.3, 0.7, [16, 6, 1])}

    def cases(self):
        return {label: (text(
            material(["block", "floor"], 20e6), contact(["block", "floor"], 20e6, f"friction = {friction}"),
            thrown("block", [speed, 0, 0]), stage(1.15 * speed / (friction * GRAVITY), [0, 0, -GRAVITY]),
            fixed("floor"), output(1e-3, ["block"])), self.mesh(floor))
            for label, (friction, speed, floor) in self.CASES.items()}

    def figures(self, results):
        figures = {**balance(results), "friction": 0.0}
        for label, result in complete(results).items():
            friction, speed, _ = self.CASES[label]
            way = result["history"]["block displacement x"][-1] * 2 * friction * GRAVITY / speed**2
            figures["friction"] = max(figures["friction"], abs(1 / way - 1) if way > 0 else 1.0)
            if abs(result["history"]["block velocity x"][-1]) > 0.02:
                figures["failures"].append(f"{label}: has not stopped")
        return figures


class Spins:
    """A block that spins on a floor is stopped by the torque of friction; one on a turntable does not slide."""

    name = "spins"
    FRICTION, SIDE = 0.5, 0.02
    # Mean distance from the centre of a square of side 1.
    ARM = (math.sqrt(2) + math.asinh(1)) / 6
    RADIUS, TURN = 0.015, 12.0  # m, rad/s
    STILL = 1e-4  # m

    def floor_case(self):
        mesh, a = Mesh(), self.SIDE
        mesh.box("block", [-a / 2, -a / 2, 1e-8], [a / 2, a / 2, a / 2], [5, 5, 2], jitter=0.2, seed=1)
        mesh.box("floor", [-a, -a, -a / 2], [a, a, 0], [3, 3, 1], jitter=0.2, seed=2)
        return text(material(["block", "floor"], 20e6),
                    contact(["block", "floor"], 0.4e6, f"friction = {self.FRICTION}", 'points_on = "first"'),
                    thrown("block", angular=[0, 0, 60]), stage(0.018, [0, 0, ramp(-10 * GRAVITY, 0, 4e-3)]),
                    fixed("floor"), output(5e-5, ["block"])), mesh.text()

    def table_case(self):
        mesh, a, r = Mesh(), 0.01, self.RADIUS
        mesh.box("block", [r - a / 2, -a / 2, 1e-8], [r + a / 2, a / 2, a], [2, 2, 2], jitter=0.2, seed=1)
        mesh.box("table", [-0.03, -0.03, -0.01], [0.03, 0.03, 0], [6, 6, 1], jitter=0.2, seed=2)
        mesh.surface("underside", lambda x: abs(x[2] + 0.01) < 1e-9)
        return text(material(["block"], 20e6), material(["table"], 200e6, density=20000),
                    contact(["block", "table"], 20e6, f"friction = {self.FRICTION}", 'points_on = "first"'),
                    thrown("block", [0, self.TURN * r, 0], [0, 0, self.TURN]),
                    thrown("table", angular=[0, 0, self.TURN]),
                    stage(0.13, [0, 0, -GRAVITY]), fixed("underside", "z"),
                    output(5e-4, ["block", "table"])), mesh.text()

    def cases(self):
        return {"on a floor": self.floor_case(), "on a turntable": self.table_case()}

    def figures(self, results):
        figures = {**balance(results), "friction": 0.0}
        done = complete(results)
        if "on a floor" in done:
            history = done["on a floor"]["history"]
            t, spin, normal = history["time"], history["block spin z"], history["block force z"]
            first = at(history, 4e-3)
            last = next((i for i in range(first, len(t)) if spin[i] < 5), len(t) - 1)
            turned = sum(0.25 * (spin[i] + spin[i + 1]) * (normal[i] + normal[i + 1]) * (t[i + 1] - t[i])
                         for i in range(first, last))
            right = self.FRICTION * self.ARM * self.SIDE * turned
            rubbed = history["friction"][last] - history["friction"][first]
            figures["friction"] = abs(rubbed / right - 1) if right > 0 else 1.0
        if "on a turntable" in done:
            history = done["on a turntable"]["history"]
            away = [math.hypot(*(history[f"block centre {c}"][i] - history[f"table centre {c}"][i] for c in "xy"))
                    for i in (at(history, 0.02), -1)]
            if abs(away[1] - away[0]) > self.STILL:
                figures["failures"].append(f"turntable: the block slides by {abs(away[1] - away[0]) * 1e3:.2g} mm")
        return figures
