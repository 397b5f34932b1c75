"""pvbatch --symmetric fragments_test.py TABLE: the filter Fragments on any number of ranks. TABLE_RANKS gets a digest of all tables; with `speed`
instead of TABLE it measures."""
import hashlib
import sys
import time

import numpy as np

import broken_box as b
from vtkmodules.vtkCommonCore import vtkStringArray

simple = b.load()
RANK, RANKS = b.rank()
MASS_TOLERANCE = 1e-12   # relative: the figure; sums are exact but for the rounding of their terms
ROUND_OFF = 1e-9         # relative, of moments and their eigenvectors


def fragments(box, broken, scatter=None, **properties):
    """The filter on this rank's elements and joints, shared out by chance."""
    owner = np.zeros(box.count, int) if scatter is None else scatter.integers(0, RANKS, box.count)
    holder = np.zeros(len(broken), int) if scatter is None else scatter.integers(0, RANKS, len(broken))
    data = b.blocks(elements=box.elements(owner == RANK), joints=box.joints(broken, holder == RANK))
    found = simple.Fragments(Input=b.producer(data), **properties)
    found.UpdatePipeline()
    return found, owner


def brute_force(box, broken):
    """Label of every element: the smallest id that can be reached, by sweeps until nothing changes."""
    cut = set((int(j) // 4, int(box.neighbour[j // 4, j % 4])) for j in broken)
    pairs = np.array([(j // 4, box.neighbour[j // 4, j % 4]) for j in box.joint
                      if (j // 4, int(box.neighbour[j // 4, j % 4])) not in cut], dtype=np.int64).reshape(-1, 2)
    label = box.id.copy()
    while True:
        lowest = np.minimum(label[pairs[:, 0]], label[pairs[:, 1]])
        new = label.copy()
        np.minimum.at(new, pairs[:, 0], lowest)
        np.minimum.at(new, pairs[:, 1], lowest)
        if np.array_equal(new, label):
            return label
        label = new


def table_is_that_of_brute_force():
    digest = hashlib.sha256()
    for seed in range(6):
        chance = np.random.default_rng(seed)
        box = b.Box((5, 4, 3))
        box.points = box.points + 1e-4 * chance.random(box.points.shape)
        box.velocity = chance.normal(size=(box.count, 3))
        broken = box.joint[chance.random(len(box.joint)) < (0.0, 0.3, 0.6, 0.75, 0.9, 1.0)[seed]]
        found, owner = fragments(box, broken, chance)
        expected = brute_force(box, broken)
        mine = b.output(found)
        labels = b.vtk_to_numpy(mine.GetCellData().GetArray("fragment")) if mine.GetNumberOfCells() else np.zeros(0)
        b.expect(np.array_equal(labels, expected[owner == RANK]), f"seed {seed}: labels differ from those of brute force")
        table = b.output(found, 1)
        b.expect((table.GetNumberOfRows() > 0) == (RANK == 0), f"rows on rank {RANK}")
        if RANK != 0:
            continue
        ids = np.unique(expected)
        b.expect(np.array_equal(b.column(table, "fragment"), ids), f"seed {seed}: fragments {b.column(table, 'fragment')}")
        count = np.array([np.sum(expected == i) for i in ids])
        b.expect(np.array_equal(b.column(table, "elements"), count), f"seed {seed}: elements")
        total = b.column(table, "mass").sum()
        b.expect(abs(total - box.mass.sum()) <= MASS_TOLERANCE * total, f"seed {seed}: mass {total} of {box.mass.sum()}")
        centroid = box.points.mean(axis=1)
        for name, values in (("centroid", centroid), ("velocity", box.velocity)):
            mean = np.array([np.average(values[expected == i], axis=0, weights=box.mass[expected == i]) for i in ids])
            b.expect(np.allclose(b.column(table, name), mean, rtol=ROUND_OFF, atol=1e-12), f"seed {seed}: {name}")
        cut = len(broken) * 2
        b.expect(b.column(table, "cracked_faces").sum() == cut, f"seed {seed}: cracked faces {b.column(table, 'cracked_faces').sum()} of {cut}")
        for i in range(table.GetNumberOfColumns()):
            values = table.GetColumn(i)
            if values.IsA("vtkDataArray"):
                digest.update(b.vtk_to_numpy(values).tobytes())
    if RANK == 0:
        open(f"{sys.argv[1]}_{RANKS}", "w").write(digest.hexdigest())


def fragments_have_the_name_of_their_body():
    """Bodies of one cube each; the third has no name."""
    box = b.Box((3, 1, 1))
    chance = np.random.default_rng(3)
    owner = chance.integers(0, RANKS, box.count)
    elements = box.elements(owner == RANK)
    body = b.numpy_to_vtk(np.ascontiguousarray((box.id // 6)[owner == RANK].astype(np.int32)), deep=1)
    body.SetName("body")
    elements.GetCellData().AddArray(body)
    names = vtkStringArray()
    names.SetName("body_names")
    for name in ("plate", "a, \"b\""):
        names.InsertNextValue(name)
    elements.GetFieldData().AddArray(names)
    broken = [j for j in box.joint if j // 4 // 6 != box.neighbour[j // 4, j % 4] // 6]
    found = simple.Fragments(Input=b.producer(b.blocks(elements=elements, joints=box.joints(broken if RANK == 0 else []))))
    found.UpdatePipeline()
    table = b.output(found, 1)
    if RANK == 0:
        b.expect(b.words(table, "body_name") == ["plate", "a, \"b\"", "body 2"], f"names {b.words(table, 'body_name')}")
        b.expect(list(b.column(table, "body")) == [0, 1, 2], f"bodies {b.column(table, 'body')}")


def rigid_motion_has_its_spin():
    box = b.Box((4, 2, 1))
    spin, drift = np.array([3.0, -2.0, 5.0]), np.array([1.0, 2.0, -4.0])
    box.velocity = drift + np.cross(spin, box.points.mean(axis=1))
    found, _ = fragments(box, [])
    if RANK == 0:
        b.expect(np.allclose(b.column(b.output(found, 1), "spin")[0], spin, rtol=ROUND_OFF), "spin of a rigid box")


def box_has_its_ellipsoid():
    box = b.Box((4, 2, 1))
    found, _ = fragments(box, [])
    if RANK != 0:
        return
    table = b.output(found, 1)
    edges = 0.01 * np.array([4, 2, 1])
    axes = np.sqrt(5 / 12) * edges  # second moment of a box: edge^2 / 12
    b.expect(np.allclose(b.column(table, "semi_axes")[0], axes, rtol=ROUND_OFF), f"semi-axes {b.column(table, 'semi_axes')[0]}")
    # A corner of the box: the sum of (edge/2)^2 / (5 edge^2 / 12) is 9/5.
    b.expect(np.isclose(b.column(table, "bounding_factor")[0], np.sqrt(9 / 5), rtol=ROUND_OFF), "bounding factor")
    area = 2 * (edges[0] * edges[1] + edges[1] * edges[2] + edges[0] * edges[2])
    b.expect(np.isclose(b.column(table, "area")[0], area, rtol=ROUND_OFF), f"area {b.column(table, 'area')[0]} of {area}")
    b.expect(np.isclose(b.column(table, "volume")[0], edges.prod(), rtol=ROUND_OFF), "volume")
    b.expect(np.isclose(b.column(table, "elongation")[0], 0.5), "elongation")
    b.expect(np.isclose(b.column(table, "flatness")[0], 0.5), "flatness")
    ball = np.pi ** (1 / 3) * (6 * edges.prod()) ** (2 / 3) / area
    b.expect(np.isclose(b.column(table, "sphericity")[0], ball, rtol=ROUND_OFF), "sphericity")


def sieve_of(sizes, masses):
    """The curve of single tetrahedra with these diameters and masses."""
    n = len(sizes)
    box = b.Box((n, 1, 1))
    box.points, box.id = box.points[::6].copy(), np.arange(n)
    box.count, box.mass, box.velocity = n, np.asarray(masses, float), np.zeros((n, 3))
    box.neighbour = np.full((n, 4), -1)
    edge = box.points - box.points[:, :1]
    now = np.cbrt(6 / np.pi * abs(np.linalg.det(edge[:, 1:])) / 6)
    box.points = edge * (np.asarray(sizes) / now)[:, None, None]  # all at the origin: some are very small
    data = b.blocks(elements=box.elements(slice(None) if RANK == 0 else slice(0)), joints=box.joints([]))
    found = simple.Fragments(Input=b.producer(data), SieveMeasure="Sphere of the same volume", OnlyBroken=0)
    found.UpdatePipeline()
    return b.output(found, 2)


def sieve(size_at):
    """Single tetrahedra of one mass whose diameters follow a distribution: size_at(share that passes)."""
    n = 50
    return sieve_of(size_at(np.minimum(np.arange(1, n + 1) / n, 1 - 1e-9)), np.full(n, 2.0))


def sieve_curves_give_back_their_parameters():
    size, exponent = 0.02, 1.4
    curve = sieve(lambda p: size * (-np.log1p(-p)) ** (1 / exponent))
    median, largest, b_swebrec = 0.01, 0.05, 2.2
    other = sieve(lambda p: largest / np.exp(np.log(largest / median) * np.where(p > 1 - 1e-6, 0, 1 / p - 1) ** (1 / b_swebrec)))
    if RANK != 0:
        return
    b.expect(np.isclose(b.fact(curve, "rosin_rammler_size"), size, rtol=1e-9), f"x_c {b.fact(curve, 'rosin_rammler_size')}")
    b.expect(np.isclose(b.fact(curve, "rosin_rammler_exponent"), exponent, rtol=1e-9), "n")
    b.expect(np.isclose(b.fact(curve, "d50"), size * np.log(2) ** (1 / exponent), rtol=1e-9), f"d50 {b.fact(curve, 'd50')}")
    b.expect(np.isclose(b.fact(curve, "d80"), size * np.log(5) ** (1 / exponent), rtol=1e-9), f"d80 {b.fact(curve, 'd80')}")
    b.expect(np.isclose(b.fact(other, "swebrec_median"), median, rtol=1e-9), f"x_50 {b.fact(other, 'swebrec_median')}")
    b.expect(np.isclose(b.fact(other, "swebrec_largest"), largest, rtol=1e-9), "x_max")
    b.expect(np.isclose(b.fact(other, "swebrec_exponent"), b_swebrec, rtol=1e-9), f"b {b.fact(other, 'swebrec_exponent')}")


def measures(curve, name):
    """R2 and largest deviation of a fit, from the columns."""
    passing, fit = b.column(curve, "passing"), b.column(curve, name)
    mass = np.diff(passing, prepend=0)
    return 1 - np.sum(mass * (fit - passing) ** 2) / np.sum(mass * (passing - np.sum(mass * passing)) ** 2), abs(fit - passing).max()


def sieve_curves_have_fits_of_the_mass_or_the_reason_why_not():
    rng = np.random.default_rng(5)
    share = (np.arange(1, 81) - 0.5) / 80
    noise = np.exp(0.03 * rng.normal(size=80))
    splinters = np.concatenate([1e-3 * np.exp(0.2 * rng.normal(size=100)), 5e-3 * np.exp(0.5 * rng.normal(size=12)),
                                [0.02, 0.025, 0.03, 0.04]])
    curves = {
        "Rosin-Rammler": sieve_of(0.02 * (-np.log1p(-share)) ** (1 / 1.4) * noise, np.ones(80)),
        "Swebrec": sieve_of(0.05 / np.exp(np.log(5) * (1 / share - 1) ** (1 / 2.2)) * noise, np.ones(80)),
        "splinters": sieve_of(splinters, splinters ** 3),
        "bimodal": sieve_of(np.concatenate([1e-3 * np.exp(0.3 * rng.normal(size=60)), 0.02 * np.exp(0.3 * rng.normal(size=20))]),
                            np.repeat([1.0, 3.0], [60, 20])),
        "few": sieve_of([0.01, 0.02, 0.03, 0.04], [1, 1, 2, 3]),
    }
    if RANK != 0:
        return
    # R2 and deviation that each fit reaches at least (the noise of the sizes, the steps of few heavy fragments); None: it is left out
    expected = {"Rosin-Rammler": ((0.999, 0.03), (0.99, 0.06)), "Swebrec": ((0.98, 0.08), (0.999, 0.03)),
                "splinters": ((0.97, 0.12), (0.998, 0.04)), "bimodal": (None, None), "few": (None, None)}
    for kind, curve in curves.items():
        for (name, size), wanted in zip((("rosin_rammler", "size"), ("swebrec", "median")), expected[kind]):
            reason = b.words_of_fact(curve, f"{name}_left_out")
            if wanted is None:
                b.expect("4 different sizes" in reason if kind == "few" else "its best fit deviates by 0." in reason, f"{kind}, {name}: {reason}")
                b.expect(np.all(np.isnan(b.column(curve, name))) and np.isnan(b.fact(curve, f"{name}_{size}")), f"{kind}, {name} is left out")
                continue
            r2, deviation = measures(curve, name)
            print(f"{kind}: {name}: R2 {r2:.4f}, largest deviation {deviation:.3f}")
            b.expect(not reason and r2 >= wanted[0] and deviation <= wanted[1], f"{kind}, {name}: R2 {r2}, deviation {deviation} {reason}")
            b.expect(np.isclose(b.fact(curve, f"{name}_r2"), r2, rtol=1e-9), f"R2 {b.fact(curve, f'{name}_r2')}")
            b.expect(np.isclose(b.fact(curve, f"{name}_deviation"), deviation, rtol=1e-9), "deviation")
    # No other parameters near these have less: a minimum of the squares.
    curve = curves["splinters"]
    x, passing, mass = b.column(curve, "size"), b.column(curve, "passing"), np.diff(b.column(curve, "passing"), prepend=0)
    best = [b.fact(curve, "rosin_rammler_size"), b.fact(curve, "rosin_rammler_exponent")]

    def squares(size, exponent):
        return np.sum(mass * (-np.expm1(-(x / size) ** exponent) - passing) ** 2)

    for change in ((1.001, 1), (0.999, 1), (1, 1.001), (1, 0.999)):
        b.expect(squares(best[0] * change[0], best[1] * change[1]) > squares(*best), f"there is a better fit by {change}")


def followed_elements_show_their_fragment_alone():
    box = b.Box((4, 1, 1))
    middle = [j for j in box.joint if {j // 4 // 6, box.neighbour[j // 4, j % 4] // 6} == {1, 2}]
    found, _ = fragments(box, middle, np.random.default_rng(1), FollowedElements=[20])
    if RANK == 0:
        b.expect(list(b.column(b.output(found, 1), "fragment")) == [12], "the right half of the box is fragment 12")
    shown = b.output(found)
    if shown.GetNumberOfCells():
        b.expect(b.vtk_to_numpy(shown.GetCellData().GetArray("id")).min() >= 12, "elements of the other half")


def speed():
    """400,000 elements, once everything is in place; for one rank."""
    box = b.Box((41, 41, 40))
    chance = np.random.default_rng(0)
    broken = box.joint[chance.random(len(box.joint)) < 0.5]
    found, _ = fragments(box, broken)
    begin = time.perf_counter()
    found.GetClientSideObject().Modified()
    found.GetClientSideObject().Update()
    print(f"{box.count} elements, {len(broken)} failed joints: {time.perf_counter() - begin:.3f} s")


if sys.argv[1] == "speed":
    speed()
else:
    table_is_that_of_brute_force()
    fragments_have_the_name_of_their_body()
    rigid_motion_has_its_spin()
    box_has_its_ellipsoid()
    sieve_curves_give_back_their_parameters()
    sieve_curves_have_fits_of_the_mass_or_the_reason_why_not()
    followed_elements_show_their_fragment_alone()
b.finish()
