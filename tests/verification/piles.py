"""Random piles of boxes, half of which can break, that strike each other in a sphere, side by side or turned any way: none gains energy at the default time step
(random_runs.py says what each must show).

usage: piles.py BRECCIA FOLDER SEED... [--count N] [--jobs N] [--steps MULTIPLE]
"""

import random_runs
from fragmentations import number

WHOLE = 'joints = "none"'


def breakable(rng, young, size, stress):
    """The material's last line and joints of a strength near the stress of an impact."""
    strength, factor = number(rng, 0.1, 3) * stress, 30
    opening = max(number(rng, 3e-4, 3e-3), 4 * strength / (factor * young)) * size
    return ['joints = "breakable"', "[[joint]]", 'group = "box"', f"penalty_factor = {factor}", f"tensile_strength = {strength}",
            f"shear_strength = {2 * strength}", f"energy_mode_1 = {strength * opening}", f"energy_mode_2 = {6 * strength * opening}",
            f"friction = {rng.choice([0, 0.3])}"]


def text_of(rng, arguments, harder):  # need not break, however hard they strike
    size, young, density = number(rng, 1e-3, 0.1), number(rng, 4e6, 2e11), number(rng, 450, 8000)
    boxes, cells = [rng.choice([2, 3]), 2, rng.choice([1, 2])], rng.choice([1, 2])
    turned = rng.random() < 0.5
    width = cells * size
    # Boxes in rows touch, or nearly, so that their edges are right above each other.
    gap = width if turned else rng.choice([0, number(rng, 0.001, 0.2) * width])
    extent = max(boxes) * (width + gap)
    speed = number(rng, 0.002, 0.02) * (young / density) ** 0.5
    plateau = rng.choice([0, 0, young / 200])
    points, friction = rng.choice([3, 4, 6]), rng.choice([0, 0.3, 0.6])
    duration = float(f"{arguments.steps * number(rng, 5, 15) * width / speed:.3g}")
    lines = [f'title = "pile: {"turned" if turned else "in rows"}, {points} points a face, friction {friction}{", plateau" if plateau else ""}"',
             "[mesh.raster]", f"cells = {cells}", f"cell_size = {size}", f"boxes = {boxes}", f"gap = {[gap] * 3}", 'group = "box"',
             f"random_orientation = {str(turned).lower()}", f"seed = {rng.randrange(1, 1000)}",
             "[[material]]", 'group = "box"', f"young = {young}", f"poisson = {rng.choice([0, 0.2, 0.35])}", f"density = {density}", WHOLE,
             "[[contact]]", 'between = ["*", "*"]', f"penalty = {young * number(rng, 0.3, 3)}", f"friction = {friction}", f"plateau = {plateau}",
             f"unloading_exponent = {rng.choice([1, 3]) if plateau else 1}", 'initial_overlap = "relax"',
             "[contact_points]", f"per_face = {points}",
             "[sphere]", f"centre = {[0.5 * n * (width + gap) for n in boxes]}", f"radius = {1.2 * extent}", f"penalty = {young}",
             "[[initial_velocity]]", 'group = "box"', f"random = [{0.2 * speed}, {speed}]", f"seed = {rng.randrange(1, 1000)}",
             "[[stage]]", 'name = "all"', f"end = {duration}"]
    if rng.random() < 0.5:
        lines.append(f"gravity = [0, 0, {-speed ** 2 / extent}]")
    if rng.random() < 0.5:
        place = lines.index(WHOLE)
        lines[place:place + 1] = breakable(rng, young, size, speed * (young * density) ** 0.5)
    lines += ["[output]", "frame_interval = 0", f"history_interval = {duration / 1000}"]
    return "\n".join(lines) + "\n", ""


if __name__ == "__main__":
    random_runs.main(text_of, __doc__.splitlines()[0])
