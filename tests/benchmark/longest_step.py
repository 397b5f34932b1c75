#!/usr/bin/env python3
"""The longest step that survives, against the one that the program chooses.

For small models of every kind a bisection on time.step: a step survives when the run does its 20,000 steps (or comes
to its end), is never stopped, breaks no joint (no load here does, but for the tower that falls), and has created no
energy: the residual of the budget is at most 2 % of the largest term.
The program's step is what `breccia check` prints, at time.safety = 1.

    longest_step.py BRECCIA [--work FOLDER] [--steps N] [CASE ...]
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys

MESHES = pathlib.Path(__file__).resolve().parent.parent.parent / "meshes"
RESOLUTION = 1.04  # of the bisection
RESIDUAL = 0.02

ROCK = 'young = "30 GPa"\npoisson = 0.2\ndensity = 2500\n'
SOFT = 'young = "3 GPa"\npoisson = 0.3\ndensity = 1200\n'
STRONG = 'tensile_strength = "300 MPa"\nshear_strength = "600 MPa"\nenergy_mode_1 = "2 MJ/m2"\n'


def raster(n=4, more=""):
    return f'[mesh.raster]\ncells = {n}\ncell_size = "10 mm"\ngroup = "block"\n{more}\n'


def material(group, text, joints):
    return f'[[material]]\ngroup = "{group}"\n{text}joints = "{joints}"\n'


def joint(group, more="", factor=50):
    between = f'between = {json.dumps(group)}' if isinstance(group, list) else f'group = "{group}"'
    return f'[[joint]]\n{between}\npenalty_factor = {factor}\n{STRONG}{more}\n'


# Pulled on one end for a while, held on the other.
PULL = '''[[stage]]
name = "pull"
end = 1
[[stage.constraint]]
group = "block.x0"
fixed = "xyz"
[[stage.constraint]]
group = "block.x1"
velocity = { x = { ramp = { from = "10 mm/s", to = 0, start = 0, end = "1 us" } } }
'''
WEIGHT = '''[[stage]]
name = "weight"
end = 1
gravity = [0, 0, -9.81]
[[stage.constraint]]
group = "foot"
fixed = "xyz"
'''
GEO = {
    "graded.geo": '''SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 0.1, 0.1, 0.1};
Physical Volume("block") = {1};
foot() = Surface In BoundingBox{-1, -1, -1e-6, 1, 1, 1e-6};
Physical Surface("foot") = {foot()};
MeshSize{ PointsOf{ Volume{1}; } } = 0.04;
top() = Point In BoundingBox{0.09, 0.09, 0.09, 0.11, 0.11, 0.11};
MeshSize{ top() } = 0.003;
''',
    "slivers.geo": '''SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 0.1, 0.1, 0.1};
Box(2) = {0, 0, 0.1, 0.1, 0.1, 0.003};
v() = BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; };
Physical Volume("block") = {v()};
foot() = Surface In BoundingBox{-1, -1, -1e-6, 1, 1, 1e-6};
Physical Surface("foot") = {foot()};
MeshSize{ PointsOf{ Volume{:}; } } = 0.02;
Mesh.Optimize = 0;
''',
    "two.geo": '''SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 0.1, 0.1, 0.05};
Box(2) = {0, 0, 0.05, 0.1, 0.1, 0.05};
v() = BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; };
Physical Volume("lower") = {1};
Physical Volume("upper") = {2};
foot() = Surface In BoundingBox{-1, -1, -1e-6, 1, 1, 1e-6};
Physical Surface("foot") = {foot()};
MeshSize{ PointsOf{ Volume{:}; } } = 0.02;
''',
    "boxes.geo": '''SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 0.1, 0.1, 0.05};
Box(2) = {0.013, 0.017, 0.05001, 0.07, 0.07, 0.05};
Physical Volume("lower") = {1};
Physical Volume("upper") = {2};
foot() = Surface In BoundingBox{-1, -1, -1e-6, 1, 1, 1e-6};
Physical Surface("foot") = {foot()};
MeshSize{ PointsOf{ Volume{1}; } } = 0.02;
MeshSize{ PointsOf{ Volume{2}; } } = 0.015;
''',
    "platens.geo": '''SetFactory("OpenCASCADE");
Box(1) = {-0.01, 0, -0.01, 0.02, 0.04, 0.02};
Box(2) = {-0.013, 0.040001, -0.013, 0.026, 0.006, 0.026};
Box(3) = {-0.013, -0.006001, -0.013, 0.026, 0.006, 0.026};
Physical Volume("rock") = {1};
Physical Volume("top") = {2};
Physical Volume("bottom") = {3};
Physical Surface("drive") = Surface In BoundingBox{-1, 0.0459, -1, 1, 0.0461, 1};
Physical Surface("foot") = Surface In BoundingBox{-1, -0.0061, -1, 1, -0.0059, 1};
MeshSize{ PointsOf{ Volume{1}; } } = 0.005;
MeshSize{ PointsOf{ Volume{2,3}; } } = 0.008;
''',
    "sphere.geo": '''SetFactory("OpenCASCADE");
Sphere(1) = {0, 0, 0.010001, 0.01};
Box(2) = {-0.008, -0.008, -0.004, 0.016, 0.016, 0.004};
Physical Volume("sphere") = {1};
Physical Volume("plate") = {2};
Mesh.MeshSizeMax = 0.004;
Field[1] = Ball;
Field[1].Radius = 0.002; Field[1].Thickness = 0.006; Field[1].VIn = 0.0008; Field[1].VOut = 0.004;
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
''',
    "tower.geo": '''SetFactory("OpenCASCADE");
n = 24;
For i In {0:n}
  z = 120*i/n; r = 27*Sqrt(1 + (z - 90)^2*((46/27)^2 - 1)/90^2);
  Point(100 + i) = {r - 0.25, 0, z}; Point(200 + i) = {r + 0.25, 0, z};
EndFor
Spline(1) = {100:100 + n}; Spline(2) = {200:200 + n};
Line(3) = {100, 200}; Line(4) = {100 + n, 200 + n};
Curve Loop(1) = {3, 2, -4, -1}; Plane Surface(1) = {1};
a() = Extrude{ {0, 0, 1}, {0, 0, 0}, Pi }{ Surface{1}; };
b() = Extrude{ {0, 0, 1}, {0, 0, 0}, Pi }{ Surface{a(0)}; };
Coherence;
Physical Volume("tower") = Volume{:};
Box(1000) = {-60, -60, -3.001, 120, 120, 3};
Physical Volume("floor") = {1000};
MeshSize{:} = 3; MeshSize{ PointsOf{ Volume{1000}; } } = 15;
Mesh.MeshSizeMax = 15;
''',
}
BREAKING = {"tower"}


def glued(lower, upper, more):
    return ('[mesh]\nfile = "two.geo"\nglue = true\n' + material("lower", ROCK, lower) + material("upper", SOFT, upper)
            + more + WEIGHT)


def cases():
    own = raster() + material("block", ROCK, "unbreakable")
    out = {
        "shared": raster() + material("block", ROCK, "none") + PULL,
        "own nodes": raster() + material("block", ROCK, "unbreakable") + joint("block") + PULL,
        "mid_edge": own + joint("block", 'points = "mid_edge"') + PULL,
        "independent_peaks": raster() + material("block", ROCK, "breakable") + joint("block", 'law = "independent_peaks"\nrise = "parabolic"', 10) + PULL,
        "graded": '[mesh]\nfile = "graded.geo"\n' + material("block", ROCK, "none") + WEIGHT,
        "slivers": '[mesh]\nfile = "slivers.geo"\n' + material("block", ROCK, "none") + WEIGHT,
        "two stiffnesses": glued("none", "none", ""),
        "own on shared": glued("none", "breakable", joint("upper") + joint(["lower", "upper"])),
        "platens": '[mesh]\nfile = "platens.geo"\n' + material("rock", ROCK, "unbreakable")
        + material("top", 'young = "200 GPa"\npoisson = 0.3\ndensity = 7800\n', "none")
        + material("bottom", 'young = "200 GPa"\npoisson = 0.3\ndensity = 7800\n', "none") + joint("rock")
        + '[[contact]]\nbetween = ["*", "*"]\npenalty = "300 GPa"\n'
        '[[stage]]\nname = "press"\nend = 1\n[[stage.constraint]]\ngroup = "foot"\nfixed = "xyz"\n'
        '[[stage.constraint]]\ngroup = "drive"\nvelocity = { x = 0, z = 0, '
        'y = { ramp = { from = "-0.5 m/s", to = 0, start = 0, end = "20 us" } } }\n',
        "sphere on plate": '[mesh]\nfile = "sphere.geo"\n' + material("sphere", SOFT, "none")
        + material("plate", SOFT, "none") + '[[contact]]\nbetween = ["sphere", "plate"]\npenalty = "30 GPa"\n'
        '[[initial_velocity]]\ngroup = "sphere"\nvelocity = [0, 0, "-1 m/s"]\n'
        '[[stage]]\nname = "bounce"\nend = "0.2 ms"\n[[stage.constraint]]\ngroup = "plate"\nfixed = "xyz"\n',
        "boxes": '[mesh]\nfile = "boxes.geo"\n' + material("lower", ROCK, "none") + material("upper", ROCK, "none")
        + '[[contact]]\nbetween = ["lower", "upper"]\npenalty = "300 GPa"\n'
        '[[initial_velocity]]\ngroup = "upper"\nvelocity = [0, 0, "-1 m/s"]\n' + WEIGHT.replace("-9.81", '"-1000 m/s2"'),
    }
    concrete = 'young = "35 GPa"\npoisson = 0.15\ndensity = 2400\n'
    plateau = ('[[contact]]\nbetween = ["tower", "{}"]\npenalty = "1800 GPa"\nplateau = "{} MPa"\n'
               'unloading_exponent = {}\nfriction = 0.6\n')
    out["tower"] = ('[mesh]\nfile = "tower.geo"\n' + material("tower", concrete, "breakable")
                    + material("floor", concrete, "none") + '[[joint]]\ngroup = "tower"\npenalty_factor = 10\n'
                    'tensile_strength = "6.3 MPa"\nenergy_mode_1 = 147.5\nfriction = 0.6\n'
                    + plateau.format("tower", 500, 6) + plateau.format("floor", 5, 4)
                    + '[[initial_velocity]]\ngroup = "tower"\nvelocity = [0, 0, "-3 m/s"]\n'
                    '[[stage]]\nname = "fall"\nend = "30 ms"\ngravity = [0, 0, -9.81]\n'
                    '[[stage.constraint]]\ngroup = "floor"\nfixed = "xyz"\n')
    return {name: f'title = "{name}"\n' + text for name, text in out.items()}


class Tester:
    def __init__(self, breccia, work, steps):
        self.breccia, self.work, self.steps = breccia, work, steps

    def write(self, name, text, time):
        path = self.work / (re.sub(r"\W", "_", name) + ".toml")
        path.write_text(f"{text}\n[time]\n{time}\nresidual_limit = {RESIDUAL}\n[output]\nframe_interval = 0\n")
        return path

    def survives(self, name, text, step):
        case = self.write(name, text, f'step = {step}\nmax_steps = {self.steps}')
        folder = case.with_suffix("")
        run = subprocess.run([self.breccia, "run", case, "-o", folder, "--overwrite", "--progress", "none"],
                             capture_output=True, text=True, check=False)
        if run.returncode != 0:
            return False
        summary = json.loads((folder / "summary.json").read_text())
        if summary["broken_joints"] > 0 and name not in BREAKING:
            return False
        energy = summary["energy"]
        terms = {k: v for k, v in energy.items() if k not in ("residual", "residual_relative")}
        return abs(energy["residual"]) <= RESIDUAL * max(abs(v) for v in terms.values())

    def chosen(self, name, text):
        case = self.write(name, text, "safety = 1")
        out = subprocess.run([self.breccia, "check", case], capture_output=True, text=True, check=False)
        found = re.search(r"stable time step ([\d.e+-]+) (\w+), limited by (.*?); elements alone (.*)", out.stdout)
        if not found:
            sys.exit(f"{name}: {out.stdout}{out.stderr}")
        unit = {"s": 1, "ms": 1e-3, "us": 1e-6, "ns": 1e-9, "ps": 1e-12}[found[2]]
        return float(found[1]) * unit, found[3] + "; elements alone " + found[4]

    def longest(self, name, text, start):
        good = bad = None
        step = start
        while good is None or bad is None:
            if self.survives(name, text, step):
                good, step = step, step * 1.5
            else:
                bad, step = step, step / 1.5
        while bad / good > RESOLUTION:
            step = (good * bad) ** 0.5
            good, bad = (step, bad) if self.survives(name, text, step) else (good, step)
        return good


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("breccia")
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("longest_step"))
    parser.add_argument("--steps", type=int, default=20000)
    parser.add_argument("cases", nargs="*", metavar="CASE")
    args = parser.parse_intermixed_args()
    args.work.mkdir(parents=True, exist_ok=True)
    for name, text in GEO.items():
        (args.work / name).write_text(text)
    tester = Tester(args.breccia, args.work, args.steps)
    print("| case | chosen, s | survives, s | chosen / survives | limited by |\n|---|---|---|---|---|")
    for name, text in cases().items():
        if args.cases and name not in args.cases:
            continue
        chosen, limit = tester.chosen(name, text)
        longest = tester.longest(name, text, chosen)
        print(f"| {name} | {chosen:.3g} | {longest:.3g} | {chosen / longest:.2f} | {limit} |", flush=True)


if __name__ == "__main__":
    main()
