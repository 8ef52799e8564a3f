# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Goes the way of a new user: `lmdbench plugin new`, build, `plugin check`, `run --plugin`. Arguments: the program; with --every
each language with gcc and clang, unoptimised and optimised, without it one C project."""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.abspath(sys.argv.pop(1)) if len(sys.argv) > 1 else "lmdbench"
EVERY = "--every" in sys.argv
if EVERY:
    sys.argv.remove("--every")
COMPILERS = {"c": ("gcc", "clang"), "c++": ("g++", "clang++"), "python": ("g++", "clang++")}


def run(*command, **options):
    return subprocess.run(command, capture_output=True, text=True, timeout=600, check=False, **options)


class Projects(unittest.TestCase):
    def setUp(self):
        self.folder = self.enterContext(tempfile.TemporaryDirectory())

    def assert_done(self, done):
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def build(self, language, compiler, level):
        project = os.path.join(tempfile.mkdtemp(dir=self.folder), "mine")
        self.assert_done(run(PROGRAM, "plugin", "new", project, "--language", language))
        kind = "C" if language == "c" else "CXX"
        warnings = "-Wall -Wextra -Werror" + ("" if language == "python" else " -Wpedantic")
        self.assert_done(run("cmake", "-S", project, "-B", project + "/build", f"-DCMAKE_{kind}_COMPILER={compiler}",
                             f"-DCMAKE_{kind}_FLAGS={level} {warnings}", "-DCMAKE_BUILD_TYPE=None",
                             f"-DPython_EXECUTABLE={sys.executable}"))
        self.assert_done(run("cmake", "--build", project + "/build"))
        return project + "/build/mine.so"

    def test_from_nothing_to_a_result(self):
        cases = [(language, compiler, level) for language, compilers in COMPILERS.items() for compiler in compilers
                 for level in ("-O0", "-O3")] if EVERY else [("c", "gcc", "-O3")]
        for case in cases:
            if shutil.which(case[1]) is None:
                continue
            with self.subTest(case=case):
                plugin = self.build(*case)
                questions = [json.loads(line) for line in self.assert_done(run(PROGRAM, "plugin", "check", plugin, "--json")).splitlines()]
                self.assertGreater(len(questions), 8)
                self.assertNotIn("failed", [question["verdict"] for question in questions])

    def test_a_project_is_not_written_over_another(self):
        project = os.path.join(self.folder, "mine")
        self.assert_done(run(PROGRAM, "plugin", "new", project))
        again = run(PROGRAM, "plugin", "new", project)
        self.assertEqual(again.returncode, 2)
        self.assertIn("is there already", again.stderr)
        self.assertEqual(run(PROGRAM, "plugin", "new", self.folder + "/Not A Name").returncode, 2)
        self.assertEqual(run(PROGRAM, "plugin", "new", self.folder + "/mine2", "--language", "cobol").returncode, 2)


if __name__ == "__main__":
    unittest.main()
