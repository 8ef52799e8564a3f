# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The Python module against the program and against itself. Arguments: the program, the folder that holds the module."""

import json
import os
import re
import resource
import signal
import sys
import threading
import time
import unittest
from pathlib import Path

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts", "figures", "tests"))

from cases import ROOT, Scratch, call  # noqa: E402  (the figures' tests must be found first)

PROGRAM, MODULE = sys.argv.pop(1), sys.argv.pop(1)
sys.path.insert(0, MODULE)

import lmdbench  # noqa: E402
import numpy as np  # noqa: E402

CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
SIDES = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
                  [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]])


def torus(rows=24, columns=40):
    u, v = np.meshgrid(np.arange(rows) * 2 * np.pi / rows, np.arange(columns) * 2 * np.pi / columns, indexing="ij")
    ring = 1.0 + 0.35 * np.cos(u)
    vertices = np.stack([ring * np.cos(v), ring * np.sin(v), 0.35 * np.sin(u)], axis=-1).reshape(-1, 3)
    i, j = (a.ravel() for a in np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij"))
    here, right = i * columns + j, i * columns + (j + 1) % columns
    above, across = (i + 1) % rows * columns + j, (i + 1) % rows * columns + (j + 1) % columns
    return vertices, np.concatenate([np.stack([here, right, across], 1), np.stack([here, across, above], 1)])


def poses_near(count, seed=1):
    """Random turns, shifted so that tori are near each other."""
    random = np.random.default_rng(seed)
    quaternions = random.normal(size=(count, 4))
    quaternions /= np.linalg.norm(quaternions, axis=1)[:, None]
    return quaternions, random.normal(size=(count, 3)) * 0.1 + [2.0, 0.2, 0.3]


def matrices(quaternions, shifts):
    x, y, z, w = quaternions.T
    result = np.tile(np.eye(4), (len(shifts), 1, 1))
    result[:, 0, :3] = np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)], 1)
    result[:, 1, :3] = np.stack([2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)], 1)
    result[:, 2, :3] = np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], 1)
    result[:, :3, 3] = shifts
    return result


def at(height):
    pose = np.eye(4)
    pose[:3, 3] = 0.2, 0.3, height
    return pose


class Files(Scratch):
    def write_off(self, name, vertices, triangles):
        lines = [f"OFF\n{len(vertices)} {len(triangles)} 0\n"]
        lines += ["%r %r %r\n" % tuple(map(float, vertex)) for vertex in vertices]
        lines += ["3 %d %d %d\n" % tuple(triangle) for triangle in triangles]
        return self.write(name, "".join(lines))

    def program(self, *arguments):
        return call(PROGRAM, *arguments, cwd=self.folder, timeout=120)


