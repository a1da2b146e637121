#!/usr/bin/env python3
"""Opens a report in headless Chromium and uses it as a reader would.

report_test.py REPORT.html [--screenshots FOLDER]

Exit status 77 where chromium or chromedriver is not installed, which ctest counts as skipped.
"""

import sys
import time

import page
from page import FLEXURE_PATHS, UNTIDY, PageTest

PATHS = ("path", "inverse")


class ReportTest(PageTest):
    def path_study(self):
        for study in self.studies:
            self.open_study(study)
            if self.kind() in PATHS:
                return study
        self.skipTest("no study of kind path")

    def test_every_tab_opens_and_draws(self):
        self.assertGreater(len(self.studies), 0)
        for study in self.studies:
            with self.subTest(study=study):
                self.open_study(study)
                selected = self.browser.script(
                    "return document.querySelector('[aria-selected=true]').dataset.study")
                self.assertEqual(study, selected)
                still = self.kind() in ("linear", "response")
                drawn = ".still-flexures path" if still else ".flexures path"
                sizes = self.browser.script(
                    "return [...document.querySelectorAll(arguments[0])].map((p) => {"
                    "const b = p.getBBox(); return Math.max(b.width, b.height); })", drawn)
                self.assertGreater(len(sizes), 0)
                self.assertGreater(min(sizes), 1.0)
                self.assertGreater(self.browser.script(
                    "return document.querySelectorAll('tbody td').length"), 0)

    def test_address_opens_its_study(self):
        last = self.studies[-1]
        self.browser.script("window.location.hash = '#' + encodeURIComponent(arguments[0])", last)
        time.sleep(0.2)
        self.assertEqual(last, self.browser.script(
            "return document.querySelector('[aria-selected=true]').dataset.study"))

    def test_slider_moves_the_mechanism(self):
        self.path_study()
        shapes = []
        for share in (0.0, 0.37, 1.0):
            self.seek(share)
            shapes.append([path["d"] for path in self.browser.script(FLEXURE_PATHS)])
        self.assertNotEqual(shapes[0], shapes[1])
        self.assertNotEqual(shapes[1], shapes[2])
        for shape in shapes:
            self.assertFalse(any("NaN" in d or not d for d in shape))

    def test_play_moves_the_slider_and_pause_stops_it(self):
        self.path_study()
        self.seek(0.1)
        value = "return Number(document.getElementById('load-slider').value)"
        before = self.browser.script(value)
        self.browser.script("document.getElementById('play').click()")
        time.sleep(0.5)
        self.browser.script("document.getElementById('play').click()")
        paused = self.browser.script(value)
        self.assertGreater(paused, before)
        time.sleep(0.3)
        self.assertEqual(paused, self.browser.script(value))

    def test_toggle_hides_a_modeling_everywhere(self):
        self.path_study()
        toggles = self.browser.script("return [...document.querySelectorAll('.legend input')]"
                                      ".map((box) => box.dataset.toggle)")
        click = ("[...document.querySelectorAll('.legend input')]"
                 ".find((box) => box.dataset.toggle === arguments[0]).click()")
        shown = "return [...new Set([...document.querySelectorAll('.flexures path')]" \
                ".map((path) => path.dataset.modeling))]"
        lines = "return document.querySelectorAll('.chart-line').length"
        labels = self.browser.script(shown)  # a modeling that never began is not drawn
        self.assertLessEqual(set(labels), set(toggles))
        before = self.browser.script(lines)
        self.browser.script(click, labels[0])
        self.assertEqual(set(labels[1:]), set(self.browser.script(shown)))
        self.assertLess(self.browser.script(lines), before)
        for label in labels[1:]:
            self.browser.script(click, label)
        self.assertEqual([], self.browser.script(shown))

    def test_chart_shows_values_under_the_pointer(self):
        self.path_study()
        tip = self.browser.script("""
          const frame = document.querySelector('.chart-frame');
          const box = frame.getBoundingClientRect();
          frame.dispatchEvent(new PointerEvent('pointermove',
            { clientX: box.left + box.width / 2, clientY: box.top + 50, bubbles: true }));
          const tip = frame.querySelector('.chart-tip');
          return tip.hidden ? '' : tip.textContent;
        """)
        self.assertRegex(tip, r"[a-z ]+\d")

    def test_choosing_a_point_changes_plots_and_table(self):
        self.path_study()
        state = "return document.querySelector('.chart-line').getAttribute('d')" \
                " + document.querySelector('#comparison').textContent"
        before = self.browser.script(state)
        self.browser.script("const s = document.getElementById('subject');"
                            "s.selectedIndex = s.options.length - 2;"
                            "s.dispatchEvent(new Event('change'))")
        self.assertNotEqual(before, self.browser.script(state))

    def painted(self):
        """How many pixels of the canvas over the mechanism are not clear, and of how many hues."""
        return self.browser.script("""
          const sheet = document.querySelector('.view-canvas');
          if (!sheet) return [0, 0];
          const copy = document.createElement('canvas');
          [copy.width, copy.height] = [sheet.width, sheet.height];
          const context = copy.getContext('2d', { willReadFrequently: true });
          context.drawImage(sheet, 0, 0);
          const { data } = context.getImageData(0, 0, sheet.width, sheet.height);
          const hues = new Set();
          let count = 0;
          for (let i = 0; i < data.length; i += 4) {
            if (data[i + 3] < 250) continue;
            count += 1;
            hues.add((data[i] >> 4) + ' ' + (data[i + 1] >> 4) + ' ' + (data[i + 2] >> 4));
          }
          return [count, hues.size];
        """)

    def choose_field(self, key):
        self.browser.script(
            "document.querySelector(`[name=field][value='${arguments[0]}']`).click()", key)
        time.sleep(0.1)

    def test_stress_colours_the_flexures_of_the_last_state(self):
        self.open_study("push")
        self.seek(0.4)
        self.assertEqual(0, self.painted()[0])
        for key in ("von_mises", "first", "second", "xx", "yy", "xy"):
            self.choose_field(key)
            count, hues = self.painted()
            self.assertGreater(count, 1000, key)
            self.assertGreater(hues, 10, key)
            self.assertRegex(self.texts("#field-caption")[0], "continuum: .* to .* N/mm².*0.40 %")
        self.assertIn("N/mm²", self.texts(".colour-bar-high")[0])
        self.seek(0.4)
        self.assertEqual(0, self.painted()[0])
        self.assertIn("end of the slider", self.texts("#field-caption")[0])
        self.choose_field("")
        self.assertEqual("", self.texts("#field-caption")[0])

    def test_stress_of_every_step_follows_the_slider(self):
        self.open_study("lift & turn")
        self.choose_field("von_mises")
        captions = set()
        for share in (0.0, 0.325, 0.7, 1.0):
            self.seek(share)
            self.assertGreater(self.painted()[0], 1000)
            captions.add(self.texts("#field-caption")[0])
        self.assertEqual(4, len(captions))
        self.choose_field("")
        self.assertEqual(0, self.painted()[0])

    def choose_diagram(self, key):
        self.browser.script("document.querySelector(`[name=diagram][value='${arguments[0]}']`)"
                            ".click()", key)
        time.sleep(0.1)

    def test_diagram_is_drawn_on_the_last_state(self):
        drawn = """
          return { fills: [...document.querySelectorAll('.diagram-fill')]
                     .map((path) => path.getAttribute('d')),
                   labels: [...document.querySelectorAll('.diagram-names text')]
                     .map((text) => text.textContent),
                   caption: document.getElementById('diagram-caption').textContent,
                   slider: document.getElementById('load-slider').value
                     / document.getElementById('load-slider').max };
        """
        self.path_study()
        self.assertEqual([], self.browser.script(drawn)["fills"])
        self.seek(0.4)
        shapes = set()
        for key, label in (("axial_force", "N "), ("shear_force", "V "),
                           ("bending_moment", "M "), ("stress", "σ ")):
            self.choose_diagram(key)
            now = self.browser.script(drawn)
            self.assertEqual(1.0, now["slider"], "a diagram is of the last state")
            self.assertGreater(len(now["fills"]), 0)
            self.assertFalse(any("NaN" in d or not d for d in now["fills"]))
            self.assertGreater(len(now["labels"]), 0)
            self.assertTrue(all(text.startswith(label) for text in now["labels"]), now["labels"])
            shapes.add("".join(now["fills"]))
        self.assertEqual(4, len(shapes))
        self.seek(0.4)
        now = self.browser.script(drawn)
        self.assertEqual([], now["fills"])
        self.assertIn("end of the slider", now["caption"])
        self.seek(1.0)
        self.assertGreater(len(self.browser.script(drawn)["fills"]), 0)
        self.choose_diagram("")
        now = self.browser.script(drawn)
        self.assertEqual(([], ""), (now["fills"], now["caption"]))

    def test_largest_ordinate_keeps_to_the_mechanism(self):
        self.path_study()
        self.choose_diagram("bending_moment")
        size, diagram = self.browser.script("""
          const box = (selector) => {
            const b = document.querySelector(selector).getBBox();
            return Math.max(b.width, b.height);
          };
          return [box('.ghost-flexures'), box('.diagrams')];
        """)
        self.assertGreater(diagram, 0.1 * size)
        self.assertLess(diagram, 3.0 * size)

    def test_address_may_choose_a_diagram(self):
        study = self.path_study()
        self.browser.script("window.location.hash = '#' + encodeURIComponent(arguments[0])"
                            " + '/bending_moment'", study)
        time.sleep(0.2)
        self.assertEqual("bending_moment", self.browser.script(
            "return document.querySelector('[name=diagram]:checked').value"))
        self.assertGreater(self.browser.script(
            "return document.querySelectorAll('.diagram-fill').length"), 0)

    def test_a_stage_is_drawn_and_its_stiffness_listed(self):
        count = "return document.querySelectorAll(arguments[0]).length"
        stages = 0
        for study in self.studies:
            self.open_study(study)
            charts = self.browser.script(count, ".stage-plots .chart")
            if charts == 0:
                continue
            stages += 1
            self.assertGreaterEqual(charts, 6)
            lines = self.browser.script(
                "return [...document.querySelectorAll('.stage-plots .chart-line')]"
                ".map((path) => path.getAttribute('d'))")
            self.assertGreater(len(lines), charts)
            self.assertFalse(any("NaN" in d for d in lines))
            self.assertGreaterEqual(self.browser.script(count, ".condensed tbody tr"), 3)
        self.assertGreater(stages, 0, "no study shows a stage")

    def test_fields_are_drawn_and_named(self):
        seen = 0
        for study in self.studies:
            self.open_study(study)
            if self.kind() not in PATHS:
                continue
            self.seek(1.0)
            arrows = self.browser.script(
                "return [...document.querySelectorAll('.fields path')]"
                ".map((path) => path.getAttribute('d'))")
            self.assertFalse(any("NaN" in d or not d for d in arrows))
            header = self.browser.script(
                "return document.querySelector('.study-header').textContent")
            self.assertEqual(len(arrows) > 0, "along" in header or "gravity" in header)
            seen += len(arrows)
        self.assertGreater(seen, 0)

    def test_springs_follow_the_mechanism(self):
        drawn = ("return [...document.querySelectorAll('.springs path')]"
                 ".map((path) => path.getAttribute('d'))")
        self.path_study()
        self.seek(0.0)
        before = self.browser.script(drawn)
        self.seek(1.0)
        after = self.browser.script(drawn)
        self.assertGreater(len(before), 0)
        self.assertNotEqual(before, after)
        self.assertFalse(any("NaN" in d or not d for d in before + after))

    def test_extremes_and_safety_are_listed(self):
        safeties = 0
        for study in self.studies:
            self.open_study(study)
            if self.kind() not in PATHS:
                continue
            rows = self.browser.script(
                "return [...document.querySelectorAll('#extremes tbody tr')]"
                ".map((row) => row.textContent)")
            self.assertGreater(len(rows), 0)
            self.assertTrue(any("s = " in row for row in rows))
            safeties += self.browser.script(
                "return [...document.querySelectorAll('#extremes th')]"
                ".filter((head) => head.textContent.startsWith('Safety')).length")
        self.assertGreater(safeties, 0)

    def test_choosing_a_record_shows_its_ellipse(self):
        for study in self.studies:
            self.open_study(study)
            if self.kind() == "linear":
                break
        else:
            self.skipTest("no study of kind linear")
        chosen = "return document.querySelector('.ellipse.is-chosen').getAttribute('d')"
        before = self.browser.script(chosen)
        self.browser.script("document.querySelector('.row-button').click()")
        self.assertNotEqual(before, self.browser.script(chosen))

    def test_zoom_buttons_scale_the_drawing(self):
        size = "const b = document.querySelector('.ghost-flexures path, .still-flexures path')" \
               ".getBBox(); return Math.max(b.width, b.height)"
        before = self.browser.script(size)
        self.browser.script("document.querySelector('.view-buttons button').click()")
        time.sleep(0.4)
        self.assertGreater(self.browser.script(size), 1.2 * before)

    def test_texts_are_tidy_at_common_sizes(self):
        for width in (1100, 1280, 1920, 390):
            self.browser.resize(width, 900)
            for study in self.studies:
                with self.subTest(width=width, study=study):
                    self.open_study(study)
                    if self.kind() in PATHS:
                        self.choose_diagram("stress")
                    self.assertEqual([], self.browser.script(UNTIDY))
        self.browser.resize(1280, 900)

    def test_user_text_stays_text(self):
        self.assertEqual(0, self.browser.script(
            "return document.querySelectorAll('h1 *, #tabs script').length"))


if __name__ == "__main__":
    sys.exit(page.main(__name__, __doc__))
