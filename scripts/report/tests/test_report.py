# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the page says and holds, without a browser (tests/report opens it in one)."""

import base64
import json
import os
import sys
import tempfile
import unittest

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, ".."), os.path.join(HERE, "..", "..", "figures"),
                os.path.join(HERE, "..", "..", "figures", "tests")]

import report  # noqa: E402
import scene_data  # noqa: E402
from answer import answer, sentence  # noqa: E402
from lmdbench_results import Result, ResultError  # noqa: E402
from page_data import held, moving_recall, time_panels  # noqa: E402
from synthetic import write_result  # noqa: E402
from test_sweep import ROWS, write_sweep  # noqa: E402


class FakeRow:
    def __init__(self, label, error, median, p99, late=0):
        self.label, self.force_error = label, error
        self.numbers = {"frame_time_median_s": median, "frame_time_p99_s": p99, "frames_late": late}

    def number(self, name):
        return self.numbers[name]


def decoded(text):
    return np.frombuffer(base64.b64decode(text), dtype="<f4")


class Answer(unittest.TestCase):
    def test_names_the_least_error_within_the_budget(self):
        rows = [FakeRow("cheap", 0.5, 1e-6, 2e-6), FakeRow("good", 0.1, 1e-5, 9e-4), FakeRow("exact", 0.0, 1e-3, 5e-3)]
        self.assertIn("good leaves the least force error: 10 %", sentence(rows))

    def test_prefers_the_faster_of_two_equals(self):
        self.assertIn("quick", sentence([FakeRow("slow", 0.0, 1e-4, 2e-4), FakeRow("quick", 0.0, 1e-5, 2e-4)]))

    def test_says_how_many_frames_are_late(self):
        self.assertIn("3 of its frames are late", sentence([FakeRow("a", 0.0, 1e-5, 1e-4, late=3)]))

    def test_says_when_no_method_is_in_time_or_judged(self):
        self.assertIn("No method keeps", sentence([FakeRow("a", 0.0, 1e-3, 2e-3)]))
        self.assertIn("No truth probe", sentence([FakeRow("a", float("nan"), 1e-6, 1e-6)]))

    def test_shows_a_row_a_method_with_both_recalls(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "hard.h5")
            write_result(file)
            shown = answer(Result(file))
        self.assertEqual([line[0] for line in shown["rows"]], ["original", "improved"])
        self.assertTrue(all(len(line) == len(shown["headings"]) for line in shown["rows"]))
        self.assertIn("recall [%]", shown["headings"])
        self.assertIn("recall, neighbouring features count [%]", shown["headings"])


class Series(unittest.TestCase):
    def test_holds_values_between_searches(self):
        class Frames:
            time = np.arange(6)
        values = held(Frames, np.array([1, 4]), [10.0, 20.0])
        np.testing.assert_array_equal(values, [np.nan, 10, 10, 10, 20, 20])

    def test_pools_recall_over_a_window(self):
        class Truth:
            recall = np.array([1.0, 0.0, np.nan, 0.5])
            true_count = np.array([2.0, 2.0, 0.0, 4.0])
        np.testing.assert_allclose(moving_recall(Truth), [1.0, 0.5, 0.5, 0.5])

    def test_encodes_what_the_result_holds(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "hard.h5")
            write_result(file, frames=300)
            result = Result(file)
            panels = {panel["id"]: panel for panel in time_panels(result)["panels"]}
            lines = {line["label"]: decoded(line["values"]) for line in panels["force"]["series"]}
            np.testing.assert_allclose(lines["improved"], result.methods["improved"].force_magnitude(), rtol=1e-6)
            self.assertEqual(lines["truth, exponential law"].size, 300)


