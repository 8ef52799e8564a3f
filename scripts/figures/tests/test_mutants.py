# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Every planted defect of scripts/mutants.txt fits the code as it is: scripts/mutants.sh, which takes hours, can plant it."""

import re
import unittest

from cases import text_of


def mutants():
    found, file = [], ""
    for line in text_of("scripts", "mutants.txt").splitlines():
        if re.match("[^ #]", line):
            file = line.split()[0]
        elif mutant := re.fullmatch(r"  ([\w-]+)(?: \(\S+\))?: (.*?) =>(?: (.*))?", line):
            found.append({"file": file, **dict(zip(("name", "from", "to"), mutant.groups("")))})
        elif not re.fullmatch("|#.*|    equivalent: .+", line):
            raise ValueError(f"scripts/mutants.txt: what is this: {line}")
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
