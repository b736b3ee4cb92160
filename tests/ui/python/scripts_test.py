"""The scripts by which the library was designed, as they stand: each file of the folder scripts is one of them."""

import os
import pathlib
import tempfile
import unittest

import numpy as np

import octant

scripts = pathlib.Path(__file__).parent / "scripts"


def run(name, given, changes=()):
    """Runs a script with these names and returns its names. Changes replace what a script leaves out."""
    text = (scripts / name).read_text(encoding="utf-8")
    for before, after in changes:
        assert before in text
        text = text.replace(before, after)
    names = dict(given)
    exec(compile(text, name, "exec"), names)
    return names


class Scripts(unittest.TestCase):
    def test_a_hundred_cameras_in_one_call(self):
        names = run("1_cameras.py", {})
        frames, world = names["frames"], names["world"]
        self.assertEqual((frames.rgb.shape, frames.rgb.dtype), ((100, 128, 128, 3), np.uint8))
        self.assertEqual((frames.depth_m.shape, frames.depth_m.dtype), ((100, 128, 128), np.float32))
        self.assertEqual((frames.class_id.shape, frames.class_id.dtype), ((100, 128, 128), np.uint8))
        self.assertEqual((frames.object_id.shape, frames.object_id.dtype), ((100, 128, 128), np.uint32))
        self.assertEqual((frames.normal.shape, frames.normal.dtype), ((100, 128, 128, 3), np.float32))
        self.assertEqual((frames.flow_px.shape, frames.flow_px.dtype), ((100, 128, 128, 2), np.float32))
        sky = frames.class_id == octant.classes.index("sky")
        self.assertTrue(0.02 < sky.mean() < 0.9)
        np.testing.assert_array_equal(np.isinf(frames.depth_m), sky)
        self.assertTrue((frames.depth_m > 0).all())
        lengths = np.linalg.norm(frames.normal, axis=-1)
        np.testing.assert_allclose(lengths[~sky], 1.0, atol=1e-4)
        self.assertTrue(np.isfinite(frames.flow_px[~sky]).mean() > 0.9)
        self.assertTrue(np.abs(frames.flow_px[~sky & np.isfinite(frames.flow_px[..., 0])]).max() > 0.1)
        self.assertTrue(np.isin(np.unique(frames.object_id), range(len(world.objects) + 1)).all())
        self.assertGreater(frames.rgb.std(), 10)

    def test_a_flight_frame_by_frame_and_its_recording(self):
        with tempfile.TemporaryDirectory() as folder:
            before = os.getcwd()
            os.chdir(folder)
            try:
                for name in ("my-flight", "other"):
                    for _ in octant.fly("jinking", record=name, aircraft="f15", terrain="canyon", size=(64, 48), frames=20):
                        pass
                names = run("2_flight.py", {"octant": octant})
                self.assertGreater(os.path.getsize("report.html"), 10000)
            finally:
                os.chdir(before)
        self.assertEqual(names["frame"].rgb.shape, (360, 640, 3))
        self.assertGreater(names["frame"].timing.draw_ms, 0)
        self.assertEqual(names["frame"].states[0].position_m.shape, (3,))
        self.assertEqual(len(names["table"]["frame_ms"]), 20)

    def test_an_environment_to_learn_in(self):
        one = 'FollowPath(path="turn", aircraft="500md", camera=octant.Camera(84, 84, fov_deg=80), terrain="hills")'
        names = run("3_environment.py", {"octant": octant}, [("FollowPath(...)", one)])
        self.assertEqual(names["observation"].shape, (84, 84, 3))
        self.assertTrue(0 <= names["reward"] <= 1)
        self.assertIs(names["terminated"], False)
        self.assertIs(names["truncated"], False)
        observations, _ = names["many"].reset(seed=1)
        self.assertEqual(observations.shape, (64, 84, 84, 3))
        np.testing.assert_array_equal(observations[0], names["env"].reset(seed=1)[0])

    def test_own_motion(self):
        world = octant.World(terrain="hills", aircraft=["500md", "f15"], triangles=3000)
        camera = octant.Camera(width=128, height=128, fov_deg=60)
        p, q = np.array([[0.0, 0.0, 1500.0]]), octant.attitudes(heading_deg=[90.0])
        given = {"octant": octant, "world": world, "camera": camera, "p": p, "q": q, "offset": np.array([40.0, 0.0, 0.0])}
        image = run("4_own_motion.py", given)["image"]
        self.assertEqual(image.shape, (128, 128, 3))
        seen = world.render(camera, p[0] - given["offset"], q[0], outputs="object_id").object_id
        self.assertEqual(set(np.unique(seen)), {0, 2})
        self.assertEqual(world.states.is_present.tolist(), [False, True])


if __name__ == "__main__":
    unittest.main()
