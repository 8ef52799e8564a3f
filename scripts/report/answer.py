# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The first screen's table and sentence: of each method the error beside the time. All numbers are the program's own."""

import math

import numpy as np

from clock_results import clocks
from work_precision import ROUNDING

BUDGET_S = 1e-3  # one haptic frame at 1 kHz
LATE_SHARE = 0.01  # of the frames in contact
SHOWN_AS_1 = 0.9995  # the least that is rounded up to 1 with three digits
ON_THE_CLOCK = ("On the clock each method has a run to itself, and the time of a frame does not tell how late its force is: that stands under "
                "\"On the clock\". Frames without a tick have no time.")


class Row:
    """A method in a result, with the numbers of its summary (results/README.md)."""

    def __init__(self, method, clock=None):
        self.late = method.number("frames_late") if clock is None else float(np.sum(clock.read("frame_source") == 1))
        self.label = method.label
        self.profile = method.profile
        self.force_law = method.force_law if method.aggregation == "sum" else f"{method.force_law}, {method.aggregation}"
        self.number = method.number
        self.force_error = method.number("force_error_rms_n") / method.constant("maximum_force_n")
        self.frames_probed = method.read("truth/frame").size if method.has("truth/frame") else 0
        self.largest_force_error = method.number("force_error_maximum_n") / method.constant("maximum_force_n")


def lead(rows):
    """A sentence for each force profile: under different ones the same error is of another force."""
    profiles = list(dict.fromkeys(row.profile for row in rows))
    said = [(profile, sentence([row for row in rows if row.profile == profile])) for profile in profiles]
    return " ".join(f"Under {profile}: {text[0].lower()}{text[1:]}" if profile else text for profile, text in said)


def sentence(rows):
    """Which method to take at the budget of one haptic frame, said with its conditions; what cannot be said is said."""
    probed = [row for row in rows if math.isfinite(row.force_error)]
    if not probed:
        return "No frame in contact was compared with a true force: the times stand without an error, so no method can be preferred."
    # Times are of frames that have one: who loses others keeps them within nothing.
    punctual = [row for row in probed
                if row.number("frame_time_p99_s") <= BUDGET_S and not row.late > LATE_SHARE * row.number("frames_in_contact")]
    if not punctual:
        return "No method keeps 99 % of its frames within 1 ms here."
    # Errors of rounding are ties: a set that is never wrong comes first, then the faster one.
    best = min(punctual, key=lambda row: (row.force_error if row.force_error >= ROUNDING else 0.0, row.number("frames_wrong") > 0,
                                          row.number("frame_time_median_s")))
    late = int(best.late)
    laws = len({row.force_law for row in probed}) > 1
    return (f"Within one haptic frame (1 ms), {best.label} leaves the least force error: {percent(best.force_error)} % of "
            f"F_max (root mean square), in {time(best.number('frame_time_median_s'))} in the median frame and "
            f"{time(best.number('frame_time_p99_s'))} in 99 % of them; "
            f"{late or 'none'} of its frames {'is' if late < 2 else 'are'} late." + (" Each error is under the method's own force law." if laws else ""))


def time(value):
    """[s] in the unit that one reads it in."""
    if not math.isfinite(value):
        return "-"
    unit, scale = next(((name, one) for name, one in (("s", 1.0), ("ms", 1e3)) if abs(value) * one >= SHOWN_AS_1), ("\u00b5s", 1e6))
    return f"{number(value, scale)} {unit}"


def percent(share):
    """Of 100; what is rounding is 0, and what a reader cannot tell from it says so."""
    return "0" if share < ROUNDING else "< 0.01" if share < 1e-4 else share_of_all(share)


def share_of_all(share):
    """In percent; what is less than all is not rounded up to it."""
    shown = number(share, 100.0)
    return "> 99.9" if shown == "100" and share < 1.0 else shown


def number(value, scale=1.0):
    shown = value * scale
    return "-" if not math.isfinite(shown) else f"{shown:.0f}" if abs(shown) >= 1000 * SHOWN_AS_1 else f"{shown:.3g}"


def frames_wrong(row):
    """Of how many; methods that promise a force alone have no set that could be wrong."""
    wrong = row.number("frames_wrong")
    return f"{wrong:.0f} of {row.frames_probed}" if math.isfinite(wrong) else "-"


def late(row):
    return number(row.late)


def summary(name, scale=1.0):
    return lambda row: number(row.number(name), scale)


FIRST_COLUMNS = (
    ("method", lambda row: row.label),
    ("frames wrong", frames_wrong),
    ("recall [%]", lambda row: percent(row.number("recall"))),
    ("force error, RMS [% of F_max]", lambda row: percent(row.force_error)),
    ("frame, median", lambda row: time(row.number("frame_time_median_s"))),
    ("frame, 99 %", lambda row: time(row.number("frame_time_p99_s"))),
    ("late frames", late),
)
COLUMNS = (
    ("method", lambda row: row.label),
    ("force law", lambda row: row.force_law),
    ("frames probed", lambda row: f"{row.frames_probed}"),
    ("frames wrong", summary("frames_wrong")),
    ("recall [%]", lambda row: share_of_all(row.number("recall"))),
    ("recall, neighbouring features count [%]", lambda row: share_of_all(row.number("recall_adjacent"))),
    ("precision [%]", lambda row: share_of_all(row.number("precision"))),
    ("force error, RMS [% of F_max]", lambda row: number(row.force_error, 100.0)),
    ("force error, largest [% of F_max]", lambda row: number(row.largest_force_error, 100.0)),
    ("frame, median [\u00b5s]", summary("frame_time_median_s", 1e6)),
    ("frame, 99 % [\u00b5s]", summary("frame_time_p99_s", 1e6)),
    ("frame, largest [\u00b5s]", summary("frame_time_maximum_s", 1e6)),
    ("frames above 1 ms", late),
)


def answer(result):
    on_clock = {clock.label: clock for clock in clocks(result)}
    rows = [Row(method, on_clock.get(method.label)) for method in result.methods.values()]

    def table(columns):
        return {"headings": ["frames without a tick" if on_clock and cell is late else name for name, cell in columns],
                "rows": [[cell(row) for _, cell in columns] for row in rows]}
    return {"sentence": ON_THE_CLOCK if on_clock else lead(rows), "first": table(FIRST_COLUMNS), "whole": table(COLUMNS)}
