#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The page of a real run in a real browser: argument 1 is the program. No console error, no request, every section there,
plots zoom together, the 3D view draws pixels that change when it is turned, nothing is wider than the window."""

import json
import os
import subprocess
import sys
import tempfile
import unittest

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
# 3D graphics in software, and none of the requests that a browser makes of its own.
FLAGS = ("--headless=new", "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
         "--ignore-gpu-blocklist", "--force-prefers-reduced-motion")
SECTIONS = ("answer", "work_precision", "figure7", "frames", "scene", "study-claims", "omissions", "provenance")
PROGRAM = None


def open_browser():
    options = Options()
    for flag in FLAGS:
        options.add_argument(flag)
    options.binary_location = "/usr/bin/chromium"
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return webdriver.Chrome(options=options, service=Service("/usr/bin/chromedriver"))


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        result = os.path.join(cls.folder.name, "shapes.h5")
        out = os.path.join(cls.folder.name, "page")
        run = {"check": True, "cwd": ROOT, "stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL}
        subprocess.run([PROGRAM, "-q", "run", "experiments/shapes.json", "--out", result, "--set", "/frames=200"], **run)
        subprocess.run([PROGRAM, "-q", "report", result, "--out", out, "--study", "results/reference/claims.md"], **run)
        cls.page = os.path.join(out, "index.html")
        cls.browser = open_browser()
        cls.addClassCleanup(cls.browser.quit)
        cls.show(1280)

    @classmethod
    def show(cls, width):
        cls.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False})
        cls.browser.get("file://" + cls.page)

    def test_is_silent_and_asks_for_nothing(self):
        self.show(1280)
        self.assertEqual(self.browser.get_log("browser"), [])
        requests = [json.loads(entry["message"])["message"] for entry in self.browser.get_log("performance")]
        urls = {message["params"]["request"]["url"] for message in requests if message["method"] == "Network.requestWillBeSent"}
        self.assertEqual({url for url in urls if not url.startswith("data:")}, {"file://" + self.page})

    def test_has_every_section_and_an_answer(self):
        for section in SECTIONS:
            self.assertEqual(len(self.browser.find_elements(By.ID, section)), 1, section)
        self.assertIn("leaves the least force error", self.browser.find_element(By.CSS_SELECTOR, "#answer .lead").text)

    def test_plots_zoom_together(self):
        ranges = "return page.plots[0].map((plot) => plot.xAxisRange())"
        before = self.browser.execute_script(ranges)
        plot = self.browser.find_element(By.CSS_SELECTOR, ".panels .plot")
        self.browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", plot)
        ActionChains(self.browser).move_to_element_with_offset(plot, -100, 0).click_and_hold().move_by_offset(200, 0).release().perform()
        after = self.browser.execute_script(ranges)
        self.assertLess(after[0][1] - after[0][0], 0.5 * (before[0][1] - before[0][0]))
        for other in after[1:]:
            self.assertAlmostEqual(other[0], after[0][0], places=9)

    def picture(self):
        return self.browser.execute_script("return page.views[0].renderer.domElement.toDataURL()")

    def test_scene_turns_and_steps(self):
        canvas = self.browser.find_element(By.CSS_SELECTOR, ".view canvas")
        self.browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", canvas)
        colours = self.browser.execute_script(
            "const view = page.views[0], gl = view.renderer.getContext(); const size = [gl.drawingBufferWidth, gl.drawingBufferHeight];"
            "const pixels = new Uint8Array(4 * size[0] * size[1]); gl.readPixels(0, 0, size[0], size[1], gl.RGBA, gl.UNSIGNED_BYTE, pixels);"
            "return new Set(new Uint32Array(pixels.buffer)).size")
        self.assertGreater(colours, 50)
        before = self.picture()
        ActionChains(self.browser).move_to_element(canvas).click_and_hold().move_by_offset(120, 30).release().perform()
        turned = self.picture()
        self.assertNotEqual(before, turned)
        slider = self.browser.find_element(By.CSS_SELECTOR, ".view input")
        text = self.browser.find_element(By.CSS_SELECTOR, ".view output").text
        self.assertRegex(text, r"frame \d+, .* LMDs?")
        slider.send_keys(Keys.HOME)
        self.assertTrue(self.browser.find_element(By.CSS_SELECTOR, ".view output").text.startswith("frame 0,"))

    def test_fits_a_telephone(self):
        self.show(390)
        self.assertLessEqual(self.browser.execute_script("return document.documentElement.scrollWidth"), 390)
        self.show(1280)

    def test_turns_dark_by_a_button(self):
        colour = "return getComputedStyle(document.body).backgroundColor"
        before = self.browser.execute_script(colour)
        self.browser.find_element(By.ID, "theme").click()
        self.assertNotEqual(self.browser.execute_script(colour), before)


if __name__ == "__main__":
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
