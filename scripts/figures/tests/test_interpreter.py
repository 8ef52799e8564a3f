# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Scripts under an interpreter without the modules that they need."""

import os
import sys
import unittest
import venv

from cases import FIGURES, SCRIPTS, SharedScratch, call


class Interpreter(SharedScratch):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        venv.create(cls.folder, symlinks=True)
        cls.bare = os.path.join(cls.folder, "bin", "python3")

    def test_every_script_asks(self):
        for script in FIGURES.glob("*.py"):
            text = script.read_text(encoding="utf-8")
            if "__main__" in text:
                self.assertRegex(text, r"(?m)^import interpreter ", script.name)

    def test_scripts_go_on_under_the_distributions_own(self):
        for script in (FIGURES / "figure7.py", SCRIPTS / "baseline.py", SCRIPTS / "report" / "report.py"):
            done = call(self.bare, script, "--help")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(f"usage: {script.name}", done.stdout)

    def test_what_is_missing_is_named_where_no_interpreter_has_it(self):
        done = call(self.bare, FIGURES / "figure7.py", "--help", env={**os.environ, "LMDBENCH_SECOND_INTERPRETER": "1"})
        self.assertEqual(done.returncode, 4)
        self.assertEqual(done.stdout, "")
        self.assertIn(f"{self.bare} has no h5py, matplotlib, numpy (remedy: ./scripts/setup.sh", done.stderr)

    def test_an_interpreter_that_has_them_stays(self):
        done = call(sys.executable, "-c", f"import sys; sys.path.insert(0, {str(FIGURES)!r}); import interpreter; print(sys.executable)")
        self.assertEqual(done.stdout.strip(), sys.executable)


if __name__ == "__main__":
    unittest.main()
