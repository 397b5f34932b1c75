"""report_test.py BRECCIA RUN SCRATCH CASE: `breccia report` on the run, whose title is markup. SCRATCH is made anew."""
import base64
import csv
import json
import os
import re
import shutil
import signal
import stat
import subprocess
import sys
import time
from html.parser import HTMLParser

breccia, run, scratch, case = sys.argv[1:5]
STRETCH = 1e-3  # of areas: faces in a frame are strained, those of the history are in the reference shape
VOID = {"meta", "img", "path", "circle", "rect"}
shutil.rmtree(scratch, ignore_errors=True)
os.makedirs(scratch)


def expect(true, what):
    if not true:
        sys.exit(f"FAILED: {what}")


class Page(HTMLParser):
    """Elements as (tag, attributes, text in it), and the rows of tables by their caption: lists of (text, value)."""

    def __init__(self, file):
        super().__init__(convert_charrefs=True)
        self.open, self.elements, self.tables, self.caption = [], [], {}, ""
        self.source = open(file, encoding="utf-8").read()
        self.feed(self.source)
        self.close()
        expect(not self.open, f"elements are left open: {self.open}")

    def handle_starttag(self, tag, attributes):
        element = [tag, dict(attributes), ""]
        self.elements.append(element)
        if tag == "table":
            self.caption = ""
        if tag == "tr":
            self.tables.setdefault(self.caption, []).append([])
        if tag in ("td", "th"):
            self.tables[self.caption][-1].append([element, None])
        if tag == "data" and any(e[0] in ("td", "th") for e in self.open):
            self.tables[self.caption][-1][-1][1] = float(element[1]["value"])
        if tag not in VOID:
            self.open.append(element)

    def handle_startendtag(self, tag, attributes):
        self.elements.append([tag, dict(attributes), ""])

    def handle_endtag(self, tag):
        expect(self.open and self.open[-1][0] == tag, f"</{tag}> ends {self.open[-1][0] if self.open else 'nothing'}")
        element = self.open.pop()
        if tag == "caption":
            self.caption = element[2]

    def handle_data(self, data):
        for element in self.open:
            element[2] += data

    def all(self, tag):
        return [e for e in self.elements if e[0] == tag]

    def values(self, caption):
        """The numbers of each row by the words of the row; the row of heads is none."""
        return {row[0][0][2]: [cell[1] for cell in row[1:]] for row in self.tables[caption] if row[-1][0][0] == "td"}


def report(folder, *options, ends=0, environment=None):
    """@return what is said on stderr"""
    done = subprocess.run([breccia, "report", folder, *options], capture_output=True, text=True, env=environment)
    expect(done.returncode == ends, f"report {folder} {options} ends with {done.returncode}: {done.stdout}{done.stderr}")
    return done.stderr


def plain(folder=run, *options):
    file = f"{scratch}/page.html"
    report(folder, "-o", file, "--no-pictures", *options)
    return Page(file)


def copied(name):
    folder = f"{scratch}/{name}"
    shutil.copytree(run, folder, ignore=shutil.ignore_patterns(".*.tmp"))  # of a test that reports on the same run
    return folder


def last_line():
    rows = list(csv.reader(open(f"{run}/history.csv")))
    return dict(zip(rows[0], map(float, rows[-1])))


