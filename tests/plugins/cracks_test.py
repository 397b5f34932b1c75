"""pvbatch --symmetric cracks_test.py RUN: fracture surfaces, crack events, contacts, energies and ranks, on any number of ranks."""
import csv
import json
import sys

import numpy as np

import broken_box as b
import flying_wall

simple = b.load()
RANK, RANKS = b.rank()
run = sys.argv[1]
ROUND_OFF = 1e-9      # relative
SINGLE = 1e-6         # relative: energies are kept in single precision in frames


def shared_out(n):
    """Which of n things this rank has."""
    return np.random.default_rng(n).integers(0, RANKS, n) == RANK


def input_of(box, chosen, **arrays):
    return b.producer(b.blocks(elements=box.elements(shared_out(box.count)),
                               joints=box.joints(chosen, shared_out(len(chosen)), **arrays)))


def wall(box, x):
    """Joints in the plane at x, their centres and areas."""
    centre = box.points[box.joint // 4][np.arange(len(box.joint))[:, None], b.FACES[box.joint % 4]].mean(axis=1)
    at = abs(centre[:, 0] - x) < 1e-9
    return box.joint[at], centre[at]


def area_is_that_of_broken_joints():
    box = b.Box((4, 3, 2))
    plane, _ = wall(box, 0.02)
    found = simple.FractureSurface(Input=input_of(box, box.joint, broken=np.isin(box.joint, plane).astype(np.int32)), Up="Z")
    found.UpdatePipeline()
    surface = b.output(found)
    b.expect(np.isclose(b.fact(surface, "fracture_area"), 0.03 * 0.02, rtol=ROUND_OFF), "area of a plane crack")
    b.expect(np.isclose(b.fact(surface, "projected_area"), 0.03 * 0.02, rtol=ROUND_OFF), "projected area of a plane crack")
    b.expect(b.fact(surface, "rms_height") < 1e-9, f"roughness of a plane {b.fact(surface, 'rms_height')}")
    if RANKS == 1:
        b.expect(surface.GetNumberOfPoints() == 4 * 3, f"{surface.GetNumberOfPoints()} corners of a grid of 3 by 2 cells")
    if RANK == 0:
        rose = b.output(found, 1)
        area = b.column(rose, "area")
        # Up z: east x, north y. A plane normal to x strikes north: 0 degrees.
        b.expect(np.isclose(area[0], 0.03 * 0.02, rtol=ROUND_OFF) and area[1:].sum() == 0, f"rose {area}")
        net = b.output(found, 2)
        radius = np.hypot(*b.vtk_to_numpy(net.GetPoints().GetData())[:, :2].T)
        b.expect(np.allclose(radius, 1), "poles of upright planes are on the rim")


def orientation_is_that_of_the_plane():
    """A single joint that dips 30 degrees towards 120 degrees."""
    dip, azimuth = np.radians(30), np.radians(120)
    down = np.array([np.sin(azimuth) * np.cos(dip), np.cos(azimuth) * np.cos(dip), -np.sin(dip)])
    along = np.array([np.cos(azimuth), -np.sin(azimuth), 0])
    corners = np.array([[0 * down, 0.01 * down, 0.01 * along]])
    mine = slice(None) if RANK == 0 else slice(0)
    one = np.ones(1)
    joints = b.grid(corners[mine], 5, {name: (value * one)[mine] for name, value in
                    (("id", 4), ("broken", 1), ("mode", 2), ("time_of_failure", 0.5), ("opening", 0), ("energy", 0))})
    found = simple.FractureSurface(Input=b.producer(b.blocks(joints=joints)))
    found.UpdatePipeline()
    if RANK != 0:
        return
    cells = b.output(found).GetCellData()
    for name, value in (("dip", 30), ("dip_direction", 120), ("strike", 30), ("area", 5e-5)):
        b.expect(np.isclose(cells.GetArray(name).GetValue(0), value), f"{name} {cells.GetArray(name).GetValue(0)} instead of {value}")
    x = b.vtk_to_numpy(b.output(found, 2).GetPoints().GetData())[0]
    radius = np.sqrt(2) * np.sin(dip / 2)
    b.expect(np.allclose(x[:2], [-radius * np.sin(azimuth), -radius * np.cos(azimuth)], atol=1e-6), f"pole at {x}")


def tip_has_its_speed():
    box = b.Box((2, 30, 1))
    plane, centre = wall(box, 0.01)
    speed, start = 700.0, centre[np.argmin(centre[:, 1] + 1e-3 * centre[:, 2])]
    distance = np.linalg.norm(centre - start, axis=1)
    found = simple.FractureSurface(Input=input_of(box, plane, time_of_failure=1e-6 + distance / speed))
    found.UpdatePipeline()
    if RANK == 0:
        tips = b.output(found, 3)
        b.expect(np.isclose(b.fact(tips, "mean_speed"), speed, rtol=1e-6), f"speed {b.fact(tips, 'mean_speed')}")
        b.expect(np.allclose(b.column(tips, "speed")[1:], speed, rtol=1e-5), "speeds of the tip")
        b.expect(np.isclose(b.column(tips, "distance")[-1], distance.max(), rtol=ROUND_OFF), "reach of the tip")


def events_are_apart_in_space_and_time():
    box = b.Box((20, 1, 1))
    groups = [wall(box, x)[0] for x in (0.02, 0.1, 0.18)]
    joints = np.concatenate(groups)
    order = np.argsort(joints)
    # The first plane fails at once, the second in two halves, the third a little later than the first.
    time = np.concatenate([[0.0, 0.0], [0.0, 1.0], [1e-9, 1e-9]])
    energy = np.array([1.0, 2.0, 4.0, 8.0, 16.0, 32.0])
    found = simple.CrackEvents(Input=input_of(box, joints[order], time_of_failure=time[order], energy=energy[order]),
                               Distance=0.03, Duration=1e-6)
    found.UpdatePipeline()
    if RANK != 0:
        return
    table = b.output(found, 1)
    b.expect(sorted(b.column(table, "energy")) == [3.0, 4.0, 8.0, 48.0], f"energies of events {b.column(table, 'energy')}")
    b.expect(np.allclose(sorted(b.column(table, "centre")[:, 0]), [0.02, 0.1, 0.1, 0.18]), "places of events")
    b.expect(b.fact(table, "energy") == energy.sum(), "energy of all events")
    b.expect(b.output(found).GetNumberOfPoints() == 4, "a point for each event")


def moment_tensor(jump):
    """Of a wall of 10 mm by 10 mm normal to x, whose right side has moved by `jump`."""
    box = b.Box((2, 1, 1))
    plane, _ = wall(box, 0.01)
    right = box.points.mean(axis=1)[:, 0] > 0.01
    joints = box.joints(plane, shared_out(len(plane)))
    box.points = box.points + np.where(right[:, None, None], np.asarray(jump), 0)
    data = b.blocks(elements=box.elements(shared_out(box.count)), joints=joints)
    found = simple.CrackEvents(Input=b.producer(data), YoungsModulus=30e9, PoissonsRatio=0.2)
    found.UpdatePipeline()
    return b.output(found, 1)


def moment_tensors_are_those_of_opening_and_slip():
    mu, lam, area, u = 12.5e9, 30e9 * 0.2 / (1.2 * 0.6), 1e-4, 1e-6
    opened, slipped = moment_tensor([u, 0, 0]), moment_tensor([0, u, 0])
    if RANK != 0:
        return
    m = b.column(opened, "moment_tensor")[0]
    b.expect(np.allclose(m, area * u * np.array([lam + 2 * mu, lam, lam, 0, 0, 0]), rtol=1e-6, atol=1e-6), f"opening: {m}")
    m = b.column(slipped, "moment_tensor")[0]
    b.expect(np.allclose(abs(m), area * u * np.array([0, 0, 0, mu, 0, 0]), rtol=1e-6, atol=1e-6), f"slip: {m}")
    b.expect(np.isclose(b.column(slipped, "double_couple_part")[0], 1, atol=1e-6), "slip is a double couple")
    b.expect(np.isclose(b.column(slipped, "scalar_moment")[0], mu * area * u, rtol=1e-6), "scalar moment of slip")
    magnitude = 2 / 3 * (np.log10(mu * area * u) - 9.1)
    b.expect(np.isclose(b.column(slipped, "magnitude")[0], magnitude, rtol=1e-6), "magnitude of slip")
    isotropic = lam + 2 * mu / 3
    share = isotropic / (isotropic + 4 * mu / 3)
    b.expect(np.isclose(b.column(opened, "isotropic_part")[0], share, rtol=1e-6), "isotropic part of opening")
    b.expect(np.isclose(b.column(opened, "clvd_part")[0], 1 - share, rtol=1e-6), "the rest of opening is a vector dipole")


def moment_tensors_are_those_at_the_time_of_failure():
    mu, lam = 12.5e9, 30e9 * 0.2 / (1.2 * 0.6)
    joint_area = 0.5e-4
    flying_wall.asked.clear()
    found = simple.CrackEvents(Input=flying_wall.source(), YoungsModulus=30e9, PoissonsRatio=0.2, Distance=1e-9, Duration=1e-12)
    for time in (3e-6, 9e-6, 4e-6):  # also backwards, and where everything has flown apart
        found.UpdatePipeline(time)
        if RANK != 0:
            continue
        table = b.output(found, 1)
        until = np.sort(flying_wall.FAILURE[flying_wall.FAILURE < time])
        b.expect(table.GetNumberOfRows() == len(until), f"{table.GetNumberOfRows()} events until {time}")
        order = np.argsort(b.column(table, "time"))
        for i, row in enumerate(order[:len(until)]):
            u = (until[i] - flying_wall.START) * flying_wall.SPEED
            expected = joint_area * np.array([(lam + 2 * mu) * u[0], lam * u[0], lam * u[0], mu * u[1], 0, 0])
            got = b.column(table, "moment_tensor")[row]
            b.expect(np.allclose(got, expected, rtol=1e-6, atol=1e-6), f"moment tensor of {until[i]} at {time}: {got} of {expected}")
            centre = b.column(table, "centre")[row]
            b.expect(abs(centre[0] - (0.01 + u[0] / 2)) < 1e-9, f"centre of {until[i]} at {time}: {centre}")
        b.expect(np.isclose(b.fact(table, "fracture_energy"), 4 * 0.25), f"fracture energy {b.fact(table, 'fracture_energy')}")
        b.expect(np.isclose(b.fact(table, "energy_of_damage"), (4 - len(until)) * 0.25), "energy of damage")
    b.expect(1e-6 not in flying_wall.asked, "only the frames around failures are read")
    found.MomentAt = "Time shown"
    found.UpdatePipeline(9e-6)
    if RANK == 0:
        b.expect(b.column(b.output(found, 1), "scalar_moment").min() > 1e5, "at the time shown everything has flown apart")


def ranks_have_their_load_over_time():
    found = simple.RankView(Input=flying_wall.source(), OverTime=1)
    found.UpdatePipeline(3e-6)
    table, shown = b.output(found, 2), b.output(found, 1)
    if RANK != 0:
        b.expect(table.GetNumberOfRows() == 0, "the table over time is on the first rank")
    else:
        times = np.array(flying_wall.TIMES)
        b.expect(np.allclose(b.column(table, "time [s]"), times), f"times {b.column(table, 'time [s]')}")
        more = 1 + times / flying_wall.START
        mean = (1 + more) / 2
        b.expect(np.allclose(b.column(table, "load of rank 1"), more / mean), f"load {b.column(table, 'load of rank 1')}")
        b.expect(np.allclose(b.column(table, "load of rank 0"), 1 / mean), f"load {b.column(table, 'load of rank 0')}")
        b.expect(np.allclose(b.column(table, "imbalance"), more / mean - 1), f"imbalance {b.column(table, 'imbalance')}")
        b.expect(np.all(b.column(table, "elements of rank 1") == 12), "elements of a rank")
        # At 3e-6 s, though later frames were read after that.
        b.expect(np.isclose(b.fact(shown, "imbalance"), (more / mean - 1)[3]), f"imbalance shown {b.fact(shown, 'imbalance')}")
    found.OverTime = 0
    found.UpdatePipeline(4e-6)
    if RANK == 0:
        b.expect(list(b.column(b.output(found, 2), "time [s]")) == [4e-6], "without OverTime the time shown alone")


def b_value_is_given_back():
    n, slope, start = 4000, 0.9, -5.0
    box = b.Box((1, 1, 1))
    plane = box.joint[:1]
    corners = box.joints(plane).GetPoints()
    triangle = b.vtk_to_numpy(corners.GetData()).reshape(1, 3, 3)
    magnitude = start - np.log10(1 - (np.arange(n) + 0.5) / n) / slope
    energy = 10 ** (1.5 * (magnitude + 2.9))
    place = triangle + np.arange(n)[:, None, None]
    part = shared_out(n)
    ones = np.ones(n, dtype=np.int32)
    joints = b.grid(place[part], 5, {"id": np.arange(n, dtype=np.int64)[part], "broken": ones[part], "mode": ones[part],
                                     "time_of_failure": 0.0 * ones[part], "opening": 0.0 * ones[part], "energy": energy[part]})
    found = simple.CrackEvents(Input=b.producer(b.blocks(joints=joints)), MagnitudeOf="Energy")
    found.UpdatePipeline()
    if RANK == 0:
        table = b.output(found, 2)
        b.expect(np.isclose(b.fact(table, "completeness"), start), f"completeness {b.fact(table, 'completeness')}")
        # The quantiles' mean is that of the distribution but for the tail beyond the last: 1 / n.
        b.expect(np.isclose(b.fact(table, "b_value"), slope, rtol=1 / np.sqrt(n)), f"b-value {b.fact(table, 'b_value')}")


def run_has_its_energies_and_contacts():
    reader = simple.BrecciaReader(FileName=run)
    reader.UpdatePipelineInformation()
    last = reader.TimestepValues[-1]
    summary = json.load(open(f"{run}/summary.json"))
    events = simple.CrackEvents(Input=reader)
    events.UpdatePipeline(last)
    balance = simple.EnergyBalance(Input=simple.OutputPort(reader, 1))
    balance.UpdatePipeline(last)
    network = simple.ContactNetwork(Input=reader)
    network.UpdatePipeline(last)
    ranks = simple.RankView(Input=reader)
    ranks.UpdatePipeline(last)
    surface = simple.FractureSurface(Input=reader)
    surface.UpdatePipeline(last)
    data = b.output(reader)
    if RANKS > 1:
        return
    joints = data.GetBlock(2).GetCellData()
    energy, broken = b.vtk_to_numpy(joints.GetArray("energy")), b.vtk_to_numpy(joints.GetArray("broken"))
    budget = summary["energy"]["joint_mode_1"] + summary["energy"]["joint_mode_2"]
    b.expect(np.isclose(energy.sum(dtype=float), budget, rtol=SINGLE), f"energy of joints {energy.sum()} of {budget}")
    shown = b.fact(b.output(events, 1), "energy")
    b.expect(np.isclose(shown, energy[broken != 0].sum(dtype=float), rtol=SINGLE), f"energy of events {shown}")
    fracture = b.fact(b.output(events, 1), "fracture_energy")
    b.expect(np.isclose(fracture, budget, rtol=SINGLE), f"energy of events and of damage {fracture} of the budget's {budget}")
    b.expect(b.column(b.output(events, 1), "joints").sum() == summary["broken_joints"], "joints of events")
    b.expect(b.output(surface).GetNumberOfCells() == summary["broken_joints"], "faces of the surface")

    rows = list(csv.reader(open(f"{run}/history.csv")))
    end = dict(zip(rows[0], map(float, rows[-1])))
    table = b.output(balance)
    names = [table.GetColumnName(i) for i in range(table.GetNumberOfColumns())]
    b.expect("plastic [J]" not in names and "kinetic [J]" in names, f"columns {names}")
    total = sum(value for name, value in end.items() if name.endswith("[J]") and name[:-4] not in ("external work", "step change", "residual"))
    top = [name for name in names if name.startswith("up to")][-1]
    b.expect(np.isclose(b.column(table, top)[-1], total, rtol=ROUND_OFF), f"{top} at the end")

    for time in reversed(reader.TimestepValues):  # to the last frame in which bodies touch each other
        network.UpdatePipeline(time)
        if b.output(network, 2).GetNumberOfRows() > 0:
            break
    force = b.column(b.output(network, 2), "force").reshape(-1, 3)
    body, other = b.column(b.output(network, 2), "body"), b.column(b.output(network, 2), "other_body")
    raw = b.output(reader).GetBlock(1).GetCellData()
    for i in range(len(body)):
        f, p, q = (b.vtk_to_numpy(raw.GetArray(name)) for name in ("force", "body", "other_body"))
        expected = f[(p == body[i]) & (q == other[i])].sum(axis=0, dtype=float) - f[(p == other[i]) & (q == body[i])].sum(axis=0, dtype=float)
        b.expect(np.allclose(force[i], expected, rtol=SINGLE, atol=1e-6 * abs(f).max()), f"force between {body[i]} and {other[i]}")
    nodes = b.column(b.output(network, 1), "force").reshape(-1, 3)
    b.expect(len(body) > 0 and np.allclose(nodes.sum(axis=0), 0, atol=1e-9 * abs(nodes).max()), "forces between fragments cancel")

    b.expect(list(b.column(b.output(ranks, 1), "elements")) == [summary["elements"]], "elements of the only rank")
    b.expect(b.fact(b.output(ranks, 1), "imbalance") == 0, "imbalance of one rank")


area_is_that_of_broken_joints()
orientation_is_that_of_the_plane()
tip_has_its_speed()
events_are_apart_in_space_and_time()
moment_tensors_are_those_of_opening_and_slip()
b_value_is_given_back()
run_has_its_energies_and_contacts()
ranks_have_their_load_over_time()
moment_tensors_are_those_at_the_time_of_failure()  # with the one before the last: scripts of sources put their own sum and max among this file's names
b.finish()
