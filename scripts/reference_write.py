#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Puts what scripts/reference.sh left in a folder into results/reference. A file of the same name is copied; what stands
under a page's title becomes that page where the page has no line of its own; else each table of PART.txt takes the place of
the one with the same header in the page PART.md or PART-*.md. What stands round the tables is written by hand: the pages that
were touched are named, to be read. In the register a row whose pages were renewed as a whole names the new commit, any other
keeps its commits and names it beside them."""

import argparse
import functools
import os
import re
import shutil
import subprocess
from pathlib import Path

import reference_ages


def blocks(text):
    """The text as runs of lines, each a table or none."""
    return re.findall(r"(?:^\|.*\n)+|(?:^(?!\|).*\n)+", text if text.endswith("\n") else text + "\n", re.MULTILINE)


def header(block):
    """What a table is known by; None of a text."""
    return " ".join(block.split("\n", 1)[0].split()) if block.startswith("|") else None


def with_tables_of(page, output):
    """The page with the tables of an output, and how many of its own were not renewed. Of several with one header the first is the first."""
    fresh = {}
    for block in blocks(output):
        fresh.setdefault(header(block), []).append(block)
    written = blocks(page)
    kept = 0
    for i, block in enumerate(written):
        name = header(block)
        if name is None:
            continue
        if fresh.get(name):
            written[i] = fresh[name].pop(0)
        else:
            kept += 1
    return "".join(written), kept


def section(output, title):
    """What an output says under a title, with it; None where the title is not there."""
    marks = title.split(" ", 1)[0]
    parts = re.split(f"^(?=#{{1,{len(marks)}}} )", output, flags=re.MULTILINE)
    return next((part for part in parts if marks.startswith("#") and part.split("\n", 1)[0] == title), None)


def holds_text_of(page, text):
    """Whether a text has every line of a page that is of no table."""
    lines = set(text.split("\n"))
    return all(line in lines for block in blocks(page) if header(block) is None for line in block.split("\n"))


@functools.cache
def parts():
    """Those of scripts/reference.sh."""
    command = [os.path.join(reference_ages.ROOT, "scripts", "reference.sh"), "--list"]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()


def part_of(name):
    """The part that a page is of."""
    return max((part for part in parts() if name.startswith(part)), key=len, default="")


def renew(path, run):
    """Renews one file of results/reference. Returns how many of its tables stay old, or None where nothing of it was made again."""
    name = os.path.basename(path)
    if os.path.exists(os.path.join(run, name)):
        shutil.copyfile(os.path.join(run, name), path)
        return 0
    made = os.path.join(run, part_of(name) + ".txt")
    if not name.endswith(".md") or not os.path.exists(made):
        return None
    output, page = (Path(file).read_text(encoding="utf-8") for file in (made, path))
    whole = section(output, page.split("\n", 1)[0])
    text, kept = (whole, 0) if whole and holds_text_of(page, whole) else with_tables_of(page, output)
    if text == page and kept:
        return None
    Path(path).write_text(text, encoding="utf-8")
    return kept


def name_commit(files, kept, commit):
    """Names the commit in the register's row of these files."""
    def change(row, cells):
        if row.files == files:
            cells[reference_ages.COMMITS] = f" {', '.join([commit] if kept == 0 else [*row.commits, commit])} "
    reference_ages.rewrite(change)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("run", help="results/reference-runs/COMMIT")
    arguments = parser.parse_args()
    commit = os.path.basename(os.path.normpath(arguments.run))
    for row in reference_ages.rows():
        old = [renew(os.path.join(reference_ages.FOLDER, file), arguments.run) for file in row.files]
        if all(kept is None for kept in old):
            continue
        kept = sum(1 if kept is None else kept for kept in old)
        name_commit(row.files, kept, commit)
        print(f"{', '.join(row.files)}: " + (f"{kept} tables or files are of before" if kept else "all of it") + "; read what stands round the tables")


if __name__ == "__main__":
    main()
