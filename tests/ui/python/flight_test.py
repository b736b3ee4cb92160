"""Flights frame by frame, their recordings as tables, reports; against the program octant."""

import importlib.util
import os
import pathlib
import subprocess
import tempfile
import threading
import unittest
import zipfile

import numpy as np

import octant

program = os.environ["OCTANT_PROGRAM"]
flight = {"aircraft": "500md", "terrain": "hills", "size": (64, 48), "frames": 12}


class Flights(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_frames_are_those_of_the_program(self):
        recorded = self.folder / "by-program"
        subprocess.run(
            [program, "fly", "turn", "--aircraft", "500md", "--terrain", "hills", "--size", "64x48", "--frames", "12",
             "--record", recorded, "--quiet"],
            check=True, stdout=subprocess.DEVNULL,
        )  # fmt: skip
        own = self.folder / "by-library"
        frames = list(octant.fly("turn", record=own, **flight))
        self.assertEqual([each.number for each in frames], list(range(12)))
        a, b = octant.recording(recorded).frames, octant.recording(own).frames
        self.assertEqual(list(a), list(b))
        np.testing.assert_array_equal(a["picture_hash"], b["picture_hash"])
        np.testing.assert_array_equal(a["state_hash"], b["state_hash"])
        np.testing.assert_allclose(b["sim_time_s"], [each.time_s for each in frames], atol=1e-6)
        np.testing.assert_allclose(b["aircraft_x_m"], [each.states[0].position_m[0] for each in frames], atol=1e-3)
        self.assertEqual(frames[0].rgb.shape, (48, 64, 3))
        self.assertFalse(np.array_equal(frames[0].rgb, frames[11].rgb))
        self.assertGreater(frames[5].timing.frame_ms, frames[5].timing.draw_ms)

    def test_a_flight_is_for_one_thread(self):
        flown = octant.fly("turn", **{**flight, "size": (640, 480), "frames": 60})
        refused, drawn = [], []

        def draw():
            try:
                for each in flown:
                    drawn.append(each.number)
            except ValueError as fault:
                refused.append(str(fault))

        threads = [threading.Thread(target=draw) for _ in range(4)]
        for each in threads:
            each.start()
        for each in threads:
            each.join()
        self.assertEqual(drawn, sorted(set(drawn)))
        self.assertEqual(set(refused) - {"flight: expected one thread at a time, got a second one"}, set())
        self.assertGreater(len(refused), 0)

    def test_columns_have_types(self):
        for _ in octant.fly("turn", record=self.folder / "flight", **flight):
            pass
        table = octant.recording(self.folder / "flight").frames
        self.assertEqual({len(column) for column in table.values()}, {12})
        self.assertEqual(table["frame"].dtype, np.int64)
        self.assertEqual(table["frame_ms"].dtype, np.float64)
        self.assertEqual(table["latency_ms"].dtype, np.float64)
        self.assertTrue(np.isnan(table["latency_ms"]).all())
        self.assertEqual(table["picture_hash"].dtype.kind, "U")
        run = octant.recording(self.folder / "flight").run
        self.assertEqual(run["settings"]["aircraft"], ["500md"])
        self.assertGreater(len(octant.recording(self.folder / "flight").track["t_s"]), 2)
        self.assertEqual(len(octant.recording(self.folder / "flight").counters["frame"]), 12)
        if importlib.util.find_spec("pandas"):
            import pandas

            frame = pandas.DataFrame(table)
            self.assertEqual(frame.shape, (12, len(table)))
            self.assertEqual(list(frame.columns), list(table))

    def test_a_packed_recording_is_the_same(self):
        for _ in octant.fly("turn", record=self.folder / "flight", **flight):
            pass
        packed = self.folder / "flight.zip"
        subprocess.run([program, "pack", self.folder / "flight", "--out", packed, "--quiet"], check=True)
        a, b = octant.recording(self.folder / "flight").frames, octant.recording(packed).frames
        for name in a:
            np.testing.assert_array_equal(a[name], b[name])

    def test_a_flight_ended_early_has_its_recording(self):
        with octant.fly("turn", record=self.folder / "short", **flight) as frames:
            self.assertEqual(len(frames), 12)
            for frame in frames:
                if frame.number == 3:
                    break
        recording = octant.recording(self.folder / "short")
        self.assertEqual(len(recording.frames["frame"]), 4)
        self.assertIn("4 of 12 frames", str(recording.run))
        self.assertTrue((self.folder / "short" / "report.html").exists())
        with self.assertRaises(StopIteration):
            next(frames)

    def test_two_recordings_make_a_report(self):
        for name in ("a", "b"):
            for _ in octant.fly("turn", record=self.folder / name, **flight):
                pass
        page = self.folder / "page.html"
        octant.report([self.folder / "a", self.folder / "b"], out=page)
        self.assertIn("<html", page.read_text(encoding="utf-8")[:500].lower())
        with self.assertRaises(octant.Error):
            octant.report([self.folder / "none"], out=self.folder / "no.html")
        self.assertFalse((self.folder / "no.html").exists())
        with self.assertRaises(octant.Error):
            octant.report([], out=self.folder / "no.html")

    def test_wrong_recordings_name_file_and_line(self):
        with self.assertRaises(OSError):
            octant.recording(self.folder / "none")
        with self.assertRaises(ValueError):
            octant.recording(__file__)
        broken = self.folder / "broken"
        broken.mkdir()
        (broken / "run.json").write_text('{"format": "octant recording",\n "summary": {}', encoding="utf-8")
        with self.assertRaises(octant.Error) as raised:
            octant.recording(broken)
        self.assertIn("run.json:2:", str(raised.exception))
        (broken / "run.json").write_text('{"format": "octant recording", "summary": {}}', encoding="utf-8")
        (broken / "frames.csv").write_text("frame,frame_ms\n0,1.5\n1\n", encoding="utf-8")
        with self.assertRaises(octant.Error) as raised:
            octant.recording(broken).frames
        self.assertIn("frames.csv:3: expected 2 columns, got 1", str(raised.exception))
        (broken / "run.json").write_text('{"format": "octant recording"}', encoding="utf-8")
        (broken / "frames.csv").write_text("frame,frame_ms\n0,1.5\n1,2", encoding="utf-8")
        np.testing.assert_array_equal(octant.recording(broken).frames["frame_ms"], [1.5])
        with zipfile.ZipFile(self.folder / "empty.zip", "w"):
            pass
        with self.assertRaises(octant.Error):
            octant.recording(self.folder / "empty.zip")

    def test_wrong_flights_are_refused(self):
        for path, wrong in (
            ("nowhere", {}), ("turn", {"size": (1, 1)}), ("turn", {"colour": 1}), ("live", {}), ("turn", {"view": "odd"}),
            ("turn", {"frames": 0}), ("turn", {"path": "turn"}),
        ):  # fmt: skip
            with self.assertRaises((ValueError, TypeError), msg=f"{path} {wrong}"):
                octant.fly(path, **wrong)


class ByHand(unittest.TestCase):
    def test_the_same_controls_give_the_same_flight(self):
        start = octant.states([0, 0, 1000], octant.attitudes(heading_deg=90), velocity_mps=[150, 0, 0])
        flights = [octant.PilotedAircraft("f15", start) for _ in range(2)]
        for each in flights:
            each.advance(0.0, 0.0, each.trim_throttle, 0.0, steps=600)
        a, b = (each.state for each in flights)
        np.testing.assert_array_equal(a.position_m, b.position_m)
        self.assertAlmostEqual(float(a.time_s), 5.0)
        np.testing.assert_allclose(a.position_m, [750, 0, 1000], atol=40)
        flights[0].advance(1.0, 0.0, 0.5, 0.0, steps=30)
        self.assertGreater(np.abs(flights[0].state.attitude - a.attitude).max(), 0.1)

    def test_an_aircraft_without_a_flight_model_is_refused(self):
        start = octant.states([0, 0, 1000], velocity_mps=[150, 0, 0])
        with self.assertRaises(octant.Error):
            octant.PilotedAircraft("f16", start)
        with self.assertRaises(ValueError):
            octant.PilotedAircraft("f15", octant.states(np.zeros((2, 3))))
        with self.assertRaises(ValueError):
            octant.PilotedAircraft("f15", start).advance(float("nan"), 0, 0, 0)


if __name__ == "__main__":
    unittest.main()
