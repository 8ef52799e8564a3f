# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Feeds the program damaged files of every format it reads: bytes flipped, ends cut off, pieces of other files put in,
numbers made extreme, lines taken away and doubled, path specifications beyond what can be reached. Every case must end
with an exit code of the contract, within its processor time, by no signal; a refusal names the file and a remedy in
printable text. The same seed makes the same files. The rows of named hostile inputs are in hostile_input_test.cpp.

    hostile_set.py PROGRAM SOURCE_FOLDER [--count N] [--seed S] [--format NAME]... [--keep FOLDER]
"""

import argparse
import collections
import json
import os
import pathlib
import random
import re
import resource
import signal
import subprocess
import sys
import tempfile

EXIT_CODES = {0, 2, 3, 4}
PROCESSOR_SECONDS = 20  # of a process and its children; what hangs is ended by the system
PATH_SECONDS = 3        # for path specifications, in place of ten minutes
WALL_SECONDS = 300      # of what neither works nor ends: it waits for something
CONTROL = re.compile(rb"[\x00-\x08\x0b-\x1f\x7f]")
# Experiments and sweeps name other files: an error may name one of those, even by a damaged name.
FILE_NAME = re.compile(rb"error: [^ ]+\.[^ /]+: ")
NUMBERS = [b"0", b"-1", b"1e308", b"-1e308", b"1e-310", b"1e999", b"nan", b"inf", b"2147483647", b"4294967296",
           b"9223372036854775807", b"18446744073709551614", b"0.5", b"1e-9", b"1000000", b"\xff", b"", b"0x10", b"1,5"]


class Format:
    def __init__(self, name, suffix, corpus, command, strip=0, pick=None, where="{file}"):
        self.name, self.suffix, self.command, self.where = name, suffix, command, where
        folder = CORPUS / corpus
        self.files = [path.read_bytes()[strip:] for path in sorted(folder.iterdir()) if pick is None or path.name in pick]
        assert self.files, name


def mutated(content, others, rng):
    data = bytearray(content)
    kind = rng.choice(["flip", "flip", "cut", "splice", "number", "number", "lines"])
    if kind == "flip" and data:
        for _ in range(rng.randint(1, 8)):
            data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)
    elif kind == "cut" and data:
        del data[rng.randrange(len(data)):]
    elif kind == "splice":
        other = rng.choice(others)
        begin = rng.randrange(len(other) + 1)
        at = rng.randrange(len(data) + 1)
        data[at:at + rng.choice([0, 0, 20])] = other[begin:begin + rng.randint(1, 200)]
    elif kind == "number":
        found = list(re.finditer(rb"-?[0-9]+(\.[0-9]+)?(e-?[0-9]+)?", data))
        for match in sorted(rng.sample(found, min(len(found), rng.randint(1, 3))), key=lambda m: -m.start()):
            data[match.start():match.end()] = rng.choice(NUMBERS)
    elif kind == "lines":
        lines = bytes(data).split(b"\n")
        at = rng.randrange(len(lines))
        lines[at:at + 1] = rng.choice([[], [lines[at]] * 2, [lines[at]] * 300, [rng.choice(lines)]])
        data = bytearray(b"\n".join(lines))
    return bytes(data)


def wild_specification(rng):
    """A path specification that is no nonsense by its types: gaps, sizes and rates of any magnitude."""
    def magnitude(low, high):
        return float("%.3g" % 10 ** rng.uniform(low, high))
    meshes = ["sphere", "torus", "box", "blob", "l-block"]
    count = rng.randint(2, 5)
    floor = rng.choice([0, magnitude(-12, -2)])
    times = sorted({0.0, *(magnitude(-3, 2) for _ in range(count))})
    spec = {"moving": {"mesh": rng.choice(meshes), "diagonal_m": magnitude(-8, 8)},
            "fixed": {"mesh": rng.choice(meshes), "diagonal_m": magnitude(-8, 8)},
            "frame_rate_hz": rng.choice([1000, magnitude(0, 5)]), "seed": rng.randrange(2**63),
            "slide_rate_deg_per_s": magnitude(-3, 6), "turn_rate_deg_per_s": magnitude(-3, 6),
            "radial_speed_m_per_s": magnitude(-9, 6), "radial_acceleration_m_per_s2": magnitude(-9, 6),
            "gap_floor": floor, "gaps": [{"time_s": t, "gap": floor + magnitude(-9, 6)} for t in times]}
    return json.dumps(spec).encode()


def run(argv, folder):
    """(exit code or minus the signal, output, errors, processor seconds)."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)

    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (PROCESSOR_SECONDS, PROCESSOR_SECONDS + 1))

    try:
        done = subprocess.run(argv, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, timeout=WALL_SECONDS,
                              preexec_fn=limit, check=False)
        outcome = done.returncode, done.stdout, done.stderr
    except subprocess.TimeoutExpired as error:
        outcome = -signal.SIGALRM, b"", error.stderr or b""
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return *outcome, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def problem_of(code, errors, seconds, name):
    if code < 0:
        return f"ended by signal {-code}"
    if code not in EXIT_CODES:
        return f"exit code {code}"
    if seconds > PROCESSOR_SECONDS:
        return f"took {seconds:.1f} s of processor time"
    if CONTROL.search(errors):
        return "control characters in the message"
    if code != 0 and b"remedy: " not in errors:
        return "a refusal without a remedy"
    if code != 0 and name.encode() not in errors and not FILE_NAME.search(errors):
        return "the message names no file"
    return None


