# SPDX-License-Identifier: BSD-3-Clause
"""docs/accuracy.md is what benchmarks/page.py writes from the results that are on record, every place in its
words has a piece that fills it, and its figures are there."""
import os
import re
import sys
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "benchmarks"))

import page  # noqa: E402


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


class AccuracyPage(unittest.TestCase):
    def test_page_is_what_its_generator_writes(self):
        self.assertEqual(read(page.PAGE).split("\n"), page.page().split("\n"),
                         "run /usr/bin/python3 benchmarks/page.py")

    def test_every_piece_has_its_place(self):
        places = re.findall(r"\{\{(.+?)\}\}", read(page.WORDS))
        self.assertEqual(sorted(places), sorted(page.PIECES))
        self.assertNotIn("{{", read(page.PAGE))

    def test_figures_are_of_what_was_measured(self):
        text = read(page.PAGE)
        for image, source in (("accuracy-curves", "accuracy-curves"), ("accuracy-saving", "accuracy-runs"),
                              ("accuracy-calibration", "calibration"), ("direct-scaling", "direct-scaling"),
                              ("radiosity-scaling", "radiosity-scaling"), ("view-factors", "view-factors")):
            self.assertEqual(f"images/{image}.png" in text, page.result(source) is not None, image)
        for image in re.findall(r"\(images/(.+?)\)", text):
            self.assertTrue(os.path.exists(os.path.join(ROOT, "docs", "images", image)), image)



if __name__ == "__main__":
    unittest.main()
