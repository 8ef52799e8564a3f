# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Numbers in words, Markdown tables of them, and files that appear whole or not at all."""

import html
import math
import os


def counted(number, what):
    return f"{number} {what}{'s' * (number != 1)}"


def shown(value, digits=3, missing="-"):
    return missing if value is None or not math.isfinite(value) else f"{value:.{digits}g}"


def percent(share):
    """Less than all is not rounded up to it."""
    words = f"{100.0 * share:.1f}"
    return "> 99.9" if words == "100.0" and share < 1.0 else words


def interval(value, limits):
    return f"{shown(value)} [{shown(limits[0])}, {shown(limits[1])}]"


def as_is(text):
    """Names may hold what is HTML in Markdown: it is shown as it is."""
    return html.escape(str(text), quote=False)


def line(cells):
    return "| " + " | ".join(as_is(cell).replace("|", "\\|") for cell in cells) + " |"


def table(headings, rows):
    """Its lines, and an empty one behind it."""
    return [line(headings), "|" + "---|" * len(headings), *map(line, rows), ""]


def table_text(headings, rows):
    return "\n".join(table(headings, rows)[:-1])


def write_text(text, *path):
    """The file's name."""
    file = os.path.join(*path)
    os.makedirs(os.path.dirname(file) or ".", exist_ok=True)
    with open(file + ".part", "w", encoding="utf-8") as stream:
        stream.write(text)
    os.replace(file + ".part", file)
    return file
