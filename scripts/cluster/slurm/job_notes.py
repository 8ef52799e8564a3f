# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""What submit.py knew of a job and status.py asks for again; and the log of what became of jobs, jobs.log beside the journals."""

import json
import os
import time
from pathlib import Path

FOLDER = os.path.join(".snakemake", "lmdbench-jobs")


def _place(job):
    return os.path.join(FOLDER, f"{int(job)}.json")


def write_note(job, note):
    os.makedirs(FOLDER, exist_ok=True)
    Path(_place(job) + ".new").write_text(json.dumps(note), encoding="utf-8")
    os.replace(_place(job) + ".new", _place(job))


def read_note(job):
    """None where nobody noted anything."""
    try:
        return json.loads(Path(_place(job)).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None


def append_log(marker, line):
    with open(os.path.join(os.path.dirname(marker), "jobs.log"), "a", encoding="utf-8") as stream:
        stream.write(time.strftime("%Y-%m-%dT%H:%M:%SZ ", time.gmtime()) + line + "\n")
