# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Every use of the program with every kind of scene: nine small scenes, nineteen uses. What is refused (exit code 2) stands in
the table of experiments/README.md, which this makes; it fails where the table says otherwise, and where a use neither works nor is
refused.

    scene_uses_test.py PROGRAM SOURCE [--write]
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

BEGIN, END = "<!-- scene_uses_test.py: begin -->\n", "<!-- scene_uses_test.py: end -->\n"

SLAB = {"mesh": "slab"}
BALL = {"mesh": "ball", "diagonal_m": 0.02}
BREATHES = {"generator": "breathe", "amplitude": 0.001, "period_s": 0.01}
STANDS = {"instances": {"rule": "list", "file": "places.txt"}}
SWAYS = {"mesh": "ball", "diagonal_m": 0.02, "pose": {"translation_m": [0.03, 0, 0.115]},
         "path": {"way_diagonals": 0.1, "period_s": 0.05}}
DEFORMING = {"deformation": BREATHES}

KINDS = {
    "pair": {},
    "several fixed": {"fixed": [{"mesh": "plate", "diagonal_m": 0.1}, SLAB]},
    "instances": {"fixed": [SLAB | STANDS]},
    "movers": {"movers": [SWAYS]},
    "moving deforms": {"moving": BALL | DEFORMING},
    "fixed deforms": {"fixed": [SLAB | DEFORMING]},
    "instances, movers": {"fixed": [SLAB | STANDS], "movers": [SWAYS]},
    "movers, deforming": {"moving": BALL | DEFORMING, "movers": [SWAYS | DEFORMING]},
    "instances, deforming": {"fixed": [SLAB | STANDS | DEFORMING]},
}

CLOSED = ["/loop/kind=closed"]
PREDICTED = ['/methods=[{"name":"improved"}]', "/driver/prediction=linear", "/driver/search_every_frames=2",
             "/driver/search_latency_frames=2"]
CLOCK = ["/driver/kind=realtime", "/driver/realtime/floor_s=0.005", "/driver/realtime/lock_memory=false"]
TRACKED = ['/methods=[{"name":"improved"}]']

# Arguments of the program for each use; OUT is a folder of the use, SCENE the experiment.
USES = {
    "open loop": ("run SCENE --out OUT/result.h5", ["/record/lmds=true"]),
    "closed loop": ("run SCENE --out OUT/result.h5", CLOSED),
    "predicted searches": ("run SCENE --out OUT/result.h5", PREDICTED),
    "on the clock": ("run SCENE --out OUT/result.h5", CLOCK),
    "on the clock, with tracking": ("run SCENE --out OUT/result.h5", CLOCK + TRACKED),
    "`shared`": ("run SCENE --out OUT/result.h5", ["/force/aggregation=shared"]),
    "`signed`": ("run SCENE --out OUT/result.h5", ["/force/aggregation=signed"]),
    "`layered`": ("run SCENE --out OUT/result.h5", ["/force/aggregation=layered"]),
    "`shared` in a closed loop": ("run SCENE --out OUT/result.h5", CLOSED + ["/force/aggregation=shared"]),
    "`shared` on the clock": ("run SCENE --out OUT/result.h5", CLOCK + ["/force/aggregation=shared"]),
    "`plan`": ("plan SCENE", []),
    "`report`": ("report OPEN --out OUT/page", []),
    "3D view": ("", []),
    "`export`": ("export OPEN --out OUT/vtk", []),
    "`anatomy`": ("anatomy SCENE", []),
    "`record`": ("record SCENE --out OUT/path.tum", CLOSED),
    "polylines": ("run SCENE --out OUT/result.h5", ["/record/polylines/stride_frames=1"]),
    "`stability`": ("stability SCENE", ["/loop/kind=closed"]),
    "`work-precision`": ("work-precision OUT/sweep.json --out OUT/sweep.h5", []),
}


