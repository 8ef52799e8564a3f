# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""README.md, the page for strangers: short, with no number that no table of results/reference has, one verdict a claim, links and commands that
there are. And the links of the other READMEs."""

import os
import re
import unittest

from cases import ROOT, call, text_of
from claim_verdicts import read_verdicts

MOST_LINES = 80
# Its row of the sweep where the page's table says no other.
POINTS = {"original": "original, a search every 20 frames", "improved": "improved, a search every 20 frames", "certified": "certified", "nearest": "nearest"}
# Column of the page: columns of the sweep, the second in parentheses or after a comma.
COLUMNS = {"recall, exact feature (or a neighbouring one) [%]": ("recall [%]", "with neighbours [%]"),
           "force error, RMS [% of F_max]": ("force error, RMS [% of F_max]",),
           "time a frame, searches spread evenly: median, 99 % [us]": ("frame, median [us]", "99 % [us]")}


def table_after(text, heading):
    """[{column: cell}] of the table whose first row begins so."""
    lines = text[text.index(heading):].splitlines()
    names = [cell.strip() for cell in lines[0].strip("|").split("|")]
    rows = []
    for line in lines[2:]:
        if not line.startswith("|"):
            break
        rows.append(dict(zip(names, (cell.strip() for cell in line.strip("|").split("|")))))
    return rows


def anchors(text):
    """What GitHub calls the headings of a page."""
    headings = re.findall(r"(?m)^#+ (.*)$", text)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


class FrontPage(unittest.TestCase):
    page = text_of("README.md")

    def test_it_is_short(self):
        self.assertLessEqual(len(self.page.splitlines()), MOST_LINES)

    def test_numbers_of_methods_are_the_tables(self):
        sweep = text_of("results", "reference", "work-precision.md")
        points = {row["point"].strip("*"): row for row in table_after(sweep[sweep.index("\n## bunny-hard"):], "| point |")}
        shown = {row["method"].strip("`"): row for row in table_after(self.page, "| method |")}
        self.assertEqual(set(shown), set(POINTS) | {"exhaustive"})
        for method, point in POINTS.items():
            for column, names in COLUMNS.items():
                numbers = re.findall(r"[\d.]+", shown[method][column])
                self.assertEqual(numbers, [points[point][name] for name in names][:len(numbers)], (method, column))
                self.assertGreaterEqual(len(numbers), 1, (method, column))
        self.assertIn("(", shown["original"]["recall, exact feature (or a neighbouring one) [%]"])

    def test_what_the_command_prints_is_the_summary(self):
        printed = re.search(r"```text\n(.*?)```", self.page, re.DOTALL).group(1).splitlines()
        self.assertGreaterEqual(len(printed), 4)
        summary = [line.rstrip() for line in text_of("results", "reference", "summary.txt").splitlines()]
        for line in printed:
            self.assertIn(line, summary)

    def test_each_claim_has_the_ledgers_verdict(self):
        rows = {row[""]: row for row in table_after(self.page, "| | claim |")}
        ledger = read_verdicts()
        self.assertEqual(list(rows), list(ledger))
        for name, entry in ledger.items():
            self.assertEqual((rows[name]["claim"], rows[name]["verdict"]), (entry["in_short"], entry["verdict"]))
            settings = entry["settings"]
            self.assertRegex(rows[name]["reason"], rf"^{settings['holds']} of {sum(settings.values())} settings: .{{20}}")

    def test_links_of_all_readmes_lead_somewhere(self):
        pages = call("git", "-C", ROOT, "ls-files", "--cached", "--others", "--exclude-standard", "README.md", "*/README.md",
                     "CONTRIBUTING.md").stdout.split() or ["README.md"]
        for page in pages:
            folder = os.path.dirname(os.path.join(ROOT, page))
            for target in re.findall(r"\]\(([^)\s]+)\)", text_of(page)):
                if re.match(r"[a-z]+://", target):
                    continue
                file, _, anchor = target.partition("#")
                path = os.path.join(folder, file) if file else os.path.join(ROOT, page)
                self.assertTrue(os.path.exists(path), (page, target))
                if anchor:
                    self.assertIn(anchor, anchors(text_of(path)), (page, target))

    def test_scripts_that_it_names_are_there(self):
        for page in ("README.md", os.path.join("scripts", "README.md"), os.path.join("src", "lmdbench", "README.md"), os.path.join("experiments", "README.md")):
            for file in re.findall(r"(?<![\w/])(?:\./)?((?:scripts|experiments|tests)/[\w/.-]+\.(?:sh|py|json))", text_of(page)):
                self.assertTrue(os.path.exists(os.path.join(ROOT, file)), (page, file))
