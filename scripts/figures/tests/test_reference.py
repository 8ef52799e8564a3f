# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Every table and figure of results/reference is told to have been made by a command that there is at a commit that there is."""

import os
import re
import subprocess
import unittest

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..")
FOLDER = os.path.join(ROOT, "results", "reference")
STUDIES = os.path.join(ROOT, "experiments", "study", "main.cpp")


def rows():
    """(files, command, commits) of the register."""
    with open(os.path.join(FOLDER, "README.md"), encoding="utf-8") as stream:
        cells = [[cell.strip() for cell in line.strip("|\n").split("|")] for line in stream if line.startswith("| `")]
    return [(re.findall(r"`([^`]+)`", files), command, [commit.strip() for commit in commits.split(",")]) for files, command, commits in cells]


def git(*arguments):
    return subprocess.run(["git", "-C", ROOT, *arguments], capture_output=True, text=True, check=False)


class Register(unittest.TestCase):
    def test_every_file_is_told_once(self):
        told = [file for files, _, _ in rows() for file in files]
        self.assertEqual(sorted(told), sorted(name for name in os.listdir(FOLDER) if name != "README.md"),
                         "remedy: a row in results/reference/README.md with command and commit")

    def test_every_command_is_there(self):
        with open(STUDIES, encoding="utf-8") as stream:
            studies = stream.read()
        for files, command, _ in rows():
            for file in re.findall(r"(?:scripts|tests)/[\w/]+\.(?:py|sh)", command):
                self.assertTrue(os.path.exists(os.path.join(ROOT, file)), (files, file))
            for study in re.findall(r"lmdbench-study ([\w-]+)", command):
                self.assertIn(f"add_{study.replace('-', '_')}(", studies, files)
            self.assertRegex(command, r"lmdbench|scripts/|tests/", files)

    def test_every_commit_is_there(self):
        if git("rev-parse", "--is-shallow-repository").stdout.strip() != "false":
            self.skipTest("not a whole working copy: commits cannot be looked up")
        for files, _, commits in rows():
            for commit in commits:
                if commit == "the one that added it":  # a file cannot name the commit that it is in
                    self.assertTrue(git("log", "--format=%h", "--", f"results/reference/{files[0]}").stdout.strip(), files)
                    continue
                # of the history, not only of the store: a clone brings no commit that nothing leads to
                self.assertEqual(git("merge-base", "--is-ancestor", commit, "HEAD").returncode, 0, (files, commit))


if __name__ == "__main__":
    unittest.main()
