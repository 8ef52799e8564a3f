#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""How old the tables and figures of results/reference are: by how many commits the code that each measures (folders of
src/lmdbench, column "measures" of the register) has changed since the commit that made it. Prints the register's rows; with
--mark writes "older" into the last column of those whose code has changed, and takes it from the others. Comments count as
code, texts (*.md) and build files do not. Exit code 1 when a row that the code has left behind is not marked; with
--none-older when there is such a row at all, as none may be in a release."""

import argparse
import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
FOLDER = os.path.join(ROOT, "results", "reference")
REGISTER = os.path.join(FOLDER, "README.md")
ADDED = "the one that added it"  # a file cannot name its own commit
OLDER = "older"
COMMITS, MARK = 2, 4  # columns


class Row:
    """One line of the register."""

    def __init__(self, line):
        files, self.command, commits, measures, self.mark = (cell.strip() for cell in line.strip().strip("|").split("|"))
        self.files = re.findall(r"`([^`]+)`", files)
        self.commits = [commit.strip() for commit in commits.split(",")]
        self.folders = [os.path.join("src", "lmdbench", folder) for folder in measures.split()]


def rows():
    with open(REGISTER, encoding="utf-8") as stream:
        return [Row(line) for line in stream if line.startswith("| `")]


def git(*arguments):
    return subprocess.run(["git", "-C", ROOT, *arguments], capture_output=True, text=True, check=False)


def age(row):
    """Commits since the row's oldest one that changed the code that it measures; one more for changes that are not committed."""
    commits = [git("log", "-1", "--format=%H", "--", f"results/reference/{row.files[0]}").stdout.strip() if commit == ADDED else commit
               for commit in row.commits]
    code = [f"{folder}/*.{ending}" for folder in row.folders for ending in ("cpp", "h", "def")]
    since = 0
    for commit in commits:
        done = git("rev-list", "--count", f"{commit}..HEAD", "--", *code)
        if done.returncode != 0:
            raise SystemExit(f"error: {REGISTER}: {row.files[0]}: {commit}: {done.stderr.strip()} (remedy: a commit of this history)")
        if git("diff", "--quiet", commit, "HEAD", "--", *code).returncode != 0:  # what was taken back is no change
            since = max(since, int(done.stdout))
    return since + (git("diff", "--quiet", "HEAD", "--", *code).returncode != 0)


def unmarked(ages):
    """Files that are older than their code without saying so."""
    return [row.files[0] for row, since in ages if since > 0 and row.mark != OLDER]


def rewrite(change):
    """Writes the register again after change(row, cells) of each of its rows, with what stands in its cells."""
    lines = Path(REGISTER).read_text(encoding="utf-8").split("\n")
    for i, line in enumerate(lines):
        if line.startswith("| `"):
            cells = line.strip().strip("|").split("|")
            change(Row(line), cells)
            lines[i] = "|" + "|".join(cells) + "|"
    Path(REGISTER).write_text("\n".join(lines), encoding="utf-8")


def mark(ages):
    older = {row.files[0]: since > 0 for row, since in ages}

    def change(row, cells):
        cells[MARK] = f" {OLDER} " if older[row.files[0]] else " "
    rewrite(change)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--mark", action="store_true", help="write what is found into the register")
    parser.add_argument("--none-older", action="store_true", help="marked or not, a row that the code has left behind is a failure")
    arguments = parser.parse_args()
    if git("rev-parse", "--is-shallow-repository").stdout.strip() != "false":
        print("not a whole working copy: commits cannot be looked up (remedy: git fetch --unshallow)", file=sys.stderr)
        return 4
    ages = [(row, age(row)) for row in rows()]
    if arguments.mark:
        mark(ages)
    for row, since in ages:
        print(f"{since:5}  {row.files[0]}")
    left = [] if arguments.mark else unmarked(ages)
    if left:
        print(f"older than their code and not marked: {', '.join(left)} (remedy: scripts/reference_ages.py --mark, or make them again)", file=sys.stderr)
    older = sum(since > 0 for _, since in ages)
    print(f"{older} of {len(ages)} are older than their code")
    return 1 if left or (arguments.none_older and older) else 0


if __name__ == "__main__":
    raise SystemExit(main())
