"""Arrays in and out: shapes, types, memory, and what is wrong with them."""

import copy
import pickle
import unittest

import numpy as np

import octant

camera = octant.Camera(48, 32)
world = octant.World(terrain="hills", aircraft=["f15"], triangles=1000)
above = float(world.ground.height_m(0, 0)) + 200.0
level = octant.attitudes(pitch_deg=-15)


class Arguments(unittest.TestCase):
    def refused(self, text, *arguments, **keywords):
        with self.assertRaises(ValueError) as raised:
            world.render(*arguments, **keywords)
        self.assertIn(text, str(raised.exception))
        self.assertNotIn("\n", str(raised.exception))

    def test_wrong_shapes_are_refused(self):
        self.refused("eye: expected an array of shape (3,) or (n, 3), got (2,)", camera, [0, 0], level)
        self.refused("eye: expected an array of shape", camera, np.zeros((2, 2, 3)), level)
        self.refused("eye: expected an array of shape", camera, 5.0, level)
        self.refused("look: expected an array of shape (4,) or (n, 4), got (3,)", camera, [0, 0, above], [1, 0, 0])
        self.refused("look: expected one row or 3, got 2", camera, np.zeros((3, 3)), np.ones((2, 4)))
        self.refused("previous_eye: expected one row or 1, got 4", camera, [0, 0, above], level, previous_eye=np.ones((4, 3)))
        self.refused("previous_look: expected an array of shape", camera, [0, 0, above], level, previous_look=[1, 2, 3])

    def test_wrong_types_are_refused(self):
        self.refused("eye: expected an array of numbers", camera, ["a", "b", "c"], level)
        self.refused("eye: expected an array of numbers", camera, [1j, 0, 0], level)
        self.refused("eye: expected an array of numbers", camera, [object()] * 3, level)
        self.refused("eye: expected an array of numbers", camera, [True, False, True], level)
        self.refused("eye: expected an array of numbers", camera, None, level)
        self.refused("camera: expected an octant.Camera, got dict", {}, [0, 0, 0], level)
        self.refused("threads: expected a whole number from 0 to 1024, got -1", camera, [0, 0, above], level, threads=-1)
        self.refused("seed: expected a whole number, got 'x'", camera, [0, 0, above], level, seed="x")
        self.refused("first_index: expected a whole number, got 0.5", camera, [0, 0, above], level, first_index=0.5)
        self.refused("outputs: expected some of rgb", camera, [0, 0, above], level, outputs=["depth"])
        self.refused("outputs: expected some of rgb", camera, [0, 0, above], level, outputs=[])
        self.refused("states: expected octant.states()", camera, [0, 0, above], level, states=[[0, 0, 0]])

    def test_numbers_that_are_not_finite_are_refused(self):
        self.refused("eye: expected finite numbers, got NaN at place 1", camera, [0, np.nan, above], level)
        self.refused("look: expected finite numbers, got infinity", camera, [0, 0, above], [np.inf, 0, 0, 0])
        with self.assertRaises(ValueError):
            world.render(camera, [0, 0, above], [0, 0, 0, 0])
        with self.assertRaises(ValueError):
            octant.states(position_m=[0, 0, np.nan])

    def test_wrong_cameras_are_refused(self):
        for wrong in (
            {"width": -1}, {"width": 0}, {"height": 10000}, {"fov_deg": 0}, {"fov_deg": float("nan")}, {"fov_deg": 180},
            {"K": np.eye(4)}, {"K": [[1, 2, 3], [0, 1, 0], [0, 0, 1]]}, {"distortion": "odd"}, {"samples": 3}, {"bits": 12},
            {"coefficients": [float("inf")]}, {"exposure": -1}, {"noise": float("nan")}, {"blur_frames": 0}, {"noise": 2},
            {"blur_frames": 257}, {"fov_deg": 175}, {"row_time_s": 2}, {"coefficients": [0.1]}, {"coefficients": [[0.1]]},
            {"distortion": None}, {"distortion": "\0"},
        ):  # fmt: skip
            with self.assertRaises(ValueError, msg=str(wrong)):
                octant.Camera(**wrong)

    def test_a_camera_names_the_arguments_that_it_does_not_have_in_one_line(self):
        for call in (lambda: octant.Camera(fov=60), lambda: octant.Camera(64, 64, 60, 8)):
            with self.assertRaisesRegex(TypeError, r"^Camera: expected width, height, fov_deg and, .*; got .*(fov|8).*$") as raised:
                call()
            self.assertNotIn("\n", str(raised.exception))

    def test_arguments_of_a_wrong_type_are_named_in_one_line(self):
        positions = octant.states([[0, 0, 500]])
        for text, call in (
            ("width: expected a whole number of at most nine digits, got 1.5", lambda: octant.Camera(width=1.5)),
            ("height: expected a whole number of at most nine digits, got 18446744073709551616", lambda: octant.Camera(3, 2**64)),
            ("bits: expected a whole number of at most nine digits, got '8'", lambda: octant.Camera(bits="8")),
            ("fov_deg: expected a number, got '60'", lambda: octant.Camera(fov_deg="60")),
            ("exposure: expected a number, got None", lambda: octant.Camera(exposure=None)),
            ("coefficients: expected an array of numbers", lambda: octant.Camera(coefficients=None)),
            ("camera: expected 13 values, got 1", lambda: octant.Camera.__new__(octant.Camera).__setstate__((1,))),
            ("outputs: expected a name or several, got 5", lambda: world.render(camera, [0, 0, above], level, outputs=5)),
            ("kind: expected a kind or several, got 5", lambda: octant.states([[0, 0, 500]], kind=5)),
            ("terrain: expected a text or a path, got 1.5", lambda: octant.World(terrain=1.5)),
            ("aircraft: expected a name or several, got 7", lambda: octant.World(aircraft=7)),
            ("aircraft: expected a text or a path, got 7", lambda: octant.World(aircraft=[7])),
            ("path: expected a text or a path, got 3", lambda: world.export(3)),
            ("record: expected a text or a path, got 3", lambda: octant.fly("turn", record=3)),
            ("rate_hz: expected an array of numbers", lambda: world.path_states("fast")),
            ("rate_hz: expected a number, got an array of shape (2,)", lambda: world.path_states([1, 2])),
            ("aircraft: expected a name, got 5", lambda: octant.PilotedAircraft(5, positions)),
            ("start: expected octant.states() of one aircraft, got list", lambda: octant.PilotedAircraft("f15", [])),
        ):
            with self.assertRaises(ValueError, msg=text) as raised:
                call()
            self.assertIn(text, str(raised.exception))
            self.assertNotIn("\n", str(raised.exception))
        numpy_ones = octant.Camera(np.int64(48), np.uint8(32), np.float32(60), coefficients=np.zeros(0), exposure=1)
        self.assertEqual(numpy_ones, camera)

    def test_arrays_with_gaps_and_of_other_numbers_are_copied(self):
        wide = np.zeros((3, 6))
        wide[:, ::2] = [[0, 0, above], [50, 0, above], [0, 50, above]]
        expected = world.render(camera, np.ascontiguousarray(wide[:, ::2]), level).rgb
        np.testing.assert_array_equal(world.render(camera, wide[:, ::2], level).rgb, expected)
        whole = np.round(wide[:, ::2]).astype(np.float64)
        for kind in (np.int32, np.float64, ">f8"):
            drawn = world.render(camera, np.asfortranarray(whole.astype(kind)), level).rgb
            np.testing.assert_array_equal(drawn, world.render(camera, whole, level).rgb)

    def test_one_pose_is_one_picture_and_one_row_goes_with_many(self):
        self.assertEqual(world.render(camera, [0, 0, above], level).rgb.shape, (1, 32, 48, 3))
        looks = octant.attitudes(heading_deg=[0, 90, 180])
        self.assertEqual(world.render(camera, [0, 0, above], looks).rgb.shape, (3, 32, 48, 3))
        self.assertEqual(world.render(camera, np.empty((0, 3)), np.empty((0, 4))).rgb.shape, (0, 32, 48, 3))


