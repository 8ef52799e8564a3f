# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""pip_test.py SOURCE SCRATCH: `pip install` of the tree into an environment of its own, used there; and what a Python hears for
which no module was compiled."""

import shutil
import subprocess
import sys
import unittest
import venv
from pathlib import Path

SOURCE, SCRATCH = Path(sys.argv[1]), Path(sys.argv[2])
QUERY = """
import lmdbench, numpy
corner = numpy.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
tetrahedron = (corner, numpy.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]))
pose = numpy.eye(4)[None]
pose[0, :3, 3] = [1.25, 0, 0]
print(lmdbench.__file__, lmdbench.query(tetrahedron, tetrahedron, pose, cutoff=1.0)[0]["distance"].tolist())
"""


class Pip(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(SCRATCH, ignore_errors=True)

    def test_a_tree_installs_into_an_environment(self):
        venv.create(SCRATCH / "venv", system_site_packages=True, with_pip=False)
        python = SCRATCH / "venv" / "bin" / "python3"
        done = subprocess.run([python, "-m", "pip", "install", "--no-index", "--no-deps", SOURCE], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        done = subprocess.run([python, "-c", QUERY], capture_output=True, text=True, cwd=SCRATCH)
        self.assertEqual(done.returncode, 0, done.stderr)
        file, answer = done.stdout.split(" ", 1)
        self.assertTrue(file.startswith(str(SCRATCH)), file)
        self.assertEqual(answer.strip(), "[0.25]")

    def test_a_python_without_a_compiled_module_is_told_the_remedy(self):
        package = SCRATCH / "bare" / "lmdbench"
        shutil.copytree(SOURCE / "src" / "lmdbench" / "python" / "package", package)
        done = subprocess.run([sys.executable, "-c", "import lmdbench"], capture_output=True, text=True, cwd=package.parent)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("holds no compiled module for this Python", done.stderr)
        self.assertIn("pip install .", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
