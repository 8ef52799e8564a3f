#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The page of one or more results: DIR/index.html, one file that needs no network, and its figures as SVG and PNG beside
it. `lmdbench report` calls this with the scenes of the results; everything else comes from the result files alone."""

import argparse
import ctypes
import html
import json
import os
import re
import signal
import sys
from pathlib import Path

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "figures"))

import interpreter  # noqa: E402, F401  (in the figures' folder; chooses one that has what follows)

import jinja2  # noqa: E402
import markupsafe  # noqa: E402

from answer import answer  # noqa: E402
from claims_section import claims_of, evidence  # noqa: E402
from lmdbench_results import no_truth, refuse_foreign, run_script, truth_of  # noqa: E402
from page_data import page_colours, panels_of  # noqa: E402
from page_figures import figures, probed  # noqa: E402
from paper_figures import paper_figures  # noqa: E402
from scene_data import scene  # noqa: E402
from studies import FIRST, studies as study_sections  # noqa: E402
from sweep_results import Sweep, is_sweep  # noqa: E402
from tables import write_text  # noqa: E402
from variants import open_results, refuse_twice, tell_apart  # noqa: E402

PR_SET_PDEATHSIG = 1  # <linux/prctl.h>
JAVASCRIPT = "/usr/share/javascript"
LIBRARIES = (("three/three.min.js", "libjs-three"), ("three/examples/js/controls/OrbitControls.js", "libjs-three"),
             ("dygraphs/dygraph.min.js", "libjs-dygraphs"), ("dygraphs/src/extras/synchronizer.js", "libjs-dygraphs"))
STYLES = (("dygraphs/dygraph.min.css", "libjs-dygraphs"),)


def text_of(*path):
    return Path(*path).read_text(encoding="utf-8")


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


def json_in_script(data):
    """Names in it may begin a comment or a tag, and none of that may be seen before it is parsed."""
    return json.dumps(data, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")


def code(text):
    """What stands in backticks, set as code."""
    return markupsafe.Markup(re.sub(r"`([^`]+)`", r"<code>\1</code>", str(plain(text))))


def plain(text):
    """As an element's text, where quotes need no escape."""
    return markupsafe.Markup(html.escape(str(text), quote=False))


def title_of(results, sweeps):
    """What the page is about; of several experiments the names, which are shorter than their titles."""
    titles = list(dict.fromkeys(result.experiment.get("title") or result.experiment_name for result in results))
    return titles[0] if len(titles) == 1 else " and ".join(dict.fromkeys([result.experiment_name for result in results] or [sweep.title for sweep in sweeps]))


def what_was_run(result):
    methods = ", ".join(method.label for method in result.methods.values())
    probed = next((truth_of(method) for method in result.methods.values() if truth_of(method)), None)
    truth = f"errors against exhaustive truth (every pair of features) in {probed.frames.size} probed frames" if probed else no_truth(result)
    cutoffs, largest = (" and ".join(dict.fromkeys(f"{method.constant(name) * scale:.4g}" for method in result.methods.values()))
                        for name, scale in (("cutoff_m", 1e3), ("maximum_force_n", 1.0)))
    loop = "in a closed loop, in which every method moves a simulated device of its own" if result.experiment.get("loop", {}).get("kind") == "closed" else ""
    return (f"{result.time.size} frames{loop and ' ' + loop}, {result.triangles()} triangles, cutoff {cutoffs} mm (forces begin at this distance), F_max {largest} N (the largest force of one "
            f"contact); methods {methods}"
            f"{searches(result)}; {truth}.")


def searches(result):
    """When sets of methods that track are searched anew; nothing on the machine's clock, where each search is due when the last one is done."""
    tracking, driver = [method.label for method in result.methods.values() if method.tracks_locally], result.experiment.get("driver", {})
    if not tracking or driver.get("kind") == "realtime" or not {"search_every_frames", "search_latency_frames"} <= driver.keys():
        return ""
    return (f" ({' and '.join(tracking)}: a search begins every {driver['search_every_frames']} frames and its contacts are in use "
            f"{driver['search_latency_frames']} frames later; in between they are tracked)")


