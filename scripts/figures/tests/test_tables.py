# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Tables that show names as they are."""

import unittest

import markdown

import cases  # noqa: F401
from tables import percent, table_text

NAME = 'a|b <img src=x onerror="alert(1)"> & c'


class Cells(unittest.TestCase):
    def test_names_end_no_cell_and_are_no_html(self):
        text = table_text([NAME, "value"], [[NAME, 1.5], ["**bold**", "[K1](#k1)"]])
        made = markdown.markdown(text, extensions=["tables"])
        self.assertNotIn("<img", made)
        shown = 'a|b &lt;img src=x onerror="alert(1)"&gt; &amp; c'
        self.assertIn(f"<th>{shown}</th>", made)
        self.assertIn(f"<td>{shown}</td>\n<td>1.5</td>", made)
        self.assertIn("<strong>bold</strong>", made, "Markdown of the scripts stays")

    def test_less_than_all_is_not_told_as_all(self):
        self.assertEqual([percent(share) for share in (0.5, 0.9994, 0.9998, 1.0)], ["50.0", "99.9", "> 99.9", "100.0"])
