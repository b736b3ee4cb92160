"""Recordings, and the statistics of their frame times and of changes, by the words of pages and headers: for
recompute_pages.py. Shares no code with Octant. Tests of ranks are enumerated (all signs, all choices), not computed by
the program's recurrences; the rest is numpy's and scipy's.
"""
import csv
import itertools
import json
import math
from pathlib import Path

import numpy
import scipy.stats


# Frame times of other programs.

def write_captures(folder):
    folder.mkdir()
    dice = numpy.random.default_rng(7)

    def times(mean_ms, count=240):
        return numpy.round(mean_ms * numpy.exp(dice.normal(0.0, 0.08, count)), 4)

    for i in range(1, 4):
        rows = ["Application,ProcessID,SwapChainAddress,Runtime,Dropped,TimeInSeconds,MsBetweenPresents"]
        time_s = 12.5
        for k, ms in enumerate(times(8.0)):
            time_s += ms / 1000
            rows.append(f"sim.exe,77,0x1,DXGI,{int(k % 60 == 5)},{time_s:.6f},{'NA' if k == 9 else ms}")
            if k % 4 == 0:
                rows.append(f"overlay.exe,78,0x2,DXGI,0,{time_s:.6f},16.7")
        (folder / f"presentmon-{i}.csv").write_text("\n".join(rows) + "\n")
    for card, mean_ms in (("A", 10.0), ("B", 10.6)):
        for i in range(1, 4):
            ms = times(mean_ms)
            at = numpy.cumsum(ms) / 1000
            name = f"capframex-{card.lower()}{i}"
            if i == 3:
                data = {"MsBetweenPresents": ms.tolist(), "TimeInSeconds": at.tolist(), "Dropped": [False] * len(ms)}
                info = {"GameName": "Flight", "Processor": "Chip 9", "GPU": f"Card {card}"}
                (folder / f"{name}.json").write_text(json.dumps({"Info": info, "Runs": [{"CaptureData": data}]}))
                continue
            rows = ["//GameName=Flight", "//Processor=Chip 9", f"//GPU=Card {card}",
                    "Application,Dropped,TimeInSeconds,MsBetweenPresents"]
            rows += [f"Flight,0,{t:.6f},{v}" for t, v in zip(at, ms)]
            (folder / f"{name}.csv").write_text("\n".join(rows) + "\n")
    for name, mean_ms in [("mangohud-1", 7.0)] + [(f"old-{i}", 9.0) for i in (1, 2, 3)] + [(f"new-{i}", 9.6) for i in (1, 2, 3)]:
        rows = ["os,cpu,gpu,ram,kernel,driver,cpuscheduler", "Debian,Chip 9,Card A,16000000,6.1,42,schedutil",
                "fps,frametime,cpu_load,elapsed"]
        at = 0.0
        for ms in times(mean_ms):
            at += ms * 1e6
            rows.append(f"{1000 / ms:.2f},{ms},40,{at:.0f}")
        (folder / f"{name}.csv").write_text("\n".join(rows) + "\n")

# Recordings.

def flattened(value, prefix=""):
    rows = []
    for name, each in value.items():
        if isinstance(each, dict):
            rows += flattened(each, prefix + name + ".")
        else:
            rows.append((prefix + name, shown_value(each)))
    return rows


def shown_value(value):
    if isinstance(value, str):
        return value
    if isinstance(value, list):
        return ", ".join(shown_value(each) for each in value)
    return json.dumps(value, ensure_ascii=False)


STAGES = ["sim", "plan", "draw", "read", "other"]


