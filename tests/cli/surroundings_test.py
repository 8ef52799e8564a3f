# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the built program in bad surroundings: little memory, few files and processes, no home, odd folders for temporary
files, read-only and full disks, file size limits, inputs that change meanwhile, two writers, results that are damaged or
old. It works, or leaves with the reason; nothing that was there is lost. What needs rights that the caller lacks is
skipped with the reason.

    surroundings_test.py PROGRAM SOURCE_FOLDER [unittest arguments]
"""

import hashlib
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import h5py

PROGRAM, SOURCE = "", pathlib.Path()
DONE, USAGE, INPUT_DATA, ENVIRONMENT = 0, 2, 3, 4
PROCESSOR_SECONDS = 60
MIB = 1 << 20
NOBODY = 65534


def without_root(command):
    """The command as a user without rights: limits on processes and permissions do not bind root."""
    if os.geteuid() != 0:
        return command
    return ["setpriv", f"--reuid={NOBODY}", f"--regid={NOBODY}", "--clear-groups", "--inh-caps=-all",
            "--bounding-set=-all"] + command


def reserves_address_space():
    """Whether the program is built with the address or thread sanitizer, as it says itself."""
    version = subprocess.run([PROGRAM, "--version"], capture_output=True, text=True, check=True).stdout
    return re.search(r"-fsanitize=\S*(address|thread)", version) is not None


def flipped(content, places):
    damaged = bytearray(content)
    for at in places:
        damaged[at] ^= 0xFF
    return damaged


class Surroundings(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="lmdbench-surroundings-", ignore_cleanup_errors=True)))
        self.folder.chmod(0o777)
        self.shapes = str(SOURCE / "experiments" / "shapes.json")

    def run_program(self, arguments, limits=(), wrap=lambda command: command, **options):
        def limit():
            for kind, value in ((resource.RLIMIT_CPU, PROCESSOR_SECONDS), *limits):
                resource.setrlimit(kind, (value, value))
        return subprocess.run(wrap([PROGRAM, *map(str, arguments)]), capture_output=True, text=True, errors="replace",
                              stdin=subprocess.DEVNULL, preexec_fn=limit, timeout=300, check=False,
                              cwd=options.pop("cwd", self.folder), **options)

    def started(self, *arguments):
        return subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def finished_run(self, *more):
        self.assertEqual(self.run_program(self.short_run("r.h5", *more)).returncode, DONE)

    def short_run(self, out, *more):
        return ["run", self.shapes, "--set", "/frames=20", "--set", "/driver/repetitions=1", "--out", out, *more]

    def assert_works_or_says_why(self, done, codes=(DONE, ENVIRONMENT)):
        self.assertIn(done.returncode, codes, done.stderr)
        if done.returncode != DONE:
            self.assertIn("remedy: ", done.stderr)

    def assert_refused(self, done, code, *texts):
        self.assertEqual(done.returncode, code, done.stderr)
        for text in ("remedy: ", *texts):
            self.assertIn(text, done.stderr)

    # Limits of the machine

    def test_sixteen_open_files(self):
        limits = [(resource.RLIMIT_NOFILE, 16)]
        done = self.run_program(self.short_run("r.h5"), limits)
        self.assertEqual(done.returncode, DONE, done.stderr)
        for arguments in (["compare", "r.h5", "r.h5"], ["mesh", "info", self.small_mesh("m.obj")],
                          ["plan", self.shapes]):
            done = self.run_program(arguments, limits)
            self.assertIn(done.returncode, (DONE, ENVIRONMENT), done.stderr)

    def test_little_memory(self):
        if reserves_address_space():
            self.skipTest("sanitizers reserve terabytes of address space, which is what the limit is on")
        self.finished_run()
        before = (self.folder / "r.h5").read_bytes()
        for mebibytes in (512, 200, 150, 120, 90):
            with self.subTest(mebibytes=mebibytes):
                limits = [(resource.RLIMIT_AS, mebibytes * MIB)]
                done = self.run_program(self.short_run("r.h5"), limits)
                self.assert_works_or_says_why(done)
                if mebibytes == 512:
                    self.assertEqual(done.returncode, DONE, done.stderr)
                self.assert_works_or_says_why(self.run_program(["mesh", "info", self.small_mesh("m.ply")], limits),
                                              (DONE, INPUT_DATA, ENVIRONMENT))
        with h5py.File(self.folder / "r.h5") as file:
            self.assertIn("methods", file)
        self.assertGreater(len(before), 0)

    def test_few_processes(self):
        if os.geteuid() == 0 and not shutil.which("setpriv"):
            self.skipTest("the limit does not bind root, and there is no setpriv")
        if subprocess.run(without_root([PROGRAM, "--version"]), capture_output=True, check=False).returncode != 0:
            self.skipTest("a user without rights cannot start the program here")
        # The address sanitizer looks for leaks in a process of its own, and fails without.
        options = os.environ.get("ASAN_OPTIONS", "").split(":") + ["detect_leaks=0"]
        environment = os.environ | {"ASAN_OPTIONS": ":".join(filter(None, options))}
        for most in (0, 1, 3, 4):
            with self.subTest(most=most):
                def limited(command, most=most):
                    return without_root(["sh", "-c", f'ulimit -u {most}; exec "$0" "$@"', *command])
                self.assert_works_or_says_why(
                    self.run_program(self.short_run(f"r{most}.h5"), wrap=limited, env=environment))
                self.assert_works_or_says_why(
                    self.run_program(["mesh", "info", self.small_mesh("m.obj")], wrap=limited, env=environment))
                self.assert_works_or_says_why(
                    self.run_program(self.short_run(f"c{most}.h5", "--driver", "realtime", "--set", "/driver/realtime/seconds=0.5"), wrap=limited, env=environment))

    def test_closed_standard_descriptors(self):
        def closed(command):
            return ["sh", "-c", 'exec "$0" "$@" <&- >&- 2>&-', *command]
        done = self.run_program(self.short_run("r.h5"), wrap=closed)
        self.assertEqual(done.returncode, ENVIRONMENT, "its table is lost")
        self.assertEqual([file.name for file in self.folder.iterdir()], ["r.h5"])
        with h5py.File(self.folder / "r.h5") as file:
            self.assertIn("methods", file)
        self.assertEqual(self.run_program(self.short_run("r.h5", "-q"), wrap=closed).returncode, DONE)

    def test_no_home_and_odd_temporary_folders(self):
        bare = {"PATH": os.environ["PATH"]}
        done = self.run_program(self.short_run("r.h5"), env=bare)
        self.assertEqual(done.returncode, DONE, done.stderr)
        (self.folder / "a file").write_text("")
        for number, temporary in enumerate(("/no/such/folder", str(self.folder / "a file"), "", "relative", "x" * 5000)):
            with self.subTest(temporary=temporary[:20]):
                if number < 3:
                    done = self.run_program(["report", "r.h5", "--out", "page"], env=bare | {"TMPDIR": temporary})
                    self.assert_works_or_says_why(done)
                self.assertEqual(self.run_program(self.short_run("s.h5"), env=bare | {"TMPDIR": temporary}).returncode,
                                 DONE)

    def test_read_only_folder(self):
        self.finished_run()
        (self.folder / "r.h5").chmod(0o644)
        before = (self.folder / "r.h5").read_bytes()
        self.folder.chmod(0o555)
        if subprocess.run(without_root([PROGRAM, "--version"]), capture_output=True, check=False).returncode != 0:
            self.skipTest("a user without rights cannot start the program here")
        for arguments in (self.short_run("r.h5"), ["path", "generate", SOURCE / "paths" / "shapes.json", "--out", "p.tum",
                                                   "--dir", SOURCE / "meshes"]):
            self.assert_refused(self.run_program(arguments, wrap=without_root), ENVIRONMENT)
        self.folder.chmod(0o777)
        self.assertEqual((self.folder / "r.h5").read_bytes(), before)
        self.assertEqual(sorted(os.listdir(self.folder)), ["r.h5"])

    def on_small_disk(self, command, kibibytes):
        """A shell command on a disk of its own, the current folder; None where no disk can be mounted."""
        disk = self.folder / "disk"
        disk.mkdir(exist_ok=True)
        mount = f"mount -t tmpfs -o size={kibibytes}k tmpfs '{disk}' && cd '{disk}'"
        if subprocess.run(["unshare", "-rm", "sh", "-c", mount], capture_output=True, check=False).returncode != 0:
            return None
        return subprocess.run(["unshare", "-rm", "sh", "-c", f"{mount} && {command}"], capture_output=True, text=True,
                              check=False, timeout=300)

    def test_full_disk(self):
        run = " ".join(f"'{part}'" for part in [PROGRAM, *self.short_run("r.h5")])
        # The first run has room, the second has not: the first result stays whole, nothing else.
        done = self.on_small_disk(f"{run} && cp r.h5 kept && dd if=/dev/zero of=filler bs=1k; rm -f p; "
                                  f"{run}; echo code $?; cmp r.h5 kept && ls", 4000)
        if done is None:
            self.skipTest("no disk can be mounted: unshare -rm is not allowed")
        self.assertIn(f"code {ENVIRONMENT}", done.stdout, done.stderr)
        self.assertIn("remedy: ", done.stderr)
        left = done.stdout.split(f"code {ENVIRONMENT}")[1].split()
        self.assertLessEqual(set(left), {"filler", "kept", "r.h5", "r.h5.part"}, done.stdout)
        for command in (f"'{PROGRAM}' path generate '{SOURCE}/paths/shapes.json' --dir '{SOURCE}/meshes' --out p.tum",
                        f"'{PROGRAM}' work-precision '{self.sweep()}' --out s.h5"):
            done = self.on_small_disk(f"dd if=/dev/zero of=filler bs=1k; {command}; echo code $?; ls", 8)
            self.assertIn(f"code {ENVIRONMENT}", done.stdout, done.stderr)

    def test_limited_file_size(self):
        limits = [(resource.RLIMIT_FSIZE, 4096)]
        done = self.run_program(self.short_run("r.h5"), limits)
        self.assert_refused(done, ENVIRONMENT)
        self.assertFalse((self.folder / "r.h5").exists())

    # Inputs that change, two writers

    def small_mesh(self, name):
        texts = {".obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
                 ".ply": "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                         "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                 ".off": "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"}
        path = self.folder / name
        path.write_text(texts[path.suffix])
        return path

    def own_experiment(self, repetitions=30):
        """An experiment whose mesh and path are files of the test."""
        mesh = self.small_mesh("mesh.off")
        shutil.copy(SOURCE / "paths" / "shapes.tum", self.folder / "path.tum")
        experiment = json.loads(pathlib.Path(self.shapes).read_text())
        experiment["moving"]["mesh"] = "./mesh.off"
        experiment["mesh_folder"] = str(SOURCE / "meshes")
        experiment["path"]["file"] = "path.tum"
        experiment["driver"]["repetitions"] = repetitions
        (self.folder / "own.json").write_text(json.dumps(experiment))
        return mesh, self.folder / "path.tum"

    def hashes_of(self, result):
        with h5py.File(result) as file:
            files, digests = (file[f"provenance/inputs/{name}"].asstr()[()] for name in ("file", "sha256"))
        return {os.path.basename(path): digest for path, digest in zip(files, digests)}

    def test_inputs_that_change_during_a_run(self):
        mesh, path = self.own_experiment()
        wanted = {file.name: hashlib.sha256(file.read_bytes()).hexdigest() for file in (mesh, path)}
        process = self.started("run", "own.json", "--out", "r.h5", "-q")
        self.wait_for_frames(process, self.folder / "r.h5.part")
        mesh.write_text(mesh.read_text().replace("0 0 1", "0 0 2"))
        path.unlink()
        self.assertIsNone(process.poll(), "the run was through before its inputs changed")
        _, errors = process.communicate(timeout=300)
        self.assertEqual(process.returncode, DONE, errors)
        found = self.hashes_of(self.folder / "r.h5")
        for name, digest in wanted.items():
            self.assertEqual(found.get(name), digest, name)
        self.assertNotEqual(hashlib.sha256(mesh.read_bytes()).hexdigest(), wanted[mesh.name])

    def wait_for_frames(self, process, part):
        for _ in range(6000):
            if process.poll() is not None:
                return
            try:
                with h5py.File(part) as file:
                    if file["frames_measured"][0] > 0:
                        return
            except (OSError, KeyError):
                pass
            time.sleep(0.005)

    def begin_run(self):
        """Of the own experiment, killed once it has frames."""
        process = self.started("run", "own.json", "--out", "r.h5", "-q")
        self.wait_for_frames(process, self.folder / "r.h5.part")
        process.kill()
        process.communicate()

    def test_an_interrupted_run_is_not_resumed_with_another_mesh(self):
        mesh, _ = self.own_experiment()
        self.begin_run()
        mesh.write_text(mesh.read_text().replace("0 0 1", "0 0 2"))
        self.assert_refused(self.run_program(["run", "own.json", "--out", "r.h5", "--resume"]), INPUT_DATA, "another run")

    def test_two_writers_of_one_file(self):
        meshes = self.folder / "meshes"
        meshes.mkdir()
        manifest = json.loads((SOURCE / "meshes" / "manifest.json").read_text())
        shape = next(name for name, entry in manifest["meshes"].items() if "shape" in entry)
        manifest["meshes"] = {shape: manifest["meshes"][shape]}
        (meshes / "manifest.json").write_text(json.dumps(manifest))
        commands = [(["mesh", "build", shape, "--dir", meshes], meshes / f"{shape}.off"),
                    (["path", "generate", SOURCE / "paths" / "shapes.json", "--dir", SOURCE / "meshes", "--out", "p.tum"],
                     self.folder / "p.tum")]
        for arguments, written in commands:
            self.assertEqual(self.run_program(arguments).returncode, DONE)
            alone = written.read_bytes()
            for _ in range(2):
                written.unlink()
                processes = [self.started(*arguments) for _ in range(4)]
                for process in processes:
                    _, errors = process.communicate(timeout=300)
                    self.assertIn(process.returncode, (DONE, ENVIRONMENT), errors)
                    if process.returncode == ENVIRONMENT:
                        self.assertIn("remedy: ", errors)
                self.assertIn(DONE, [process.returncode for process in processes])
                self.assertEqual(written.read_bytes(), alone)
                self.assertFalse(list(written.parent.glob("*.part*")))

    # Sweeps

    def sweep(self, repetitions=2):
        path = self.folder / "sweep.json"
        path.write_text(json.dumps({
            "name": "s", "experiments": [self.shapes], "repetitions": repetitions, "truth_check_frames": 2,
            "set": {"/frames": 150},
            "series": [{"method": {"name": name}, "axes": [{"/driver/search_every_frames": [1, 20],
                                                           "/driver/search_latency_frames": [1, 20]}]}
                       for name in ("improved", "certified")]}))
        return path

    def test_killed_sweeps_go_on(self):
        sweep = self.sweep(3)
        self.assertEqual(self.run_program(["work-precision", sweep, "--out", "whole.h5"]).returncode, DONE)
        journal, resumed = self.folder / "s.h5.points.jsonl", 0
        for lines in range(2, 40, 3):  # lines of the journal at the kill; the first describes the sweep
            process = self.started("work-precision", sweep, "--out", "s.h5")
            while process.poll() is None:
                if journal.exists() and journal.read_bytes().count(b"\n") >= lines:
                    process.kill()
                    break
                time.sleep(0.002)
            _, errors = process.communicate(timeout=300)
            if process.returncode == DONE:
                resumed += "were done before" in errors
                break
            self.assertEqual(process.returncode, -signal.SIGKILL, errors)
        self.assertEqual(process.returncode, DONE)
        self.assertEqual(resumed, 1)
        with h5py.File(self.folder / "whole.h5") as whole, h5py.File(self.folder / "s.h5") as other:
            for name in ("failure", "scene", "series", "axes", "force_error_rms_n", "recall", "truth_checked_frames"):
                if name in whole["points"]:
                    one, two = (file["points"][name][()] for file in (whole, other))
                    self.assertEqual(*((values.tolist() if values.dtype.kind == "O" else values.tobytes()) for values in (one, two)), name)

    def test_inputs_that_change_during_a_sweep(self):
        mesh, _ = self.own_experiment()
        sweep = json.loads(self.sweep(20).read_text())
        sweep["experiments"] = [self.shapes, "own.json"]  # each is read when its turn comes
        (self.folder / "sweep.json").write_text(json.dumps(sweep))
        process = self.started("work-precision", "sweep.json", "--out", "s.h5")
        journal = self.folder / "s.h5.points.jsonl"
        while process.poll() is None and not (journal.exists() and journal.read_bytes().count(b"\n") > 1):
            time.sleep(0.002)
        mesh.write_text(mesh.read_text().replace("0 0 1", "0 0 2"))
        _, errors = process.communicate(timeout=300)
        self.assertEqual(process.returncode, INPUT_DATA, errors)
        self.assertIn("mesh.off: has changed since the sweep began", errors)
        self.assertFalse((self.folder / "s.h5").exists())

    def test_damaged_journals(self):
        sweep = self.sweep()
        self.assertEqual(self.run_program(["work-precision", sweep, "--out", "s.h5"]).returncode, DONE)
        journal = self.folder / "s.h5.points.jsonl"
        lines = journal.read_text().splitlines()
        at = next(i for i, line in enumerate(lines) if "errors" in json.loads(line))
        entry = json.loads(lines[at])
        damage = {
            "cut": "\n".join(lines)[:-30],
            "no lines of ours": "\n".join([lines[0], '{"key":3,"repetition":"x"}', "[]", "null", "[" * 5000]) + "\n",
        }

        def swept(text):
            journal.write_text(text)
            return self.run_program(["work-precision", sweep, "--out", "s.h5"])

        def swept_with(change):
            return swept("\n".join([*lines[:at], json.dumps(entry | change), *lines[at + 1:]]) + "\n")
        for name, text in damage.items():
            done = swept(text)
            self.assertEqual(done.returncode, DONE, f"{name}: {done.stderr}")
        for change in ({"errors": {}}, {"local_update_ns": [1]}, {"local_update_ns": "x"},
                       {"errors": entry["errors"] | {"search_frames": [10**9] * len(entry["errors"]["search_frames"])}}):
            self.assert_refused(swept_with(change), INPUT_DATA, "points.jsonl")
        # Repetitions that differ are made again.
        done = swept_with({"result_hash": 3})
        self.assertEqual(done.returncode, DONE, done.stderr)
        self.assertIn("done again: point 0 ", done.stderr)
        self.assert_refused(swept("my notes\n"), USAGE)
        self.assertEqual(journal.read_text(), "my notes\n")

    # Results that are damaged, old, or of other files

    def altered(self, alter, with_report):
        """The message of `compare` for a copy of a result that was altered; the same for `report`."""
        shutil.copy(self.folder / "r.h5", self.folder / "bad.h5")
        with h5py.File(self.folder / "bad.h5", "r+") as file:
            del file.attrs["content_sha256"]  # on purpose
            alter(file)
        for arguments in (["compare", "bad.h5", "r.h5"], ["compare", "r.h5", "bad.h5"],
                          ["report", "bad.h5", "--out", "page"]):
            if arguments[0] != "report" or with_report:
                yield arguments, self.run_program(arguments)

    def test_results_of_other_versions_and_files(self):
        self.finished_run()

        def newer(file):
            file.attrs.modify("format_version", 3)

        def replace(file, name, make):
            del file[name]
            make(file, name)
        alterations = {
            "format_version": newer,
            "links": lambda f: replace(f, "methods/improved", lambda f, n: f.__setitem__(n, h5py.ExternalLink("/etc/passwd", "/"))),
            "other files": lambda f: replace(f, "methods/improved/force", lambda f, n: f.create_dataset(
                n, (20, 3), "f8", external=[("/etc/passwd", 0, 480)])),
            "no force": lambda f: f.__delitem__("methods/improved/force"),
            "text": lambda f: replace(f, "methods/improved/force", lambda f, n: f.create_dataset(n, data="x")),
            "shape": lambda f: replace(f, "methods/improved/force", lambda f, n: f.create_dataset(n, (7,), "f8")),
            "huge": lambda f: replace(f, "methods/improved/force", lambda f, n: f.create_dataset(
                n, (10**15, 3), "f8", chunks=(1000, 3))),
        }
        for name, alter in alterations.items():
            # A page takes two seconds: only for damage that the program does not see before.
            for arguments, done in self.altered(alter, name in ("format_version", "text", "shape")):
                with self.subTest(alteration=name, arguments=arguments):
                    # A page needs no dataset that is missing; a comparison may call a missing one a
                    # difference, and is unsure with one process a side.
                    self.assertIn(done.returncode, (DONE, 1, INPUT_DATA, 4), done.stderr)
                    if name in ("format_version", "links", "other files", "huge"):
                        if arguments[0] == "compare" or name == "format_version":
                            self.assert_refused(done, INPUT_DATA, "bad.h5")

    def test_cut_and_flipped_results(self):
        self.finished_run()
        content = (self.folder / "r.h5").read_bytes()
        for step in range(1, 13):
            (self.folder / "bad.h5").write_bytes(
                content[:len(content) * step // 14] if step % 2 else flipped(content, range(step * 37, len(content), len(content) // 40)))
            for arguments in (["compare", "bad.h5", "r.h5"], ["report", "bad.h5", "--out", "page"])[:1 + (step < 3)]:
                self.assert_refused(self.run_program(arguments), INPUT_DATA, "bad.h5")

    def test_results_that_are_no_regular_files(self):
        os.mkfifo(self.folder / "fifo.h5")
        self.finished_run()
        for bad in ("fifo.h5", "/dev/zero", ".", "absent.h5"):
            for arguments in (["compare", bad, "r.h5"], ["compare", "r.h5", bad], ["report", bad, "--out", "page"]):
                self.assert_refused(self.run_program(arguments), INPUT_DATA, bad)

    def test_damaged_parts(self):
        part = self.folder / "r.h5.part"
        self.own_experiment(repetitions=6)
        self.begin_run()
        content = part.read_bytes()
        for step in range(1, 9):
            part.write_bytes(content[:len(content) * step // 10] if step % 2 else flipped(content, range(step, min(len(content), 4000), 97)))
            done = self.run_program(["run", "own.json", "--out", "r.h5", "--resume"])
            self.assertIn(done.returncode, (DONE, INPUT_DATA, ENVIRONMENT), done.stderr)
            self.assertFalse(re.search(r"[\x00-\x08\x0b-\x1f]", done.stderr))
            (self.folder / "r.h5").unlink(missing_ok=True)


if __name__ == "__main__":
    PROGRAM, SOURCE = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
