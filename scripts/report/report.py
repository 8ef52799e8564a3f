#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The page of one or more results: DIR/index.html, one file that needs no network, and its figures as SVG and PNG beside
it. `lmdbench report` calls this with the scenes of the results; everything else comes from the result files alone."""

import argparse
import base64
import csv
import io
import json
import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "figures"))

import jinja2  # noqa: E402  (the figures' folder must be found first)
import markdown  # noqa: E402
import markupsafe  # noqa: E402

import figure7  # noqa: E402
import sweep as sweep_figure  # noqa: E402
import figure_style as style  # noqa: E402
import work_precision  # noqa: E402
from answer import answer  # noqa: E402
from lmdbench_results import Result, ResultError, run_script, truth_of  # noqa: E402
from page_data import page_colours, time_panels  # noqa: E402
from scene_data import scene  # noqa: E402
from sweep_results import Sweep, is_sweep  # noqa: E402

JAVASCRIPT = "/usr/share/javascript"
LIBRARIES = (("three/three.min.js", "libjs-three"), ("three/examples/js/controls/OrbitControls.js", "libjs-three"),
             ("dygraphs/dygraph.min.js", "libjs-dygraphs"), ("dygraphs/src/extras/synchronizer.js", "libjs-dygraphs"))
STYLES = (("dygraphs/dygraph.min.css", "libjs-dygraphs"),)


def text_of(*path):
    with open(os.path.join(*path), encoding="utf-8") as stream:
        return stream.read()


def library(name, package):
    """A library of Debian's, without the reference to its source map, which a browser would ask for."""
    try:
        text = text_of(JAVASCRIPT, name)
    except OSError as error:
        raise OSError(f"{error.filename}: cannot be read (remedy: apt-get install {package}, or ./scripts/setup.sh)")
    return re.sub(r"(?m)^(//|/\*)# sourceMappingURL=.*$", "", text)


def in_script(text):
    """What stands inside <script> must not end it; a longer pattern would break regular expressions of the libraries."""
    return re.sub(r"(?i)</(?=script)", r"<\\/", text)


def what_was_run(result):
    methods = ", ".join(method.label for method in result.methods.values())
    probed = next((truth_of(method) for method in result.methods.values() if truth_of(method)), None)
    truth = f"errors against exhaustive truth in {probed.frames.size} frames" if probed else "no truth probe"
    return (f"{result.experiment.get('title') or result.name}. {result.time.size} frames, {result.triangles()} triangles, cutoff "
            f"{result.scene('cutoff_m') * 1e3:.4g} mm; methods {methods}; {truth}.")


def provenance(result):
    root = result.h5["/provenance"].attrs
    rows = [(name, result.text_attribute("/provenance", name)) for name in sorted(root)]
    rows += [(f"machine: {name}", value) for name, value in sorted(result.machine().items())]
    if result.has("/provenance/inputs/role"):
        rows += [(f"input: {role}", f"{file}, SHA-256 {digest}") for role, file, digest in
                 zip(*(result.texts(f"/provenance/inputs/{name}") for name in ("role", "file", "sha256")))]
    rows += [(f"result hash: {label}", result.text_attribute(f"/methods/{label}", "result_hash")) for label in result.methods]
    return [(name, value) for name, value in rows if value]


def work_precision_csv(results):
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(["experiment", "method", "median [ms]", "99 % [ms]", "RMS force error / F_max [1]", "missed LMDs [1]",
                     "missed, neighbouring features count [1]", "failure"])
    for result in results:
        for method in result.methods.values():
            point = work_precision.Point(result, method)
            writer.writerow([point.experiment, point.method.label, point.median_ms, point.p99_ms, point.force_error,
                             point.missed, point.missed_adjacent, point.failure])
    return stream.getvalue()


