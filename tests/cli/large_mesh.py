# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a sheet of very many triangles as OFF and lets the program read it: with the usual limits it must be refused by name, with
the limit raised it must be read. A rough sheet has no two triangles in one plane; one of strips is a zigzag of flat ones, each of very
many triangles. Prints processor time and peak memory of each as a table.

    large_mesh.py PROGRAM [--triangles N] [--shape rough|strips] [--folder FOLDER]
"""

import argparse
import os
import resource
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77  # told to ctest
BYTES_PER_TRIANGLE = 60  # of the text, vertices included
MEMORY_PER_TRIANGLE = 500  # what `query` may need; `mesh info` takes about 260


def write_sheet(path, triangles, shape):
    side = round((triangles / 2) ** 0.5)
    with open(path, "w", encoding="ascii", buffering=1 << 22) as file:
        file.write(f"OFF\n{(side + 1) ** 2} {2 * side * side} 0\n")
        heights = [f"{0.01 * ((j * 37) % 101):.4f}" for j in range(side + 1)]
        columns = [f"{j / side:.7f}" for j in range(side + 1)]
        for i in range(side + 1):
            row = columns[i]
            if shape == "strips":
                file.write("".join(f"{row} {column} {0.01 * (i % 2)}\n" for column in columns))
            else:
                file.write("".join(f"{row} {columns[j]} {heights[(31 * i + j) % (side + 1)]}\n" for j in range(side + 1)))
        for i in range(side):
            a, b = i * (side + 1), (i + 1) * (side + 1)
            file.write("".join(f"3 {a + j} {b + j} {b + j + 1}\n3 {a + j} {b + j + 1} {a + j + 1}\n" for j in range(side)))
    return 2 * side * side


def measured(argv):
    """(exit code, errors, processor seconds, peak memory in bytes)"""
    process = subprocess.Popen(argv, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, output, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("program")
    parser.add_argument("--triangles", type=int, default=40_000_000)
    parser.add_argument("--shape", choices=["rough", "strips"], default="rough")
    parser.add_argument("--folder", default=tempfile.gettempdir())
    arguments = parser.parse_args()
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    if shutil.disk_usage(arguments.folder).free < 2 * arguments.triangles * BYTES_PER_TRIANGLE:
        print("skipped: the disk has no room for the mesh")
        return SKIPPED
    if memory < arguments.triangles * MEMORY_PER_TRIANGLE:
        print(f"skipped: {memory >> 30} GB of memory are too little for the mesh")
        return SKIPPED
    resource.setrlimit(resource.RLIMIT_AS, (memory, memory))  # fails the program alone
    failures = []
    with tempfile.TemporaryDirectory(prefix="lmdbench-large-", dir=arguments.folder) as folder:
        mesh = os.path.join(folder, "sheet.off")
        triangles = write_sheet(mesh, arguments.triangles, arguments.shape)
        print(f"{triangles} triangles, {os.path.getsize(mesh)} bytes\n")
        print("| command | exit code | processor time [s] | peak memory [GB] |\n|---|---|---|---|")
        raised = ["--limit", f"triangles={triangles}"]
        for title, argv, codes, text in [
                ("mesh info", ["mesh", "info", mesh], {3}, "--limit triangles="),
                ("mesh info, limit raised", [*raised, "mesh", "info", mesh], {0}, "triangles"),
                ("query against a sphere, limit raised", [*raised, "query", "--moving", mesh, "--fixed", "sphere", "--cutoff",
                                                        "1e-4"], {0, 4}, "")]:
            code, output, seconds, peak = measured([arguments.program, *argv])
            print(f"| {title} | {code} | {seconds:.1f} | {peak / 1e9:.2f} |", flush=True)
            if code not in codes or text not in output:
                failures.append(f"{title}: exit code {code}: {output[-500:]}")
    for failure in failures:
        print(failure, file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
