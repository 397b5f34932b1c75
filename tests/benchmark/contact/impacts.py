"""Experiments on energy: impacts of elastic bodies, bodies at rest, random cases of tests/verification."""

import random

from cases import GRAVITY, NO_LIMITS, at, balance, complete, contact, fixed, material, output, ramp, stage, text, thrown
from meshes import Mesh, rotation_to_z


class Impacts:
    """Bodies strike a fixed plate without friction."""

    SPEEDS = [1.0, 1.13, 1.29]
    # Shape -> (penalty over Young's modulus, time.safety): on a face the force lasts for about 4, 6, 10, 20 steps.
    SETTINGS = {"face": [(2, 0.9), (0.3, 0.8), (0.3, 0.45), (0.3, 0.22)],
                "edge": [(0.3, 0.8), (1, 0.8), (1, 0.5), (1, 0.22)],
                "corner": [(0.3, 0.8), (1, 0.8), (1, 0.5), (1, 0.22)], "ball": [(1, 0.8), (1, 0.3)],
                "ridge": [(1, 0.8), (1, 0.3), (3, 0.8)]}
    GAP = 1e-5

    def __init__(self, steep):
        self.name = "steep impacts" if steep else "impacts"
        self.law = ["unloading_exponent = 6", "plateau = 20e6"] if steep else []

    @classmethod
    def mesh(cls, shape):
        mesh = Mesh()
        x, y, a = 0.0011, 0.0007, 0.01
        if shape == "ridge":  # along x, and the face of a tetrahedron that also moves across it
            side = 0.01 * 2**0.5
            turn = rotation_to_z([0, 0.5**0.5, 0.5**0.5])
            mesh.turned_box("plate", [0, 0, -0.01], [0.04, side, side], [4, 2, 2], turn)
        else:
            mesh.box("plate", [-0.02, -0.02, -0.01], [0.02, 0.02, 0], [4, 4, 1], jitter=0.2, seed=3)
        if shape == "ball":
            mesh.ball("body", [x, y, 0.005 + cls.GAP], 0.005, 2)
            return mesh.text()
        r = a / 3**0.5
        base = [[a / 2, -r / 2, 0], [-a / 2, -r / 2, 0], [0, r, 0], [0, 0, a * (2 / 3) ** 0.5]]
        corners = {"face": base, "ridge": base, "corner": [[p, q, -r] for p, q, r in base],
                   "edge": [[a / 2, 0, 0], [-a / 2, 0, 0], [0, a / 2, a / 2**0.5], [0, -a / 2, a / 2**0.5]]}[shape]
        lowest = min(r for _, _, r in corners)
        mesh.tetrahedron("body", [[p + x, q + y, r - lowest + cls.GAP] for p, q, r in corners])
        return mesh.text()

    def cases(self):
        cases = {}
        for shape, settings in self.SETTINGS.items():
            mesh = self.mesh(shape)
            for penalty, safety in settings:
                for speed in self.SPEEDS:
                    end = 2 * self.GAP / speed + 60e-6
                    cases[f"{shape} {penalty} {safety} {speed}"] = (text(
                        material(["body", "plate"], 1e9), contact(["body", "plate"], penalty * 1e9, *self.law),
                        ["[contact_points]", "per_face = 4"],
                        thrown("body", [0, 1.5 * speed if shape == "ridge" else 0, -3 * speed]),
                        stage(end), fixed("plate"), output(1e-9, ["body"]),
                        limits=[*NO_LIMITS, f"safety = {safety}"]), mesh)
        return cases

    def figures(self, results):
        """At the end, when the bodies are apart: what is between is the error of steps in the middle of an impact."""
        figures = balance(results, from_line=-1)
        for label, result in complete(results).items():
            if result["history"]["body centre z"][-1] < 0:
                figures["failures"].append(f"{label}: the body is in the plate")
        return figures


