#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The field's other answers beside ours: error against run time, and how far the force still steps when a path is subdivided.

Runs of each scene, in the same program, without a device's clipping: certified and improved along the whole path; all methods at poses
evenly spread over its frames in contact; all methods along a few frames about the largest step of the plain sum, ten- and hundredfold
subdivided, after a rest at the first of them; and certified under `shared` along all of these, which is the continuous force. The plain sum of certified's complete set is the
other truth. A force that is a rival's own has a scale of its own: it gets the one factor a scene and truth that brings it nearest to
the truth. Last, `lmdbench stability` taps each method at rest in four closed loops, and finds the largest stiffness at which it does not
shake. Tables go to rivals.md, the figure to rivals.png in --out.

    cmake -S experiments/rivals -B build/rivals && cmake --build build/rivals
    scripts/figures/rivals.py --out results/rivals"""

import argparse
import json
import os

import interpreter  # noqa: F401  (chooses one that has what follows)

import numpy as np

import figure_style as style
from lmdbench_results import Result, ResultError, run_script
from program import PROGRAM, printed, settings_words
from tables import shown, table, write_text

import matplotlib.pyplot as plt

SCENES = {
    "bunny-hard": "experiments/bunny-hard.json",
    "bunny-soft": "experiments/bunny-soft.json",
    "box on a slab": "experiments/extreme/box-on-table.json",
    "peg in a slot": "experiments/peg-in-slot.json",
    "gears": "experiments/extreme/gears.json",
    "rod in a bore": "experiments/extreme/peg-round.json",
}
CLOSED_LOOPS = ("box", "wedge", "peg", "bunny")
# Label, entry of the experiment, colour and mark.
RIVALS = (
    ("vertices", {"name": "vertices"}, style.ORANGE, "v"),
    ("manifold", {"name": "manifold"}, style.SKY, "P"),
    ("manifold-all", {"name": "manifold", "points": "all"}, style.SKY, "X"),
    ("barrier", {"name": "barrier"}, style.GREEN, "s"),
    ("barrier-plain", {"name": "barrier", "maximum": "plain"}, style.GREEN, "^"),
    ("barrier-each", {"name": "barrier", "weights": "each"}, style.GREEN, "D"),
    ("gcp", {"name": "gcp"}, style.PURPLE, "^"),
    ("points", {"name": "points"}, style.BLUE, "o"),
    ("points-coarse", {"name": "points", "spacing_cutoffs": 1.0, "voxel_cutoffs": 0.5}, style.BLUE, "X"),
    ("proxy", {"name": "proxy"}, style.GREY, "*"),
)
OURS = (("certified", {"name": "certified"}, style.BLACK, "o"), ("improved", {"name": "improved"}, style.VERMILLION, "s"))
HOLLOW = ("manifold-all", "barrier-plain", "barrier-each", "points-coarse")
SHARED = "certified, shared"
SUBDIVISIONS = (1, 10, 100)
REST = 40  # frames before a stretch, in no step: two periods of the scenes' searches, since improved has no set before its first search is back
TRUTH_FRAMES = 10
LEAST_STEP = 1e-5  # of F_max; smaller errors are drawn here


def entries(methods):
    return [{**entry, "label": label, "force_law": "exponential"} for label, entry, *_ in methods]


def plugin_words(arguments, methods):
    names = {entry["name"] for entry in methods}
    return [word for name in sorted({entry["name"] for _, entry, *_ in RIVALS} & names)
            for word in ("--plugin", os.path.join(arguments.plugins, f"{name}.so"))]


def scaled_error(forces, truth):
    """RMS length of the difference under the factor that makes it least, and the factor."""
    power = np.sum(forces * forces)
    factor = max(np.sum(forces * truth) / power, 0.0) if power > 0 else 0.0
    return rms(factor * forces - truth), factor


def rms(vectors):
    return float(np.sqrt(np.mean(np.sum(vectors * vectors, axis=1))))


def largest_steps(forces):
    """By subdivision, of forces along a path that is subdivided by the finest, after its rest."""
    forces, finest = forces[REST:], SUBDIVISIONS[-1]
    return [float(np.max(np.linalg.norm(np.diff(forces[:: finest // times], axis=0), axis=1))) for times in SUBDIVISIONS]


def subdivided(position, orientation, times):
    """Straight in position, even in turn, after a rest at the first pose."""
    places, turns = [position[0]] * REST, [orientation[0]] * REST
    for i in range(len(position) - 1):
        a, b = orientation[i], orientation[i + 1] * (1.0 if orientation[i] @ orientation[i + 1] >= 0 else -1.0)
        angle = np.arccos(np.clip(a @ b, -1.0, 1.0))
        for share in np.arange(times) / times:
            weights = (1.0 - share, share) if angle < 1e-9 else np.sin([(1.0 - share) * angle, share * angle]) / np.sin(angle)
            turns.append((weights[0] * a + weights[1] * b) / np.linalg.norm(weights[0] * a + weights[1] * b))
            places.append((1.0 - share) * position[i] + share * position[i + 1])
    return np.array([*places, position[-1]]), np.array([*turns, orientation[-1]])


class Scene:
    """The runs of an experiment, made where they are not there yet."""

    def __init__(self, arguments, name):
        self.arguments, self.name, self.file = arguments, name, SCENES[name]
        self.slug = name.replace(" ", "-")
        ours, rivals = entries(OURS), entries(RIVALS)
        both = self.run("path", ours, "sum", repetitions=3), self.run("path", ours[:1], "shared", repetitions=3)
        self.path, self.path_shared = both
        self.maximum = self.path.maximum_force()
        gap = self.path.method("certified").read("minimum_distance")
        pose = [self.path.read(f"/path/{part}") for part in ("position", "orientation")]
        touched = np.flatnonzero(self.path.in_contact() & (gap > 0))
        if touched.size < 8:
            raise ResultError(f"{self.file}: is hardly ever in contact (remedy: choose another scene)")
        self.frames = touched[np.linspace(0, touched.size - 1, min(arguments.poses, touched.size)).astype(int)]
        poses = self.write_path("poses", pose[0][self.frames], pose[1][self.frames])
        self.poses, self.poses_shared = (self.run("poses", methods, law, poses, truth=max(len(self.frames) // TRUTH_FRAMES, 1))
                                         for methods, law in ((ours[:1] + rivals, "sum"), (ours[:1], "shared")))
        steps = np.linalg.norm(np.diff(self.path.method("certified").read("force"), axis=0), axis=1)
        steps[~(gap[1:] > 0)] = 0.0
        first = int(np.clip(np.argmax(steps) - arguments.stretch // 2, 0, len(gap) - arguments.stretch - 1))
        stretch = slice(first, first + arguments.stretch + 1)
        fine = self.write_path("steps", *subdivided(pose[0][stretch], pose[1][stretch], SUBDIVISIONS[-1]))
        self.steps = self.run("steps", ours + rivals, "sum", fine)
        self.steps_shared = self.run("steps", ours[:1], "shared", fine)

    def write_path(self, name, position, orientation):
        rate = self.path.scene("frame_rate_hz")
        lines = [" ".join(repr(float(x)) for x in (i / rate, *p, *q)) for i, (p, q) in enumerate(zip(position, orientation))]
        return os.path.abspath(write_text("\n".join(lines) + "\n", self.arguments.out, f"{self.slug}-{name}.tum"))

    def run(self, what, methods, law, path=None, repetitions=1, truth=0):
        out = os.path.join(self.arguments.out, f"{self.slug}-{what}-{law}.h5")
        if not os.path.exists(out):
            settings = {"/methods": methods, "/device": "ideal", "/force/aggregation": law, "/driver/repetitions": repetitions,
                        "/driver/block_frames": 50, "/probes": {"truth": {"stride_frames": truth}, "fcl": {"stride_frames": 0}}}
            if path is not None:
                settings.update({"/path": {"file": path, "interpolation": "linear"}})
            printed([self.arguments.program, "run", self.file, "--out", out, *plugin_words(self.arguments, methods),
                     "--limit", "plugin-seconds=300", *settings_words(settings)], allowed=(0, 1))
        return Result(out)

    def rows(self):
        """label: what the tables and the figure say of it, forces in F_max."""
        shared = self.poses_shared.method("certified")
        sum_here, shared_here = self.poses.method("certified").read("force"), shared.read("force")
        rows = {SHARED: {"promise": shared.promise, **self.at_poses(shared), "path ms": self.time(self.path_shared.method("certified")), "shared": 0.0,
                         "sum": rms(shared_here - sum_here) / self.maximum, "steps": self.scaled_steps(self.steps_shared.method("certified"), 1.0)}}
        on_path = {law: run.method("certified").read("force")[self.frames]
                   for law, run in (("sum", self.path), ("shared", self.path_shared))}
        for label, *_ in OURS:
            method = self.path.method(label)
            force = method.read("force")[self.frames]
            rows[label] = {"promise": method.promise, **self.at_poses(self.poses.methods.get(label)), "path ms": self.time(method),
                           "steps": self.scaled_steps(self.steps.method(label), 1.0),
                           **{law: rms(force - truth) / self.maximum for law, truth in on_path.items()}}
        for label, *_ in RIVALS:
            method = self.poses.method(label)
            force, own = method.read("force"), self.has_own_force(label)
            errors = {}
            for law, truth in (("shared", shared_here), ("sum", sum_here)):
                errors[law], factor = scaled_error(force, truth) if own else (rms(force - truth), 1.0)
                errors[f"{law} factor"] = factor
            rows[label] = {"promise": method.promise, "own": own, **self.at_poses(method), "path ms": np.nan,
                           "shared": errors["shared"] / self.maximum, "sum": errors["sum"] / self.maximum,
                           "steps": self.scaled_steps(self.steps.method(label), errors["shared factor"])}
        return rows

    def at_poses(self, method):
        """Time and set at the unrelated poses; no numbers of a method that was not there, such as improved, which has no old set to track."""
        set_is_judged = method is not None and method.promise != "force-only"
        return {"ms": np.nan if method is None else self.time(method),
                **{name: method.number(name) if set_is_judged else np.nan for name in ("recall", "precision")}}

    def has_own_force(self, label):
        entry = next(entry for entry in self.poses.experiment["methods"] if entry["label"] == label)
        return bool(entry.get("own_force", False))

    @staticmethod
    def time(method):
        return 1e3 * method.number("frame_time_median_s")

    def scaled_steps(self, method, factor):
        """No numbers where no factor above 0 brings the force nearer to the truth."""
        return [(factor or np.nan) * step / self.maximum for step in largest_steps(method.read("force"))]


def closed_loops(arguments):
    """{label: {scene: critical over exact stiffness, or why there is none}}, of the hard profile."""
    found = {}
    for scene in CLOSED_LOOPS:
        for law, methods in (("shared", entries(OURS[:1])), ("sum", entries(OURS + RIVALS))):
            out = os.path.join(arguments.out, f"stability-{scene}-{law}.json")
            if not os.path.exists(out):
                file = f"experiments/stability/{scene}.json"
                with open(file, encoding="utf-8") as stream:
                    hard = json.load(stream)["force"][0]
                write_text(printed([arguments.program, "stability", file, "--json", "--seconds", str(arguments.stability_seconds),
                                    *plugin_words(arguments, methods),
                                    *settings_words({"/methods": methods, "/force": {**hard, "aggregation": law}})], allowed=(0, 3)),
                           arguments.out, os.path.basename(out))
            with open(out, encoding="utf-8") as stream:
                for row in json.load(stream):
                    label = SHARED if law == "shared" else row["method"]
                    critical = row["critical_stiffness_n_per_m"]
                    has_answer = critical is not None and row["clean_until"] != "undecided"
                    found.setdefault(label, {})[scene] = (f"{critical / row['exact_n_per_m']:.4f}" if has_answer
                                                          else row["clean_until"].replace("_", " "))
    return found


def tables(all_rows, loops):
    lines = []
    for name, rows in all_rows.items():
        lines += [f"## {name}", ""]
        lines += table(("method", "promise", "ms a pose (along the path)", "from `shared`", "from the sum", "recall", "precision"),
                       [(label + (" (own force)" if row.get("own") else ""), row["promise"],
                         shown(row["ms"]) + ("" if np.isnan(row["path ms"]) else f" ({shown(row['path ms'])})"),
                         *(shown(row[name]) for name in ("shared", "sum", "recall", "precision"))) for label, row in rows.items()])
    lines += ["## Largest step, by subdivision of a stretch: 1, 10, 100", ""]
    labels = list(next(iter(all_rows.values())))
    lines += table(("method", *all_rows), [(label, *(", ".join(shown(step, 2) for step in rows[label]["steps"])
                                                     for rows in all_rows.values())) for label in labels])
    lines += ["## Largest clean stiffness in a closed loop, over the exact boundary of one linear contact", ""]
    lines += table(("method", *CLOSED_LOOPS), [(label, *(loops[label][scene] for scene in CLOSED_LOOPS)) for label in labels])
    return "\n".join(lines)


def draw(all_rows, out):
    style.use_style()
    marks = {SHARED: (style.TRUTH, "o"), **{label: mark for label, _, *mark in OURS + RIVALS}}
    figure, axes = plt.subplots(2, len(all_rows), figsize=(style.TWO_COLUMNS_IN, 4.3), sharey="row", squeeze=False)
    errors = [row["shared"] for rows in all_rows.values() for row in rows.values() if row["shared"] > 0]
    floor = 10.0 ** np.floor(np.log10(min(errors)) - 0.3)
    for column, (name, rows) in enumerate(all_rows.items()):
        above, below = axes[:, column]
        for label, row in rows.items():
            colour, mark = marks[label]
            drawn = {"color": colour, "marker": mark, "markersize": 5.0, "markeredgewidth": 0.8, "label": label,
                     "markerfacecolor": "white" if row["promise"] == "force-only" or label in HOLLOW else colour}
            above.plot([row["ms"]], [max(row["shared"], floor)], linestyle="none", **drawn)
            below.plot(SUBDIVISIONS, np.maximum(row["steps"], LEAST_STEP), linewidth=0.9, **{**drawn, "markersize": 3.5})
        above.set(xscale="log", yscale="log", title=name)
        above.axhspan(floor / 1.6, floor * 1.6, color="#EEEEEE", zorder=0)
        above.set_ylim(floor / 1.6, 2.0 * max(errors))
        above.set_xlabel("ms a pose")
        below.set(xscale="log", yscale="log", xticks=SUBDIVISIONS, xlabel="subdivision")
        below.set_xticklabels([f"$\\times${times}" for times in SUBDIVISIONS])
        below.minorticks_off()
    axes[0, 0].set_ylabel("RMS distance from the\ncontinuous force / $F_{max}$")
    axes[1, 0].set_ylabel("largest step of force\n/ $F_{max}$")
    axes[0, 0].annotate("0", (0.03, 0.03), xycoords="axes fraction", fontsize=6.5)
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, ncol=7, loc="lower center", bbox_to_anchor=(0.5, 0.0))
    figure.tight_layout(rect=(0, 0.1, 1, 1), w_pad=0.4)
    return style.save(figure, out, "rivals")


def main(words=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=PROGRAM)
    parser.add_argument("--plugins", default="build/rivals", help="folder of the rivals' shared objects")
    parser.add_argument("--scenes", nargs="+", default=list(SCENES), choices=list(SCENES), metavar="SCENE")
    parser.add_argument("--poses", type=int, default=100, help="poses in contact that rivals are put to")
    parser.add_argument("--stretch", type=int, default=4, help="frames that are subdivided")
    parser.add_argument("--stability-seconds", type=float, default=300, help="a method's search in a closed loop ends after these")
    parser.add_argument("--out", default="results/rivals")
    arguments = parser.parse_args(words)
    all_rows = {name: Scene(arguments, name).rows() for name in arguments.scenes}
    loops = closed_loops(arguments)
    write_text(json.dumps({"scenes": all_rows, "closed_loops": loops}, indent=1), arguments.out, "rivals.json")
    print(write_text(tables(all_rows, loops), arguments.out, "rivals.md"))
    draw(all_rows, arguments.out)
    return 0


if __name__ == "__main__":
    raise SystemExit(run_script(main))
