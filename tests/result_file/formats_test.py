# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Reads the kept file of every format version with the program and with the figures' reader; both refuse a later version.
Argument: the program."""

import os
import shutil
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts", "figures", "tests"))

from cases import ROOT, Scratch, call  # noqa: E402  (the figures' tests must be found first)
from lmdbench_results import FORMAT_VERSION, Result, ResultError  # noqa: E402

PROGRAM = sys.argv.pop(1)
INPUT_DATA = 3


def kept(version):
    return str(ROOT / "tests" / "result_file" / "formats" / f"format-{version}.h5")


def run(*arguments):
    return call(PROGRAM, *arguments, timeout=120, cwd=ROOT)  # the kept files name meshes below it


class Formats(Scratch):
    def altered(self, version):
        file = shutil.copy(kept(FORMAT_VERSION), self.path("altered.h5"))
        with h5py.File(file, "r+") as h5:
            h5.attrs["format_version"] = np.int64(version)
        return file

    def test_a_file_of_every_version_is_kept_and_read(self):
        for version in range(1, FORMAT_VERSION + 1):
            with self.subTest(version=version):
                result = Result(kept(version))
                self.assertEqual(result.format_version, version)
                self.assertEqual(list(result.methods), ["original", "improved"])
                self.assertEqual(result.time.size, 20)
                improved = result.method("improved")
                self.assertTrue(improved.tracks_locally and improved.reduces)
                self.assertFalse(result.method("original").reduces)
                self.assertEqual(improved.force_magnitude().shape, (20,))
                self.assertEqual(improved.median_times("local_update_time").shape, (20,))
                done = run("compare", kept(version), kept(version), "--json")
                self.assertNotEqual(done.returncode, INPUT_DATA, done.stderr)
                self.assertIn('"differences": []' if '"differences": []' in done.stdout else '"differences":[]', done.stdout)

    def test_the_scene_of_every_version_is_shown(self):
        for version in range(1, FORMAT_VERSION + 1):
            for command in ("export",) if version == 1 else ("report", "export"):  # format 1 has no summary for a page
                with self.subTest(version=version, command=command):
                    done = run(command, kept(version), "--out", self.path(f"{command}-{version}"))
                    self.assertEqual(done.returncode, 0, done.stderr)

    def test_both_hold_the_same_run(self):
        old, new = Result(kept(1)), Result(kept(2))
        for label in new.methods:
            for name in ("force", "lmd_count", "minimum_distance", "counters/node_pairs"):
                if new.method(label).has(name):
                    np.testing.assert_array_equal(old.method(label).read(name), new.method(label).read(name))

    def test_what_format_1_lacks_is_said(self):
        with self.assertRaisesRegex(ResultError, "summary/recall: is missing .remedy: format 1 did not hold it"):
            Result(kept(1)).method("improved").number("recall")
        self.assertTrue(np.isfinite(Result(kept(2)).method("improved").number("lmd_count_median")))

    def test_later_versions_are_refused_with_the_remedy(self):
        for version in (FORMAT_VERSION + 1, 10**12, 0, -1):
            file = self.altered(version)
            with self.assertRaisesRegex(ResultError, "format version.*remedy: ") as caught:
                Result(file)
            done = run("compare", file, kept(FORMAT_VERSION))
            self.assertEqual(done.returncode, INPUT_DATA)
            for text in (str(caught.exception), done.stderr):
                self.assertIn(str(version), text)
                if version > FORMAT_VERSION:
                    self.assertRegex(text, r"lmdbench .*\d+\.\d+\.\d+.* newer one")


if __name__ == "__main__":
    unittest.main()