def clipping_beside(result, warnings):
    """The run's note names a method whose force is clipped often; the others that are clipped, too."""
    if not any("clips the force" in warning for warning in warnings):
        return []
    shares = {method.label: method.number("force_clipped_share") for method in result.methods.values()
              if not any(warning.startswith(f"{method.label}: ") and "clips the force" in warning for warning in warnings)}
    others = [f"{label} in {100.0 * share:.2g} %" for label, share in shares.items() if share > 0.0]
    return [f"The force of other methods is clipped, too: {', '.join(others)} of the frames in contact"] if others else []


def notes_of(result):
    warnings = result.texts("/scene/warnings") if result.has("/scene/warnings") else []
    return warnings + clipping_beside(result, warnings)


def in_words(name, value):
    """A key of the provenance and its value, as one reads them."""
    if name.endswith("_bytes") and str(value).isdigit():
        unit, scale = ("MiB", 2**20) if int(value) >= 2**20 else ("KiB", 2**10)
        name, value = name.removesuffix("_bytes"), f"{int(value) / scale:,.0f} {unit}"
    if not name.startswith("result hash: "):  # a label is what it is
        name = re.sub(r"\bl(\d)\b", r"L\1", name.replace("_", " "))
    return name, value


def provenance(result):
    root = result.h5["/provenance"].attrs
    rows = [(name, result.text_attribute("/provenance", name)) for name in sorted(root)]
    rows += [(f"machine: {name}", value) for name, value in sorted(result.machine().items())]
    if result.has("/provenance/inputs/role"):
        rows += [(f"input: {role}", f"{file}, SHA-256 {digest}") for role, file, digest in
                 zip(*(result.texts(f"/provenance/inputs/{name}") for name in ("role", "file", "sha256")))]
    rows += [(f"result hash: {label}", result.text_attribute(f"/methods/{label}", "result_hash")) for label in result.methods]
    return [in_words(name, value) for name, value in rows if value]


def sweep_provenance(sweep):
    rows = [*sorted(sweep.provenance.items()), *((f"machine: {name}", value) for name, value in sorted(sweep.machine.items()))]
    return {"name": sweep.name, "provenance": [in_words(name, value) for name, value in rows if value], "experiment": sweep.definition}


PAPERS_OMISSION = ("The paper states neither force constants, cutoffs, saturation distance, paths nor the exact meshes: they are ours, and stand in "
                   "the experiment under Provenance.")
OMISSIONS = (
    "Times are of one machine and one process a result: compare methods within a result, not results of different machines.",
    "A time is the median of the repetitions of its frame; the largest frame is the largest of these medians, not of all samples.",
    "In a run truth is probed at a stride: events between the probed frames are not seen by recall, precision and force error. Jumps of "
    "the true force are counted in all frames if one of the methods promises the complete set, else in the probed frames. A sweep knows truth in every frame.",
    "Forces are sums over the LMDs, as in the paper: they jump by up to F_max where an LMD is born or dies. Another aggregation (shared, signed, layered) "
    "stands in the column of the force law.",
    "Force errors are against the true set under the same aggregation; methods that find no saddles (original, improved, nearest) are always summed.",
    "The methods run in one thread and take turns, block by block, in random order; with the driver `realtime` each has a run to itself.",
    "The paper's methods are scalar code. Whether another method uses vector instructions is told by its options in the experiment, if at all: the "
    "fair comparison is by the work counters in the result file.",
)


def navigation(entries, results, studies, claims, paper):
    """Every section of the page in its order; the tables that nobody looks for by name share one entry."""
    of_runs = [{"id": "frames", "title": "Frame by frame"}, {"id": "scene", "title": "In space"}] if results else []
    of_paper = ([{"id": "claims", "title": "The paper's claims"}] if claims else []) + ([{"id": "paper", "title": "Figures 1 to 6"}] if paper else [])
    first = [{"id": entry["id"], "title": entry["name"].replace("-", " ").capitalize()} for entry in studies if entry["name"] in FIRST]
    more = [{"id": "more", "title": "More tables"}] if len(first) < len(studies) else []
    return [{"id": "answer", "title": "Answer"}, *entries, *of_runs, *of_paper, *first, *more, {"id": "omissions", "title": "What is left out"},
            {"id": "provenance", "title": "Provenance"}]


