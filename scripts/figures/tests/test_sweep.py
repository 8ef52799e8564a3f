# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Sweeps: fronts, crossings, intervals and verdicts on data whose answers are known; figures and tables as files."""

import json
import math
import os
import unittest
import unittest.mock

import h5py
import numpy as np

from cases import ROOT, Scratch
import claim_regions
from claim_rules import CLAIMS
import region_rules
import intervals
import region_cost
import region_sets
import sweep
import sweep_results
from lmdbench_results import ResultError

NUMBERS = ("recall", "recall_adjacent", "precision", "force_error_rms_n", "force_error_p99_n", "force_error_maximum_n",
           "force_angle_error_median_rad", "torque_error_rms_n_m", "minimum_distance_error_maximum_m", "false_jumps", "missed_jumps",
           "true_jumps", "jumps", "switches", "true_switches", "births", "deaths", "true_births", "true_deaths", "seconds_in_contact",
           "processor_share", "frame_time_median_s", "frame_time_p99_s", "force_magnitude_error_rms_n", "force_angle_error_p99_rad", "frame_time_maximum_s", "frames_late", "candidates", "kept",
           "maximum_force_n", "method_order", "truth_checked_frames", "truth_wrong_frames", "reduction_ratio_maximum")


def row(series, every=20, cost=1e-2, error=0.3, recall=0.9, failure="", scene="hard", **numbers):
    method = series.split("-")[0]
    experiment = {"driver": {"search_every_frames": every, "search_latency_frames": every}, "moving": {"mesh": "bunny-16k"},
                  "force": {"cutoff_diagonal": 0.005},
                  "methods": [{"name": method, "visibility": "off", "reduction": "published"}]}
    if method == "original":
        experiment["methods"][0]["g5_tolerance_deg"] = 17.0
    values = dict.fromkeys(NUMBERS, math.nan)
    if not failure:
        values.update(recall=recall, recall_adjacent=recall, precision=1.0, force_error_rms_n=error * 2, processor_share=cost,
                      frame_time_median_s=cost * 1e-3, seconds_in_contact=10.0, candidates=0.0 if method == "certified" else 100.0,
                      kept=10.0, truth_checked_frames=4, truth_wrong_frames=0)
    values.update(maximum_force_n=2.0, method_order={"original": 0, "improved": 1, "certified": 2}[method], **numbers)
    axes = {} if method == "certified" else {"/driver/search_every_frames": every, "/driver/search_latency_frames": every}
    return {"scene": scene, "problem": scene, "series": series, "method": method, "force_law": "linear", "axes": json.dumps(axes), "failure": failure,
            "result_hash": "0", "experiment": json.dumps(experiment), **values}


def write_sweep(file, rows, name="test"):
    with h5py.File(file, "w") as h5:
        h5.attrs["format"], h5.attrs["format_version"] = "lmdbench-result", 2
        h5.create_group("provenance").attrs["git_commit"] = "0123456789abcdef"
        h5.create_group("sweep").attrs.update({"name": name, "title": "a title", "clock_overhead_s": 3e-8})
        for key in rows[0]:
            column = [entry[key] for entry in rows]
            h5[f"points/{key}"] = column if isinstance(column[0], str) else np.array(column, dtype=float)


ROWS = [row("improved", 1, cost=1.0, error=0.01), row("improved", 10, cost=0.1, error=0.1), row("improved", 100, cost=0.01, error=0.4),
        row("original", 10, cost=0.2, error=0.5), row("original", 100, cost=0.02, error=1e-6, recall=0.0),
        row("certified", cost=0.03, error=0.0, recall=1.0), row("improved-other", failure="mesh is missing")]


class SweepScratch(Scratch):
    def setUp(self):
        super().setUp()
        self.file = self.path("test.h5")

    def sweep(self, rows, name="test"):
        """As it is read again."""
        write_sweep(self.file, rows, name)
        return sweep_results.Sweep(self.file)


