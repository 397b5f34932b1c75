"""Small SVG pictures: lines, areas, arrows, texts with sub- and superscripts, curves in axes. The Python library alone.

The same script gives the same bytes everywhere: coordinates have one decimal, there is no date and no random number.
"""

import math
import re
from pathlib import Path

INK, GREY, LIGHT, PALE = "#222", "#777", "#bbb", "#eef1f4"
RED, BLUE, GREEN, ORANGE = "#b3261e", "#1f5fa8", "#2c7a4b", "#c26a00"
FILLS = {RED: "#f6dcda", BLUE: "#dbe7f4", GREEN: "#dcefe3", ORANGE: "#f8e6cf"}


def number(x):
    return f"{x:.1f}".rstrip("0").rstrip(".") if abs(x) >= 0.05 else "0"


def points_text(points):
    return " ".join(f"{number(x)},{number(y)}" for x, y in points)


def escape(text):
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def marked_up(text, size):
    """a_{n} and b^{2} as raised and lowered spans."""
    parts, shift = [], 0
    for plain, sign, inner in re.findall(r"((?:[^_^]|[_^](?!\{))+)|([_^])\{([^}]*)\}", text):
        if plain:
            back = f' dy="{number(-shift)}"' if shift else ""
            parts.append(f"<tspan{back}>{escape(plain)}</tspan>" if shift else escape(plain))
            shift = 0
        else:
            to = 0.28 * size if sign == "_" else -0.36 * size
            parts.append(f'<tspan dy="{number(to - shift)}" font-size="{number(0.75 * size)}">{escape(inner)}</tspan>')
            shift = to
    return "".join(parts)


class Drawing:
    def __init__(self, width, height):
        self.width, self.height, self.parts = width, height, []

    def path(self, points, color=INK, width=1.5, fill="none", closed=False, dash="", opacity=1):
        tag = "polygon" if closed else "polyline"
        extra = f' stroke-dasharray="{dash}"' if dash else ""
        extra += f' fill-opacity="{opacity}"' if opacity != 1 else ""
        self.parts.append(f'<{tag} points="{points_text(points)}" fill="{fill}" stroke="{color}" '
                          f'stroke-width="{width}" stroke-linejoin="round"{extra}/>')

    def line(self, a, b, color=INK, width=1.5, dash=""):
        self.path([a, b], color, width, dash=dash)

    def area(self, points, fill, color="none", width=1, opacity=1):
        self.path(points, color, width, fill, True, opacity=opacity)

    def box(self, x, y, width, height, fill="none", color=INK, line=1.5, dash=""):
        extra = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(f'<rect x="{number(x)}" y="{number(y)}" width="{number(width)}" height="{number(height)}" '
                          f'fill="{fill}" stroke="{color}" stroke-width="{line}"{extra}/>')

    def circle(self, centre, radius, fill="none", color=INK, width=1.5, dash=""):
        extra = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(f'<circle cx="{number(centre[0])}" cy="{number(centre[1])}" r="{number(radius)}" fill="{fill}" '
                          f'stroke="{color}" stroke-width="{width}"{extra}/>')

    def dot(self, at, color=INK, radius=3):
        self.circle(at, radius, color, color, 0)

    def arrow(self, a, b, color=INK, width=1.5, both=False, dash="", head=7):
        length = math.hypot(b[0] - a[0], b[1] - a[1])
        ex, ey = (b[0] - a[0]) / length, (b[1] - a[1]) / length
        back = 0.8 * head
        start = (a[0] + back * ex, a[1] + back * ey) if both else a
        self.line(start, (b[0] - back * ex, b[1] - back * ey), color, width, dash)
        for tip, sign in [(b, 1)] + ([(a, -1)] if both else []):
            foot = (tip[0] - sign * head * ex, tip[1] - sign * head * ey)
            half = 0.38 * head
            self.area([tip, (foot[0] - half * ey, foot[1] + half * ex), (foot[0] + half * ey, foot[1] - half * ex)], color)

    def text(self, at, text, color=INK, size=13, anchor="start", bold=False):
        weight = ' font-weight="bold"' if bold else ""
        for i, line in enumerate(text.split("\n")):
            self.parts.append(f'<text x="{number(at[0])}" y="{number(at[1] + 1.25 * i * size)}" fill="{color}" '
                              f'font-size="{size}" text-anchor="{anchor}"{weight}>{marked_up(line, size)}</text>')

    def save(self, script):
        """Beside the script, under its name."""
        head = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{self.width}" height="{self.height}" '
                f'viewBox="0 0 {self.width} {self.height}" font-family="DejaVu Sans, Verdana, sans-serif">')
        background = f'<rect width="{self.width}" height="{self.height}" fill="#fff"/>'
        body = "\n".join([head, background, *self.parts, "</svg>", ""])
        Path(script).with_suffix(".svg").write_text(body, encoding="utf-8")


class Axes:
    """A plot within a drawing. @param box  x, y, width, height of the plot; @param x, y  (first, last) of the data"""

    def __init__(self, drawing, box, x, y, origin=None):
        self.d, self.box, self.x, self.y = drawing, box, x, y
        ox, oy = origin or (x[0], y[0])
        drawing.arrow(self.at(x[0], oy), self.at(x[1], oy), INK, 1.2)
        drawing.arrow(self.at(ox, y[0]), self.at(ox, y[1]), INK, 1.2)

    def at(self, x, y):
        left, top, width, height = self.box
        return (left + width * (x - self.x[0]) / (self.x[1] - self.x[0]),
                top + height * (1 - (y - self.y[0]) / (self.y[1] - self.y[0])))

    def curve(self, data, color=BLUE, width=2, dash=""):
        self.d.path([self.at(x, y) for x, y in data], color, width, dash=dash)

    def area(self, data, fill, opacity=1):
        self.d.area([self.at(x, y) for x, y in data], fill, opacity=opacity)

    def tick_x(self, x, text, y=None, size=12):
        px, py = self.at(x, self.y[0] if y is None else y)
        self.d.line((px, py - 3), (px, py + 3), INK, 1)
        self.d.text((px, py + 17), text, size=size, anchor="middle")

    def tick_y(self, y, text, x=None, size=12):
        px, py = self.at(self.x[0] if x is None else x, y)
        self.d.line((px - 3, py), (px + 3, py), INK, 1)
        self.d.text((px - 7, py + 4), text, size=size, anchor="end")


def span(first, last, count):
    return [first + (last - first) * i / count for i in range(count + 1)]
