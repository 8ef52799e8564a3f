#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The life of the Debian packages in a clean Debian 12: lintian has nothing to say, they install, the program runs an
experiment, the module answers, a program outside is built against the library, an upgrade keeps all that, and after the purge
no file is left. Needs root, mmdebstrap, lintian and the archive.

    check_packages.py BUILD [--root ROOT.tar] [--keep]

Prints a Markdown table of sizes. Exit codes: 0 all checks passed, 1 one did not, 4 the system lacks something."""

import argparse
import glob
import os
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
CONSUMER = [os.path.join(HERE, "..", "..", "tests", "install", "consumer", name) for name in ("main.cpp", "CMakeLists.txt")]
# Files that the system itself writes when packages come and go.
SYSTEMS_OWN = ("/var/cache", "/var/lib/apt", "/var/lib/dpkg", "/var/log", "/etc/ld.so.cache", "/tmp", "/debs", "/root", "/proc", "/sys",
               "/dev", "/run", "/var/lib/systemd", "/var/lib/ucf", "/var/lib/python", "/etc/ssl/certs", "/var/lib/xml-core")
USE_MODULE = """
import lmdbench, numpy as np
box = [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]
sides = [[0,1,3],[0,3,2],[4,6,7],[4,7,5],[0,4,5],[0,5,1],[2,3,7],[2,7,6],[0,2,6],[0,6,4],[1,5,7],[1,7,3]]
pose = np.eye(4); pose[:3, 3] = 0.2, 0.3, 1.02
sets = lmdbench.query((box, sides), (box, sides), pose, 0.05)
assert abs(sets[0]["distance"][0] - 0.02) < 1e-12, sets[0]
"""
USE_RESULTS = """
import lmdbench
frames = lmdbench.open_result("/root/shapes.h5").frames("improved")
assert len(frames) == 200 and frames.attrs["units"]["force_z"] == "N", frames
"""


class Checks:
    def __init__(self):
        self.failed = 0

    def that(self, holds, what):
        print(f"{'ok' if holds else 'FAILED'}: {what}", file=sys.stderr)
        self.failed += not holds


def run(*command, **options):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=3600, **options)
    return done.returncode, done.stdout


class Root:
    """A Debian in a folder."""

    def __init__(self, folder, archive):
        self.folder = folder
        if archive is None:
            code, said = run("mmdebstrap", "--quiet", "--variant=apt", "bookworm", folder)
        else:
            os.makedirs(folder)
            code, said = run("tar", "-xf", archive, "-C", folder)
        if code != 0:
            raise OSError(f"no clean root: {said.strip()[-500:]}")

    def __call__(self, *command):
        return run("chroot", self.folder, "env", "-i", "PATH=/usr/sbin:/usr/bin:/sbin:/bin", "DEBIAN_FRONTEND=noninteractive",
                   "LC_ALL=C.UTF-8", "HOME=/root", *command)

    def copy(self, files, place):
        os.makedirs(self.folder + place, exist_ok=True)
        for file in files:
            shutil.copy(file, self.folder + place)

    def files(self):
        found = set()
        for folder, folders, names in os.walk(self.folder):
            place = folder[len(self.folder):] or "/"
            folders[:] = [name for name in folders if os.path.join(place, name) not in SYSTEMS_OWN]
            found |= {os.path.join(place, name) for name in (*names, *folders)} - set(SYSTEMS_OWN)
        return found


def use(root, checks, when):
    # A chroot lacks that device; an empty standard input is enough.
    code, said = root("sh", "-c", "cd /root && lmdbench run /usr/share/lmdbench/experiments/shapes.json --out shapes.h5 --set /frames=200")
    checks.that(code == 0 and os.path.getsize(root.folder + "/root/shapes.h5") > 10_000, f"{when}: runs shapes.json{said if code else ''}")
    code, said = root("sh", "-c", "for file in /usr/share/lmdbench/experiments/*.json /usr/share/lmdbench/experiments/extreme/*.json; do "
                      "lmdbench plan $file 2>&1 >/dev/null | grep error: | grep -v 'is not built yet'; done")
    checks.that(not said, f"{when}: the experiments have their files {said}")
    code, said = root("python3", "-c", USE_MODULE)
    checks.that(code == 0, f"{when}: the module answers {said}")


def life(build, archive, scratch, checks):
    debs = sorted(glob.glob(os.path.join(build, "packages", "*.deb")))
    newer = os.path.join(scratch, "newer")
    code, said = run("cpack", "-G", "DEB", "-D", "CPACK_DEBIAN_PACKAGE_RELEASE=2", "-D", f"CPACK_PACKAGE_DIRECTORY={newer}", cwd=build)
    checks.that(code == 0, f"packages of the next revision {said if code else ''}")
    root = Root(os.path.join(scratch, "root"), archive)
    root.copy(debs, "/debs/1")
    root.copy(glob.glob(os.path.join(newer, "*.deb")), "/debs/2")
    checks.that(root("apt-get", "update", "-q")[0] == 0, "the archive is there")
    before = root.files()

    def install(revision):
        names = ["/debs/" + str(revision) + "/" + os.path.basename(file) for file in sorted(glob.glob(f"{root.folder}/debs/{revision}/*"))]
        return root("apt-get", "install", "-qq", "-y", "--no-install-recommends", *names)

    code, said = install(1)
    checks.that(code == 0, f"installs {said[-2000:] if code else ''}")
    use(root, checks, "installed")
    code, said = install(2)
    upgraded = os.path.basename(debs[0]).split("_")[1].split("-")[0] + "-2"
    checks.that(code == 0 and upgraded in root("dpkg-query", "-W", "lmdbench")[1], f"upgrades {said[-2000:] if code else ''}")
    use(root, checks, "upgraded")

    ours = [name.split("_")[0] for name in map(os.path.basename, debs)]
    code, said = root("apt-get", "purge", "-qq", "-y", *ours)
    checks.that(code == 0, f"purges {said[-2000:] if code else ''}")
    left = sorted(file for file in root.files() if "lmdbench" in file)
    checks.that(not left, f"the purge leaves nothing of ours: {left[:20]}")
    root("apt-get", "autoremove", "--purge", "-qq", "-y")
    more = sorted(root.files() - before)
    checks.that(not more, f"nor do the packages it needed: {more[:20]}")

    install(2)
    root("apt-get", "install", "-qq", "-y", "--no-install-recommends", "cmake", "g++", "make", "pkg-config", "python3-h5py", "python3-pandas")
    code, said = root("python3", "-c", USE_RESULTS)
    checks.that(code == 0, f"the module opens the result {said[-2000:]}")
    root.copy(CONSUMER, "/root")
    for how, build in (("pkg-config", "g++ -std=c++20 main.cpp -o consumer $(pkg-config --cflags --libs lmdbench)"),
                       ("find_package", "cmake -B made . >/dev/null && cmake --build made >/dev/null && cp made/consumer .")):
        code, said = root("sh", "-c", f"cd /root && rm -f consumer && {build} && "
                          "printf 'OFF\\n3 1 0\\n0 0 0\\n1 0 0\\n0 1 0\\n3 0 1 2\\n' > t.off && ./consumer t.off t.off 2")
        checks.that(code == 0, f"a program outside is built against the library by {how}: {said.strip()[-2000:]}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", help="build tree with packages/")
    parser.add_argument("--root", help="a clean root as tar, in place of mmdebstrap's")
    parser.add_argument("--keep", action="store_true", help="leave the root for a look")
    arguments = parser.parse_args()
    debs = sorted(glob.glob(os.path.join(arguments.build, "packages", "*.deb")))
    for tool in ("lintian", "chroot", *([] if arguments.root else ["mmdebstrap"])):
        if shutil.which(tool) is None or os.geteuid() != 0 or not debs:
            print(f"error: needs root, {tool} and packages (remedy: ./scripts/setup.sh, then as root ./scripts/package.sh --check)",
                  file=sys.stderr)
            return 4
    print("| package | size [kB] | installed [kB] |\n|---|---|---|")
    for deb in debs:
        installed = run("dpkg-deb", "--field", deb, "Installed-Size")[1].strip()
        print(f"| {os.path.basename(deb)} | {os.path.getsize(deb) // 1000} | {installed} |")
    checks = Checks()
    code, said = run("lintian", "--allow-root", "--fail-on", "error,warning", "--tag-display-limit", "0", *debs)
    checks.that(code == 0 and not said.strip(), f"lintian {said}")
    scratch = tempfile.mkdtemp(prefix="lmdbench-packages-")
    try:
        life(os.path.abspath(arguments.build), arguments.root, scratch, checks)
    except OSError as error:
        print(f"error: {error}", file=sys.stderr)
        return 4
    finally:
        if not arguments.keep:
            shutil.rmtree(scratch, ignore_errors=True)
    return 1 if checks.failed else 0


if __name__ == "__main__":
    raise SystemExit(main())
