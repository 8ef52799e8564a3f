# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Two mesh files are enough, whatever their formats: `lmdbench init` on five pairs (STL in millimetres, OBJ, PLY, OFF, a scan
with holes and noise and a box), and each experiment that it writes runs, grazes, and neither penetrates nor misses: it is in
contact for a part of the time, some frame comes well within the cutoff, no frame touches, and FCL finds the meshes apart
wherever it looks.

    init_pairs_test.py PROGRAM [--table]
"""

import argparse
import os
import struct
import subprocess
import sys
import tempfile

import h5py
import numpy as np


def grid_sphere(rings, sectors, radius):
    """A closed surface around the origin: vertices by direction, radius(x, y, z) of the unit vector."""
    points, triangles = [], []
    for i in range(rings + 1):
        for j in range(sectors):
            polar, turn = np.pi * i / rings, 2 * np.pi * j / sectors
            unit = np.array([np.sin(polar) * np.cos(turn), np.sin(polar) * np.sin(turn), np.cos(polar)])
            if 0 < i < rings or j == 0:
                points.append(unit * radius(*unit))

    def index(i, j):
        return 0 if i == 0 else len(points) - 1 if i == rings else 1 + (i - 1) * sectors + j % sectors
    for i in range(rings):
        for j in range(sectors):
            corners = [index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)]
            if i < rings - 1:
                triangles.append(corners[:3])
            if i > 0:
                triangles.append([corners[0], corners[2], corners[3]])
    return np.array(points), np.array(triangles)


def box(sides):
    points = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)]) * sides
    quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
    return points, np.array([t for a, b, c, d in quads for t in ([a, b, c], [a, c, d])])


def bumpy(size):
    return grid_sphere(24, 36, lambda x, y, z: size * (1 + 0.25 * np.sin(5 * x) * np.sin(4 * y + 1) * np.cos(3 * z)))


def scan(size):
    """What a scanner leaves: noise on every vertex, and holes."""
    noise = np.random.default_rng(7)
    points, triangles = grid_sphere(40, 60, lambda x, y, z: size * (1 + 0.3 * x * y + 0.1 * z + 0.004 * noise.normal()))
    return points, np.array([t for k, t in enumerate(triangles) if k % 97 and not 300 < k < 330])


def write_off(name, mesh):
    points, triangles = mesh
    with open(name, "w", encoding="ascii") as stream:
        stream.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        stream.writelines(f"{x} {y} {z}\n" for x, y, z in points)
        stream.writelines(f"3 {a} {b} {c}\n" for a, b, c in triangles)


def write_obj(name, mesh):
    points, triangles = mesh
    with open(name, "w", encoding="ascii") as stream:
        stream.write("mtllib lost.mtl\no part\n")
        stream.writelines(f"v {x} {y} {z}\n" for x, y, z in points)
        stream.writelines(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in triangles)


def write_ply(name, mesh):
    points, triangles = mesh
    with open(name, "wb") as stream:
        stream.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\n"
                     f"property float z\nelement face {len(triangles)}\nproperty list uchar int vertex_indices\n"
                     "end_header\n".encode())
        stream.write(points.astype("<f4").tobytes())
        for corners in triangles:
            stream.write(struct.pack("<Biii", 3, *corners))


def write_stl(name, mesh):
    points, triangles = mesh
    with open(name, "wb") as stream:
        stream.write(b"millimetres".ljust(80) + struct.pack("<I", len(triangles)))
        for corners in triangles:
            stream.write(struct.pack("<12fH", 0, 0, 0, *points[corners].ravel(), 0))


def call(command, folder):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=250)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(command)}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def judge(result):
    """What a run of a written experiment shows; names of what is wrong with it."""
    with h5py.File(result, "r") as file:
        contact = file["/scene/in_contact"][()].astype(bool)
        cutoff = float(file["/scene"].attrs["cutoff_m"])
        truth = file["/reference/minimum_distance"][()]
        fcl = file["/crosscheck/fcl"]
        shown = {"contact": contact.mean(), "nearest": np.nanmin(file["/methods/certified/minimum_distance"][()]) / cutoff,
                 "touching": int(file["/methods/certified/summary/frames_touching"][0]),
                 "separated": f"{int(fcl['separated'][()].sum())} of {len(fcl['separated'])}",
                 "recall": float(file["/methods/certified/summary/recall"][0])}
        wrong = []
        if not 0.3 < shown["contact"] < 0.98:
            wrong.append("it misses, or never leaves")
        if not 0.0 < shown["nearest"] < 0.5:
            wrong.append("it does not graze")
        if shown["touching"] or np.nanmin(truth) <= 0 or not fcl["separated"][()].all():
            wrong.append("it penetrates")
        if shown["recall"] != 1.0:
            wrong.append("certified is not complete")
    return shown, wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--table", action="store_true", help="print what each pair shows, as Markdown")
    arguments = parser.parse_args()
    program, failed = os.path.abspath(arguments.program), 0
    with tempfile.TemporaryDirectory() as folder:
        def at(name):
            return os.path.join(folder, name)
        write_stl(at("peg.stl"), box((20.0, 12.0, 50.0)))
        write_stl(at("knob.stl"), bumpy(30.0))
        write_obj(at("knob.obj"), bumpy(0.03))
        write_ply(at("egg.ply"), grid_sphere(30, 40, lambda x, y, z: 0.05 + 0.01 * z))
        write_off(at("block.off"), box((0.1, 0.08, 0.06)))
        write_ply(at("scan.ply"), scan(0.08))
        pairs = [("peg.stl", "knob.stl"), ("knob.obj", "egg.ply"), ("egg.ply", "block.off"), ("block.off", "knob.obj"),
                 ("scan.ply", "block.off")]
        if arguments.table:
            print("| moving | fixed | frames in contact | nearest, in cutoffs | frames touching | FCL finds apart | recall |")
            print("|---|---|---|---|---|---|---|")
        for number, (moving, fixed) in enumerate(pairs):
            out = f"pair-{number}"
            call([program, "init", moving, fixed, "--out", out, "-q"], folder)
            experiment = [name for name in os.listdir(at(out)) if name.endswith(".json") and ".path." not in name][0]
            call([program, "run", os.path.join(out, experiment), "--out", f"{out}.h5", "-q", "--set", "/driver/repetitions=1"],
                 folder)
            shown, wrong = judge(at(f"{out}.h5"))
            if arguments.table:
                print(f"| {moving} | {fixed} | {100 * shown['contact']:.1f} % | {shown['nearest']:.3f} | {shown['touching']} "
                      f"| {shown['separated']} | {shown['recall']:g} |")
            for what in wrong:
                failed += 1
                print(f"{moving} past {fixed}: {what}: {shown}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    raise SystemExit(main())
