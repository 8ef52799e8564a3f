# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Reads lmdbench result files (see results/README.md) for figures and tables.

Reported numbers (recall, force error, times, ...) are read from the summary that the program wrote, `Method.number` and
`Result.number`: they have one definition, and it is not here. Raw samples are for what figures draw and for measures that
have names of their own. Times are in seconds here; figures and tables show milliseconds.
"""

import hashlib
import json
import os
import sys
import traceback

import h5py
import numpy as np

if __package__:  # as part of the Python module
    from .intervals import Rate
else:
    from intervals import Rate

FORMAT = "lmdbench-result"
FORMAT_VERSION = 2
OLDEST_FORMAT_VERSION = 1  # see results/README.md, "Versions"
EXIT_CHECK_FAILED = 1
EXIT_USAGE = 2
EXIT_INPUT_DATA = 3
EXIT_ENVIRONMENT = 4


class ResultError(Exception):
    """A result file is missing, broken or lacks what is asked for; the message names file, place and remedy."""

    exit_code = EXIT_INPUT_DATA


class UsageError(ResultError):
    """What was asked for is wrong, or the experiment."""

    exit_code = EXIT_USAGE


class ForeignFileError(Exception):
    """An output would replace a file that is not lmdbench's."""


def refuse_foreign(file, kind, *marks):
    """Only an earlier output of ours is replaced: one of the marks (bytes) stands at its beginning."""
    if not os.path.exists(file) or os.path.getsize(file) == 0:
        return
    with open(file, "rb") as stream:
        start = stream.read(4096)
    if not any(mark in start for mark in marks):
        raise ForeignFileError(f"{file}: is no {kind} of lmdbench, which would replace it (remedy: choose another folder with --out)")


# Errors of reading a file that lacks required data, or has it in another shape or type.
DATA_ERRORS = (AttributeError, IndexError, KeyError, TypeError, ValueError)
OPENED = []  # results of this call, for messages


def text(value):
    """What HDF5 has as bytes or as text; all else as it is."""
    return value.decode() if isinstance(value, bytes) else value


def texts_of(attributes):
    return {name: text(value) for name, value in attributes.items()}


def check_content(file, h5):
    """Whether the file's bytes are those that were written (results/README.md); results of earlier versions do not tell."""
    digits = h5.attrs.get("content_sha256")
    if digits is None:
        return
    with open(file, "rb") as stream:
        content = stream.read()
    digits = bytes(digits)
    if content.count(digits) != 1 or hashlib.sha256(content.replace(digits, b"0" * len(digits))).hexdigest().encode() != digits:
        raise ResultError(f"{file}: attribute content_sha256: its bytes are not those that were written: damaged, or changed afterwards "
                          "(remedy: make the file again with lmdbench run; who changed it on purpose deletes the attribute)")


# Facts of methods that format 1 lacks: place, tracks locally, trackings after a search.
METHODS_OF_FORMAT_1 = {"original": (0, True, 0), "improved": (1, True, 2), "certified": (2, False, 0), "exhaustive": (3, False, 0)}


def open_h5(file):
    """The file, open for reading, once it is known to be a result of a format that is read here."""
    remedy = "(remedy: name a file that `lmdbench run` or `lmdbench work-precision` wrote)"
    OPENED.append(str(file))
    try:
        h5 = h5py.File(file, "r")
    except OSError as error:
        raise ResultError(f"{file}: cannot be read: {error} {remedy}")
    found, creator = (text(h5.attrs.get(name)) for name in ("format", "creator"))
    if found == "lmdbench-part":
        raise ResultError(f"{file}: is an unfinished run (remedy: finish it with lmdbench run --resume)")
    if found != FORMAT or "format_version" not in h5.attrs:
        raise ResultError(f"{file}: is not a result of lmdbench {remedy}")
    version = int(h5.attrs["format_version"])
    if version > FORMAT_VERSION:
        raise ResultError(f"{file}: has format version {version}, this script reads {OLDEST_FORMAT_VERSION} to {FORMAT_VERSION} "
                          f"(remedy: use the scripts of the lmdbench that wrote it, {creator or 'unknown'}, or of a newer one)")
    if version < OLDEST_FORMAT_VERSION:
        raise ResultError(f"{file}: has format version {version}, which never was {remedy}")
    check_content(file, h5)
    return h5


