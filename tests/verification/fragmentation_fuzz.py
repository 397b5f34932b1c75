"""Random small blocks that burst, are torn, blasted or thrown at each other: none ends in an error, gains energy, or takes back what it
dissipated. The seed of a case is its number, so that a failure can be repeated.

usage: fragmentation_fuzz.py BRECCIA FOLDER FIRST COUNT

Prints a line a case and exits with 1 if any failed. For each: exit code 0; no dissipated term ever falls in
history.csv; at no line is there more energy than what there was at first and was put in (but for GAIN, a share of the largest term).
"""

import csv
import pathlib
import random
import subprocess
import sys

GAIN = 0.001  # of the largest term
DISSIPATED = ["joint mode 1 [J]", "joint mode 2 [J]", "joint friction [J]", "viscous [J]", "contact dissipated [J]", "contact friction [J]"]
STORED = ["kinetic [J]", "elastic [J]", "joint elastic [J]", "contact stored [J]"]
STEPS = 6000
YOUNG, DENSITY, POISSON = 26e9, 2600.0, 0.2
SIZE = 0.01  # m, cell


def joint_lines(rng):
    law = rng.choice(["mixed_mode", "mixed_mode", "independent_peaks"])
    points = rng.choice(["nodal", "nodal", "mid_edge"])
    friction = rng.choice([0, 0, 0.3, 0.8])
    parabolic = law == "independent_peaks" and rng.random() < 0.3
    factor = rng.choice([10, 50, 100])
    lines = ["[[joint]]", 'group = "block"', f"penalty_factor = {factor}", f'tensile_strength = "{rng.choice([1, 3, 6])} MPa"',
             f'shear_strength = "{rng.choice([2, 5, 12])} MPa"', f"energy_mode_1 = {rng.choice([20, 30, 100])}",
             f"energy_mode_2 = {rng.choice([40, 100, 300])}", f'law = "{law}"', f'points = "{points}"',
             f"points_to_fail = {rng.choice([1, 2, 3, 3])}", f'softening = {{ kind = "{rng.choice(["z_curve", "linear", "exponential"])}" }}']
    if parabolic:
        lines.append('rise = "parabolic"')
    elif friction:
        lines.append(f"friction = {friction}")
    return lines, factor


def step_of(factor, contact):
    """A step below the bound of joints and contact whatever their points or law (all joints stiff on a corner, as for nodal points).

    Bound: omega^2 = 4 c^2 sum h^-2 + 2 * 3 k A/3 / (m/4) + contact, with k = factor E / h for the raster's tetrahedra.
    """
    volume, area, height = SIZE**3 / 24, SIZE**2 / 4, SIZE / 4
    mass = DENSITY * volume / 4
    joint = 2 * 3 * factor * YOUNG / (0.35 * SIZE) * area / 3 / mass
    element = 4 * YOUNG * 1.2 / DENSITY * 4 / height**2
    touch = (10 * YOUNG / SIZE) * area * 16 / mass if contact else 0
    return 0.8 * 2 / (element + joint + touch) ** 0.5


def case_text(seed):
    rng = random.Random(seed)
    kind = rng.choice(["burst", "tear", "blast", "impact"])
    contact = kind == "impact" or rng.random() < 0.6
    cells = [rng.randint(2, 4 if kind != "impact" else 3) for _ in range(3)]
    joint, factor = joint_lines(rng)
    step = step_of(factor, contact)
    lines = [f'title = "fragmentation {seed}: {kind}"', "[mesh.raster]", f"cells = {cells}", f'cell_size = {SIZE}', 'group = "block"']
    lines += ["[[material]]", 'group = "block"', f"young = {YOUNG}", f"poisson = {POISSON}", f"density = {DENSITY}", 'joints = "breakable"']
    lines += joint
    if contact:
        lines += ["[[contact]]", 'between = ["*", "*"]', f"penalty = {10 * YOUNG}", f"friction = {rng.choice([0, 0.3, 0.6])}"]
    spin = [rng.uniform(-1, 1) * 4000 for _ in range(3)]
    fly = [rng.uniform(-20, 20) for _ in range(3)]
    if kind == "burst":
        lines += ["[[initial_velocity]]", 'group = "block"', f"velocity = {fly}", f"angular = {spin}"]
    lines += ["[[stage]]", 'name = "all"', f"end = {STEPS * step}"]
    speed = [rng.uniform(-1, 1) * 20 for _ in range(3)]
    motion = f"velocity = {{ x = {abs(speed[0])}, y = {speed[1]}, z = {speed[2]} }}"
    if kind == "tear":
        lines += ["[[stage.constraint]]", 'group = "block.x0"', 'fixed = "xyz"', "[[stage.constraint]]", 'group = "block.x1"', motion]
    elif kind == "impact":
        crush = f"velocity = {{ x = {-rng.uniform(5, 40)}, y = {speed[1]}, z = {speed[2]} }}"
        lines += ["[[stage.constraint]]", 'group = "block.x0"', 'fixed = "xyz"', "[[stage.constraint]]", 'group = "block.x1"', crush]
    elif kind == "blast":
        pressure = rng.uniform(5e6, 1e8)
        end = STEPS * step * rng.uniform(0.02, 0.2)
        ramp = f"{{ ramp = {{ from = {-pressure}, to = 0, start = 0, end = {end} }} }}"
        lines += ["[[stage.pressure]]", f'surface = "block.{rng.choice(["x0", "y1", "z0"])}"', f"value = {ramp}"]
    lines += ["[time]", f"step = {step}", "[output]", "frame_interval = 0", f"history_interval = {STEPS * step / 300}"]
    return kind, "\n".join(lines) + "\n"


def problems_of(folder):
    """What is wrong with a run's history."""
    found, before, first = [], None, None
    with open(folder / "history.csv", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            number = {key: float(value) for key, value in row.items()}
            scale = max(abs(number[key]) for key in STORED + DISSIPATED + ["external work [J]"]) or 1.0
            held = sum(number[key] for key in STORED)
            given = number["external work [J]"]
            first = held - given if first is None else first
            if held - first - given > GAIN * scale:
                found.append(f"t = {number['time [s]']:.3e}: {held:.4g} J of {first + given:.4g} J put in")
            if before:
                found += [f"t = {number['time [s]']:.3e}: {key} falls from {before[key]:.9g} to {number[key]:.9g}"
                          for key in DISSIPATED if number[key] < before[key] - 1e-12 * abs(before[key])]
            before = number
    return found, (before or {})


def run(breccia, folder, seed):
    kind, text = case_text(seed)
    folder.mkdir(parents=True, exist_ok=True)
    case = folder / f"{seed}.toml"
    case.write_text(text, encoding="utf-8")
    out = folder / str(seed)
    done = subprocess.run([breccia, "run", str(case), "-f", "-o", str(out), "--set", "time.residual_limit=1000",
                           "--set", "time.energy_gain_limit=1000"],
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return kind, [f"exit {done.returncode}: {(done.stdout + done.stderr).strip()[-300:]}"], {}
    found, last = problems_of(out)
    return kind, found, last


def main():
    breccia, folder, first, count = sys.argv[1], pathlib.Path(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4])
    failed = 0
    for seed in range(first, first + count):
        kind, found, last = run(breccia, folder, seed)
        summary = f"{last.get('broken joints', 0):.0f} broken, {last.get('fragments', 0):.0f} fragments, residual {last.get('relative residual', 0):.1e}"
        print(f"{seed} {kind}: {summary}{'' if not found else ': ' + found[0]}", flush=True)
        failed += bool(found)
    print(f"{count} cases, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