class Rest:
    """Cubes on top of each other, flush and as a pyramid: they come to rest under damping and stay there without it."""

    name = "rest"
    STILL = 1e-4  # m, that a cube of 20 mm may move from damped rest to the end
    YOUNG, SIDE = 20e6, 0.02

    @classmethod
    def mesh(cls, places):
        mesh, a = Mesh(), cls.SIDE
        mesh.box("floor", [-3 * a, -2 * a, -a], [3 * a, 2 * a, 0], [5, 3, 1], jitter=0.2, seed=5)
        for n, (x, z) in enumerate(places):
            low = [x * a - a / 2, -a / 2, z * a]
            mesh.box(f"cube{n}", low, [c + a for c in low], [2, 2, 2], jitter=0.2, seed=10 + n)
        return mesh.text()

    def cases(self):
        cases = {}
        places = {"column": [(0, 0), (0, 1), (0, 2)],
                  "pyramid": [(-1.02, 0), (0, 0), (1.02, 0), (-0.51, 1), (0.51, 1), (0, 2)]}
        for (label, where), points in [(item, n) for item in places.items() for n in (3, 4)]:
            cubes = [f"cube{n}" for n in range(len(where))]
            cases[f"{label} {points}"] = (text(
                material([*cubes, "floor"], self.YOUNG), contact(["*", "*"], self.YOUNG, "friction = 0.5"),
                ["[contact_points]", f"per_face = {points}"],
                stage(0.06, [0, 0, ramp(-GRAVITY, 0, 0.03)], "mass_damping = 400"), fixed("floor"),
                stage(0.12, [0, 0, -GRAVITY]), fixed("floor"), output(5e-4, cubes)), self.mesh(where))
        return cases

    def figures(self, results):
        figures = balance(results)
        for label, result in complete(results).items():
            history = result["history"]
            start = at(history, 0.06)
            for n in range(3 if "column" in label else 6):
                centre = [history[f"cube{n} centre {axis}"] for axis in "xyz"]
                moved = max(abs(along[-1] - along[start]) for along in centre)
                if moved > self.STILL:
                    figures["failures"].append(f"{label}: cube {n} moves by {moved * 1e3:.2g} mm")
        return figures


class RandomCases:
    """Random cases of tests/verification, whose seeds have shown faults before, or are short."""

    def __init__(self, name, module, seeds, steps=1.0):
        self.name, self.module, self.seeds, self.steps = name, module, seeds, steps

    def cases(self):
        class Arguments:
            steps = self.steps
        found = {}
        for seed in self.seeds:
            case, _ = self.module.text_of(random.Random(seed), Arguments, 0)
            found[str(seed)] = (case + "\n".join(NO_LIMITS) + "\n", "")
        return found

    def figures(self, results):
        return balance(results)


class Aligned:
    """A cube falls flat on a floor of equal, regular cells: points lie on the borders of elements, where one counts."""

    name = "aligned"
    WITHIN = 0.1  # the largest force by other points of a face against that by three

    def cases(self):
        mesh, a = Mesh(), 0.02
        mesh.box("floor", [-2 * a, -2 * a, -a], [2 * a, 2 * a, 0], [8, 8, 2])
        mesh.box("cube", [-a / 2, -a / 2, 1e-6], [a / 2, a / 2, a], [2, 2, 2])
        return {str(points): (text(
            material(["cube", "floor"], 20e6), contact(["*", "*"], 20e6), ["[contact_points]", f"per_face = {points}"],
            thrown("cube", [0, 0, -0.5]), stage(0.01), fixed("floor"), output(2e-5, ["cube"])),
            mesh.text()) for points in (3, 4, 6)}

    def figures(self, results):
        figures = balance(results, from_line=-1)
        force = {label: max(result["history"]["cube force z"]) for label, result in complete(results).items()}
        for label in force:
            ratio = force[label] / force.get("3", force[label])
            if abs(ratio - 1) > self.WITHIN:
                figures["failures"].append(f"{label} points: the largest force is {ratio:.2f} times that by 3")
        return figures
