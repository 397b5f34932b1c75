"""Experiments on the surface: what happens must not depend on how it is cut into triangles."""

import random

from cases import NO_LIMITS, at, balance, complete, contact, fixed, material, output, stage, text, thrown
from meshes import Mesh, random_rotation, turned


class Ball:
    """A ball falls straight on a flat plate without friction, turned and placed at random."""

    name = "ball"
    RADIUS, SPEED, WITHIN = 0.01, 1.0, 0.02
    LAYERS = [3]

    def __init__(self, places):
        self.places = places

    @classmethod
    def mesh(cls, layers, seed):
        mesh, rng, r = Mesh(), random.Random(seed), cls.RADIUS
        turn, cell = random_rotation(rng), r / layers
        mesh.ball("ball", [0, 0, 0], r, 2 * layers)
        mesh.nodes = [turned(x, turn) for x in mesh.nodes]
        lowest = min(z for _, _, z in mesh.nodes)
        place = [cell * rng.random(), cell * rng.random(), 1e-6 - lowest]
        mesh.nodes = [[a + b for a, b in zip(x, place)] for x in mesh.nodes]
        mesh.box("plate", [-r, -r, -r / 2], [r, r, 0], [2 * layers, 2 * layers, 2], jitter=0.2, seed=seed)
        mesh.surface("underside", lambda x: abs(x[2] + r / 2) < 1e-9)
        return mesh.text()

    def cases(self):
        return {f"R/{layers} {seed}": (text(
            material(["ball", "plate"], 1e9), contact(["*", "*"], 1e9),
            thrown("ball", [0, 0, -self.SPEED]), stage(8e-4), fixed("underside"), output(1e-5, ["ball"])),
            self.mesh(layers, seed)) for layers in self.LAYERS for seed in range(1, self.places + 1)}

    def figures(self, results):
        figures = balance(results)
        sideways = 0
        for label, result in complete(results).items():
            x, y = (result["history"][f"ball velocity {axis}"][-1] / self.SPEED for axis in "xy")
            speed = (x * x + y * y) ** 0.5
            sideways = max(sideways, speed)
            if speed > self.WITHIN:
                figures["failures"].append(f"{label}: {speed:.3f} of its momentum sideways")
        return {**figures, "sideways": sideways}


class Cubes:
    """Elastic cubes without friction in a closed box: nothing may be lost, and nothing counted as inelastic."""

    name = "cubes"
    SIDE, BOX, WITHIN = 0.01, 0.04, 1e-3

    def __init__(self, seeds, end):
        self.seeds, self.end = seeds, end

    @classmethod
    def mesh(cls, seed):
        mesh, rng, b, t = Mesh(), random.Random(seed), cls.BOX, 0.005
        for axis in range(3):
            for n, low in enumerate((-t, b)):
                lower, upper = [-t] * 3, [b + t] * 3
                lower[axis], upper[axis] = low, low + t
                cells = [8, 8, 8]
                cells[axis] = 1
                mesh.box("wall", lower, upper, cells, jitter=0.2, seed=10 * axis + n)
        for n in range(8):
            centre = [b / 2 * ((n >> axis & 1) + 0.5) for axis in range(3)]
            mesh.turned_box("cube", centre, [cls.SIDE] * 3, [2, 2, 2], random_rotation(rng))
        return mesh.text()

    def cases(self):
        cases = {}
        for seed in range(1, self.seeds + 1):
            cases[f"{seed}"] = (text(
                material(["cube", "wall"], 20e6), contact(["cube", "cube"], 20e6), contact(["cube", "wall"], 20e6),
                ["[[initial_velocity]]", 'group = "cube"', "random = [0, 5]", f"seed = {seed}"],
                stage(self.end), fixed("wall"), output(self.end / 200)), self.mesh(seed))
        return cases

    def figures(self, results):
        figures = balance(results)
        for label, result in complete(results).items():
            history = result["history"]
            inelastic = history["dissipated"][-1] / history["kinetic"][0]
            lost = max(map(abs, history["residual"])) / history["kinetic"][0]
            if lost > self.WITHIN:
                figures["failures"].append(f"{label}: residual {lost:.2g} of the energy")
            if inelastic > self.WITHIN:
                figures["failures"].append(f"{label}: {inelastic:.2g} of the energy counted as inelastic")
        return figures
