"""The contact detection laboratory: runs bench_detection_lab, fits its times as the thesis does, and draws its figures.

usage: detection.py PROGRAM FOLDER [arguments of bench_detection_lab: --largest, --repeat, --budget, --experiments, --scene, --no-peers, ...]

Reads FOLDER/equal_size.csv, memory_order.csv and points.csv; writes FOLDER/fits.csv and one SVG and PNG a figure where gnuplot is there.
"""

import csv
import math
import shutil
import subprocess
import sys
from pathlib import Path

FIGURES = {"I": "7.2", "II": "7.5", "III": "7.8", "IV": "7.10", "V": "7.12", "VI": "7.15"}
SMALLEST_FITTED = 100_000  # the exponent of smaller sets is that of the caches

PLOT = """set terminal {terminal}
set output "{name}.{suffix}"
set datafile separator ","
set logscale xy
set title "{title}" noenhanced
set xlabel "{x}"
set ylabel "{y}"
set key outside noenhanced
set grid
set yrange [*:*]
plot {curves}
"""
TERMINALS = {"svg": 'svg size 900,600 background "white"', "png": "png size 900,600"}


def read(file):
    if not file.exists():
        return []
    with open(file, newline="") as stream:
        return list(csv.DictReader(stream))


def slope(points):
    """Exponent p of t = a N^p: least squares in logarithms."""
    x, y = zip(*((math.log(n), math.log(t)) for n, t in points))
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    return sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / sum((a - mean_x) ** 2 for a in x)


def fit_of(points, shape):
    """a of t = a shape(N) by least squares as eq. (7.9), and the largest relative deviation of a point from it."""
    a = sum(t * shape(n) for n, t in points) / sum(shape(n) ** 2 for n, _ in points)
    return a, max(abs(a * shape(n) / t - 1) for n, t in points)


def series(rows, experiment, x="bodies"):
    """Algorithm -> its points in ascending order of x."""
    result = {}
    for row in rows:
        if row["experiment"] == experiment:
            result.setdefault(row["algorithm"], []).append((int(row[x]), float(row["least_s"])))
    return {name: sorted(points) for name, points in result.items()}


def fits(rows):
    """One row an experiment and algorithm: the exponent and the fits of N, N log N and N^2."""
    shapes = {"n": lambda n: n, "n_log_n": lambda n: n * math.log(n), "n2": lambda n: n * n}
    for experiment in FIGURES:
        if experiment == "II":
            continue
        for name, points in series(rows, experiment).items():
            large = [p for p in points if p[0] >= 0.9 * SMALLEST_FITTED]
            fitted = large if len(large) > 1 else points
            if len(fitted) < 2:
                continue
            row = {"experiment": experiment, "algorithm": name, "from": fitted[0][0], "to": fitted[-1][0],
                   "exponent": f"{slope(fitted):.3f}"}
            for label, shape in shapes.items():
                a, deviation = fit_of(fitted, shape)
                row |= {f"{label}_s": f"{a:.3e}", f"{label}_deviation": f"{deviation:.2f}"}
            yield row


def draw(folder, name, curves, title, x, y):
    """curves: label -> points."""
    if not curves or not shutil.which("gnuplot"):
        return
    lines = []
    for label, points in curves.items():
        data = f"{name}_{label}.dat"
        (folder / data).write_text("".join(f"{a},{b}\n" for a, b in points))
        lines.append(f'"{data}" with linespoints title "{label}"')
    for suffix, terminal in TERMINALS.items():
        (folder / f"{name}.gp").write_text(PLOT.format(terminal=terminal, name=name, suffix=suffix, title=title, x=x, y=y, curves=", \\\n  ".join(lines)))
        subprocess.run(["gnuplot", f"{name}.gp"], cwd=folder, check=True)


def draw_all(folder, rows):
    time = "processor time of ten detections, s"
    for experiment, figure in FIGURES.items():
        x = "spacing" if experiment == "II" else "bodies"
        label = "spacing, cells (density 1 / spacing^3)" if experiment == "II" else "bodies"
        draw(folder, f"experiment_{experiment}", series(rows, experiment, x), f"Experiment {experiment} (figure {figure} of the thesis)", label, time)
    memory = read(folder / "memory_order.csv")
    draw(folder, "experiment_VII", {label: [(int(r["entries"]), float(r[column])) for r in memory] for label, column in (
        ("A_one_behind_the_other", "one_behind_the_other_ns"), ("B_interleaved", "interleaved_ns")) if memory},
        "Experiment VII (figure 7.19 of the thesis)", "entries", "ns an entry")
    points = {}
    for row in read(folder / "points.csv"):
        if row["scene"].startswith("sizes 1:"):
            points.setdefault(row["algorithm"], []).append((int(row["scene"].split(":")[1]), float(row["least_s"])))
    draw(folder, "points", points, "Four million points against a million tetrahedra, or as many as were asked for", "largest size / smallest size", "processor time, s")


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    program, folder = sys.argv[1], Path(sys.argv[2])
    subprocess.run([program, "--folder", folder, *sys.argv[3:]], check=True)
    rows = read(folder / "equal_size.csv")
    table = list(fits(rows))
    if table:
        with open(folder / "fits.csv", "w", newline="") as stream:
            writer = csv.DictWriter(stream, fieldnames=list(table[0]))
            writer.writeheader()
            writer.writerows(table)
        print(f"\n{'experiment':11}{'algorithm':15}{'bodies':>20}  exponent   largest deviation from a N, a N log N, a N^2")
        for r in table:
            print(f"{r['experiment']:11}{r['algorithm']:15}{r['from']:>9} to{r['to']:>9} {r['exponent']:>8} {r['n_deviation']:>9} {r['n_log_n_deviation']:>6} {r['n2_deviation']:>6}")
    draw_all(folder, rows)


if __name__ == "__main__":
    try:
        main()
    except subprocess.CalledProcessError as error:
        sys.exit(error.returncode)