class Recording:
    """Own recordings (folders) and those of other programs (files)."""

    def __init__(self, path):
        self.path = Path(path)
        self.name = self.path.name
        self.format = ""
        self.has_counters = False
        if self.path.is_dir():
            self.read_own()
        else:
            self.read_capture()
        self.statistics = statistics_of(self.frame_ms)

    def read_own(self):
        run = json.loads((self.path / "run.json").read_text())
        self.title = run["title"]
        self.settings = flattened(run["settings"])
        self.machine = flattened(run["program"], "program.") + flattened(run["machine"])
        self.facts = flattened(run.get("facts", {})) + [("note", shown_value(n)) for n in run.get("notes", [])]
        self.legs = [[leg["label"], leg["time_s"]] for leg in run.get("legs", [])]
        summary = run.get("summary") or {}
        self.ended = bool(summary)
        self.state_hash = summary.get("state_hash") or ""
        self.picture_hash = summary.get("picture_hash") or ""
        self.path_offset = shown_value(run["path_offset_m"])
        self.stopped = run.get("stopped", "")
        self.noise = run.get("noise", {}).get("reasons")
        machine = dict(self.machine)
        if self.noise is None:
            load, cores = float(machine["load_average_1min"]), int(machine["cores"])
            self.noise = [f"The load average was {load:.2f} on {cores} cores when the flight began."] if load > 0.5 * cores else []
        self.start, self.device = machine["start_time_utc"], machine["gl_renderer"]
        self.machine_text = f"{machine['cpu']}, {machine['cores']} cores"
        with open(self.path / "frames.csv", newline="") as file:
            rows = list(csv.reader(file))
        header = rows[0]
        rows = [row for row in rows[1:] if len(row) == len(header)]
        column = {name: [row[i] for row in rows] for i, name in enumerate(header)}
        number = lambda name: numpy.array([float(v) if v else math.nan for v in column[name]])
        self.warm_up = number("warm_up") != 0
        paused = number("paused") != 0 if "paused" in header else numpy.zeros(len(rows), bool)
        self.counted = ~self.warm_up & ~paused
        self.frames = len(rows)
        self.all = {name: number(name) for name in
                    ("frame", "sim_time_s", "frame_ms", "sim_ms", "plan_ms", "draw_ms", "read_ms", "terrain_triangles",
                     "triangle_change", "triangle_target", "stress")}
        self.row = {name: values[self.counted] for name, values in self.all.items()}
        self.frame_ms = self.row["frame_ms"]
        self.time_s = self.row["sim_time_s"]
        other = numpy.round(numpy.maximum(0.0, self.all["frame_ms"] - sum(self.all[s + "_ms"] for s in STAGES[:4])), 4)
        self.all["other_ms"] = other
        self.stage_ms = [self.all[s + "_ms"][self.counted] for s in STAGES]
        # What is compared: all frames but the warm-up, as the paused ones must stand in their places.
        self.compared_ms = self.all["frame_ms"][~self.warm_up]
        self.compared_stages = [self.all[s + "_ms"][~self.warm_up] for s in STAGES]
        self.paused = paused[~self.warm_up]
        self.first_frame = int(self.all["frame"][~self.warm_up][0]) if len(self.compared_ms) else None
        self.counters = {}
        counters = self.path / "counters.csv"
        if counters.is_file():
            self.has_counters = True
            for line in counters.read_text().split("\n")[1:-1]:
                frame, faults, switches, stolen = line.split(",")
                self.counters[int(frame)] = (int(faults), int(switches), float(stolen))
        self.inputs = flattened(run.get("inputs", {}))

    def read_capture(self):
        """Of the files of write_captures() only."""
        text = self.path.read_text()
        self.settings, self.machine, self.facts, self.legs, self.inputs = [], [], [], [], []
        self.state_hash = self.picture_hash = self.path_offset = self.stopped = self.start = ""
        self.ended, self.noise, self.title = True, [], ""
        rows_left_out = dropped = 0
        others = {}
        if text.startswith("{"):
            data = json.loads(text)
            self.format, self.title = "CapFrameX JSON", data["Info"]["GameName"]
            self.machine = [("cpu", data["Info"]["Processor"]), ("gpu", data["Info"]["GPU"])]
            run = data["Runs"][0]["CaptureData"]
            times, at = run["MsBetweenPresents"], run["TimeInSeconds"]
        else:
            lines = text.split("\n")[:-1]
            head = next(i for i, line in enumerate(lines) if "MsBetweenPresents" in line or "frametime" in line)
            names = lines[head].split(",")
            rows = [dict(zip(names, line.split(","))) for line in lines[head + 1:]]
            if "frametime" in names:
                self.format, key = "MangoHud log", "frametime"
                self.machine = [(k, v) for k, v in zip(lines[0].split(","), lines[1].split(",")) if k != "cpuscheduler"]
                self.machine = [("memory" if k == "ram" else k, v) for k, v in self.machine]
                at_of = lambda row: float(row["elapsed"]) * 1e-9
            else:
                key = "MsBetweenPresents"
                self.format = "CapFrameX CSV" if lines[0].startswith("//") else "PresentMon CSV"
                for line in lines[:head]:
                    name, value = line[2:].split("=")
                    self.machine += [({"Processor": "cpu", "GPU": "gpu"}[name], value)] if name != "GameName" else []
                at_of = lambda row: float(row["TimeInSeconds"])
                applications = [row["Application"] for row in rows]
                self.title = max(set(applications), key=applications.count)
                others = {a: applications.count(a) for a in set(applications) - {self.title}}
                rows = [row for row in rows if row["Application"] == self.title]
            rows_left_out = sum(row[key] == "NA" for row in rows)
            rows = [row for row in rows if row[key] != "NA"]
            dropped = sum(row.get("Dropped") == "1" for row in rows)
            times, at = [float(row[key]) for row in rows], [at_of(row) for row in rows]
        self.frame_ms = numpy.array(times)
        self.time_s = numpy.array(at) - at[0]
        self.facts = [("recorded with", self.format)] + ([("application", self.title)] if self.title else [])
        if self.format != "CapFrameX JSON":
            self.facts.append(("frame time is", key))
        if others:
            self.facts.append(("note", f"of {1 + len(others)} swap chains only that with the most frames is taken, {self.title} "
                               f"({len(times)} frames); left out: " + ", ".join(f"{a} ({n})" for a, n in others.items())))
        if dropped:
            self.facts.append(("note", f"{dropped} of {len(times)} frames were dropped (never shown); their times count"))
        if rows_left_out:
            self.facts.append(("note", f"rows without a frame time, left out: {rows_left_out}"))
        self.application = self.title
        self.title = self.title or self.path.stem
        machine = dict(self.machine)
        self.device = machine.get("gpu", "")
        self.machine_text = machine.get("cpu", "")
        self.frames, self.stage_ms, self.first_frame = len(times), None, 0
        self.row = {"frame": numpy.arange(len(times))}
        self.all = {"frame_ms": self.frame_ms, "sim_time_s": self.time_s}
        self.counted = numpy.ones(len(times), bool)
        self.warm_up = self.paused = ~self.counted
        self.compared_ms, self.compared_stages = self.frame_ms, None
        self.counters = {}

    def faults(self):
        words = []
        if not self.ended:
            words.append("ended early")
        if self.stopped:
            words.append("stopped")
        if self.noise:
            words.append("noisy")
        if not len(self.frame_ms):
            words.append("no frames")
        return words

    def differing(self):
        """What may make it another flight, and what another variant: of the settings that pages.sh varies."""
        scene = {"path", "aircraft"}
        own = [(k, v) for k, v in self.settings if k != "pictures"]
        flight = [row for row in own if row[0] in scene] + [("inputs", tuple(self.inputs)), ("title", self.title)]
        if self.format:
            flight = [("application", self.application), ("cpu", self.machine_text)]
        drawing = [row for row in own if row[0] not in scene] + [("device", self.device)]
        return tuple(flight), tuple(drawing)


