"""With a screen (Xvfb): how soon a final picture stops, and what keeps it from that."""

from blender import OFFICE, ROOT, InBlender, run

SOON_S = 0.2


class WindowStops(InBlender):
    def test_a_final_picture_stops_within_200_ms_of_escape_at_any_moment(self):
        """From the key until Blender says that the render has ended: the slowest of twenty moments. What Blender takes
        with an engine that does nothing at the same moment is its own.
        """
        result = self.once("inside_stops.py", ROOT / "tests/bridge/fake_engine.py", file=OFFICE, screen=True, fails=True)
        self.assertEqual(result["errors"], [], self.said[-4000:])
        self.assertEqual(result["renders_completed"], 0)
        for name in ("tracing", "taking_over"):
            moments = result[name]
            print(f"final picture stopped while {name}: "
                  f"{[[(round(s * 1000), round(alone * 1000)) for s, alone in tries] for tries in moments]} ms")
            self.assertEqual(len(moments), 10)
            for tries in moments:
                self.assertGreater(min(s for s, _ in tries), 0)
                self.assertLess(min(s - alone for s, alone in tries), SOON_S)


if __name__ == "__main__":
    run()
