"""What experiments share: cases as text, and what their histories show.

An experiment has cases() -> {label: (case, mesh)}, where the case names the mesh as MESH, and figures(results) -> its
columns, where results has what bench_contact prints, by label:
  gain      largest energy that came from nowhere, share of the energy put in
  lost      largest energy that is unaccounted, likewise
  friction  error of friction, share
  failures  list of texts: runs that ended with an error, bodies that passed each other, motion where none should be
The cost is measured by the table.
"""

GRAVITY = 9.81  # m/s2
# Limits at which a run would end by itself: what it gains or loses is to be seen whole.
NO_LIMITS = ["[time]", "residual_limit = 1e3", "energy_gain_limit = 1e3"]
# A run that gains or loses more would have been ended.
GAIN_LIMIT, LOSS_LIMIT = 0.01, 0.05


def material(groups, young, density=2000, poisson=0.2):
    return ["[[material]]", f"group = {list(groups)}".replace("'", '"'), f"young = {young}", f"poisson = {poisson}",
            f"density = {density}", 'joints = "none"']


def contact(between, penalty, *more):
    return ["[[contact]]", f"between = {list(between)}".replace("'", '"'), f"penalty = {penalty}", *more]


def fixed(group, axes="xyz"):
    return ["[[stage.constraint]]", f'group = "{group}"', f'fixed = "{axes}"']


def ramp(to, start, end, before=0):
    return f"{{ ramp = {{ from = {before}, to = {to}, start = {start}, end = {end} }} }}"


def output(interval, gauges=()):
    names = f"gauges = {list(gauges)}".replace("'", '"')
    return ["[output]", "frame_interval = 0", f"history_interval = {interval}", names]


def stage(end, gravity=(0, 0, 0), *more):
    return ["[[stage]]", f"end = {end}", f"gravity = [{', '.join(map(str, gravity))}]", *more]


def driven(group, velocity):
    return ["[[stage.constraint]]", f'group = "{group}"', f"velocity = {{ {velocity} }}"]


def thrown(group, velocity=(0, 0, 0), angular=(0, 0, 0)):
    return ["[[initial_velocity]]", f'group = "{group}"', f"velocity = {list(velocity)}", f"angular = {list(angular)}"]


def text(*parts, limits=NO_LIMITS):
    return "\n".join(['[mesh]', 'file = "MESH"', *(line for part in [*parts, limits] for line in part)]) + "\n"


def put_in(history):
    first = history["kinetic"][0] + history["stored"][0] - history["work"][0]
    return max(first + work for work in history["work"])


def balance(results, from_line=0):
    """Gain and loss, the largest of all runs, and what ended with an error or would have been ended.

    @param from_line  of the history; -1: at the end alone
    """
    gain = lost = 0.0
    failures = []
    for label, result in results.items():
        if result["status"] != "complete":
            failures.append(f"{label}: {result['status'][:80]}")
        if not result["history"]:
            continue
        most = put_in(result["history"])
        shares = [residual / most for residual in result["history"]["residual"][from_line:]]
        if -min(shares) > GAIN_LIMIT:
            failures.append(f"{label}: gains {-min(shares):.2g} of the energy put in")
        if max(shares) > LOSS_LIMIT:
            failures.append(f"{label}: loses {max(shares):.2g} of it")
        gain, lost = max(gain, -min(shares)), max(lost, max(shares))
    return {"gain": max(gain, 0.0), "lost": max(lost, 0.0), "failures": failures}


def at(history, time):
    """Index of the first line from a time on."""
    return next((i for i, t in enumerate(history["time"]) if t >= time), len(history["time"]) - 1)


def complete(results):
    return {label: result for label, result in results.items() if result["status"] == "complete"}
