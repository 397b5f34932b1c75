"""Experiments on many bodies: an arch, the seam of a floor, platens, debris."""

import math
import random

from cases import (GRAVITY, NO_LIMITS, balance, complete, contact, driven, fixed, material, output, ramp, stage, text,
                   thrown)
from meshes import Mesh, random_rotation


class Arch:
    """Half a ring of 15 dry stones stands from a thickness of 0.106 of its radius on."""

    name = "arch"
    STONES, DEPTH = 15, 0.2
    STANDING, FALLEN = 0.05, 5.0  # J, of the stones

    @classmethod
    def mesh(cls, thickness):
        mesh = Mesh()
        mesh.box("pier", [0.8, -0.2, 0], [1.2, 0, cls.DEPTH], [4, 2, 2], jitter=0.2, seed=1)
        mesh.box("pier", [-1.2, -0.2, 0], [-0.8, 0, cls.DEPTH], [4, 2, 2], jitter=0.2, seed=2)
        for stone in range(cls.STONES):
            ends = [math.pi * (stone + n) / cls.STONES for n in (0, 1)]

            def place(i, j, k, ends=ends):  # flat faces, as cut stones have
                radius = 1 + thickness * (i - 0.5)
                a, b = ([radius * math.cos(end), radius * math.sin(end)] for end in ends)
                return [a[axis] + j / 2 * (b[axis] - a[axis]) for axis in (0, 1)] + [k * cls.DEPTH / 2]

            mesh.grid("stone", [1, 2, 2], place)
        return mesh.text()

    def cases(self):
        return {f"{thickness}": (text(
            material(["stone", "pier"], 200e6), contact(["*", "*"], 50e6, "friction = 0.7"),
            ["[contact_points]", "per_face = 4"],
            stage(0.15, [0, ramp(-GRAVITY, 0, 0.1), 0], "mass_damping = 20"), fixed("pier"),
            stage(0.45, [0, -GRAVITY, 0]), fixed("pier"), output(2e-3)),
            self.mesh(thickness)) for thickness in (0.115, 0.1)}

    def figures(self, results):
        figures = balance(results)
        for label, result in complete(results).items():
            kinetic = result["history"]["kinetic"][-1]
            if float(label) > 0.106 and kinetic > self.STANDING:
                figures["failures"].append(f"thickness {label}: falls ({kinetic:.2g} J)")
            if float(label) < 0.106 and kinetic < self.FALLEN:
                figures["failures"].append(f"thickness {label}: stands ({kinetic:.2g} J)")
        return figures


class Seam:
    """A frictionless block slides over the seam of a level floor: a crack in one body, and two bodies side by side."""

    name = "seam"
    SPEED, WITHIN = 0.5, 0.01  # m/s, share

    @staticmethod
    def mesh(split):
        mesh, seam = Mesh(), 0.04
        if split:
            mesh.box("floor", [0.01, 0, -0.01], [seam, 0.03, 0], [3, 3, 1], jitter=0.2, seed=1)
            mesh.box("floor", [seam, 0, -0.01], [0.07, 0.03, 0], [3, 3, 1], jitter=0.2, seed=2)
        else:
            mesh.box("floor", [0.01, 0, -0.01], [0.07, 0.03, 0], [6, 3, 1], jitter=0.2, seed=1, keep=[(0, seam)])
            mesh.surface("crack", lambda x: abs(x[0] - seam) < 1e-9)
        mesh.box("block", [0.027, 0.01, 1e-8], [0.037, 0.02, 0.01], [3, 3, 3], jitter=0.2, seed=3)
        mesh.surface("underside", lambda x: abs(x[2] + 0.01) < 1e-9)
        return mesh.text()

    def cases(self):
        cases = {}
        for split in (False, True):
            for points in (1, 3, 4, 6):
                law = [] if split else ["[[joint]]", 'group = "floor"', "tensile_strength = 1e6", "energy_mode_1 = 100",
                                        "[joints]", 'broken = ["crack"]']
                floor = material(["floor"], 20e6)
                floor[-1] = floor[-1] if split else 'joints = "breakable"'
                case = text(floor, material(["block"], 20e6), law, contact(["*", "*"], 20e6, "damping_ratio = 0.05"),
                            ["[contact_points]", f"per_face = {points}"],
                            thrown("block", [self.SPEED, 0, 0]), stage(0.035, [0, 0, -GRAVITY]), fixed("underside"),
                            output(5e-4, ["block"]))
                if not split:
                    case = case.replace("[mesh]\n", "[mesh]\nglue = true\n")
                cases[f"{'two floors' if split else 'crack'} {points}"] = (case, self.mesh(split))
        return cases

    def figures(self, results):
        figures = balance(results)
        for label, result in complete(results).items():
            speed = result["history"]["block velocity x"][-1]
            if abs(speed / self.SPEED - 1) > self.WITHIN:
                figures["failures"].append(f"{label}: {speed:.3f} m/s after the seam")
        return figures


