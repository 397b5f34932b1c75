"""Experiments on the surface: what happens must not depend on how it is cut into triangles."""

import random
from math import radians, tan

from cases import NO_LIMITS, at, balance, complete, contact, fixed, material, output, stage, text, thrown
from meshes import Mesh, random_rotation, turned


# Not broken by what happens here.
STRONG = ["[[joint]]", 'group = "*"', "penalty_factor = 30", "tensile_strength = 1e8", "shear_strength = 1e8",
          "energy_mode_1 = 1e7", "energy_mode_2 = 1e7"]


class Ball:
    """A ball falls straight on a flat plate without friction, turned and placed at random; every second one can break."""

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

    @classmethod
    def case(cls, breakable):
        bodies = material(["ball", "plate"], 1e9)
        if breakable:
            bodies = [*bodies[:-1], 'joints = "breakable"', *STRONG]
        return text(bodies, contact(["*", "*"], 1e9), thrown("ball", [0, 0, -cls.SPEED]), stage(8e-4),
                    fixed("underside"), output(1e-5, ["ball"]))

    def cases(self):
        return {f"R/{layers} {seed}": (self.case(seed % 2 == 0), self.mesh(layers, seed))
                for layers in self.LAYERS for seed in range(1, self.places + 1)}

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


class Oblique:
    """A ball strikes a flat plate with friction at an angle to its normal, turned and placed at random."""

    name = "oblique"
    FRICTION, POISSON, WITHIN = 0.3, 0.3, 0.03
    ANGLES, LAYERS = [20, 45, 70], 5

    def __init__(self, places):
        self.places = places

    @classmethod
    def impulse_along_plate(cls, slope):
        """Of a solid sphere on a half-space of the same material, over mass and normal speed; Hertz' force, and a
        tangential spring of Mindlin's stiffness that slips by Coulomb's law [Maw, Barber, Fawcett 1976].

        @param slope  of the velocity against the normal
        """
        softer = (2 - cls.POISSON) / (2 * (1 - cls.POISSON))  # normal stiffness over tangential stiffness
        step, depth, speed, sliding, force, impulse = 1e-4, 0.0, 1.0, slope, 0.0, 0.0
        while depth >= 0:
            depth += speed * step / 2
            normal = max(depth, 0) ** 1.5
            speed -= normal * step
            force -= 1.5 * max(depth, 0) ** 0.5 / softer * sliding * step
            force = max(-cls.FRICTION * normal, min(cls.FRICTION * normal, force))
            sliding += (1 + 5 / 2) * force * step
            impulse -= force * step
            depth += speed * step / 2
        return impulse

    def cases(self):
        bodies = material(["ball", "plate"], 1e9, poisson=self.POISSON)
        law = contact(["*", "*"], 1e9, f"friction = {self.FRICTION}")
        return {f"{angle} {seed}": (text(
            bodies, law, thrown("ball", [tan(radians(angle)) * Ball.SPEED, 0, -Ball.SPEED]), stage(8e-4),
            fixed("underside"), output(1e-5, ["ball"])), Ball.mesh(self.LAYERS, seed))
            for angle in self.ANGLES for seed in range(1, self.places + 1)}

    def figures(self, results):
        """The error of the mean over all places; of what slides throughout by its normal impulse, as the plate takes
        some energy away as vibrations."""
        figures, errors = balance(results), []
        for angle in self.ANGLES:
            slope = tan(radians(angle))
            along, normal = [], []
            for label, result in complete(results).items():
                if label.split()[0] == f"{angle}":
                    along.append(slope - result["history"]["ball velocity x"][-1] / Ball.SPEED)
                    normal.append(1 + result["history"]["ball velocity z"][-1] / Ball.SPEED)
            exact = self.impulse_along_plate(slope)
            if exact > 0.99 * 2 * self.FRICTION:
                exact = self.FRICTION * sum(normal) / len(normal)
            errors.append(abs(sum(along) / len(along) / exact - 1))
            if errors[-1] > self.WITHIN:
                figures["failures"].append(f"{angle} degrees: impulse along the plate {errors[-1]:.3f} off")
        return {**figures, "friction": max(errors)}


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
