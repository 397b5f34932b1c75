"""Builds the HTML of the manual: guide, theory, cases, and the reference of all keys.

    python3 build_guide.py PROGRAM FOLDER [--version VERSION] [--sphinx SPHINX_BUILD] [--katex FOLDER]

The pages of the repository (PAGES) are copied into FOLDER/pages; the HTML is in FOLDER/html. In the copies links follow the pages; files of the
repository that are no pages are copied beside them and become downloads; links to folders without a page become plain text; names of keys in
code spans lead to the reference.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import reference

MANUAL = Path(__file__).resolve().parent
REPOSITORY = MANUAL.parent.parent
# Folder or file of the repository -> page of the manual. Those that do not exist are left out.
PAGES = {
    "solver/manual/index.md": "index.md", "solver/manual/guide/*.md": "guide/*.md", "solver/manual/theory/*.md": "theory/*.md",
    "meshes/README.md": "cases/index.md", "meshes/*/README.md": "cases/*.md",
    "README.md": "more/readme.md", "gui/README.md": "more/desktop.md", "catalyst/README.md": "more/in_situ.md",
    "plugins/README.md": "more/paraview.md", "tests/README.md": "more/tests.md", "tests/benchmark/README.md": "more/speed.md",
    "tests/benchmark/detection/README.md": "more/detection.md", "CONTRIBUTING.md": "more/contributing.md", "CHANGELOG.md": "more/changes.md",
}
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\[\]]*\]\([^()]*\)|\[[^\[\]]*\])*)\]\(([^)\s]+)((?:\s[^)]*)?)\)")
PICTURES = {".png", ".svg", ".jpg", ".gif"}


def pages():
    """{file of the repository: page}, both relative."""
    found = {}
    for pattern, page in PAGES.items():
        for file in sorted(REPOSITORY.glob(pattern)):
            name = file.parent.name if file.name == "README.md" and "*" in page else file.stem
            found[file.relative_to(REPOSITORY).as_posix()] = page.replace("*", name)
    return found


def page_of(path, all_pages):
    """The page that a file, or the README of a folder, has become; or None."""
    return all_pages.get(path) or all_pages.get(f"{path}/README.md" if path != "." else "README.md")


def relative(target, page):
    return os.path.relpath(target, Path(page).parent).replace(os.sep, "/")


class Rewriter:
    """Adapts the text of one page to its place in the manual."""

    def __init__(self, source, page, all_pages, keys, folder):
        self.source, self.page, self.pages, self.keys, self.folder = source, page, all_pages, keys, folder

    def link(self, found):
        mark, label, target, title = found.groups()
        label = LINK.sub(self.link, label)
        if re.match(r"\w+:", target) or target.startswith("#"):
            return f"{mark}[{label}]({target}{title})"
        name, _, anchor = target.partition("#")
        path = os.path.normpath(os.path.join(os.path.dirname(self.source), name)).replace(os.sep, "/")
        anchor = f"#{anchor}" if anchor else ""
        page = page_of(path, self.pages)
        if page:
            return f"{mark}[{label}]({relative(page, self.page)}{anchor}{title})"
        file = REPOSITORY / path
        if file.is_dir():
            return label
        if file.is_file():
            copy_new(file, self.folder / "_files" / path)
            return f"{mark}[{label}]({relative('_files/' + path, self.page)}{title})"
        return found.group()  # Sphinx reports it

    def code(self, found):
        name = found.group(1)
        if name not in self.keys:
            return found.group()
        return f"[`{name}`]({relative('reference/' + name.split('.')[0] + '.md', self.page)}#{reference.slug(name)})"

    def prose(self, text):
        """Code spans are set aside while links are replaced."""
        spans = []

        def aside(found):
            spans.append(found.group())
            return f"\0{len(spans) - 1}\0"

        text = LINK.sub(self.link, re.sub(r"(?<!`)(`+)(?!`).+?(?<!`)\1(?!`)", aside, text, flags=re.DOTALL))
        whole = text
        for number, span in enumerate(spans):
            mark = f"\0{number}\0"
            place = whole.find(mark)
            line = whole[whole.rfind("\n", 0, place) + 1:place]
            in_link = re.search(r"\[[^\[\]]*$", line)
            linked = span if line.startswith("#") or in_link else re.sub(r"^`([^`]+)`$", self.code, span)
            text = text.replace(mark, linked)
        return text

    def rewritten(self, text):
        parts = re.split(r"(^ *```.*?^ *```[^\n]*$)", text, flags=re.DOTALL | re.MULTILINE)
        return "".join(part if part.lstrip().startswith("```") else self.prose(part) for part in parts)


def copy_new(source, target):
    target.parent.mkdir(parents=True, exist_ok=True)
    if not target.exists() or target.stat().st_mtime < source.stat().st_mtime or target.stat().st_size != source.stat().st_size:
        shutil.copyfile(source, target)


def stage(program, folder):
    """Writes all pages into the folder, and removes those of before that are no more."""
    reference.write_pages(program, folder / "reference")
    keys = {reference.plain(key["path"]) for key in reference.keys_of(program) if "." in key["path"]}
    all_pages = pages()
    written = set(folder.glob("reference/*.md"))
    for source, page in all_pages.items():
        file = folder / page
        file.parent.mkdir(parents=True, exist_ok=True)
        text = (REPOSITORY / source).read_text(encoding="utf-8")
        reference.write(file, Rewriter(source, page, all_pages, keys, folder).rewritten(text))
        written.add(file)
    for file in set(folder.glob("**/*.md")) - written:
        if "_files" not in file.parts:
            file.unlink()
    copy_new(MANUAL / "conf.py", folder / "conf.py")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--version", default="")
    parser.add_argument("--sphinx", default="sphinx-build")
    parser.add_argument("--katex", default="", help="folder of katex.min.js")
    arguments = parser.parse_args()
    staged, html = arguments.folder / "pages", arguments.folder / "html"
    stage(arguments.program, staged)
    settings = {"html_title": f"Breccia {arguments.version}".strip(), "release": arguments.version, "katex_folder": arguments.katex}
    defined = [word for name, value in settings.items() for word in ("-D", f"{name}={value}")]
    sys.exit(subprocess.run([arguments.sphinx, "-q", "-W", "--keep-going", "-b", "html", "-d", arguments.folder / "doctrees", *defined,
                             staged, html], check=False).returncode)


if __name__ == "__main__":
    main()