def page():
    """A whole page for readers and machines, that needs nothing beside it."""
    shown = plain()
    expect(shown.source.startswith("<!DOCTYPE html>"), "a type of document")
    expect([e[1].get("lang") for e in shown.all("html")] == ["en"], "a language")
    expect(len(shown.all("h1")) == len(shown.all("main")) == len(shown.all("title")) - len(shown.all("svg")) + sum(
        1 for e in shown.all("svg") if "aria-hidden" in e[1]) == 1, "one heading, main part and title")
    ids = [e[1]["id"] for e in shown.elements if "id" in e[1]]
    expect(len(ids) == len(set(ids)), "ids are used once")
    for tag, attributes, _ in shown.elements:
        for name in ("src", "href", "xlink:href", "action", "data"):
            target = attributes.get(name, "#")
            expect(target.startswith("#") or target.startswith("data:image/png;base64,"), f"{tag} wants {target[:80]}")
            expect(not target.startswith("#") or target == "#" or target[1:] in ids, f"nothing is at {target}")
        expect(not any(name.startswith("on") for name in attributes), f"{tag} acts")
    expect("default-src 'none'" in next(e[1]["content"] for e in shown.all("meta") if "content" in e[1]), "a policy")
    expect(not re.search(r"url\(|@import", shown.source), "style that is fetched")
    for svg in (e for e in shown.all("svg") if "aria-hidden" not in e[1]):
        expect(svg[1].get("role") == "img", "charts are pictures")
    for row_head in (e for e in shown.all("th")):
        expect(row_head[1].get("scope") in ("row", "col"), "heads of tables name what they head")
    expect("breccia run" in shown.source or "/breccia" in shown.source, "the command")
    sections = [e[1]["id"] for e in shown.all("section") if "id" in e[1]]
    for name in ("energy", "cracks", "fragments", "contacts", "gauges", "effort", "origin"):
        expect(name in sections, f"section {name} of {sections}")
    report(run, "--no-pictures")
    expect(Page(f"{run}/report.html").all("h1"), "the page is in the run's folder")


def numbers():
    """Those of the history and of the summary, to the last digit."""
    shown, end = plain(), last_line()
    energy = shown.values("Energy at the last line of the history")
    for words, column in (("kinetic", "kinetic [J]"), ("elastic", "elastic [J]"), ("fracture, mode I", "joint mode 1 [J]"),
                          ("friction in joints", "joint friction [J]"), ("residual, unaccounted", "residual [J]"),
                          ("relative residual", "relative residual")):
        expect(energy[words] == [end[column]], f"{words} {energy[words]}, in the history {end[column]!r}")
    stock = sum(energy[words][0] for words in energy if not re.search("residual|outside", words))
    expect(abs(stock - energy["put in: start and outside"][0]) <= 2 * abs(end["residual [J]"]) + 1e-15, f"the terms add up to {stock}")
    joints = shown.values("At the last line of the history")
    for words, count, area in (("all", "broken joints", "broken area [m2]"), ("mode I", "broken in mode I", "broken area in mode I [m2]"),
                               ("mode II", "broken in mode II", "broken area in mode II [m2]")):
        expect(joints[words] == [end[count], end[area]], f"{words} {joints[words]}")
    summary = json.load(open(f"{run}/summary.json"))
    phases = shown.values("Wall time by phase")
    for name, seconds in summary["phases"].items():
        expect(seconds == 0 or phases[name][0] == seconds, f"phase {name}")
    tiles = [e[1]["value"] for e in shown.all("data")]
    for name in ("steps", "elements", "joints", "ranks", "element_steps_per_s"):
        expect(summary[name] in map(float, tiles), f"{name} {summary[name]}")
    inputs = json.load(open(f"{run}/provenance.json"))["inputs"]
    for entry in inputs:
        expect(entry["sha256"] in shown.source and entry["file"] in shown.source, f"input {entry}")


def markup():
    """A title, a folder and a command that look like HTML are text."""
    folder = copied("<img src=x onerror=alert(1)>")
    shown = plain(folder)
    expect(not shown.all("script") and not shown.all("img"), "markup of a name is markup of the page")
    expect([e[2] for e in shown.all("h1")] == ["<script>alert(1)</script> & co"], f"title {shown.all('h1')}")
    expect("<img src=x onerror=alert(1)>" in "".join(e[2] for e in shown.all("td")), "the folder is named")