class SweepFile(SweepScratch):

    def test_front_holds_what_nothing_beats_in_both(self):
        best = sweep_results.front(self.sweep(ROWS).of(scene="hard"), sweep.cost, sweep.error)
        self.assertEqual([point.text() for point in best], ["improved, a search every 100 frames", "certified"])

    def test_a_point_without_any_true_lmd_is_a_failure_unless_its_force_is_true(self):
        point = self.sweep(ROWS).points[4]
        self.assertEqual(point.trouble, sweep_results.MISSES_ALL)
        self.assertEqual(self.sweep(ROWS).points[6].trouble, "mesh is missing")
        flush = self.sweep([row("original", cost=0.005, error=1e-14, recall=0.0), row("certified", error=0.0)]).points
        self.assertEqual(flush[0].trouble, "")
        self.assertEqual(sweep_results.front(flush, sweep.cost, sweep.error)[0].series, "original")

    def test_no_sweep_counts_frames_before_its_slowest_search_is_back(self):
        for file in (ROOT / "experiments" / "sweeps").glob("*.json"):
            definition = json.loads(file.read_text(encoding="utf-8"))
            slowest = max((latency for series in definition["series"] for axis in series.get("axes", [])
                           for latency in axis.get("/driver/search_latency_frames", [])), default=0)
            self.assertGreaterEqual(definition.get("from_frame") or slowest, slowest, file)

    def test_births_count_once_and_wrong_frames_of_all_problems(self):
        numbers = {"births": 20.0, "deaths": 20.0, "true_births": 30.0, "truth_checked_frames": 4, "truth_wrong_frames": 2}
        text = sweep.markdown(self.sweep([row("certified", scene=scene, **numbers) for scene in ("hard", "soft")]), "")
        self.assertIn("in 8 frames of the problems (4 differ)", text)
        for rate in (intervals.Rate([20], [10.0]), intervals.Rate([30], [10.0])):
            self.assertIn(f"| {rate} |", text)

    def test_crossing_is_interpolated_between_the_points_on_both_sides(self):
        points = self.sweep(ROWS).of(series="improved")
        # cost is 1 / period: it falls below 0.03 s/s at a period of 1 / 0.03
        self.assertAlmostEqual(sweep_results.crossing(points, 0.03, lambda p: p.number("processor_share")), 1 / 0.03, places=6)
        self.assertTrue(math.isnan(sweep_results.crossing(points, 1e-9, lambda p: p.number("processor_share"))))

    def test_crossings_are_with_the_cheapest_reference_and_join_no_points_of_other_axes(self):
        def wider(entry):
            return {**entry, "axes": json.dumps({**json.loads(entry["axes"]), "/methods/0/subdivision": 2}), "processor_share": 10 * entry["processor_share"]}

        along = [entry for entry in ROWS if entry["series"] == "improved"]
        slower = {**row("certified", cost=0.5, error=0.0, recall=1.0), "axes": json.dumps({"/methods/0/coherent": False})}
        for order in (1, -1):
            rows = sweep.crossings(self.sweep([slower, *ROWS[5:6], *along, *map(wider, along)][::order]))
            self.assertEqual(sorted(tuple(line.split(" | ")[:3]) for line in rows if "hard" in line),
                             [("| hard", "33", "33"), ("| hard, subdivision 2", "-", "33")])

    def test_figure_and_tables_become_files_and_failures_stay_in_them(self):
        write_sweep(self.file, ROWS)
        self.printed(sweep.main, self.file, "--out", self.path("out"))
        for suffix in ("svg", "png"):
            self.assertGreater(os.path.getsize(self.path("out", f"test.{suffix}")), 10_000)
        text = self.read("out", "test.md")
        self.assertIn("failed, mesh is missing", text)
        self.assertIn("**certified**", text)
        self.assertIn("| hard | 33 |", text)  # the crossing
        self.assertIn("at commit 0123456789ab", text)
        budget = next(line for line in text.splitlines() if line.startswith("| hard | none"))
        self.assertIn("improved, a search every 100 frames: 40 %", budget)  # 10 and 20 ms/s
        self.assertIn("certified: 0 %", budget)

    def test_tables_name_the_files_that_were_given_and_take_a_list_of_one_profile(self):
        self.sweep(ROWS)
        with h5py.File(self.file, "a") as h5:
            h5["provenance/argv"] = ["/opt/bin/lmdbench", "work-precision", "my sweep.json", "--out", "test.h5"]
            h5["sweep"].attrs["title"] = ""
            experiment = json.loads(h5["points/experiment"][0])
            h5["points/experiment"][0] = json.dumps({**experiment, "force": [{"name": "hard", "cutoff_m": 0.002}]})
        text = sweep.markdown(sweep_results.Sweep(self.file), "")
        self.assertIn(f"\ntest. Made by `lmdbench work-precision 'my sweep.json' --out test.h5` and `scripts/figures/sweep.py {self.file}` at", text)
        self.assertIn("Cutoff 2 mm.", text)
        with h5py.File(self.file, "a") as h5:
            h5["points/experiment"][0] = json.dumps({key: value for key, value in experiment.items() if key != "force"})
        self.assertIn("Cutoff: the default.", sweep.markdown(sweep_results.Sweep(self.file), ""))

    def test_what_changes_the_truth_makes_panels_and_fronts_of_its_own(self):
        def at(cutoff, entries):
            return [{**entry, "problem": f"hard, force/cutoff_m {cutoff}"} for entry in entries]

        near = [row("improved", 10, cost=0.2, error=0.5), row("certified", cost=0.3, error=0.0, recall=1.0)]
        far = [row("improved", 10, cost=0.1, error=0.1), row("certified", cost=0.2, error=0.0, recall=1.0)]  # better in both
        found = self.sweep(at(0.001, near) + at(0.01, far))
        self.assertEqual(found.problems, ["hard, force/cutoff_m 0.001", "hard, force/cutoff_m 0.01"])
        figure = sweep.draw(found)
        self.assertEqual([axes.get_title("left") for axes in figure.axes if axes.get_title("left")], ["force/cutoff_m 0.001", "force/cutoff_m 0.01"])
        lines = [line for axes in figure.axes[:2] for line in axes.lines if line.get_marker() == "o"]
        self.assertEqual([len(line.get_xdata()) for line in lines], [1, 1], "no line from one problem to the other")
        sweep.plt.close(figure)
        text = sweep.markdown(found, "")
        for cutoff in ("0.001", "0.01"):
            part = text.split(f"## hard, force/cutoff_m {cutoff}\n", 1)[1].split("\n## ", 1)[0]
            self.assertIn("**improved, a search every 10 frames**", part, "on the front of its own problem")

    def test_lines_run_along_the_axis_that_varies_and_part_at_every_other(self):
        def point(every, latency, visibility):
            entry = row("improved", every)
            entry["axes"] = json.dumps({"/driver/search_every_frames": every, "/driver/search_latency_frames": latency,
                                        "/method/visibility": visibility, "/method/constant": 3})
            return entry

        found = self.sweep([point(n, n - 1, v) for v in ("off", "orthogonal") for n in (100, 5, 20)]).points
        parted = sweep_results.lines(found)
        self.assertEqual([[p.period for p in line.points] for line in parted], [[5, 20, 100], [5, 20, 100]])
        self.assertEqual([line.value(line.points[0]) for line in parted], ["5, off", "5, orthogonal"])
        self.assertEqual(parted[0].place, "/driver/search_every_frames", "the latency goes with it")
        words = [point(5, 4, v) for v in ("off", "orthogonal", "vertex-normal")]
        self.assertEqual([len(line.points) for line in sweep_results.lines(self.sweep(words).points)], [1, 1, 1], "words have no order to join")
        (alone,) = sweep_results.lines(self.sweep([point(5, 4, "off")]).points)
        self.assertEqual((alone.place, alone.value(alone.points[0])), (None, ""))
        self.assertIn("labels: search every frames, visibility", [t.get_text() for t in sweep.draw(self.sweep(
            [point(n, n - 1, v) for v in ("off", "orthogonal") for n in (5, 20)])).texts][0])

    def test_what_is_written_round_the_panels_stays_on_one_line_of_the_figure(self):
        axes = {f"/methods/0/an_option_with_a_long_name_{number}": ["off", "on"] for number in range(5)}
        rows = [{**row("improved", 10), "axes": json.dumps({place: values[number] for place, values in axes.items()})} for number in (0, 1)]
        for reason in ("mesh is missing", "no such mesh " * 40):
            figure = sweep.draw(self.sweep([*rows, row("improved-other", failure=reason), row("improved-next", failure="mesh is missing")]))
            notes = [text for text in figure.texts if "failed" in text.get_text()]
            self.assertRegex(notes[0].get_text(), "improved-other.*; improved-next" if len(reason) < 20 else "^2 failed: see the table$")
            for text in figure.texts:
                self.assertLessEqual(sweep.style.width_of(figure, text)[1], 1.0, text.get_text())
                self.assertNotIn("\n", text.get_text())
            sweep.plt.close(figure)

    def test_run_times_near_each_other_are_plain_numbers(self):
        figure = sweep.draw(self.sweep([row("certified", cost=0.0038), row("improved", 10, cost=0.0045)]))
        figure.canvas.draw()
        ticks = figure.axes[1].get_xticklabels(which="both")
        self.assertIn("5", [tick.get_text() for tick in ticks])
        self.assertEqual([tick.get_text() for tick in ticks if "$" in tick.get_text()], [])
        sweep.plt.close(figure)

    def test_the_words_above_the_tables_are_those_of_the_points(self):
        unchecked = sweep.markdown(self.sweep([row("certified", truth_checked_frames=0)]), "")
        self.assertIn("compared with `exhaustive` in no frame. ", unchecked)
        self.assertIn("`certified` with vector instructions", unchecked)
        kernels = [{**row("certified"), "axes": json.dumps({"/methods/0/kernel": name})} for name in ("scalar", "avx2")]
        self.assertIn("`certified` with the instructions that its points name", sweep.markdown(self.sweep(kernels), ""))

    def test_what_was_not_judged_has_no_mark_and_did_not_fail(self):
        figure = sweep.draw(self.sweep([row("certified", error=math.nan), row("improved", 10)]))
        self.assertIn("not drawn: certified in hard, no true force in contact", [text.get_text() for text in figure.texts])
        self.assertNotIn("failed", [label.get_text() for axes in figure.axes for label in axes.get_yticklabels()])
        self.assertEqual([line for line in figure.axes[0].lines if line.get_marker() == "x"], [])
        sweep.plt.close(figure)

    def test_a_failure_has_its_reason_in_the_figure(self):
        figure = sweep.draw(self.sweep(ROWS))
        (note,) = [text.get_text() for text in figure.texts if text.get_text().startswith("failed: ")]
        self.assertIn("improved-other", note)
        self.assertIn("mesh is missing", note)
        self.assertIn("finds no true LMD", note)
        sweep.plt.close(figure)

    def test_names_are_no_formula_and_no_html(self):
        name = "hard, fixed/mesh cu$^$<b>|.off"
        figure = sweep.draw(self.sweep([{**entry, "problem": name, "axes": json.dumps({"/fixed/mesh": f"cu$^${i}.off"})} for i, entry in enumerate(ROWS)]))
        figure.canvas.draw()
        self.assertIn("cu\\$^\\$<b>|.off", figure.axes[0].get_title("left"))
        sweep.plt.close(figure)
        text = sweep.markdown(self.sweep([{**entry, "problem": name} for entry in ROWS]), "")
        self.assertIn("\n## hard, fixed/mesh cu$^$&lt;b&gt;|.off\n", text)
        self.assertIn("| hard, fixed/mesh cu$^$&lt;b&gt;\\|.off |", text)

    def test_the_same_sweep_makes_the_same_bytes_of_svg(self):
        write_sweep(self.file, ROWS)
        for name in ("a", "b"):
            self.printed(sweep.main, self.file, "--out", self.path(name))
        self.assertEqual(self.read("a", "test.svg"), self.read("b", "test.svg"))

    def test_another_file_is_refused(self):
        with h5py.File(self.file, "w") as h5:
            h5.attrs["format"], h5.attrs["format_version"] = "lmdbench-result", 2
        with self.assertRaisesRegex(ResultError, "is no sweep"):
            sweep_results.Sweep(self.file)