def main():
    global CORPUS
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("program")
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=300, help="cases of each format")
    parser.add_argument("--seed", type=int, default=14)
    parser.add_argument("--format", action="append", help="this one only; repeatable")
    parser.add_argument("--keep", type=pathlib.Path, help="leave the files of failed cases here")
    arguments = parser.parse_args()
    arguments.source = arguments.source.resolve()
    CORPUS = arguments.source / "tests" / "fuzz" / "corpus"
    program = os.path.abspath(arguments.program)
    info = [program, "mesh", "info", "{file}"]
    meshes = str(arguments.source / "meshes")
    # A lower limit of time: a slow path must say so before the processor time of its case is over.
    generate = [program, "--limit", f"path-seconds={PATH_SECONDS}", "path", "generate", "{file}", "--out", "path.tum",
                "--dir", meshes]
    formats = [
        Format("off", "off", "off", info),
        Format("ply", "ply", "ply", info),
        Format("obj", "obj", "obj", info),
        Format("stl", "stl", "import", info, strip=1, pick={"stl_text", "stl_binary"}),
        Format("gltf", "gltf", "import", info, strip=1, pick={"gltf"}),
        Format("glb", "glb", "import", info, strip=1, pick={"glb"}),
        Format("tum", "tum", "tum", [program, "path", "info", "{file}"]),
        Format("poses", "tum", "tum", [program, "query", "--moving", "sphere", "--fixed", "sphere", "--cutoff", "0.1",
                                       "--dir", meshes, "--poses", "{file}"]),
        Format("experiment", "json", "experiment", [program, "plan", "{file}"]),
        Format("path", "json", "path", generate),
        Format("wild", "json", "path", generate),
        Format("manifest", "json", "manifest", [program, "mesh", "list", "--dir", "{folder}"], where="manifest.json"),
        Format("sweep", "json", "sweep", [program, "work-precision", "{file}", "--out", "sweep.h5"]),
        Format("result", "h5", "result", [program, "compare", "{file}", "{file}"]),
    ]
    everything = [content for each in formats for content in each.files]
    failures = 0
    print("| format | command | cases | taken | refused, 2 | refused, 3 | refused, 4 | crashed, hung, or without file or remedy |"
          " longest [s of processor time] |\n" + "|---" * 9 + "|")
    for each in formats:
        if arguments.format and each.name not in arguments.format:
            continue
        rng = random.Random(f"{arguments.seed} {each.name}")
        codes, worst, bad = collections.Counter(), 0.0, 0
        for case in range(arguments.count):
            content = wild_specification(rng) if each.name == "wild" else mutated(
                rng.choice(each.files), each.files + [rng.choice(everything)], rng)
            with tempfile.TemporaryDirectory(prefix="lmdbench-hostile-") as folder:
                name = each.where.format(file=f"case{case}.{each.suffix}")
                path = os.path.join(folder, name)
                pathlib.Path(path).write_bytes(content)
                argv = [part.format(file=path, folder=folder) for part in each.command]
                code, _, errors, seconds = run(argv, folder)
            codes[code] += 1
            worst = max(worst, seconds)
            problem = problem_of(code, errors, seconds, name)
            if problem:
                bad += 1
                print(f"{each.name}, case {case}: {problem}: {errors[-400:]!r}", file=sys.stderr)
                if arguments.keep:
                    arguments.keep.mkdir(parents=True, exist_ok=True)
                    (arguments.keep / f"{each.name}-{case}.{each.suffix}").write_bytes(content)
        failures += bad
        command = " ".join(each.command[1:]).replace(meshes, "meshes")
        print(f"| {each.name} | `{command}` | {arguments.count} | {codes[0]} | {codes[2]} | {codes[3]} | {codes[4]} | {bad} | {worst:.2f} |",
              flush=True)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