def no_paraview():
    """Where ParaView is missing there is a page that says so."""
    file, environment = f"{scratch}/page.html", dict(os.environ, PATH="/nowhere")
    said = report(run, "-o", file, environment=environment)
    expect("no pvpython" in said and "apt-get install paraview" in said, f"said: {said}")
    shown = Page(file)
    expect("no pvpython" in shown.source and not shown.all("img"), "the page says that there are no pictures")
    environment = dict(os.environ, BRECCIA_PARAVIEW_PLUGIN=f"{scratch}/lost/Breccia.so")
    for name in ("pvpython", "xvfb-run"):
        open(f"{scratch}/{name}", "w").write("#!/bin/sh\necho 'it broke' >&2\nexit 1\n")
        os.chmod(f"{scratch}/{name}", 0o755)
    environment["PATH"] = f"{scratch}:{environment['PATH']}"
    said = report(run, "-o", file, environment=environment)
    expect("lost/Breccia.so is missing" in said, f"said: {said}")
    for name in ("Breccia.so", "draw_report.py"):
        open(f"{scratch}/{name}", "w").close()
    environment["BRECCIA_PARAVIEW_PLUGIN"] = f"{scratch}/Breccia.so"
    said = report(run, "-o", file, environment=environment)
    expect("could not read or draw the run: it broke" in said, f"said: {said}")
    open(f"{scratch}/xvfb-run", "w").write("#!/bin/sh\nfor word; do case $word in */breccia-report-*) "
                                           "echo 'TypeError: of the script' >$word/messages.log;; esac; done\nexit 1\n")
    said = report(run, "-o", file, environment=environment)
    expect("could not read or draw the run: TypeError: of the script" in said, f"said: {said}")
    open(f"{scratch}/xvfb-run", "w").write("#!/bin/sh\nsleep 60 & wait\n")
    start = time.monotonic()
    said = report(run, "-o", file, "--time-limit", "1", environment=environment)
    expect(time.monotonic() - start < 30 and "took more than 1 s" in said, f"said after {time.monotonic() - start} s: {said}")


def lives(process):
    """Whether it runs; one that has ended and that nobody has asked for does not."""
    try:
        return open(f"/proc/{process}/stat").read().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


def killed():
    """A report that is killed leaves no ParaView and no screen behind."""
    for name in ("pvpython", "xvfb-run"):
        open(f"{scratch}/{name}", "w").write(f"#!/bin/sh\nsleep 60 &\necho $$ $! >{scratch}/made\nmv {scratch}/made {scratch}/processes\nwait\n")
        os.chmod(f"{scratch}/{name}", 0o755)
    for name in ("Breccia.so", "draw_report.py"):
        open(f"{scratch}/{name}", "w").close()
    environment = dict(os.environ, BRECCIA_PARAVIEW_PLUGIN=f"{scratch}/Breccia.so", PATH=f"{scratch}:{os.environ['PATH']}")
    going = subprocess.Popen([breccia, "report", run, "-o", f"{scratch}/page.html"], env=environment)
    begin = time.monotonic()
    while not os.path.exists(f"{scratch}/processes") and time.monotonic() - begin < 60:
        time.sleep(0.02)
    processes = [int(process) for process in open(f"{scratch}/processes").read().split()]
    expect(all(lives(process) for process in processes), "the processes run")
    going.kill()
    going.wait()
    begin = time.monotonic()
    while any(lives(process) for process in processes) and time.monotonic() - begin < 30:
        time.sleep(0.02)
    expect(not any(lives(process) for process in processes), f"of {processes} some live on")


