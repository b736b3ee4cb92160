#!/usr/bin/env python3
"""Simplifies collected meshes with octant and with other libraries and judges every result.

evaluate.py --meshes FOLDER --peers BUILD --octant BINARY --out FOLDER [--set open|held|all] [--quick] [--only NAME,...]
            [--octant-options "--threads 1"] [--label TEXT]

FOLDER of meshes: filled by collect.py. BUILD: cmake -S tests/peers -B BUILD && cmake --build BUILD.
Writes OUT/results.csv (a row per mesh, goal and tool) and OUT/summary.md. Distances are fractions of the bounding
box's diagonal, sampled by octant-mesh-judge. CPU seconds are user and system time; Lindstrom-Turk (CGAL) is timed
anew before and after each run of octant and is the unit. Other results are cached below the folder of meshes by
tool, mesh and goal; octant's by the hash of its binary and its options, so that a run goes on where it was stopped.
"""
import argparse
import collect
import csv
import hashlib
import json
import math
import os
import pathlib
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import time

LIBRARIES = ["cgal-lindstrom-turk", "cgal-garland-heckbert", "meshoptimizer", "meshlab"]
UNIT = "cgal-lindstrom-turk"
QUICK = ["tube", "sheet", "suzanne", "featuretype", "studs", "pinholes", "tile-west", "cow"]
FLOOR = 1e-6  # of the diagonal: smaller distances count as this
LARGE_FACES = 5000
FOLDED_NOISE = 1e-4  # of the area: 20 of the sampled points
GOAL_SLACK = 1.02  # a result with more faces than this times the goal has missed it

MESHLAB_SCRIPT = """<!DOCTYPE FilterScript><FilterScript>
<filter name="Simplification: Quadric Edge Collapse Decimation">
<Param type="RichInt" value="{goal}" name="TargetFaceNum"/><Param type="RichFloat" value="0" name="TargetPerc"/>
<Param type="RichFloat" value="0.3" name="QualityThr"/><Param type="RichBool" value="false" name="PreserveBoundary"/>
<Param type="RichFloat" value="1" name="BoundaryWeight"/><Param type="RichBool" value="false" name="PreserveNormal"/>
<Param type="RichBool" value="false" name="PreserveTopology"/>
<Param type="RichBool" value="true" name="OptimalPlacement"/><Param type="RichBool" value="false" name="PlanarQuadric"/>
<Param type="RichFloat" value="0.001" name="PlanarWeight"/><Param type="RichBool" value="false" name="QualityWeight"/>
<Param type="RichBool" value="true" name="AutoClean"/><Param type="RichBool" value="false" name="Selected"/>
</filter></FilterScript>
"""


class Run:
    """A finished process: exit code, output, CPU seconds and peak memory of it and its children."""

    def __init__(self, command, timeout_s=1800):
        process = subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (timeout_s, timeout_s)))
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.output, self.errors = process.communicate()
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.code = process.returncode
        self.cpu_s = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def peak_of(command):
    """The command under /usr/bin/time where that is installed, and a reader of its peak memory in MB."""
    if not shutil.which("/usr/bin/time"):
        return command, lambda run: ""
    return ["/usr/bin/time", "-f", "%M"] + command, lambda run: round(int(run.errors.split()[-1]) / 1024)


def obj_to_ply(source, target):
    """MeshLab's reader of OBJ fails on some of these files."""
    vertices, faces = [], []
    with open(source) as file:
        for line in file:
            if line.startswith("v "):
                vertices.append(struct.pack("<3f", *map(float, line.split()[1:4])))
            elif line.startswith("f "):
                corners = [int(word.split("/")[0]) for word in line.split()[1:]]
                corners = [i - 1 if i > 0 else len(vertices) + i for i in corners]
                faces += [struct.pack("<B3i", 3, corners[0], *pair) for pair in zip(corners[1:], corners[2:])]
    with open(target, "wb") as file:
        file.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\nproperty float x\n"
                   f"property float y\nproperty float z\nelement face {len(faces)}\n"
                   "property list uchar int vertex_indices\nend_header\n".encode())
        file.write(b"".join(vertices) + b"".join(faces))


