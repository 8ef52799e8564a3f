#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Puts what scripts/reference.sh left in a folder into results/reference. A file of the same name is copied, but a page keeps its own head, which
answers its question; of a PART.txt each table takes the place of the one with the same columns in the page PART.md or PART-*.md, and what stands round
the tables is written by hand: the pages that were touched are named, to be read. A page shows at most seven columns of a table: those that it has
already. The whole table goes to tables/PAGE.csv beside it. In the register a row whose pages were renewed as a whole names the new commit, any other
keeps its commits and names it beside them."""

import argparse
import csv
import functools
import itertools
import os
import re
import shutil
import subprocess
from pathlib import Path

import reference_ages

MOST_COLUMNS = 7


def blocks(text):
    """The text as runs of lines, each a table or none."""
    return re.findall(r"(?:^\|.*\n)+|(?:^(?!\|).*\n)+", text if text.endswith("\n") else text + "\n", re.MULTILINE)


def is_table(block):
    return block.startswith("|")


def rows_of(block):
    """The cells of a table, without the line under its names."""
    lines = block.strip().split("\n")
    return [[cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip()[1:].removesuffix("|"))] for line in [lines[0], *lines[2:]]]


def tables_of(text):
    """[(heading that it stands under, block)]"""
    heading, found = "", []
    for block in blocks(text):
        if is_table(block):
            found.append((heading, block))
        else:
            heading = next((line.lstrip("# ") for line in reversed(block.split("\n")) if re.match("##+ ", line)), heading)
    return found


def places(names, of):
    """Where a table's columns stand among those of another one, in their order; None where it is no part of it."""
    found = []
    for name in names:
        place = next((i for i in range(found[-1] + 1 if found else 0, len(of)) if of[i] == name), None)
        if place is None:
            return None
        found.append(place)
    return found


def projected(block, columns):
    """Some columns of a table."""
    names, *rows = [[row[i] if i < len(row) else "" for i in columns] for row in rows_of(block)]
    return "".join(f"{line}\n" for line in ["| " + " | ".join(names) + " |", "|" + "---|" * len(names), *("| " + " | ".join(row) + " |" for row in rows)])


def with_tables_of(page, output):
    """The page with the tables of an output, how many of its own were not renewed, the whole of those of which it shows a part, [(heading, block)], and
    the headings under which all are new. A table under the same heading comes first, of several the first; none that is under the heading of another one of the page."""
    fresh, whole, kept, heading = tables_of(output), [], [], ""
    renewed = []
    written, headings = blocks(page), {under for under, _ in tables_of(page)}
    for i, block in enumerate(written):
        if not is_table(block):
            heading = tables_of(block + "|\n")[-1][0] or heading
            continue
        names = rows_of(block)[0]
        able = [(under != heading, len(rows_of(other)[0]), k) for k, (under, other) in enumerate(fresh)
                if (under == heading or under not in headings) and places(names, rows_of(other)[0])]
        if not able:
            kept.append(heading)
            continue
        renewed.append(heading)
        _, width, k = min(able)
        _, other = fresh.pop(k)
        if width > len(names):
            whole.append((heading, other))
            other = projected(other, places(names, rows_of(other)[0]))
        written[i] = other
    return "".join(written), len(kept), whole, set(renewed).difference(kept)


def write_whole(page, whole, kept, renewed):
    """tables/PAGE.csv, or PAGE-2.csv, ... where tables have other columns: all of them, beside the headings that they stand under. Where tables of the
    page were kept, so are the rows of headings that are not all new."""
    folder = Path(page).parent / "tables"
    folder.mkdir(exist_ok=True)
    written = {}
    for file in sorted(folder.glob(f"{Path(page).stem}*.csv")):
        if re.fullmatch(r"(-[0-9]+)?", file.stem.removeprefix(Path(page).stem)):
            with file.open(encoding="utf-8", newline="") as stream:
                names, *rows = csv.reader(stream)
            if kept:
                written[tuple(names[1:])] = (file, rows)
            else:
                file.unlink()
    groups = {names: {} for names in written}
    for heading, block in whole:
        names, *rows = rows_of(block)
        groups.setdefault(tuple(names), {}).setdefault(heading, []).extend([heading, *(cell.replace("**", "").strip("*") for cell in row)] for row in rows)
    for names, fresh in groups.items():
        if names not in written:
            numbered = (folder / f"{Path(page).stem}{'' if number == 1 else f'-{number}'}.csv" for number in itertools.count(1))
            written[names] = (next(file for file in numbered if not file.exists()), [])
        file, before = written[names]
        headings = dict.fromkeys([*(row[0] for row in before), *fresh])
        rows = [row for heading in headings for row in fresh.get(heading) or (row for row in before if row[0] == heading and heading not in renewed)]
        if not rows:
            file.unlink()
            continue
        with file.open("w", encoding="utf-8", newline="") as stream:
            csv.writer(stream, lineterminator="\n").writerows([["table", *names], *rows])


def head_and_body(page):
    """Up to the first heading below the title, and the rest."""
    parts = re.split(r"(?m)^(?=## )", page, maxsplit=1)
    return parts[0], parts[1] if len(parts) > 1 else ""


@functools.cache
def parts():
    """Those of scripts/reference.sh."""
    command = [os.path.join(reference_ages.ROOT, "scripts", "reference.sh"), "--list"]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()


def part_of(name):
    """The part that a page is of."""
    return max((part for part in parts() if name.startswith(part)), key=len, default="")


def shown_as(body, page):
    """A text whose tables show no more columns than those of the page do."""
    shown = [rows_of(block)[0] for _, block in tables_of(page)]
    written = blocks(body)
    for i, block in enumerate(written):
        if is_table(block):
            columns = next((found for names in shown if (found := places(names, rows_of(block)[0]))), None)
            written[i] = projected(block, columns) if columns else block
    return "".join(written)


def renew(path, run):
    """Renews one file of results/reference. Returns how many of its tables stay old, or None where nothing of it was made again."""
    name = os.path.basename(path)
    same, made = os.path.join(run, name), os.path.join(run, part_of(name) + ".txt")
    if not name.endswith(".md"):
        if not os.path.exists(same):
            return None
        shutil.copyfile(same, path)
        return 0
    source = same if os.path.exists(same) else made
    if not os.path.exists(source):
        return None
    output, page = (Path(file).read_text(encoding="utf-8") for file in (source, path))
    body = head_and_body(output)[1] if source == same else ""
    page_then = head_and_body(page)[0] + shown_as(body, page) if body else page
    text, kept, whole, renewed = with_tables_of(page_then, output)
    if text == page and kept == len(tables_of(page)) > 0:
        return None
    Path(path).write_text(text, encoding="utf-8")
    if whole or renewed:
        write_whole(path, whole, kept, renewed)
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
