# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""What results of one experiment under several settings are called, and the axes that they share."""

import tempfile

from cases import Scratch
import figure7
from lmdbench_results import UsageError
from synthetic import write_result
from variants import open_results


def method(name, label=None, **options):
    return {"name": name, "label": label or name, **options}


class Names(Scratch):
    def names(self, *settings):
        folder = tempfile.mkdtemp(dir=self.folder)
        return [result.name for result in open_results([write_result(f"{folder}/{i}.h5", "hard", frames=100, settings=one)
                                                        for i, one in enumerate(settings)])]

    def test_are_of_what_differs(self):
        self.assertEqual(self.names({"force": {"aggregation": "sum", "sharpness": 4}}, {"force": {"aggregation": "shared", "sharpness": 4}}),
                         ["hard: aggregation sum", "hard: aggregation shared"])
        self.assertEqual(self.names({"driver": {"search_every_frames": 20}, "device": "ideal"}, {"driver": {"search_every_frames": 40}, "device": None}),
                         ["hard: search every frames 20, device ideal", "hard: search every frames 40, device none"])

    def test_say_whose_key_it_is_where_several_have_it(self):
        self.assertEqual(self.names({"methods": [method("improved", plain_cache=True), method("improved", "other", plain_cache=True)]},
                                    {"methods": [method("improved", "other", plain_cache=True), method("improved", plain_cache=False)]}),
                         ["hard: improved plain cache on", "hard: improved plain cache off"])
        self.assertEqual(self.names({"fixed": [{"mesh": "b"}]}, {"fixed": [{"mesh": "c"}]}), ["hard: fixed mesh b", "hard: fixed mesh c"])

    def test_tell_a_method_that_one_lacks_by_its_name(self):
        self.assertEqual(self.names({"methods": [method("improved", plain_cache=True)]}, {"methods": [method("improved", plain_cache=True), method("nearest")]}),
                         ["hard: methods improved", "hard: methods improved, nearest"])

    def test_tell_a_list_of_profiles_by_their_names(self):
        one, other = {"cutoff_m": 0.001, "sharpness": 4}, {"cutoff_m": 0.002, "sharpness": 4}
        both = [{"name": "hard", **one}, {"name": "soft", **other}]
        self.assertEqual(self.names({"force": one}, {"force": both}), ["hard", "hard: profiles hard, soft"])
        self.assertEqual(self.names({"force": both[:1]}, {"force": both}), ["hard: profiles hard", "hard: profiles hard, soft"])
        self.assertEqual(self.names({"force": one}, {"force": both}, {"force": other}),
                         ["hard: force cutoff m 0.001", "hard: profiles hard, soft", "hard: force cutoff m 0.002"])
        self.assertEqual(self.names({"force": both}, {"force": [both[0], {**both[1], "sharpness": 2}]}), ["hard: soft sharpness 4", "hard: soft sharpness 2"])

    def test_are_of_what_decides_results(self):
        self.assertEqual(self.names({"record": {"lmds": True}, "device": "a"}, {"record": {"lmds": False}, "device": "b"}), ["hard: device a", "hard: device b"])
        self.assertEqual(self.names({"record": {"lmds": True}}, {"record": {"lmds": False}}), ["hard: lmds on", "hard: lmds off"])

    def test_are_of_the_files_where_nothing_differs(self):
        self.assertEqual(self.names({}, {}), ["hard (0.h5)", "hard (1.h5)"])
        self.assertEqual(self.names({"device": "a"}, {"device": "b"}, {"device": "a"}), ["hard: device a (0.h5)", "hard: device b", "hard: device a (2.h5)"])

    def test_of_several_experiments_stay(self):
        files = [write_result(self.path(f"{name}.h5"), name, frames=100) for name in ("hard", "soft")]
        self.assertEqual([result.name for result in open_results(files)], ["hard", "soft"])

    def test_a_file_given_twice_is_refused(self):
        file = write_result(self.path("a.h5"), frames=100)
        with self.assertRaisesRegex(UsageError, "there twice.*remedy"):
            open_results([file, file])
        self.assertEqual(UsageError.exit_code, 2)


class Axes(Scratch):
    def drawn(self, *results):
        """Axes of Figure 7, a row a list."""
        files = [write_result(self.path(f"{i}.h5"), frames=400, **options) for i, options in enumerate(results)]
        axes = figure7.draw(*open_results(files)).axes
        return [axes[i:i + len(files)] for i in range(0, len(axes), len(files))]

    def test_of_variants_are_the_same_and_hold_both(self):
        rows = self.drawn({"settings": {"device": "a"}}, {"settings": {"device": "b"}, "maximum_force": 6.0})
        for left, right in rows:
            self.assertEqual(left.get_ylim(), right.get_ylim())
            self.assertEqual(list(left.get_yticks()), list(right.get_yticks()))
        self.assertGreater(rows[0][0].get_ylim()[1], 6.0)

    def test_of_other_experiments_are_their_own(self):
        left, right = self.drawn({"name": "hard"}, {"name": "soft", "maximum_force": 6.0})[0]
        self.assertLess(left.get_ylim()[1], 0.5 * right.get_ylim()[1])
