# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Man pages and completion against --help: every command and option of it is in both, and bash completes what it should.
Arguments: the program, the folder of its manual."""

import gzip
import os
import re
import shutil
import subprocess
import sys
import unittest

PROGRAM, MANUAL = sys.argv.pop(1), sys.argv.pop(1)


def help_of(*command):
    return subprocess.run([PROGRAM, *command, "--help"], capture_output=True, text=True, check=True, timeout=60).stdout


def commands(path=()):
    """Paths of all commands, as --help lists them."""
    yield path
    _, _, listed = help_of(*path).partition("\nSubcommands:\n")
    for name in re.findall(r"^  ([a-z][a-z-]*) ", listed.split("\n\n")[0], re.MULTILINE):
        yield from commands((*path, name))


def options(path):
    """Names of a command's options, as --help writes them in front of its lines."""
    text = help_of(*path).split("\nSubcommands:")[0]
    _, _, listed = text.partition("\nOptions:\n")
    found = []
    for line in listed.splitlines():
        match = re.match(r"^  (-[\w-]+(?:,-[\w-]+)*)", line)
        if match:
            found += match.group(1).split(",")
    return found


def page(path):
    with gzip.open(os.path.join(MANUAL, "man", "-".join(("lmdbench", *path)) + ".1.gz"), "rt", encoding="utf-8") as stream:
        return stream.read()


def shown(path):
    """The page as a reader sees it, in one line."""
    name = os.path.join(MANUAL, "man", "-".join(("lmdbench", *path)) + ".1.gz")
    text = subprocess.run(["man", "--warnings", "--encoding=ascii", "--local-file", name], capture_output=True, text=True, timeout=60,
                          check=True, env={**os.environ, "MANWIDTH": "200", "LC_ALL": "C.UTF-8", "MANPAGER": "cat"})
    return text.stdout, text.stderr


def bash(*words):
    """What bash offers behind these words."""
    script = f"""source '{MANUAL}/bash/lmdbench'
COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _lmdbench 2>/dev/null; printf '%s\\n' "${{COMPREPLY[@]}}\""""
    done = subprocess.run(["bash", "-c", script, "bash", "lmdbench", *words], capture_output=True, text=True, timeout=60)
    return [line for line in done.stdout.splitlines() if line]


class Manual(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.commands = list(commands())
        cls.options = {path: options(path) for path in cls.commands}
        with open(os.path.join(MANUAL, "zsh", "_lmdbench"), encoding="utf-8") as stream:
            cls.zsh = stream.read()

    def test_help_was_understood(self):
        self.assertIn(("run",), self.commands)
        self.assertIn(("mesh", "info"), self.commands)
        self.assertGreaterEqual(len(self.commands), 15)
        self.assertIn("--cutoff", self.options[("query",)])
        self.assertIn("-o", self.options[("run",)])
        self.assertGreater(sum(map(len, self.options.values())), 60)

    def test_every_command_and_option_has_its_place_in_a_man_page(self):
        for path in self.commands:
            text = page(path).replace("\\-", "-")
            for option in self.options[path]:
                self.assertIn(f"\\fB{option}\\fR", text, path)
            self.assertTrue(text.startswith(f".TH {'-'.join(('lmdbench', *path)).upper()} 1 "), path)
        for path in self.commands[1:]:
            self.assertIn(f"\\fB{' '.join(path)}\\fR", page(path[:-1]).replace("\\-", "-"))
        self.assertEqual(len(os.listdir(os.path.join(MANUAL, "man"))), len(self.commands))

    def test_pages_are_read_without_a_warning_and_lose_no_word(self):
        if shutil.which("man") is None:
            self.fail("man is missing (remedy: apt-get install man-db)")
        for path in (("query",), ("run",), ()):
            text, warnings = shown(path)
            self.assertEqual(warnings, "")
            if not text.strip():
                self.fail(f"{path}: man shows nothing")
            words = re.sub(r"\s+", "", text)
            for line in help_of(*path).split("\n\n")[-1].splitlines():  # the footer: what roff could swallow
                self.assertIn(re.sub(r"\s+", "", line), words, path)

    def test_bash_completes_every_command_and_option(self):
        for path in self.commands:
            offered = bash(*path, "-")
            for option in self.options[path]:
                self.assertIn(option, offered, path)
            nested = {other[-1] for other in self.commands if other[:-1] == path and other}
            self.assertEqual(nested - set(bash(*path, "")), set(), path)

    def test_bash_completes_values(self):
        self.assertEqual(bash("query", "--method", "cert"), ["certified"])
        self.assertEqual(bash("query", "--moving", "a.off", "--method", "ne"), ["nearest"])
        self.assertIn("/driver/search_every_frames=", bash("run", "x.json", "--set", "/driver/"))
        self.assertEqual(bash("run", "--driver", "lock"), ["lockstep"])
        self.assertIn("--verbose", bash("mesh", "info", "--v"))
        folder = os.path.dirname(MANUAL)
        self.assertIn(MANUAL, bash("query", "--moving", os.path.join(folder, "man")))
        self.assertIn(MANUAL, bash("plan", os.path.join(folder, "man")))

    def test_zsh_knows_every_command_and_option(self):
        for path in self.commands:
            name = "_".join(("_lmdbench", *path)).replace("-", "_")
            body = self.zsh.split(f"\n{name}() {{\n")[1].split("\n}\n")[0]
            for option in self.options[path]:
                self.assertRegex(body, rf"'\*?{re.escape(option)}\[", path)
            for other in self.commands:
                if other and other[:-1] == path:
                    self.assertIn(f"'{other[-1]}:", body)

    def test_zsh_reads_it(self):
        if shutil.which("zsh") is None:
            self.skipTest("zsh is not installed")
        done = subprocess.run(["zsh", "-n", os.path.join(MANUAL, "zsh", "_lmdbench")], capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main()
