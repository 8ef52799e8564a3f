# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Every table and figure of results/reference is told to have been made by a command that there is at a commit that there is, and to be older than
its code where it is."""

import os
import re
import unittest
import unittest.mock

from cases import ROOT, Scratch, text_of
import reference_ages
from reference_ages import ADDED, FOLDER, age, git, rows, unmarked
from reference_write import holds_text_of, name_commit, part_of, parts, renew, section, with_tables_of


class Register(unittest.TestCase):
    def test_every_file_is_told_once(self):
        told = [file for row in rows() for file in row.files]
        self.assertEqual(sorted(told), sorted(name for name in os.listdir(FOLDER) if name != "README.md"),
                         "remedy: a row in results/reference/README.md with command and commit")

    def test_every_command_is_there(self):
        studies = text_of("experiments", "study", "main.cpp")
        for row in rows():
            for file in re.findall(r"(?:scripts|tests)/[\w/]+\.(?:py|sh)", row.command):
                self.assertTrue(os.path.exists(os.path.join(ROOT, file)), (row.files, file))
            for study in re.findall(r"lmdbench-study ([\w-]+)", row.command):
                self.assertIn(f"add_{study.replace('-', '_')}(", studies, row.files)
            self.assertRegex(row.command, r"lmdbench|scripts/|tests/", row.files)

    def test_one_command_makes_every_table(self):
        self.assertIn("figures", parts())
        tables = [file for row in rows() for file in row.files if file.endswith(".md") and file != "verdicts.md"]
        for table in tables:
            self.assertTrue(any(table.startswith(part) for part in parts()), (table, "remedy: a part in scripts/reference.sh"))
        for part in parts():
            self.assertTrue(part == "figures" or any(table.startswith(part) for table in tables), (part, "makes no table"))

    def test_every_folder_is_there(self):
        for row in rows():
            self.assertTrue(row.folders, row.files)
            for folder in row.folders:
                self.assertTrue(os.path.isdir(os.path.join(ROOT, folder)), (row.files, folder))

    def whole_history(self):
        if git("rev-parse", "--is-shallow-repository").stdout.strip() != "false":
            self.skipTest("not a whole working copy: commits cannot be looked up")

    def test_every_commit_is_there(self):
        self.whole_history()
        for row in rows():
            for commit in row.commits:
                if commit == ADDED:
                    self.assertTrue(git("log", "--format=%h", "--", f"results/reference/{row.files[0]}").stdout.strip(), row.files)
                    continue
                # of the history, not only of the store: a clone brings no commit that nothing leads to
                self.assertEqual(git("merge-base", "--is-ancestor", commit, "HEAD").returncode, 0, (row.files, commit))

    def test_what_is_older_than_its_code_says_so(self):
        self.whole_history()
        self.assertEqual(unmarked([(row, age(row)) for row in rows()]), [], "remedy: scripts/reference_ages.py --mark, or make them again")


PAGE = """# Costs

Old words.

| mesh | us |
|---|---|
| bunny | 7 |
More words.

| mesh | LMDs |
|---|---|
| bunny | 3 |
"""


class Writing(unittest.TestCase):
    def test_a_table_takes_the_place_of_the_one_with_its_header(self):
        text, kept = with_tables_of(PAGE, "| mesh  | us |\n|---|---|\n| bunny | 5 |\n| torus | 9 |\nof other things\n")
        self.assertEqual(text, PAGE.replace("| bunny | 7 |", "| bunny | 5 |\n| torus | 9 |").replace("| mesh | us |", "| mesh  | us |"))
        self.assertEqual(kept, 1)

    def test_tables_of_one_header_are_taken_in_their_order(self):
        page = "| a |\n|---|\n| 1 |\nthen\n| a |\n|---|\n| 2 |\n"
        self.assertEqual(with_tables_of(page, page.replace("1", "5").replace("2", "6")), (page.replace("1", "5").replace("2", "6"), 0))
        self.assertEqual(with_tables_of(page, "| a |\n|---|\n| 5 |\n"), (page.replace("1", "5"), 1))

    def test_an_output_may_hold_several_pages(self):
        output = "noise\n# One\nx\n## part\n# Two\n"
        self.assertEqual([section(output, title) for title in ("# One", "# Two", "## part", "# Three", "x")],
                         ["# One\nx\n## part\n", "# Two\n", "## part\n", None, None])

    def test_what_is_written_by_hand_stays(self):
        made = PAGE.replace("| bunny | 7 |", "| bunny | 5 |")
        self.assertTrue(holds_text_of(PAGE, made))
        self.assertFalse(holds_text_of(PAGE + "- Read by hand.\n", made))

    def test_a_page_is_of_the_longest_part_that_it_is_called_after(self):
        self.assertEqual([part_of(name) for name in ("stability-map.md", "stability.md", "recall-bunny-bunny.md", "README.md")],
                         ["stability-map", "stability", "recall", ""])


class WrittenFiles(Scratch):
    def test_a_page_takes_its_parts_tables_and_a_file_of_the_same_name_is_copied(self):
        page, figure = self.write("deform.md", PAGE), self.write("jumps.png", "old")
        self.write("run/deform.txt", "# Costs\n\n| mesh | us |\n|---|---|\n| bunny | 5 |\n")
        self.write("run/jumps.png", "new")
        self.assertEqual([renew(file, self.path("run")) for file in (page, figure, self.path("flat.md"))], [1, 0, None])
        self.assertEqual(self.read("deform.md"), PAGE.replace("| bunny | 7 |", "| bunny | 5 |"))
        self.assertEqual(self.read("jumps.png"), "new")

    def test_a_row_names_the_commit_of_what_was_renewed_and_keeps_that_of_what_was_not(self):
        register = self.write("README.md", "| `a.md`, `a.png` | c | 1111111 | lmd | older |\n| `b.md` | c | 2222222 | lmd | |\n")
        with unittest.mock.patch.object(reference_ages, "REGISTER", register):
            name_commit(["a.md", "a.png"], 0, "3333333")
            name_commit(["b.md"], 1, "3333333")
            self.assertEqual([row.commits for row in rows()], [["3333333"], ["2222222", "3333333"]])
