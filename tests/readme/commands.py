"""What a README tells its reader to type, and where its links lead.

A command is every line of a ```sh block, and every `code span` whose first word is one of PROGRAMS.
"""

import re
from dataclasses import dataclass
from pathlib import Path

PROGRAM = "build/release/solver/breccia"
PICTURES = ("meshes/breccia-picture", "breccia-picture", "pvbatch", "xvfb-run")
PROGRAMS = {"./run", "breccia", PROGRAM, "mpiexec", "ctest", "cmake", "apt-get", "sudo", "paraview", "python3", *PICTURES}


@dataclass
class Command:
    text: str  # without its comment, on one line
    line: int  # in the README
    inline: bool = False


def strip_comment(text):
    """The text up to a # that a shell would take for a comment."""
    quote = ""
    for i, c in enumerate(text):
        if quote:
            quote = "" if c == quote and (quote == "'" or text[i - 1] != "\\") else quote
        elif c in "'\"":
            quote = c
        elif c == "#" and (i == 0 or text[i - 1].isspace()):
            return text[:i].rstrip()
    return text.rstrip()


def parts(markdown):
    """[(language, first line, text)] of a README: its fenced blocks, and with the language None the paragraphs between them."""
    found, language, start, lines = [], None, 1, []

    def finish(following):
        nonlocal start, lines
        if lines:
            found.append((language, start, "\n".join(lines)))
        start, lines = following, []

    for number, line in enumerate(markdown.split("\n"), 1):
        fence = re.fullmatch(r"\s*```\s*(\{?\w*\}?)\s*", line)
        if fence:
            finish(number + 1)
            language = None if language is not None else fence.group(1)
        elif language is None and not line.strip():
            finish(number + 1)
        else:
            lines.append(line)
    finish(0)
    return found


def blocks(markdown, language):
    return [(line, text + "\n") for kind, line, text in parts(markdown) if kind == language]


def block_below(markdown, heading, language):
    """The first block of that language below a heading, or None."""
    _, found, below = markdown.partition(f"\n{heading}\n")
    texts = blocks(below, language) if found else []
    return texts[0][1] if texts else None


def lines_of(start, text):
    """[(line, command)] of a block: comments stripped, continued lines joined."""
    found, number = [], start
    for line in re.sub(r"\s*\\\n\s*", " \0", text).split("\n"):  # \0 keeps count of the lines joined
        command = strip_comment(line.replace("\0", "")).strip()
        if command:
            found.append((number, command))
        number += 1 + line.count("\0")
    return found


def commands_of(markdown):
    """Every command, in the order of the README; the same text once."""
    found = {}
    for language, start, text in parts(markdown):
        if language == "sh":
            for line, command in lines_of(start, text):
                found.setdefault(command, Command(command, line))
        elif language is None:
            for span in re.finditer(r"(?<!`)(`+)(?!`)(.+?)(?<!`)\1(?!`)", text, re.DOTALL):
                command = " ".join(span.group(2).split())
                if command.split(" ")[0] in PROGRAMS:
                    found.setdefault(command, Command(command, start + text.count("\n", 0, span.start()), True))
    return list(found.values())


def unmarked_commands(markdown):
    """[(line, command)] of lines that look like commands in blocks that are not marked sh, where nobody would try them. A line that
    begins with the bare name is none: it may be output."""
    return [(line, command) for language, start, text in parts(markdown) if language not in (None, "sh")
            for line, command in lines_of(start, text) if command.split(" ")[0] in PROGRAMS - {"breccia"}]


def targets_of(markdown):
    """[(line, target, anchor)] of links and pictures that stay in the repository; no target: the page itself."""
    found = []
    for language, start, text in parts(markdown):
        if language is None:
            plain = re.sub(r"`[^`]*`", lambda span: re.sub(r"[^\n]", " ", span.group()), text)
            for link in re.finditer(r"""\]\(([^)\s]+)[^)]*\)|(?:src|href)="([^"]+)\"""", plain):
                target, _, anchor = (link.group(1) or link.group(2)).partition("#")
                if not re.match(r"\w+:", target):
                    found.append((start + text.count("\n", 0, link.start()), target, anchor))
    return found


def links_of(markdown):
    """[(line, target)] of links and pictures that lead to other files of the repository."""
    return [(line, target) for line, target, _ in targets_of(markdown) if target]


def anchors_of(markdown):
    """What links to headings may name, as a code host makes it of the headings."""
    found = set()
    for language, _, text in parts(markdown):
        for heading in re.findall(r"^#{1,6} +(.*?)[ #]*$", text, re.MULTILINE) if language is None else ():
            words = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
            name = re.sub(r"[^\w\- ]", "", words).replace(" ", "-")
            number = next(n for n in range(len(found) + 1) if (f"{name}-{n}" if n else name) not in found)
            found.add(f"{name}-{number}" if number else name)
    return found


def broken_links(readme):
    """A line for each link without its file, or without its heading in a page."""
    readme = Path(readme)
    found = []
    for line, target, anchor in targets_of(readme.read_text(encoding="utf-8")):
        file = readme.parent / target if target else readme
        if file.is_dir() and (file / "README.md").exists():
            file = file / "README.md"  # which a code host shows below the folder
        if not file.exists():
            found.append(f"{readme}:{line}: no file {target}")
        elif anchor and file.suffix == ".md" and anchor not in anchors_of(file.read_text(encoding="utf-8")):
            found.append(f"{readme}:{line}: no heading #{anchor} in {target or readme.name}")
    return found