class Evaluation:
    def __init__(self, options):
        self.options = options
        self.peers = pathlib.Path(options.peers)
        self.meshes = pathlib.Path(options.meshes)
        self.cache = self.meshes / "cache"
        self.cache.mkdir(exist_ok=True)
        binary = pathlib.Path(options.octant).read_bytes()
        self.judge_key = hashlib.sha1((self.peers / "octant-mesh-judge").read_bytes()).hexdigest()[:6]
        self.octant_key = hashlib.sha1(binary + options.octant_options.encode()).hexdigest()[:10]

    def library(self, name, source, goal, target):
        if name == "meshlab":
            return self.meshlab(source, goal, target)
        run = Run([self.peers / "octant-peers", name, source, goal, target])
        if run.code != 0:
            return {"status": f"exit {run.code}"}
        return {"status": "", "cpu_s": json.loads(run.output)["time_ms"] / 1e3}

    def meshlab(self, source, goal, target):
        if not shutil.which("meshlabserver"):
            return {"status": "absent"}
        with tempfile.TemporaryDirectory() as scratch:
            ply, script, out = (pathlib.Path(scratch) / name for name in ("in.ply", "script.mlx", "out.ply"))
            obj_to_ply(source, ply)
            script.write_text(MESHLAB_SCRIPT.format(goal=goal))
            run = Run(["xvfb-run", "-a", "meshlabserver", "-i", ply, "-o", out, "-s", script])
            if not out.exists():
                return {"status": f"exit {run.code}"}
            Run([self.peers / "octant-mesh-to-obj", out, target])
        return {"status": "", "cpu_s": run.cpu_s}

    def octant(self, source, goal, target):
        """Whole process; of it the seconds of simplification and certificate where octant tells them."""
        repeat = 1 if source.stat().st_size > 3e5 else 5
        unit = [self.peers / "octant-peers", UNIT, source, goal, "/dev/null", "--repeat", repeat]
        times = [Run(unit)]
        command, peak = peak_of([self.options.octant, "simplify", source, target, "--faces", goal, "--json"]
                                + self.options.octant_options.split())
        run = Run(command)
        times.append(Run(unit))
        times_s = [json.loads(lt.output)["time_ms"] / 1e3 for lt in times if lt.code == 0]
        if run.code not in (0, 1) or not target.exists():
            return {"status": f"exit {run.code}: {run.errors.decode(errors='replace').strip()[:80]}"}
        told = json.loads(run.output)
        cpu = told.get("cpu_s", run.cpu_s)
        return {"status": "", "cpu_s": sum(cpu.values()) if isinstance(cpu, dict) else cpu, "process_s": run.cpu_s,
                "lt_s": sum(times_s) / len(times_s) if times_s else "", "peak_mb": peak(run),
                "certificate": told["error_of_diagonal"]}

    def results_of(self, row, goal):
        """Every tool's result as a dictionary: made now or kept in the cache, judged now or by this judge before."""
        source = self.meshes / (row["name"] + ".obj")
        mesh_key = hashlib.sha1(source.read_bytes()).hexdigest()[:10]
        results, unjudged = {}, {}
        for tool in [UNIT, "octant"] if row["class"] == "large" else LIBRARIES + ["octant"]:
            key = f"-{self.octant_key}" if tool == "octant" else ""
            kept = self.cache / f"{row['name']}-{mesh_key}-{goal}-{tool}{key}"
            target, run, judged = (kept.with_name(kept.name + ending) for ending in
                                   (".obj", ".run.json", f".{self.judge_key}.json"))
            if not run.exists():
                target.unlink(missing_ok=True)
                made = self.octant(source, goal, target) if tool == "octant" else self.library(tool, source, goal, target)
                run.write_text(json.dumps(made))
            results[tool] = json.loads(run.read_text())
            if judged.exists():
                results[tool].update(json.loads(judged.read_text()))
            elif not results[tool]["status"]:
                unjudged[tool] = (target, judged)
        if unjudged:
            judge = Run([self.peers / "octant-mesh-judge", source] + [target for target, _ in unjudged.values()])
            for (tool, (_, judged)), line in zip(unjudged.items(), judge.output.decode().splitlines()):
                judged.write_text(line)
                results[tool].update(json.loads(line))
        for result in results.values():
            if not result["status"] and not result.get("faces"):
                result["status"] = "no faces"
        return results


