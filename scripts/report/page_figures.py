# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The page's figures, each also as SVG and PNG in the folder of the page, and the CSV files of their numbers."""

import base64
import csv
import io
import json

import figure7
import figure_style as style
import sweep as sweep_figure
import work_precision
from clock_results import age_table, clocks, draw_timing, excess_table, lateness_table, role_table
from lmdbench_results import NOT_JUDGED, truth_of
from studies import html_of, slug, unique


def csv_text(headings, rows):
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(headings)
    writer.writerows(rows)
    return stream.getvalue()


def work_precision_csv(results):
    points = [work_precision.Point(result, method) for result in results for method in result.methods.values()]
    return csv_text(["experiment", "method", "median [ms]", "99 % [ms]", "RMS force error / F_max [1]", "missed LMDs [1]",
                     "missed, neighbouring features count [1]", "failure"],
                    ([point.experiment, point.method.label, point.median_ms, point.p99_ms, point.force_error, point.missed,
                      point.missed_adjacent, point.failure] for point in points))


def sweep_csv(sweep):
    """Every point with all its numbers."""
    numbers = sorted(sweep.columns)
    return csv_text(["scene", "series", "axes", "failure", *numbers],
                    ([point.scene, point.series, json.dumps(point.axes), point.failure, *(point.number(name) for name in numbers)]
                     for point in sweep.points))


def saved(figure, folder, name):
    """As SVG and PNG in the folder; the SVG in base64."""
    svg = next(file for file in style.save(figure, folder, name) if file.endswith(".svg"))
    with open(svg, "rb") as stream:
        return base64.b64encode(stream.read()).decode("ascii")


def entry(figure, folder, name, title, text, table="", narrow=None):
    """@param narrow  the same for a page as wide as a telephone"""
    return {"id": name, "title": title, "text": text, "svg": saved(figure, folder, name), "narrow": saved(narrow, folder, f"{name}-narrow") if narrow else "",
            "csv": table, "html": "", "csv_results": [], "folded": ""}


def sweep_entry(sweep, folder, taken):
    """Figure and answer of a sweep: which method at which budget, and where one gets cheaper than the other."""
    tables = ["Least RMS force error [% of F_max of one LMD] within so much run time of a second in contact, searches included:",
              "", *sweep_figure.budget_table(sweep)]
    crossing = sweep_figure.crossings(sweep)
    if crossing:
        tables += ["`improved` costs less than `certified`, with older sets, where it searches more rarely than every", "", *crossing]
    made = entry(
        sweep_figure.draw(sweep), folder, unique(f"sweep-{sweep.sweep_name}", taken),
        ("Error against run time" if sweep.sweep_name == "budget" else sweep.title) + sweep.name.removeprefix(sweep.sweep_name),
        f"{sweep.title}. A line a series, a point a setting, truth in every frame. Lower left is better; shaded lanes hold errors of exactly "
        "zero and points that fail or find neither a true LMD nor the true force.", sweep_csv(sweep))
    return {**made, "html": html_of("\n".join(tables))}


def probed(results):
    return [result for result in results if any(truth_of(method) for method in result.methods.values())]


def over_time_entry(results, folder, by_paper):
    """The paper's Figure 7, hard beside soft, or the same of any results; as many columns as a page holds."""
    columns = figure7.columns_of(results)
    if not columns:
        return None
    shown, left_out = ([column.name() for column in part] for part in (columns[:figure7.MOST_COLUMNS], columns[figure7.MOST_COLUMNS:]))
    where = f"From left to right: {'; '.join(shown)}. " if len(shown) > 1 else ""
    beside = (f" Not in the figure, which has room for {figure7.MOST_COLUMNS}: {'; '.join(left_out)} (the plots to zoom have them; so has a figure of "
              "`scripts/figures/figure7.py` with fewer results)." if left_out else "")
    name, title, beyond = ("figure7", "The paper's Figure 7", " beyond the paper") if by_paper else ("over_time", "Over time", "")
    truth = f", and{beyond} the true force and the share of true LMDs that each method knows" if probed(results) else ""
    made = entry(figure7.draw_columns(columns[:figure7.MOST_COLUMNS]), folder, name, title,
                 f"{where}Force, LMD counts, {'' if truth else 'and '}search and update times{truth}.{beside}{' The next section has these plots to zoom, with all methods.' if by_paper else ''}")
    return {**made, "folded": "" if by_paper else "As a figure to print", "csv_results": [(i, result.name) for i, result in enumerate(results)]}


def clock_entry(result, folder, taken):
    """Loop timing over the floor and ages over time of a run with the driver realtime."""
    named = [(clock.label, clock) for clock in clocks(result)]
    lists = (excess_table(named), lateness_table(named), age_table(named), role_table(named))
    made = entry(
        draw_timing(named), folder, unique(f"clock-{slug(result.name)}", taken), f"On the clock: {result.name}",
        "How late the servo loop wakes and how late its force is, over an empty loop of the same priority on the same core; and how old "
        "the sets in use are. What the empty loop is late by is the machine's own: verdicts rest on what exceeds it. Intervals are 95 %.",
        csv_text(["method", "series", "share", "value [s]", "low [s]", "high [s]"],
                 ([name, series, share, *row] for name, clock in named for series in ("floor", "servo", "response", "excess", "response_excess")
                  for share, row in clock.quantiles(series).items())))
    return {**made, "html": html_of("\n\n".join("\n".join(table) for table in lists))}


def work_precision_text(results):
    """What the figure shows; lanes and open marks only where they are drawn."""
    points = [work_precision.Point(result, method) for result in results for method in result.methods.values()]
    several = " in one experiment" if len({point.experiment for point in points}) > 1 else ""
    several += " under one force profile" if any(point.method.profile for point in points) else ""
    lanes = ["The shaded lane on the left holds errors of exactly zero."] * any(
        0.0 in (point.force_error, point.missed, point.missed_adjacent) for point in points)
    lanes += ["The shaded lane on the right holds methods that fail."] * any(point.failure not in ("", NOT_JUDGED) for point in points)
    return " ".join([
        f"Each filled mark is one method{several}: further right its error is larger, further up its run time in a frame in contact is longer; lower "
        "left is better. Open marks: the share missed if LMDs between neighbouring features count as found.", *lanes])


def figures(results, sweeps, folder, by_paper):
    taken = set()
    entries = [sweep_entry(sweep, folder, taken) for sweep in sweeps]
    known = probed(results)
    if known:
        entries.append(entry(
            work_precision.draw(known), folder, "work_precision", "Error against run time of these runs" if sweeps else "Error against run time",
            work_precision_text(known), work_precision_csv(known), work_precision.draw(known, narrow=True)))
    entries += [clock_entry(result, folder, taken) for result in results if clocks(result)]
    over_time = over_time_entry(results, folder, by_paper)
    return entries + ([over_time] if over_time else [])
