"""How a test tries a command of a README; nothing is run here.

A command is tried as it stands, or in a short form: the same command with options appended. Placeholders stand for the values of PLACEHOLDERS.
What no rule covers is a Problem, so that a new kind of command needs a rule before the tests pass.
"""

import re
import shlex
from dataclasses import dataclass
from pathlib import Path

from commands import PICTURES, PROGRAM

# Words of a README that stand for something of the reader's own -> what the tests put there.
RUN_GOING_ON = "runs/going_on"
PLACEHOLDERS = {
    "CASE.toml": "meshes/glass_impact/case_smoke.toml",
    "CASE": "meshes/glass_impact/case_smoke.toml",
    "bar/case.toml": "meshes/notched_bar/case.toml",
    "case.toml": "meshes/block_wall/case.toml",
    "FILE": "meshes/glass_impact/geometry.geo",
    "runs/FOLDER": RUN_GOING_ON,
    "runs/RUN": RUN_GOING_ON,
    "RUN": RUN_GOING_ON,
    "KEY": "joint.penalty",
    "COMMAND": "check",
    "FOLDER": "runs/folder",
    "TOPIC": "contact",
    "N": "2",
}
VALUES = {"ON", "OFF"}  # capitals that stand for themselves
# A word in capitals that is neither an option (-L) nor a unit ("5 N"), an ellipsis, or <something>.
PLACEHOLDER = re.compile(r"(?<![\w.-])(?<!\d )[A-Z][A-Z_]*(?!\w)|\.\.\.|…|<[^>]*>")

TEST_PROGRAM = "build/release/tests/unit/base/test_base"  # of tests/README.md
NO_RULE = "no rule of tests/readme/plans.py says how to try"
STEPS = "--set time.max_steps=10"
NEEDS_CASE = {"run", "check", "live", "race"}
SUBCOMMANDS = NEEDS_CASE | {"mesh", "control", "insitu", "explain", "resume", "diff", "schema", "report", "guide"}
# tests/bare runs these on a bare system; bench and detection take minutes. Here their names and options are looked up in `./run help`.
LOOKED_UP = {"demo", "desktop", "test", "build", "install", "package", "guide", "bench", "detection"}


class Problem(Exception):
    """A command that cannot be tried, or was and failed."""


@dataclass
class Plan:
    """How a command is tried. Once tried: `text` has ended with 0, the files are there."""
    text: str                # what is typed
    kind: str                # typed, control, live, ctest, look_up, presets
    needs: tuple = ()        # adaptor, paraview, guide, lists (of apt)
    run_folder: str = ""     # where summary.json must be, of a run that has ended well
    file: str = ""           # what it must leave
    section: str = ""        # sub-command of ./run whose part of the help counts
    options: tuple = ()      # what the help must list; presets that must be


def substituted(text):
    """The text with every placeholder replaced. Throws Problem for one without a value."""
    for name in sorted(PLACEHOLDERS, key=len, reverse=True):
        text = re.sub(rf"(?<![\w./=\[-])(?<!\d ){re.escape(name)}(?![\w./-])", lambda _, name=name: PLACEHOLDERS[name], text)
    for word in shlex.split(text):
        for unknown in PLACEHOLDER.findall(re.sub(r"^[A-Z_]+=", "", word)):
            if unknown not in VALUES:
                raise Problem(f"'{unknown}' is no placeholder of tests/readme/plans.py")
    return text


def words_of(text):
    """Words of a command, without what stands before the program: variables, sudo, mpiexec."""
    words = shlex.split(text)
    while words and (words[0] == "sudo" or re.fullmatch(r"[A-Z_]+=\S*", words[0])):
        words.pop(0)
    if words and words[0] == "mpiexec":
        words = words[next((i for i, word in enumerate(words) if Path(word).name == "breccia"), 0):]
    return words


def options_of(words):
    return tuple(word.split("=")[0] for word in words if word.startswith("-"))


