"""Every link, picture, script and style of the built manual leads to a file of it, and to a place that is there; nothing comes from a network.

    python3 html_links.py HTML_FOLDER [--planted]

With --planted the test tests itself: faults are put into a small made-up folder, and each must be found.
"""

import re
import sys
import tempfile
from functools import lru_cache
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

LOADED = {("script", "src"), ("link", "href"), ("img", "src"), ("source", "src"), ("iframe", "src"), ("video", "src"), ("object", "data")}
# Relations of <link> that a browser does not load.
NAMED = {"index", "search", "next", "prev", "author", "copyright", "canonical", "top", "up", "contents", "genindex"}
GENERATED = ("genindex.html", "search.html")  # what leads to them is made by Sphinx


class Page(HTMLParser):
    def __init__(self):
        super().__init__()
        self.links, self.anchors = [], set()  # [(line, target, whether a browser loads it)]

    def handle_starttag(self, tag, attributes):
        of = dict(attributes)
        self.anchors.update(filter(None, (of.get("id"), of.get("name") if tag == "a" else None)))
        for name in ("href", "src", "data"):
            target = of.get(name)
            if target and (tag == "a" or (tag, name) in LOADED):
                loaded = tag != "a" and not (tag == "link" and set((of.get("rel") or "").split()) & NAMED)
                self.links.append((self.getpos()[0], target, loaded))


@lru_cache(maxsize=None)
def page_of(file):
    page = Page()
    page.feed(file.read_text(encoding="utf-8"))
    return page


def faults_of_page(file, folder):
    found = []
    for line, target, loaded in page_of(file).links:
        parts = urlsplit(target)
        place = f"{file.relative_to(folder)}:{line}: {target}"
        if parts.scheme in ("data", "mailto") or target.startswith("javascript:"):
            continue
        if parts.scheme or parts.netloc:
            if loaded:
                found.append(f"{place} comes from a network")
            continue
        aim = (file.parent / unquote(parts.path)).resolve() if parts.path else file
        if folder not in aim.parents:
            found.append(f"{place} leads out of the manual")
        elif not aim.is_file():
            found.append(f"{place} is not there")
        elif parts.fragment and aim.suffix == ".html" and aim.name not in GENERATED and unquote(parts.fragment) not in page_of(aim).anchors:
            found.append(f"{place} has no such place")
    return found


def faults_of_style(file, folder):
    """Files that a style loads."""
    found = []
    text = file.read_text(encoding="utf-8")
    for target in re.findall(r"""url\(\s*['"]?([^'")\s]+)""", text) + re.findall(r"""@import\s+['"]([^'"]+)""", text):
        place = f"{file.relative_to(folder)}: {target}"
        if target.startswith(("data:", "#")):
            continue
        if re.match(r"(\w+:)?//", target):
            found.append(f"{place} comes from a network")
        elif not (file.parent / unquote(urlsplit(target).path)).is_file():
            found.append(f"{place} is not there")
    return found


def faults(folder):
    folder = Path(folder).resolve()
    pages = sorted(folder.rglob("*.html"))
    if not pages:
        return [f"{folder} has no page"]
    found = [fault for page in pages for fault in faults_of_page(page, folder)]
    return found + [fault for style in sorted(folder.rglob("*.css")) for fault in faults_of_style(style, folder)]


PLANTED = {
    '<a href="gone.html">': "is not there",
    '<img src="a/gone.png">': "is not there",
    '<a href="index.html#gone">': "has no such place",
    '<a href="#gone">': "has no such place",
    '<a href="../outside.html">': "leads out of the manual",
    '<script src="https://example.org/a.js"></script>': "comes from a network",
    '<link rel="stylesheet" href="//example.org/a.css">': "comes from a network",
    '<a href="https://example.org"></a><a href="index.html#here"></a><link rel="canonical" href="https://example.org">': "",
}


def planted():
    """What is wrong with this test."""
    wrong = []
    for text, message in PLANTED.items():
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "index.html").write_text(f'<p id="here">{text}</p>', encoding="utf-8")
            Path(folder, "a.css").write_text("@font-face{src:url(data:font/woff2;base64,AA)}", encoding="utf-8")
            found = faults(folder)
            page_of.cache_clear()
            if [bool(message in fault) for fault in found] != ([True] if message else []):
                wrong.append(f"{text}: found {found}")
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "index.html").write_text("", encoding="utf-8")
        Path(folder, "a.css").write_text("@import url(gone.css);a{src:url(gone.woff2)} b{src:url('https://example.org/f.woff2')}", encoding="utf-8")
        if len(faults(folder)) != 3:
            wrong.append(f"style: found {faults(folder)}")
    return wrong


if __name__ == "__main__":
    problems = planted() if "--planted" in sys.argv else faults(sys.argv[1])
    print("\n".join(problems) or "no fault")
    sys.exit(bool(problems))
