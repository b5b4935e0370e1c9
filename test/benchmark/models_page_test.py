#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What benchmarks/models/page.py keeps of a page, and in which order."""
import pathlib
import tempfile
import unittest

from models.chapters import CHAPTERS
from models.page import Page, anchor

TITLES = {"first": "Of springs, and more", "second": "Of cells"}


class PageTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = pathlib.Path(folder.name) / "page.md"

    def write(self, keep, **chapters):
        page = Page(self.file, keep)
        for name, text in chapters.items():
            page.put(name, text)
        page.write(TITLES)
        return self.file.read_text()

    def test_chapters_that_are_not_made_stay_as_they_are(self):
        before = self.write(True, second="## Of cells\n\nbefore\n", first="## Of springs, and more\n\nbefore\n")
        self.assertLess(before.index("## Of springs"), before.index("## Of cells"))
        self.assertEqual(self.write(True), before)
        after = self.write(True, second="## Of cells\n\nafterwards\n")
        self.assertEqual(after.replace("afterwards", "before"), before)
        self.assertEqual(after.count("afterwards"), 1)

    def test_a_page_of_its_own_has_only_what_was_made(self):
        self.write(True, first="a", second="b")
        self.assertNotIn("Of springs", self.write(False, second="b"))

    def test_chapters_that_are_no_more_go(self):
        self.write(True, first="a", third="gone")
        self.assertNotIn("gone", self.file.read_text())

    def test_the_list_leads_to_the_headings(self):
        self.assertIn("(#of-springs-and-more)", self.write(True, first="a"))
        self.assertEqual(anchor("Table 2.1: the models"), "table-21-the-models")

    def test_no_part_is_in_two_chapters(self):
        parts = [part for chapter in CHAPTERS.values() for part in chapter.parts]
        self.assertEqual(len(parts), len(set(parts)))


if __name__ == "__main__":
    unittest.main()
