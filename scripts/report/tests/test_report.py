# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the page says and holds, without a browser (tests/report opens it in one)."""

import base64
import io
import json
import os
import re
import sys
import unittest.mock

import h5py
import numpy as np
from PIL import Image

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "figures", "tests"))

from cases import Scratch  # noqa: E402  (the figures' tests must be found first)
import page_figures  # noqa: E402
import report  # noqa: E402
import scene_data  # noqa: E402
import studies  # noqa: E402
from answer import answer, lead, percent, sentence, time  # noqa: E402
from lmdbench_results import Result, ResultError  # noqa: E402
from page_data import held, moving_recall, time_panels  # noqa: E402
from synthetic import write_result  # noqa: E402
from test_sweep import ROWS, write_sweep  # noqa: E402


class FakeRow:
    def __init__(self, label, error, median, p99, late=0, wrong=0, profile="", force_law="linear"):
        self.label, self.force_error, self.profile, self.force_law = label, error, profile, force_law
        self.late = late
        self.numbers = {"frame_time_median_s": median, "frame_time_p99_s": p99, "frames_wrong": wrong, "frames_in_contact": 1000}

    def number(self, name):
        return self.numbers[name]


def decoded(text):
    return np.frombuffer(base64.b64decode(text), dtype="<f4")


class Answer(Scratch):
    def test_names_the_least_error_within_the_budget(self):
        rows = [FakeRow("cheap", 0.5, 1e-6, 2e-6), FakeRow("good", 0.1, 1e-5, 9e-4), FakeRow("exact", 0.0, 1e-3, 5e-3)]
        self.assertIn("good leaves the least force error: 10 %", sentence(rows))

    def test_each_force_profile_has_a_sentence_of_its_own(self):
        hard = [FakeRow("a-hard", 0.1, 1e-5, 1e-4, profile="hard"), FakeRow("b-hard", 0.2, 1e-5, 1e-4, profile="hard", force_law="quadratic")]
        soft = [FakeRow("a-soft", float("nan"), 1e-5, 1e-4, profile="soft")]
        told = lead([*hard, *soft])
        self.assertTrue(told.startswith("Under hard: within one haptic frame (1 ms), a-hard leaves"), told)
        self.assertIn("under the method's own force law. Under soft: no frame in contact was compared", told)
        self.assertNotIn("own force law", sentence(hard[:1]))

    def test_prefers_the_faster_of_two_equals(self):
        rows = [FakeRow("slow", 0.0, 1e-4, 2e-4), FakeRow("quick", 1e-16, 1e-5, 2e-4)]
        self.assertIn("quick", sentence(rows))
        self.assertIn("slow", sentence([rows[0], FakeRow("quick", 1e-16, 1e-5, 2e-4, wrong=45)]), "sets of which some are wrong")

    def test_says_how_many_frames_are_late(self):
        self.assertIn("3 of its frames are late", sentence([FakeRow("a", 0.0, 1e-5, 1e-4, late=3)]))

    def test_a_method_that_loses_frames_is_not_within_the_budget(self):
        rows = [FakeRow("loses", 0.1, 1e-6, 2e-6, late=11), FakeRow("answers", 0.5, 1e-5, 1e-4, late=10)]
        self.assertIn("answers leaves the least force error", sentence(rows))

    def test_says_when_no_method_is_in_time_or_judged(self):
        self.assertIn("No method keeps", sentence([FakeRow("a", 0.0, 1e-3, 2e-3)]))
        self.assertIn("No frame in contact was compared", sentence([FakeRow("a", float("nan"), 1e-6, 1e-6)]))

    def test_shows_a_row_a_method_with_both_recalls(self):
        shown = answer(Result(write_result(self.path("hard.h5"))))
        for table in (shown["first"], shown["whole"]):
            self.assertEqual([line[0] for line in table["rows"]], ["original", "improved"])
            self.assertTrue(all(len(line) == len(table["headings"]) for line in table["rows"]))
            self.assertIn("recall [%]", table["headings"])
        self.assertLessEqual(len(shown["first"]["headings"]), 7)
        self.assertEqual([line[1] for line in shown["first"]["rows"]], ["8 of 40", "0 of 40"])
        self.assertIn("recall, neighbouring features count [%]", shown["whole"]["headings"])

    def test_on_the_clock_frames_without_a_tick_are_late_and_no_method_is_preferred(self):
        file = write_result(self.path("clock.h5"))
        with h5py.File(file, "a") as h5:
            for label, missed in (("original", 3), ("improved", 0)):
                h5[f"realtime/{label}/frame_source"] = np.repeat([0, 1, 2], [1990, missed, 10 - missed])
        shown = answer(Result(file))
        for table in (shown["first"], shown["whole"]):
            column = table["headings"].index("frames without a tick")
            self.assertEqual([line[column] for line in table["rows"]], ["3", "0"])
        self.assertNotIn("least force error", shown["sentence"])
        self.assertIn("late frames", answer(Result(write_result(self.path("hard.h5"))))["first"]["headings"])

    def test_numbers_are_in_the_unit_that_one_reads(self):
        self.assertEqual([time(value) for value in (float("nan"), 9.91e-6, 1.101e-3, 2.0, 0.9997e-3, 0.99991, 0.9994e-3, 1234.0)],
                         ["-", "9.91 \u00b5s", "1.1 ms", "2 s", "1 ms", "1 s", "999 \u00b5s", "1234 s"])
        self.assertEqual([percent(share) for share in (float("nan"), 0.0, 3e-14, 3e-5, 0.494, 0.9998, 1.0, 12.5)],
                         ["-", "0", "0", "< 0.01", "49.4", "> 99.9", "100", "1250"])

    def test_what_misses_one_lmd_of_many_is_not_whole(self):
        file = write_result(self.path("hard.h5"))
        with h5py.File(file, "a") as h5:
            h5["methods/original/summary/recall"][...] = 0.9998
        shown = answer(Result(file))
        for table in (shown["first"], shown["whole"]):
            column = table["headings"].index("recall [%]")
            self.assertEqual([line[column] for line in table["rows"]], ["> 99.9", "100"])

    def test_names_an_aggregation_that_is_not_the_sum(self):
        file = write_result(self.path("hard.h5"))
        with h5py.File(file, "a") as h5:
            h5["/methods/improved"].attrs["aggregation"] = "shared"
        rows = answer(Result(file))["whole"]["rows"]
        self.assertEqual([line[1] for line in rows], ["linear", "exponential, shared"])