def page(results, sweeps, scenes, study_files, by_paper, paper, folder):
    raw = markupsafe.Markup
    entries = [{**entry, "html": raw(entry["html"])} for entry in figures(results, sweeps, folder, by_paper)]
    studies = [{**entry, "html": raw(entry["html"])} for entry in study_sections(study_files)]
    printed = [entry for entry in entries if entry["id"] == "over_time"]  # stands with the plots to zoom
    entries = [entry for entry in entries if entry not in printed]
    claims = claims_of(results) if by_paper and results else {}
    sections = navigation(entries, results, studies, claims, paper)
    linked = [(claim, evidence(claim.id, [*sections, *studies])) for claim in claims.get("claims", [])]
    data = {"results": panels_of(results), "scenes": scenes,
            "colours": [page_colours(result) for result in results], "tables": {entry["id"]: entry["csv"] for entry in entries}}
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE), autoescape=True, undefined=jinja2.StrictUndefined)
    environment.filters.update(code=code, plain=plain)
    titles = [result.experiment.get("title") for result in results]
    described = [{"name": result.name, "what": (f"{title}. " if title and len(set(titles)) > 1 else "") + what_was_run(result), "answer": answer(result), "provenance": provenance(result),
                  "experiment": json.dumps(result.experiment, indent=2),
                  "warnings": notes_of(result)} for result, title in zip(results, titles)]
    return environment.get_template("page.html.j2").render(
        title=title_of(results, sweeps),
        results=described, movers=any(result.has("/path/movers/position") for result in results),
        probed=bool(probed(results)), sections=sections, provenances=[*described, *map(sweep_provenance, sweeps)],
        figures=entries, printed=printed, by_paper=by_paper, paper=paper, studies=studies, first_studies=FIRST, claims=claims, linked_claims=linked,
        omissions=[PAPERS_OMISSION, *OMISSIONS] if by_paper else OMISSIONS, style=raw(text_of(HERE, "page.css")),
        libraries={"script": raw(in_script("\n".join(library(*item) for item in LIBRARIES))),
                   "style": raw("\n".join(library(*item) for item in STYLES))},
        script=raw(in_script(text_of(HERE, "page.js") + text_of(HERE, "scene.js"))),
        data=raw(json_in_script(data)))


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", nargs="+", metavar="RESULT.h5",
                        help="what `lmdbench run` or `lmdbench work-precision` wrote")
    parser.add_argument("--out", required=True, metavar="DIR", help="folder of index.html and of its figures")
    parser.add_argument("--scenes", metavar="DIR", help="folder with a scene for each result, 0, 1, ...; sweeps count")
    parser.add_argument("--study", nargs="*", default=[], metavar="FILE.md", help="tables of studies to show as well")
    parser.add_argument("--paper", nargs="?", const="", metavar="DIR", help="hold the results against the paper: its Figure 7, its claims and, "
                        "of a folder, its Figures 1 to 6 (scripts/figures/figure1.py to figure6.py)")
    arguments = parser.parse_args(argv)
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGTERM)  # a page that nobody waits for is not written
    refuse_twice(arguments.results)
    sweeps = tell_apart([Sweep(file) for file in arguments.results if is_sweep(file)])
    runs = [(i, file) for i, file in enumerate(arguments.results) if not is_sweep(file)]
    results = open_results([file for _, file in runs])
    folders = [os.path.join(arguments.scenes, str(i)) if arguments.scenes else None for i, _ in runs]
    scenes = [scene(result, folder) for result, folder in zip(results, folders)]
    os.makedirs(arguments.out, exist_ok=True)
    refuse_foreign(os.path.join(arguments.out, "index.html"), "page", b'content="lmdbench report"', b"<title>lmdbench")
    paper = paper_figures(arguments.paper) if arguments.paper else []
    text = page(results, sweeps, scenes, arguments.study, arguments.paper is not None, paper, arguments.out)
    print(write_text(text, arguments.out, "index.html"))
    return 0


if __name__ == "__main__":
    try:
        raise SystemExit(run_script(main))
    except jinja2.TemplateError as error:
        raise SystemExit(f"bug in the page's template: {error}")