class AgainstTheProgram(Files):
    def test_every_method_gives_the_bits_of_query(self):
        mesh = self.write_off("torus.off", *torus())
        quaternions, shifts = poses_near(12)
        rows = [" ".join(map(repr, map(float, (i, *shift, *turn)))) for i, (shift, turn) in enumerate(zip(shifts, quaternions))]
        path = self.write("near.tum", "\n".join(rows) + "\n")
        for method in lmdbench.method_names():
            with self.subTest(method=method):
                sets = lmdbench.query(mesh, mesh, path, 0.2, method)
                done = self.program("query", "--moving", mesh, "--fixed", mesh, "--cutoff", "0.2", "--poses", path, "--method", method,
                                    "--json")
                lines = [json.loads(line) for line in done.stdout.splitlines()]
                self.assertEqual(len(sets), len(lines), done.stderr)
                for line, lmds in zip(lines, sets):
                    self.assertEqual([lmd["distance"] for lmd in line["lmds"]], lmds["distance"].tolist())
                    for side in ("moving", "fixed"):
                        self.assertEqual([lmd[f"point_{side}"] for lmd in line["lmds"]], lmds[f"point_{side}"].tolist())
                        kinds = [lmdbench.FeatureKind(kind).name.lower() for kind in lmds[f"feature_{side}"]["kind"]]
                        self.assertEqual([lmd[f"feature_{side}"]["kind"] for lmd in line["lmds"]], kinds)
                        self.assertEqual([lmd[f"feature_{side}"]["index"] for lmd in line["lmds"]],
                                         lmds[f"feature_{side}"]["index"].tolist())
                if method == "certified":
                    self.assertGreater(sets.counts.sum(), 10)
                    self.assertEqual(sets.times.tolist(), list(range(12)))

    def test_errors_have_the_text_of_the_program(self):
        box = self.write_off("box.off", CORNERS, SIDES)
        cut = self.write("cut.off", "OFF\n8 12 0\n0 0 0\n")
        path = self.write("bad.tum", "0 0 0 0 0 0 0 1\n1 0 0 zero 0 0 0 1\n")
        cases = ((("gone.off", box, np.eye(4)), {}, lmdbench.InputError, ["--moving", "gone.off", "--fixed", box]),
                 ((cut, box, np.eye(4)), {}, lmdbench.InputError, ["--moving", cut, "--fixed", box]),
                 ((box, box, path), {}, lmdbench.InputError, ["--moving", box, "--fixed", box, "--poses", path]))
        os.chdir(self.folder)
        for (moving, fixed, poses), options, kind, arguments in cases:
            with self.assertRaises(kind) as caught:
                lmdbench.query(moving, fixed, poses, 0.1, **options)
            done = self.program("query", "--cutoff", "0.1", *[os.path.basename(a) if a == "gone.off" else a for a in arguments])
            self.assertEqual(done.returncode, caught.exception.exit_code)
            said = re.sub(r"^\[?error\]?:? ", "", done.stderr.strip())
            self.assertIn("remedy", str(caught.exception))
            if "gone" not in arguments[1]:  # the program may also take a name for "gone.off"
                self.assertIn(str(caught.exception), said)
        for method, options in (("certifed", {}), ("improved", {"visibilty": "off"}), ("improved", {"visibility": "maybe"})):
            with self.assertRaises(lmdbench.UsageError) as caught:
                lmdbench.query(box, box, np.eye(4), 0.1, method, **options)
            self.assertEqual(caught.exception.exit_code, 2)
            arguments = [f"{name}={value}" for name, value in options.items()]
            done = self.program("query", "--cutoff", "0.1", "--moving", box, "--fixed", box, "--method", method,
                                *sum((["--option", argument] for argument in arguments), []))
            problem = str(caught.exception).split(": ", 1)[1].split(" (remedy")[0]
            self.assertIn(problem.split(": ")[-1], done.stderr)

    def test_options_may_be_numbers_of_numpy(self):
        of_numpy = {"search_threads": np.int64(1), "second_tracking": np.bool_(False)}
        sets = [lmdbench.query((CORNERS, SIDES), (CORNERS, SIDES), at(1.02), 0.05, "improved", **options)[0]
                for options in (of_numpy, {"search_threads": 1, "second_tracking": False})]
        np.testing.assert_array_equal(*sets)
        with self.assertRaises(lmdbench.UsageError):
            lmdbench.query((CORNERS, SIDES), (CORNERS, SIDES), at(1.02), 0.05, "improved", search_threads=np.float64(1.5))
        with self.assertRaisesRegex(lmdbench.UsageError, "options: g5_tolerance_deg: nan .*remedy: a finite number"):
            lmdbench.query((CORNERS, SIDES), (CORNERS, SIDES), at(1.02), 0.05, "original", merge_duplicates=True, g5_tolerance_deg=np.float64("nan"))
        with self.assertRaisesRegex(TypeError, "type set .*remedy"):
            lmdbench.query((CORNERS, SIDES), (CORNERS, SIDES), at(1.02), 0.05, "improved", search_threads={1})