def paper_pairs(results):
    """Results with methods that search now and then, as the paper's do, hard beside soft: the first two of them."""
    able = [result for result in results if figure7.shown(result)]
    return (able[0], able[1]) if len(able) > 1 else (able[0], able[0]) if able else None


def figure_entry(figure, folder, name, title, text, table=""):
    svg = next(file for file in style.save(figure, folder, name) if file.endswith(".svg"))
    with open(svg, "rb") as stream:
        data = base64.b64encode(stream.read()).decode("ascii")
    return {"id": name, "title": title, "text": text, "svg": data, "csv": in_script(table), "html": ""}


def sweep_csv(sweep):
    """Every point with all its numbers."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    numbers = sorted(sweep.columns)
    writer.writerow(["scene", "series", "axes", "failure", *numbers])
    for point in sweep.points:
        writer.writerow([point.scene, point.series, json.dumps(point.axes), point.failure, *(point.number(name) for name in numbers)])
    return stream.getvalue()


def sweep_entry(sweep, folder):
    """Figure and answer of a sweep: which method at which budget, and where one gets cheaper than the other."""
    tables = ["Least RMS force error [% of F_max of one LMD] within so much processor time of a second in contact, searches included:",
              "", *sweep_figure.budget_table(sweep), ""]
    crossing = sweep_figure.crossings(sweep)
    if len(crossing) > 2:
        tables += ["`improved` costs less than `certified`, with older sets, where it searches more rarely than every", "", *crossing, ""]
    entry = figure_entry(
        sweep_figure.draw(sweep), folder, f"sweep-{sweep.name}", "Error against run time" if sweep.name == "budget" else sweep.title,
        f"{sweep.title}. A line a series, a point a setting, truth in every frame. Lower left is better; shaded lanes hold errors of exactly "
        "zero and points that fail or find no true LMD.", sweep_csv(sweep))
    return {**entry, "html": markdown.markdown("\n".join(tables), extensions=["tables"])}


def sweep_provenance(sweep):
    rows = [*sorted(sweep.provenance.items()), *((f"machine: {name}", value) for name, value in sorted(sweep.machine.items()))]
    return {"name": sweep.name, "provenance": [(name, value) for name, value in rows if value], "experiment": sweep.definition}


def figures(results, sweeps, folder):
    entries = [sweep_entry(sweep, folder) for sweep in sweeps]
    probed = [result for result in results if any(truth_of(method) for method in result.methods.values())]
    if probed:
        entries.append(figure_entry(
            work_precision.draw(probed), folder, "work_precision", "Error against run time of these runs" if sweeps else "Error against run time",
            "A point a method and experiment: what error it leaves for what run time of a frame in contact. Lower left is better; "
            "shaded lanes hold errors of exactly zero and methods that fail.", work_precision_csv(probed)))
    pair = paper_pairs(results)
    if pair:
        entries.append(figure_entry(
            figure7.draw(*pair), folder, "figure7", "The paper's Figure 7",
            f"{pair[0].name} on the left, {pair[1].name} on the right: force, LMD counts, search and update times, and beyond the paper "
            "the true force and the share of true LMDs that each method knows."))
    return entries


def study(file):
    """A table of results/reference: its first heading is its title."""
    text = text_of(file)
    title = re.search(r"(?m)^# (.+)$", text)
    name = os.path.splitext(os.path.basename(file))[0]
    body = re.sub(r"(?m)^# .+\n", "", text, count=1)
    # Pictures of other files would be requests.
    body = re.sub(r"!\[([^\]]*)\]\([^)]*\)", r"*\1*", body)
    return {"id": "study-" + re.sub(r"[^a-z0-9]+", "-", name.lower()), "title": title.group(1) if title else name,
            "html": markdown.markdown(body, extensions=["tables", "fenced_code"]), "open": False}


OMISSIONS = (
    "The paper states neither force constants, cutoffs, saturation distance, paths nor the exact meshes: they are ours, and stand in the "
    "experiment under Provenance.",
    "Times are of one machine and one process a result: compare methods within a result, not results of different machines.",
    "A time is the median of the repetitions of its frame; the largest frame is the largest of these medians, not of all samples.",
    "In a run truth is probed at a stride: events between the probed frames are not seen by recall, precision and force error. In a sweep "
    "it stands in every frame.",
    "The methods run in one thread and take turns, block by block, in random order.",
    "The methods of the paper are scalar code; where a method uses vector instructions, its times say so in the experiment's options or not at "
    "all: work counters in the result file are the fair comparison.",
)


def page(results, sweeps, scenes, studies, folder):
    entries = figures(results, sweeps, folder)
    studies = [study(file) for file in studies]
    of_runs = [{"id": "frames", "title": "Frame by frame"}, {"id": "scene", "title": "In space"}] if results else []
    sections = [{"id": "answer", "title": "Answer"}, *entries, *of_runs, *studies, {"id": "omissions", "title": "Omissions"},
                {"id": "provenance", "title": "Provenance"}]
    colours = {label: colour for result in results for label, colour in page_colours(result).items()}
    data = {"results": [time_panels(result) for result in results], "scenes": scenes, "colours": colours}
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE), autoescape=True, undefined=jinja2.StrictUndefined)
    raw = markupsafe.Markup
    described = [{"name": result.name, "what": what_was_run(result), "answer": answer(result), "provenance": provenance(result),
                  "experiment": json.dumps(result.experiment, indent=2),
                  "warnings": result.texts("/scene/warnings") if result.has("/scene/warnings") else []} for result in results]
    return environment.get_template("page.html.j2").render(
        title=" and ".join(result.experiment.get("title") or result.name for result in results)
        or " and ".join(sweep.title for sweep in sweeps),
        results=described, sections=sections, provenances=[*described, *map(sweep_provenance, sweeps)],
        figures=[{**entry, "csv": raw(entry["csv"]), "html": raw(entry["html"])} for entry in entries],
        studies=[{**entry, "html": raw(entry["html"])} for entry in studies],
        omissions=OMISSIONS, style=raw(text_of(HERE, "page.css")),
        libraries={"script": raw(in_script("\n".join(library(*item) for item in LIBRARIES))),
                   "style": raw("\n".join(library(*item) for item in STYLES))},
        script=raw(in_script(text_of(HERE, "page.js") + text_of(HERE, "scene.js"))),
        data=raw(in_script(json.dumps(data, separators=(",", ":"), allow_nan=False))))


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", nargs="+", metavar="RESULT.h5",
                        help="what `lmdbench run` or `lmdbench work-precision` wrote")
    parser.add_argument("--out", required=True, metavar="DIR", help="folder of index.html and of its figures")
    parser.add_argument("--scenes", metavar="DIR", help="folder with a scene for each result, 0, 1, ...; sweeps count")
    parser.add_argument("--study", nargs="*", default=[], metavar="FILE.md", help="tables of studies to show as well")
    arguments = parser.parse_args(argv)
    sweeps = [Sweep(file) for file in arguments.results if is_sweep(file)]
    runs = [(i, file) for i, file in enumerate(arguments.results) if not is_sweep(file)]
    results = [Result(file) for _, file in runs]
    folders = [os.path.join(arguments.scenes, str(i)) if arguments.scenes else None for i, _ in runs]
    scenes = [scene(result, folder) for result, folder in zip(results, folders)]
    os.makedirs(arguments.out, exist_ok=True)
    file = os.path.join(arguments.out, "index.html")
    text = page(results, sweeps, scenes, arguments.study, arguments.out)
    with open(file + ".part", "w", encoding="utf-8") as stream:
        stream.write(text)
    os.replace(file + ".part", file)
    print(file)
    return 0


if __name__ == "__main__":
    try:
        raise SystemExit(run_script(main))
    except jinja2.TemplateError as error:
        raise SystemExit(f"bug in the page's template: {error}")