def unfinished():
    """Runs that go on, were killed, or left files that are not whole."""
    folder = f"{scratch}/killed"
    case_file = f"{scratch}/case.toml"
    shutil.copy(f"{run}/case.toml", case_file)
    going = subprocess.Popen([breccia, "run", case_file, "-o", folder, "--progress", "none", "--trust-geometry",
                              "--set", "output.history_interval='0.01 us'"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    history = f"{folder}/history.csv"
    while going.poll() is None and not (os.path.exists(history) and open(history).read().count("\n") > 3):
        time.sleep(0.02)
    expect(going.poll() is None, f"the run ends too early: {going.stderr.read() if going.poll() else ''}")
    going.send_signal(signal.SIGSTOP)
    shown = plain(folder)
    expect(any(e[1].get("class", "").startswith("state") and e[2] == "running" for e in shown.all("span")), "it is running")
    expect("The run is in progress" in shown.source, "the page states that the run is in progress")
    going.kill()
    going.wait()
    shown = plain(folder)
    expect("interrupted" in shown.source and "did not come to its end" in shown.source, "the page says that it was killed")
    for name in ("history.csv", "status.jsonl"):
        os.truncate(f"{folder}/{name}", os.path.getsize(f"{folder}/{name}") - 5)
    shown = plain(folder)
    expect(shown.source.count("lines that are not whole are left out") == 2, "lines that are cut off are told")
    for name in ("status.jsonl", "case.toml", "provenance.json"):
        os.remove(f"{folder}/{name}")
        expect(f"{name} is missing" in plain(folder).source, f"{name} is told to be missing")


def refusals():
    """Each with one line and the exit code of its kind."""
    for folder in (f"{scratch}/nowhere", scratch, f"{run}/history.csv"):
        said = report(folder, ends=2)
        expect("is no folder of a run" in said and folder in said and said.count("\n") == 1, f"said: {said}")
    for file in (f"{scratch}/nowhere/page.html", scratch):
        said = report(run, "-o", file, "--no-pictures", ends=2)
        expect(file in said and said.count("\n") == 1, f"said: {said}")
    os.mkfifo(f"{scratch}/pipe")
    os.symlink("pipe", f"{scratch}/to_pipe")
    os.symlink("nothing", f"{scratch}/to_nothing")
    for name in ("pipe", "to_pipe", "to_nothing"):
        said = report(run, "-o", f"{scratch}/{name}", "--no-pictures", ends=2)
        expect("is no regular file" in said and said.count("\n") == 1, f"said: {said}")
    expect(stat.S_ISFIFO(os.stat(f"{scratch}/pipe").st_mode) and os.path.islink(f"{scratch}/to_nothing"), "nothing is replaced")
    for name in ("history.csv", "case.toml", "summary.json"):
        before = open(f"{run}/{name}", "rb").read()
        said = report(run, "-o", f"{run}/{name}", "--no-pictures", ends=2)
        expect("this file is no page" in said and said.count("\n") == 1, f"said: {said}")
        expect(open(f"{run}/{name}", "rb").read() == before, f"{name} is kept")
    open(f"{scratch}/page.html", "w").close()
    os.symlink("page.html", f"{scratch}/to_page")
    report(run, "-o", f"{scratch}/to_page", "--no-pictures")
    expect(os.path.islink(f"{scratch}/to_page") and Page(f"{scratch}/page.html").all("h1"), "the page is where the link leads")
    report(run, "--time-limit", "0", ends=1)
    expect(subprocess.run([breccia, "report"], capture_output=True).returncode == 1, "no run is wrong usage")


def paraview():
    """Pictures and statistics of the last frame, by the plugin."""
    file = f"{scratch}/page.html"
    said = report(run, "-o", file)
    expect(said == "", f"said: {said}")
    shown, summary = Page(file), json.load(open(f"{run}/summary.json"))
    expect("ParaView, " not in shown.source, "ParaView has complained")
    images = shown.all("img")
    expect(len(images) >= 4, f"{len(images)} pictures")
    for image in images:
        expect(base64.b64decode(image[1]["src"].split(",")[1]).startswith(b"\x89PNG"), "pictures are PNG")
        expect(len(image[1]["alt"]) > 20, "pictures are described")
    names = [row["name"] for row in csv.DictReader(open(f"{run}/bodies.csv"))]
    supports = [i for i, name in enumerate(names) if name.startswith("support")]
    table = shown.tables["The heaviest fragments at the last frame"]
    expect({row[1][0][2] for row in table[1:]} == {"glass", "projectile"} | {f"support (body {i})" for i in supports},
           f"bodies {[row[1][0][2] for row in table[1:]]}")
    forces = shown.tables["Forces between bodies then"][1:]
    expect(forces and all(cell[0][2] in names for row in forces for cell in row[:2]), f"forces {[r[0][0][2] for r in forces]}")
    heaviest = [row[3][1] for row in table[1:]]
    expect(heaviest == sorted(heaviest, reverse=True) and len(heaviest) == min(10, summary["fragments"]), f"masses {heaviest}")
    joints = shown.values("At the last line of the history")["all"]
    area = shown.values("Fracture surface at the last frame")["area"]
    expect(summary["broken_joints"] > 0 and abs(area[0] - joints[1]) < STRETCH * joints[1], f"areas {area} and {joints}")
    ranks = shown.values("Ranks at the last frame; load: cost over the mean")
    expect(sum(values[0] for values in ranks.values()) == summary["elements"], f"elements of ranks {ranks}")
    expect(sorted(shown.values("Materials")["young"]) == [7.5e10, 7.5e10, 7.5e11], "Young's moduli of the case")
    expect(shown.values("Joints")["energy_mode_1"] == [10], "energy of its joints")
    events_of_the_filter(shown)


def events_of_the_filter(shown):
    """The filter Crack Events with its defaults gives the same events and b-value."""
    plugin = os.path.join(os.path.dirname(os.path.dirname(breccia)), "plugins/lib/breccia/paraview/Breccia/Breccia.so")
    script = f"""
import json
from paraview.simple import *
LoadPlugin({plugin!r}, remote=False, ns=globals())
run = BrecciaReader(FileName={run + "/status.jsonl"!r})
found = CrackEvents(Input=run)
found.UpdatePipeline(run.TimestepValues[-1])
tables = [found.GetClientSideObject().GetOutputDataObject(port) for port in (1, 2)]
facts = {{t.GetFieldData().GetArrayName(i): t.GetFieldData().GetArray(i).GetValue(0) for t in tables for i in range(t.GetFieldData().GetNumberOfArrays())}}
json.dump({{"events": tables[0].GetNumberOfRows(), **facts}}, open({scratch + "/events.json"!r}, "w"))
"""
    with open(f"{scratch}/events.py", "w", encoding="utf-8") as file:
        file.write(script)
    subprocess.run(["pvpython", f"{scratch}/events.py"], check=True, capture_output=True)
    facts = json.load(open(f"{scratch}/events.json"))
    known = shown.values("At the last frame")
    expect(facts["events"] > 1 and known["events"] == [facts["events"]], f"events {known['events']}, of the filter {facts['events']}")
    for words, name in (("b-value", "b_value"), ("magnitude of completeness", "completeness"), ("energy of all events", "energy")):
        expect(known[words] == [facts[name]], f"{words} {known[words]}, of the filter {facts[name]}")
    distance = 1e3 * facts["linking_distance"]
    expect(re.search(r"linked by at most ([\d.]+)\s*mm", shown.source) and
           abs(float(re.search(r"linked by at most ([\d.]+)\s*mm", shown.source)[1]) - distance) < 0.01 * distance, "the distance is printed")


def one_frame():
    """A run with one frame and one crack event has its pictures; one without a whole frame has a reason."""
    meshes = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "meshes")
    folder, file = f"{scratch}/pair", f"{scratch}/page.html"
    subprocess.run([breccia, "run", f"{meshes}/joint_pair/case_smoke.toml", "-o", folder, "--progress", "none"], check=True)
    said = report(folder, "-o", file)
    expect(said == "", f"said: {said}")
    shown = Page(file)
    expect("ParaView, " not in shown.source and len(shown.all("img")) >= 2, f"{len(shown.all('img'))} pictures")
    expect(len(os.listdir(f"{folder}/frames")) >= 1 and "Crack events" in shown.source, "the event is shown")
    shutil.rmtree(f"{folder}/frames")
    report(folder, "-o", file)
    expect("ParaView, frames: the run holds no whole frame" in Page(file).source, "it has no frames")


globals()[case]()