def plan_of(command, only_look_up=False):
    """How to try a command, or to look it up. Throws Problem where no rule says so."""
    text = substituted(command.text)
    if re.search(r"[;|&]", re.sub(r"'[^']*'|\"[^\"]*\"", "", text)):
        raise Problem("several commands in a line: give each a line of its own")
    words = words_of(text)
    if words and words[0].startswith("build/release/tests/"):  # a test program: its tests are only listed
        return Plan(" ".join([words[0], "--gtest_list_tests", *map(shlex.quote, words[1:])]), "typed")
    rule = next((rule for programs, rule in RULES if words and words[0] in programs), None)
    if rule is None:
        raise Problem(f"{NO_RULE} this command")
    if len(words) == 1 and command.inline and words[0] != "./run":
        return Plan(f"command -v {words[0]}", "typed", ("paraview",) if words[0] in PICTURES else ())
    if only_look_up and words[0] == "./run":
        return look_up_script(words)
    if only_look_up and words[0] in (*PICTURES, "paraview"):
        return Plan(f"command -v {words[0]}", "typed", ("paraview",))
    if only_look_up and Path(words[0]).name == "breccia":
        return look_up_program(words)
    return rule(text, words, text != command.text)


def output_folder(words):
    """Where `breccia run` writes."""
    for option, value in zip(words, words[1:]):
        if option in ("-o", "--output"):
            return value
    case = next(word for word in words if word.endswith(".toml"))
    return "runs/" + Path(case).parent.name


def subcommand(words):
    sub = next((word for word in words[1:] if not word.startswith("-")), "")
    if sub and sub not in SUBCOMMANDS:
        raise Problem(f"breccia has no sub-command '{sub}'")
    return sub


def look_up_program(words):
    return Plan(f"{words[0]} {subcommand(words)} --help", "look_up", options=options_of(words))


def plan_program(text, words, own):
    """@param own  whether the case is the reader's own, so that its folder may hold results of the command before"""
    sub = subcommand(words)
    if sub in ("", "explain") or "--help" in words:
        return Plan(text, "typed")
    case = next((word for word in words if word.endswith(".toml")), "")
    arguments = [word for word in words[2:] if not word.startswith("-")]
    if (sub in NEEDS_CASE and not case) or (sub == "mesh" and not arguments) or (sub == "control" and len(arguments) < 2) or not words[2:]:
        return look_up_program(words)  # "`breccia mesh` reports on the mesh"
    if sub == "run":
        # A case is called after what it needs: here its text is not read.
        adaptor = "--live" in words or "--insitu" in words or Path(case).stem.endswith("insitu")
        return Plan(f"{text} {'-f ' if own else ''}{STEPS}", "typed", ("adaptor",) if adaptor else (), output_folder(words))
    if sub == "race":
        lap = "" if {"--steps", "--time"} & set(words) else " --steps 5"
        return Plan(text + lap + ("" if "--algorithms" in words else " --algorithms ms,sorted_grid --buffers 1"), "typed")
    if sub == "insitu":
        if arguments == ["replay"] and len(words) == 3:
            return look_up_program(words)
        if arguments != ["info"]:
            raise Problem(f"{NO_RULE} a replay: on which recordings?")
        return Plan(text, "typed", ("adaptor",))
    if sub == "guide":
        return Plan(f"{text} --address", "typed", ("guide",))
    if sub == "resume":
        return look_up_program(words)  # tests/end_to_end goes on with runs
    return Plan(text, sub if sub in ("control", "live") else "typed")


def look_up_script(words):
    return Plan("./run help", "look_up", section=words[1] if len(words) > 1 else "", options=options_of(words[2:]))


def plan_script(text, words, _):
    """./run"""
    sub = words[1] if len(words) > 1 else "help"
    if sub in LOOKED_UP:
        return look_up_script(words)
    if sub == "insitu":
        return Plan(f"{text} --set time.max_steps=40", "typed", ("adaptor",), "runs/insitu")
    if sub == "scaling":
        size = "--largest 20000" if "--cases" in words else "--cases e6 --largest 900"
        return Plan(f"{text} --preset release {size} --steps 5 --set time.max_steps=5 --repeat 1 --no-ceiling", "typed",
                    file="runs/scaling/scaling.csv")
    if sub not in ("help", "packages"):
        raise Problem(f"{NO_RULE} './run {sub}'")
    return Plan(text, "typed")


