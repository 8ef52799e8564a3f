#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""What `lmdbench export` writes (argument 1 is the program), read as VTK's readers do: every array has the length that its
grid gives it, every index a point, every cell its end; and the numbers are those of the result."""

import json
import os
import pathlib
import shutil
import sys
import unittest
import xml.etree.ElementTree as ET

import h5py
import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts", "figures", "tests"))

from cases import ROOT, SCRIPTS, Scratch, call, text_of  # noqa: E402  (the figures' tests must be found first)
from mesh_drawing import rotation  # noqa: E402

TYPES = {"Float32": np.float32, "Float64": np.float64, "Int32": np.int32, "UInt8": np.uint8}
POINTS_OF_A_CELL = {1: 1, 5: 3}  # of a polyline (4) any number
PROGRAM = None


def array(element):
    components = int(element.get("NumberOfComponents"))
    assert element.get("format") == "ascii"
    values = np.array((element.text or "").split(), dtype=TYPES[element.get("type")])
    return values.reshape(-1, components) if components > 1 else values


class Grid:
    def __init__(self, file):
        root = ET.parse(file).getroot()
        assert root.tag == "VTKFile" and root.get("type") == "UnstructuredGrid" and root.get("byte_order") == "LittleEndian"
        (piece,) = root.findall("UnstructuredGrid/Piece")
        points, cells = int(piece.get("NumberOfPoints")), int(piece.get("NumberOfCells"))
        self.points = array(piece.find("Points/DataArray")).reshape(-1, 3)
        named = {element.get("Name"): array(element) for element in piece.findall("Cells/DataArray")}
        self.corners, self.ends, self.types = named["connectivity"], named["offsets"], named["types"]
        assert len(self.points) == points and np.isfinite(self.points).all()
        assert len(self.ends) == cells and len(self.types) == cells and len(self.corners) == (self.ends[-1] if cells else 0)
        assert not cells or (0 <= self.corners.min() and self.corners.max() < points)
        sizes = np.diff(np.concatenate([[0], self.ends]))
        assert all(size == POINTS_OF_A_CELL.get(kind, size) and size > 0 for size, kind in zip(sizes, self.types))
        self.point_data, self.cell_data = ({element.get("Name"): array(element) for element in piece.findall(f"{place}/DataArray")}
                                           for place in ("PointData", "CellData"))
        assert all(len(values) == points for values in self.point_data.values())
        assert all(len(values) == cells for values in self.cell_data.values())


def collection(file):
    """[(time, grid)]"""
    root = ET.parse(file).getroot()
    assert root.tag == "VTKFile" and root.get("type") == "Collection"
    return [(float(entry.get("timestep")), Grid(os.path.join(os.path.dirname(file), entry.get("file")))) for entry in root.findall("Collection/DataSet")]


class ExportTest(Scratch):
    def call(self, *words, code=0):
        done = call(PROGRAM, "-q", *words, cwd=ROOT)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stdout

    def run_and_export(self, name, *settings):
        result, out = self.path(f"{name}.h5"), self.path(name)
        self.call("run", "experiments/shapes.json", "--out", result, "--set", "/frames=400", *[word for setting in settings for word in ("--set", setting)])
        return result, out, self.call("export", result, "--out", out, "--frames", "8").split()

    def test_open_loop(self):
        result, out, told = self.run_and_export("open", "/record/lmds=true", "/record/polylines={\"stride_frames\": 100}")
        self.assertEqual(sorted(os.path.basename(file) for file in told),
                         ["fixed_0.vtu", "forces.pvd", "lmds-exact.pvd", "lmds-improved.pvd", "lmds-original.pvd", "moving.pvd", "polylines.pvd"])
        for file in told:
            self.assertTrue(os.path.exists(file))
        moving = collection(os.path.join(out, "moving.pvd"))
        with h5py.File(result) as h5:
            stride = 400 // 8
            np.testing.assert_allclose([time for time, _ in moving], h5["path/time"][::stride])
            forces = collection(os.path.join(out, "forces.pvd"))
            np.testing.assert_array_equal([grid.point_data["force of improved [N]"][0] for _, grid in forces], h5["methods/improved/force"][::stride])
            offset = h5["methods/improved/lmds/frame_offset"][:]
            own = collection(os.path.join(out, "lmds-improved.pvd"))
            self.assertGreater(sum(len(grid.ends) for _, grid in own), 0)
            for (_, grid), frame in zip(own, range(0, 400, stride)):
                rows = slice(offset[frame], offset[frame + 1])
                np.testing.assert_array_equal(grid.points[0::2], h5["methods/improved/lmds/point_moving"][rows])
                np.testing.assert_array_equal(grid.points[1::2], h5["methods/improved/lmds/point_fixed"][rows])
                np.testing.assert_array_equal(grid.cell_data["distance [m]"], h5["methods/improved/lmds/distance"][rows])
                np.testing.assert_array_equal(grid.cell_data["feature of moving (0 vertex, 1 edge, 2 face)"],
                                              h5["methods/improved/lmds/feature_moving_kind"][rows])
            # In every frame the exported mesh has the pose of the path.
            first, turn = (rotation(*h5["path/orientation"][frame]) for frame in (0, stride))
            own_frame = (moving[0][1].points - h5["path/position"][0]) @ first
            np.testing.assert_allclose(moving[1][1].points, own_frame @ turn.T + h5["path/position"][stride], atol=1e-7)
            fixed = Grid(os.path.join(out, "fixed_0.vtu"))
            self.assertEqual(len(fixed.ends), h5["scene/fixed_0"].attrs["triangles"])
            lines = collection(os.path.join(out, "polylines.pvd"))
            np.testing.assert_allclose([time for time, _ in lines], h5["path/time"][::100])
        exact = collection(os.path.join(out, "lmds-exact.pvd"))
        self.assertGreater(sum(len(grid.ends) for _, grid in exact), 0)
        for _, grid in exact:
            np.testing.assert_allclose(np.linalg.norm(grid.points[1::2] - grid.points[0::2], axis=1), grid.cell_data["distance [m]"], atol=1e-12)
        self.call("export", result, "--out", out, "--frames", "2")
        for name in ("polylines", "moving"):
            self.assertEqual(len(collection(os.path.join(out, f"{name}.pvd"))), 2)
            self.assertEqual(len(os.listdir(os.path.join(out, name))), 2, "none is left of the earlier export")

    def test_closed_loop_has_a_mesh_a_device(self):
        result, out, told = self.run_and_export("closed", "/loop={\"kind\": \"closed\"}")
        names = {os.path.basename(file) for file in told}
        self.assertLessEqual({"moving-improved.pvd", "moving-original.pvd", "forces-original.pvd", "lmds-exact-improved.pvd"}, names)
        with h5py.File(result) as h5:
            moved = {label: collection(os.path.join(out, f"moving-{label}.pvd")) for label in ("original", "improved")}
            self.assertEqual(len(moved["original"]), 4, "frames are shared by the devices")
            shift = moved["original"][-1][1].points - moved["improved"][-1][1].points
            expected = h5["methods/original/path/position"][300] - h5["methods/improved/path/position"][300]
            np.testing.assert_allclose(shift, np.tile(expected, (len(shift), 1)), atol=1e-7)

    def test_replaces_its_own_files_and_no_others(self):
        result, out, _ = self.run_and_export("again")
        self.call("export", result, "--out", out, "--frames", "2")
        mine = pathlib.Path(out, "fixed_0.vtu")
        mine.write_text("mine")
        self.call("export", result, "--out", out, code=2)
        self.assertEqual(mine.read_text(), "mine")

    def test_datasets_of_another_size_are_told(self):
        """Edited results, whose hash is taken out: each dataset that is read, a row short, a row long, empty, with wild numbers and with none."""
        result, _, _ = self.run_and_export("sizes", "/record/lmds=true")
        inside = self.path("inside.h5")
        self.call("run", "experiments/extreme/start-inside.json", "--out", inside, "--set", "/frames=20",
                  "--set", "/record/polylines={\"stride_frames\": 5}")
        lists = ["distance", "point_moving", "point_fixed", "feature_moving_kind", "feature_fixed_kind", "frame_offset"]
        names = ["path/position", "path/orientation", "methods/improved/force", "provenance/experiment", "provenance/inputs/file",
                 "provenance/inputs/sha256", *[f"methods/improved/lmds/{name}" for name in lists],
                 *[f"polylines/{name}" for name in ("frame_offset", "point_offset", "closed", "point")]]
        changes = [(name, change) for name in names for change in (lambda values: values[:-1], lambda values: values[:0],
                                                                   lambda values: np.append(values, values[-1:], axis=0))]
        changes += [(name, lambda values: -values) for name in ("methods/improved/lmds/frame_offset", "polylines/point_offset")]
        changes += [(name, lambda values: values + 10**12) for name in ("methods/improved/lmds/frame_offset", "polylines/frame")]
        changes += [(name, lambda values: np.append([-5], values[1:])) for name in ("polylines/frame_offset", "polylines/point_offset")]
        changes += [("polylines/frame_offset", lambda values: np.concatenate([values[:1], values[1:2] + 10**9, values[2:]])),
                    ("polylines/frame", lambda values: -1 - values),
                    *[(name, lambda values: values * np.nan) for name in ("methods/improved/force", "methods/improved/lmds/distance", "polylines/point")],
                    ("path/time path/position path/orientation", lambda values: values[:0])]
        for name, change in changes:
            with self.subTest(dataset=name):
                edited = shutil.copy(inside if name.startswith("polylines") else result, self.path("edited.h5"))
                with h5py.File(edited, "r+") as h5:
                    del h5.attrs["content_sha256"]
                    for dataset in name.split():
                        attributes, values = dict(h5[dataset].attrs), change(np.atleast_1d(h5[dataset][()]))
                        kind = h5[dataset].dtype
                        del h5[dataset]
                        h5.create_dataset(dataset, data=values, dtype=kind).attrs.update(attributes)
                done = call(PROGRAM, "-q", "export", edited, "--out", self.path("vtk"), "--frames", "8", cwd=ROOT)
                self.assertEqual(done.returncode, 3, f"{name}: {done.stderr}")
                self.assertRegex(done.stderr, rf"edited\.h5: /{name.split()[0].split('/')[0]}.*remedy: ")
        self.assertIn("holds no frame", done.stderr)

    def own_run(self):
        """A result of a project's folder, run there under relative names: mesh, manifest and path are files of the project."""
        project = pathlib.Path(self.folder, "project")
        shapes = json.loads(text_of("experiments", "shapes.json"))
        shapes["moving"]["mesh"] = "../parts/part.off"
        self.write("project/experiments/own.json", json.dumps(shapes))
        self.write("project/paths/shapes.tum", text_of("paths", "shapes.tum"))
        self.write("project/meshes/manifest.json", text_of("meshes", "manifest.json"))
        self.write("project/parts/part.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n")
        (project / "out").mkdir()
        done = call(PROGRAM, "-q", "run", "experiments/own.json", "--out", "out/own.h5", "--set", "/frames=40", cwd=project)
        self.assertEqual(done.returncode, 0, done.stderr)
        return project

    def export_from(self, folder, result):
        return call(PROGRAM, "-q", "export", result, "--out", self.path("vtk"), "--frames", "2", cwd=folder)

    def test_a_result_knows_from_any_folder_where_its_meshes_are(self):
        project = self.own_run()
        with h5py.File(project / "out" / "own.h5") as h5:
            self.assertEqual(h5["provenance"].attrs["run_folder"], "..")
        elsewhere = pathlib.Path(self.folder, "elsewhere")
        elsewhere.mkdir()
        moved = project.rename(self.path("moved"))
        result = moved / "out" / "own.h5"
        done = self.export_from(elsewhere, result)
        self.assertEqual(done.returncode, 0, done.stderr)
        # A mesh of that name in the working folder is ignored; the result's own folder counts.
        self.write("elsewhere/parts/part.off", "OFF\n")
        self.assertEqual(self.export_from(elsewhere, result).returncode, 0)
        part = moved / "parts" / "part.off"
        part.rename(result.with_name("part.off"))
        self.assertEqual(self.export_from(elsewhere, result).returncode, 0)

    def test_a_mesh_that_is_gone_is_told_with_the_places(self):
        project = self.own_run()
        result, part = project / "out" / "own.h5", project / "parts" / "part.off"
        part.write_text(part.read_text() + "\n")
        done = self.export_from("/", result)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("parts/part.off: has changed since the run", done.stderr)
        part.unlink()
        done = self.export_from("/", result)
        self.assertEqual(done.returncode, 3, done.stderr)
        for text in ("part.off: ", f"seen from /, {result.parent}, {project}", "remedy: put it beside the result file"):
            self.assertIn(text, done.stderr)
        # The page is made without the mesh, and says so.
        done = call(PROGRAM, "report", result, "--out", self.path("page"), cwd="/", env={**os.environ, "LMDBENCH_SCRIPTS": str(SCRIPTS)})
        self.assertEqual(done.returncode, 0, done.stderr)
        (line,) = [line for line in done.stderr.splitlines() if "no 3D view" in line]
        for text in ("own.h5", "part.off", f"seen from /, {result.parent}, {project}", "remedy: "):
            self.assertIn(text, line)


if __name__ == "__main__":
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
