# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""What came of a comparison: evidence in, one verdict out. Every thing that was looked at is a check with a word of its own, the
verdict is the worst of these words, and console, verdict.md, junit.xml and exit code are all written from the same checks.

    python3 scripts/ci/outcome.py FOLDER SIDE STEP MESSAGE LOG

is the outcome where a program did not even come to be: what a step ("build") of a side ("base", "candidate") broke on."""

import argparse
import collections
import dataclasses
import itertools
import json
import os
import re
import statistics
import sys
from xml.etree import ElementTree

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "figures"))

import tables  # noqa: E402

# The worst first.
EXIT_CODES = {"no comparison": 3, "broken": 1, "changed": 1, "slower": 1, "unsure": 4, "faster": 0, "same": 0}
NOT_JUDGED = "not judged"  # judgements that were left out
OF_JUNIT = {"no comparison": "error", "broken": "error", "changed": "failure", "slower": "failure", "unsure": "skipped", NOT_JUDGED: "skipped"}
LAST_LINES = 40  # of a log: here compilers and programs report errors
LONGEST_VALUE = 100
NOT_OF_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd]")

DIFFERENCES = ("method", "dataset", "frame", "base", "candidate")
INSTRUCTIONS = ("instructions of", "base", "candidate", "change", "frames", "verdict")
TIMES = ("method", "stage", "base [us]", "candidate [us]", "ratio", "interval", "detectable", "verdict")

Failure = collections.namedtuple("Failure", "side step message log")
# The verdict on times (regression.py), why, and the (method, stage) pairs confirmed as slower.
Times = collections.namedtuple("Times", "word why confirmed")
# A test case of junit.xml, with its rows of a table under these headings.
Check = collections.namedtuple("Check", "group name word message headings rows details", defaults=((), (), ""))


@dataclasses.dataclass
class Evidence:
    """All that is known; None for what was not looked at."""
    failure: Failure = None  # why there are no results
    other_experiment: str = None  # the judge's message
    answer: dict = None  # of the judge over all rounds: `lmdbench compare --json`
    seconds: dict = None  # by side and name (regression.seconds): one number a process
    instructions: list = None  # (function, base, candidate)
    counted: tuple = None  # frames whose instructions were counted, and how many of them are in contact
    not_counted: str = "results differ, or --instructions 0"
    share: float = 0.01  # of instructions: the least that matters
    times: Times = None


def failure_checks(failure):
    word = "broken" if failure.side == "candidate" else "no comparison"
    return [Check(failure.side, failure.step, word, failure.message, details="\n".join(failure.log.splitlines()[-LAST_LINES:]))]


def shown(value):
    text = "NaN" if value is None else json.dumps(value)
    return text if len(text) <= LONGEST_VALUE else text[:LONGEST_VALUE] + "..."


def result_checks(evidence):
    group, name = "results", "forces, LMD sets and counters"
    if evidence.other_experiment:
        return [Check(group, name, "changed", "the candidate makes another experiment of the same scene file; " + evidence.other_experiment)]
    rows = [(d["method"] or "", f"`{d['dataset']}`", "" if d["frame"] is None else d["frame"], shown(d["base"]), shown(d["candidate"]))
            for d in evidence.answer["differences"]]
    if not rows:
        return [Check(group, name, "same", "the same bits")]
    sentences = [f"{method}: {dataset} differs{f' in frame {frame}' if frame != '' else ''}: {base} became {candidate}"
                 for method, dataset, frame, base, candidate in rows]
    message = "results or counters differ: " + sentences[0] + (f" (and {len(rows) - 1} more)" if len(rows) > 1 else "")
    return [Check(group, name, "changed", message, DIFFERENCES, rows, "\n".join(sentences))]


def instruction_checks(evidence):
    if not evidence.instructions:
        return [Check("instructions", "callgrind", NOT_JUDGED, "instructions were not counted: " + evidence.not_counted)]
    checks = []
    frames = "first {}, {} in contact".format(*evidence.counted) if evidence.counted else "unknown"
    for function, base, candidate in evidence.instructions:
        if base and candidate:
            change = f"{100 * (candidate / base - 1.0):+.2f} %"
            blind = evidence.counted and evidence.counted[1] == 0  # what matters was not looked at
            word = "slower" if candidate > base * (1.0 + evidence.share) else NOT_JUDGED if blind else "same"
            message = f"{change} instructions in {function}, counted by callgrind (frames: {frames})"
        else:
            change, word, message = "-", NOT_JUDGED, f"only the {'base' if base else 'candidate'} has {function}"
        checks.append(Check("instructions", function, word, message, INSTRUCTIONS, [(function, base or "-", candidate or "-", change, frames, word)]))
    return checks


def time_checks(evidence):
    """The rule's own word first; no stage's can be worse. A stage that looks slower and was not confirmed is a suspect, no more."""
    checks = []
    if evidence.times:
        checks.append(Check("times", "all stages", evidence.times.word, evidence.times.why))
    for t in evidence.answer["timings"]:
        method, stage = t["method"], t["stage"]
        interval = "unknown" if t["low"] is None else f"{t['low']:.3f} to {tables.shown(t['high'], 4)}"
        message = f"{t['ratio']:.3f} times the base's time (interval {interval})"
        if not evidence.times:
            word, message = NOT_JUDGED, message + "; other evidence decided before times were judged"
        elif (method, stage) in evidence.times.confirmed:
            word, message = "slower", message + ", confirmed by fresh rounds"
        elif t["verdict"] == "slower":
            word, message = "unsure", message + "; looks slower, which fresh rounds did not confirm"
        else:
            word = t["verdict"]
        seconds = [evidence.seconds[side].get(f"{method}/{stage}".replace(" ", "_")) if evidence.seconds else None for side in ("base", "candidate")]
        row = (method, stage, *(f"{1e6 * statistics.median(values):.4g}" if values else "-" for values in seconds), f"{t['ratio']:.3f}", interval,
               "-" if t["detectable"] is None else f"{100 * t['detectable']:.2g} %", word)
        checks.append(Check(method, stage, word, message, TIMES, [row]))
    return checks


def checks_of(evidence):
    if evidence.failure:
        return failure_checks(evidence.failure)
    if evidence.other_experiment:
        return result_checks(evidence)
    return result_checks(evidence) + instruction_checks(evidence) + time_checks(evidence)


def verdict_of(checks):
    return next(word for word in EXIT_CODES if any(check.word == word for check in checks))


def reason_of(evidence, checks):
    """The rule on times is asked only where nothing else decides."""
    word = verdict_of(checks)
    reason = evidence.times.why if evidence.times else "; ".join(check.message for check in checks if check.word == word)
    return " ".join(reason.split())


def junit_of(checks):
    counts = collections.Counter(OF_JUNIT.get(check.word) for check in checks)
    suite = ElementTree.Element("testsuite", name="lmdbench compare", tests=str(len(checks)), failures=str(counts["failure"]),
                                errors=str(counts["error"]), skipped=str(counts["skipped"]))
    for check in checks:
        case = ElementTree.SubElement(suite, "testcase", classname="lmdbench.compare." + check.group, name=check.name)
        if check.word in OF_JUNIT:
            told = ElementTree.SubElement(case, OF_JUNIT[check.word], type=check.word, message=NOT_OF_XML.sub("?", check.message))
            told.text = NOT_OF_XML.sub("?", check.details)
    ElementTree.indent(suite)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + ElementTree.tostring(suite, encoding="unicode") + "\n"


def markdown_of(evidence, checks):
    lines = [f"**{verdict_of(checks)}: {reason_of(evidence, checks)}**", ""]
    for headings, alike in itertools.groupby(checks, lambda check: check.headings):
        if headings:
            lines += tables.table(headings, [row for check in alike for row in check.rows])
    lines += [f"- {check.message}" for check in checks if check.word == NOT_JUDGED and not check.rows]
    for side, notes in (("machines", "reasons"), ("builds", "build_notes")):
        lines += [f"- {side} differ: {note}" for note in (evidence.answer or {}).get("machine", {}).get(notes, [])]
    if evidence.failure:
        lines += ["```", checks[0].details, "```"]
    return "\n".join(lines).rstrip("\n") + "\n"


def tell(evidence, folder, effort=""):
    """Console, verdict.md and junit.xml in `folder`; the exit code. `effort`: what the verdict took, in words."""
    checks = checks_of(evidence)
    word = verdict_of(checks)
    line = f"verdict: {word} ({reason_of(evidence, checks)}){effort}"
    text = f"{markdown_of(evidence, checks)}\n{line}\n"
    tables.write_text(text, folder, "verdict.md")
    tables.write_text(junit_of(checks), folder, "junit.xml")
    print(text, end="", flush=True)
    return EXIT_CODES[word]


def main(words=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("folder", "side", "step", "message", "log"):
        parser.add_argument(name)
    arguments = parser.parse_args(words)
    try:
        with open(arguments.log, encoding="utf-8", errors="replace") as stream:
            text = stream.read()
    except OSError as error:
        text = str(error)
    code = tell(Evidence(failure=Failure(arguments.side, arguments.step, arguments.message, text)), arguments.folder)
    print(f"the whole log: {arguments.log}", file=sys.stderr)
    return code


if __name__ == "__main__":
    sys.exit(main())