class Method:
    """One group of /methods. What kind of method it is stands in its attributes."""

    def __init__(self, result, label):
        self.result = result
        self.label = label
        group = f"/methods/{label}"
        self.name = result.text_attribute(group, "method", label)
        self.force_law = result.text_attribute(group, "force_law", "exponential")
        self.aggregation = result.text_attribute(group, "aggregation", "sum")
        attributes = result.h5[group].attrs
        self.promise = result.text_attribute(group, "promise")
        if result.format_version == 1:
            order, tracks, trackings = METHODS_OF_FORMAT_1[self.name]
        else:
            order, tracks, trackings = (attributes[name] for name in ("method_order", "tracks_locally", "trackings_after_search"))
        self.order, self.tracks_locally, self.reduces = int(order), bool(tracks), int(trackings) > 0
        self.profile = result.text_attribute(group, "profile") or ""
        self.series = label.removesuffix(f"-{self.profile}") if self.profile else label  # the same under every profile

    def has(self, dataset):
        return self.result.has(f"/methods/{self.label}/{dataset}")

    def read(self, dataset):
        return self.result.read(f"/methods/{self.label}/{dataset}")

    def times(self, dataset):
        """(R, count) samples [s] of the repetitions after the warm-up."""
        samples = np.atleast_2d(self.read(dataset))
        first = self.result.warm_up_repetitions
        if samples.shape[0] <= first:
            raise ResultError(
                f"{self.result.file}: /methods/{self.label}/{dataset}: only {samples.shape[0]} repetition(s), and the "
                f"first {first} warm up (remedy: run with /driver/repetitions of at least {first + 1})"
            )
        return samples[first:]

    def median_times(self, dataset):
        """(count) median over the repetitions [s]; NaN where nothing was measured."""
        return nan_median(self.times(dataset), axis=0)

    def force_magnitude(self):
        """(N) length of the rendered force [N]."""
        return np.linalg.norm(self.read("force"), axis=1)

    def events(self, name):
        """Rare events of the run, such as jumps: how many, in what time, and their rate (intervals.Rate)."""
        frames = self.number("true_jump_frames" if name == "true_jumps" else "frames_in_contact")
        return Rate([self.number(name)], [frames / self.result.scene("frame_rate_hz")])

    def number(self, name):
        """A number of the program's summary; NaN where it was not measured."""
        return self.result.summary_number(f"/methods/{self.label}/summary/{name}")

    def constant(self, name):
        """A number of its force profile: cutoff_m, maximum_force_n, ...; the scene's where all methods share one."""
        attributes = self.result.h5[f"/methods/{self.label}"].attrs
        return float(attributes[name]) if name in attributes else self.result.scene(name)

    def at_its_frames(self, group):
        """Where a probe's group is: its own in a closed loop or under one of several profiles, else the root's."""
        own = f"/methods/{self.label}/{group}"
        return own if self.result.has(f"{own}/frame") else f"/{group}"

    def reference(self):
        """Group of the true sets at its frames."""
        return self.at_its_frames("reference")

    def in_contact(self):
        """(N) whether the meshes are within its cutoff at its poses, by frame."""
        own = next((name for name in ("loop/in_contact", "in_contact") if self.has(name)), None)
        return self.read(own).astype(bool) if own else self.result.in_contact()

    def searches_every_frame(self):
        """Whether the method has no search of its own rate: its whole set is found anew in the local part."""
        return not self.tracks_locally


