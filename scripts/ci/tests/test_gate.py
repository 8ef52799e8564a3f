# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The gate as CI services run it: the commands of both workflow files, on a repository whose commits do not build, do not run,
differ, are slower or the same. Builds are played: `cmake` leaves a program that copies results made beforehand, whose times are
known, and hands `compare` to the real program, which the environment variable LMDBENCH_PROGRAM names."""

import os
import random
import shutil
import subprocess
import sys
import xml.etree.ElementTree
from pathlib import Path

import h5py
import yaml

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "figures", "tests"))

from cases import PROGRAM, ROOT, SCRIPTS, SharedScratch, call, text_of  # noqa: E402  (the figures' tests must be found first)

ROUNDS = 24  # as many as ci_regression.sh runs at most

CMAKE = """#!/bin/sh
[ "$1" = --build ] || exit 0
read -r behaviour <behaviour
if [ "$behaviour" = no-build ]; then echo "src/main.cpp:1: error: expected ';' & <more>" >&2; exit 1; fi
mkdir -p build/release
cat >build/release/lmdbench <<END
#!/bin/sh
behaviour=$behaviour
. {folder}/program.sh
END
chmod +x build/release/lmdbench
"""

# What every played program does; `kind` is where its results come from.
PLAYED = """
[ $behaviour != no-start ] || { echo 'missing library' >&2; exit 127; }
case "$*" in *compare*|--help) exec {program} "$@" ;; esac
[ $behaviour != no-run ] || { echo 'a bug of ours' >&2; exit 70; }
while [ "$1" != --out ]; do shift; done
kind=$behaviour
[ -z "$PLAYED_LOAD" ] || kind=load
[ -d {folder}/results/$kind ] || kind=same
cp {folder}/results/$kind/$(basename "$2") "$2"
"""


def make_results(folder):
    """results/KIND/NAME-ROUND.h5: copies of one result with times of their own; the spread is 0.3 %, 60 % under load."""
    template = os.path.join(folder, "template.h5")
    subprocess.run([PROGRAM, "--quiet", "run", ROOT / "experiments" / "shapes.json", "--set", "/frames=60", "--set", "/probes/truth/stride_frames=0",
                    "--set", "/probes/fcl/stride_frames=0", "--out", template], check=True, stdout=subprocess.DEVNULL)
    generator = random.Random(30)
    for kind, names, factor, spread in (("same", ("base", "null", "cand"), 1.0, 0.003), ("slower", ("cand",), 1.3, 0.003),
                                        ("faster", ("cand",), 0.7, 0.003),
                                        ("differs", ("cand",), 1.0, 0.003), ("load", ("base", "null", "cand"), 1.0, 0.6)):
        os.makedirs(os.path.join(folder, "results", kind))
        for name in names:
            for index in range(ROUNDS):
                file = os.path.join(folder, "results", kind, f"{name}-{index}.h5")
                shutil.copy(template, file)
                with h5py.File(file, "r+") as h5:
                    del h5.attrs["content_sha256"]  # changed on purpose
                    for method in h5["methods"].values():
                        for dataset in [d for d in method if d.endswith("_time")]:
                            method[dataset][...] = method[dataset][()] * factor * generator.lognormvariate(0.0, spread)
                    if kind == "differs":
                        h5["methods/improved/force"][3] += 0.001


class GateTest(SharedScratch):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        make_results(cls.folder)
        tools = os.path.join(cls.folder, "tools")
        os.makedirs(tools)
        for name, text in (("cmake", CMAKE), ("valgrind", "#!/bin/sh\nexit 1\n")):
            Path(tools, name).write_text(text.replace("{folder}", cls.folder), encoding="utf-8")
            os.chmod(os.path.join(tools, name), 0o755)
        Path(cls.folder, "program.sh").write_text(PLAYED.replace("{folder}", cls.folder).replace("{program}", PROGRAM), encoding="utf-8")
        cls.environment = {"PATH": f"{tools}:{os.path.dirname(sys.executable)}:/usr/bin:/bin", "HOME": cls.folder,
                           "PYTHONDONTWRITEBYTECODE": "1"}
        cls.repository = os.path.join(cls.folder, "repository")
        shutil.copytree(SCRIPTS, os.path.join(cls.repository, "scripts"),
                        ignore=shutil.ignore_patterns("__pycache__"))
        os.makedirs(os.path.join(cls.repository, "experiments"))
        shutil.copy(ROOT / "experiments" / "shapes.json", os.path.join(cls.repository, "experiments"))
        cls.git("init", "--quiet")
        cls.commits = {}
        for behaviour in ("same", "base", "slower", "faster", "differs", "no-build", "no-run", "no-start"):
            Path(cls.repository, "behaviour").write_text(behaviour + "\n", encoding="utf-8")
            cls.git("add", "--all")
            cls.git("-c", "user.name=t", "-c", "user.email=t@example.org", "commit", "--quiet", "--message", behaviour)
            cls.commits[behaviour] = cls.git("rev-parse", "HEAD").strip()
        cls.github = yaml.safe_load(text_of("scripts", "ci", "github-actions.yml"))["jobs"]["regression"]
        cls.gitlab = yaml.safe_load(text_of("scripts", "ci", "gitlab-ci.yml"))["regression"]

    @classmethod
    def git(cls, *words):
        return subprocess.run(["git", "-C", cls.repository, *words], check=True, capture_output=True, text=True,
                              env=cls.environment).stdout

    def shell(self, lines, **variables):
        return call("bash", "-e", "-c", lines, cwd=self.repository, env={**self.environment, **variables})

    def on_gitlab(self, base, candidate, **variables):
        """(outcome of the job, exit code of its script)."""
        done = self.shell("\n".join(self.gitlab["script"]), CI_MERGE_REQUEST_DIFF_BASE_SHA=self.commits[base],
                          CI_COMMIT_SHA=self.commits[candidate], **variables)
        allowed = self.gitlab["allow_failure"]["exit_codes"]
        word = {0: "passed", allowed: "warning"}.get(done.returncode, "failed")
        return word, done.returncode

    def on_github(self, base, candidate, **variables):
        """(outcome of the step, its annotation, the job's summary)."""
        (step,) = [step for step in self.github["steps"] if step.get("name") == "Compare with the base"]
        lines = step["run"].replace("${{ github.event.pull_request.base.sha }}", self.commits[base])
        lines = lines.replace("${{ github.event.pull_request.head.sha }}", self.commits[candidate])
        self.assertNotIn("${{", lines)
        done = self.shell(lines, GITHUB_ACTIONS="true", GITHUB_STEP_SUMMARY=self.write("summary.md", ""), **variables)
        notes = [line for line in done.stdout.splitlines() if line.startswith("::")]
        return "failed" if done.returncode else "passed", notes[0].split("::")[1] if notes else "", self.read("summary.md")

    def junit(self):
        """(failures, errors, text of the first error)."""
        root = xml.etree.ElementTree.parse(os.path.join(self.repository, "build", "ci", "junit.xml")).getroot()
        error = root.find(".//error")
        return int(root.get("failures")), int(root.get("errors")), "" if error is None else error.text

    def check(self, base, candidate, code, gitlab, github, summary, **variables):
        self.assertEqual(self.on_gitlab(base, candidate, **variables), (gitlab, code))
        word, note, text = self.on_github(base, candidate, **variables)
        self.assertEqual((word, note), github)
        self.assertRegex(text, summary)

    def test_the_same(self):
        self.check("base", "same", 0, "passed", ("passed", ""), r"verdict: same \(")
        self.assertEqual(self.junit()[:2], (0, 0))

    def test_slower(self):
        self.check("base", "slower", 1, "failed", ("failed", "error"), r"verdict: slower \(")
        self.assertGreater(self.junit()[0], 0)

    def test_faster(self):
        self.check("base", "faster", 0, "passed", ("passed", ""), r"verdict: faster \(")

    def test_differs(self):
        self.check("base", "differs", 1, "failed", ("failed", "error"), r"improved \| `force` \| 3")

    def test_under_load_is_unsure_and_alone_has_exit_code_4(self):
        self.check("base", "same", 4, "warning", ("passed", "notice"), r"verdict: unsure \(", PLAYED_LOAD="1")
        self.assertEqual(self.junit()[:2], (0, 0))

    def test_a_candidate_that_does_not_build(self):
        self.check("base", "no-build", 1, "failed", ("failed", "error"), "candidate [0-9a-f]+ does not build")
        failures, errors, text = self.junit()
        self.assertEqual((failures, errors), (0, 1))
        self.assertIn("error: expected ';' & <more>", text)

    def test_a_candidate_that_does_not_run(self):
        self.check("base", "no-run", 1, "failed", ("failed", "error"), "candidate's run left with 70")
        self.assertEqual(self.junit(), (0, 1, "a bug of ours"))

    def test_a_candidate_that_does_not_start(self):
        self.check("base", "no-start", 1, "failed", ("failed", "error"), "does not start")
        self.assertEqual(self.junit(), (0, 1, "missing library"))

    def test_a_base_that_does_not_build_or_run_is_no_comparison(self):
        for base in ("no-build", "no-run"):
            for candidate in ("same", base):
                self.check(base, candidate, 3, "failed", ("failed", "error"), "no comparison: the base")
                self.assertEqual(self.junit()[:2], (0, 1))
