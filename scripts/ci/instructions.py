# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Instructions that two builds spend in the methods' searches and trackings, counted by callgrind: equal within 2 in 100,000 from
run to run (addresses of memory), whatever else the machine does. Valgrind knows no AVX-512 and tells programs so, so the kernels
that choose their instructions at run time take their AVX2 form: a change of an AVX-512 form alone does not show here."""

import os
import re
import shutil
import subprocess

FUNCTION = re.compile(r"^ *([0-9,]+) .*:lmdbench::([A-Za-z]+::(?:search|track))\(lmdbench::Pose", re.MULTILINE)
CONTACT = re.compile(r"([0-9]+) frames, ([0-9]+) in contact")
# One repetition has the same counts as many. Recorded scenes begin with up to 730 free frames.
SHORTENED = ("/driver/repetitions=1", "/probes/truth/stride_frames=0", "/probes/fcl/stride_frames=0", "/frames=1600")


class NotCounted(Exception):
    """Why there are no counts, and what helps."""


def count(program, scene, folder, name, root):
    """{"Method::function": instructions} of one run, and (frames, of them in contact), None if it does not tell; leaves NAME.log and NAME.callgrind in `folder`."""
    log, counts, out = (os.path.join(folder, name + ending) for ending in (".log", ".callgrind", ".h5"))
    for left in (out, out + ".part"):  # of a call that was interrupted
        if os.path.exists(left):
            os.remove(left)
    # Without address randomisation sizes of hash tables and alignments are the same, too.
    command = ["setarch", "--addr-no-randomize", "valgrind", "--tool=callgrind", "--callgrind-out-file=" + counts, program,
               "run", *scene, *(word for pair in SHORTENED for word in ("--set", pair)), "--out", out]
    with open(log, "w", encoding="utf-8") as stream:
        done = subprocess.run(command, cwd=root, stdin=subprocess.DEVNULL, stdout=stream, stderr=stream, check=False)
    if done.returncode != 0:
        raise NotCounted(f"callgrind failed on {program}, see {log}")
    annotated = subprocess.run(["callgrind_annotate", "--inclusive=yes", "--threshold=100", counts], capture_output=True, text=True, check=False)
    found = {}
    for instructions, function in FUNCTION.findall(annotated.stdout):  # the most first
        found.setdefault(function, int(instructions.replace(",", "")))
    if not found:
        raise NotCounted(f"callgrind saw no search in {program} (remedy: keep its symbols)")
    with open(log, encoding="utf-8", errors="replace") as stream:
        told = CONTACT.search(stream.read())
    return found, told and tuple(map(int, told.groups()))


def compared(base, candidate, scene, folder, root):
    """[(function, base's instructions, candidate's)], None where a side has no such function, and the frames as `count` has them; `scene`:
    experiment and overrides, as `lmdbench run` has them."""
    if shutil.which("valgrind") is None:
        raise NotCounted("no valgrind (remedy: ./scripts/setup.sh)")
    os.makedirs(folder, exist_ok=True)
    (before, frames), (after, _) = (count(program, scene, folder, name, root) for program, name in ((base, "base"), (candidate, "candidate")))
    return [(function, before.get(function), after.get(function)) for function in sorted(before | after)], frames
