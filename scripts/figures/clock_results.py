# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""What a run with the driver `realtime` left of its clock (results/README.md, /realtime), its figure and its tables."""

import numpy as np

import figure_style as style
from intervals import bootstrap, poisson_interval
from tables import table

import matplotlib.pyplot as plt

SERIES = ("servo", "response", "floor")
BLOCK = 100  # instants, as in realtime/lateness.h
MOST_POINTS = 4000  # of a line over time: more than a page is wide


class Clock:
    """One method's group of /realtime."""

    def __init__(self, result, label):
        self.result, self.label = result, label
        self.group = result.h5[f"/realtime/{label}"]

    def attribute(self, name, of=""):
        return float((self.group[of] if of else self.group).attrs[name])

    def read(self, name):
        return self.group[name][()]

    def roles(self):
        return [name for name in ("servo", "tracking", "search", "scene") if name in self.group]

    def quantiles(self, series):
        """{share: (value, low, high) [s]}"""
        return {float(share): row for share, row in zip(self.read("lateness/share"), zip(*(
            self.read(f"lateness/{series}/{name}") for name in ("value", "low", "high"))))}

    def above(self, series):
        return {float(share): int(count) for share, count in zip(self.read("lateness/share"), self.read(f"lateness/{series}/above"))}

    def skipped_per_million(self, of):
        """(rate, low, high) of instants without a turn per million instants, of the servo loop or of the floor. They come in
        bursts, so that the interval is by blocks of instants; where none was missed it is that of bursts of one."""
        missed = self.read("frame_source") == 1 if of == "servo" else np.concatenate([self.missed(name) for name in ("floor_before", "floor_after")])
        blocks = [(float(block.sum()), block.size) for block in np.array_split(missed, max(missed.size // BLOCK, 1))]

        def rate(drawn):
            return 1e6 * sum(count for count, _ in drawn) / max(sum(size for _, size in drawn), 1)

        if not missed.any():
            return (0.0, *(1e6 * limit / max(missed.size, 1) for limit in poisson_interval(0)))
        return (rate(blocks), *bootstrap(blocks, rate))

    def missed(self, loop):
        """Whether each instant of an empty loop's grid had no turn: a late turn is for the last instant that has come."""
        asked = self.read(f"{loop}/asked")
        missed = np.ones(asked.size + int(self.attribute("skipped", loop)), dtype=bool)
        instants = np.rint((asked - asked[:1]) / self.attribute("period_s")).astype(int)
        missed[np.append(instants[1:], missed.size)[: asked.size] - 1] = False
        return missed

    def refused(self):
        granted, asked, thread = (self.read(f"grants/{name}") for name in ("granted", "asked", "thread"))
        return [f"{who.decode()}: {what.decode()}" for ok, what, who in zip(granted, asked, thread) if not ok]

    def ages_ms(self):
        """(time [s], age of the set in use [ms], age of its search [ms]) by tick."""
        return self.read("servo/woken"), 1e3 * self.read("servo/age"), 1e3 * self.read("servo/search_age")


def clocks(result):
    """The clocks of a result in the order of its methods; empty for one of the lockstep driver."""
    return [Clock(result, label) for label in result.methods if f"/realtime/{label}" in result.h5]


def thinned(time, values):
    """The largest of each stretch, so that no peak is lost."""
    if values.size <= MOST_POINTS:
        return time, values
    starts = np.arange(0, values.size, -(-values.size // MOST_POINTS))
    return time[starts], np.maximum.reduceat(values, starts)


def draw_timing(named):
    """Left: lateness as a histogram over the floor; right: ages over time. A row for each (name, clock)."""
    style.use_style()
    figure, rows = plt.subplots(len(named), 2, figsize=(style.TWO_COLUMNS_IN, 1.7 * len(named) + 0.5), squeeze=False,
                                gridspec_kw={"width_ratios": (1.2, 1.0)})
    looks = {"floor": {"color": style.PALE_GREY, "label": "empty loop"}, "servo": {"color": style.BLUE, "label": "servo, woken"},
             "response": {"color": style.VERMILLION, "label": "servo, force"}}
    for (name_of_run, clock), (left, right) in zip(named, rows):
        edges = 1e6 * np.concatenate(([0.8e-6], clock.read("lateness/edges"), [1.25]))
        for name in ("floor", "servo", "response"):
            counts = clock.read(f"lateness/{name}/histogram").astype(float)
            share = counts / max(counts.sum(), 1.0)
            left.stairs(share, edges, fill=name == "floor", linewidth=0.9, **looks[name])
        left.set(xscale="log", yscale="log", xlim=(0.8, 2e4), ylabel="share of the instants")
        left.set_title(style.shortened(name_of_run), loc="left")
        left.axvline(1e6 * clock.attribute("period_s"), color=style.GREY, linewidth=0.6, linestyle=":")
        time, age, search_age = clock.ages_ms()
        if age.any():
            right.plot(*thinned(time, search_age), color=style.SKY, linewidth=0.6, label="since its search")
            right.plot(*thinned(time, age), color=style.BLUE, linewidth=0.6, label="of the set in use")
            right.set(yscale="log", ylabel="age [ms]")
            right.legend(loc="lower right", bbox_to_anchor=(1.0, 0.98), ncol=2, borderpad=0.0)
        else:
            right.text(0.5, 0.5, "searched in the tick: age 0", ha="center", va="center", transform=right.transAxes)
            right.set_yticks([])
        right.set_xlim(0.0, max(time.max(initial=0.0), clock.attribute("period_s")))
        right.locator_params(axis="x", nbins=5)
    rows[0][0].legend(loc="upper right")
    rows[-1][0].set_xlabel("later than the instant of the grid [us]; dotted: a servo period")
    rows[-1][1].set_xlabel("time [s]")
    figure.tight_layout()
    return figure


def micro(row):
    """'12.3 (11.9 to 12.8)' of (value, low, high) [s]."""
    value, low, high = (1e6 * number for number in row)
    return f"{value:.1f} ({low:.1f} to {high:.1f})"


def lateness_table(named):
    """Markdown lines: [(name, clock)]."""
    lines = []
    for name, clock in named:
        for series, loop in (("floor", "empty"), ("servo", "servo, woken"), ("response", "servo, force")):
            rows, above = clock.quantiles(series), clock.above(series)
            *cells, last = map(micro, rows.values())
            lines.append([name, loop, *cells, f"{last} ({above[list(rows)[-1]]})", f"{1e6 * clock.attribute('maximum_s', f'lateness/{series}'):.0f}"])
    return table(["run", "loop", "p50 [us]", "p95", "p99", "p99.9", "p99.99 (instants above)", "largest"], lines)[:-1]


def excess_table(named):
    rows = []
    for name, clock in named:
        excess, force = clock.quantiles("excess"), clock.quantiles("response_excess")
        miss, floor = (f"{rate:.0f} ({low:.0f} to {high:.0f})" for rate, low, high in map(clock.skipped_per_million, ("servo", "floor")))
        rows.append([name, micro(excess[0.99]), micro(force[0.5]), micro(force[0.99]), miss, floor, f"{clock.attribute('stolen_s'):.2f}"])
    return table(["run", "woken over empty, p99 [us]", "force over empty, p50 [us]", "force over empty, p99 [us]", "periods without a tick, a million",
                  "of the empty loop", "stolen [s]"], rows)[:-1]


def role_table(named):
    rows = []
    for name, clock in named:
        for role in clock.roles():
            turns, processor = (clock.attribute(key, role) for key in ("turns", "processor_s"))
            faults = clock.attribute("minor_faults", role) + clock.attribute("major_faults", role)
            rows.append([name, role, f"{clock.attribute('core', role):.0f}", f"{clock.attribute('rate_hz', role):.1f}", f"{1e6 * processor / max(turns, 1):.1f}",
                         f"{100 * clock.attribute('load', role):.2f}", f"{faults:.0f}", f"{clock.attribute('involuntary_switches', role):.0f}"])
    return table(["run", "role", "core", "turns a second", "processor time a turn [us]", "share of a core [%]", "faults", "processor taken away"], rows)[:-1]


def age_table(named):
    return table(["run", "age of the set in use, p50 [ms]", "p99", "largest", "since its search, p50 [ms]", "p99", "largest"], [
        [name, *(f"{value:.2f}" for ages in clock.ages_ms()[1:] for value in (*np.quantile(ages, (0.5, 0.99)), ages.max()))] for name, clock in named])[:-1]
