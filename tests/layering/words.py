"""Refuses words that readers of other FDEM and FE codes stop at, in messages, in the comments of headers and in pages.

usage: words.py REPOSITORY
Checks string literals that contain a blank (messages, help, forms, tooltips) of every source in solver/, gui/, catalyst/ and plugins/, and
the comments of headers there, and every page in Markdown without its code. Adjacent literals are read as one text, as the compiler does, and so are the lines of a comment.
Prints one line a word, "file:line: word: what to write instead", and exits 1 when there is any.
"""

import ast
import re
import sys
from fnmatch import fnmatch
from pathlib import Path

FOLDERS = ("solver", "gui", "catalyst", "plugins")
HEADERS = {".hpp", ".h"}
PAGES = ("*.md", *(f"{folder}/**/*.md" for folder in (*FOLDERS, "meshes", "tests")))
SOURCES = {".cpp", ".hpp", ".cxx", ".h", ".py"}

# Word (a regular expression) -> what to write instead.
PLAIN = [
    (r"tells?|told|telling", "state, report, inform, distinguish"),
    (r"says?|said|saying", "state, report; is called"),
    (r"asks?|asked|asking", "request, query; wants"),
    (r"judges?|judged|judging", "check, evaluate"),
    (r"looks?|looked|looking", "check, evaluate, search; appear"),
    (r"goes on|go on|going on|went on|gone on", "continue"),
    (r"lets? go|letting go", "close, release"),
    (r"gone", "removed, ended, missing"),
    (r"held", "constrained, stored, kept"),
    (r"nobody", "no rank, no process, no one; better a passive"),
    (r"whoever", "the user, the process; its name"),
    (r"whatever", "any, regardless of; its name"),
    (r"late", "delayed, pending"),
    (r"hears?|heard|hearing", "receive"),
    (r"calm", "elastic, at rest"),
    (r"settles?|settled|settling", "come to rest, at rest"),
    (r"booked|booking", "accounted"),
    (r"ledgers?", "accumulator, budget"),
    (r"strangers?", "remote viewer, other user"),
    (r"crowding|crowded", "oversubscription, oversubscribed"),
    (r"tellers?", "sink group"),
    (r"takes? over|taken over|taking over|took over", "copy, inherit, adopt"),
]
REFUSED = [(re.compile(rf"\b(?:{word})\b", re.IGNORECASE), plain) for word, plain in PLAIN]

# Code within a comment: names of parameters and functions, and what stands between backticks.
CODE = re.compile(r"`[^`]*`|@param +\w+(?:, \w+)*|\b\w+\(\)")

# (files, a regular expression that covers the word, reason): legitimate uses.
EXCEPTIONS = [
    ("solver/case/topics.cpp", r"static analysis\|settle", "a search word of `breccia explain`, which readers from other codes type"),
    ("*", r"[Ll]ook(?:s|ed|ing)? up|look-ups?", "the term for reading a table or tree"),
    ("*.md", r"\b[Ss]ettl(?:es?|ed|ing)\b", "the term of geotechnics: ground or a structure settles under its weight"),
    ("catalyst/python/live_steering.py", r"say\(line\)", "the name of a function"),
]


class Cpp:
    """Tokens that matter in C++: comments and string literals, raw ones included; strings in comments are comments."""

    TOKEN = re.compile(
        r'(?P<comment>//(?:[^\n\\]|\\.|\\\n)*|/\*.*?\*/)'
        r'|(?P<raw>R"(?P<mark>[^()\\\s]*)\((?P<inside>.*?)\)(?P=mark)")'
        r'|(?P<string>"(?:[^"\\\n]|\\.)*")'
        r"|(?P<character>(?<![0-9a-fA-F])'(?:[^'\\\n]|\\.)+')"
        r"|(?P<include>^[ \t]*#[ \t]*include[^\n]*)", re.DOTALL | re.MULTILINE)


def cpp_texts(source, comments):
    """(kind, text, offset) of every comment or string; adjacent strings, or // lines, are one text.

    Bytes between are replaced by blanks of the same number, so that offsets in the text are offsets in the source.
    """
    pieces = []
    for match in Cpp.TOKEN.finditer(source):
        kind = match.lastgroup if match.lastgroup not in ("mark", "inside") else "raw"
        if kind == "comment" and comments:
            pieces.append(["comment", match.start(), match.end()])
        elif kind in ("string", "raw"):
            pieces.append(["string", match.start(), match.end()])
    joined = []
    for kind, begin, end in pieces:
        if joined and joined[-1][0] == kind and not source[joined[-1][2]:begin].strip():
            joined[-1][2] = end
        else:
            joined.append([kind, begin, end])
    for kind, begin, end in joined:
        marks = r'//[/!]?<?|^[ \t]*\*|/\*+|\*/' if kind == "comment" else r'\\?"|\\n|\\t'
        covered = re.sub(marks, lambda mark: " " * len(mark.group()), source[begin:end], flags=re.MULTILINE)
        yield kind, covered, begin