class Arrays(Files):
    def test_sets_are_views_that_outlive_their_search(self):
        sets = lmdbench.query((CORNERS, SIDES), (CORNERS, SIDES), np.stack([at(1.02), at(1.5), at(1.01)]), 0.05)
        self.assertEqual(sets.counts.tolist(), [1, 0, 1])
        np.testing.assert_array_equal(sets.minimum_distance, [sets[0]["distance"][0], np.nan, sets[2]["distance"][0]])
        first, last = sets[0], sets[-1]
        self.assertEqual(first.dtype, lmdbench.LMD_DTYPE)
        self.assertFalse(first.flags.owndata)
        self.assertFalse(first.flags.writeable)
        self.assertEqual(first.__array_interface__["data"][0], sets[0].__array_interface__["data"][0])
        kept = last.copy()
        del sets
        junk = [bytearray(1000) for _ in range(10000)]
        np.testing.assert_array_equal(last, kept)
        del junk
        self.assertTrue(kept.flags.writeable)
        self.assertAlmostEqual(last["distance"][0], 0.01)
        np.testing.assert_allclose(last["direction"][0], [0, 0, -1])
        np.testing.assert_allclose(last["point_fixed"] - last["point_moving"], last["direction"] * last["distance"][:, None], atol=1e-15)

    def test_sequence(self):
        sets = lmdbench.query((CORNERS, SIDES), (CORNERS, SIDES), np.stack([at(1.02), at(1.5), at(1.01)]), 0.05)
        self.assertEqual([part.size for part in sets[1:]], [0, 1])
        self.assertEqual(sets.seconds.shape, (3,))
        for index in (3, -4):
            with self.assertRaises(IndexError):
                sets[index]

    def test_meshes_keep_the_rows_of_the_arrays(self):
        vertices = np.vstack([[np.nan, 9.0, 9.0], CORNERS])
        mesh = lmdbench.Mesh(vertices, SIDES.astype(np.uint16) + 1)
        used = np.vstack([CORNERS[SIDES[0, 0]], CORNERS])  # a vertex without triangles counts for nothing
        np.testing.assert_array_equal(mesh.vertices, used)
        np.testing.assert_array_equal(mesh.triangles, SIDES + 1)
        self.assertFalse(mesh.vertices.flags.writeable)
        self.assertEqual(mesh.edges.shape, (18, 2))
        self.assertTrue((mesh.edges[:, 0] < mesh.edges[:, 1]).all())
        self.assertEqual(mesh.findings, [])
        self.assertNotEqual(lmdbench.Mesh(CORNERS, SIDES[:-1]).findings, [])
        # A triangle without area that closes a T junction is flipped with the one beside it.
        middle = np.vstack([CORNERS, CORNERS[SIDES[0, :2]].mean(axis=0)])
        a, b, c = SIDES[0]
        junction = lmdbench.Mesh(middle, np.vstack([[[a, 8, c]], SIDES[1:], [[8, b, c], [a, b, 8]]]))
        self.assertEqual(junction.triangles.shape, (14, 3))
        self.assertIn("1 flat triangle", " ".join(junction.findings))
        view = mesh.vertices
        del mesh
        np.testing.assert_array_equal(view, used)
        turned = matrices(*poses_near(1))[0]
        turned[:3, 3] = np.array([0.4, 0.6, 1.02]) - turned[:3, :3] @ CORNERS[np.argmin(CORNERS @ turned[2, :3])]
        lmd = lmdbench.query((vertices, SIDES + 1), (CORNERS, SIDES), turned, 0.05)[0][0]
        self.assertEqual(lmd["feature_moving"]["kind"], lmdbench.FeatureKind.VERTEX)
        self.assertEqual(lmd["feature_moving"]["index"], 1 + np.argmin(CORNERS @ turned[2, :3]))

    def test_several_fixed_meshes(self):
        shifted = (CORNERS + [1.5, 0, 0], SIDES)
        sets = lmdbench.query((CORNERS, SIDES), [(CORNERS, SIDES), shifted], at(1.02), 0.05)
        self.assertEqual(sorted(sets[0]["fixed_body"]), [0] if sets[0].size == 1 else [0, 1])
        self.assertIn(0, sets[0]["fixed_body"])

    def test_bad_arguments_are_named(self):
        box = lmdbench.Mesh(CORNERS, SIDES)
        mirrored = np.diag([1.0, 1.0, -1.0, 1.0])
        cases = ((lambda: lmdbench.Mesh(CORNERS[:, :2], SIDES), lmdbench.UsageError, r"vertices: has shape \(8, 2\)"),
                 (lambda: lmdbench.Mesh(CORNERS, SIDES.astype(float), name="peg"), lmdbench.UsageError, "peg: triangles: .*whole numbers"),
                 (lambda: lmdbench.Mesh(CORNERS, SIDES + 1), lmdbench.InputError, "triangle 2: names vertex 8 of 8"),
                 (lambda: lmdbench.Mesh(CORNERS, SIDES - 1), lmdbench.InputError, "names vertex -1"),
                 (lambda: lmdbench.Mesh(CORNERS, SIDES.astype(np.int64) + 2**32), lmdbench.InputError, "names vertex 4294967296"),
                 (lambda: lmdbench.Mesh(CORNERS * np.nan, SIDES), lmdbench.InputError, "vertex 0: .*not finite"),
                 (lambda: lmdbench.Mesh(CORNERS, SIDES[:0]), lmdbench.InputError, "holds no triangle"),
                 (lambda: lmdbench.Mesh(CORNERS), lmdbench.UsageError, "without triangles"),
                 (lambda: lmdbench.Mesh([[0, 0, 0], [1, 0]], SIDES), lmdbench.UsageError, "mesh: vertices: no array"),
                 (lambda: lmdbench.Mesh(CORNERS, SIDES, planar_tolerance="much"), lmdbench.UsageError, "planar_tolerance"),
                 (lambda: lmdbench.query(7, box, np.eye(4), 0.1), lmdbench.UsageError, "int is no mesh"),
                 (lambda: lmdbench.query(box, box, np.eye(3), 0.1), lmdbench.UsageError, r"poses: has shape \(3, 3\)"),
                 (lambda: lmdbench.query(box, box, np.eye(4) * 2, 0.1), lmdbench.InputError, "pose 0: ends in another row"),
                 (lambda: lmdbench.query(box, box, np.stack([np.eye(4), mirrored]), 0.1), lmdbench.InputError, "pose 1: .*no rotation"),
                 (lambda: lmdbench.query(box, box, np.full((4, 4), np.inf), 0.1), lmdbench.InputError, "not finite"),
                 (lambda: lmdbench.query(box, box, np.stack([np.eye(4), at(1e19)]), 0.1), lmdbench.InputError, "pose 1: is farther than"),
                 (lambda: lmdbench.query(box, box, np.eye(4), float("nan")), lmdbench.UsageError, "cutoff"),
                 (lambda: lmdbench.query(box, [], np.eye(4), 0.1), lmdbench.UsageError, "fixed: names no mesh"),
                 (lambda: lmdbench.query(box, box, np.eye(4), 0.1, method=""), lmdbench.UsageError, "method"))
        for attempt, kind, text in cases:
            with self.subTest(text=text), self.assertRaisesRegex(kind, text):
                attempt()

    def test_tum_files(self):
        path = self.write("path.tum", "0 1 2 3 0 0 0.6 0.8\n0.5 0 0 0 0 0 0 1\n")
        times, poses = lmdbench.read_tum(path)
        self.assertEqual(times.tolist(), [0.0, 0.5])
        np.testing.assert_allclose(poses[0], [[0.28, -0.96, 0, 1], [0.96, 0.28, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]], atol=1e-15)
        np.testing.assert_array_equal(poses[1], np.eye(4))
        # Quaternions that were matrices on their way are those poses; 1e-9 rad is another one.
        box, turns = lmdbench.Mesh(CORNERS, SIDES), poses_near(20)[0]
        path = self.write("turns.tum", "".join("%d 0 0 3 %r %r %r %r\n" % (i, *map(float, turn)) for i, turn in enumerate(turns)))
        poses = lmdbench.read_tum(path)[1].copy()
        lmdbench.agreement(lmdbench.truth(box, box, path, 0.1), lmdbench.query(box, box, poses, 0.1))
        poses[7, :3, :3] = poses[7, :3, :3] @ matrices(np.array([[0.0, 0.0, 5e-10, 1.0]]), np.zeros((1, 3)))[0, :3, :3]
        with self.assertRaisesRegex(lmdbench.UsageError, "different poses"):
            lmdbench.agreement(lmdbench.truth(box, box, path, 0.1), lmdbench.query(box, box, poses, 0.1))

    def test_names_of_files_may_hold_any_bytes(self):
        odd = os.fsdecode(os.fsencode(self.write_off("box.off", CORNERS, SIDES)).replace(b"box", b"b\xffx"))
        os.rename(os.path.join(self.folder, "box.off"), odd)
        self.assertEqual(lmdbench.Mesh(odd).vertices.shape, (8, 3))