class Memory(unittest.TestCase):
    eyes = np.array([[0, 0, above], [100, 0, above], [0, 100, above], [300, 200, above + 50]])

    def test_pictures_are_written_into_given_arrays(self):
        frames = octant.Frames.empty(camera, 4, ["rgb", "depth_m"])
        places = {name: array.ctypes.data for name, array in frames.arrays.items()}
        same = world.render(camera, self.eyes, level, out=frames)
        self.assertIs(same, frames)
        self.assertEqual({name: array.ctypes.data for name, array in frames.arrays.items()}, places)
        np.testing.assert_array_equal(frames.rgb, world.render(camera, self.eyes, level).rgb)
        frames.rgb[:] = 7
        world.render(camera, self.eyes, level, out=frames, outputs=["depth_m"])
        self.assertTrue((frames.rgb == 7).all())

    def test_a_part_of_a_larger_array_is_written_into(self):
        whole = np.full((6, 32, 48, 3), 9, np.uint8)
        world.render(camera, self.eyes, level, out=octant.Frames({"rgb": whole[1:5]}))
        np.testing.assert_array_equal(whole[1:5], world.render(camera, self.eyes, level).rgb)
        self.assertTrue((whole[[0, 5]] == 9).all())

    def test_arrays_that_do_not_fit_are_refused(self):
        right = np.zeros((4, 32, 48, 3), np.uint8)
        read_only = right.copy()
        read_only.setflags(write=False)
        wrong = {
            "rgb: expected an array of shape (4, 32, 48, 3), got (3, 32, 48, 3)": right[:3],
            "rgb: expected values of type uint8, got float32": right.astype(np.float32),
            "rgb: expected an array that can be written to": read_only,
            "without gaps": np.zeros((4, 32, 48, 6), np.uint8)[..., ::2],
            "got <class 'list'>": right.tolist(),
            "rgb: expected a NumPy array": right.tolist(),
        }
        for text, array in wrong.items():
            with self.assertRaises(ValueError) as raised:
                world.render(camera, self.eyes, level, out=octant.Frames({"rgb": array}))
            self.assertIn(text, str(raised.exception))
        unaligned = np.frombuffer(bytearray(4 * right.size // 3 + 1), np.float32, offset=1).reshape(4, 32, 48)
        with self.assertRaises(ValueError) as raised:
            world.render(camera, self.eyes, level, out=octant.Frames({"depth_m": unaligned}))
        self.assertIn("depth_m: expected an aligned array", str(raised.exception))
        with self.assertRaises(ValueError) as raised:
            octant.Frames.empty(camera, -1)
        self.assertIn("count: expected a whole number from 0", str(raised.exception))
        with self.assertRaises(ValueError):
            world.render(camera, self.eyes, level, out={"rgb": right})
        with self.assertRaises(ValueError):
            world.render(camera, self.eyes, level, out=octant.Frames({"rgb": right}), outputs=["rgb", "depth_m"])

    def test_arrays_that_were_not_asked_for_are_named(self):
        with self.assertRaises(AttributeError) as raised:
            world.render(camera, self.eyes, level).depth_m
        self.assertIn("depth_m: not among the outputs", str(raised.exception))
        self.assertEqual(len(copy.copy(world.render(camera, self.eyes, level))), 4)

    def test_sixteen_bits(self):
        deep = world.render(octant.Camera(48, 32, bits=16), self.eyes, level).rgb
        self.assertEqual(deep.dtype, np.uint16)
        plain = world.render(camera, self.eyes, level).rgb
        self.assertLess(np.abs(deep / 257.0 - plain).max(), 1.01)

    def test_bytes_do_not_depend_on_threads_or_on_the_split_into_calls(self):
        every = list(octant.output_names)
        keywords = {"previous_eye": self.eyes - 1.0, "outputs": every}
        whole = world.render(camera, self.eyes, level, threads=1, **keywords)
        for threads in (2, 5):
            again = world.render(camera, self.eyes, level, threads=threads, **keywords)
            for name in every:
                self.assertEqual(getattr(whole, name).tobytes(), getattr(again, name).tobytes(), name)
        for i in range(4):
            keywords["previous_eye"] = self.eyes[i] - 1.0
            alone = world.render(camera, self.eyes[i], level, **keywords)
            for name in every:
                self.assertEqual(getattr(whole, name)[i].tobytes(), getattr(alone, name)[0].tobytes(), name)

    def test_noise_is_that_of_seed_and_index(self):
        noisy = octant.Camera(48, 32, noise=0.05)
        whole = world.render(noisy, self.eyes, level, seed=3).rgb
        np.testing.assert_array_equal(world.render(noisy, self.eyes[2:], level, seed=3, first_index=2).rgb, whole[2:])
        self.assertFalse(np.array_equal(world.render(noisy, self.eyes, level, seed=4).rgb, whole))
        self.assertFalse(np.array_equal(world.render(camera, self.eyes, level).rgb, whole))


class Geometry(unittest.TestCase):
    def test_attitudes_broadcast(self):
        grid = octant.attitudes(heading_deg=np.zeros((3, 1)), pitch_deg=np.zeros(5), bank_deg=2)
        self.assertEqual(grid.shape, (3, 5, 4))
        np.testing.assert_allclose(np.linalg.norm(grid, axis=-1), 1.0)
        with self.assertRaises(ValueError):
            octant.attitudes(heading_deg=[1, 2, 3], pitch_deg=[1, 2])
        with self.assertRaises(ValueError):
            octant.attitudes(heading_deg="north")

    def test_look_at_points_to_the_target(self):
        target = np.array([30.0, -20.0, 5.0])
        eyes = np.array([[0.0, 0.0, 0.0], [10.0, 50.0, 90.0]])
        cameras = octant.to_opencv(octant.look_at(eyes, target))
        for eye, turn in zip(eyes, cameras):
            seen = octant.Camera(101, 101).project(rotated_back(turn, target - eye))
            np.testing.assert_allclose(seen, [[50.0, 50.0]], atol=1e-9)

    def test_axes_of_opengl_are_those_of_opencv_half_a_turn_about_x(self):
        turn = octant.attitudes(heading_deg=33, pitch_deg=-20, bank_deg=12)
        point = np.array([1.0, 2.0, 3.0])
        a = rotated_back(octant.to_opencv(turn), point)
        b = rotated_back(octant.to_opengl(turn), point)
        np.testing.assert_allclose(a * [1, -1, -1], b, atol=1e-12)
        back = octant.from_opengl(octant.to_opengl(turn))
        np.testing.assert_allclose(np.abs(np.dot(back, turn)), 1.0, atol=1e-12)

    def test_cameras_are_values(self):
        one = octant.Camera(64, 48, K=[[50, 0, 31.5], [0, 51, 23.5], [0, 0, 1]], distortion="brown-conrady", coefficients=[0.1])
        again = pickle.loads(pickle.dumps(one))
        self.assertEqual(one, again)
        self.assertEqual(hash(one), hash(again))
        self.assertNotEqual(one, octant.Camera(64, 48))
        np.testing.assert_array_equal(again.K, [[50, 0, 31.5], [0, 51, 23.5], [0, 0, 1]])
        with self.assertRaises(AttributeError):
            one.width = 5

    def test_project_and_ray_are_inverse(self):
        for model, values in (("none", []), ("brown-conrady", [-0.1, 0.01, 1e-3, -1e-3]), ("fisheye", [0.02, -0.003])):
            wide = octant.Camera(200, 100, fov_deg=70, distortion=model, coefficients=values)
            pixels = np.array([[10.0, 20.0], [99.5, 49.5], [180.0, 90.0]])
            np.testing.assert_allclose(wide.project(wide.ray(pixels)), pixels, atol=1e-6)
        self.assertTrue(np.isnan(octant.Camera().project([0, 0, -1])).all())


def rotated_back(quaternion, vector):
    """The vector in the axes that the quaternion turns into the world's."""
    w, x, y, z = quaternion
    to_world = np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ])  # fmt: skip
    return to_world.T @ vector


if __name__ == "__main__":
    unittest.main()
