# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Figures of results as users have them: any number of methods, long names, one result to four. No text may be cut off by the page or lie on
another one. Run: python3 -m unittest discover scripts/figures/tests"""

import warnings
from types import SimpleNamespace

import h5py
import numpy as np

from cases import SharedScratch
import clock_results
import figure7
import figure_style
import page_data
import work_precision
from lmdbench_results import Result
from synthetic import write_result

METHODS = ("original", "improved", "certified", "exhaustive")
FURTHER = {5: ("my-own-variant-with-a-long-label",), 6: ("my-own-variant-" + "m" * 90, "the-second-variant-" + "m" * 90)}
NAMES = ("a", "bolt-mm-nut-mm", "housing-cover-left-v12-final-gearbox-mm-contact",
         "peg-and-hole-of-the-assembly-with-every-tolerance-at-its-lower-limit-and-a-name-as-long-as-files-have")
SLACK = 1.0  # pixels that antialiasing may stand beyond


def texts_of(figure):
    """{what: box} of everything that is read: texts, labels of axes and ticks, keys, titles."""
    renderer = figure.canvas.get_renderer()
    found = []
    for axes in figure.axes:
        found += axes.texts
        if not axes.axison:
            continue
        found += [axes.title, axes.xaxis.label, axes.yaxis.label]
        for axis in (axes.xaxis, axes.yaxis):
            low, high = sorted(axis.get_view_interval())
            found += [tick.label1 for tick in axis.get_major_ticks() if low <= tick.get_loc() <= high and tick.label1.get_visible()]
    found += figure.texts
    for legend in figure.legends:
        found += legend.get_texts()
    return [(text.get_text(), text.get_window_extent(renderer)) for text in found if text.get_text() and text.get_visible()]


def faults_of(figure):
    """Texts beyond the page, and pairs of them that lie on each other."""
    figure.canvas.draw()
    page, texts = figure.bbox, texts_of(figure)
    wrong = [f"cut: {words!r}" for words, box in texts
             if box.x0 < page.x0 - SLACK or box.y0 < page.y0 - SLACK or box.x1 > page.x1 + SLACK or box.y1 > page.y1 + SLACK]
    for i, (words, box) in enumerate(texts):
        for other, beside in texts[i + 1:]:
            if (min(box.x1, beside.x1) - max(box.x0, beside.x0) > SLACK and min(box.y1, beside.y1) - max(box.y0, beside.y0) > SLACK):
                wrong.append(f"over each other: {words!r}, {other!r}")
    return wrong


class LayoutTest(SharedScratch):
    def tearDown(self):
        figure_style.plt.close("all")

    def result(self, name, methods=4, seed=1):
        file = write_result(self.path(f"{name[:20]}-{methods}-{seed}.h5"), name, frames=600, repetitions=3, methods=METHODS[:methods], seed=seed)
        with h5py.File(file, "r+") as h5:
            for label in FURTHER.get(methods, ()):
                h5.copy("methods/improved", f"methods/{label}")
        return Result(file)

    def check(self, figure, what):
        self.assertEqual(faults_of(figure), [], what)

    def test_two_to_six_methods_under_any_name(self):
        for methods, name in zip((2, 3, 4, 5, 6), (*NAMES, NAMES[-1])):
            with self.subTest(methods=methods, name=name):
                result = self.result(name, methods)
                self.assertEqual(len(result.methods), methods)
                self.check(figure7.draw(result), "figure 7")
                self.check(work_precision.draw([result]), "error against run time")

    def test_two_to_four_results_beside_each_other(self):
        results = [self.result(name, 6, seed) for seed, name in enumerate(NAMES)]
        for chosen in (results[:2], results[-2:], results[-3:], results):
            with self.subTest(names=[result.name for result in chosen]):
                self.check(figure7.draw(*chosen), "figure 7")
                self.check(work_precision.draw(chosen), "error against run time")

    def test_keys_of_many_results_stay_in_a_narrow_figure(self):
        results = [self.result(f"{'long name ' * 5}{number}", 2, number) for number in range(9)]
        figure = work_precision.draw(results, narrow=True)
        (legend,) = figure.legends
        self.assertLessEqual(figure_style.width_of(figure, legend)[1], 1.0)

    def test_counts_between_1_and_10_have_a_scale(self):
        self.assertEqual(figure7.count_ticks(1.0), [0.0, 1.0])
        self.assertEqual(figure7.count_ticks(8.0), [0.0, 1.0, 8.0])
        self.assertEqual(figure7.count_ticks(300.0), [0.0, 1.0, 10.0, 100.0])

    def test_updates_of_the_fastest_method_are_within_the_axis(self):
        file = write_result(self.path("fast.h5"), frames=600)
        with h5py.File(file, "r+") as h5:
            h5["methods/original/local_update_time"][...] = 3e-8
        figure = figure7.draw(Result(file))
        self.assertLess(figure.axes[3].get_ylim()[0], 0.03)

    def test_a_short_name_is_kept_and_a_long_one_keeps_its_ends(self):
        self.assertEqual(figure_style.shortened("peg-hole"), "peg-hole")
        long = figure_style.shortened("left" + "-" * 80 + "right")
        self.assertEqual((len(long), long[:4], long[-5:]), (figure_style.LONGEST_NAME, "left", "right"))

    def test_dollars_in_names_begin_no_formula(self):
        other = self.result("$", 4, 2)
        for name in ("cu$^$.off", "a$x^{ $"):
            result = self.result(name)
            self.check(figure7.draw(result), "figure 7")
            self.check(work_precision.draw([result, other]), "error against run time")
            figure_style.note_failures(figure := figure_style.plt.figure(), {name: "is missing"})
            figure.canvas.draw()

    def test_a_method_without_a_time_is_no_warning(self):
        file = write_result(self.path("lost.h5"), frames=100)
        with h5py.File(file, "r+") as h5:
            h5["methods/original/local_update_time"][...] = np.nan
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.check(figure7.draw(Result(file)), "figure 7")

    def test_ages_of_a_short_run_stand_over_its_own_time(self):
        def clock(age):
            time = np.linspace(0.0, 0.02, 21)
            return SimpleNamespace(attribute=lambda name: 1e-3, ages_ms=lambda: (time, np.full(21, age), np.full(21, 2.0 * age)),
                                   read=lambda name: np.array([1e-5, 1e-4, 1e-3]) if name.endswith("edges") else np.array([0, 9, 9, 1]))
        figure = clock_results.draw_timing([("improved", clock(1.0)), ("certified", clock(0.0))])
        figure.canvas.draw()
        for axes in figure.axes[1::2]:
            self.assertAlmostEqual(axes.get_xlim()[1], 0.02)
            ends = [label.get_window_extent() for label in axes.get_xticklabels()]
            self.assertTrue(all(one.x1 < other.x0 for one, other in zip(ends, ends[1:])))
        figure_style.plt.close(figure)

    def test_one_frame_is_seen(self):
        file = write_result(self.path("one.h5"), frames=1, repetitions=3, truth_stride=0)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            figure = figure7.draw(Result(file))
        for axes in figure.axes[:4]:
            self.assertIn("o", [line.get_marker() for line in axes.lines])
        self.check(figure, "figure 7")

    def test_labels_stay_within_their_panels_in_four_columns(self):
        def labels(axes):
            low, high = axes.get_ylim()
            return [tick.label1.get_window_extent(renderer) for tick in axes.yaxis.get_major_ticks() if low <= tick.get_loc() <= high]

        file = write_result(self.path("wide.h5"), frames=1001, repetitions=3)
        with h5py.File(file, "a") as h5:
            h5["methods/original/local_update_time"][...] = 2e-2
        figure = figure7.draw(*[Result(file)] * 4)
        self.check(figure, "figure 7")
        renderer = figure.canvas.get_renderer()
        for left, axes in ((figure.axes[place], figure.axes[place + 1]) for place in range(19) if place % 4 < 3):
            for box in labels(axes):
                self.assertGreater(box.x0, left.get_window_extent(renderer).x1)

    def test_what_an_empty_panel_says_stays_in_it(self):
        file = write_result(self.path("empty.h5"), frames=100, methods=("certified",), truth_stride=0, settings={"probes": {"truth": {"stride_frames": 200}}})
        figure = figure7.draw(*[Result(file)] * 4)
        renderer = figure.canvas.get_renderer()
        for row in (2, 4):
            for axes in figure.axes[4 * row:4 * row + 4]:
                (text,) = axes.texts
                self.assertGreater(text.get_window_extent(renderer).x0, axes.get_window_extent(renderer).x0, text)
                self.assertLess(text.get_window_extent(renderer).x1, axes.get_window_extent(renderer).x1, text)

    def test_a_share_does_not_exceed_all(self):
        file = write_result(self.path("half.h5"), frames=600, repetitions=3)
        with h5py.File(file, "a") as h5:
            for name in ("recall", "recall_adjacent"):
                h5[f"methods/original/summary/{name}"][...] = 0.05
        figure = work_precision.draw([Result(file)])
        self.assertLessEqual(figure.axes[1].get_xlim()[1], 1.0)
        self.assertLess(figure.axes[1].get_xlim()[0], 0.3)

    def test_methods_of_one_colour_are_dashed_apart(self):
        result = self.result("many")
        with h5py.File(self.path("many12.h5"), "w") as h5:
            for name in result.h5:
                result.h5.copy(name, h5)
            h5.attrs.update(result.h5.attrs)
            for number in range(14):
                h5.copy("methods/improved", f"methods/variant-{number}")
        (column,) = figure7.columns_of([Result(self.path("many12.h5"))])
        looks = [(look["color"], str(look["ls"])) for look in column.look.values()]
        self.assertEqual(len(set(looks)), len(looks))
        lines = {line["label"]: (line["colour"], str(line.get("dash"))) for line in page_data.time_panels(column.result)["panels"][0]["series"]}
        self.assertEqual(len(set(lines.values())), len(lines))
        figure7.draw(column.result)
        work_precision.draw([column.result])

    def test_the_check_sees_faults(self):
        figure, axes = figure_style.plt.subplots(figsize=(3, 2))
        axes.set_axis_off()
        axes.text(0.5, 0.5, "one place", transform=axes.transAxes)
        self.assertEqual(faults_of(figure), [])
        axes.text(0.5, 0.5, "the same", transform=axes.transAxes)
        axes.text(0.9, 0.2, "beyond the edge of the page", transform=axes.transAxes)
        self.assertEqual(len(faults_of(figure)), 2)
