"""Sphinx configuration of the manual. build_guide.py copies it with the pages into the build folder and starts Sphinx there.

Nothing is loaded from a network: formulas are drawn by KaTeX, whose files (Debian: libjs-katex) are copied into _static.
"""

import re
import shutil
from pathlib import Path

from docutils.nodes import SkipNode
from sphinx.errors import ConfigError

project = "Breccia"
author = "The Breccia project"
copyright = "The Breccia project"  # noqa: A001, the name is Sphinx's
language = "en"
root_doc = "index"
extensions = ["myst_parser"]
source_suffix = {".md": "markdown"}
exclude_patterns = ["_files"]

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 5
myst_update_mathjax = False
suppress_warnings = ["myst.header"]  # pages that begin below the first level

html_theme = "furo"
html_title = "Breccia"  # build_guide.py adds the version
html_static_path = ["_static"]
html_css_files = ["katex.min.css", "manual.css"]
html_js_files = ["katex.min.js", "formulas.js"]
html_math_renderer = "katex"
html_copy_source = False
html_show_sphinx = False
pygments_style = "default"
highlight_language = "none"

KATEX = ("/usr/share/javascript/katex", "/usr/share/nodejs/katex/dist")
CSS = ".content { width: min(53em, 100%); } table img { max-width: 100%; } .katex { font-size: 1.08em; }\n"
JS = """document.addEventListener("DOMContentLoaded", function () {
  for (const formula of document.querySelectorAll("span.math, div.math")) {
    katex.render(formula.textContent, formula, { displayMode: formula.tagName === "DIV", throwOnError: false });
  }
});
"""


def visit_inline(self, node):
    self.body.append(self.starttag(node, "span", "", CLASS="math notranslate nohighlight"))
    self.body.append(self.encode(node.astext()) + "</span>")
    raise SkipNode


def visit_display(self, node):
    self.body.append(self.starttag(node, "div", CLASS="math notranslate nohighlight"))
    self.body.append(self.encode(node.astext()) + "</div>\n")
    raise SkipNode


def copy_katex(app, config):
    """KaTeX, its style with the fonts that every browser of today reads, and the script that draws formulas."""
    static = Path(app.srcdir, "_static")
    source = next((Path(folder) for folder in (config.katex_folder, *KATEX) if folder and Path(folder, "katex.min.js").exists()), None)
    if source is None:
        raise ConfigError("katex.min.js not found: install libjs-katex, or give its folder as katex_folder")
    (static / "fonts").mkdir(parents=True, exist_ok=True)
    shutil.copy(source / "katex.min.js", static)
    style = (source / "katex.min.css").read_text(encoding="utf-8")
    style = re.sub(r"""(url\([^)]*\.woff2['"]?\) format\(['"]woff2['"]\))(?:,\s*url\([^)]*\) format\([^)]*\))+""", r"\1", style)
    (static / "katex.min.css").write_text(style, encoding="utf-8")
    for font in (source / "fonts").glob("*.woff2"):
        shutil.copy(font, static / "fonts")
    (static / "manual.css").write_text(CSS, encoding="utf-8")
    (static / "formulas.js").write_text(JS, encoding="utf-8")


def make_local(app, exception):
    """Debian's themes load some styles by the paths of a web server, /javascript/...: they are copied beside those that load them."""
    for style in Path(app.outdir, "_static").rglob("*.css") if exception is None else ():
        text = style.read_text(encoding="utf-8")
        for path in set(re.findall(r"url\((/javascript/[^)]+)\)", text)):
            shutil.copy(f"/usr/share{path}", style.parent)
            text = text.replace(f"url({path})", f"url({Path(path).name})")
            style.write_text(text, encoding="utf-8")


def setup(app):
    app.add_config_value("katex_folder", "", "html")
    app.connect("config-inited", copy_katex)
    app.connect("build-finished", make_local)
    app.add_html_math_renderer("katex", (visit_inline, None), (visit_display, None))