# Statistics of one flight, by the definitions that its page has.

def nearest_rank(ordered, share):
    return ordered[math.ceil(round(share * len(ordered), 9)) - 1]


def statistics_of(ms):
    n = len(ms)
    if n == 0:
        return {}
    ordered = numpy.sort(ms)
    low = lambda share: 1000.0 / float(numpy.mean(ordered[-math.ceil(round(share * n, 9)):]))
    return {"Frames": (n, 0), "Mean, ms": (float(numpy.mean(ms)), 3),
            "Standard deviation, ms": (float(numpy.std(ms, ddof=1)) if n > 1 else 0.0, 3),
            "P50, ms": (nearest_rank(ordered, 0.5), 3), "P90, ms": (nearest_rank(ordered, 0.9), 3),
            "P95, ms": (nearest_rank(ordered, 0.95), 3), "P99, ms": (nearest_rank(ordered, 0.99), 3),
            "P99.9, ms": (nearest_rank(ordered, 0.999), 3), "Longest, ms": (ordered[-1], 3),
            "1 % low, frames/s": (low(0.01), 2), "0.1 % low, frames/s": (low(0.001), 2),
            "Overruns of 16.67 ms": (int(numpy.sum(ms > 16.67)), 0), "Overruns of 33.3 ms": (int(numpy.sum(ms > 33.3)), 0),
            "Overruns of 41.7 ms": (int(numpy.sum(ms > 41.7)), 0),
            "Jitter, ms": (float(numpy.mean(numpy.abs(numpy.diff(ms)))) if n > 1 else 0.0, 3)}


