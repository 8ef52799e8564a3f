# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Reports of a comparison that did not come about: junit.xml with an error, and verdict.md.

    python3 scripts/ci/outcome.py FOLDER STEP MESSAGE LOG"""

import os
import re
import sys
from xml.sax.saxutils import escape, quoteattr

LAST_LINES = 40  # of the log: where compilers and programs say what went wrong
NOT_OF_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd]")


def last_lines(text):
    return NOT_OF_XML.sub("?", "\n".join(text.splitlines()[-LAST_LINES:]))


def write_reports(folder, step, kind, word, message, details):
    message, tail = NOT_OF_XML.sub("?", message), last_lines(details)
    with open(os.path.join(folder, "junit.xml"), "w", encoding="utf-8") as stream:
        stream.write('<?xml version="1.0" encoding="UTF-8"?>\n<testsuite name="lmdbench compare" tests="1" '
                     f'failures="{int(kind == "failure")}" skipped="0" errors="{int(kind == "error")}">\n'
                     f'  <testcase classname="lmdbench.compare" name={quoteattr(step)}><{kind} type="{word}" '
                     f'message={quoteattr(message)}>{escape(tail)}</{kind}></testcase>\n</testsuite>\n')
    with open(os.path.join(folder, "verdict.md"), "w", encoding="utf-8") as stream:
        stream.write(f"**{word}: {message}**\n" + (f"\n```\n{tail}\n```\n" if tail else ""))


def write_error(folder, step, message, log):
    """What a `step` ("candidate, build") of a comparison broke on, and the end of its log."""
    write_reports(folder, step, "error", "broken", message, log)


def write_failure(folder, step, message):
    """A candidate that behaves otherwise in a way that no table of `lmdbench compare` shows."""
    write_reports(folder, step, "failure", "changed", message, "")


def main(words):
    folder, step, message, log = words
    try:
        with open(log, encoding="utf-8", errors="replace") as stream:
            text = stream.read()
    except OSError as error:
        text = str(error)
    write_error(folder, step, message, text)


if __name__ == "__main__":
    main(sys.argv[1:])
