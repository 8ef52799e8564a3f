# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Installs the build tree into a prefix, moves it, and uses it from outside: a project of twenty lines by CMake with g++ and
clang++, Debug and Release, and by pkg-config; the program with the data and scripts beside it. Arguments: the build tree; with
--every the consumer of every compiler, build type and prefix, without it of one, and all the rest."""

import hashlib
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.abspath(os.path.join(HERE, "..", ".."))
CONSUMER = os.path.join(HERE, "consumer")
BUILD = None
# For each compiler: the build types, and where the library is. A release build is always linked.
ONE_CONSUMER = (("g++", ("Debug",), ("prefix",)),)
EVERY_CONSUMER = tuple((compiler, ("Debug", "Release"), ("staged", "prefix")) for compiler in ("g++", "clang++"))
CONSUMERS = ONE_CONSUMER
BOX = """OFF\n8 12 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1
3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 4 7\n"""


def cached(name):
    """A setting of the build tree; empty where it has none."""
    found = re.search(rf"^{name}:[A-Z]+=(.*)$", Path(BUILD, "CMakeCache.txt").read_text(encoding="utf-8"), re.MULTILINE)
    return found.group(1) if found else ""


def sanitizer_flags():
    """What a library with sanitizers asks of its consumers: their runtime."""
    return [f"-fsanitize={cached('LMDBENCH_SANITIZE')}"] if cached("LMDBENCH_SANITIZE") else []


def compiled_code_names_sources():
    """Debuggers and reports of sanitizers find lines by the whole path of their file, so that compiled code holds it."""
    flags = cached("CMAKE_CXX_FLAGS") + " " + cached(f"CMAKE_CXX_FLAGS_{cached('CMAKE_BUILD_TYPE').upper()}")
    return bool(sanitizer_flags()) or any(flag.startswith("-g") and flag != "-g0" for flag in flags.split())


def run(*command, **options):
    return subprocess.run(command, capture_output=True, text=True, timeout=1200, **options)


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = cls.enterClassContext(tempfile.TemporaryDirectory())
        cls.staged = os.path.join(cls.folder, "staged")
        cls.prefix = os.path.join(cls.folder, "moved", "to here")
        for component in ("Runtime", "Development"):
            done = run("cmake", "--install", BUILD, "--prefix", cls.staged, "--component", component)
            if done.returncode != 0:
                raise RuntimeError(done.stdout + done.stderr)
        os.makedirs(os.path.dirname(cls.prefix))
        shutil.copytree(cls.staged, cls.prefix, symlinks=True)
        cls.mesh = os.path.join(cls.folder, "box.off")
        Path(cls.mesh).write_text(BOX, encoding="ascii")

    def libdir(self):
        return os.path.join(self.prefix, self.package_folder().split("/cmake/")[0])

    def package_folder(self):
        for folder, _, files in os.walk(self.prefix):
            if "lmdbenchConfig.cmake" in files:
                return os.path.relpath(folder, self.prefix)
        self.fail("no lmdbenchConfig.cmake")

    def configure(self, prefix, name, *arguments):
        folder = os.path.join(self.folder, name)
        flags = [f"-DCMAKE_CXX_FLAGS={flag}" for flag in sanitizer_flags()]
        return folder, run("cmake", "-S", CONSUMER, "-B", folder, "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}", *flags, *arguments)

    def assert_answers(self, program):
        done = run(program, self.mesh, self.mesh, "0.05")
        self.assertEqual(done.returncode, 0, done.stderr)
        wanted = run(os.path.join(BUILD, "lmdbench"), "query", "--moving", self.mesh, "--fixed", self.mesh, "--cutoff", "0.05",
                     "--poses", "-", "--json", input="0 0.2 0.3 1.02 0 0 0 1\n")
        lmds = json.loads(wanted.stdout)["lmds"]
        self.assertEqual(len(lmds), 1)
        for line, lmd in zip(done.stdout.splitlines(), lmds):
            moving, fixed = lmd["feature_moving"], lmd["feature_fixed"]
            distance, *features = line.split()
            self.assertEqual(float(distance), lmd["distance"])
            self.assertEqual(features, [moving["kind"], str(moving["index"]), fixed["kind"], str(fixed["index"])])
        self.assertEqual(len(done.stdout.splitlines()), len(lmds))
        missing = run(program, "missing.off", self.mesh, "0.05")
        self.assertEqual(missing.returncode, 3)
        self.assertIn("missing.off", missing.stderr)

    def test_cmake_finds_it(self):
        for compiler, kinds, prefixes in CONSUMERS:
            for kind in kinds:
                for prefix in (getattr(self, name) for name in prefixes):
                    with self.subTest(compiler=compiler, kind=kind, prefix=prefix):
                        folder, done = self.configure(prefix, f"{compiler}-{kind}-{os.path.basename(prefix)}",
                                                      f"-DCMAKE_CXX_COMPILER={compiler}", f"-DCMAKE_BUILD_TYPE={kind}")
                        self.assertEqual(done.returncode, 0, done.stderr)
                        done = run("cmake", "--build", folder)
                        self.assertEqual(done.returncode, 0, done.stdout)
                        self.assert_answers(os.path.join(folder, "consumer"))

    def test_components_and_versions_that_are_not_there_are_refused(self):
        _, done = self.configure(self.prefix, "formats", "-DWANTED=formats;nearest")
        self.assertEqual(done.returncode, 0, done.stderr)
        _, done = self.configure(self.prefix, "unknown", "-DWANTED=record")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("record", done.stderr)
        for other in ("0.1", "1.99", "2.0"):
            with self.subTest(version=other):
                _, done = self.configure(self.prefix, "other-version", f"-DVERSION_WANTED={other}")
                self.assertNotEqual(done.returncode, 0)
                self.assertIn(f'"{other}"', done.stderr)

    def test_pkg_config_finds_it(self):
        for compiler in [compiler for compiler, _, _ in CONSUMERS]:
            with self.subTest(compiler=compiler):
                self.use_pkg_config(compiler)

    def use_pkg_config(self, compiler):
        environment = {**os.environ, "PKG_CONFIG_PATH": os.path.join(self.libdir(), "pkgconfig")}
        done = run("pkg-config", "--cflags", "--libs", "lmdbench", env=environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        flags = shlex.split(done.stdout)  # the prefix has a space
        self.assertIn("-DEIGEN_MAX_ALIGN_BYTES=16", flags)
        program = os.path.join(self.folder, f"by-pkg-config-{compiler}")
        done = run(compiler, "-std=c++20", "-O1", *sanitizer_flags(), os.path.join(CONSUMER, "main.cpp"), "-o", program, *flags)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_answers(program)

    def test_flags_that_make_the_results_stay_private(self):
        targets = Path(self.prefix, self.package_folder(), "lmdbenchTargets.cmake").read_text(encoding="utf-8")
        self.assertIn("EIGEN_MAX_ALIGN_BYTES=16", targets)
        for private in ("ffp-contract", "-march", "-W", "fast-math"):
            self.assertNotIn(private, targets)

    def test_nothing_installed_names_the_tree_it_was_built_in(self):
        found, left_out, leaves_out = [], [], compiled_code_names_sources()
        for folder, _, files in os.walk(self.staged):
            for name in files:
                file = os.path.join(folder, name)
                content = Path(file).read_bytes()
                if leaves_out and content.startswith((b"\x7fELF", b"!<arch>\n")):
                    left_out.append(name)
                    continue
                for place in (ROOT, BUILD, self.staged):
                    at = content.find(place.encode() + b"/")
                    if at >= 0:  # the first of them: an archive holds thousands
                        text = re.split(rb"[\0\n]", content[at:at + 200])[0].decode(errors="replace")
                        found.append(f"{os.path.relpath(file, self.staged)} at byte {at}: {text}")
        if found:
            self.fail("\n".join([f"{len(found)} places:", *found[:10]]))
        if left_out:
            self.skipTest(f"with debug information or sanitizers compiled code names its sources: not asked of {', '.join(left_out)}")

    def test_man_pages_and_completion_are_where_readers_look(self):
        self.assertTrue(os.path.exists(os.path.join(self.prefix, "share/man/man1/lmdbench-run.1.gz")))
        for file in ("share/bash-completion/completions/lmdbench", "share/zsh/vendor-completions/_lmdbench"):
            self.assertTrue(os.path.exists(os.path.join(self.prefix, file)), file)

    def test_the_moved_program_runs_its_experiment_and_makes_its_page(self):
        program = os.path.join(self.prefix, "bin", "lmdbench")
        environment = {name: value for name, value in os.environ.items() if name != "LMDBENCH_SCRIPTS"}
        work = os.path.join(self.folder, "work")
        os.makedirs(work, exist_ok=True)
        experiment = os.path.join(self.prefix, "share/lmdbench/experiments/shapes.json")
        done = run(program, "-q", "run", experiment, "--set", "/frames=40", cwd=work, env=environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        done = run(program, "-q", "report", "results/shapes.h5", "--out", "page", cwd=work, env=environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater(len(Path(work, "page", "index.html").read_text(encoding="utf-8")), 100_000)
        for other in os.listdir(os.path.join(self.prefix, "share/lmdbench/experiments")):
            if not other.endswith(".json"):
                continue
            done = run(program, "-q", "plan", os.path.join(self.prefix, "share/lmdbench/experiments", other), cwd=work)
            if done.returncode != 0:
                self.assertRegex(done.stderr, r"is not built yet", other)

    def test_who_may_not_write_beside_the_program_finds_and_builds_meshes_from_any_folder(self):
        home = os.path.join(self.folder, "home")
        sources = os.path.join(home, "lmdbench", "meshes", "sources")
        os.makedirs(sources)
        shutil.copy(self.mesh, os.path.join(sources, "box.off"))
        manifest = os.path.join(self.prefix, "share/lmdbench/meshes/manifest.json")
        document = json.loads(Path(manifest).read_text(encoding="utf-8"))
        document["sources"]["box-file"] = {"package": "none", "archive": "a.tar", "path": "box.off", "licence": "l", "credit": "c",
                                           "sha256": hashlib.sha256(BOX.encode()).hexdigest()}
        document["meshes"]["box-of-file"] = {"description": "d", "source": "box-file", "triangles": 12}
        Path(manifest).write_text(json.dumps(document), encoding="utf-8")
        os.chmod(self.folder, 0o755)
        nobody = {}
        if os.getuid() == 0:  # root may write anywhere
            nobody = {"user": 65534}
            for folder in (home, os.path.dirname(os.path.dirname(sources)), os.path.dirname(sources), sources):
                os.chown(folder, 65534, 65534)
        else:
            os.chmod(os.path.dirname(manifest), 0o555)
        environment = {**os.environ, "XDG_DATA_HOME": home, "PATH": os.path.join(self.prefix, "bin") + ":" + os.environ["PATH"]}

        def lmdbench(*arguments, code=0):
            done = run("lmdbench", *arguments, cwd=home, env=environment, **nobody)
            self.assertEqual(done.returncode, code, done.stdout + done.stderr)
            return done

        self.assertIn("bunny-5k", lmdbench("mesh", "list").stdout)
        lmdbench("init", "box", "torus", "--out", "new")
        self.assertNotIn("mesh_folder", Path(home, "new", "box-torus.json").read_text(encoding="utf-8"))
        lmdbench("-q", "run", "new/box-torus.json", "--set", "/frames=20")
        Path(home, "own.json").write_text('{"moving": {"mesh": "box-of-file"}, "fixed": [{"mesh": "box"}], '
                                          '"path": {"file": "new/box-torus.tum"}}', encoding="ascii")
        remedy = re.search(r"run '(lmdbench mesh build box-of-file)'", lmdbench("plan", "own.json", code=3).stderr)
        lmdbench(*remedy.group(1).split()[1:])
        self.assertTrue(os.path.exists(os.path.join(home, "lmdbench", "meshes", "box-of-file.off")))
        lmdbench("plan", "own.json")

    def test_the_program_without_its_data_says_what_it_lacks(self):
        lonely = os.path.join(self.folder, "lonely")
        shutil.copy(os.path.join(self.prefix, "bin", "lmdbench"), lonely)
        environment = {name: value for name, value in os.environ.items() if name != "LMDBENCH_SCRIPTS"}
        done = run(lonely, "report", "any.h5", "--out", "page", cwd=self.folder, env=environment)
        self.assertEqual(done.returncode, 4)
        self.assertRegex(done.stderr, r"report.py.*LMDBENCH_SCRIPTS")


if __name__ == "__main__":
    if "--every" in sys.argv:
        sys.argv.remove("--every")
        CONSUMERS = EVERY_CONSUMER
        sys.argv += ["Installed.test_cmake_finds_it", "Installed.test_pkg_config_finds_it"]
    BUILD = os.path.abspath(sys.argv.pop(1))
    if sanitizer_flags():
        # Each compiler has a runtime of its own: only the one that made the library can link it.
        CONSUMERS = ((os.path.basename(cached("CMAKE_CXX_COMPILER")), *CONSUMERS[0][1:]),)
    unittest.main()
