"""What render.py colours by: fields of frames with their units, tables of colours and their ranges; and which files of a run are read."""
import errno
import math
import os
import stat

import numpy as np

# Colours from weak to strong; light enough everywhere for dark cracks to stand out.
SEQUENTIAL = [(0.00, 0.93, 0.94, 0.95), (0.20, 0.72, 0.84, 0.91), (0.45, 0.45, 0.68, 0.82), (0.65, 0.98, 0.85, 0.55),
              (0.85, 0.95, 0.55, 0.35), (1.00, 0.80, 0.22, 0.24)]
DAMAGE = [(0.00, 0.99, 0.90, 0.70), (0.50, 0.93, 0.45, 0.25), (1.00, 0.62, 0.07, 0.15)]
DIVERGING = [(0.0, 0.16, 0.38, 0.66), (0.25, 0.55, 0.73, 0.87), (0.5, 0.94, 0.94, 0.94), (0.75, 0.93, 0.66, 0.52), (1.0, 0.72, 0.13, 0.18)]
FIELDS = {  # title, unit, the unit in SI, array, component (None: the magnitude)
    "von_mises": ("von Mises", "MPa", 1e6, "von_mises", 0),
    "tension": ("largest principal\nstress", "MPa", 1e6, "principal", 0),
    "compression": ("smallest principal\nstress", "MPa", 1e6, "principal", 2),
    **{f"stress_{axes}": (f"stress {axes}", "MPa", 1e6, "stress", i)
       for i, axes in enumerate(("xx", "yy", "zz", "xy", "yz", "xz"))},
    "speed": ("speed", "m/s", 1.0, "velocity", None),
    "displacement": ("displacement", "mm", 1e-3, "displacement", None),
    **{f"displacement_{axis}": (f"displacement {axis}", "mm", 1e-3, "displacement", i) for i, axis in enumerate("xyz")},
    "damage": ("joint damage", "", 1.0, None, None),
    "fragment": None, "body": None,
}


def numbers_of(array, component):
    """A number a cell. component: None for the magnitude."""
    values = array.reshape(len(array), -1)
    return np.linalg.norm(values, axis=1) if component is None else values[:, component]


def rounded_up(value):
    """The next of 1, 1.5, 2, 3, 4, 5, 6, 8, 10 times a power of ten: a bar that ends on a number one can read."""
    if not (value > 0 and math.isfinite(value)):
        return 1.0
    power = 10.0 ** math.floor(math.log10(value))
    return next(step * power for step in (1, 1.5, 2, 3, 4, 5, 6, 8, 10) if step * power >= value * (1 - 1e-9))


def range_of(values, signed):
    """Of the colours: up to what a hundredth of the faces exceeds; to both sides of 0 alike where signs occur."""
    sizes = np.abs(values[np.isfinite(values)])
    high = rounded_up(np.quantile(sizes, 0.99) if len(sizes) > 0 else 1.0)
    return (-high if signed else 0), high


def regular(path):
    """The path of a regular file. A run's folder may be another's: a link would lead out of it, a pipe would be read for ever."""
    if not stat.S_ISREG(os.lstat(path).st_mode):
        raise OSError(errno.EINVAL, "is no regular file", path)
    return path