def python_texts(source):
    """(kind, text, offset) of every string of a Python source, docstrings and the parts of formatted strings included."""
    starts = [0]
    for line in source.splitlines(keepends=True):
        starts.append(starts[-1] + len(line.encode()))
    raw = source.encode()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, (ast.Constant, ast.JoinedStr)) and (
                isinstance(node, ast.JoinedStr) or isinstance(node.value, str)) and hasattr(node, "end_lineno"):
            begin = starts[node.lineno - 1] + node.col_offset
            end = starts[node.end_lineno - 1] + node.end_col_offset
            text = raw[begin:end].decode(errors="replace")
            if text[:2].lower().strip("rfbu")[:1] in ('"', "'"):
                covered = re.sub(r"""["']""", " ", text)
                yield "string", covered, len(raw[:begin].decode())


def markdown_texts(source):
    """Paragraphs of a page; code in fences and spans is blanked."""
    def blank(match):
        return re.sub(r"[^\n]", "_", match.group())

    text = re.sub(r"^ *```.*?^ *```", blank, source, flags=re.DOTALL | re.MULTILINE)
    text = re.sub(r"(?<!`)(`+)(?!`).+?(?<!`)\1(?!`)", blank, text, flags=re.DOTALL)
    for paragraph in re.finditer(r"(?:[^\n]+\n?)+", text):
        yield "page", paragraph.group(), paragraph.start()


def collapsed(text):
    """Text with every run of white space as one blank, and the offset of each of its characters."""
    out, offsets = [], []
    for offset, character in enumerate(text):
        if character.isspace():
            if out and out[-1] == " ":
                continue
            character = " "
        out.append(character)
        offsets.append(offset)
    return "".join(out), offsets


def words_of(file, source):
    """(kind, line, word, plain) of every refused word in a source; file is its path in the repository."""
    suffix = Path(file).suffix
    if suffix == ".md":
        texts = markdown_texts(source)
    else:
        texts = python_texts(source) if suffix == ".py" else cpp_texts(source, suffix in HEADERS)
    found = set()
    for kind, text, begin in texts:
        flat, offsets = collapsed(text)
        if kind == "string" and " " not in flat.strip():
            continue
        if kind == "comment":
            flat = CODE.sub(lambda match: "_" * len(match.group()), flat)
        for files, phrase, _ in EXCEPTIONS:
            if fnmatch(file, files):
                flat = re.sub(phrase, lambda match: "_" * len(match.group()), flat)
        for pattern, plain in REFUSED:
            for match in pattern.finditer(flat):
                line = source.count("\n", 0, begin + offsets[match.start()]) + 1
                found.add((kind, line, match.group().lower(), plain))
    return sorted(found, key=lambda hit: hit[1])


def sources(repository):
    """Path in the repository and text of every source that is checked."""
    for folder in FOLDERS:
        for path in sorted((Path(repository) / folder).rglob("*")):
            if path.suffix in SOURCES:
                yield path.relative_to(repository).as_posix(), path.read_text(encoding="utf-8")
    for path in sorted(path for pattern in PAGES for path in Path(repository).glob(pattern)):
        yield path.relative_to(repository).as_posix(), path.read_text(encoding="utf-8")


def problems(repository, kinds=("string", "comment", "page")):
    """Every refused word as "file:line: word: what to write instead"."""
    return [f"{file}:{line}: {word}: {plain}" for file, text in sources(repository) for kind, line, word, plain in words_of(file, text)
            if kind in kinds]


def unused_exceptions(repository):
    """Exceptions that cover no word any more."""
    texts = [(file, text) for file, text in sources(repository)]
    for files, phrase, _ in EXCEPTIONS:
        pattern = re.compile(phrase.replace(" ", r'[\s"/*]+'))
        if not any(fnmatch(file, files) and pattern.search(text) for file, text in texts):
            yield phrase


def main():
    if len(sys.argv) != 2 or not (Path(sys.argv[1]) / "solver").is_dir():
        sys.exit(__doc__)
    found = problems(sys.argv[1])
    found += [f"tests/layering/words.py:1: the exception {phrase} covers nothing; remove it" for phrase in unused_exceptions(sys.argv[1])]
    print("\n".join(found) if found else "no refused words")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