def write_scenes(folder, source):
    places = ["0 0 0 0 0 0 1", "3 0 0 0 0 0 1"]
    (folder / "places.txt").write_text("\n".join(places) + "\n")
    at = "0 0 0.12575350269 0 0 0 1"  # at rest on the slab, 0.02 mm within the cutoff
    (folder / "path.tum").write_text(f"0 {at}\n0.007 {at}\n")
    scene = {
        "mesh_folder": str(source / "meshes"), "moving": BALL, "fixed": [SLAB], "path": {"file": "path.tum"},
        "force": {"cutoff_m": 0.02, "saturation_m": 0, "maximum_force_n": 10}, "device": "ideal",
        "methods": [{"name": "certified", "force_law": "linear"}], "driver": {"repetitions": 1},
        "loop": {"mass_kg": 0.04, "damping_n_s_per_m": 0.8, "friction_n": 0, "resolution_m": 0, "delay_frames": 0,
                 "hand": None, "push_n": [0, 0, -0.001]},
        "probes": {"truth": {"stride_frames": 2}, "fcl": {"stride_frames": 2}}}
    for number, keys in enumerate(KINDS.values()):
        (folder / f"{number}.json").write_text(json.dumps(scene | {"name": f"kind-{number}"} | keys))


def call(program, use, number, folder):
    """Exit code and output of a use with a kind of scene; of a page and its view in one."""
    command, changes = USES[use]
    out = folder / f"{number}-{list(USES).index(use)}"
    out.mkdir(exist_ok=True)
    (out / "sweep.json").write_text(json.dumps(
        {"name": "sweep", "experiments": [f"../{number}.json"], "from_frame": 1, "repetitions": 1,
         "series": [{"method": {"name": "certified"}}, {"method": {"name": "improved"}, "axes": [
             {"/driver/search_every_frames": [1, 2], "/driver/search_latency_frames": [1, 2]}]}]}))
    opened = folder / f"{number}-0" / "result.h5"
    if "OPEN" in command and not opened.exists():
        return 2, "there is no result"
    words = [word.replace("SCENE", str(folder / f"{number}.json")).replace("OPEN", str(opened)).replace("OUT", str(out))
             for word in command.split()]
    for change in changes:
        words += ["--set", change]
    done = subprocess.run([program] + words, capture_output=True, text=True, check=False)
    if use == "`work-precision`" and "failed" in done.stdout:  # points, which others need not share
        return 2, done.stdout
    return done.returncode, done.stderr


def table_of(refused):
    kinds = list(KINDS)
    lines = ["| | " + " | ".join(kinds) + " |", "|---" * (len(kinds) + 1) + "|"]
    for use in USES:
        lines.append(f"| {use} | " + " | ".join("-" if (kind, use) in refused else "+" for kind in kinds) + " |")
    return f"\n{len(refused)} of {len(KINDS) * len(USES)} are refused (-):\n\n" + "\n".join(lines) + "\n\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("--write", action="store_true", help="write the table")
    arguments = parser.parse_args()
    readme = arguments.source / "experiments/README.md"
    refused, broken = {}, []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_scenes(folder, arguments.source)
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            # The open loop runs first: pages and exports need its results.
            for uses in (["open loop"], [use for use in USES if use not in ("open loop", "3D view")]):
                cases = [(kind, use) for use in uses for kind in KINDS]
                done = pool.map(lambda case: call(arguments.program, case[1], list(KINDS).index(case[0]), folder), cases)
                for case, (code, said) in zip(cases, done):
                    if code == 2:
                        refused[case] = said
                        if case[1] == "`report`":
                            refused[(case[0], "3D view")] = said
                    elif code != 0:
                        broken.append(f"{case}: exit code {code}: {said}")
                    elif "gets no 3D view" in said:
                        refused[(case[0], "3D view")] = said.splitlines()[-2]
    for (kind, use), said in refused.items():
        print(f"{use} / {kind}: {said.strip().splitlines()[-1]}")
    table = table_of(refused)
    text = readme.read_text()
    found = re.search(re.escape(BEGIN) + ".*?" + re.escape(END), text, re.DOTALL)
    if broken or not found:
        sys.exit("\n".join(broken) or f"{readme} has no place for the table")
    if arguments.write:
        readme.write_text(text.replace(found.group(), BEGIN + table + END))
    elif found.group() != BEGIN + table + END:
        sys.exit(f"{readme} has another table; --write writes this one:\n{table}")


if __name__ == "__main__":
    main()
