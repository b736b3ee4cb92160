"""Worlds: states, objects, settings, heights, places; closing, threads, fork and Ctrl-C."""

import contextlib
import os
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings

import numpy as np

import octant

camera = octant.Camera(64, 48)
world = octant.World(terrain="hills", aircraft=["f15", "500md", "f15"], triangles=1000)
behind = octant.attitudes(heading_deg=0)


def count_of(object_id, frames):
    return int((frames.object_id == object_id).sum())


class States(unittest.TestCase):
    def test_kinds_find_their_aircraft(self):
        own = world.copy()
        self.assertEqual([each.kind for each in own.objects], ["f15", "500md", "f15"])
        self.assertEqual(len({each.name for each in own.objects}), 3)
        own.set_states(octant.states(position_m=[[0, 0, 2000], [5, 0, 2000]], kind=["500md", "f15"]))
        np.testing.assert_array_equal(own.states.is_present, [True, True, False])
        np.testing.assert_array_equal(own.states.position_m[:2], [[5, 0, 2000], [0, 0, 2000]])
        for wrong in (["500md", "500md"], ["f16", "f15"]):
            with self.assertRaises(ValueError):
                own.set_states(octant.states(position_m=np.zeros((2, 3)), kind=wrong))
        with self.assertRaises(ValueError):
            own.set_states(octant.states(position_m=np.zeros((4, 3))))
        with self.assertRaises(ValueError):
            octant.states(position_m=np.zeros((2, 3)), kind=["f15"])

    def test_copies_have_states_of_their_own(self):
        a, b = world.copy(), world.copy()
        a.set_states(octant.states(position_m=[0, 60, 2000]))
        b.set_states(octant.states(position_m=[0, 60, 9000]))
        frames = [each.render(camera, [0, 0, 2000], behind, outputs="object_id") for each in (a, b)]
        self.assertGreater(count_of(1, frames[0]), 10)
        self.assertEqual(count_of(1, frames[1]), 0)

    def test_other_settings_share_a_world(self):
        named = {"terrain": "hills", "aircraft": ["f15"], "triangles": 1000}
        eye = world.ground.random_positions(3, seed=5)
        draw = lambda of: of.render(camera, eye, behind).rgb
        noon = octant.World(**named, sun_elevation_deg=60)
        evening = noon.with_settings(sun_elevation_deg=8)
        np.testing.assert_array_equal(draw(evening), draw(octant.World(**named, sun_elevation_deg=8)))
        np.testing.assert_array_equal(draw(evening.with_settings(sun_elevation_deg=60)), draw(noon))
        self.assertGreater((draw(evening) != draw(noon)).sum(), 1000)
        with self.assertRaises(octant.Error):
            noon.with_settings(sun_elevation_deg=600)
        noon.close()
        draw(evening)
        with self.assertRaises(ValueError):
            noon.with_settings(sun_elevation_deg=20)

    def test_states_of_each_picture(self):
        position_m = np.zeros((2, 1, 3)) + [0, 60, 2000]
        position_m[1, 0, 2] = 9000
        frames = world.render(camera, [[0, 0, 2000]] * 2, behind, states=octant.states(position_m), outputs="object_id")
        self.assertGreater((frames.object_id[0] == 1).sum(), 10)
        self.assertEqual((frames.object_id[1] == 1).sum(), 0)
        with self.assertRaises(ValueError):
            world.render(camera, [[0, 0, 2000]] * 3, behind, states=octant.states(position_m))

    def test_flow_follows_the_states_before(self):
        own = world.copy()
        eye = [0, 0, 2000]
        own.set_states(octant.states(position_m=[0, 60, 2000]))
        own.set_states(octant.states(position_m=[2, 60, 2000]))
        frames = own.render(camera, eye, behind, previous_eye=eye, outputs=["object_id", "flow_px"])
        moved = frames.flow_px[frames.object_id == 1]
        expected = 2 / 60 * camera.K[0, 0]
        self.assertLess(abs(np.abs(moved[:, 0]).mean() - expected), 0.25 * expected)
        self.assertLess(np.abs(moved[:, 1]).mean(), 0.2 * expected)

    def test_boxes(self):
        own = world.copy()
        own.set_states(octant.states(position_m=[0, 60, 2000]))
        [boxes] = own.boxes(camera, [0, 0, 2000], behind)
        [box] = [each for each in boxes if each.object_id == 1]
        seen = own.render(camera, [0, 0, 2000], behind, outputs="object_id").object_id[0] == 1
        rows, columns = np.nonzero(seen)
        self.assertEqual(box.pixels, seen.sum())
        self.assertEqual(box.visible_px, (columns.min(), rows.min(), columns.max() + 1, rows.max() + 1))
        self.assertEqual(box.corners_m.shape, (8, 3))
        self.assertTrue(55 < box.distance_m < 65)


