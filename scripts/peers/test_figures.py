"""`python3 -m unittest discover scripts/peers`"""

import unittest
import xml.etree.ElementTree as xml

import figures
import page
import plot
import store


class Figures(unittest.TestCase):
    def test_front_leaves_out_what_is_beaten(self):
        points = [(1, 10), (2, 12), (3, 5), (3, 4), (0.5, 20), (4, 4)]
        self.assertEqual(figures.front(points), [(0.5, 20), (1, 10), (3, 4)])

    def test_cheapest_is_within_the_error(self):
        self.assertEqual(figures.cheapest([(1, 10), (2, 6), (5, 1)], 6), (2, 6))
        self.assertIsNone(figures.cheapest([(1, 10)], 6))

    def test_error_of_noise_is_crossed_where_its_law_says(self):
        noise = [(t, 100 / t**0.5) for t in (1, 4, 16, 64)]
        self.assertAlmostEqual(figures.crossing(noise, 20), 25, places=6)
        self.assertIsNone(figures.crossing(noise, 200))
        self.assertIsNone(figures.crossing(noise, 1))

    def test_marks_lie_within_the_bounds(self):
        self.assertEqual(figures.decades(0.3, 6), [0.5, 1.0, 2.0, 5.0])

    def test_numbers_of_tables(self):
        self.assertEqual([figures.short(v) for v in (0.1234, 12.34, 1234, None, 0)], ["0.12", "12", "1234", "–", "0"])


class Plot(unittest.TestCase):
    def test_svg_holds_each_point_and_no_reference_outside(self):
        series = [{"name": "a < b", "points": [(0.1, 30), (1, 10)], "line": True}]
        text = plot.picture([[{"title": "t & u", "series": series}]], "CPU s", "%")
        tree = xml.fromstring(text)
        dots = [e for e in tree.iter() if e.tag.endswith("circle") and e.get("class") == "dot"]
        self.assertEqual(len(dots), 2)
        self.assertNotIn("href", text)

    def test_panel_without_points_is_drawn(self):
        xml.fromstring(plot.picture([[{"title": "none", "series": []}]], "s", "%"))


class Page(unittest.TestCase):
    def test_a_block_is_replaced_and_the_rest_stays(self):
        text = page.with_block("# title\n", "2x1", "old")
        text = page.with_block(text + "words\n", "4x2", "other")
        text = page.with_block(text, "2x1", "new")
        self.assertNotIn("old", text)
        for part in ("# title", "words", "other", "new"):
            self.assertEqual(text.count(part), 1)


class Store(unittest.TestCase):
    def test_results_are_found_again_and_half_a_line_is_passed_over(self):
        import tempfile
        from pathlib import Path

        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "results.jsonl"
            first = store.Store(path)
            first.put({"scene": "a", "spp": 1}, {"error": 3})
            with path.open("a") as file:
                file.write('{"key": {"sce')
            again = store.Store(path)
            self.assertEqual(again.get({"spp": 1, "scene": "a"}), {"error": 3})
            self.assertIsNone(again.get({"scene": "a", "spp": 2}))
            again.put({"scene": "a", "spp": 2}, {"error": 4})
            self.assertEqual(store.Store(path).get({"scene": "a", "spp": 2}), {"error": 4})


if __name__ == "__main__":
    unittest.main()