class Series(Scratch):
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
        Truth.recall = np.full(4, np.nan)
        np.testing.assert_array_equal(moving_recall(Truth), np.full(4, np.nan))  # promises no set

    def test_encodes_what_the_result_holds(self):
        result = Result(write_result(self.path("hard.h5"), frames=300))
        panels = {panel["id"]: panel for panel in time_panels(result)["panels"]}
        lines = {line["label"]: decoded(line["values"]) for line in panels["force"]["series"]}
        np.testing.assert_allclose(lines["improved"], result.methods["improved"].force_magnitude(), rtol=1e-6)
        self.assertEqual(lines["truth, exponential law"].size, 300)

    def test_marks_the_devices_limit_where_forces_reach_it(self):
        result = Result(write_result(self.path("hard.h5"), frames=300))
        highest = max(np.nanmax(method.force_magnitude()) for method in result.methods.values())
        for limit, drawn in ((highest, True), (2.0 * highest, False)):
            result.scene = lambda name, limit=limit: limit
            self.assertEqual("limit" in time_panels(result)["panels"][0], drawn)

    def test_says_over_which_frames_recall_is(self):
        for frames, words in ((300, "so far"), (3000, "in the last 40 probed frames")):
            result = Result(write_result(self.path(f"{frames}.h5"), frames=frames))
            (title,) = [panel["title"] for panel in time_panels(result)["panels"] if panel["id"] == "recall"]
            self.assertIn(words, title)


OCTAHEDRON = "OFF\n6 8 0\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n" + "".join(
    f"3 {a} {b} {c}\n" for a, b, c in ((0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)))


