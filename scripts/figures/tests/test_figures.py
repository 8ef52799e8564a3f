# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the scripts on synthetic results with known contents. Run: python3 -m unittest discover scripts/figures/tests"""

import hashlib
import json
import pathlib
import re
import sys
import unittest.mock
import warnings

import h5py
import numpy as np

from cases import FIGURES, ROOT, Scratch, SharedScratch, call, text_of
import check_format
import claim_rules
import claim_runs
import claims
import claims_section
import figure7
import figure_style
import hard_soft
import lmdbench_results
import summary
import work_precision
from claim_rules import read_verdicts
from lmdbench_results import Result, ResultError, truth_of
from synthetic import misses, write_result

VERDICTS = {"K2": {"verdict": "holds where", "reason": "cutoff small"}}


class ScriptsTest(SharedScratch):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.hard = write_result(f"{cls.folder}/hard.h5", "hard")
        cls.soft = write_result(f"{cls.folder}/soft.h5", "soft", methods=("original", "improved", "certified"), seed=2)
        cls.bare = write_result(f"{cls.folder}/bare.h5", "bare", truth_stride=0)

    def edited(self, name, change, **options):
        """A result on which `change(h5)` was applied."""
        file = write_result(self.path(name), **options)
        with h5py.File(file, "r+") as h5:
            change(h5)
        return file

    def refused(self, code, script, *arguments):
        """What it says, in words for people, when it leaves with this exit code."""
        done = call(sys.executable, FIGURES / script, *arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertNotIn("Traceback", done.stderr)
        return done.stderr


class ReadingTest(ScriptsTest):
    def test_nothing_measured_has_a_median_a_column(self):
        self.assertEqual(lmdbench_results.nan_median(np.empty((3, 0)), axis=0).shape, (0,))
        self.assertTrue(np.isnan(lmdbench_results.nan_median([])))

    def test_warm_up_is_in_no_time(self):
        method = Result(self.hard).method("original")
        self.assertEqual(method.read("local_update_time").shape[0], 5)
        self.assertEqual(method.times("local_update_time").shape[0], 4)
        warm_up = method.read("local_update_time")[0]
        self.assertTrue(np.all(method.median_times("local_update_time") < 0.5 * warm_up))

    def test_only_a_warm_up_is_refused(self):
        file = write_result(self.path("short.h5"), repetitions=1)
        with self.assertRaisesRegex(ResultError, "short.h5: /methods/original/local_update_time.*remedy"):
            Result(file).method("original").times("local_update_time")

    def test_numbers_come_from_the_summary(self):
        """No script may compute under a name of the summary what the program has computed."""
        method = Result(self.hard).method("original")
        self.assertEqual(method.number("recall"), 0.8)
        self.assertEqual(Result(self.hard).number("frames_probed"), 40)
        with self.assertRaisesRegex(ResultError, "summary/no_such_number: is missing"):
            method.number("no_such_number")

    def test_known_lmds_of_a_stretch_are_pooled(self):
        truth = truth_of(Result(self.hard).method("original"))
        counts, chosen = truth.true_count, truth.frames < 1000
        found = counts[chosen & ~misses(2000)[truth.frames]].sum()
        self.assertAlmostEqual(truth.found_in(truth.recall, chosen), found / counts[chosen].sum())
        self.assertNotAlmostEqual(truth.found_in(truth.recall, chosen), np.nanmean(truth.recall[chosen]), places=3)
        self.assertTrue(np.isnan(truth.found_in(truth.recall, truth.frames < 0)))
        self.assertTrue(np.isnan(truth.found_in(np.full(truth.recall.size, np.nan), chosen)), "promises no set")

    def test_no_truth_probe_is_no_truth(self):
        self.assertIsNone(truth_of(Result(self.bare).method("original")))

    def test_other_files_are_refused(self):
        self.write("text.h5", "text")
        with h5py.File(self.path("other.h5"), "w") as h5:
            h5["a"] = 1
        self.edited("newer.h5", lambda h5: h5.attrs.__setitem__("format_version", 3))
        for name, message in (("gone.h5", "cannot be read"), ("text.h5", "cannot be read"), ("other.h5", "not a result"),
                              ("newer.h5", "version 3")):
            with self.assertRaisesRegex(ResultError, f"{name}.*{message}.*remedy"):
                Result(self.path(name))

    def test_scripts_leave_with_the_exit_code_of_wrong_data(self):
        for script in ("figure7.py", "claims.py"):
            said = self.refused(lmdbench_results.EXIT_INPUT_DATA, script, self.path("gone.h5"), self.hard, "--out", self.path("out"))
            self.assertIn("gone.h5", said)

    def test_every_script_names_the_file_that_is_wrong(self):
        self.edited("cut.h5", lambda h5: h5.create_group("polylines"))
        for script, *files in (("front_page.py", self.hard), ("polylines.py", self.path("cut.h5"))):
            said = self.refused(lmdbench_results.EXIT_INPUT_DATA, script, *files, "--out", self.path("out"))
            self.assertTrue(said.startswith(files[0]), said)

    def test_what_was_asked_for_leaves_with_the_exit_code_of_usage_and_no_program_with_that_of_the_environment(self):
        experiment = ROOT / "experiments" / "bunny-hard.json"
        refusing = self.write("refusing", "#!/bin/sh\necho 'lmdbench: error: --level: no such level' >&2\nexit 2\n")
        pathlib.Path(refusing).chmod(0o755)
        there = ("--out", self.path("out"))
        for code, words, script, *arguments in (
                (2, "--level: no such level", "figure2.py", experiment, "--program", refusing),
                (4, "gone: cannot be started.*remedy", "figure2.py", experiment, "--program", self.path("gone")),
                (2, "nosuch.json: is no experiment: .*remedy", "figure1.py", self.path("nosuch.json")),
                (2, "hard.h5: is no experiment: .*remedy", "figure1.py", self.hard),
                (2, "--curves: -3 is below 1", "polylines.py", self.hard, "--curves", "-3")):
            self.assertRegex(self.refused(code, script, *arguments, *there), words)

    def test_a_file_of_another_kind_is_not_printed(self):
        said = self.refused(lmdbench_results.EXIT_INPUT_DATA, "front_page.py", self.hard)
        self.assertLess(len(said), 500)
        self.assertRegex(said, "remedy: name files of the kind")

    def test_scripts_leave_with_the_exit_code_of_the_environment(self):
        occupied = self.write("occupied", "a file where a directory should be")
        self.assertIn("occupied", self.refused(lmdbench_results.EXIT_ENVIRONMENT, "figure7.py", self.hard, self.soft, "--out", occupied))

    def test_figures_of_others_stay(self):
        mine = pathlib.Path(self.path("mine"))
        mine.mkdir()
        for suffix in ("svg", "png"):
            (mine / f"figure7.{suffix}").write_text("my thesis")
            said = self.refused(2, "figure7.py", self.hard, "--out", mine)
            self.assertIn(f"figure7.{suffix}: is no figure of lmdbench", said)
            self.assertEqual((mine / f"figure7.{suffix}").read_text(), "my thesis")
            (mine / f"figure7.{suffix}").unlink()
        for _ in range(2):  # one of ours is replaced
            self.assertEqual(call(sys.executable, FIGURES / "figure7.py", self.hard, "--out", mine).returncode, 0)

    def test_a_sweep_is_told_from_a_run(self):
        def become_sweep(h5):
            h5.create_group("sweep")
        self.assertIn("holds a sweep", self.refused(3, "figure7.py", self.edited("sweep.h5", become_sweep), "--out", self.path("none")))

    def test_an_unfinished_run_is_told_how_to_finish(self):
        file = self.edited("cut.h5.part", lambda h5: h5.attrs.__setitem__("format", "lmdbench-part"))
        with self.assertRaisesRegex(ResultError, "unfinished run.*--resume"):
            Result(file)

    def test_what_a_run_left_out_is_told_from_what_is_lost(self):
        def leave_out(h5):
            experiment = json.loads(h5["/provenance/experiment"][()].ravel()[0])
            experiment["record"] = {"timings": False, "counters": True}
            del h5["/provenance/experiment"], h5["/methods/original/local_update_time"], h5["/methods/improved/force"]
            h5["/provenance/experiment"] = [json.dumps(experiment)]

        result = Result(self.edited("less.h5", leave_out))
        with self.assertRaisesRegex(ResultError, "local_update_time: is missing.*--set /record/timings=true"):
            result.method("original").times("local_update_time")
        with self.assertRaisesRegex(ResultError, r"force: is missing \(remedy: run the experiment again\)"):
            result.method("improved").force_magnitude()
        self.assertEqual(result.repetitions(), result.method("improved").read("local_update_time").shape[0])

    def test_flipped_bytes_are_seen(self):
        file = pathlib.Path(self.path("sealed.h5"))
        with h5py.File(file, "w") as h5:
            h5.attrs["content_sha256"] = np.bytes_("x" * 64)
            h5["numbers"] = [1.0, 2.0]
        content = file.read_bytes().replace(b"x" * 64, b"0" * 64)
        digits = hashlib.sha256(content).hexdigest().encode()
        content = content.replace(b"0" * 64, digits)
        for place, seen in ((None, False), (len(content) - 4, True)):
            changed = bytearray(content)
            if place is not None:
                changed[place] ^= 4
            file.write_bytes(changed)
            with h5py.File(file) as h5:
                if seen:
                    with self.assertRaisesRegex(ResultError, "sealed.h5: attribute content_sha256: its bytes are not those"):
                        lmdbench_results.check_content(file, h5)
                else:
                    lmdbench_results.check_content(file, h5)

    def test_missing_dataset_is_named(self):
        file = self.edited("lacks.h5", lambda h5: h5["/methods/original"].__delitem__("force"))
        with self.assertRaisesRegex(ResultError, "lacks.h5: /methods/original/force: is missing"):
            Result(file).method("original").force_magnitude()


class FormatTest(ScriptsTest):
    def rows(self):
        return check_format.described(text_of(check_format.README))

    def test_the_description_is_read_in_full(self):
        rows = self.rows()
        self.assertEqual(rows["force"], (2, "N"))
        self.assertEqual(rows["local_update_time"], (2, "s"))
        self.assertEqual(rows["counters/NAME"], (1, "1"))
        self.assertEqual(rows["/reference/force_linear"], (2, "N"))
        self.assertEqual(rows["summary/recall"], (1, "1"))

    def test_synthetic_results_have_the_described_format(self):
        for file in (self.hard, self.soft, self.bare):
            self.assertEqual(check_format.differences(Result(file), self.rows()), [])

    def test_what_is_undescribed_or_different_is_found(self):
        def change(h5):
            h5["/methods/original"]["surprise"] = [1.0]
            h5["/path/time"].attrs["units"] = "ms"
            del h5["/path/time"].attrs["long_name"]
            del h5["/methods/original/force"]
            h5["/methods/original"].create_dataset("force", data=[1.0]).attrs["units"] = "N"

        found = "\n".join(check_format.differences(Result(self.edited("changed.h5", change)), self.rows()))
        for text in ("surprise: is not described", "/path/time: has units ms", "/path/time: has no long_name",
                     "/methods/original/force: has 1 axes"):
            self.assertIn(text, found)


class FigureTest(ScriptsTest):
    def tearDown(self):
        figure_style.plt.close("all")

    def figure_bytes(self, main, names, *arguments):
        contents = []
        for turn in ("first", "second"):
            self.printed(main, *arguments, "--out", self.path(turn))
            contents.append([pathlib.Path(self.path(turn), name).read_bytes() for name in names])
        return contents

    def test_figure7_is_the_same_every_time(self):
        first, second = self.figure_bytes(figure7.main, ("figure7.svg", "figure7.png"), self.hard, self.soft)
        self.assertEqual(first, second)
        self.assertNotIn(b"dc:date", first[0])
        self.assertGreater(len(first[1]), 50_000)

    def test_work_precision_is_the_same_every_time(self):
        names = ("work_precision.svg", "work_precision.png")
        first, second = self.figure_bytes(work_precision.main, names, self.hard, self.soft)
        self.assertEqual(first, second)

    def test_figure7_shows_medians_and_says_what_it_cuts(self):
        def busy(h5):
            h5["/methods/original/global_search_time"][:, 10] = 0.5  # in every repetition

        result = Result(self.edited("busy.h5", busy))
        figure = figure7.draw(result, Result(self.soft))
        axes = figure.axes[4]  # global search, left column
        self.assertEqual(axes.get_shared_x_axes().joined(axes, figure.axes[0]), True)
        self.assertLess(axes.get_ylim()[1], 10.0)
        self.assertIn("1 point above, up to 500 ms", [text.get_text() for text in axes.texts])

    def test_figure7_without_truth_says_so(self):
        figure = figure7.draw(Result(self.bare), Result(self.bare))
        texts = [text.get_text() for axes in figure.axes for text in axes.texts]
        self.assertIn("no truth probe", texts)
        early = Result(self.edited("early.h5", lambda h5: None, truth_stride=0, settings={"probes": {"truth": {"stride_frames": 20}}}))
        texts = [text.get_text() for axes in figure7.draw(early).axes for text in axes.texts]
        self.assertIn("the path ends before the first probed frame", texts)
        with self.assertRaisesRegex(ResultError, "early.h5: the path ends before the first probed frame.*remedy"):
            work_precision.draw([early])

    def test_figure7_takes_any_labels_profiles_and_methods(self):
        def profiles(h5):
            for name, profile, cutoff in (("original", "hard", 0.001), ("improved", "soft", 0.01)):
                h5["methods"].move(name, f"{name}-{profile}")
                h5[f"methods/{name}-{profile}"].attrs.update({"profile": profile, "cutoff_m": cutoff})

        two = figure7.columns_of([Result(self.edited("profiles.h5", profiles))])
        self.assertEqual([column.title().split(",")[0] + column.title().split(",")[1] for column in two], ["hard hard: cutoff 1 mm", "hard soft: cutoff 10 mm"])
        self.assertEqual([list(column.names.values()) for column in two], [["original"], ["improved"]])
        self.assertEqual(two[1].look["improved-soft"]["color"], figure_style.BLUE, "as without profiles")

        mine = figure7.columns_of([Result(self.edited("mine.h5", lambda h5: h5["methods"].move("original", "mine")))])[0]
        self.assertEqual(sorted(mine.look), ["improved", "mine"])
        self.assertNotEqual(mine.look["mine"]["color"], mine.look["improved"]["color"])

        exact = Result(self.edited("exact.h5", lambda h5: None, methods=("certified",)))
        figure = figure7.draw(exact)
        self.assertEqual(len(figure.axes), len(figure7.ROWS))
        self.assertIn("no method searches at a rate of its own", figure.axes[2].texts[0].get_text())
        with self.assertRaisesRegex(ResultError, "5 columns are more than a page holds"):
            figure7.draw(*[exact] * 5)

    def test_figure7_draws_no_true_force_between_probed_frames(self):
        for stride, line in ((20, "None"), (1, "-")):
            result = Result(write_result(self.path(f"every{stride}.h5"), frames=100, truth_stride=stride))
            force, truth = figure7.draw(result).axes[0], figure_style.TRUTH_COLOURS["exponential"]
            drawn = [one for one in force.lines if one.get_color() == truth]
            keys = [key for legend in force.figure.legends for key in legend.get_lines() if key.get_color() == truth]
            self.assertEqual([one.get_linestyle() for one in (*drawn, *keys)], [line, line])
            self.assertEqual(drawn[0].get_marker(), "o" if stride > 1 else "None")

    def test_no_true_force_where_triangles_intersect(self):
        def intersect(h5):
            h5["reference/minimum_distance"][...] = 1e-3
            h5["reference/minimum_distance"][3:5] = 0.0
            h5["reference/contact_without_direction"][3] = 1

        def of_before(h5):
            intersect(h5)
            del h5["reference/contact_without_direction"]

        for change, unknown in ((intersect, [3]), (of_before, [3, 4])):
            _, force = lmdbench_results.reference_force(Result(self.edited(f"{change.__name__}.h5", change)).method("improved"))
            self.assertEqual(list(np.flatnonzero(np.isnan(force))), unknown)

    def test_truth_of_a_device_of_its_own_is_its_own(self):
        def close(h5):
            h5.copy("reference", "methods/improved/reference")
            h5["methods/improved/reference/force_exponential"][:] *= 2.0

        result = Result(self.edited("closed.h5", close))
        forces = {name: lmdbench_results.reference_force(method)[1] for name, method in lmdbench_results.true_forces(result.methods.values())}
        self.assertEqual(sorted(forces), ["truth of improved", "truth, linear law"])
        np.testing.assert_allclose(forces["truth of improved"], 2.0 * forces["truth, linear law"])

    def test_work_precision_places_exact_failed_and_other_methods(self):
        def fail(h5):
            h5["/methods/improved/force"][5] = np.nan

        result = Result(self.edited("failing.h5", fail, methods=("original", "improved", "certified")))
        points = {label: work_precision.Point(result, method) for label, method in result.methods.items()}
        self.assertEqual(points["certified"].force_error, 0.0)
        self.assertEqual(points["certified"].failure, "")
        self.assertGreater(points["original"].force_error, 0.1)
        self.assertNotEqual(points["improved"].failure, "")
        figure = work_precision.draw([result])
        labels = [label.get_text() for label in figure.axes[0].get_xticklabels()]
        self.assertIn("failed", labels)
        self.assertIn("0", labels)
        self.assertIn("failed: improved in hard, force is not finite", [text.get_text() for text in figure.texts])

    def test_what_is_read_is_named_and_no_option_is(self):
        with open(self.path("list.json"), "w", encoding="utf-8") as file:
            file.write("[]")
        said = self.refused(lmdbench_results.EXIT_INPUT_DATA, "continuous_force.py", self.path("list.json"), "--out", self.path("made"))
        self.assertTrue(said.startswith(f"{self.path('list.json')}: not what is read here"), said)
        said = self.refused(lmdbench_results.EXIT_ENVIRONMENT, "figure7.py", self.hard, "--out", self.path("list.json"))
        self.assertRegex(said, "list.json.*remedy")

    def test_a_run_without_contact_has_no_smallest_distance_and_no_error(self):
        def apart(h5):
            h5["scene/in_contact"][...] = 0
            h5["methods/original/minimum_distance"] = np.full(2000, np.nan)

        result = Result(self.edited("apart.h5", lambda h5: (h5.move("methods/improved", "methods/exact-original"), apart(h5))))
        method = result.methods["original"]
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertTrue(np.isnan(hard_soft.COLUMNS["smallest distance, mm"](method)))
            with unittest.mock.patch.object(result, "method", lambda name: result.methods[name.removesuffix("-")]):
                self.assertTrue(np.all(np.isnan(hard_soft.errors(result, "", "original"))))

    def test_work_precision_takes_nobody_for_failed_where_there_is_no_true_force(self):
        def unjudged(h5):
            h5["/methods/improved/summary/force_error_rms_n"][...] = np.nan

        figure = work_precision.draw([Result(self.edited("unjudged.h5", unjudged, methods=("original", "improved")))])
        self.assertNotIn("failed", [label.get_text() for label in figure.axes[0].get_xticklabels()])
        self.assertIn("not drawn: improved in hard, no true force in contact", [text.get_text() for text in figure.texts])
        self.assertEqual({line.get_marker() for line in figure.axes[0].lines} & {"x"}, set())

    def test_work_precision_has_no_mark_for_the_recall_of_a_method_without_a_set(self):
        def unset(h5):
            for name in ("recall", "recall_adjacent"):
                h5[f"/methods/original/summary/{name}"][...] = np.nan

        force, missed = work_precision.draw([Result(self.edited("force.h5", unset))]).axes
        colour = figure_style.colours_of(Result(self.hard).methods.values())["original"]
        self.assertEqual([any(line.get_color() == colour for line in panel.lines) for panel in (force, missed)], [True, False])

    def test_work_precision_tells_profiles_by_marks_and_methods_by_colours(self):
        def profiles(h5):
            for label in ("original", "improved"):
                for number in range(7):
                    h5.copy(f"methods/{label}", f"methods/{label}-p{number}")
                    h5[f"methods/{label}-p{number}"].attrs["profile"] = f"p{number}"
                del h5[f"methods/{label}"]

        figure = work_precision.draw([Result(self.edited("seven.h5", profiles))])
        looks = {(line.get_color(), line.get_marker()) for line in figure.axes[0].lines if line.get_marker() in work_precision.MARKERS}
        self.assertEqual(len(looks), 14)
        self.assertEqual({colour for colour, _ in looks}, {figure_style.VERMILLION, figure_style.BLUE})
        keys = [text.get_text() for legend in figure.legends for text in legend.get_texts()]
        self.assertEqual(keys[:3], ["original", "improved", "hard, p0"])

    def test_labels_of_an_axis_stay_apart_however_far_errors_reach(self):
        def shift(error):
            def change(h5):
                h5["/methods/certified/summary/force_error_rms_n"][...] = error
            return Result(self.edited(f"shifted{error}.h5", change, methods=("original", "improved", "certified")))

        for error in (1e-7, 3e-14):  # just above rounding, and a nearest pair exact to rounding
            figure = work_precision.draw([shift(error)])
            figure.canvas.draw()
            for axes in figure.axes[:2]:
                boxes = [label.get_window_extent() for label in axes.get_xticklabels() if label.get_text()]
                self.assertGreaterEqual(len(boxes), 2)
                for left, right in zip(boxes, boxes[1:]):
                    self.assertLessEqual(left.x1, right.x0, error)
        exact = shift(2e-14)
        self.assertEqual(work_precision.Point(exact, exact.method("certified")).force_error, 0.0)
        self.assertEqual(figure_style.labelled_decades(-14.0, 0.5), [1e-12, 1e-9, 1e-6, 1e-3, 1.0])

    def test_figure7_draws_every_method(self):
        result = Result(self.edited("three.h5", lambda h5: None, methods=("original", "improved", "certified", "exhaustive")))
        figure = figure7.draw(result)
        keys = [[text.get_text() for text in legend.get_texts()] for legend in figure.legends]
        for row, (plot, label, _) in enumerate(figure7.ROWS):
            searching = plot is figure7.plot_searches  # rows for methods with a search rate
            for name in ("original", "improved", "certified", "exhaustive"):
                self.assertEqual(any(key.startswith(name) for key in keys[row]), not searching or name in ("original", "improved"), (label, name))
        self.assertGreaterEqual(len(figure.axes[0].lines), 4 + 2, "methods and truths")

    def test_work_precision_refuses_times_without_errors(self):
        with self.assertRaisesRegex(ResultError, "no truth probe"):
            work_precision.draw([Result(self.bare)])


class SummaryTest(ScriptsTest):
    def test_every_time_has_its_error_in_the_row(self):
        text = self.printed(summary.main, self.hard, self.soft)
        rows = [line for line in text.splitlines() if line.startswith(("original", "improved", "certified"))]
        self.assertEqual(len(rows), 5)
        for line in rows:
            self.assertRegex(line, r"\d+\.\d \(\d+\.\d\)")  # recall
        self.assertRegex(rows[0], r"1 \(2\) +none +0\.005 \(0\.01\) +2 \(4\) +80\.0 \(90\.0\) +70\.0 \(95\.0\) +0\.9 +12\.7 \[7\.\d+, 19\.\d+\]")
        self.assertIn("0 disagree, worst relative difference 2.0e-09", text)
        self.assertIn("hard.h5", text)
        self.assertIn("Note: synthetic data", text)

    def test_small_forces_and_missing_times_are_told(self):
        def small(h5):
            h5["methods/original/summary/force_error_rms_n"][...] = 4.321e-5
            for label in ("original", "improved"):
                del h5[f"methods/{label}/local_update_time"]

        text = self.printed(summary.main, self.edited("small.h5", small))
        self.assertIn(" 4.32e-05 ", text)
        self.assertIn("times were not kept;", text)

    def test_a_closed_loop_says_whose_contact_it_counts(self):
        whose = "in contact on the path that the hand means; "
        self.assertNotIn(whose, self.printed(summary.main, self.hard))
        closed = self.path("closed.h5")
        write_result(closed, settings={"loop": {"kind": "closed"}})
        self.assertIn(whose, self.printed(summary.main, closed))

    def test_of_several_profiles_it_says_which_one_is_counted_and_one_is_no_plural(self):
        file = write_result(self.path("two.h5"), frames=1, repetitions=2, settings={"force": [{"name": "stiff"}, {"name": "weak"}]})
        text = self.printed(summary.main, file)
        self.assertIn("\n1 frame, 0 in contact under stiff; 1 timed repetition; ", text)

    def test_missing_errors_are_shouted(self):
        self.assertIn("NO TRUTH PROBE", self.printed(summary.main, self.bare))

    def test_disagreements_with_fcl_are_counted(self):
        def disagree(h5):
            h5["/crosscheck/fcl/agrees"][3:5] = 0
            h5["/crosscheck/fcl/relative_difference"][3] = 0.5

        text = self.printed(summary.main, self.edited("fcl.h5", disagree))
        self.assertIn("2 disagree, worst relative difference 5.0e-01", text)


class ClaimsTest(ScriptsTest):
    def verdicts(self, hard, soft):
        return {claim.id: claim for claim in claim_rules.rows(Result(hard), Result(soft), VERDICTS)}

    def test_what_the_synthetic_run_shows(self):
        rows = self.verdicts(self.hard, self.soft)
        self.assertEqual(list(rows), [f"K{i}" for i in range(1, 13)])
        expected = {"K1": "undecided", "K2": "holds", "K3": "does not hold", "K4": "holds", "K5": "holds", "K6": "holds",
                    "K7": "does not hold", "K8": "not measured", "K9": "holds", "K10": "does not hold", "K11": "not measured", "K12": "not measured"}
        self.assertEqual({name: claim.setting for name, claim in rows.items()}, expected)
        self.assertEqual(rows["K7"].because, "not: less so when soft")
        self.assertIn("undecided: the improved force switches", rows["K1"].because)  # a second is too short

    def test_what_holds_here_is_said_once(self):
        rows = self.verdicts(self.hard, self.soft)
        self.assertEqual(rows["K7"].in_this_setting(), "does not hold: less so when soft")
        self.assertRegex(rows["K1"].in_this_setting(), "^undecided: the improved force switches")
        self.assertEqual(rows["K2"].in_this_setting(), "holds")
        mixed = claim_rules.Claim("K6", "", "", "", "does not hold", "not: twice; undecided: as long")
        self.assertEqual(mixed.in_this_setting(), "does not hold: twice; undecided: as long")

    def test_the_verdict_is_the_ledgers_whatever_two_runs_show(self):
        rows = self.verdicts(self.hard, self.soft)
        self.assertEqual((rows["K2"].verdict, rows["K2"].reason), ("holds where", "cutoff small"))
        self.assertEqual(rows["K3"].verdict, "not measured")
        self.assertEqual(rows["K3"].reason, "no ledger of verdicts (remedy: scripts/claims.sh)")

    def test_jumps_have_count_and_interval(self):
        text = self.verdicts(self.hard, self.soft)["K1"].result
        self.assertRegex(text, r"changes above 25 % of F_max original [0-9.]+ \[[0-9.]+, [0-9.]+\]")
        self.assertRegex(text, r"improved 0 in [0-9.]+ s \[0, ")
        self.assertRegex(text, r"truth under its law 1 in 0.04 s \[0.633, 139\]")

    def test_k1_turns_when_the_improved_method_jumps(self):
        def jump(h5):
            h5["/methods/improved/force"][...] = h5["/methods/original/force"][...]

        claim = self.verdicts(self.edited("jumping.h5", jump), self.soft)["K1"]
        self.assertEqual(claim.setting, "does not hold")
        self.assertIn("not: the improved force switches", claim.because)

    def test_k1_turns_when_nobody_jumps(self):
        def smooth(h5):
            h5["/methods/original/force"][...] = h5["/methods/improved/force"][...]

        self.assertIn("original jumps from zero", self.verdicts(self.edited("smooth.h5", smooth), self.soft)["K1"].because)

    def test_k2_turns_with_large_sets(self):
        def many(step):
            def change(h5):
                for label in ("original", "improved"):
                    h5[f"/methods/{label}/lmd_count"][::step] += 10
            return change

        for step, verdict in ((1000, "holds"), (20, "does not hold")):
            self.assertEqual(self.verdicts(self.edited(f"many{step}.h5", many(step)), self.soft)["K2"].setting, verdict)

    def test_a_verdict_on_times_alone_is_undecided_where_repetitions_disagree(self):
        def torn(h5):
            h5["/methods/improved/local_update_time"][1] += 1e-3

        claim = self.verdicts(self.edited("torn.h5", torn), self.soft)["K9"]
        self.assertEqual(claim.setting, "undecided")
        self.assertIn("undecided: ", claim.because)
        self.assertIs(claim_runs.inside([1.0, 3.0], 2.0), None)
        self.assertIs(claim_runs.inside([2.5, 3.0], 2.0), True)
        self.assertIs(claim_runs.inside([1.0, 1.5], 2.0), False)

    def test_one_repetition_decides_nothing(self):
        self.assertIs(claim_runs.inside([2.5], 2.0), None)
        hard = write_result(self.path("once.h5"), repetitions=2)  # the first one warms up
        rows = self.verdicts(hard, self.soft)
        for name in ("K6", "K7", "K9"):
            self.assertEqual(rows[name].setting, "undecided", rows[name].because)

    def test_k9_needs_large_meshes_and_short_updates(self):
        def slow(h5):
            h5["/methods/improved/local_update_time"][...] += 1e-3

        self.assertIn("above 1 kHz", self.verdicts(self.edited("slow.h5", slow), self.soft)["K9"].because)
        small = write_result(self.path("small.h5"), triangles=500)
        self.assertIn("10,000 triangles", self.verdicts(small, self.soft)["K9"].because)

    def test_what_was_not_measured_does_not_fail(self):
        def unknown(h5):
            h5["methods/improved/force"][...] = 0.0
            for label in ("original", "improved"):
                for name in ("force_error_rms_n", "recall", "recall_adjacent", "reduction_ratio", "reduction_ratio_maximum"):
                    h5[f"methods/{label}/summary/{name}"][...] = np.nan

        file = self.edited("unknown.h5", unknown)
        claims = self.verdicts(file, file)
        self.assertEqual([claims[name].setting for name in ("K3", "K5", "K10")], ["undecided", "undecided", "not measured"])
        for claim in claims.values():
            self.assertNotRegex(claim.result, r"\bnan\b")
        self.assertEqual(claim_runs.inside([np.nan, np.nan], 1.0), None)

    def test_runs_whose_methods_see_different_frames_are_refused(self):
        changes = {"closed": lambda h5: h5.create_group("methods/original/loop"), "realtime": lambda h5: h5.create_group("realtime"),
                   "no frame in contact": lambda h5: h5["summary/frames_in_contact"].write_direct(np.zeros(1)),
                   "the name original to the method nearest": lambda h5: h5["methods/original"].attrs.create("method", "nearest")}
        for words, change in changes.items():
            file = self.edited(f"{words}.h5", change)
            with self.assertRaisesRegex(ResultError, f"{words}.h5: .*{words}.*remedy"):
                self.verdicts(self.hard, file)
            self.assertIn("No claim can be judged", claims_section.claims_of([Result(file)])["problem"])

    def test_ledger_is_written(self):
        text = self.printed(claims.main, self.hard, self.soft, "--out", self.path("ledger"))
        ledger = read_verdicts()
        self.assertIn(f"K2: {ledger['K2']['verdict']}: {ledger['K2']['reason']}", text)
        self.assertEqual(self.read("ledger", "claims.md").count("\n| K"), 12, "K11 and K12 with the ledger's verdict")


class OneLedgerTest(Scratch):
    """What the project shows: one verdict and one reason a claim, wherever it stands."""

    def rows(self, name, pattern):
        return {found.group(1): line.strip().strip("|").split(" | ") for line in text_of("results", "reference", name).splitlines()
                if (found := re.match(pattern, line))}

    def test_every_table_has_the_ledgers_verdict_and_reason(self):
        ledger = read_verdicts()
        self.assertEqual(sorted(ledger), sorted(f"K{i}" for i in range(1, 13)))
        regions = self.rows("claim-regions.md", r"\| \[(K[0-9]+)\]")
        for name, entry in ledger.items():
            self.assertTrue(entry["reason"], name)
            self.assertEqual((regions[name][2], regions[name][3]), (f"**{entry['verdict']}**", entry["reason"]))

    def test_a_ledger_that_is_none_is_refused(self):
        with self.assertRaisesRegex(ResultError, "no ledger of verdicts"):
            read_verdicts(self.write("claims.json", '[{"id": "K1"}]'))
        with open(self.path("binary"), "wb") as stream:
            stream.write(b"\x89" * 10_000)
        with self.assertRaisesRegex(ResultError, "^.{1,500}$"):
            read_verdicts(self.path("binary"))