class ForcesAndTruth(unittest.TestCase):
    def test_forces_follow_the_laws(self):
        sets = lmdbench.query((CORNERS, SIDES), (CORNERS, SIDES), np.stack([at(1.02), at(1.5), at(1.005)]), 0.05)
        pushes = lmdbench.forces(sets, 0.05, 3.0, law="linear", saturation_distance=0.01)
        np.testing.assert_allclose(pushes.force, [[0, 0, 3 * 0.03 / 0.04], [0, 0, 0], [0, 0, 3]], atol=1e-12)
        np.testing.assert_allclose(pushes.stiffness, [3 / 0.04, 0, 0], atol=1e-9)
        centre = sets[0]["point_moving"][0]
        np.testing.assert_allclose(lmdbench.forces(sets, 0.05, 3.0, reference=centre).torque[0], 0, atol=1e-12)
        soft = lmdbench.forces(sets, 0.05, 3.0, sharpness=2.0)
        np.testing.assert_allclose(soft.force[0, 2], 3 * np.expm1(2 * 0.6) / np.expm1(2), rtol=1e-9)
        for wrong in ({"law": "cubic"}, {"saturation_distance": 0.06}, {"reference": np.zeros((2, 3))}, {"reference": [np.nan] * 3}):
            with self.assertRaises(lmdbench.UsageError):
                lmdbench.forces(sets, 0.05, 3.0, **wrong)
        with self.assertRaisesRegex(lmdbench.UsageError, "above that of the search"):
            lmdbench.forces(sets, 0.06, 3.0)

    def test_truth_and_agreement(self):
        mesh = lmdbench.Mesh(*torus())
        poses = matrices(*poses_near(20))
        true_sets = lmdbench.truth(mesh, mesh, poses, 0.2)
        exact = lmdbench.agreement(true_sets, lmdbench.query(mesh, mesh, poses, 0.2))
        self.assertEqual((exact.recall, exact.precision), (1.0, 1.0))
        self.assertEqual(exact.true_lmds.tolist(), true_sets.counts.tolist())
        near = lmdbench.query(mesh, mesh, poses, 0.2, "nearest")
        some = lmdbench.agreement(true_sets, near)
        self.assertLess(some.recall, 1.0)
        self.assertGreaterEqual(lmdbench.agreement(true_sets, near, neighbouring=True).recall, some.recall)
        with self.assertRaisesRegex(lmdbench.UsageError, "20 poses against 1"):
            lmdbench.agreement(true_sets, lmdbench.query(mesh, mesh, poses[0], 0.2))
        with self.assertRaisesRegex(lmdbench.UsageError, "different meshes"):
            lmdbench.agreement(true_sets, lmdbench.query((CORNERS, SIDES), mesh, poses, 0.2))
        with self.assertRaisesRegex(lmdbench.UsageError, "different poses"):
            lmdbench.agreement(true_sets, lmdbench.query(mesh, mesh, poses[::-1], 0.2))
        with self.assertRaisesRegex(lmdbench.UsageError, "of cutoffs 0.2 and 0.1"):
            lmdbench.agreement(true_sets, lmdbench.query(mesh, mesh, poses, 0.1))
        # As many triangles, but other vertices: the features of one are none of the other's.
        box, loose = lmdbench.Mesh(CORNERS, SIDES), lmdbench.Mesh(CORNERS[SIDES].reshape(-1, 3), np.arange(SIDES.size).reshape(-1, 3))
        with self.assertRaisesRegex(lmdbench.UsageError, "different meshes"):
            lmdbench.agreement(lmdbench.truth(box, box, at(1.02), 0.05), lmdbench.truth(loose, box, at(1.02), 0.05), neighbouring=True)