COLUMNS = ["mesh", "class", "set", "goal", "tool", "status", "faces_before", "faces", "rms", "max", "rms_forth", "rms_back",
           "folded", "open_edges_before", "open_edges", "non_manifold_edges_before", "non_manifold_edges",
           "shells_before", "shells", "cpu_s", "process_s", "lt_s", "peak_mb", "certificate"]


def mean(values):
    return math.exp(sum(map(math.log, values)) / len(values)) if values else math.nan


def ratio(ours, other, value):
    return max(ours[value], FLOOR) / max(other[value], FLOOR)


def met(result, goal):
    return not result["status"] and result["faces"] <= GOAL_SLACK * goal


class Case:
    """A mesh and goal: octant's result against the libraries that met the goal."""

    def __init__(self, row, goal, results):
        self.row, self.goal, self.ours = row, goal, results["octant"]
        self.name = f"{row['name']} {goal}"
        self.ok = not self.ours["status"]
        self.met = met(self.ours, goal)
        libraries = {tool: results[tool] for tool in LIBRARIES if tool in results and met(results[tool], goal)}
        self.unit = libraries.get(UNIT)
        self.libraries = list(libraries.values())
        self.large = self.ok and self.ours["faces_before"] >= LARGE_FACES

    def best(self, value):
        return min(self.libraries, key=lambda result: result[value])

    def against_best(self, value):
        return ratio(self.ours, self.best(value), value) if self.ok and self.libraries else math.nan


