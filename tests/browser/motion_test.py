#!/usr/bin/env python3
"""Opens a report of modes, motions and responses in headless Chromium and reads it.

motion_test.py REPORT.html [--screenshots FOLDER]

Exit status 77 where chromium or chromedriver is not installed, which ctest counts as skipped.
"""

import sys
import time

import page
from page import FLEXURE_PATHS, UNTIDY, PageTest

# Of every chart its title, the number of its lines, its ticks, and what its x axis is called.
CHARTS = """
  return [...document.querySelectorAll(arguments[0] + ' .chart')].map((chart) => ({
    title: chart.querySelector('figcaption').textContent,
    lines: chart.querySelectorAll('.chart-lines > g').length,
    x: (chart.querySelector('.chart-x-title') || { textContent: '' }).textContent,
    ticks: [...chart.querySelectorAll('.chart-axis')].map(
      (axis) => axis.querySelectorAll('text').length),
  }));
"""


class MotionTest(PageTest):
    def open_kind(self, kind):
        for study in self.studies:
            self.open_study(study)
            if self.kind() == kind:
                time.sleep(0.2)
                return study
        self.skipTest(f"no study of kind {kind}")

    def charts(self, selector):
        """All that have something to draw: axes with ticks and a name, and a title."""
        charts = [c for c in self.browser.script(CHARTS, selector) if c["lines"] > 0]
        self.assertGreater(len(charts), 0, selector)
        for chart in charts:
            self.assertTrue(chart["title"])
            self.assertTrue(chart["x"], chart)
            self.assertEqual(2, len(chart["ticks"]), chart)
            self.assertGreaterEqual(min(chart["ticks"]), 2, chart)
        self.drawn(".chart-line")
        return charts

    def test_a_mode_swings(self):
        self.open_kind("modes")
        before = self.drawn(".flexures path")
        time.sleep(0.3)
        self.assertNotEqual(before, self.drawn(".flexures path"))
        self.assertEqual(2, len(self.drawn(".connections path")))

    def test_modes_are_chosen_and_say_their_frequency(self):
        self.open_kind("modes")
        title = ".mechanism h2"
        self.assertRegex(self.texts(title)[0], "Mode 1 by exact, unstable, grows e-fold in .* s")
        self.browser.script("document.querySelector(`[data-mode='fine 2']`).click()")
        self.assertRegex(self.texts(title)[0], r"Mode 2 by fine, frequency 37\.\d+ Hz")
        self.assertEqual(3, self.count("#modes tbody tr"))
        self.assertEqual(3, self.count("#modes .is-unstable"))
        self.assertIn("Hz", self.texts("#modes th")[1])

    def test_frequencies_are_drawn_along_the_path(self):
        self.open_kind("modes")
        (chart,) = self.charts(".frequencies")
        self.assertEqual("Frequency, Hz", chart["title"])
        self.assertEqual("load factor", chart["x"])
        self.assertEqual(9, chart["lines"])
        self.assertEqual(3, self.count(".frequencies .chart-line.is-unstable"))
        self.browser.script("document.querySelector('.frequencies .legend input').click()")
        self.assertEqual(6, self.charts(".frequencies")[0]["lines"])

    def test_slider_moves_the_mechanism_in_time(self):
        self.open_kind("transient")
        shapes = []
        for share in (0.0, 0.371, 0.3715, 1.0):
            self.seek(share)
            for selector in (".bodies path", ".connections path", ".ways path", ".traces path",
                             ".loads path", ".fields path"):
                self.assertGreater(len(self.drawn(selector)), 0, selector)
            shapes.append([path["d"] for path in self.browser.script(FLEXURE_PATHS)])
        for before, after in zip(shapes, shapes[1:]):
            self.assertNotEqual(before, after)
        self.assertFalse(any("NaN" in d or not d for shape in shapes for d in shape))
        self.assertEqual("time1.000s", "".join(self.texts(".readout > *")))

    def test_loads_come_and_go_by_their_histories(self):
        self.open_kind("transient")
        for share, sizes in ((0.0, []), (0.125, ["0.2 N"]), (0.5, [])):
            self.seek(share)
            self.assertEqual(sizes, self.texts(".load-names text"), share)

    def test_flexures_stay_on_their_bodies_between_drawn_states(self):
        # Of the reference, where the leaf's end and the tip's centre should be one place.
        self.open_kind("transient")
        gap = """
          const study = State.chosen.study;
          const motion = Course.unpackMotion(study.motion);
          const modeling = motion.modelings[motion.reference];
          const far = (t) => {
            const state = Course.stateAt(motion, modeling, t);
            const leaf = state.axes[1];
            return Math.hypot(leaf[leaf.length - 1][0] - state.bodies[2][0],
                              leaf[leaf.length - 1][1] - state.bodies[2][1]);
          };
          modeling.frames = modeling.frames.filter((_, i) => i % 20 === 0);
          return Math.max(...d3.range(200).map((k) => far(k / 200)));
        """
        self.assertLess(self.browser.script(gap), 1e-3)

    def test_speeds_are_offered_and_the_first_plays_all_in_ten_seconds(self):
        self.open_kind("transient")
        speeds = self.texts("#speed option")
        self.assertEqual("all in 10 s", speeds[0])
        self.assertIn("real time", speeds)
        # The page's own clock: a busy machine draws late, but at the right place.
        watch = """
          const seen = [];
          State.set({ position: 0.1 });
          State.follow(['position'], () => seen.push([d3.now(), State.chosen.position]));
          window.speedSeen = () => {
            const [a, b] = [seen[1], seen[seen.length - 1]];
            return seen.length < 4 ? 0 : 1000 * (b[1] - a[1]) / (b[0] - a[0]);
          };
          document.getElementById('play').click();
        """
        for speed, rate in ((0, 0.1), (speeds.index("2× slower"), 0.5)):
            self.choose("#speed", speed)
            self.browser.script(watch)
            for _ in range(50):
                time.sleep(0.1)
                seen = self.browser.script("return window.speedSeen()")
                if seen > 0.0:
                    break
            self.browser.script("document.getElementById('play').click()")
            self.assertAlmostEqual(rate, seen, delta=0.02 * rate)

    def test_histories_of_all_modelings_have_a_cursor(self):
        self.open_kind("transient")
        charts = self.charts(".plots")
        self.assertEqual([4, 4, 4, 3], [chart["lines"] for chart in charts])
        self.assertTrue(all(chart["x"] == "time, s" for chart in charts))
        cursor = "return document.querySelector('.plots .chart-marker line').getAttribute('x1')"
        self.seek(0.2)
        before = self.browser.script(cursor)
        self.seek(0.7)
        self.assertGreater(float(self.browser.script(cursor)), float(before) + 50)

    def test_every_subject_has_histories_and_phases(self):
        self.open_kind("transient")
        lines = set()
        for index in range(self.count("#subject option")):
            self.choose("#subject", index)
            self.assertGreaterEqual(len(self.charts(".plots")), 3)
            self.assertEqual([4, 4, 4], [chart["lines"] for chart in self.charts(".phases")])
            lines.add("".join(self.drawn(".phases .chart-line")))
        self.assertEqual(6, len(lines))

    def test_phases_mark_the_time(self):
        self.open_kind("transient")
        places = ("return [...document.querySelectorAll('.phases circle')]"
                  ".map((c) => c.getAttribute('cx') + ' ' + c.getAttribute('cy'))")
        self.seek(0.3)
        before = self.browser.script(places)
        self.assertEqual(12, len(before))
        self.assertFalse(any("NaN" in place for place in before))
        self.seek(0.31)
        self.assertNotEqual(before, self.browser.script(places))

    def test_energies_reactions_and_stress_are_drawn_over_time(self):
        self.open_kind("transient")
        energies = self.charts(".energies")
        self.assertEqual(5, len(energies))
        self.assertEqual([4] * 5, [chart["lines"] for chart in energies])
        self.assertEqual(3, len(self.charts(".reactions")))
        self.assertIn("Largest stress over time, N/mm²", self.texts("figcaption"))
        self.assertIn("Largest over the run", " ".join(self.texts("#extremes th")))

    def test_comparison_lists_what_a_motion_cost(self):
        self.open_kind("transient")
        heads = self.texts("#comparison th")
        for head in ("Steps", "Rejected", "Iterations", "Energy error", "Error estimate"):
            self.assertIn(head, heads)
        self.assertEqual(4, self.count("#comparison .is-modeling"))
        self.assertIn("stopped at 0.62 s", " ".join(self.texts("#comparison td")))
        self.assertEqual(1, self.count("#comparison .notes"))

    def test_the_header_says_how(self):
        self.open_kind("transient")
        header = self.texts(".study-header")[0]
        for words in ("Motion in time", "half-sine", "radau", "Damping: 2 %", "gravity"):
            self.assertIn(words, header)

    def test_a_response_has_amplitude_phase_and_peaks(self):
        self.open_kind("response")
        charts = self.charts(".plots")
        self.assertEqual([3, 3], [chart["lines"] for chart in charts])
        self.assertEqual({"frequency, Hz"}, {chart["x"] for chart in charts})
        self.assertEqual(12, len(self.drawn(".chart-event")))
        self.assertEqual(6, self.count("#peaks tbody tr"))
        self.assertEqual(3, self.count("#comparison .is-modeling"))
        self.assertEqual(2, len(self.drawn(".connections path")))
        ring = self.drawn(".chosen .loaded-point")
        before = self.drawn(".plots .chart-line")
        self.choose("#place", self.texts("#place option").index("tip.P.y"))
        self.assertNotEqual(before, self.drawn(".plots .chart-line"))
        self.assertNotEqual(ring, self.drawn(".chosen .loaded-point"))
        self.assertIn("Amplitude of tip.P.y, mm", self.texts("figcaption"))

    def test_a_phase_goes_on_at_the_other_end(self):
        self.open_study("sweep")
        time.sleep(0.2)
        amplitude, phase = self.charts(".plots")
        self.assertEqual((3, 3), (amplitude["lines"], phase["lines"]))
        # The delay goes round about one and a half times: every line in three pieces or more.
        self.assertGreaterEqual(self.count(".plots .chart-line"), 3 + 9)
        longest = """
          const steps = [...document.querySelectorAll('.chart:nth-child(2) .chart-line')]
            .map((path) => path.getAttribute('d').slice(1).split('L'))
            .map((places) => places.map((place) => Number(place.split(',')[1])))
            .flatMap((ys) => ys.map((y, i) => (i ? Math.abs(y - ys[i - 1]) : 0)));
          return Math.max(...steps);
        """
        self.assertLess(self.browser.script(longest), 110)

    def test_a_place_that_stands_still_has_no_peaks(self):
        self.open_kind("response")
        self.choose("#place", self.texts("#place option").index("piston.y"))
        self.assertIn("It does not move", self.texts(".chart-empty"))
        self.assertEqual(0, self.count("#peaks tbody tr"))

    def test_toggles_hide_a_modeling_in_every_figure(self):
        for study in self.studies:
            self.open_study(study)
            before = self.count(".chart-line")
            self.browser.script("document.querySelector('.legend input').click()")
            self.assertLess(self.count(".chart-line"), before)
            self.browser.script("document.querySelector('.legend input').click()")
            self.assertEqual(before, self.count(".chart-line"))

    def test_texts_are_tidy_at_common_sizes(self):
        for width in (1100, 1280, 1920, 390):
            self.browser.resize(width, 900)
            for study in self.studies:
                with self.subTest(width=width, study=study):
                    self.open_study(study)
                    self.assertEqual([], self.browser.script(UNTIDY))
        self.browser.resize(1280, 900)


if __name__ == "__main__":
    sys.exit(page.main(__name__, __doc__))
