#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Why the summed force jumps: every birth and death of an LMD in every method's sets, attributed to an event.

Needs result files of an open loop with LMD lists (--set /record/lmds=true) whose methods include the reference, 'certified',
whose set is complete in every frame. Between two frames no point of the moving mesh travels farther than `travel`, so no distance
changes by more:
- cutoff: the reference, too, gains or loses the pair here, within `travel` of the cutoff: no force worth a jump;
- hand-over: in the same frame one pair dies and one is born whose distances differ by no more than `travel`, a few
  travels apart: the minimum slid on to a neighbouring feature, and the force should not notice;
- fold: the reference gains or loses the pair in the middle of its range: a minimum met a saddle. No method can avoid it
  while forces are summed;
- age: the pair comes or goes in this method while the reference had it already or lost it before: the set is late;
- loss: the method drops a pair that the reference keeps;
- false: the pair comes or goes, and the reference never had it."""

import argparse
import collections

import interpreter  # noqa: F401  (chooses one that has what follows)

import numpy as np

from lmdbench_results import Result, ResultError, law, run_script
from mesh_drawing import rotation
from tables import table_text

REFERENCE = "certified"
JUMP_SHARE = 0.25  # of F_max, as in the summary of a run
HAND_OVER_TRAVELS = 50  # in travels of the mesh: the most that a minimum slides in a frame
KINDS = ("cutoff", "hand-over", "fold", "age", "loss", "false")

Pair = collections.namedtuple("Pair", "distance force point")


def turned(vector, orientation):
    """(N, 3) of a vector by (N, 4) unit quaternions, w last."""
    return np.einsum("ijn,j->ni", rotation(*orientation.T), vector)


def travel(position, orientation, radius):
    """Farthest way of a point of the mesh from each frame to the next [m]: of its centre, plus the turn's arc."""
    cosine = np.clip(np.abs(np.sum(orientation[1:] * orientation[:-1], axis=1)), 0, 1)
    return np.linalg.norm(np.diff(position, axis=0), axis=1) + 2 * np.arccos(cosine) * radius


def hand_overs(births, deaths, step):
    """[(dead key, born key)] of pairs that are one minimum which slid on; each key at most once, nearest first."""
    near = []
    for dead, old in deaths.items():
        for born, new in births.items():
            way = np.linalg.norm(new.point - old.point)
            if abs(new.distance - old.distance) <= step and way <= HAND_OVER_TRAVELS * step:
                near.append((way, dead, born))
    matched = []
    for _, dead, born in sorted(near):
        if all(dead != d and born != b for d, b in matched):
            matched.append((dead, born))
    return matched


def events(before, after, true_before, true_after, step, cutoff, known):
    """[(kind, jump)] between two frames of a method; the sets are {key: Pair}, jump is the change of force [N]; known are the
    keys that the reference had in any frame so far."""
    births = {key: pair for key, pair in after.items() if key not in before}
    deaths = {key: pair for key, pair in before.items() if key not in after}
    found = []
    for dead, born in hand_overs(births, deaths, step):
        found.append(("hand-over", float(np.linalg.norm(births.pop(born).force - deaths.pop(dead).force))))
    for key, pair in [*births.items(), *deaths.items()]:
        is_birth, was_true, is_true = key in births, key in true_before, key in true_after
        if is_birth != is_true:
            kind = "false" if is_birth else "loss"
        elif was_true == is_true:
            kind = "age" if key in known else "false"  # the reference got or lost it in an earlier frame, or never had it
        else:
            kind = "cutoff" if cutoff - pair.distance <= step else "fold"
        found.append((kind, float(np.linalg.norm(pair.force))))
    return found


