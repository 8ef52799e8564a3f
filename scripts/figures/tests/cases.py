# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""What tests of the scripts share: where things are, folders that go away again, calls. Import it before the scripts: it lets them be found."""

import contextlib
import io
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

FIGURES = pathlib.Path(__file__).resolve().parents[1]
SCRIPTS, ROOT = FIGURES.parents[:2]
PROGRAM = os.environ.get("LMDBENCH_PROGRAM", str(ROOT / "build" / "release" / "lmdbench"))
sys.path[:0] = [str(folder) for folder in (FIGURES, SCRIPTS / "report", SCRIPTS / "ci", SCRIPTS)]


def text_of(*path):
    """Of a file of the project, or of any other by its whole path."""
    return ROOT.joinpath(*path).read_text(encoding="utf-8")


def call(*words, **options):
    return subprocess.run([*map(str, words)], capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL, **options)


class Scratch(unittest.TestCase):
    """Every test has a folder of its own."""

    def setUp(self):
        self.folder = self.enterContext(tempfile.TemporaryDirectory())

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, name, text):
        file = pathlib.Path(self.folder, name)
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
        return str(file)

    def read(self, *names):
        return pathlib.Path(self.folder, *names).read_text(encoding="utf-8")

    def printed(self, main, *arguments, code=0):
        """What main() of a script prints; it has to leave with this exit code."""
        stream = io.StringIO()
        with contextlib.redirect_stdout(stream), contextlib.redirect_stderr(stream):
            self.assertEqual(main(list(arguments)), code, stream)
        return stream.getvalue()


class SharedScratch(Scratch):
    """All tests of a class share a folder, and what is made there once."""

    @classmethod
    def setUpClass(cls):
        cls.folder = cls.enterClassContext(tempfile.TemporaryDirectory())

    def setUp(self):
        """The folder is there."""