class Result:
    """One result file, open for reading."""

    def __init__(self, file):
        self.file = str(file)
        self.h5 = open_h5(self.file)
        if "/sweep" in self.h5:
            raise ResultError(f"{self.file}: holds a sweep, not a run (remedy: scripts/figures/sweep.py or lmdbench.open_sweep reads it)")
        self.format_version = int(self.h5.attrs["format_version"])
        self.experiment = json.loads(self.read_text("/provenance/experiment"))
        self.experiment_name = self.experiment.get("name", self.file)
        self.name = self.experiment_name  # variants get a longer one (variants.py)
        self.time = self.read("/path/time")
        self.warm_up_repetitions = self._warm_up_repetitions()
        self.methods = self._methods()

    def has(self, path):
        return path in self.h5

    def read(self, path):
        if path not in self.h5:
            raise ResultError(f"{self.file}: {path}: is missing (remedy: {self._remedy_for(path)})")
        return self.h5[path][()]

    def _remedy_for(self, path):
        """What makes a run keep a dataset that is not there."""
        if self.format_version == 1 and ("summary/" in path or path == "/scene/in_contact"):
            return "format 1 did not hold it: run the experiment again"
        record = getattr(self, "experiment", {}).get("record", {})
        name = path.split("/")[-1]
        kind = "torque" if name == "torque" else "timings" if name.endswith("_time") else "counters" if "counters/" in path else "frames"
        if path.startswith("/methods/") and record.get(kind) is False:
            return f"the run left it out: run the experiment again with --set /record/{kind}=true"
        return "run the experiment again"

    def read_text(self, path):
        return self.texts(path)[0]

    def texts(self, path):
        return [str(text(item)) for item in np.ravel(self.read(path))]

    def text_attribute(self, path, name, default=None):
        return text(self.h5[path].attrs.get(name, default)) if path in self.h5 else default

    def _warm_up_repetitions(self):
        for path in ("/methods", "/"):
            if path in self.h5 and "warm_up_repetitions" in self.h5[path].attrs:
                return int(self.h5[path].attrs["warm_up_repetitions"])
        return 0

    def _methods(self):
        if "/methods" not in self.h5:
            raise ResultError(f"{self.file}: /methods: is missing (remedy: run the experiment again)")
        methods = [Method(self, label) for label, item in self.h5["/methods"].items() if isinstance(item, h5py.Group)]

        def place(method):
            """The order of reports: that of the registry, variants of a method behind it."""
            return (method.order, method.label != method.name, method.label)

        return {method.label: method for method in sorted(methods, key=place)}

    def method(self, label):
        if label not in self.methods:
            known = ", ".join(self.methods)
            raise ResultError(f"{self.file}: has no method '{label}' (remedy: choose among {known})")
        return self.methods[label]

    def repetitions(self):
        return max((m.read("local_update_time").shape[0] for m in self.methods.values() if m.has("local_update_time")), default=0)

    def summary_number(self, path):
        return float(np.ravel(self.read(path))[0])

    def number(self, name):
        """A number of the program's summary that is no method's."""
        return self.summary_number(f"/summary/{name}")

    def in_contact(self):
        """(N) whether the meshes are within the cutoff of each other, by frame."""
        return self.read("/scene/in_contact").astype(bool)

    def seconds_in_contact(self):
        return self.number("frames_in_contact") / self.scene("frame_rate_hz")

    def scene(self, name):
        """A number of the scene: maximum_force_n, cutoff_m, ..."""
        if "/scene" not in self.h5 or name not in self.h5["/scene"].attrs:
            raise ResultError(f"{self.file}: /scene: attribute {name} is missing (remedy: run the experiment again)")
        return float(self.h5["/scene"].attrs[name])

    def maximum_force(self):
        """F_max of one LMD [N], the scale of force errors."""
        return self.scene("maximum_force_n")

    def triangles(self, smallest=False):
        """Triangles of all meshes of the scene, or of its smallest mesh."""
        counts = [int(item.attrs["triangles"]) for item in self.h5["/scene"].values() if "triangles" in item.attrs]
        if not counts:
            raise ResultError(f"{self.file}: /scene: names no mesh (remedy: run the experiment again)")
        return min(counts) if smallest else sum(counts)

    def machine(self):
        return texts_of(self.h5["/provenance/machine"].attrs) if "/provenance/machine" in self.h5 else {}


ROUNDING = 1e-8  # force errors below this share of F_max are rounding, and drawn as 0
MISSES_ALL = "finds no true LMD"
NOT_JUDGED = "no true force in contact"  # the scene's doing, no method's failure


def misses_all(recall, force_error):
    """Whether a set is a failure. In flush contact other contacts than the true LMDs can give the true force: it is none then."""
    return recall == 0.0 and not force_error < ROUNDING


def nan_median(values, axis=None):
    """Median of what was measured; NaN without a warning where nothing was."""
    values = np.asarray(values, dtype=float)
    if not values.size:
        return np.nan if axis is None else np.full(np.delete(values.shape, axis), np.nan)
    empty = np.all(np.isnan(values), axis=axis)
    filled = np.where(np.expand_dims(empty, axis) if axis is not None else empty, 0.0, values)
    return np.where(empty, np.nan, np.nanmedian(filled, axis=axis))


def quantile(values, share):
    """Quantile of what was measured; NaN where nothing was."""
    values = np.asarray(values, dtype=float)
    values = values[~np.isnan(values)]
    return float(np.quantile(values, share)) if values.size else float("nan")


def median(values):
    return quantile(values, 0.5)


# Share of the largest force at s, from 0 at the cutoff to 1 at saturation (force/force_law.cpp).
LAWS = {"linear": lambda s, sharpness: s, "exponential": lambda s, sharpness: np.expm1(sharpness * s) / np.expm1(sharpness) if sharpness else s}