def octahedron(middle):
    lines = OCTAHEDRON.splitlines()
    corners = [" ".join(repr(float(value)) for value in np.array(line.split(), dtype=float) + middle) for line in lines[2:8]]
    return "\n".join([*lines[:2], *corners, *lines[8:]]) + "\n"


def add_path(file):
    with h5py.File(file, "a") as h5:
        frames = h5["path/time"].shape[0]
        h5["path/position"] = np.linspace(0, 1, 3 * frames).reshape(-1, 3)
        h5["path/orientation"] = np.tile([0.0, 0.0, 0.0, 1.0], (frames, 1))


class WhatWasRun(Scratch):
    def test_says_force_loop_and_searches(self):
        result = Result(write_result(self.path("hard.h5")))
        result.experiment.update({"loop": {"kind": "closed"}, "driver": {"kind": "lockstep", "search_every_frames": 20, "search_latency_frames": 15}})
        told = report.what_was_run(result)
        for words in ("in a closed loop", "F_max ", "original and improved: a search begins every 20 frames and its contacts are in use 15 frames later"):
            self.assertIn(words, told)
        result.experiment.update({"loop": {"kind": "open"}, "driver": {"kind": "realtime"}})
        told = report.what_was_run(result)
        self.assertNotIn("closed loop", told)
        self.assertNotIn("a search begins every", told)

    def test_names_all_methods_that_the_device_clips(self):
        file = write_result(self.path("clipped.h5"))
        with h5py.File(file, "a") as h5:
            for label, share in (("original", 0.3), ("improved", 0.02)):
                h5[f"methods/{label}/summary/force_clipped_share"] = [share]
        result = Result(file)
        self.assertEqual(report.clipping_beside(result, ["original: the device clips the force in 30 % of the frames"]),
                         ["The force of other methods is clipped, too: improved in 2 % of the frames in contact"])
        self.assertEqual(report.clipping_beside(result, []), [])

    def test_provenance_is_in_words(self):
        self.assertEqual([report.in_words(*row) for row in (("git_commit", "abc"), ("machine: l1_data_cache_bytes", "49152"),
                                                            ("machine: memory_bytes", "25276026880"), ("result hash: my_own", "1f"))],
                         [("git commit", "abc"), ("machine: L1 data cache", "48 KiB"), ("machine: memory", "24,105 MiB"), ("result hash: my_own", "1f")])


