# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""README.md, the page for strangers: short, its plot the numbers of results/reference, its links and commands there. And one verdict a claim, and the
links of the other READMEs."""

import os
import re
import unittest

from cases import ROOT, call, text_of
from claim_rules import read_verdicts
import front_page
from lmdbench_results import ResultError

MOST_LINES = 60
MOST_WORDS = 120  # before the first command


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

    def test_a_command_comes_soon(self):
        before = re.sub(r"\]\([^)]*\)", "]", self.page.split("```", maxsplit=1)[0])
        self.assertLess(len(re.findall(r"\w[\w'-]*", before)), MOST_WORDS)

    def test_every_method_has_its_use(self):
        self.assertEqual({row["method"].strip("`") for row in table_after(self.page, "| method |")}, set(front_page.METHODS) - {"certified-cold"} | {"exhaustive"})

    def test_the_plot_is_the_tables(self):
        found = front_page.points(text_of("results", "reference", "work-precision.md"), "bunny-hard")
        self.assertEqual([(every, error) for every, _, _, error in found["certified"] + found["certified-cold"]], [(None, 0.0)] * 2)
        self.assertEqual(sorted(every for every, *_ in found["original"]), [1, 2, 5, 10, 20, 50, 100, 200, 500])
        drawn = front_page.draw(found).axes[0]
        self.assertEqual(sum(len(line.get_xdata()) for line in drawn.lines), sum(len(found[series]) for series in front_page.METHODS) + 2)  # and 1 ms
        with self.assertRaises(ResultError):
            front_page.points("## another\n", "bunny-hard")

    def test_each_claim_has_the_ledgers_verdict(self):
        rows = {row[""]: row for row in table_after(text_of("results", "reference", "claims.md"), "| | claim |")}
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
