# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Every planted defect of scripts/mutants.txt fits the code as it is: scripts/mutants.sh, which takes hours, can plant it."""

import fnmatch
import re
import unittest

from cases import ROOT, text_of


def mutants():
    found, file = [], ""
    for line in text_of("scripts", "mutants.txt").splitlines():
        if re.match("[^ #]", line):
            file, program, tests = (line + " *").split()[:3]
        elif mutant := re.fullmatch(r"  ([\w-]+)(?: \((\S+)\))?: (.*?) =>(?: (.*))?", line):
            named = dict(zip(("name", "tests", "from", "to"), mutant.groups("")))
            found.append({"file": file, "program": program, **named, "tests": named["tests"] or tests})
        elif not re.fullmatch("|#.*|    equivalent: .+", line):
            raise ValueError(f"scripts/mutants.txt: what is this: {line}")
    return found


def tests_of_programs():
    """Suite.Test of each program of lmdbench_add_test; of values without the instance's name."""
    found = {}
    for listing in (*ROOT.glob("tests/**/CMakeLists.txt"), *ROOT.glob("experiments/**/CMakeLists.txt")):
        for program, sources in re.findall(r"lmdbench_add_test\((\w+)\s.*?SOURCES(.*?)DEPENDS", listing.read_text(), re.DOTALL):
            for source in sources.split():
                tests = re.findall(r"^(?:TYPED_)?TEST(?:_P|_F)?\((\w+), (\w+)\)", (listing.parent / source).read_text(), re.MULTILINE)
                found.setdefault(program, []).extend(map(".".join, tests))
    return found


class Mutants(unittest.TestCase):
    def test_each_has_a_name_of_its_own(self):
        names = [mutant["name"] for mutant in mutants()]
        self.assertGreater(len(names), 200)
        self.assertEqual(sorted(names), sorted(set(names)))

    def test_each_fits_the_code(self):
        for mutant in mutants():
            with self.subTest(mutant["name"]):
                lines = [line for line in text_of(mutant["file"]).splitlines() if mutant["from"] in line]
                self.assertEqual(len(lines), 1, (mutant["file"], mutant["from"]))
                self.assertNotEqual(mutant["from"], mutant["to"])

    def test_each_has_tests_that_may_notice_it(self):
        tests = tests_of_programs()
        self.assertGreater(len(tests), 30)
        for mutant in mutants():
            with self.subTest(mutant["name"]):
                for pattern in mutant["tests"].split(":"):
                    own = re.sub(r"^\w+/|/[^.]*$", "", pattern)
                    self.assertTrue(fnmatch.filter(tests[mutant["program"]], own), (mutant["program"], pattern))