class Scene(unittest.TestCase):
    def test_keeps_corners_within_half_a_step(self):
        vertices = np.array([[0.0, -1.0, 5.0], [1.0, 3.0, 5.0], [0.25, 1.0, 5.0]])
        mesh = scene_data.mesh_json(vertices, np.array([[0, 1, 2]]))
        steps = np.frombuffer(base64.b64decode(mesh["vertices"]), dtype="<u2").reshape(-1, 3)
        back = np.array(mesh["low"]) + steps / 65535 * np.array(mesh["size"])
        np.testing.assert_allclose(back, vertices, atol=4.0 / 65535)

    def test_tells_why_there_is_no_view(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "hard.h5")
            write_result(file)
            with open(os.path.join(folder, "problem.txt"), "w", encoding="utf-8") as stream:
                stream.write("No view: the mesh is gone")
            self.assertEqual(scene_data.scene(Result(file), folder)["problem"], "No view: the mesh is gone")


class Page(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.file = os.path.join(self.folder.name, "hard.h5")
        write_result(self.file)

    def made(self, *more):
        out = os.path.join(self.folder.name, "out")
        report.main([self.file, "--out", out, *more])
        with open(os.path.join(out, "index.html"), encoding="utf-8") as stream:
            return stream.read(), out

    def test_stands_alone_and_is_the_same_bytes_twice(self):
        text, out = self.made()
        self.assertNotRegex(text, r'(?:src|href)="(?!data:|#)')
        for name in ("work_precision", "figure7"):
            self.assertTrue(os.path.getsize(os.path.join(out, f"{name}.svg")) > 0)
            self.assertTrue(os.path.getsize(os.path.join(out, f"{name}.png")) > 0)
        self.assertEqual(text, self.made()[0])

    def test_shows_studies_and_escapes_what_a_result_says(self):
        study = os.path.join(self.folder.name, "ledger.md")
        with open(study, "w", encoding="utf-8") as stream:
            stream.write("# Who was wrong\n\n| a | b |\n|---|---|\n| 1 | 2 |\n\n![picture](elsewhere.png)\n")
        text, _ = self.made("--study", study)
        self.assertIn("<h2>Who was wrong</h2>", text)
        self.assertIn("<td>1</td>", text)
        self.assertNotIn("elsewhere.png", text)
        self.assertEqual(text.count("</script>"), text.count("<script"))

    def test_data_is_json(self):
        text, _ = self.made()
        data = text.split('id="page-data">', 1)[1].split("</script>", 1)[0]
        self.assertEqual(json.loads(data)["results"][0]["name"], "hard")

    def test_refuses_what_is_no_result(self):
        with self.assertRaises(ResultError):
            report.main([__file__, "--out", self.folder.name])


class SweepPage(unittest.TestCase):
    """A page of sweeps, alone and beside a run."""

    def page(self, *files):
        with tempfile.TemporaryDirectory() as folder:
            names = []
            for name in files:
                names.append(os.path.join(folder, name))
                (write_sweep if name.startswith("sweep") else write_result)(names[-1], *([ROWS, "budget"] if name.startswith("sweep") else []))
            out = os.path.join(folder, "page")
            self.assertEqual(report.main([*names, "--out", out]), 0)
            self.assertTrue(os.path.exists(os.path.join(out, "sweep-budget.svg")))
            with open(os.path.join(out, "index.html"), encoding="utf-8") as stream:
                return stream.read()

    def test_alone_it_has_figure_budgets_crossing_and_every_point(self):
        text = self.page("sweep.h5")
        self.assertIn('<section id="sweep-budget">', text)
        self.assertIn("certified: 0 %", text)
        self.assertIn("<td>33</td>", text)
        self.assertIn("mesh is missing", text)  # in the CSV
        self.assertNotIn('<section id="frames">', text)

    def test_beside_a_run_it_comes_first_and_the_run_keeps_its_sections(self):
        text = self.page("run.h5", "sweep.h5")
        self.assertLess(text.index('<section id="sweep-budget">'), text.index('<section id="work_precision">'))
        self.assertIn('<section id="frames">', text)


if __name__ == "__main__":
    unittest.main()
