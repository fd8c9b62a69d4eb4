"""With a screen (Xvfb): viewport, panels and results as people see them. Screenshots go to build/.../hosts/screenshots."""

import os
import pathlib

from blender import OFFICE, InBlender, run

# Half of the stops, and the slowest on a machine whose other programs hold up the window.
SOON_S, MOST_S = 0.2, 3.0


class Window(InBlender):
    def setUp(self):
        self.out = pathlib.Path(os.environ.get("LIGHTWELL_BUILD", self.path)) / "hosts/screenshots/blender"
        self.out.mkdir(parents=True, exist_ok=True)
        self.result = self.once("inside_window.py", self.out, file=OFFICE, screen=True, fails=True)

    def test_the_viewport_shows_a_picture_and_starts_again_when_something_moves(self):
        self.assertEqual(self.result["errors"], [], self.said[-4000:])
        self.assertIsNone(self.result["failure"])
        print(f"first picture after {self.result['first_picture_s']:.1f} s")
        self.assertLess(self.result["first_picture_s"], 120)

    def test_a_viewport_stops_within_200_ms_of_a_change(self):
        seconds = sorted(self.result["stop_seconds"])
        self.assertGreater(len(seconds), 1)
        print(f"viewport stopped after {[round(s * 1000) for s in seconds]} ms")
        self.assert_soon(seconds)

    def assert_soon(self, seconds):
        """The median: other programs on a busy machine may hold up one of them."""
        self.assertLess(seconds[len(seconds) // 2], SOON_S)
        self.assertLess(seconds[-1], MOST_S)

    def test_results_are_on_the_model_and_can_be_taken_away(self):
        self.assertTrue(self.result["same"])
        self.assertIn("Architecture/Walls", self.result["report"])
        for name in ("panels.png", "viewport.png", "results.png"):
            self.assertGreater((self.out / name).stat().st_size, 20000, name)


if __name__ == "__main__":
    run()
