#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Submits a job script of Snakemake 7 to Slurm and prints the job's number. Notes in the piece's folder what the job is, for
status.py: Slurm forgets a finished job after a while.

    submit.py JOBSCRIPT"""

import json
import os
import subprocess
import sys

from job_notes import append_log, write_note


def properties_of(jobscript):
    """Snakemake's own, in a comment of the script."""
    with open(jobscript, encoding="utf-8") as stream:
        for line in stream:
            if line.startswith("# properties = "):
                return json.loads(line.split("=", 1)[1])
    raise SystemExit(f"error: {jobscript}: holds no properties of a job (remedy: call it by snakemake --cluster)")


def sbatch_command(properties, jobscript):
    resources = properties.get("resources", {})
    marker = properties["output"][0]
    command = ["sbatch", "--parsable", "--requeue", "--open-mode=append", "--job-name", "lmdbench-" + properties["rule"],
               "--cpus-per-task", str(properties.get("threads", 1)), "--output", os.path.join(os.path.dirname(marker), "slurm-%j.log")]
    for option, name in (("--mem", "mem_mb"), ("--time", "runtime")):
        if name in resources:
            command += [option, str(resources[name])]
    return [*command, jobscript]


def main():
    jobscript = sys.argv[1]
    properties = properties_of(jobscript)
    done = subprocess.run(sbatch_command(properties, jobscript), stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(done.returncode)
    job = done.stdout.strip().split(";")[0]  # a federation adds the cluster's name
    marker = properties["output"][0]
    what = properties.get("params", {}).get("what", properties["rule"])
    write_note(job, {"marker": os.path.abspath(marker), "what": what, "restarts": 0})
    append_log(marker, f"job {job}: {what}: submitted")
    print(job)


if __name__ == "__main__":
    main()
