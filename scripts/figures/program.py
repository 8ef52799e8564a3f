# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Calls of the program."""

import json
import resource
import subprocess

from lmdbench_results import EXIT_ENVIRONMENT, ResultError

PROGRAM = "build/release/lmdbench"


def settings_words(settings):
    """What changes an experiment, {JSON pointer: value}, as the command line wants it."""
    return [word for pointer, value in settings.items() for word in ("--set", f"{pointer}={json.dumps(value)}")]


EXIT_BUG = 70


class ProgramError(ResultError):
    """What went wrong in a call of the program, with its exit code, which is the script's, too."""

    def __init__(self, message, exit_code):
        super().__init__(message)
        self.exit_code = exit_code if exit_code >= 0 else EXIT_BUG  # below 0: a signal


def failure(command, code, errors):
    return ProgramError(f"{' '.join(command)}: exit code {code}\n{errors}", code)


def finished(command, **options):
    try:
        return subprocess.run(command, capture_output=True, text=True, check=False, **options)
    except OSError as error:
        raise ProgramError(f"{command[0]}: cannot be started: {error.strerror} (remedy: build it, or name it with --program)", EXIT_ENVIRONMENT) from None


def printed(command, allowed=(0,)):
    """What a command prints that leaves with one of these exit codes."""
    done = finished(command, stdin=subprocess.DEVNULL)
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
    done = finished(command, input=words)
    if done.returncode != 0:
        raise ProgramError(done.stderr.strip() or str(failure(command, done.returncode, "")), done.returncode)
    return done.stdout
