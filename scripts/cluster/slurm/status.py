#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Says "running", "success" or "failed" of a Slurm job, as Snakemake 7 asks it (--cluster-status). Without Slurm's accounting: a
job that the controller has forgotten has succeeded where what it had to leave is there. A controller that does not answer is no
failure of the job.

    status.py JOB"""

import os
import subprocess
import sys
import time

from job_notes import append_log, read_note, write_note

SUCCESS = {"COMPLETED"}
# Slurm requeues jobs of a failed node (sbatch --requeue): only jobs in other states failed.
RUNNING = {"PENDING", "CONFIGURING", "RUNNING", "COMPLETING", "SUSPENDED", "REQUEUED", "REQUEUE_FED", "RESIZING", "SIGNALING",
           "STAGE_OUT", "STOPPED"}
FORGOTTEN = "Invalid job id"
TRIES, PAUSE_S = 3, 1.0


def ask_slurm(job):
    """Fields of `scontrol show job`; empty where Slurm does not know it any more; None where it does not answer."""
    for attempt in range(TRIES):
        done = subprocess.run(["scontrol", "show", "job", "--oneliner", job], capture_output=True, text=True, check=False)
        if done.returncode == 0:
            return dict(field.split("=", 1) for field in done.stdout.split() if "=" in field)
        if FORGOTTEN in done.stderr:
            return {}
        if attempt + 1 < TRIES:
            time.sleep(PAUSE_S)
    return None


def held(fields):
    """After a failed start Slurm holds a job until somebody releases it."""
    return fields.get("JobState") in ("REQUEUE_HOLD", "SPECIAL_EXIT") or fields.get("Reason", "").startswith("launch_failed")


def verdict(fields, note):
    if fields is None:
        return "running"
    if not fields:
        return "success" if note and os.path.exists(note["marker"]) else "failed"
    state = fields.get("JobState", "")
    if held(fields):
        return "failed"
    if state in SUCCESS:
        return "success"
    return "running" if state in RUNNING else "failed"


def main():
    job = sys.argv[1]
    note, fields = read_note(job), ask_slurm(job)
    said = verdict(fields, note)
    if note:
        restarts = int((fields or {}).get("Restarts", note["restarts"]))
        if restarts > note["restarts"]:
            append_log(note["marker"], f"job {job}: {note['what']}: lost its node, done again (restart {restarts})")
            write_note(job, {**note, "restarts": restarts})
        if said == "failed":
            append_log(note["marker"], f"job {job}: {note['what']}: failed ({(fields or {}).get('JobState', 'forgotten')})")
    if fields and held(fields):
        subprocess.run(["scancel", job], check=False)
    print(said)


if __name__ == "__main__":
    main()
