#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The page of two real runs, open and closed loop side by side, in a real browser: argument 1 is the program. No console
error, no request, every section there, plots zoom together, the 3D view draws pixels that change when it is turned, all of it
by keyboard, too; CSV files hold what is drawn; nothing is wider than the window."""

import csv
import json
import os
import subprocess
import sys
import unittest

import h5py
import numpy as np
from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

SCRIPTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts")
sys.path[:0] = [os.path.join(SCRIPTS, "figures", "tests"), os.path.join(SCRIPTS, "figures"), os.path.join(SCRIPTS, "report")]

from cases import ROOT, SharedScratch  # noqa: E402  (the figures' tests must be found first)
from answer import answer  # noqa: E402
from lmdbench_results import Result  # noqa: E402

# 3D graphics in software, and no requests that a browser makes by itself.
FLAGS = ("--headless=new", "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
         "--ignore-gpu-blocklist", "--force-prefers-reduced-motion")
SECTIONS = ("answer", "work_precision", "figure7", "frames", "scene", "claims", "paper", "study-claims", "omissions", "provenance")
PROGRAM = None


def open_browser():
    options = Options()
    for flag in FLAGS:
        options.add_argument(flag)
    options.binary_location = "/usr/bin/chromium"
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return webdriver.Chrome(options=options, service=Service("/usr/bin/chromedriver"))


class Page(SharedScratch):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        result, closed, out = (os.path.join(cls.folder, name) for name in ("shapes.h5", "closed.h5", "page"))

        def run(*words):
            subprocess.run(words, check=True, cwd=ROOT, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)

        shapes = ("-q", "run", "experiments/shapes.json", "--set", "/frames=600", "--out")
        run(PROGRAM, *shapes, result, "--set", "/record/lmds=true", "--set", "/record/polylines={\"stride_frames\": 10}")
        run(PROGRAM, *shapes, closed, "--set", "/loop={\"kind\": \"closed\"}")
        for figure, level in (("figure2", ["--level", "4"]), ("figure6", [])):
            run(sys.executable, f"scripts/figures/{figure}.py", "experiments/shapes.json", "--program", PROGRAM, "--out", cls.folder, *level)
        run(PROGRAM, "-q", "report", result, closed, "--out", out, "--paper", cls.folder, "--study", "results/reference/claims.md")
        cls.page = os.path.join(out, "index.html")
        cls.sentence = answer(Result(result))["sentence"]
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
        # Times of the run decide which sentence it is.
        self.assertEqual(self.browser.find_element(By.CSS_SELECTOR, "#answer .lead").text, self.sentence)

    def test_draws_the_papers_figures(self):
        widths = self.browser.execute_script("return Array.from(document.querySelectorAll('#paper img'), (image) => [image.complete, image.naturalWidth])")
        self.assertEqual(widths, [[True, 1000]] * 2)

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

    def test_variants_share_their_axes(self):
        open_loop, closed_loop = self.browser.execute_script("return page.plots.map((plots) => plots[0].yAxisRange())")
        self.assertEqual(open_loop, closed_loop)
        headings = [heading.text for heading in self.browser.find_elements(By.CSS_SELECTOR, "#answer h2")]
        self.assertEqual(headings, ["shapes: loop kind open", "shapes: loop kind closed"])

    def test_the_scene_begins_at_the_contact(self):
        away = self.browser.execute_script("const view = page.views[0]; view.look(); const [middle] = view.contact(); "
                                           "return [view.controls.target.distanceTo(middle), lmds_of(view.track.exact, Number(view.slider.value)).length]")
        self.assertEqual(away[0], 0)
        self.assertGreater(away[1], 0)

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

    def seen(self, selector):
        element = self.browser.find_element(By.CSS_SELECTOR, selector)
        self.browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", element)
        return element

    def test_scene_shows_the_methods_own_sets_and_hides_them(self):
        self.seen(".view .canvas")
        words = self.seen(".view .choices").text
        for choice in ("true LMDs", "LMDs of original", "LMDs of improved", "force of improved", "intersection"):
            self.assertIn(choice, words)
        self.assertRegex(self.browser.find_element(By.CSS_SELECTOR, ".view output").text, r"; original \d+, improved \d+")
        box = self.seen(".view .choices input")
        self.browser.execute_script("page.views[0].show(Number(page.views[0].slider.value))")
        before = self.picture()
        box.click()
        self.assertNotEqual(self.picture(), before)
        box.click()
        self.assertEqual(self.picture(), before)

    def test_scene_of_a_closed_loop_has_a_device_a_method(self):
        view = "document.querySelectorAll('.view')[1]"
        options = self.browser.execute_script(f"return Array.from({view}.querySelectorAll('option'), (option) => option.text)")
        self.assertEqual(sorted(options), ["device of improved", "device of original"])
        self.assertIn("recorded no LMDs of its methods", self.browser.execute_script(f"return {view}.querySelector('.choices').textContent"))

    def test_keyboard_turns_the_scene_and_zooms_the_plots(self):
        canvas = self.seen(".view .canvas")
        self.browser.execute_script("page.views[0].look()")
        whole = self.picture()
        canvas.send_keys(Keys.ARROW_RIGHT)
        self.assertNotEqual(self.picture(), whole)
        canvas.send_keys("0")
        self.assertEqual(self.picture(), whole)
        width = "const range = page.plots[0][1].xAxisRange(); return range[1] - range[0]"
        before = self.browser.execute_script(width)
        nearer = self.seen(".panels button[aria-label='nearer in time']")
        nearer.send_keys(Keys.ENTER)
        self.assertAlmostEqual(self.browser.execute_script(width), 0.5 * before, places=6)
        self.seen(".panels button[aria-label='the whole time']").send_keys(Keys.ENTER)
        self.assertAlmostEqual(self.browser.execute_script(width), before, places=6)

    def test_slider_and_plots_show_the_same_frame(self):
        self.browser.execute_script("page.views[0].go_to(0.25)")
        self.assertIn("frame 250,", self.browser.execute_script("return page.views[0].output.textContent"))
        self.seen(".view input[type=range]").send_keys(Keys.ARROW_RIGHT)
        self.assertEqual(self.browser.execute_script("return page.plots[0].map((plot) => plot.getSelection())[0]"), 251)

    def test_csv_holds_what_is_drawn(self):
        self.browser.execute_script("window.saved = []; const make = URL.createObjectURL; URL.createObjectURL = (blob) => { blob.text().then((text) => saved.push(text)); "
                                    "return make.call(URL, blob); }; HTMLAnchorElement.prototype.click = () => {};")
        self.browser.execute_script("document.querySelector('.panel button').click(); document.querySelector('[data-csv-result]').click(); "
                                    "document.querySelector('.study button').click(); document.querySelector('[data-csv-table]').click()")
        texts = self.browser.execute_async_script("const done = arguments[0]; const wait = () => saved.length < 4 ? setTimeout(wait, 20) : done(saved); wait()")
        panel, whole = sorted((text for text in texts if text.startswith("time [s]")), key=len)
        lines = list(csv.reader(panel.splitlines()))
        self.assertEqual(len(lines), 601)
        with h5py.File(self.path("shapes.h5")) as result:
            force = np.linalg.norm(result["methods/improved/force"][:], axis=1)
        column = lines[0].index("Force: improved [N]")
        np.testing.assert_allclose([float(line[column]) for line in lines[1:]], force, rtol=1e-6, atol=1e-9)
        self.assertIn("Local update: improved [us]", whole.splitlines()[0])
        self.show(1280)

    def test_a_link_unfolds_its_table(self):
        details = "return document.querySelector('#study-claims > details').open"
        self.assertFalse(self.browser.execute_script(details))
        self.browser.execute_script("location.hash = '#study-claims'")
        self.assertTrue(self.browser.execute_async_script("const done = arguments[0]; setTimeout(() => done(document.querySelector('#study-claims > details').open), 100)"))
        self.show(1280)

    def test_fits_a_telephone(self):
        self.show(390)
        shown = "return document.getElementById('sections').offsetHeight > 0"
        self.assertFalse(self.browser.execute_script(shown))
        self.browser.find_element(By.ID, "menu").click()
        self.assertTrue(self.browser.execute_script(shown))
        wide = "const image = document.querySelector('#work_precision img'); return image.naturalHeight > image.naturalWidth"
        self.assertTrue(self.browser.execute_script(wide))
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
