"""Random relatives of a cube that is pulled a little and let go, whose joints are damaged and open and close ever after: none gains
energy at the default time step (random_runs.py says what each must show).

usage: relatives.py BRECCIA FOLDER SEED... [--count N] [--jobs N] [--steps MULTIPLE]
"""

import random_runs
from fragmentations import number

STEPS = 5000
KUHN = [(1, 3), (3, 2), (2, 6), (6, 4), (4, 5), (5, 1)]  # corners of a cube, by bits of x, y, z, that go with 0 and 7 round its diagonal


def mesh_text(cells, size):
    """Cubes of six tetrahedra in two groups by turns along x, that share nodes within a layer and are glued between layers (msh 2.2)."""
    def node(i, j, k):
        return 1 + i + (cells[0] + 1) * (j + (cells[1] + 1) * k)

    counts = [range(n + 1) for n in cells]
    nodes = [f"{node(i, j, k)} {i * size} {j * size} {k * size}" for k in counts[2] for j in counts[1] for i in counts[0]]
    elements = []
    for i, j, k in ((i, j, k) for k in range(cells[2]) for j in range(cells[1]) for i in range(cells[0])):
        corner = [node(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)) for c in range(8)]
        group = 1 + i % 2
        elements += [f"4 2 {group} {group} {corner[0]} {corner[b]} {corner[a]} {corner[7]}" for a, b in KUHN]
        for side, x in ((3, 0), (4, 1)):
            if i == (cells[0] - 1 if x else 0):
                a, b, c, d = (corner[x + y + z] for y, z in ((0, 0), (2, 0), (2, 4), (0, 4)))
                elements += [f"2 2 {side} {side} {a} {b} {c}", f"2 2 {side} {side} {a} {c} {d}"]
    names = ['3 1 "box"', '3 2 "lid"', '2 3 "box.x0"', '2 4 "box.x1"']
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names)), *names, "$EndPhysicalNames"]
    lines += ["$Nodes", str(len(nodes)), *nodes, "$EndNodes"]
    lines += ["$Elements", str(len(elements)), *(f"{n} {e}" for n, e in enumerate(elements, 1)), "$EndElements"]
    return "\n".join(lines) + "\n"


def joint_lines(rng, young, size, group, factor, strength):
    law = rng.choice(["mixed_mode", "independent_peaks"])
    shear = strength * rng.choice([0.5, 1, 2, 4])
    opening = number(rng, 0.003, 0.03) * size  # at which a joint breaks
    least = 4 * strength / (factor * young) * 0.85 * size * max(1, shear / strength)
    energy = strength * max(opening, least)
    lines = ["[[joint]]", group, f'law = "{law}"', f'points = "{rng.choice(["nodal", "nodal", "mid_edge"])}"',
             f"penalty_factor = {factor}", f"tensile_strength = {strength}", f"shear_strength = {shear}", f"energy_mode_1 = {energy}",
             f"energy_mode_2 = {energy * shear / strength * rng.choice([1, 3])}", f"points_to_fail = {rng.choice([1, 2, 3])}",
             f'softening = {{ kind = "{rng.choice(["z_curve", "linear", "exponential"])}" }}']
    if law == "independent_peaks" and rng.random() < 0.3:
        lines.append('rise = "parabolic"')
    else:
        lines.append(f"friction = {rng.choice([0, 0, 0.3, 0.8])}")
    return lines


def text_of(rng, arguments, harder):
    size, young, density = number(rng, 1e-3, 0.1), number(rng, 4e6, 2e11), number(rng, 450, 8000)
    cells = [rng.randint(2, 4) for _ in range(3)]
    strength, factor = number(rng, 3e-4, 3e-3) * young, rng.choice([3, 10, 30, 100])
    shared = rng.random() < 0.3
    mesh = ""
    if shared:
        mesh = mesh_text(cells, size)
        lines = ["[mesh]", 'file = "MESH"', "glue = true"]
    else:
        lines = ["[mesh.raster]", f"cells = {cells}", f"cell_size = {size}", 'group = "box"']
    poisson = rng.choice([0, 0.2, 0.3, 0.45])
    for group in ["box", "lid"] if shared else ["box"]:
        lines += ["[[material]]", f'group = "{group}"', f"young = {young}", f"poisson = {poisson}", f"density = {density}",
                  f'joints = "{("none" if group == "box" else "unbreakable") if shared else "breakable"}"']
    lines += joint_lines(rng, young, size, 'between = ["box", "lid"]' if shared else 'group = "box"', factor, strength)
    speed = (young / density) ** 0.5
    wave_time = 4 * size / speed
    step = 0.1 * size / speed / (1 if shared else (1 + factor / 4) ** 0.5)  # about the default one
    pull = number(rng, 0.3, 4) * strength / young * speed * 2**harder
    pulled = number(rng, 1, 30) * wave_time
    axis = rng.choice(["x", "x", "y"])
    if rng.random() < 0.3:
        lines += ["[[contact]]", 'between = ["*", "*"]', f"penalty = {rng.choice([0.1, 1, 10]) * young}", f"friction = {rng.choice([0, 0.3])}"]
    if rng.random() < 0.3:
        lines += ["[[initial_velocity]]", 'group = "box"', f"angular = [{pull / size}, 0, {-pull / size}]"]
    duration = pulled + arguments.steps * STEPS * step
    lines += ["[[stage]]", 'name = "pull"', f"end = {pulled}", "[[stage.constraint]]", 'group = "box.x0"', f'fixed = "{axis}"',
              "[[stage.constraint]]", 'group = "box.x1"', f"velocity = {{ {axis} = {pull} }}"]
    lines += ["[[stage]]", 'name = "free"', f"end = {duration}"]
    lines += ["[output]", "frame_interval = 0", f"history_interval = {duration / 500}"]
    return "\n".join([f'title = "relative: {"shared" if shared else "own"} nodes"', *lines]) + "\n", mesh


if __name__ == "__main__":
    random_runs.main(text_of, __doc__.splitlines()[0])