class Platens:
    """Undamped platens strike or squeeze a block: many contacts of a few steps, and surfaces that turn under points."""

    name = "platens"

    @staticmethod
    def struck():
        mesh = Mesh()
        mesh.box("rock", [-0.01, 0, -0.01], [0.01, 0.04, 0.01], [3, 6, 3], jitter=0.2, seed=1)
        mesh.box("top", [-0.013, 0.040001, -0.013], [0.013, 0.046, 0.013], [3, 1, 3], jitter=0.2, seed=2)
        mesh.box("bottom", [-0.013, -0.006, -0.013], [0.013, -0.000001, 0.013], [3, 1, 3], jitter=0.2, seed=3)
        mesh.surface("drive", lambda x: abs(x[1] - 0.046) < 1e-9)
        mesh.surface("foot", lambda x: abs(x[1] + 0.006) < 1e-9)
        return mesh.text()

    @staticmethod
    def squeezed():
        mesh = Mesh()
        mesh.box("rock", [-0.01, 0, 0], [0.01, 0.02, 0.005], [4, 4, 1], jitter=0.2, seed=1)
        mesh.box("top", [-0.03, 0.020001, 0], [0.03, 0.030001, 0.005], [10, 2, 1], jitter=0.2, seed=2)
        mesh.box("bottom", [-0.03, -0.010001, 0], [0.03, -0.000001, 0.005], [10, 2, 1], jitter=0.2, seed=3)
        return mesh.text()

    def cases(self):
        cases = {}
        for friction in (0, 0.3):
            cases[f"struck {friction}"] = (text(
                material(["rock"], 30e9), material(["top", "bottom"], 200e9),
                contact(["*", "*"], 300e9, f"friction = {friction}"), stage(1), fixed("foot"),
                driven("drive", f"x = 0, z = 0, y = {ramp(0, 0, 20e-6, -0.5)}"),
                output(10e-6), limits=[*NO_LIMITS, "max_steps = 8000"]), self.struck())
        struck, mesh = cases["struck 0.3"]
        cases["struck, joints"] = (struck.replace('"none"', '"unbreakable"', 1).replace(
            "[[contact]]", '[[joint]]\ngroup = "rock"\npenalty_factor = 5\n[[contact]]', 1), mesh)
        cases["squeezed 0.3"] = (text(
            ["[plane]", 'kind = "strain"'], material(["rock", "top", "bottom"], 30e9),
            contact(["*", "*"], 30e9, "friction = 0.3"), stage(3e-3), fixed("bottom", "xy"),
            driven("top", f"x = 0, y = {ramp(0, 0, 1e-3, -2)}"), output(1e-4)), self.squeezed())
        return cases

    def figures(self, results):
        return balance(results)


class Debris:
    """Loose tetrahedra fall on a floor with the laws of meshes/cooling_tower: the cost of contact."""

    name = "debris"
    SIDE, CUBES = 2.3, 4  # m, -
    LAW = ['initial_overlap = "relax"', "plateau = 500e6", "unloading_exponent = 6", "friction = 0.6"]
    FLOOR = ["plateau = 5e6", "unloading_exponent = 4", "friction = 0.6", 'points_on = "first"']


    def __init__(self, time):
        self.time = time

    @staticmethod
    def counted():
        """The case whose instructions are counted: a short fall, with a line of the history for every step."""
        case, mesh = Debris(0.06).cases()["heap"]
        return case.replace("history_interval = ", "history_interval = 1e-9  # "), mesh

    def mesh(self):
        """Cubes of six loose tetrahedra each, turned at random, which fill most of the space."""
        mesh, rng, side = Mesh(), random.Random(7), self.SIDE
        mesh.box("floor", [-20, -20, -2], [20, 20, 0], [5, 5, 1], jitter=0.2, seed=1)
        cube = Mesh()
        cube.grid("cube", [1, 1, 1], lambda *index: [side * i for i in index])
        pitch = 1.3 * side
        for i, j, k in ((i, j, k) for k in range(self.CUBES) for j in range(self.CUBES) for i in range(self.CUBES)):
            turn = random_rotation(rng)
            place = [pitch * (n - 0.5 * (self.CUBES - 1)) for n in (i, j)] + [pitch * (k + 0.75)]
            for _, nodes in cube.elements:
                corners = [[x - side / 2 for x in cube.nodes[n]] for n in nodes]
                centre = [sum(c[axis] for c in corners) / 4 for axis in range(3)]
                shrunk = [[0.95 * (x - c) + c for x, c in zip(corner, centre)] for corner in corners]
                mesh.tetrahedron("debris", [[p + sum(a * b for a, b in zip(row, corner)) for p, row in zip(place, turn)]
                                            for corner in shrunk])
        return mesh.text()

    def cases(self):
        return {"heap": (text(
            material(["debris", "floor"], 35e9, density=2400, poisson=0.15),
            contact(["*", "floor"], 1.8e12, *self.FLOOR), contact(["*", "*"], 8.3e9, *self.LAW),
            thrown("debris", [0, 0, -30]), stage(self.time, [0, 0, -GRAVITY]), fixed("floor"),
            output(self.time / 200, ["debris"])), self.mesh())}

    def figures(self, results):
        figures = balance(results)
        for result in complete(results).values():
            if not result["history"]["debris centre z"][-1] > 0:
                figures["failures"].append("the heap is below the floor")
        return figures