def law(distance, cutoff, saturation, maximum, sharpness, name):
    """Lengths of the forces of LMDs [N]."""
    return maximum * LAWS[name](np.clip((cutoff - distance) / (cutoff - saturation), 0.0, 1.0), sharpness)


class Truth:
    """What a method's LMD sets and forces are worth at each probed frame: for figures over time."""

    def __init__(self, method):
        result = method.result
        group = "truth/"
        reference = method.reference()
        self.frames = method.read(group + "frame").astype(int)
        self.reference_frames = result.read(f"{reference}/frame").astype(int)
        if not np.array_equal(self.frames, self.reference_frames):
            raise ResultError(f"{result.file}: /methods/{method.label}/truth/frame and {reference}/frame differ")
        self.true_count = result.read(f"{reference}/lmd_count").astype(float)
        self.recall = method.read(group + "recall")
        self.recall_adjacent = method.read(group + "recall_adjacent")
        self.force_error = method.read(group + "force_error")
        self.force_is_known = ~without_direction(result, reference)

    def found_in(self, shares, chosen):
        """Share of the true LMDs of the chosen probed frames that the method has; NaN when there are none, or it promises no set."""
        counts = self.true_count[chosen]
        total = float(np.sum(counts))
        return float(np.sum(np.where(counts > 0, shares[chosen], 0.0) * counts) / total) if total > 0 else float("nan")


def truth_of(method):
    """Truth of a method, or None when the run had no truth probe."""
    if not method.has("truth/frame") or not method.result.has(f"{method.reference()}/frame"):
        return None
    return Truth(method) if method.read("truth/frame").size else None


def no_truth(result):
    """Why a result whose methods have no truth has none, in words."""
    asked = result.experiment.get("probes", {}).get("truth", {}).get("stride_frames", 0) > 0
    return "the path ends before the first probed frame" if asked else "no truth probe"


def without_direction(result, reference):
    """(K) whether the probed frame has a true LMD without a direction, so that no force is the true one."""
    if result.has(f"{reference}/contact_without_direction"):
        return result.read(f"{reference}/contact_without_direction") > 0
    return result.read(f"{reference}/minimum_distance") == 0.0  # before 1.0: triangles that touch as well


def reference_force(method):
    """(K) frames and (K) length of the true rendered force under a method's law, at its poses [N]; empty without a truth probe."""
    group = method.reference()
    dataset = f"{group}/force_{method.force_law}"
    if not method.result.has(dataset):
        return np.empty(0, dtype=int), np.empty(0)
    force = np.linalg.norm(method.result.read(dataset), axis=1)
    force[without_direction(method.result, group)] = np.nan  # results before 1.0 have a number
    return method.result.read(f"{group}/frame").astype(int), force


def true_forces(methods):
    """[(what it is the truth of, a method)]: one for each law that methods share poses and profile under."""
    found = {}
    for method in methods:
        if method.result.has(f"{method.reference()}/force_{method.force_law}"):
            found.setdefault((method.reference() if method.reference() != "/reference" else "", method.force_law), method)
    return [(f"truth of {method.label}" if reference else f"truth, {law} law", method) for (reference, law), method in found.items()]


LONGEST_REASON = 200  # letters; errors of decoding may hold the whole file


def in_short(error):
    return str(error)[:LONGEST_REASON]


def run_script(main):
    """Calls main(argv) and turns what a user did wrong into one line and the exit code of the command line contract."""
    try:
        code = main(sys.argv[1:])
        sys.stdout.flush()
        return code
    except ForeignFileError as error:
        print(error, file=sys.stderr)
        return EXIT_USAGE
    except ResultError as error:
        print(error, file=sys.stderr)
        return error.exit_code
    except DATA_ERRORS as error:
        place = traceback.extract_tb(error.__traceback__)[-1]
        files, holder, remedy = ((OPENED, "a result holds", "make the file again with lmdbench run") if OPENED else
                                 ([argument for argument in sys.argv[1:] if os.path.isfile(argument)] or sys.argv[1:], "is read here", "name files of the kind that --help tells"))
        print(f"{', '.join(files)}: not what {holder}: {type(error).__name__}: {in_short(error)} in {os.path.basename(place.filename)}, "
              f"line {place.lineno} (remedy: {remedy})", file=sys.stderr)
        return EXIT_INPUT_DATA
    except OSError as error:  # a full disk, no write permission, a reader that has gone
        if isinstance(error, BrokenPipeError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # else the interpreter complains when it ends
        print(f"{error} (remedy: check the disk, its permissions and that a folder to write to is no file)", file=sys.stderr)
        return EXIT_ENVIRONMENT
