"""Frames of an animation: each is what a still of it would be; they share light while nothing but the camera moves."""

import numpy as np

from blender import OFFICE, InBlender, run
from lightwell_bridge import exr

ASKED = 0.2


class Animation(InBlender):
    def setUp(self):
        self.result = self.once("inside_animation.py", file=OFFICE)
        for name in ("camera", "desk", "still"):
            self.assertIsNone(self.result[name], self.said[-3000:])

    def picture(self, name):
        return exr.read(self.path / f"{name}.exr")[1]

    def test_every_frame_is_a_picture_of_its_own_moment(self):
        depths = [self.picture(f"{name}{frame:04}")["ViewLayer.Depth.Z"] for name in ("camera", "desk") for frame in (1, 2)]
        self.assertGreater(float(np.abs(depths[0] - depths[1]).max()), 0.1)  # the camera has moved
        self.assertGreater(float(np.abs(depths[1] - depths[3]).max()), 0.3)  # the desk has, too
        other = np.abs(depths[0] / depths[2] - 1) > 0.05
        self.assertLess(float(other.mean()), 0.005)  # at edges, a pixel's paths share it out otherwise

    def test_a_frame_has_the_light_of_a_still(self):
        frame, still = (self.picture(name)["ViewLayer.Illuminance.X"] for name in ("desk0002", "still0002"))
        self.assertGreater(float(still.mean()), 50)
        self.assertAlmostEqual(float(frame.mean() / still.mean()), 1, delta=ASKED / 4)
        lit = still > 0.1 * still.mean()
        self.assertLess(float(np.median(np.abs(frame[lit] / still[lit] - 1))), ASKED)

    def test_light_is_kept_in_one_file_while_only_the_camera_moves(self):
        self.assertEqual(len(self.result["kept by the camera"]), 1)
        # One more for the frame in which the desk stands elsewhere.
        self.assertEqual(len(self.result["kept by the desk"]), 2)
        self.assertTrue(set(self.result["kept by the camera"]) < set(self.result["kept by the desk"]))


if __name__ == "__main__":
    run()