class Intervals(unittest.TestCase):
    def test_poisson_limits_are_garwoods(self):
        for count, low, high in ((0, 0.0, 3.6889), (1, 0.0253, 5.5716), (10, 4.7954, 18.3904), (100, 81.364, 121.627),
                                 (2000, 1913.2987, 2089.6174)):
            found = intervals.poisson_interval(count)
            self.assertAlmostEqual(found[0], low, places=2)
            self.assertAlmostEqual(found[1], high, places=2)

    def test_limits_of_a_share_are_clopper_and_pearsons(self):
        for count, total, low, high in ((0, 10, 0.0, 0.30850), (5, 10, 0.18709, 0.81291), (3, 500, 0.001239, 0.017434),
                                        (10, 10, 0.69150, 1.0), (1, 66, 0.0003835, 0.081552)):
            found = intervals.share_interval(count, total)
            self.assertAlmostEqual(found[0], low, places=5)
            self.assertAlmostEqual(found[1], high, places=5)

    def test_bootstrap_over_paths_widens_what_comes_in_bursts(self):
        even = intervals.Rate([10] * 6, [1.0] * 6)
        bursts = intervals.Rate([60, 0, 0, 0, 0, 0], [1.0] * 6)
        self.assertEqual(even.value, bursts.value)
        self.assertGreater(bursts.high, even.high)
        self.assertLess(bursts.low, even.low)

    def test_fewer_than_ten_events_have_no_rate(self):
        few = intervals.Rate([2], [0.5])
        self.assertTrue(math.isnan(few.value))
        self.assertEqual(str(few), "2 in 0.5 s [0.484, 14.4]")
        self.assertEqual(str(intervals.Rate([10], [0.5])), "20 [9.59, 36.8]")
        self.assertEqual(str(intervals.Rate([0], [2.0])), "0 in 2 s [0, 1.84]")
        self.assertEqual(str(intervals.Rate([math.nan], [2.0])), "-")

    def test_bootstrap_is_the_same_every_time(self):
        data = list(range(20))
        self.assertEqual(intervals.bootstrap(data, np.mean), intervals.bootstrap(data, np.mean))


