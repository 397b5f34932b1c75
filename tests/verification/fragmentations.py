"""Random small blocks that are blown up, spun, torn, and thrown at each other, into 20 fragments or more, at the default time step
(random_runs.py says what each must show).

usage: fragmentations.py BRECCIA FOLDER SEED... [--count N] [--jobs N]
"""

import random_runs

FRAGMENTS = 20


def number(rng, low, high):
    """Between low and high, alike likely in every decade."""
    return float(f"{low * (high / low) ** rng.random():.3g}")


def block_lines(rng, size, cells, boxes, young, density, poisson):
    lines = ["[mesh.raster]", f"cells = {cells}", f"cell_size = {size}", f"boxes = {boxes}", 'group = "block"']
    if boxes[0] > 1:
        lines.append(f"gap = [{rng.choice([0.02, 0.2]) * size}, 0, 0]")
    lines += ["[[material]]", 'group = "block"', f"young = {young}", f"poisson = {poisson}", f"density = {density}", 'joints = "breakable"']
    return lines


def joint_lines(rng, young, size):
    """Every law and rule of points. The energy is that of a critical opening of a share of an element's edge."""
    law = rng.choice(["mixed_mode", "independent_peaks"])
    parabolic = law == "independent_peaks" and rng.random() < 0.3
    strength = number(rng, 3e-5, 3e-4) * young
    factor = rng.choice([10, 30, 100])
    shear = strength * rng.choice([1, 2, 4])
    size_of_joint = 0.85 * size
    least = 1.5 * strength / (factor * young) * size_of_joint  # the opening at the peak of the stiffest curve
    opening = max(number(rng, 3e-4, 3e-3) * size, 3 * least, 3 * least * shear / strength)
    energy_1 = strength * opening
    lines = ["[[joint]]", 'group = "block"', f'law = "{law}"', f'points = "{rng.choice(["nodal", "mid_edge"])}"',
             f"penalty_factor = {factor}", f"tensile_strength = {strength}", f"shear_strength = {shear}", f"energy_mode_1 = {energy_1}",
             f"energy_mode_2 = {energy_1 * shear / strength * rng.choice([1, 3])}", f"points_to_fail = {rng.choice([1, 2, 3, 3])}",
             f'energy_counts = "{rng.choice(["whole_curve", "softening_branch"])}"',
             f'softening = {{ kind = "{rng.choice(["z_curve", "linear", "exponential"])}" }}']
    if parabolic:
        lines.append('rise = "parabolic"')
    else:
        lines.append(f"friction = {rng.choice([0, 0, 0.3, 0.8])}")
    return lines, strength, energy_1


def contact_lines(rng, young):
    lines = ["[[contact]]", 'between = ["*", "*"]', f"penalty = {rng.choice([0.1, 1, 1, 10]) * young}",
             f"friction = {rng.choice([0, 0.3, 0.6])}", f"tangential_ratio = {rng.choice([1, 0.8])}",
             f"damping_ratio = {rng.choice([0, 0, 0.2])}", f"unloading_exponent = {rng.choice([1, 1, 2])}", "[contact_points]",
             f"per_face = {rng.choice([1, 3, 3, 4, 6])}", f'field = "{rng.choice(["body", "body", "tet_potential", "tet_distance"])}"']
    return lines


def motion_lines(rng, kind, speed, length, wave_time, strength):
    """Loads. @param speed  m/s, at which what moves could break all joints.  @return  what is given before the stage, and within it"""
    def signed(low, high):
        return rng.choice([-1, 1]) * number(rng, low, high)

    def held(x, y, z):
        return ["[[stage.constraint]]", 'group = "block.x0"', 'fixed = "xyz"', "[[stage.constraint]]", 'group = "block.x1"',
                f"velocity = {{ x = {x}, y = {y}, z = {z} }}"]

    if kind == "spin":
        spin = [signed(1, 4) * speed / length for _ in range(3)]
        return ["[[initial_velocity]]", 'group = "block"', f"velocity = {[signed(0.1, 1) * speed for _ in range(3)]}", f"angular = {spin}"], []
    if kind == "impact":
        turn = [signed(0.1, 1) * speed / length for _ in range(3)]
        return ["[[initial_velocity]]", 'group = "block"', f"random = [{2 * speed}, {4 * speed}]", f"seed = {rng.randrange(1, 1000)}",
                f"angular = {turn}"], []
    pull = number(rng, 0.1, 1) * speed
    if kind == "tear":
        return [], held(pull, signed(0.1, 3) * pull, signed(0.01, 1) * pull)
    if kind == "crush":
        return [], held(-pull, signed(0.01, 0.3) * pull, signed(0.01, 0.3) * pull)
    ramp = f"{{ ramp = {{ from = {number(rng, 3, 30) * strength}, to = 0, start = 0, end = {number(rng, 1, 10) * wave_time} }} }}"
    within = []
    for surface in rng.sample(["x0", "x1", "y0", "y1", "z0", "z1"], rng.choice([1, 2])):
        within += ["[[stage.pressure]]", f'surface = "block.{surface}"', f"value = {ramp}"]
    return [], within


def text_of(rng, arguments, harder):
    kind = rng.choice(["spin", "tear", "blast", "impact", "crush"])
    size, young, density = number(rng, 1e-3, 0.1), number(rng, 4e6, 2e11), number(rng, 450, 8000)
    boxes = [rng.choice([2, 2, 3]), 1, 1] if kind == "impact" else [1, 1, 1]
    cells = [rng.randint(2, 3 if kind == "impact" else 4) for _ in range(3)]
    while 24 * cells[0] * cells[1] * cells[2] * boxes[0] > 900:
        cells[rng.randrange(3)] -= 1
    joints, strength, energy = joint_lines(rng, young, size)
    length = max(cells) * size
    wave_time = length / (young / density) ** 0.5
    load = 2 ** harder
    speed = load * max(strength / density, 20 * energy / (density * size)) ** 0.5
    before, within = motion_lines(rng, kind, speed, length, wave_time, load * strength)
    contact = kind == "impact" or rng.random() < 0.6
    duration = float(f"{arguments.steps * number(rng, 20, 40) * wave_time:.3g}")
    lines = [f'title = "fragmentation: {kind}{", contact" if contact else ""}"', *block_lines(
        rng, size, cells, boxes, young, density, rng.choice([0, 0.2, 0.3, 0.4])), *joints]
    lines += contact_lines(rng, young) if contact else []
    lines += [*before, "[[stage]]", 'name = "all"', f"end = {duration}", *within]
    lines += ["[output]", "frame_interval = 0", f"history_interval = {duration / 1000}"]
    return "\n".join(lines) + "\n", ""


if __name__ == "__main__":
    random_runs.main(text_of, __doc__.splitlines()[0], FRAGMENTS)