def sets_of(method, frames, scene):
    """[{key: Pair}] of a method, one a frame."""
    if not method.has("lmds"):
        raise ResultError(f"{method.result.file}: /methods/{method.label}: holds no LMD lists (remedy: run with --set /record/lmds=true)")
    lmds = {name: dataset[:] for name, dataset in method.result.h5[f"/methods/{method.label}/lmds"].items()}
    keys = zip(lmds["fixed_body"], lmds["feature_moving_kind"], lmds["feature_moving_index"],
               lmds["feature_fixed_kind"], lmds["feature_fixed_index"])
    pushes = -law(lmds["distance"], *scene, method.force_law)[:, None] * lmds["direction"]
    pairs = [(key, Pair(*pair)) for key, *pair in zip(keys, lmds["distance"], pushes, lmds["point_fixed"])]
    offset = lmds["frame_offset"]
    return [dict(pairs[offset[f]:offset[f + 1]]) for f in range(frames)]


def refuse_others(run):
    """How far a pair travels is known where one rigid mesh follows one path, and its force under one profile."""
    laws = list(dict.fromkeys(method.aggregation for method in run.methods.values() if method.aggregation != "sum"))
    profiles = list(dict.fromkeys(method.profile for method in run.methods.values() if method.profile))
    for what, there in (("movers", run.has("/path/movers/position")),
                        ("a mesh that deforms", any("deformation" in mesh.attrs for mesh in run.h5["/scene"].values())),
                        (f"several force profiles ({', '.join(profiles)})", profiles),
                        (f"forces that are no plain sum ({', '.join(laws)})", laws),
                        ("a closed loop", any(method.has("path/position") for method in run.methods.values()))):
        if there:
            raise ResultError(f"{run.file}: has {what}, whose jumps are not attributed here (remedy: an open loop in which one rigid mesh moves, "
                              "under one force profile, each method with the sum of its LMDs' forces)")


def attribute(file):
    """({label: {kind: jumps [N]}}, F_max, seconds) of one result file; a jump is NaN where triangles intersect, which have no direction."""
    run = Result(file)
    refuse_others(run)
    reference = next((label for label, method in run.methods.items() if method.name == REFERENCE), None)  # a label may be another method's name
    if reference is None:
        raise ResultError(f"{file}: /methods/{REFERENCE}: is missing beside {', '.join(run.methods)} (remedy: add the method to the experiment)")
    scene = tuple(run.scene(name) for name in ("cutoff_m", "saturation_m", "maximum_force_n", "sharpness"))
    time = run.time
    orientation = run.read("/path/orientation")
    # Results before 1.0 do not tell the centre: the frame's origin then.
    centre = run.read("/scene/torque_reference") if run.has("/scene/torque_reference") else np.zeros(3)
    steps = travel(run.read("/path/position") + turned(centre, orientation), orientation, 0.5 * float(run.h5["/scene/moving"].attrs["diagonal_m"]))
    sets = {label: sets_of(run.methods[label], time.size, scene) for label in sorted(run.methods)}
    true = sets[reference]
    result = {}
    for label, own in sets.items():
        jumps = collections.defaultdict(list)
        known = set()
        for f in range(time.size - 1):
            known.update(true[f])
            for kind, jump in events(own[f], own[f + 1], true[f], true[f + 1], steps[f], scene[0], known):
                jumps[kind].append(jump)
        result[label] = jumps
    return result, scene[2], time[-1] - time[0]


def table(result, maximum, seconds):
    rows = []
    for label, jumps in result.items():
        cells = []
        for kind in KINDS:
            values = np.array(jumps[kind]) / maximum
            known = values[~np.isnan(values)]
            large = known[known > JUMP_SHARE]
            told = f"{known.size}, {large.size / seconds:.2f}/s, {known.max():.2f}" if known.size else "none"
            cells.append(told + (f"; {values.size - known.size} without direction" if known.size < values.size else ""))
        rows.append([label, *cells])
    return table_text(["method", *KINDS], rows)


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", nargs="+", metavar="RESULT.h5")
    for file in parser.parse_args(argv).results:
        result, maximum, seconds = attribute(file)
        print(f"{file}: events, of these jumps above {JUMP_SHARE:.0%} of F_max a second, largest jump in F_max; of triangles that intersect, "
              "which have no direction, how many alone\n")
        print(table(result, maximum, seconds) + "\n")
    return 0


if __name__ == "__main__":
    raise SystemExit(run_script(main))