def plan_picture(text, words, _):
    return Plan(text, "typed", ("paraview",), file=next((word for word in words if word.endswith(".png")), ""))


def plan_viewer(text, words, _):
    """paraview, a stub here: the run must have left the file that it opens."""
    return Plan(text, "typed", file=next((word for word in words[1:] if "/" in word), ""))


def plan_ranks(text, words, _):
    """mpiexec without a program: its options."""
    if any(not word.startswith("-") and not word.isdigit() for word in words[1:]):
        raise Problem(f"{NO_RULE} mpiexec with another program")
    return Plan(f"{text}{'' if '-n' in words else ' -n 1'} true", "typed")


def plan_ctest(text, words, _):
    """The tests are only listed: they run beside this one."""
    return Plan(f"{text} -N", "ctest", ("adaptor",) if "catalyst" in words else ())


def plan_python(text, words, _):
    """A script of the repository is there; those that pages name take minutes or have tests of their own."""
    if len(words) < 2 or not re.match(r"(tests|solver|plugins)/.*\.py$", words[1]):
        raise Problem(f"{NO_RULE} a Python script of the reader's")
    return Plan(f"test -f {words[1]}", "typed")


def plan_cmake(text, words, _):
    """Presets are only looked up: the build is what is being tested."""
    if {"--build", "--target"} <= set(words):
        return Plan(text, "typed")  # by the stub, which builds nothing
    presets = tuple(value for option, value in zip(words, words[1:]) if option == "--preset")
    if words[1:3] == ["--build", "build/release"] and "--target" in words:
        return Plan("test -d build/release", "typed")
    if not presets:
        raise Problem(f"{NO_RULE} cmake without --preset")
    return Plan(text, "presets", options=presets)


def plan_python(text, words, _):
    """A script of the repository: that it is there and is Python."""
    script = next((word for word in words[1:] if word.endswith(".py")), "")
    if not script:
        raise Problem(f"{NO_RULE} python3 without a script")
    return Plan(f"python3 -c 'import ast, sys; ast.parse(open(sys.argv[1], encoding=\"utf-8\").read())' {script}", "typed")


def plan_packages(text, words, _):
    files = [word for word in words if "/" in word]
    if files:
        if not all(re.match(r"(\./)?build/packages/breccia", file) for file in files):
            raise Problem(f"{NO_RULE} the installation of {', '.join(files)}")
        return Plan("./run help", "look_up", section="package", options=("build/packages",))
    return Plan(f"{text.replace('sudo ', '', 1)} --simulate", "typed", ("lists",))


RULES = [
    (("./run",), plan_script),
    (("breccia", PROGRAM), plan_program),
    (PICTURES, plan_picture),
    (("paraview",), plan_viewer),
    (("mpiexec",), plan_ranks),
    (("ctest",), plan_ctest),
    (("cmake",), plan_cmake),
    (("python3",), plan_python),
    (("apt-get",), plan_packages),
    (("python3",), plan_python),
    ((TEST_PROGRAM,), lambda text, words, _: Plan(text, "typed")),
]


def part_of_help(text, section):
    """What `./run help` says about one sub-command: its own lines, and those that name it."""
    lines, inside, found = text.split("\n"), False, []
    for line in lines:
        if re.match(r"  \w", line):
            inside = line.split()[0] == section
        if inside or re.search(rf"\b{re.escape(section)}\b", line):
            found.append(line)
    return "\n".join(found)


def not_in_help(plan, text):
    """What the plan looks up and the help does not tell of."""
    if plan.section and not re.search(rf"^  {re.escape(plan.section)}\b", text, re.MULTILINE):
        return [plan.section]
    told = part_of_help(text, plan.section) if plan.section else text
    return [option for option in plan.options if not re.search(rf"(?<![\w-]){re.escape(option)}(?![\w-])", told)]
