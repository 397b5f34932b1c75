"""Reference of all keys of a case file as Markdown, generated from the program's schema: a page a section.

    python3 reference.py PROGRAM FOLDER

In the HTML the anchor of a key is its path with '.' and '_' replaced by '-' (joint.html#joint-penalty-factor), which Sphinx makes of the heading.
"""

import json
import re
import subprocess
import sys
from pathlib import Path

FACTS = (("unit", "unit"), ("default", "default"), ("choices", "choices"), ("allowed", "allowed"), ("example", "example"),
         ("start", "with `[start]`"))


def output_of(program, *words):
    return subprocess.run([program, *words], capture_output=True, text=True, check=True, stdin=subprocess.DEVNULL).stdout


def plain(path):
    """The path as a user writes it: joint.points for joint[].points."""
    return re.sub(r"\[\]|[<>]", "", path)


def keys_of(program):
    """The table of keys."""
    return json.loads(output_of(program, "schema", "--json"))["keys"]


def code(text):
    """An inline code span; the text may hold backticks."""
    fence = "``" if "`" in text else "`"
    return f"{fence}{text}{fence}"


def escaped(text):
    """Prose of the program: `code` stays, all else that Markdown would read as a mark is escaped."""
    parts = re.split(r"(`[^`]*`)", text)
    return "".join(part if part.startswith("`") else re.sub(r"([\\*_<>\[\]$#|])", r"\\\1", part) for part in parts)


def slug(path):
    """Target of a link to the heading of a key, as MyST names it."""
    return plain(path).replace(".", "").lower()


def value_of(key, fact):
    value = key.get(fact)
    if value is None or value == "" or (fact == "unit" and value == "1"):
        return ""
    if fact == "choices":
        return ", ".join(code(choice) for choice in value)
    if fact in ("unit", "allowed", "start"):
        return escaped(str(value))
    name = plain(key["path"]).split(".")[-1]
    return code(f"{name} = {value}" if fact == "example" else str(value))


def is_section(key):
    return key["type"] in ("section", "section_list")


def entry(key, level):
    """A key: its heading, help and facts."""
    lines = [f"{'#' * level} `{plain(key['path'])}`", "", escaped(key["help"]), ""]
    facts = [] if key["type"] == "section_list" else [("required", "yes")] if key["required"] and not is_section(key) else []
    facts += [(title, value_of(key, fact)) for fact, title in FACTS if not (is_section(key) and fact == "allowed")]
    facts = [(title, value) for title, value in facts if value and not (title == "allowed" and key.get("choices"))]
    if facts:
        lines += ["| | |", "|---|---|"] + [f"| {title} | {value.replace('|', chr(92) + '|')} |" for title, value in facts] + [""]
    return lines


def overview(keys):
    """Names, units and defaults in one table."""
    lines = ["| key | unit | default |", "|---|---|---|"]
    for key in keys:
        default = "required" if key["required"] else value_of(key, "default") or "optional"
        link = f"[`{plain(key['path'])}`](#{slug(key['path'])})"
        lines.append(f"| {link} | {value_of(key, 'unit')} | {default} |")
    return lines + [""]


def section_page(section, keys):
    """@param section  the key of the section itself, or None; @param keys  its keys and those of the sections within it"""
    name = plain(section["path"])
    heading = section.get("allowed", "").partition(", ")[2]
    lines = [f"# {name}", ""]
    if heading.startswith("["):
        lines += [code(heading), ""]
    lines += [escaped(section["help"]), ""]
    if section.get("start"):
        lines += [f"With `[start]`: {escaped(section['start'])}", ""]
    basic = [key for key in keys if key.get("level") != "expert"]
    expert = [key for key in keys if key.get("level") == "expert"]
    lines += overview([key for key in basic if not is_section(key)])
    for key in basic:
        lines += entry(key, 2)
    if expert:
        lines += ["## Expert keys", "", "The defaults of these keys suit nearly every case.", ""]
        for key in expert:
            lines += entry(key, 3)
    return "\n".join(lines) + "\n"


def write_pages(program, folder):
    keys = keys_of(program)
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    tops = {}
    for key in keys:
        tops.setdefault(plain(key["path"]).split(".")[0], []).append(key)
    title = tops.pop("title", [])
    pages = []
    for name, of_section in tops.items():
        write(folder / f"{name}.md", section_page(of_section[0], of_section[1:]))
        pages.append(name)
    lines = ["# Keys of a case file", "",
             "Generated from the table of keys of the program. `breccia explain KEY` prints the same entry in a terminal. Numbers are in SI units; "
             "a text may carry a unit, such as `\"26.6 GPa\"`.", "",
             "| section | keys of |", "|---|---|"]
    lines += [f"| [`{name}`]({name}.md) | {escaped(first_sentence(tops[name][0]['help']))} |" for name in pages]
    lines += [""] + [line for key in title for line in entry(key, 2)]
    lines += ["```{toctree}", ":hidden:", ""] + pages + ["```", ""]
    write(folder / "index.md", "\n".join(lines))


def first_sentence(text):
    return re.split(r"(?<=\.) (?=[A-Z])", text)[0]


def write(file, text):
    """Unchanged files keep their time, so that Sphinx does not read them again."""
    if not file.exists() or file.read_text(encoding="utf-8") != text:
        file.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    write_pages(sys.argv[1], sys.argv[2])