# Statistics of changes. Each gives (estimate, low, high, p), or None where there are too few flights. Signed ranks also
# give the least p that they can, and that of Student's t, which counts where the least p is no change among so many.

def student(estimate, error, degrees):
    reach = scipy.stats.t.ppf(0.975, degrees) * error
    p = 2 * scipy.stats.t.sf(abs(estimate) / error, degrees) if error > 0 else float(estimate == 0)
    return estimate, estimate - reach, estimate + reach, p


def mean_of(differences):
    n = len(differences)
    return student(numpy.mean(differences), numpy.std(differences, ddof=1) / math.sqrt(n), n - 1) if n >= 3 else None


def centre_of(differences):
    n = len(differences)
    if n < 6:
        return mean_of(differences)
    signs = numpy.array(list(itertools.product((0, 1), repeat=n)))
    sums = signs @ numpy.arange(1, n + 1)
    left_out = 0  # of the sorted means of all pairs, on each side
    while 2 * numpy.mean(sums <= left_out) <= 0.05:
        left_out += 1
    means = numpy.sort([(a + b) / 2 for a, b in itertools.combinations_with_replacement(differences, 2)])
    ranks = scipy.stats.rankdata(numpy.abs(differences))
    counted = differences != 0
    of_signs = signs[:, counted] @ ranks[counted]
    seen = numpy.sum(ranks[differences > 0])
    p = min(1.0, 2 * min(numpy.mean(of_signs <= seen + 1e-9), numpy.mean(of_signs >= seen - 1e-9)))
    return numpy.median(means), means[left_out - 1], means[-left_out], p, 2.0 ** (1 - n), mean_of(differences)[3]


def out_of_rounds(values, is_new):
    m, n = int(numpy.sum(~is_new)), int(numpy.sum(is_new))
    if m < 3 or n < 3:
        return None
    old, new = numpy.mean(values[~is_new]), numpy.mean(values[is_new])
    rests = values - numpy.where(is_new, new, old)
    independent = numpy.sum(rests**2) / (m + n - 2) * (1 / m + 1 / n)
    # The difference of the means of a random walk, as a sum over its steps.
    weights = numpy.where(is_new, 1 / n, -1 / m)
    of_steps = [numpy.sum(weights[i:]) for i in range(1, m + n)]
    walk = numpy.sum(numpy.diff(rests)**2) / (m + n - 2) * numpy.sum(numpy.square(of_steps))
    return student(new - old, math.sqrt(max(independent, walk)), m + n - 2)


def are_rounds(is_new):
    pairs = is_new.reshape(-1, 2) if len(is_new) % 2 == 0 else numpy.zeros((1, 2))
    old_first = numpy.sum(pairs[:, 1])
    return bool(numpy.all(pairs[:, 0] != pairs[:, 1])) and 0 < old_first < len(pairs)


def differences_of(values, is_new):
    pairs, sides = values.reshape(-1, 2), is_new.reshape(-1, 2)
    return numpy.where(sides[:, 1], pairs[:, 1] - pairs[:, 0], pairs[:, 0] - pairs[:, 1])


def change_of(values, is_new, in_rounds, centre=centre_of):
    return centre(differences_of(values, is_new)) if in_rounds else out_of_rounds(values, is_new)


