# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Ten pairs of parts as users have them, from files to the page with the commands of the front page alone: float STL, OBJ, PLY and OFF in millimetres
and metres, meshes of the manifest, parts that are inside out, whose triangles disagree, with holes, that intersect themselves. Each pair: `init`, `run`,
`init --contact`, `stability`, `run` pressed by a hand as `init` says, `report`. Prints what came of them and how long it took, as Markdown.
Exit code 1 where a command ends otherwise than it may (--lenient: never), a complete set is not complete, or the pressed part leaves its contact.

    own_parts.py PROGRAM [--pairs NAME...] [--keep FOLDER] [--limit SECONDS] [--lenient]
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np

from init_pairs_test import box, grid_sphere, scan, write_obj, write_off, write_ply, write_stl

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
sys.path.insert(0, os.path.join(ROOT, "scripts", "figures"))

from mesh_drawing import read_off  # noqa: E402  (the figures' folder must be found first)
from what_is_an_lmd import caps  # noqa: E402

MESHES = os.path.join(ROOT, "meshes")


def scaled(mesh, factor):
    return mesh[0] * factor, mesh[1]


def inside_out(mesh):
    return mesh[0], mesh[1][:, ::-1]


def circle(radius, count):
    angle = 2 * np.pi * np.arange(count) / count
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])