class Scene(Scratch):
    def left(self, change=lambda h5: None, tracks=("",), at=np.zeros(3)):
        """What `lmdbench report` leaves of a result: two octahedra, an LMD of a millimetre in every frame but the first."""
        file = write_result(self.path(f"{change.__name__}{at[0]:g}.h5"), frames=300)
        add_path(file)
        with h5py.File(file, "a") as h5:
            h5["path/position"][...] += at
            change(h5)
        for role, middle in (("moving", np.zeros(3)), ("fixed_0", at)):
            self.write(f"scene/{role}.off", octahedron(middle))
        lmd = {"distance": 0.001, "point_moving": [1.0 + at[0], *at[1:]], "point_fixed": [1.001 + at[0], *at[1:]]}
        self.write("scene/lmds.jsonl", "".join(json.dumps({"frame": frame, "track": track, "time": frame / 1000, "lmds": [lmd] if frame else []}) + "\n"
                                               for track in tracks for frame in (0, 100, 200)))
        return file

    def scene(self, file):
        return scene_data.scene(Result(file), self.path("scene"))

    def made(self, *change, **options):
        return self.scene(self.left(*change, **options))

    def test_a_scene_far_from_the_origin_is_the_same(self):
        for at in ([0.0, 0.0, 0.0], [1e6, -2e6, 3e6]):
            data = self.made(at=np.array(at))
            np.testing.assert_allclose(data["origin"], np.add(at, [0.0, 1 / 899, 2 / 899]), rtol=1e-9)
            (track,) = data["tracks"]
            self.assertAlmostEqual(float(decoded(track["exact"]["rows"])[3] - decoded(track["exact"]["rows"])[0]), 0.001, 6)
            np.testing.assert_allclose(decoded(track["position"])[:3], 0.0, atol=1e-6)
            np.testing.assert_allclose(decoded(track["position"])[3:6], [0.3337] * 3, atol=1e-4)
            fixed = next(mesh for mesh in data["meshes"] if mesh["role"] == "fixed_0")
            np.testing.assert_allclose(fixed["low"], [-1.0, -1.0, -1.0], atol=0.003)

    def test_a_mesh_far_from_its_own_origin_lies_about_its_middle(self):
        def turn(h5):
            h5["path/orientation"][100] = [0.0, 0.0, 1.0, 0.0]  # half a turn about z
        file = self.left(turn)
        self.write("scene/moving.off", octahedron([1e8, 0.0, 0.0]))
        data = self.scene(file)
        self.assertEqual(next(mesh for mesh in data["meshes"] if mesh["role"] == "moving")["low"], [-1.0, -1.0, -1.0])
        np.testing.assert_allclose(decoded(data["tracks"][0]["position"])[[0, 3]], [0.0, -2e8], atol=20.0)

    def test_two_meshes_with_the_same_triangles_are_told_apart(self):
        file = self.left()
        self.write("scene/fixed_1.off", octahedron([5.0, 0.0, 0.0]))
        self.write("scene/fixed_2.off", OCTAHEDRON.replace("0 0 1\n", "0 0 2\n"))
        meshes = self.scene(file)["meshes"]
        self.assertEqual([mesh.get("triangles_of") for mesh in meshes], [None, "fixed_0", None, "fixed_0"])

    def test_parts_from_files_stand_on_z_and_scans_on_y(self):
        def part(h5):
            h5.require_group("scene/moving").attrs["mesh"] = "./peg.stl"

        self.assertEqual([self.made()["up"], self.made(part)["up"]], [[0, 1, 0], [0, 0, 1]])

    def test_shows_exact_sets_poses_and_forces(self):
        (track,) = self.made()["tracks"]
        self.assertEqual(track["frames"], [0, 100, 200])
        self.assertEqual(track["exact"]["offset"], [0, 0, 1, 2])
        path = np.linspace(0, 1, 900).reshape(-1, 3)
        np.testing.assert_allclose(decoded(track["exact"]["rows"])[:7], [*[1, 0, 0] - path[0], *[1.001, 0, 0] - path[0], 0.001], rtol=1e-6)
        np.testing.assert_allclose(decoded(track["position"])[3:6], path[100] - path[0], rtol=1e-6)
        self.assertEqual(list(track["forces"]), ["original", "improved"])
        self.assertEqual(track["own"], {})
        self.assertIsNone(track["polylines"])

    def test_shows_the_methods_own_sets_where_they_were_recorded(self):
        def record(h5):
            lmds = h5["methods/improved"].create_group("lmds")
            lmds["frame_offset"] = np.arange(301)  # one a frame: frame f has row f
            lmds["point_moving"], lmds["point_fixed"] = np.full((300, 3), 2.0), np.full((300, 3), 3.0)
            lmds["distance"] = np.arange(300.0)
        (track,) = self.made(record)["tracks"]
        self.assertEqual(list(track["own"]), ["improved"])
        self.assertEqual(track["own"]["improved"]["offset"], [0, 1, 2, 3])
        np.testing.assert_allclose(decoded(track["own"]["improved"]["rows"]).reshape(-1, 7)[:, 6], [0, 100, 200])

    def test_shows_every_mover_at_its_poses(self):
        def record(h5):
            movers = h5.create_group("path/movers")
            movers["position"] = np.arange(300 * 4 * 3.0).reshape(300, 4, 3)
            movers["orientation"] = np.tile([0.0, 0.0, 0.0, 1.0], (300, 4, 1))
            for entry, (first, count) in enumerate([(1, 2), (3, 1)]):
                group = h5.require_group(f"scene/mover_{entry}")
                group.attrs["first_mover"], group.attrs["movers"] = first, count
        for entry in (0, 1):
            self.write(f"scene/mover_{entry}.off", OCTAHEDRON)
        (track,) = self.made(record)["tracks"]
        self.assertEqual([mover["role"] for mover in track["movers"]], ["mover_0", "mover_0", "mover_1"])
        np.testing.assert_allclose(decoded(track["movers"][1]["position"])[3:6], [1206, 1207, 1208], atol=0.01)  # frame 100, mover 2
        self.assertEqual(self.made()["tracks"][0]["movers"], [])

    def test_shows_curves_at_their_frames(self):
        def record(h5):
            cut = h5.create_group("polylines")
            cut["frame"], cut["frame_offset"] = [0, 200], [0, 1, 2]
            cut["point_offset"], cut["closed"] = [0, 2, 5], np.array([0, 1], dtype="u1")
            cut["point"] = np.arange(15.0).reshape(5, 3)
        (track,) = self.made(record)["tracks"]
        self.assertEqual([len(lines) for lines in track["polylines"]], [1, 0, 1])
        closed, points = track["polylines"][2][0]
        self.assertEqual(closed, 1)
        np.testing.assert_allclose(decoded(points), np.arange(6, 15), atol=0.01)

    def test_a_closed_loop_has_a_track_a_device(self):
        def close(h5):
            for number, label in enumerate(("original", "improved")):
                h5[f"methods/{label}/path/position"] = np.full((300, 3), float(number))
                h5[f"methods/{label}/path/orientation"] = np.tile([0.0, 0.0, 0.0, 1.0], (300, 1))
        tracks = self.made(close, tracks=("original", "improved"))["tracks"]
        self.assertEqual([track["label"] for track in tracks], ["original", "improved"])
        self.assertEqual([list(track["forces"]) for track in tracks], [["original"], ["improved"]])
        np.testing.assert_array_equal(decoded(tracks[1]["position"]), np.ones(9))

    def test_keeps_corners_within_half_a_step(self):
        vertices = np.array([[0.0, -1.0, 5.0], [1.0, 3.0, 5.0], [0.25, 1.0, 5.0]])
        mesh = scene_data.mesh_json(vertices, np.array([[0, 1, 2]]), len(vertices))
        steps = np.frombuffer(base64.b64decode(mesh["vertices"]), dtype="<u2").reshape(-1, 3)
        back = np.array(mesh["low"]) + steps / 65535 * np.array(mesh["size"])
        np.testing.assert_allclose(back, vertices, atol=4.0 / 65535)

    def test_tells_why_there_is_no_view(self):
        self.write("problem.txt", "No view: the mesh is gone")
        self.assertEqual(scene_data.scene(Result(write_result(self.path("hard.h5"))), self.folder)["problem"], "No view: the mesh is gone")