def mann_whitney(old, new):
    ranks = scipy.stats.rankdata(numpy.concatenate([old, new]))
    expected = len(old) * (len(ranks) + 1) / 2
    sums = numpy.array([sum(c) for c in itertools.combinations(ranks, len(old))])
    return float(numpy.mean(numpy.abs(sums - expected) >= abs(sum(ranks[:len(old)]) - expected) - 1e-9))


def holm(p_values):
    adjusted, greatest = [0.0] * len(p_values), 0.0
    for k, i in enumerate(sorted(range(len(p_values)), key=lambda i: p_values[i])):
        greatest = max(greatest, (len(p_values) - k) * p_values[i])
        adjusted[i] = min(1.0, greatest)
    return adjusted


def mean_of_middle_half(values):
    quarter = len(values) // 4
    return numpy.mean(numpy.sort(values)[quarter:len(values) - quarter])


class SameFrames:
    """Flights of the same frames, by the definitions of frame_change.h."""

    def __init__(self, flights, is_new, in_rounds):
        count = min(len(f.compared_ms) for f in flights)
        self.ms = numpy.array([f.compared_ms[:count] for f in flights])
        self.is_new, self.in_rounds, self.count = is_new, in_rounds, count
        self.stages = [numpy.array([f.compared_stages[s][:count] for f in flights]) for s in range(5)]
        self.usual = numpy.median(self.ms, axis=0)
        ms = numpy.maximum(self.ms, 1e-6)
        far = numpy.log(ms[0::2] / ms[1::2]) if in_rounds else numpy.log(ms / numpy.maximum(self.usual, 1e-6))
        far = numpy.abs(far - numpy.median(far, axis=1, keepdims=True))
        middle = numpy.median(far, axis=0)
        running = ~numpy.array([f.paused[:count] for f in flights])
        running = running[0::2] & running[1::2] if in_rounds else running
        kept = running & (far <= middle + 2.5 * max(0.005, 1.4826 * numpy.median(numpy.abs(far - middle))))
        few = 2 * kept.sum(axis=1) < count
        kept[few] = running[few]
        kept[2 * kept.sum(axis=1) < count] = True
        self.kept = numpy.repeat(kept, 2, axis=0) if in_rounds else kept

    def change(self):
        return change_of(self.logarithms(), self.is_new, self.in_rounds)

    def logarithms(self):
        weights = self.usual * self.kept
        return numpy.sum(weights * numpy.log(numpy.maximum(self.ms, 1e-6) / self.usual), axis=1) / weights.sum(axis=1)

    def mean_ms(self, new, part=slice(None)):
        return float(numpy.median([numpy.mean(ms[part][kept[part]]) for ms, kept, n in zip(self.ms, self.kept, self.is_new) if n == new]))

    def change_ms(self, part, stage=None):
        times = self.ms if stage is None else self.stages[stage]
        over = times - numpy.median(times, axis=0)
        mean = numpy.mean if stage is None else mean_of_middle_half
        values = numpy.array([mean(o[part][k[part]]) if k[part].any() else 0.0 for o, k in zip(over, self.kept)])
        return change_of(values, self.is_new, self.in_rounds, mean_of)

    def frames_changed(self):
        """First and last place and mean change of the changed frames; None where they are not apart from the others."""
        blocks = max(1, min(25, self.count // 4))
        edges = [b * self.count // blocks for b in range(blocks + 1)]
        changes = [self.change_ms(slice(a, b)) for a, b in zip(edges, edges[1:])]
        sure = [p <= 0.05 for p in holm([c[3] for c in changes])]
        most, found = 0.0, None
        for first in range(blocks):
            if not sure[first]:
                continue
            total, others = 0.0, 0
            for last in range(first, blocks):
                total += changes[last][0] * (edges[last + 1] - edges[last])
                if sure[last] and (changes[last][0] > 0) == (changes[first][0] > 0):
                    others = 0
                    if abs(total) > most:
                        most, found = abs(total), (edges[first], edges[last + 1])
                else:
                    others += 1
                    if others == 2:
                        break
        if found is None or found[1] - found[0] > 0.7 * self.count:
            return None
        rough = self.change_ms(slice(*found))[0]
        profile = []
        for k in range(self.count):
            sides = [self.ms[(self.is_new == new) & self.kept[:, k], k] for new in (False, True)]
            profile.append(numpy.mean(sides[1]) - numpy.mean(sides[0]) if len(sides[0]) and len(sides[1]) else 0.0)
        begin, end = max(0, found[0] - edges[1]), min(self.count, found[1] + edges[1])
        excess = numpy.concatenate([[0.0], numpy.cumsum(math.copysign(1, rough) * numpy.array(profile[begin:end]) - abs(rough) / 2)])
        best = max((excess[j] - excess[i], -i, j) for i in range(len(excess)) for j in range(i + 1, len(excess)))
        if best[0] > 0:
            found = (begin - best[1], begin + best[2])
        inside = self.change_ms(slice(*found))[0]
        whole = self.change_ms(slice(None))[0] * self.count
        if abs(inside * (found[1] - found[0])) < 0.7 * abs(whole):
            return None
        return found[0], found[1] - 1, inside

    def stage_changed(self, part):
        changes = [self.change_ms(part, s) for s in range(5)]
        if None in changes:
            return None
        adjusted = holm([c[3] for c in changes])
        sure = [(abs(c[0]), STAGES[s], c[0]) for s, c in enumerate(changes) if adjusted[s] <= 0.05]
        return max(sure)[1:] if sure else None


class Comparison:
    """A variant against the baseline. `alternate`: flown as old, new, old, new by octant compare."""

    def __init__(self, flight, old_name, new_name, old, new, alternate):
        self.flight, self.old_name, self.new_name, self.old, self.new = flight, old_name, new_name, old, new
        both = [r for r in old + new if len(r.compared_ms)]
        old_ones = set(map(id, old))
        if alternate:
            both = [r for pair in zip(old, new) for r in pair]
        else:
            both.sort(key=lambda r: r.start)
        is_new = numpy.array([id(r) not in old_ones for r in both])
        self.same_states = len({r.state_hash for r in both} - {""}) <= 1
        self.same_pictures = len({r.picture_hash for r in both} - {""}) <= 1
        self.same_flight = old[0].differing()[0] == new[0].differing()[0]
        same = self.same_states and self.same_flight and not any(r.format for r in both) and \
            len({r.first_frame for r in both}) == 1
        in_rounds = alternate or are_rounds(is_new)
        self.runs = (int(numpy.sum(~is_new)), int(numpy.sum(is_new)))
        self.frames_changed = self.stage = None
        if same:
            flights = SameFrames(both, is_new, in_rounds)
            self.pairing, self.frames = ("rounds" if in_rounds else "frames"), flights.count
            self.change = flights.change()
            self.old_ms, self.new_ms = flights.mean_ms(False), flights.mean_ms(True)
            values = flights.logarithms()
            part = slice(None)
            if self.change:
                self.frames_changed = flights.frames_changed()
                if self.frames_changed:
                    part = slice(self.frames_changed[0], self.frames_changed[1] + 1)
                self.stage = flights.stage_changed(part)
            self.first_frame = both[0].first_frame
        else:
            self.pairing, self.frames, self.first_frame = "figures", min(len(r.compared_ms) for r in both), 0
            few = lambda r: 2 * numpy.sum(~r.paused) < len(r.paused)
            medians = numpy.array([numpy.median(r.compared_ms if few(r) else r.compared_ms[~r.paused]) for r in both])
            values = numpy.log(medians)
            self.change = change_of(values, is_new, in_rounds)
            self.old_ms, self.new_ms = float(numpy.median(medians[~is_new])), float(numpy.median(medians[is_new]))
        self.u = mann_whitney(values[~is_new], values[is_new])
        self.adjusted = 1.0
        if self.change:
            self.share, self.low, self.high = (100 * math.expm1(v) for v in self.change[:3])
        else:
            self.share, self.low, self.high = 100 * (self.new_ms / self.old_ms - 1), None, None

    def changed(self):
        return self.change is not None and self.adjusted <= 0.05

    def outcome(self, limit, within):
        if self.changed():
            return "faster" if self.share < 0 else "slower"
        return "no-change" if self.change and self.high <= limit + within else "unknown"
