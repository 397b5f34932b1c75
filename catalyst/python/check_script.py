"""Reads a Catalyst script without running it and lists its requirements; run by the plain Python interpreter, before any ParaView.

usage: check_script.py SCRIPT PIPELINES FIELDS POINTS CHANNEL...
PIPELINES is a folder of modules that scripts may import; FIELDS the only arrays that the script is handed, a,b,c, or nothing: all; POINTS those
that it gets at points too, nothing: none. Prints lines of a word and a text:
  error what (file:line)     the script does not compile
  problem what (file:line)   a source or an array that no run has
  lacks what                 this interpreter cannot run it; that of another ParaView may
  draws                      it makes pictures, so it needs a display
  channel name               a channel that it names as a source
  parameter name             a parameter that it requests from breccia_insitu
  text name, number name     the same, with the kind of its default
  any_parameter              it computes the names of parameters
"""

import ast
import difflib
import importlib.util
import os
import re
import sys

DRAWING_CALLS = {"GetActiveViewOrCreate", "GetRenderView", "Render", "RenderAllViews", "SaveAnimation", "SaveScreenshot", "Show"}
DRAWING_VIEW = re.compile(r"Create\w*View")
DRAWING_EXTRACTORS = {"PNG", "JPG", "CinemaVolumetricPNG", "RecolorableImage"}
# Arrays of the cells; those of the history depend on the case.
ELEMENT_ARRAYS = ("id", "body", "material", "rank", "fragment", "stress", "von_mises", "principal", "velocity", "displacement", "cost", "mass",
                  "neighbour")
JOINT_ARRAYS = ("id", "damage", "opening", "slip", "time_of_failure", "mode", "state", "broken", "energy")
ARRAYS = {"elements": ELEMENT_ARRAYS, "surface": (*ELEMENT_ARRAYS, "face", "crack"), "joints": JOINT_ARRAYS, "fractures": JOINT_ARRAYS,
          "contacts": ("id", "point", "normal_force", "tangential_force", "force", "slip_velocity", "body", "other_body", "other_element"),
          "domains": ("rank", "elements", "joints", "couples", "load")}
POINT_ARRAYS = ("displacement", "velocity", "stress", "von_mises", "principal", "plastic_shear", "compaction", "plastic_work")
MAKES_POINT_ARRAYS = re.compile(r"CellData\w*|Resample\w*|Programmable\w*|Python\w*|Plot\w*|Probe\w*|Point\w*|Calculator|Gradient\w*|Append\w*")
NEAR = 0.7  # of difflib: vonmises is near von_mises, Result is near nothing


def called(node):
    """Name of the function that a call calls, without what stands before its last dot."""
    return node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")


def literal(node):
    return node.value if isinstance(node, ast.Constant) and isinstance(node.value, str) else None


def draws(call):
    name = called(call)
    if name == "CreateExtractor":
        return bool(call.args) and literal(call.args[0]) in DRAWING_EXTRACTORS
    return name in DRAWING_CALLS or DRAWING_VIEW.fullmatch(name) is not None


def imported_modules(tree):
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            yield node.module


def sources(script, folders):
    """Trees of the script and of the modules that it imports from the folders, each once. Raises SyntaxError, OSError, ValueError."""
    waiting, seen = [script], set()
    while waiting:
        path = waiting.pop()
        if path in seen:
            continue
        seen.add(path)
        with open(path, "rb") as file:
            tree = ast.parse(file.read(), filename=path)
        yield tree
        for module in imported_modules(tree):
            found = (os.path.join(folder, module + ".py") for folder in folders)
            waiting.extend(candidate for candidate in found if os.path.isfile(candidate))


def channel_of(text, channels):
    """A source is named after its channel, or after the file of a recording that ParaView has opened: surface, surface.pvd."""
    name = re.sub(r"^(\w+?)(_\d+)?\.\w+\*?$", r"\1", text)
    return name if name in channels else None


def named_channels(tree, channels):
    """Channels by the registrationName of sources; by any text of that name where one is computed."""
    names = [keyword.value for node in ast.walk(tree) if isinstance(node, ast.Call) for keyword in node.keywords
             if keyword.arg == "registrationName"]
    if not names or any(literal(name) is None for name in names):
        names = [node for node in ast.walk(tree) if literal(node) is not None]
    return {channel_of(literal(name), channels) for name in names} - {None}


def listed(name, known):
    """What is allowed, the nearest first."""
    near = difflib.get_close_matches(name, known, 1, 0.0)
    return ", ".join(near + [other for other in known if other not in near])