class Ground(unittest.TestCase):
    def test_positions_are_above_the_ground(self):
        places = world.ground.random_positions(500, above_ground_m=(30, 300), seed=7)
        above = places[:, 2] - world.ground.height_m(places[:, 0], places[:, 1])
        self.assertTrue((above > 29.9).all() and (above < 300.1).all())
        np.testing.assert_array_equal(places[:20], world.ground.random_positions(20, above_ground_m=(30, 300), seed=7))
        self.assertGreater(np.abs(places - world.ground.random_positions(500, (30, 300), seed=8)).max(), 100)
        for wrong in ((300, 30), (30,), (0, np.nan)):
            with self.assertRaises(ValueError):
                world.ground.random_positions(5, above_ground_m=wrong)
        with self.assertRaises(ValueError):
            world.ground.random_positions(-1)

    def test_heights_broadcast_and_end_at_the_edge(self):
        east_m, north_m = world.ground.half_extent_m
        heights = world.ground.height_m(np.linspace(-100, 100, 3)[:, None], [0, 50])
        self.assertEqual(heights.shape, (3, 2))
        self.assertTrue(np.isnan(world.ground.height_m(2 * east_m, 0)))

    def test_a_world_that_lies_nowhere_has_no_latitudes(self):
        with self.assertRaises(octant.Error):
            world.local(48, 11, 0)
        with self.assertRaises(octant.Error):
            world.geodetic([0, 0, 0])

    def test_export_writes_triangles(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "scene.obj"
            world.export(file)
            lines = file.read_text(encoding="utf-8").splitlines()
            self.assertGreater(sum(line.startswith("f ") for line in lines), 500)
            with self.assertRaises(octant.Error):
                world.export(pathlib.Path(folder) / "no" / "scene.obj")


class Settings(unittest.TestCase):
    def test_keywords_are_settings(self):
        names = octant.setting_names()
        self.assertIn("near_detail", names)
        bare = octant.World(near_detail=False, scenery=False, roads=False, visibility_m=5000, haze_height=900, triangles=500)
        rich = octant.World(triangles=500)
        eye = [0, 0, float(bare.ground.height_m(0, 0)) + 50]
        look = octant.attitudes(pitch_deg=-30)
        self.assertFalse(np.array_equal(bare.render(camera, eye, look).rgb, rich.render(camera, eye, look).rgb))

    def test_a_path_without_aircraft_is_refused(self):
        for settings in ({"path": "turn"}, {"path": "straight", "aircraft": []}):
            with self.assertRaises(octant.Error) as raised:
                octant.World(terrain="none", **settings)
            self.assertIn("path: expected aircraft, of which the first flies it, got none", str(raised.exception))
        with self.assertRaises(octant.Error):
            octant.World(terrain="none").with_settings(path="turn")

    def test_wrong_settings_are_refused(self):
        for wrong in (
            {"colour": 1}, {"visibility": "far"}, {"triangles": 1}, {"near_detail": 3}, {"terrain": "nowhere"},
            {"aircraft": ["f16"]}, {"sun_elevation_deg": 120}, {"visibility": 1, "visibility_m": 2}, {"clouds": {}},
        ):  # fmt: skip
            with self.assertRaises(ValueError, msg=str(wrong)) as raised:
                octant.World(**wrong)
            self.assertNotIn("\n", str(raised.exception))

    def test_messages_name_keywords(self):
        for settings, text in (
            ({"near_detial": True}, "near_detial: expected the name of a setting, got 'near_detial'; perhaps near_detail is meant"),
            ({"sun_elevation_deg": 120}, "sun_elevation_deg: expected"),
            ({"visibility_m": "far"}, "visibility_m: expected"),
            ({"shading": "flat", "smooth_share": 0.5}, "beside adapt shading, smooth_share, device_ratio or shading_rule paper"),
        ):
            with self.assertRaises(octant.Error) as raised:
                octant.World(**settings)
            self.assertIn(text, str(raised.exception))
        with self.assertRaises(octant.Error) as raised:
            octant.fly("turn", view="chase", look=(1, 2, 3))
        self.assertEqual(str(raised.exception), "look: expected view free beside it, got view chase")

    def test_an_unreadable_file_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "broken.asc")
            with open(file, "w", encoding="utf-8") as text:
                text.write("ncols 3\nnrows three\n")
            for error in (octant.Error, ValueError, OSError):
                with self.assertRaises(error) as raised:
                    octant.World(terrain=file)
            self.assertIn("broken.asc", str(raised.exception))

    def test_notes_are_warnings(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "plain.asc")
            with open(file, "w", encoding="utf-8") as text:
                text.write("ncols 4\nnrows 4\nxllcorner 0\nyllcorner 0\ncellsize 30\n" + "1 2 -9999 4\n" * 4)
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                octant.World(terrain=file)
        self.assertTrue(any(each.filename == __file__ for each in caught), [str(each.message) for each in caught])


