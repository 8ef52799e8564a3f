# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Every table and figure of results/reference is told to have been made by a command that there is at a commit that there is, and to be older than
its code where it is."""

import csv
import io
import os
import re
import subprocess
import unittest
import unittest.mock

from cases import ROOT, Scratch, text_of
import reference_ages
from reference_ages import ADDED, FOLDER, Row, age, git, rows, unmarked
from reference_write import MOST_COLUMNS, name_commit, part_of, parts, places, renew, rows_of, tables_of, with_tables_of


class Register(unittest.TestCase):
    def test_every_file_is_told_once(self):
        told = [file for row in rows() for file in row.files]
        self.assertEqual(sorted(told), sorted(name for name in os.listdir(FOLDER) if name not in ("README.md", "tables")),
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
                # in the history, not only in the store: a clone has no unreachable commits
                self.assertEqual(git("merge-base", "--is-ancestor", commit, "HEAD").returncode, 0, (row.files, commit))

    def test_what_is_older_than_its_code_says_so(self):
        self.whole_history()
        self.assertEqual(unmarked([(row, age(row)) for row in rows()]), [], "remedy: scripts/reference_ages.py --mark, or make them again")

    def test_a_row_of_two_commits_is_as_old_as_the_older_one(self):
        self.whole_history()
        of = {commits: age(Row(f"| `a.md` | c | {commits} | lmd | |")) for commits in ("02e3e55", "02e3e55, HEAD", "HEAD, 02e3e55")}
        self.assertGreater(of["02e3e55"], 0)
        self.assertEqual(set(of.values()), {of["02e3e55"]})

    def test_code_that_was_changed_and_changed_back_leaves_a_row_as_young(self):
        for differs, expected in ((0, 0), (1, 2)):
            def of_git(command, *arguments, differs=differs):
                ends = subprocess.CompletedProcess(arguments, 0, "2\n", "")
                if command == "diff" and "1234567" in arguments:
                    ends.returncode = differs
                return ends
            with unittest.mock.patch.object(reference_ages, "git", of_git):
                self.assertEqual(age(Row("| `a.md` | c | 1234567 | lmd | |")), expected)


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


class Pages(unittest.TestCase):
    """What a reader of a page meets."""
    JUDGED = ("triangle_accuracy.md", "triangle_accuracy_million.md")  # a test compares them with the program's output

    def pages(self):
        return {file: text_of(FOLDER, file) for row in rows() for file in row.files if file.endswith(".md")}

    def test_a_page_asks_and_answers_first(self):
        for file, text in self.pages().items():
            if file not in self.JUDGED:
                title, _, rest = text.partition("\n")
                self.assertRegex(title, r"^# .*\?$", (file, "remedy: a question as the title"))
                self.assertRegex(rest, r"^\n[!*`\w\[]", (file, "remedy: its answer right below"))
                self.assertLess(max(map(len, rest.splitlines())), 2000, file)

    def test_tables_are_narrow_and_the_whole_of_them_stands_beside(self):
        linked = set()
        for file, text in self.pages().items():
            files = re.findall(r"\]\((tables/[^)]+\.csv)\)", text)
            linked.update(files)
            wholes = [list(csv.reader(io.StringIO(text_of(FOLDER, name)))) for name in files]
            for heading, block in tables_of(text):
                names, *cells = rows_of(block)
                self.assertTrue(len(names) <= MOST_COLUMNS or file in self.JUDGED, (file, heading, names))
                told = [{tuple(row[i] for i in places(names, whole[0])) for row in whole[1:] if row[0] == heading} for whole in wholes if places(names, whole[0])]
                here = {tuple(cell.strip("*") for cell in row) for row in cells}
                self.assertTrue(not any(told) or any(here <= rows_told for rows_told in told), (file, heading, names))
        self.assertEqual(sorted(linked), sorted(f"tables/{name}" for name in os.listdir(os.path.join(FOLDER, "tables"))))


class Writing(unittest.TestCase):
    def test_a_table_takes_the_place_of_the_one_with_its_header(self):
        text, kept, whole, _ = with_tables_of(PAGE, "| mesh  | us |\n|---|---|\n| bunny | 5 |\n| torus | 9 |\nof other things\n")
        self.assertEqual(text, PAGE.replace("| bunny | 7 |", "| bunny | 5 |\n| torus | 9 |").replace("| mesh | us |", "| mesh  | us |"))
        self.assertEqual((kept, whole), (1, []))

    def test_tables_of_one_header_are_taken_in_their_order(self):
        page = "| a |\n|---|\n| 1 |\nthen\n| a |\n|---|\n| 2 |\n"
        self.assertEqual(with_tables_of(page, page.replace("1", "5").replace("2", "6")), (page.replace("1", "5").replace("2", "6"), 0, [], {""}))
        self.assertEqual(with_tables_of(page, "| a |\n|---|\n| 5 |\n"), (page.replace("1", "5"), 1, [], set()))

    def test_the_table_under_the_same_heading_is_taken(self):
        page = "## torus\n| a |\n|---|\n| 1 |\n"
        self.assertEqual(with_tables_of(page, "## bunny\n| a |\n|---|\n| 5 |\n## torus\n| a |\n|---|\n| 6 |\n"), (page.replace("1", "6"), 0, [], {"torus"}))

    def test_a_page_shows_the_columns_that_it_has(self):
        page, whole = "## cost\n| mesh | p99 |\n|---|---|\n| old | 1 |\n", "| mesh | us | p99 | p99 |\n|---|---|---|---|\n| bunny | 5 | 6 | 7 |\n"
        self.assertEqual(with_tables_of(page, whole), ("## cost\n| mesh | p99 |\n|---|---|\n| bunny | 6 |\n", 0, [("cost", whole)], {"cost"}))

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

    def test_a_page_that_was_written_as_a_whole_keeps_its_head_and_its_columns(self):
        page = self.write("kernel.md", "# What?\n\nThis.\n\n## a\nOld.\n\n| p99 |\n|---|\n| 1 |\n")
        self.write("run/kernel.md", "# Sweep\n\n## a\nNew.\n\n| us | p99 |\n|---|---|\n| 5 | 6 |\n")
        self.assertEqual(renew(page, self.path("run")), 0)
        self.assertEqual(self.read("kernel.md"), "# What?\n\nThis.\n\n## a\nNew.\n\n| p99 |\n|---|\n| 6 |\n")
        self.assertEqual(self.read("tables", "kernel.csv"), "table,us,p99\na,5,6\n")

    def test_a_part_that_makes_some_tables_keeps_the_rows_of_the_others_and_those_that_the_page_hides_are_renewed(self):
        page = self.write("worlds.md", "## a\n| p99 |\n|---|\n| 1 |\n## b\n| p99 |\n|---|\n| 2 |\n## c\n| us |\n|---|\n| 3 |\n")
        self.write("tables/worlds-2.csv", "table,us,p99\na,5,1\nb,6,2\n")
        self.write("run/worlds.txt", "## b\n| us | p99 |\n|---|---|\n| 7 | 2 |\n")
        before = self.read("worlds.md")
        self.assertEqual(renew(page, self.path("run")), 2)
        self.assertEqual(self.read("worlds.md"), before)
        self.assertEqual(self.read("tables", "worlds-2.csv"), "table,us,p99\na,5,1\nb,7,2\n")

    def test_rows_of_a_table_that_was_renewed_with_other_columns_go(self):
        page = self.write("worlds.md", "## a\n| p99 |\n|---|\n| 1 |\n## b\n| p99 |\n|---|\n| 2 |\n## c\n| p99 |\n|---|\n| 4 |\n")
        self.write("tables/worlds.csv", "table,us,p99\na,5,1\nb,6,2\nc,8,4\n")
        self.write("run/worlds.txt", "## b\n| us | p99 | most |\n|---|---|---|\n| 7 | 3 | 9 |\n## c\n| p99 |\n|---|\n| 5 |\n")
        self.assertEqual(renew(page, self.path("run")), 1)
        self.assertEqual(self.read("tables", "worlds.csv"), "table,us,p99\na,5,1\n")
        self.assertEqual(self.read("tables", "worlds-2.csv"), "table,us,p99,most\nb,7,3,9\n")

    def test_a_row_names_the_commit_of_what_was_renewed_and_keeps_that_of_what_was_not(self):
        register = self.write("README.md", "| `a.md`, `a.png` | c | 1111111 | lmd | older |\n| `b.md` | c | 2222222 | lmd | |\n")
        with unittest.mock.patch.object(reference_ages, "REGISTER", register):
            name_commit(["a.md", "a.png"], 0, "3333333")
            name_commit(["b.md"], 1, "3333333")
            self.assertEqual([row.commits for row in rows()], [["3333333"], ["2222222", "3333333"]])