def wrong_sources(tree, channels):
    """Sources that ought to be channels: producers, and readers whose name is near one. Text and line."""
    for call in (node for node in ast.walk(tree) if isinstance(node, ast.Call)):
        kind, keywords = called(call), {keyword.arg: keyword.value for keyword in call.keywords}
        name = literal(keywords.get("registrationName"))
        if name is None or channel_of(name, channels) or not (kind == "TrivialProducer" or kind.endswith("Reader")):
            continue
        if kind == "TrivialProducer" or difflib.get_close_matches(name.split(".")[0], channels, 1, NEAR):
            yield f"the source '{name}' is no channel; allowed: {listed(name, channels)}", call.lineno


def kind_of(call):
    """Kind of a requested parameter by its default: "text", "number", or "parameter" if the default is computed or None."""
    default = next((keyword.value for keyword in call.keywords if keyword.arg == "default"), call.args[1] if len(call.args) > 1 else None)
    if isinstance(default, ast.UnaryOp):
        default = default.operand
    if isinstance(default, ast.JoinedStr) or literal(default) is not None:
        return "text"
    return "number" if isinstance(default, ast.Constant) and isinstance(default.value, (int, float)) else "parameter"


def wrong_arrays(tree, used, fields):
    """Arrays requested as ("CELLS", name) that no channel in use has and that the script does not make, if the name is a literal."""
    pairs = [node for node in ast.walk(tree) if isinstance(node, (ast.List, ast.Tuple)) and len(node.elts) == 2
             and literal(node.elts[0]) == "CELLS" and literal(node.elts[1])]
    texts = [literal(node) for node in ast.walk(tree) if literal(node)]
    asked = [literal(pair.elts[1]) for pair in pairs]
    known = list(dict.fromkeys(name for channel in used for name in ARRAYS.get(channel, ())))
    for pair, name in zip(pairs, asked):
        if fields and name in known and name not in fields:
            yield f"the array '{name}' is not handed over, it is not among the pipeline's fields: {', '.join(fields)}", pair.lineno
        if name in known or texts.count(name) > asked.count(name):
            continue
        owners = [channel for channel, arrays in ARRAYS.items() if name in arrays]
        if owners:
            yield f"the array '{name}' is one of {', '.join(owners)}; the script uses {', '.join(used)}", pair.lineno
        elif difflib.get_close_matches(name, known, 1, NEAR):
            yield f"'{name}' is no array of {', '.join(used)}; allowed: {listed(name, known)}", pair.lineno


def missing_at_points(tree, points):
    """Arrays requested as ("POINTS", name) that a channel has at points only on demand, in a script that makes none itself."""
    if any(MAKES_POINT_ARRAYS.fullmatch(called(node)) for node in ast.walk(tree) if isinstance(node, ast.Call)):
        return
    for pair in (node for node in ast.walk(tree) if isinstance(node, (ast.List, ast.Tuple)) and len(node.elts) == 2):
        name = literal(pair.elts[1])
        if literal(pair.elts[0]) == "POINTS" and name in POINT_ARRAYS and name not in points:
            yield f"the array '{name}' is one of cells; at points too with parameters = {{ point_data = \"{', '.join([*points, name])}\" }}", pair.lineno


def problems(trees, channels, fields, points):
    """Lines about sources and arrays of the script, the first tree."""
    named = set().union(*(named_channels(tree, channels) for tree in trees))
    used = [channel for channel in channels if channel in named] or list(channels)
    return [*wrong_sources(trees[0], channels), *missing_at_points(trees[0], points), *([] if "history" in named else wrong_arrays(trees[0], used, fields))]


def needs(script, pipelines, fields, points, channels):
    """Lines as above, without their order."""
    found = set()
    trees = list(sources(script, [os.path.dirname(script), pipelines]))
    found |= {f"problem {text} ({os.path.basename(script)}:{line})" for text, line in problems(trees, channels, fields, points)}
    for tree in trees:
        calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call)]
        if any(draws(call) for call in calls):
            found.add("draws")
        found |= {f"channel {name}" for name in named_channels(tree, channels)}
        found |= {f"{kind_of(call)} {literal(call.args[0])}" for call in calls
                  if called(call) == "parameter" and call.args and literal(call.args[0])}
        if any(called(call) == "parameter" and not (call.args and literal(call.args[0])) for call in calls):
            found.add("any_parameter")
    return found


def main():
    if len(sys.argv) < 6:
        sys.exit(__doc__)
    script, pipelines, channels = sys.argv[1], sys.argv[2], sys.argv[5:]
    fields, points = ([name for name in listed.split(",") if name] for listed in sys.argv[3:5])
    if importlib.util.find_spec("paraview") is None:
        print("lacks ParaView's Python module is missing (Debian: apt-get install python3-paraview)")
    try:
        lines = sorted(needs(script, pipelines, fields, points, channels))
    except SyntaxError as error:
        lines = [f"error {error.msg} ({os.path.basename(error.filename or script)}:{error.lineno})"]
    except (OSError, ValueError) as error:
        lines = [f"error {error}"]
    print("\n".join(" ".join(line.split()) for line in lines))


if __name__ == "__main__":
    main()
