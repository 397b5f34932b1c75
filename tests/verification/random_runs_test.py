"""What random_runs.py finds wrong with histories."""
import sys

import random_runs


def line(**values):
    columns = random_runs.DISSIPATED + random_runs.STORED + [random_runs.WORK, "time [s]", "residual [J]", "broken joints", "fragments", "step"]
    return {column: 0.0 for column in columns} | {key.replace("_", " ") + " [J]": value for key, value in values.items()}


def expect(lines, *words):
    found, _ = random_runs.judge(lines)
    if len(found) != len(words) or not all(word in text for word, text in zip(words, found)):
        sys.exit(f"FAILED: {found} in place of {words}")


start = line(kinetic=1.0)
expect([start, start])
expect([], "history.csv has no lines")
expect([start, line(kinetic=1.1, residual=-0.1)], "0.1 J from nowhere")
expect([line(kinetic=1.0, plastic=0.5), start], "plastic [J] falls")