class Interpreter(unittest.TestCase):
    def test_other_threads_run_and_share_a_search(self):
        search = lmdbench.Search(torus(), torus(), 0.2)
        poses = matrices(*poses_near(3000))
        wanted = search(poses)
        results, steps, done = [], [0], threading.Event()

        def count():
            while not done.is_set():
                steps[0] += 1
                time.sleep(0)

        workers = [threading.Thread(target=lambda: results.append(search(poses))) for _ in range(3)]
        counter = threading.Thread(target=count)
        for thread in (counter, *workers):
            thread.start()
        before = steps[0]
        search(poses)
        during = steps[0] - before
        for worker in workers:
            worker.join()
        done.set()
        counter.join()
        self.assertGreater(during, 10)  # a few if the lock were held
        for sets in results:
            for mine, theirs in zip(sets, wanted):
                self.assertEqual(mine["distance"].tolist(), theirs["distance"].tolist())

    def test_interrupts_end_a_call(self):
        search = lmdbench.Search(torus(), torus(), 0.2)
        poses = np.broadcast_to(matrices(*poses_near(1)), (2_000_000, 4, 4))
        timer = threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            search(poses)
        timer.join()

    def test_everything_public_says_what_it_is(self):
        for name in lmdbench.__all__:
            thing = getattr(lmdbench, name)
            if name not in ("LMD_DTYPE", "__version__"):
                self.assertTrue(thing.__doc__ and len(thing.__doc__) > 20, name)


