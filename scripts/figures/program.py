# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Calls of the program."""

import json
import resource
import subprocess

from lmdbench_results import ResultError

PROGRAM = "build/release/lmdbench"


def settings_words(settings):
    """What changes an experiment, {JSON pointer: value}, as the command line wants it."""
    return [word for pointer, value in settings.items() for word in ("--set", f"{pointer}={json.dumps(value)}")]


def failure(command, code, errors):
    return ResultError(f"{' '.join(command)}: exit code {code}\n{errors}")


def printed(command, allowed=(0,)):
    """What a command prints that leaves with one of these exit codes."""
    done = subprocess.run(command, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)
    if done.returncode not in allowed:
        raise failure(command, done.returncode, done.stderr)
    return done.stdout


def timed(command, allowed=(0,)):
    """What a command prints, and its processor time (user and system) [s], which does not depend on what else the machine does."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    text = printed(command, allowed)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return text, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def answer(command, words=None):
    """What a command prints; where it fails, its own message is the error's. @param words its standard input"""
    done = subprocess.run(command, input=words, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise ResultError(done.stderr.strip())
    return done.stdout