def summary(cases, label):
    ok = [case for case in cases if case.ok]
    compared = [case for case in ok if case.libraries]
    with_unit = [case for case in ok if case.unit]
    cpu = [case.ours["cpu_s"] / case.ours["lt_s"] for case in ok if case.large and case.ours["lt_s"]]
    small = [case.ours["cpu_s"] for case in ok if not case.large]
    above = [case for case in compared
             if not case.met or max(case.against_best("rms"), case.against_best("max")) > 1.005]
    parts = [case for case in compared if case.row["class"] in ("assembly", "holes")]
    folded = [case for case in compared if case.ours["folded"] > case.best("folded")["folded"] + FOLDED_NOISE]
    pinched = [case for case in ok if case.ours["non_manifold_edges"] > case.ours["non_manifold_edges_before"]]
    opened = [case for case in ok if case.ours["open_edges_before"] == 0 and case.ours["open_edges"] > 0]
    below = [case for case in ok if case.ours["certificate"] < case.ours["max"] * (1 - 1e-6)]
    missed = [case for case in cases if not case.met]

    def names(chosen):
        return f"{len(chosen)} of {len(ok)}" + (": " + ", ".join(case.name for case in chosen) if chosen else "")

    def worst(values):
        return f"{mean(values):.2f} / {max(values):.2f}" if values else "-"

    def shares(results):
        folds = [result["folded"] for result in results]
        return f"{sum(folds) / len(folds):.5f} / {max(folds):.4f}" if folds else "-"

    lines = [f"## {label}", "", f"{len(cases)} cases of {len({case.row['name'] for case in cases})} meshes; ratios below 1 "
             "are better than the libraries.", "", "| | |", "|---|---|",
             f"| meshes of {LARGE_FACES} faces and more: CPU against LT, geometric mean / worst | {worst(cpu)} |",
             f"| smaller meshes: CPU seconds, geometric mean / worst | {worst(small)} |",
             f"| RMS against LT, geometric mean / worst | {worst([ratio(c.ours, c.unit, 'rms') for c in with_unit])} |",
             f"| Hausdorff against the best library | {worst([c.against_best('max') for c in compared])} |",
             f"| RMS against the best library | {worst([c.against_best('rms') for c in compared])} |",
             f"| above 1.0 of the best library in either value, or goal missed | {100 * len(above) / max(len(compared), 1):.0f} %"
             f" ({len(above)} of {len(compared)}) |",
             f"| assemblies and pinholes, RMS against the best library | {worst([c.against_best('rms') for c in parts])} |",
             f"| assemblies and pinholes, Hausdorff against the best library | {worst([c.against_best('max') for c in parts])} |",
             f"| more folded area than the best library | {names(folded)} |",
             f"| folded share of the area, mean / worst: octant | {shares([c.ours for c in compared])} |",
             f"| ... of Lindstrom-Turk | {shares([c.unit for c in with_unit])} |",
             f"| ... of the library with the least in each case | {shares([c.best('folded') for c in compared])} |",
             f"| non-manifold edges gained | {names(pinched)} |",
             f"| closed meshes opened | {names(opened)} |",
             f"| certificates below the sampled distance | {names(below)} |",
             f"| goals missed (or failed) | {names(missed)} |", "",
             "| case | class | faces before | after | RMS/LT | RMS/best | Hausdorff/best | CPU/LT | CPU s | MB | folded | best |",
             "|---|---|---|---|---|---|---|---|---|---|---|---|"]
    for case in sorted(cases, key=lambda case: -(case.against_best("rms") if case.libraries else 0)):
        if not case.ok:
            lines.append(f"| {case.name} | {case.row['class']} | {case.ours['status']} |")
            continue
        ours = case.ours
        unit = f"{ratio(ours, case.unit, 'rms'):.2f}" if case.unit else "-"
        cpu_ratio = f"{ours['cpu_s'] / ours['lt_s']:.1f}" if ours["lt_s"] else "-"
        folds = f"{case.best('folded')['folded']:.4f}" if case.libraries else "-"
        lines.append(f"| {case.name} | {case.row['class']} | {ours['faces_before']} | {ours['faces']} | {unit} | "
                     f"{case.against_best('rms'):.2f} | {case.against_best('max'):.2f} | {cpu_ratio} | "
                     f"{ours['cpu_s']:.2f} | {ours['peak_mb']} | {ours['folded']:.4f} | {folds} |")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("--meshes", "--peers", "--octant", "--out"):
        parser.add_argument(name, required=True)
    parser.add_argument("--set", default="open", choices=["open", "held", "all"])
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only", default="")
    parser.add_argument("--octant-options", default="--threads 1")
    parser.add_argument("--label", default="octant against other libraries")
    options = parser.parse_args()
    names = QUICK if options.quick else options.only.split(",") if options.only else None
    evaluation = Evaluation(options)
    out = pathlib.Path(options.out)
    out.mkdir(parents=True, exist_ok=True)
    cases = []
    with open(out / "results.csv", "w", newline="") as file:
        table = csv.DictWriter(file, COLUMNS, extrasaction="ignore")
        table.writeheader()
        for row in collect.rows():
            if names and row["name"] not in names or not names and options.set not in ("all", row["set"]):
                continue
            if not names and row["class"] == "large":
                continue  # by --only: for time and memory alone
            for goal in map(int, row["goals"].split()):
                results = evaluation.results_of(row, goal)
                for tool, result in results.items():
                    table.writerow({"mesh": row["name"], "class": row["class"], "set": row["set"], "goal": goal,
                                    "tool": tool, **result})
                file.flush()
                case = Case(row, goal, results)
                cases.append(case)
                print(f"{time.strftime('%H:%M:%S')} {case.name}: " + (
                    f"RMS/best {case.against_best('rms'):.2f}, Hausdorff/best {case.against_best('max'):.2f}, "
                    f"{case.ours['cpu_s']:.2f} s" if case.ok else case.ours["status"]), flush=True)
                (out / "summary.md").write_text(summary(cases, options.label))
    print(summary(cases, options.label))


if __name__ == "__main__":
    main()