class Page(Scratch):
    def setUp(self):
        super().setUp()
        self.file = write_result(self.path("hard.h5"))

    def made(self, *more, others=()):
        self.printed(report.main, self.file, *others, "--out", self.path("out"), *more)
        return self.read("out", "index.html")

    def test_stands_alone_and_is_the_same_bytes_twice(self):
        text = self.made()
        self.assertNotRegex(text, r'(?:src|href)="(?!data:|#)')
        for name in ("work_precision.svg", "work_precision.png", "over_time.svg", "over_time.png"):
            self.assertTrue(os.path.getsize(self.path("out", name)) > 0)
        self.assertEqual(text, self.made())

    def test_shows_studies_and_escapes_what_a_result_says(self):
        text = self.made("--study", self.write("ledger.md", "# Who was wrong\n\n| a | b |\n|---|---|\n| 1 | 2 |\n\n![picture](elsewhere.png)\n"))
        self.assertIn("<h2>Who was wrong</h2>", text)
        self.assertIn("<td>1</td>", text)
        self.assertNotIn("elsewhere.png", text)
        self.assertEqual(text.count("</script>"), text.count("<script"))

    def test_studies_that_cannot_be_read_are_named(self):
        self.write("figure1.png", "no picture")
        with open(self.path("latin.md"), "wb") as stream:
            stream.write(b"# \xe4")
        for options, name in ((("--study", self.path("nosuch.md")), "nosuch.md"), (("--study", self.path("latin.md")), "latin.md"),
                              (("--study", self.write("a.md", "# A\n\n![lines](figure1.png)\n")), "figure1.png"), (("--paper", self.folder), "figure1.png")):
            with self.assertRaisesRegex(ResultError, f"^[^ ]*{name}: .*remedy"):
                self.made(*options)

    def test_studies_of_one_name_have_ids_of_their_own(self):
        text = self.made("--study", *(self.write(f"{folder}/a.md", f"# Of {folder}\n\nwords\n") for folder in ("one", "two")))
        self.assertEqual(re.findall(r'<section id="(study-[^"]*)"', text), ["study-a", "study-a-2"])

    def check_pictures(self, text, size, *colours):
        """There is one of each colour, in this order, in a part of the page."""
        for data, colour in zip(re.findall(r'src="data:image/webp;base64,([^"]+)"', text), colours, strict=True):
            with Image.open(io.BytesIO(base64.b64decode(data))) as picture:
                self.assertEqual(picture.size, size)
                np.testing.assert_allclose(picture.convert("RGB").getpixel((size[0] // 2, size[1] // 2)), colour, atol=4)

    def test_studies_carry_their_pictures_and_the_named_ones_come_first(self):
        studies = [self.write(f"{name}.md", text) for name, text in (
            ("a-table", "# A table\n\nwords\n"), ("ledger", "# Ledger\n\nwords\n"),
            ("scaling", "# Scaling\n\n![lines](lines.png)\n[other](other.md) [web](https://example.org)\n"))]
        Image.new("RGB", (3000, 30), "#336699").save(self.path("lines.png"))
        text = self.made("--study", *studies)
        self.assertLess(text.index('id="study-scaling"'), text.index('id="study-ledger"'))
        self.assertLess(text.index('id="study-ledger"'), text.index('id="more"'))
        self.assertLess(text.index('id="more"'), text.index('id="study-a-table"'))
        self.check_pictures(text.split('alt="lines"')[1], (1500, 15), (0x33, 0x66, 0x99))
        self.assertNotIn('href="other.md"', text)
        self.assertIn('href="https://example.org"', text)

    def test_shows_those_of_the_papers_figures_that_are_there(self):
        folder = self.path("figures")
        os.mkdir(folder)
        with self.assertRaisesRegex(ResultError, "none of figure1.png to figure6.png.*remedy"):
            self.made("--paper", folder)
        for name, colour in (("figure2", "#336699"), ("figure6", "#993366"), ("figure8", "#000000")):
            Image.new("RGB", (2000, 40), colour).save(os.path.join(folder, f"{name}.png"))
        text = self.made("--paper", folder)
        section = text.split('<section id="paper">', 1)[1].split("</section>", 1)[0]
        self.assertEqual(re.findall(r'<figure class="drawing" id="([^"]+)"', section), ["figure2", "figure6"])
        self.assertRegex(section, r'alt="Figure 2: A normal cone[^"]*"')
        self.check_pictures(section, (1000, 20), (0x33, 0x66, 0x99), (0x99, 0x33, 0x66))
        self.assertIn('<a href="#paper">Figures 1 to 6</a>', text)
        self.assertNotIn('id="paper"', self.made())

    def test_the_paper_is_there_where_it_is_asked_for(self):
        own, papers = (self.made(*options).split("<main>")[1].split("</main>")[0] for options in ((), ("--paper",)))
        for words in ('<section id="figure7">', "Figure 7, frame by frame", 'id="claims"', '<th scope="row">K9</th>', "The paper states neither"):
            self.assertIn(words, papers)
            self.assertNotIn(words, own)
        self.assertIn("<h2>Over time, frame by frame</h2>", own)
        self.assertIn('<details id="over_time">', own)

    def test_what_the_figure_over_time_has_no_room_for_is_named_and_has_its_numbers(self):
        def five(h5):
            for number in range(5):
                h5.copy("methods/improved", f"methods/improved-p{number}")
                h5[f"methods/improved-p{number}"].attrs["profile"] = f"p{number}"
            for label in ("original", "improved"):
                del h5[f"methods/{label}"]
        wide, other = (write_result(self.path(f"{name}.h5"), name=name, frames=100) for name in ("wide", "other"))
        with h5py.File(wide, "a") as h5:
            five(h5)
        results = [Result(wide), Result(other)]
        self.enterContext(unittest.mock.patch.object(page_figures, "saved", lambda *_: ""))
        for by_paper in (False, True):
            entry = page_figures.over_time_entry(results, self.folder, by_paper)
            self.assertIn("From left to right: wide, p0; wide, p1; wide, p2; wide, p3. ", entry["text"])
            self.assertIn("Not in the figure, which has room for 4: wide, p4; other (", entry["text"])
            self.assertEqual(entry["csv_results"], [(0, "wide"), (1, "other")])
        self.assertNotIn("Not in the figure", page_figures.over_time_entry(results[1:], self.folder, False)["text"])

    def test_the_figure_over_time_tells_of_truth_only_where_there_is_one(self):
        self.enterContext(unittest.mock.patch.object(page_figures, "saved", lambda *_: ""))
        for stride in (0, 50):
            result = Result(write_result(self.path(f"probed{stride}.h5"), frames=100, truth_stride=stride))
            text = page_figures.over_time_entry([result], self.folder, False)["text"]
            self.assertEqual("the true force" in text, stride > 0, text)

    def test_variants_of_an_experiment_are_told_apart_and_share_ranges(self):
        other = write_result(self.path("other.h5"), maximum_force=6.0, settings={"device": "ideal"})
        with h5py.File(self.file, "a") as h5:
            experiment = {**json.loads(h5["provenance/experiment"][0]), "device": "phantom-desktop"}
            h5["provenance/experiment"][0] = json.dumps(experiment)
        text = self.made(others=[other])
        names = ["hard: device phantom-desktop", "hard: device ideal"]
        for mark in ("<h2>{}</h2>", "<h3>{}</h3>", "<figcaption>{}</figcaption>", "Download CSV of {}<"):
            for name in names:
                self.assertIn(mark.format(name), text)
        self.assertIn("<h1>synthetic hard</h1>", text)
        self.assertEqual(len(re.findall(r' id="([^"]+)"', text)), len(set(re.findall(r' id="([^"]+)"', text))))
        left, right = json.loads(text.split('id="page-data">', 1)[1].split("</script>", 1)[0])["results"]
        self.assertEqual([panel["range"] for panel in left["panels"]], [panel["range"] for panel in right["panels"]])
        self.assertGreater(left["panels"][0]["range"][1], 6.0)

    def test_claims_link_to_sections_that_are_there(self):
        text = self.made("--paper")
        claims = text.split('<section id="claims">', 1)[1].split("</section>", 1)[0]
        self.assertEqual(re.findall(r'<th scope="row">(K\d+)</th>', claims), [f"K{number}" for number in range(1, 13)])
        self.assertRegex(claims.split('<th scope="row">K12</th>')[1], r"<td>not measured</td>\s*<td><b>holds where</b>")
        links = re.findall(r'href="#([^"]+)"', claims)
        self.assertIn("figure7", links)
        self.assertNotIn("study-jumps", links)
        for link in links:
            self.assertIn(f'<section id="{link}"', text)
        self.assertIn("hard alone", claims)

    def test_a_run_without_contact_judges_nothing(self):
        self.file = write_result(self.path("apart.h5"), true_counts=np.zeros(2000, dtype=int))
        self.assertIn("and frames in contact", self.made("--paper"))

    def test_own_scenes_get_what_they_have_and_are_told_what_they_lack(self):
        """Labels of one's own, one method that searches in every frame, no truth probe, two profiles."""
        def relabel(h5):
            h5["methods"].move("original", "mine-hard")
            h5["methods"].move("improved", "mine-soft")
            for profile in ("hard", "soft"):
                h5[f"methods/mine-{profile}"].attrs["profile"] = profile
                h5[f"methods/mine-{profile}"].attrs["cutoff_m"] = 0.001 if profile == "hard" else 0.01
        for name, methods, stride, change in (("certified", ("certified",), 50, lambda h5: None), ("bare", ("original", "certified"), 0, lambda h5: None),
                                              ("profiles", ("original", "improved"), 50, relabel)):
            self.file = write_result(self.path(f"{name}.h5"), methods=methods, truth_stride=stride)
            with h5py.File(self.file, "a") as h5:
                change(h5)
            text = self.made("--paper")
            self.assertTrue(os.path.exists(self.path("out", "figure7.svg")))
            self.assertEqual('<section id="work_precision">' in text, stride > 0)
            claims = text.split('<section id="claims">', 1)[1].split("</section>", 1)[0]
            self.assertIn("No claim can be judged", claims)
            if not stride:
                self.assertIn("No frame in contact was compared", text)
        self.assertIn("cutoff 1 and 10 mm", text)

    def test_data_is_json(self):
        text = self.made()
        data = text.split('id="page-data">', 1)[1].split("</script>", 1)[0]
        self.assertEqual(json.loads(data)["results"][0]["name"], "hard")
        self.assertIn("RMS force error", json.loads(data)["tables"]["work_precision"])

    def test_a_name_begins_no_script_and_is_no_link(self):
        name = "cu<!--<script>"
        with h5py.File(self.file, "a") as h5:
            experiment = {**json.loads(h5["provenance/experiment"][0]), "name": name, "title": name}
            h5["provenance/experiment"][0] = json.dumps(experiment)
        text = self.made()
        self.assertNotIn(name, text)
        data = text.split('id="page-data">', 1)[1].split("</script>", 1)[0]
        self.assertNotIn("<", data)
        self.assertEqual(json.loads(data)["results"][0]["name"], name)
        self.assertIn(name, json.loads(data)["tables"]["work_precision"])
        made = studies.html_of("[a](javascript:alert) [b](#b)")
        self.assertNotIn("javascript", made)
        self.assertIn('<a href="#b">b</a>', made)

    def test_refuses_what_is_no_result(self):
        with self.assertRaises(ResultError):
            report.main([__file__, "--out", self.folder])


class SweepPage(Scratch):
    """A page of sweeps, alone and beside a run."""

    def page(self, *runs):
        write_sweep(self.path("sweep.h5"), ROWS, "budget")
        self.printed(report.main, *runs, self.path("sweep.h5"), "--out", self.path("page"))
        return self.read("page", "index.html")

    def test_alone_it_has_figure_budgets_crossing_and_every_point(self):
        text = self.page()
        self.assertTrue(os.path.exists(self.path("page", "sweep-budget.svg")))
        self.assertIn('<section id="sweep-budget">', text)
        self.assertIn("certified: 0 %", text)
        self.assertIn("<td>33</td>", text)
        self.assertIn("mesh is missing", text)  # in the CSV
        self.assertNotIn('<section id="frames">', text)

    def test_sweeps_of_one_name_are_told_apart(self):
        write_sweep(self.path("other.h5"), [entry for entry in ROWS if entry["series"] == "improved"], "Budget")
        write_sweep(self.path("more.h5"), ROWS, "budget")
        text = self.page(self.path("other.h5"), self.path("more.h5"))
        self.assertEqual(re.findall(r'<section id="(sweep-[^"]*)"', text), ["sweep-Budget", "sweep-budget-2", "sweep-budget-3"])
        self.assertEqual(len(json.loads(text.split('id="page-data">', 1)[1].split("</script>", 1)[0])["tables"]), 3)
        for words in ("<h2>Error against run time (more.h5)</h2>", "<h2>Error against run time (sweep.h5)</h2>", "<h3>budget (more.h5)</h3>"):
            self.assertIn(words, text)
        with self.assertRaisesRegex(ResultError, "a file is there twice"):
            self.page(self.path("sweep.h5"))

    def test_beside_a_run_it_comes_first_and_the_run_keeps_its_sections(self):
        text = self.page(write_result(self.path("run.h5")))
        self.assertLess(text.index('<section id="sweep-budget">'), text.index('<section id="work_precision">'))
        self.assertIn('<section id="frames">', text)