def role_row(label, device_share, **more):
    """A repetition as `lmdbench-study roles --json` writes it."""
    stage = {"median_s": 1e-6, "p99_s": 2e-6, "maximum_s": 3e-6}
    return {"label": label, "device_share": device_share, "local_share": 1.0, "global_share": 2.0, "device": stage, "together": stage,
            "together_above_1ms": 0, **more}


def jumping(series, every, switches, **more):
    return row(series, every, switches=switches, true_switches=2.0, jumps=3.0 * switches, true_jumps=4.0, false_jumps=2.9 * switches, **more)


def judged(claim, *evidence):
    return CLAIMS[claim].judge(*evidence)


class Verdicts(SweepScratch):
    def test_one_event_decides_nothing(self):
        self.assertEqual(region_rules.decide(0.5, 1.5, at_least=1.0), claim_regions.OPEN)
        self.assertEqual(region_rules.decide(1.1, 1.5, at_least=1.0), claim_regions.HOLDS)
        self.assertEqual(region_rules.decide(0.5, 0.9, at_least=1.0), claim_regions.FAILS)
        self.assertEqual(region_rules.decide(1.2, 1.4, at_least=1.0, at_most=1.3), claim_regions.OPEN)
        self.assertEqual(region_rules.decide(math.nan, 1.0, at_least=1.0), claim_regions.OPEN)

    def test_words(self):
        holds, fails, undecided = claim_regions.HOLDS, claim_regions.FAILS, claim_regions.OPEN
        self.assertEqual(claim_regions.verdict({"a": holds, "b": holds}), ("reproduced", "in all 2 settings"))
        self.assertEqual(claim_regions.verdict({"a": holds, "b": undecided}), ("holds where", "a; 1 undecided"))
        self.assertEqual(claim_regions.verdict({"a": fails}), ("not reproduced", "in none of 1 settings"))
        self.assertEqual(claim_regions.verdict({"a": fails, "b": undecided}, "leaves cost more"),
                         ("not reproduced", "in none of 2 settings; 1 undecided: leaves cost more"))
        self.assertEqual(claim_regions.verdict({"a": fails, "b": holds, "c": holds}), ("holds where", "b; c"))
        self.assertEqual(claim_regions.verdict({"a": undecided})[0], "undecided")
        self.assertEqual(claim_regions.verdict({"g | 1": holds, "g | 2": holds, "h | 1": holds, "h | 2": fails}),
                         ("holds where", "g (all 2 settings); h, 1"))

    def test_k1_compares_with_improved_under_the_same_schedule_and_cutoff(self):
        often = [jumping("original", 20, 100.0), jumping("improved", 20, 1.0)] * 3
        rarely = [jumping("original", 100, 0.0), jumping("improved", 100, 1.0)]
        text, cells = judged("K1", self.sweep(often + rarely, "claim-k1"))
        self.assertEqual(list(cells.values()), [claim_regions.HOLDS, claim_regions.FAILS])
        self.assertIn("10 [", "\n".join(text))

    def test_what_was_not_swept_is_said_and_a_budget_sweep_judges_its_scene(self):
        hard = [jumping("original", 20, 100.0, scene="bunny-hard"), jumping("improved", 20, 0.0, scene="bunny-hard")]
        other = [{**entry, "scene": "armadillo-bunny"} for entry in hard[:1]]
        budget = self.sweep(hard + other, "budget")
        self.assertEqual(len(budget.restricted("bunny-hard").points), 2)
        text, cells = judged("K1", budget.restricted("bunny-hard"))
        self.assertEqual(list(cells.values()), [claim_regions.HOLDS])
        with unittest.mock.patch.object(claim_regions, "CLAIMS", {name: CLAIMS[name] for name in ("K1", "K5")}):
            page = claim_regions.markdown({"budget": budget}, claim_regions.judged({"budget": budget}))
        self.assertIn("| K5 | The reduction drops up to twenty times, more on denser meshes | **not measured**", page)
        self.assertIn("**reproduced** | in the one setting | 1 / 0 / 0 |", page)

    def test_k5_and_the_summary(self):
        rows = [row("improved", reduction_ratio_maximum=20.0), row("improved", reduction_ratio_maximum=90.0)]
        self.assertEqual(len(judged("K5", self.sweep(rows, "claim-k10"))[1]), 1, "two points of one setting")
        self.assertEqual(list(judged("K5", self.sweep(rows[:1], "claim-k5"))[1].values()), [claim_regions.HOLDS])

    def test_what_failed_and_what_was_not_measured_decides_nothing(self):
        rows = [row("improved", reduction_ratio_maximum=20.0), row("improved-own", failure="out of memory")]
        text, cells = judged("K5", self.sweep(rows, "claim-k5"))
        self.assertEqual(list(cells.values()), [claim_regions.HOLDS])
        self.assertIn("hard, improved-own: out of memory", "\n".join(text))
        self.assertEqual(list(judged("K5", self.sweep([row("improved", candidates=0.0)], "claim-k5"))[1].values()), [claim_regions.OPEN])

    def test_a_setting_that_two_sweeps_measured_holds_where_it_does_in_both(self):
        for cells in ((claim_regions.HOLDS, claim_regions.FAILS), (claim_regions.FAILS, claim_regions.HOLDS)):
            found = region_rules.Found()
            for cell in cells:
                found.add({"a": 1}, "one", cell)
            self.assertEqual(found.cells, {"one": claim_regions.FAILS})

    def test_k2_and_k4_judge_means_over_paths(self):
        def path(series, number, **numbers):
            entry = row(series, 20, **numbers)
            entry["axes"] = json.dumps({"/path/file": f"{number}.tum", "/driver/search_every_frames": 20})
            return entry

        def numbers(count, changes, p99):
            return {"lmd_count_mean": count, "true_lmd_count_mean": 3.0, "births": changes, "deaths": changes, "lmd_count_p99": p99,
                    "lmd_count_median": count, "lmd_count_maximum": 2 * p99}

        rows = [path("original", n, **numbers(4.0 + 0.1 * n, 50.0 + n, 12.0 + n)) for n in range(6)]
        rows += [path("improved", n, **numbers(3.5, 5.0, 7.0 + 0.1 * n)) for n in range(6)]
        found = self.sweep(rows, "claim-k1")
        self.assertEqual(list(judged("K4", found)[1].values()), [claim_regions.HOLDS])
        self.assertEqual(list(judged("K2", found)[1].values()), [claim_regions.FAILS, claim_regions.HOLDS])
        # More LMDs than 1.5 times as many are not similar, however much the original's fluctuates.
        rows = [{**entry, "lmd_count_mean": 2 * entry["lmd_count_mean"]} if entry["method"] == "original" else entry for entry in rows]
        self.assertEqual(list(judged("K4", self.sweep(rows))[1].values()), [claim_regions.FAILS])

    def test_a_ratio_of_times_is_as_wide_as_its_repetitions(self):
        new, old = np.full((3, 50), 2.0), np.full((3, 50), 1.0)
        new[2] = 4.0  # one repetition on a slow machine
        value, (low, high) = region_cost.time_interval((new, old), lambda a, b: np.median(a) / np.median(b))
        self.assertEqual((value, low, high), (2.0, 2.0, 4.0))
        value, limits = region_cost.time_interval((new[:1], old[:1]), lambda a, b: np.median(a) / np.median(b))
        self.assertEqual(value, 2.0)
        self.assertEqual(region_rules.decide(*limits, at_least=1.0), claim_regions.OPEN, "one repetition")

    def test_k8_needs_every_repetition(self):
        def roles(*shares):
            return {"experiment": "closed", "rows": [role_row("improved-hard", share) for share in shares]}
        self.assertEqual(list(judged("K8", roles(0.1, 0.2))[1].values()), [claim_regions.HOLDS])
        self.assertEqual(list(judged("K8", roles(0.1, 0.7))[1].values()), [claim_regions.OPEN])
        self.assertEqual(list(judged("K8", roles(0.6, 0.7))[1].values()), [claim_regions.FAILS])
        self.assertEqual(list(judged("K8", roles(0.1))[1].values()), [claim_regions.OPEN], "one repetition")

    def test_k8_knows_the_device_loop_without_its_simulation(self):
        row = role_row("original-hard", 9.0, force_share=0.1)
        text, cells = judged("K8", {"experiment": "closed", "rows": [row, row]})
        self.assertEqual(cells, {"original | hard": claim_regions.FAILS,
                                 "original, the simulated device's motion left out | hard": claim_regions.HOLDS})
        self.assertIn("| 9e+03 | 100 |", "\n".join(text))
        row["force_share"] = 0.6
        self.assertEqual(judged("K8", {"experiment": "closed", "rows": [row, row]})[1]["original, the simulated device's motion left out | hard"],
                         claim_regions.FAILS)

    def test_two_loads_that_contradict_each_other_are_named(self):
        def roles(hard, soft):
            rows = [role_row(f"original-{name}", share) for name, shares in (("hard", hard), ("soft", soft)) for share in shares]
            return {"roles": claim_regions.Roles(experiment="closed", rows=rows, context={"build": {"git_commit": "1234567890123"}})}
        claims = claim_regions.judged(roles([0.1, 0.1], [0.1, 0.1]))
        text = "\n".join(claim_regions.two_loads(claims, roles([0.1, 0.7], [0.8, 0.8])))
        self.assertIn("| K8 | 2 | 0 | 1 | 1 |", text)
        self.assertIn("`roles` at 123456789012)", text)
        self.assertIn("Contradicting: K8, original | soft.", text)
        self.assertNotIn("Contradicting", "\n".join(claim_regions.two_loads(claims, roles([0.1, 0.7], [0.2, 0.2]))))

    def test_why_counts_what_an_option_changes(self):
        counts = {("m", 0.05): {("vertex-normal", "published", "one-ring"): (100, 10), ("vertex-normal", "published", "edge-neighbours"): (30, 10),
                                ("off", "published", "one-ring"): (500, 5), ("vertex-normal", "published", "own"): (0, 0)}}
        text = "\n".join(region_cost.why_k5(counts))
        self.assertIn("leaf cones edge-neighbours makes 0.3 times the candidates and keeps 1 times the LMDs", text)
        self.assertIn("visibility off makes 5 times the candidates and keeps 0.5 times the LMDs", text)

    def test_k12_asks_for_every_pair_that_crosses(self):
        def result(candidates):
            file = h5py.File(self.path(f"cut-{candidates}.h5"), "w")
            for name, values in {"frame": [0, 5], "frame_offset": [0, 0, 1], "trace_time": [1e-6] * 2, "point_offset": [0, 3], "closed": [1], "length": [0.1],
                                 "point": np.zeros((3, 3))}.items():
                file[f"polylines/{name}"] = np.array(values)
            file["path/position"], file["path/orientation"] = np.zeros((6, 3)), np.tile([0.0, 0.0, 0.0, 1.0], (6, 1))
            search = {"global_frame": np.arange(6.0), "candidates": np.array([0, 0, 0, 0, 0, candidates], dtype=float)}
            return unittest.mock.Mock(points=(), h5=file, read=lambda name: file[name][:], method=lambda _: unittest.mock.Mock(read=search.get))

        with unittest.mock.patch.object(region_sets, "body", return_value=("cube", np.zeros((1, 3, 3)), 1.0)):
            for candidates, cell in ((3, claim_regions.HOLDS), (2, claim_regions.FAILS)):
                text, cells = judged("K12", result(candidates))
                self.assertEqual(cells, {"cube into cube": cell})
                self.assertIn(f"| 1 | 3 | {candidates} |", "\n".join(text))

    def test_k9_judges_each_method(self):
        rows = [row(series, scene="bunny-soft", local_update_p99_s=1e-3, local_update_median_s=1e-6, local_update_maximum_s=2e-3) for series in ("original", "improved")]
        for entry in rows:
            experiment = json.loads(entry["experiment"])
            entry["experiment"] = json.dumps({**experiment, "fixed": [{"mesh": "bunny-16k"}]})
        found = self.sweep(rows, "claim-k7")
        times = {"original": np.full((3, 100), 1.5e-3), "improved": np.full((3, 100), 1e-5)}
        found.samples = lambda point, name: times[point.series] if name == "local_update_time" else np.ones(100)
        cells = judged("K9", found)[1]
        self.assertEqual({name.split(" | ")[0]: cell for name, cell in cells.items()}, {"improved": claim_regions.HOLDS, "original": claim_regions.FAILS})

    def test_distance_to_triangles_and_back_rotation(self):
        corners = np.array([[[0.0, 0, 0], [1, 0, 0], [0, 1, 0]], [[9.0, 9, 9], [9, 9, 9], [9, 9, 9]]])
        for point, distance in (((0.2, 0.2, 0.5), 0.5), ((-1, 0, 0), 1.0), ((1, 1, 0), math.sqrt(0.5)), ((0.5, -2, 0), 2.0)):
            self.assertAlmostEqual(region_sets.distance_to_triangles(np.array(point), corners), distance, places=12)
        quarter = (0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5))  # x to y
        np.testing.assert_allclose(region_sets.rotated_back(quarter, np.array([0.0, 1.0, 0.0])), [1, 0, 0], atol=1e-15)