class Life(unittest.TestCase):
    def test_a_closed_world_is_refused(self):
        with octant.World(terrain="hills", triangles=500) as closed:
            ground = closed.ground
        calls = [
            lambda: closed.render(camera, [0, 0, 900], behind),
            lambda: closed.boxes(camera, [0, 0, 900], behind),
            lambda: closed.ground,
            lambda: closed.objects,
            lambda: closed.states,
            lambda: closed.set_states(octant.states([0, 0, 0])),
            lambda: closed.copy(),
            lambda: closed.local(0, 0),
            lambda: closed.geodetic([0, 0, 0]),
            lambda: closed.export("scene.obj"),
            lambda: closed.path_states(),
            lambda: ground.height_m(0, 0),
            lambda: ground.half_extent_m,
            lambda: ground.random_positions(3),
        ]
        for call in calls:
            with self.assertRaises(ValueError) as raised:
                call()
            self.assertEqual(str(raised.exception), "world: expected an open world, got a closed one")
        closed.close()

    def test_a_world_closed_while_it_draws_ends_in_order(self):
        own = octant.World(terrain="hills", triangles=500)
        eyes = own.ground.random_positions(400, seed=1)
        result = []
        drawing = threading.Thread(target=lambda: result.append(own.render(camera, eyes, behind, threads=1)))
        drawing.start()
        time.sleep(0.02)
        own.close()
        drawing.join()
        again = octant.World(terrain="hills", triangles=500)
        np.testing.assert_array_equal(result[0].rgb, again.render(camera, eyes, behind).rgb)

    def test_several_threads_draw_and_move_at_once(self):
        own = world.copy()
        eyes = own.ground.random_positions(60, seed=2)
        expected = own.render(camera, eyes, behind, states=octant.states([0, 0, 2000])).rgb
        wrong = []

        def draw():
            for _ in range(4):
                if not np.array_equal(own.render(camera, eyes, behind, states=octant.states([0, 0, 2000])).rgb, expected):
                    wrong.append("another picture")

        def move():
            for i in range(200):
                own.set_states(octant.states([0, i, 2000]))

        threads = [threading.Thread(target=each) for each in (draw, draw, draw, move)]
        for each in threads:
            each.start()
        for each in threads:
            each.join()
        self.assertEqual(wrong, [])

    def test_the_lock_of_python_is_let_go(self):
        eyes = world.ground.random_positions(600, seed=3)
        ticks = []
        done = threading.Event()

        def tick():
            while not done.wait(0.001):
                ticks.append(time.monotonic())

        ticking = threading.Thread(target=tick)
        ticking.start()
        begin = time.monotonic()
        world.render(camera, eyes, behind, threads=1)
        end = time.monotonic()
        done.set()
        ticking.join()
        self.assertGreater(sum(begin < each < end for each in ticks), 3)

    def test_a_forked_child_draws_the_same(self):
        eyes = world.ground.random_positions(8, seed=4)
        expected = world.render(camera, eyes, behind, threads=2).rgb.tobytes()
        child = os.fork()
        if child == 0:
            code = 1
            with contextlib.suppress(BaseException):
                code = 0 if world.render(camera, eyes, behind, threads=2).rgb.tobytes() == expected else 3
            os._exit(code)
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline:
            ended, status = os.waitpid(child, os.WNOHANG)
            if ended:
                self.assertEqual(os.waitstatus_to_exitcode(status), 0)
                return
            time.sleep(0.05)
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        self.fail("the child did not end within 60 s")

    def test_where_the_system_gives_no_more_threads_fewer_draw_the_same(self):
        program = (
            "import octant, resource\n"
            "world = octant.World(triangles=300, scenery=False)\n"
            "eyes = world.ground.random_positions(300)\n"
            "draw = lambda threads: world.render(octant.Camera(8, 8), eyes, octant.attitudes(), threads=threads).rgb.tobytes()\n"
            "expected = draw(1)\n"
            "lines = open('/proc/self/status').read().splitlines()\n"
            "used = next(int(line.split()[1]) * 1024 for line in lines if line.startswith('VmSize'))\n"
            "resource.setrlimit(resource.RLIMIT_AS, (used + 2**30,) * 2)\n"  # for three stacks
            "print(draw(300) == expected)\n"
        )
        large_stacks = lambda: resource.setrlimit(resource.RLIMIT_STACK, (2**28, resource.getrlimit(resource.RLIMIT_STACK)[1]))
        child = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, preexec_fn=large_stacks)
        self.assertEqual(child.stdout, "True\n", child.stderr)

    def test_control_c_ends_a_batch(self):
        program = (
            "import octant, sys, time\n"
            "world = octant.World(triangles=500)\n"
            "eyes = world.ground.random_positions(200000)\n"
            "frames = octant.Frames.empty(octant.Camera(8, 8), len(eyes))\n"
            "print('drawing', flush=True)\n"
            "try:\n"
            "    world.render(octant.Camera(8, 8), eyes, octant.attitudes(), out=frames, threads=2)\n"
            "except KeyboardInterrupt:\n"
            "    world.render(octant.Camera(8, 8), eyes[:3], octant.attitudes())\n"
            "    print('interrupted', flush=True)\n"
        )
        with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True) as child:
            self.assertEqual(child.stdout.readline(), "drawing\n")
            time.sleep(0.3)
            child.send_signal(signal.SIGINT)
            begin = time.monotonic()
            self.assertEqual(child.stdout.readline(), "interrupted\n")
            self.assertLess(time.monotonic() - begin, 3)
            self.assertEqual(child.wait(), 0)


if __name__ == "__main__":
    unittest.main()