def ring(outer, inner, height):
    """Between two outlines of as many points."""
    n = len(outer)
    points = [(x, y, z) for z in (0.0, height) for outline in (outer, inner) for x, y in outline]
    triangles = []
    for k in range(n):
        j = (k + 1) % n
        quads = ((k, j, 2 * n + j, 2 * n + k), (n + j, n + k, 3 * n + k, 3 * n + j), (2 * n + k, 2 * n + j, 3 * n + j, 3 * n + k), (n + k, n + j, j, k))
        triangles += [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    return np.array(points), np.array(triangles)


def slotted_plate(slots, width, gap, length, base, height):
    """Teeth on a plate. Its ends are turned the other way than its sides, as some exporters leave them."""
    outline = [(0.0, 0.0), (slots * (width + gap) + width, 0.0)]
    for k in reversed(range(slots + 1)):
        left = k * (width + gap)
        outline += [(left + width, height), (left, height)]
        outline += [(left, base), (left - gap, base)] if k else []
    n, profile = len(outline), np.array(outline)
    points = np.vstack([np.column_stack([profile[:, 0], np.full(n, y), profile[:, 1]]) for y in (0.0, length)])
    triangles = [t for k in range(n) for t in ((k, n + k, n + (k + 1) % n), (k, n + (k + 1) % n, (k + 1) % n))]
    return points, np.array(triangles + end_caps(profile))


def end_caps(profile):
    n, ears = len(profile), caps(profile)
    return [(c, b, a) for a, b, c in ears] + [(n + a, n + b, n + c) for a, b, c in ears]


def pairs(program, folder):
    """(name, what makes the moving part's file, the fixed one's, words of init, what they are)."""

    def file(name, write, mesh):
        def make():
            write(os.path.join(folder, name), mesh())
            return name
        return make

    def build(name):
        """A mesh of the manifest."""
        subprocess.run([program, "-q", "mesh", "build", name], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
        return name

    def built(name, factor):
        return scaled(read_off(os.path.join(MESHES, f"{build(name)}.off")), factor)

    def ring_mm():
        return ring(circle(20, 48), circle(12, 48), 6.0)

    def table_mm():
        return box((120.0, 80.0, 18.0))

    return [
        ("box-table", file("box.stl", write_stl, lambda: box((20.0, 14.0, 9.0))), file("table.stl", write_stl, table_mm), [], "float STL, mm"),
        ("ring-table", file("ring-m.stl", write_stl, lambda: scaled(ring_mm(), 1e-3)), file("table-m.stl", write_stl, lambda: scaled(table_mm(), 1e-3)), [],
         "float STL, m"),
        ("ring-slots", file("ring.stl", write_stl, ring_mm), file("slots.stl", write_stl, lambda: slotted_plate(4, 6.0, 5.0, 60.0, 5.0, 12.0)), [],
         "float STL, mm; ends of the slotted plate turned inward"),
        ("peg-hole", lambda: build("peg-round"), lambda: build("hole-round"), [], "by name, m"),
        ("bolt-nut", file("bolt.off", write_off, lambda: built("bolt", 10)), file("nut.stl", write_stl, lambda: inside_out(built("nut", 10))),
         ["--unit", "mm"], "OFF and float STL, mm; nut inside out"),
        ("gears", lambda: build("gear-20"), lambda: build("gear-30"), [], "by name, m"),
        ("bunny-fandisk", file("bunny.stl", write_stl, lambda: inside_out(built("bunny-1k", 100))), file("fandisk.obj", write_obj, lambda: built("fandisk", 20)),
         [], "float STL, inside out, and OBJ, mm"),
        ("scan-block", file("scan.ply", write_ply, lambda: scan(0.08)), file("block.off", write_off, lambda: box((0.1, 0.08, 0.06))), [],
         "PLY of a scan with holes and noise, m"),
        ("egg-camel", file("egg.stl", write_stl, lambda: inside_out(grid_sphere(30, 40, lambda x, y, z: 0.05 + 0.01 * z))), lambda: build("camel"), [],
         "float STL, inside out, and by name (it intersects itself), m"),
        ("elephant-slab", lambda: build("elephant-with-holes"), lambda: build("slab"), [], "by name (1,353 edges of holes), m"),
    ]


class Journey:
    """One pair's commands, one after another."""

    def __init__(self, program, folder, limit):
        self.program, self.folder, self.limit, self.wrong = program, folder, limit, []
        self.seconds = {}

    def call(self, step, words, allowed=(0,)):
        """Standard output; what else went wrong is remembered."""
        began = time.monotonic()
        try:
            done = subprocess.run([self.program, *words], cwd=self.folder, capture_output=True, text=True, timeout=self.limit, check=False,
                                  stdin=subprocess.DEVNULL)
            code, out, err = done.returncode, done.stdout, done.stderr
        except subprocess.TimeoutExpired:
            code, out, err = None, "", f"no end in {self.limit:g} s"
        self.seconds[step] = time.monotonic() - began
        if code not in allowed:
            self.wrong.append(f"{step}: {err.strip().splitlines()[-1] if err.strip() else code}")
        return code, out

    def at(self, *names):
        return os.path.join(self.folder, *names)


def value(words, key):
    found = re.search(rf"^  {re.escape(key)} +(.*)$", words, re.MULTILINE)
    return found.group(1) if found else ""


def open_loop(journey, name, moving, fixed, words):
    code, said = journey.call("init", ["init", moving, fixed, "--out", name, "--dir", MESHES, *words])
    if code != 0:
        return {}
    shown = {"unit": value(said, "/moving/scale").split(" ")[0], "turned": [key for key in ("moving", "fixed") if value(said, f"/{key}{'/0' * (key == 'fixed')}/orient")]}
    code, _ = journey.call("run", ["run", said.splitlines()[0], "--out", f"{name}/open.h5", "--set", "/driver/repetitions=2"])
    if code != 0:
        return shown
    with h5py.File(journey.at(name, "open.h5"), "r") as file:
        recall = {method: float(file[f"/methods/{method}/summary/recall"][0]) for method in file["/methods"]}
        shown |= {"contact": float(file["/scene/in_contact"][()].mean()), "lmds": float(file["/methods/certified/summary/lmd_count_median"][0]), "recall": recall}
    if recall["certified"] != 1.0:
        journey.wrong.append(f"certified has {100 * recall['certified']:.3g} % of the LMDs")
    return shown


def closed_loop(journey, name, moving, fixed, words):
    code, said = journey.call("init --contact", ["init", moving, fixed, "--contact", "--out", name, "--dir", MESHES, *words])
    if code != 0:
        return {}
    experiment, press = said.splitlines()[0], re.search(r"--set '([^']+)'", said).group(1)
    shown = {"at rest": re.search(r"at rest with (\d+) LMD", said).group(1)}
    code, table = journey.call("stability", ["stability", experiment], allowed=(0, 3))
    if code in (0, 3):
        cells = table.splitlines()[2].split()
        shown["stiffness"] = f"{float(cells[6]):,.0f} ({cells[-1]})" if code == 0 else cells[-1]
    code, _ = journey.call("run pressed", ["run", experiment, "--set", press, "--out", f"{name}/contact.h5", "--set", "/driver/repetitions=2"])
    if code == 0:
        with h5py.File(journey.at(name, "contact.h5"), "r") as file:
            counts = file["/methods/certified/lmd_count"][()]
        shown["held"] = float(np.mean(counts > 0))
        if shown["held"] < 1.0:
            journey.wrong.append(f"pressed, but in contact in {100 * shown['held']:.3g} % of the frames")
    return shown


def percent(share):
    return "-" if share is None else f"{100 * share:.3g}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--pairs", nargs="+", help="of these names alone")
    parser.add_argument("--keep", help="folder that keeps files, results and pages")
    parser.add_argument("--limit", type=float, default=300.0, help="seconds of a command (300)")
    parser.add_argument("--lenient", action="store_true", help="what went wrong is told in the table alone")
    arguments = parser.parse_args()
    program, failed = os.path.abspath(arguments.program), 0
    print("| pair | files | scale, turned | frames in contact [%] | LMDs, median | recall [%]: original, improved, certified, nearest | at rest: LMDs "
          "| largest clean stiffness [N/m] (ends by) | pressed: in contact [%] | seconds: init, run, init --contact, stability, run pressed, report | went wrong |")
    print("|" + "---|" * 11)
    with tempfile.TemporaryDirectory() as scratch:
        folder = arguments.keep or scratch
        os.makedirs(folder, exist_ok=True)
        for name, moving, fixed, words, what in pairs(program, folder):
            if arguments.pairs and name not in arguments.pairs:
                continue
            moving, fixed = moving(), fixed()
            journey = Journey(program, folder, arguments.limit)
            shown = open_loop(journey, name, moving, fixed, words) | closed_loop(journey, name, moving, fixed, words)
            results = [f"{name}/{file}" for file in ("open.h5", "contact.h5") if os.path.exists(journey.at(name, file))]
            if results:
                journey.call("report", ["report", *results, "--out", f"{name}/page"])
            recall = shown.get("recall", {})
            steps = ("init", "run", "init --contact", "stability", "run pressed", "report")
            print(f"| {name} | {what} | {shown.get('unit', '-')}{''.join(', ' + part for part in shown.get('turned', []))} | {percent(shown.get('contact'))} "
                  f"| {shown.get('lmds', np.nan):g} | {', '.join(percent(recall.get(method)) for method in ('original', 'improved', 'certified', 'nearest'))} "
                  f"| {shown.get('at rest', '-')} | {shown.get('stiffness', '-')} | {percent(shown.get('held'))} "
                  f"| {', '.join(f'{journey.seconds[step]:.0f}' if step in journey.seconds else '-' for step in steps)} | {'; '.join(journey.wrong)} |", flush=True)
            failed += bool(journey.wrong)
    return 1 if failed and not arguments.lenient else 0


if __name__ == "__main__":
    sys.exit(main())