class Memory(unittest.TestCase):
    def test_a_million_sets_leave_nothing_behind(self):
        search = lmdbench.Search((CORNERS, SIDES), (CORNERS, SIDES), 0.05)
        poses = np.stack([at(1.0 + 0.0001 * k) for k in range(1, 1001)])
        refused = np.eye(4) * 2

        def resident():
            return int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1]) * resource.getpagesize()

        def hundred_thousand():
            for _ in range(100):
                sets = search(poses)
                self.assertEqual(sets[0].size + sets[-1].size, 1)
                lmdbench.forces(sets, 0.05, 1.0)
                with self.assertRaises(lmdbench.InputError):
                    search(refused)

        hundred_thousand()
        before = resident()
        for _ in range(10):
            hundred_thousand()
        grown = resident() - before
        print(f"resident memory after 1e6 sets: {grown / 1e6:+.2f} MB", file=sys.stderr)
        self.assertLess(grown, 4e6)  # 4 bytes a set


class Results(Files):
    def test_frames_of_a_run(self):
        done = self.program("-q", "run", os.path.join(ROOT, "experiments", "shapes.json"), "--out", "shapes.h5", "--set", "/frames=60",
                            "--set", "/record/lmds=true", "--set", "/force/cutoff_diagonal=0.3", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        result = lmdbench.open_result(self.path("shapes.h5"))
        self.assertEqual(result.methods, ["original", "improved"])
        frames = result.frames("improved")
        self.assertEqual(len(frames), 60)
        self.assertEqual(frames.attrs["units"]["force_z"], "N")
        h5 = result.result.h5["/methods/improved"]
        np.testing.assert_array_equal(frames[["force_x", "force_y", "force_z"]], h5["force"])
        np.testing.assert_array_equal(frames["lmd_count"], h5["lmd_count"])
        self.assertTrue(any(name.startswith("counters/") for name in frames))
        self.assertEqual(list(result.searches("improved")["global_frame"]), [0, 20, 40])
        self.assertEqual(result.times("improved").shape[0], 60)
        lmds = result.lmds("improved")
        self.assertEqual(set(lmds.attrs["units"]), set(lmds.columns))
        np.testing.assert_array_equal(lmds.groupby("frame").size().reindex(range(60), fill_value=0), h5["lmd_count"])
        np.testing.assert_array_equal(result.truth("improved")["recall"], h5["truth/recall"])
        told = {method["label"]: method for method in json.loads(done.stdout)["methods"]}
        summary = result.summary()
        self.assertEqual(summary.index.tolist(), ["original", "improved"])
        for name in ("lmd_count_median", "candidates_median", "recall", "force_error_rms_n"):
            self.assertEqual(summary.loc["improved", name], told["improved"][name])
        self.assertEqual(summary.attrs["units"]["force_error_rms_n"], "N")
        self.assertTrue(result.movers("improved").empty)
        with self.assertRaisesRegex(lmdbench.InputError, "has no method 'best'"):
            result.frames("best")
        with self.assertRaisesRegex(lmdbench.InputError, "is no sweep"):
            lmdbench.open_sweep(self.path("shapes.h5"))

    def test_movers_of_a_run(self):
        done = self.program("-q", "run", os.path.join(ROOT, "experiments", "movers.json"), "--out", "movers.h5", "--set", "/frames=20",
                            "--set", "/driver/repetitions=1", "--set", "/probes/fcl/stride_frames=0", "--set", "/probes/truth/stride_frames=0")
        self.assertEqual(done.returncode, 0, done.stderr)
        result = lmdbench.open_result(self.path("movers.h5"))
        movers = result.movers("certified")
        self.assertEqual(len(movers), 20 * 26)
        h5 = result.result.h5
        row = movers[(movers["frame"] == 7) & (movers["mover"] == 3)].iloc[0]
        np.testing.assert_array_equal(row[["force_x", "force_y", "force_z"]], h5["/methods/certified/movers/force"][7, 3])
        np.testing.assert_array_equal(row[["position_x", "position_y", "position_z"]], h5["/path/movers/position"][7, 3])
        self.assertEqual(row["lmd_count"], h5["/methods/certified/movers/lmd_count"][7, 3])
        self.assertEqual(movers.attrs["units"]["torque_y"], "N m")
        self.assertIn("moving_body", result.lmds("certified"))

    def test_movers_of_a_closed_loop_stand_where_the_method_left_them(self):
        done = self.program("-q", "run", os.path.join(ROOT, "experiments", "movers.json"), "--out", "loop.h5", "--set", "/frames=5",
                            "--set", '/loop={"kind": "closed"}', "--set", "/driver/repetitions=1", "--set", "/probes/fcl/stride_frames=0",
                            "--set", "/probes/truth/stride_frames=0")
        self.assertEqual(done.returncode, 0, done.stderr)
        result = lmdbench.open_result(self.path("loop.h5"))
        movers, h5 = result.movers("certified"), result.result.h5
        own = movers[movers["mover"] == 0]
        np.testing.assert_array_equal(own[["position_x", "position_y", "position_z"]], h5["/methods/certified/path/position"])
        np.testing.assert_array_equal(own[[f"orientation_{axis}" for axis in "xyzw"]], h5["/methods/certified/path/orientation"])
        self.assertFalse(np.array_equal(h5["/methods/certified/path/position"], h5["/path/movers/position"][:, 0]))
        other = movers[movers["mover"] == 3]
        np.testing.assert_array_equal(other[["position_x", "position_y", "position_z"]], h5["/path/movers/position"][:, 3])

    def test_files_of_every_format_version(self):
        for version in (1, 2):
            result = lmdbench.open_result(os.path.join(ROOT, "tests", "result_file", "formats", f"format-{version}.h5"))
            self.assertEqual(result.methods, ["original", "improved"])
            self.assertEqual(len(result.frames("improved")), 20)
            if version == 1:
                with self.assertRaisesRegex(lmdbench.InputError, "format 1 did not hold it"):
                    result.summary()
            else:
                self.assertEqual(len(result.summary()), 2)

    def test_other_files_are_refused(self):
        for file in (self.write("text.h5", "text"), self.path("gone.h5")):
            for read in (lmdbench.open_result, lmdbench.open_sweep):
                with self.assertRaisesRegex(lmdbench.InputError, "remedy"):
                    read(file)


class Examples(unittest.TestCase):
    def test_they_run(self):
        environment = {**os.environ, "PYTHONPATH": MODULE, "LMDBENCH_PROGRAM": PROGRAM,
                       "LMDBENCH_EXPERIMENT": os.path.join(ROOT, "experiments", "shapes.json")}
        done = call(sys.executable, ROOT / "src" / "lmdbench" / "python" / "examples.py", env=environment, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("certified: recall 1.00, precision 1.00", done.stdout)
        self.assertIn('did you mean "certified"', done.stdout)


class Types(Scratch):
    def test_stubs_match_the_module(self):
        options = {"cwd": self.folder, "env": {**os.environ, "PYTHONPATH": MODULE, "MYPYPATH": MODULE}, "timeout": 600}
        # pybind11's classes have a metaclass and an initialiser of its own.
        self.write("allowed", "lmdbench._lmdbench.(Mesh|Poses|Search|Sets)(.__init__)?\n")
        done = call(sys.executable, "-m", "mypy.stubtest", "lmdbench._lmdbench", "--ignore-missing-stub", "--allowlist", "allowed", **options)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.write("user.py", "import lmdbench\nimport numpy as np\nsets = lmdbench.query('a', 'b', np.eye(4), 0.1)\n"
                   "distance: np.ndarray = sets[0]['distance']\ncount: int = lmdbench.Mesh('a').vertices\n")
        done = call(sys.executable, "-m", "mypy", "user.py", **options)
        self.assertIn("user.py:5", done.stdout + done.stderr)
        self.assertNotIn("user.py:3", done.stdout)
        self.assertNotIn("user.py:4", done.stdout)


def load_tests(_loader, tests, _pattern):
    """Without names on the command line: all but Memory, which takes longest."""
    return unittest.TestSuite(suite for suite in tests if not any(isinstance(test, Memory) for test in suite))


if __name__ == "__main__":
    unittest.main()
