#!/usr/bin/env python3
"""Makes small data sets by `octant dataset` and reads them with numpy and code that shares nothing with the program.

check_dataset.py OCTANT FOLDER [NAME...]: runs the checks of these names, else all. Exit code 1 and a line for each fault.
"""
import hashlib
import json
import random
import shutil
import signal
import struct
import subprocess
import sys
import time
import zlib
from pathlib import Path

try:
    import numpy as np
except ImportError:
    print("SKIPPED: python3-numpy is not installed")
    sys.exit(0)

OCTANT = sys.argv[1]
FOLDER = Path(sys.argv[2])
COUNT = 8
CAMERAS = """
[[camera]]
name = "side"
mount = "random"
distance = [25, 60]
aim = 0.8
size = "96x64"
[[camera]]
name = "nose"
mount = "aircraft"
at = [9, 0, 0]
pitch = -15
size = "64x48"
matrix = [50, 52, 31, 24]
"""
ALL = "rgb,depth,class,object,normal,flow,coverage,boxes"
faults = []


def check(is_right, what):
    if not is_right:
        faults.append(what)
        print("FAULT:", what)


def arguments(out, *more, outputs=ALL, form="npz", count=COUNT):
    return [OCTANT, "dataset", "--path", "turn", "--path", "straight", "--aircraft", "f15", "--aircraft", "500md",
            "--terrain", str(FOLDER / "map.tif"), "--cameras", str(FOLDER / "cameras.toml"), "--outputs", outputs,
            "--vary", "sun-elevation=5:60,clouds=0:0.7,palette=temperate|arid", "--count", str(count), "--seed", "3",
            "--triangles", "1000", "--format", form, "--out", str(FOLDER / out), "--quiet", *more]


def run(*words):
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"FAULT: {' '.join(words)}: {done.returncode}: {done.stderr}")
    return done.stdout


def make(out, *more, **kind):
    if not (FOLDER / out / "README.md").exists():
        run(*arguments(out, *more, **kind))
    return FOLDER / out


def tree(folder):
    """The hash of each file by its name."""
    return {str(file.relative_to(folder)): hashlib.sha256(file.read_bytes()).hexdigest()
            for file in sorted(folder.rglob("*")) if file.is_file()}


def read_png(file):
    """A PNG without interlacing, of the filters that its rows name."""
    data = file.read_bytes()
    check(data[:8] == b"\x89PNG\r\n\x1a\n", f"{file} begins as a PNG")
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        check(zlib.crc32(kind + body) == struct.unpack(">I", data[at + 8 + size:at + 12 + size])[0], f"{file}: {kind}")
        if kind == b"IHDR":
            width, height, bits, colour = struct.unpack(">IIBB", body[:10])
        if kind == b"IDAT":
            packed += body
        at += 12 + size
    channels = {0: 1, 2: 3}[colour]
    step = channels * bits // 8
    raw = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + width * step)
    rows = np.zeros((height, width * step), np.uint8)
    for y in range(height):
        before = rows[y - 1].astype(int) if y > 0 else np.zeros(width * step, int)
        row = raw[y, 1:].astype(int)
        kind = raw[y, 0]
        if kind == 1:
            for x in range(step, width * step):
                row[x] = (row[x] + row[x - step]) & 255
        elif kind == 2:
            row = (row + before) & 255
        elif kind in (3, 4):
            for x in range(width * step):
                left = row[x - step] if x >= step else 0
                corner = before[x - step] if x >= step else 0
                if kind == 3:
                    guess = (left + before[x]) // 2
                else:
                    p = left + before[x] - corner
                    guess = min((abs(p - left), 0, left), (abs(p - before[x]), 1, before[x]), (abs(p - corner), 2, corner))[2]
                row[x] = (row[x] + guess) & 255
        rows[y] = row
    values = rows.view(">u2").astype(np.uint16) if bits == 16 else rows
    return values.reshape((height, width, channels) if channels > 1 else (height, width))


def mask_of(counts, height, width):
    """COCO's compressed run lengths as a picture of truth values."""
    runs, at = [], 0
    while at < len(counts):
        value, shift, more = 0, 0, True
        while more:
            letter = ord(counts[at]) - 48
            value |= (letter & 31) << shift
            more = bool(letter & 32)
            shift += 5
            at += 1
            if not more and letter & 16:
                value -= 1 << shift
        if len(runs) > 2:
            value += runs[-2]
        runs.append(value)
    flat = np.concatenate([np.full(run, i % 2 == 1) for i, run in enumerate(runs)])
    check(flat.size == height * width, "runs fill the picture")
    return flat.reshape(width, height).T


def rotation(q):
    w, x, y, z = q / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def npz():
    folder = make("npz")
    seen = 0
    for number in range(2 * COUNT):
        a = np.load(folder / f"npz/{number:06}.npz")
        height, width = (64, 96) if number % 2 == 0 else (48, 64)
        for name, kind, channels in [("rgb", np.uint8, 3), ("depth_m", np.float32, 1), ("class_id", np.uint8, 1),
                                     ("object_id", np.uint32, 1), ("normal", np.float32, 3), ("flow_px", np.float32, 2),
                                     ("coverage", np.float32, 1)]:
            shape = (height, width, channels) if channels > 1 else (height, width)
            check(a[name].dtype == kind and a[name].shape == shape, f"{number}: {name} is {a[name].dtype} {a[name].shape}")
        sky = a["class_id"] == 0
        check(np.array_equal(np.isinf(a["depth_m"]), sky), f"{number}: the sky and only it is infinitely far")
        length = np.linalg.norm(a["normal"], axis=2)
        check(np.allclose(length[~sky], 1, atol=1e-3) and np.all(length[sky] == 0), f"{number}: normals are units")
        check(np.all((a["object_id"] == 0) | (a["class_id"] == 7)), f"{number}: objects are aircraft")
        check(np.all((a["coverage"] >= 0) & (a["coverage"] <= 1)), f"{number}: coverage")
        check(np.isfinite(a["flow_px"]).mean() > 0.5, f"{number}: flow is known")
        sample = json.loads((folder / f"samples/{number // 2:06}.json").read_text())
        picture = sample["pictures"][number % 2]
        check(picture["number"] == number and picture["camera"] == ("side", "nose")[number % 2], f"{number}: camera")
        check(np.allclose(a["eye_m"], picture["eye_m"]), f"{number}: eye")
        to_camera = rotation(a["attitude"]).T
        for i, object_id in enumerate(a["box_object_id"]):
            mask = a["object_id"] == object_id
            left, top, right, bottom = a["box_visible_px"][i]
            check(a["box_measures"][i, 3] == mask.sum(), f"{number}: pixels of object {object_id}")
            if mask.any():
                seen += 1
                rows, columns = np.nonzero(mask)
                box = (columns.min(), rows.min(), columns.max() + 1, rows.max() + 1)
                check(np.allclose((left, top, right, bottom), box), f"{number}: box of object {object_id}")
            body = (a["box_corners_m"][i] - a["eye_m"]) @ to_camera.T  # x ahead, y right, z down
            if body[:, 0].min() > 1:
                k = a["matrix"]
                u = k[0, 0] * body[:, 1] / body[:, 0] + k[0, 2] + 0.5  # from the first pixel's edge, as boxes are
                v = k[1, 1] * body[:, 2] / body[:, 0] + k[1, 2] + 0.5
                whole = np.array([u.min(), v.min(), u.max(), v.max()])
                check(np.abs(whole - a["box_whole_px"][i]).max() < 0.01, f"{number}: whole box of {object_id}: {whole}")
            # A point of the object lies in its box: its depth is that of the box's corners or between.
            if mask.any():
                depth = a["depth_m"][mask]
                check(depth.min() > body[:, 0].min() - 0.5 and depth.max() < body[:, 0].max() + 0.5, f"{number}: depth")
        unboxed = set(np.unique(a["object_id"])) - {0} - set(a["box_object_id"])
        check(not unboxed, f"{number}: objects without a box: {unboxed}")
    check(seen >= COUNT, f"aircraft are seen: {seen}")


def coco():
    folder = make("coco", form="coco")
    arrays = make("npz")
    data = json.loads((folder / "annotations.json").read_text())
    names = {row["id"]: row["name"] for row in data["categories"]}
    check(sorted(names.values()) == ["500md", "f15"], f"categories: {names}")
    images = {row["id"]: row for row in data["images"]}
    check(sorted(images) == list(range(2 * COUNT)), "each picture is there once")
    masks = {number: set() for number in images}
    for number, row in images.items():
        npz_file = np.load(arrays / f"npz/{number:06}.npz")
        check(np.array_equal(read_png(folder / row["file_name"]), npz_file["rgb"]), f"{number}: PNG and npz are alike")
        own = np.load(folder / row["arrays"])
        check(np.array_equal(own["depth_m"], npz_file["depth_m"]), f"{number}: depth is that of the other format")
    for row in data["annotations"]:
        number = row["image_id"]
        height, width = row["segmentation"]["size"]
        check((height, width) == (images[number]["height"], images[number]["width"]), f"{row['id']}: size")
        mask = mask_of(row["segmentation"]["counts"], height, width)
        truth = np.load(arrays / f"npz/{number:06}.npz")["object_id"] == row["object_id"]
        check(np.array_equal(mask, truth), f"annotation {row['id']}: mask")
        check(row["area"] == truth.sum() > 0, f"annotation {row['id']}: area")
        rows, columns = np.nonzero(truth)
        x, y, w, h = row["bbox"]
        check((x, y, x + w, y + h) == (columns.min(), rows.min(), columns.max() + 1, rows.max() + 1), f"{row['id']}: bbox")
        check(names[row["category_id"]] == row["name"], f"{row['id']}: category")
        masks[number].add(row["object_id"])
    for number in images:
        truth = set(np.unique(np.load(arrays / f"npz/{number:06}.npz")["object_id"])) - {0}
        check(masks[number] == truth, f"{number}: annotated {masks[number]}, visible {truth}")
    check([row["id"] for row in data["annotations"]] == list(range(1, len(data["annotations"]) + 1)), "ids count")
    try:
        from pycocotools import mask as tool
    except ImportError:
        return
    for row in data["annotations"]:
        check(tool.area(row["segmentation"]) == row["area"], f"{row['id']}: area by pycocotools")


def kitti():
    folder = make("kitti", form="kitti")
    arrays = make("npz")
    for number in range(2 * COUNT):
        a = np.load(arrays / f"npz/{number:06}.npz")
        coded = {name: read_png(folder / name / f"{number:06}.png")
                 for name in ("image_2", "depth", "semantic", "instance", "flow", "normal", "coverage")}
        check(np.array_equal(coded["image_2"], a["rgb"]), f"{number}: picture")
        near = a["depth_m"] < 255.9
        check(np.abs(coded["depth"][near] / 256 - a["depth_m"][near]).max(initial=0) <= 0.002, f"{number}: depth")
        check(np.all(coded["depth"][a["depth_m"] > 256] == 0), f"{number}: what is too far is unknown")
        check(np.array_equal(coded["semantic"], a["class_id"]), f"{number}: class")
        check(np.array_equal(coded["instance"], a["object_id"]), f"{number}: object")
        known = coded["flow"][..., 2] == 1
        flow = (coded["flow"][..., :2].astype(float) - 32768) / 64
        check(np.abs(flow[known] - a["flow_px"][known]).max(initial=0) <= 0.008, f"{number}: flow")
        in_range = np.isfinite(a["flow_px"]).all(axis=2) & (np.abs(np.nan_to_num(a["flow_px"])).max(axis=2) < 511)
        check(np.all(known[in_range]), f"{number}: known flow is there")
        check(np.abs(coded["normal"] / 32767.5 - 1 - a["normal"]).max() < 3e-5, f"{number}: normal")
        check(np.abs(coded["coverage"] / 65535 - a["coverage"]).max() < 2e-5, f"{number}: coverage")
        p2 = [line for line in (folder / f"calib/{number:06}.txt").read_text().splitlines() if line.startswith("P2: ")]
        matrix = np.array(p2[0].split()[1:], float).reshape(3, 4)
        check(np.allclose(matrix[:, :3], a["matrix"], rtol=1e-10) and not matrix[:, 3].any(), f"{number}: P2")
        lines = (folder / f"label_2/{number:06}.txt").read_text().splitlines()
        boxes = sorted(tuple(np.round(box - (0, 0, 1, 1), 2)) for box, m in zip(a["box_visible_px"], a["box_measures"])
                       if m[3] > 0)
        check(boxes == sorted(tuple(map(float, line.split()[4:8])) for line in lines), f"{number}: boxes of labels")
        for line in lines:
            words = line.split()
            check(words[0] in ("f15", "500md") and len(words) == 15, f"{number}: {line}")
            z = float(words[13])
            distances = [np.linalg.norm(corners.mean(axis=0) - a["eye_m"]) for corners in a["box_corners_m"]]
            check(any(abs(np.linalg.norm(list(map(float, words[11:14]))) - d) < 6 for d in distances), f"{number}: place {z}")


def same_bytes():
    whole = tree(make("npz"))
    check(tree(make("one-thread", "--threads", "1")) == whole, "one thread makes the same bytes")
    for part in (3, 1, 2):
        run(*arguments("parts", "--part", f"{part}/3"))
        check((FOLDER / "parts/README.md").exists() == (part == 2), "the last part ends the set")
    check(tree(FOLDER / "parts") == whole, "three parts make the same bytes")
    run(*arguments("alone", "--only", "5"))
    alone = tree(FOLDER / "alone")
    check({name for name in alone if name.startswith("npz")} == {"npz/000010.npz", "npz/000011.npz"}, "sample 5 alone")
    check(all(whole[name] == alone[name] for name in alone), "a sample alone has the same bytes")
    before = (FOLDER / "npz/npz/000010.npz").stat().st_mtime_ns
    run(*arguments("npz"))
    check((FOLDER / "npz/npz/000010.npz").stat().st_mtime_ns == before, "what is done is not made again")
    run(*arguments("npz", "--only", "5"))
    check((FOLDER / "npz/npz/000010.npz").stat().st_mtime_ns != before, "--only makes it again")
    check(tree(FOLDER / "npz") == whole, "and the bytes are the same")
    larger = make("larger", count=3)
    run(*arguments("larger"))
    check(tree(larger) == whole, "a set that grew is as one made at once")


def killed():
    """Kills a program after some samples or during one, until it comes to the end by itself."""
    whole = tree(make("npz"))
    rng = random.Random(7)
    kills = 0
    for _ in range(200):
        begun = len(list((FOLDER / "killed/samples").glob("*.json")))
        child = subprocess.Popen(arguments("killed"), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        more = rng.randint(0, 2)
        while child.poll() is None and len(list((FOLDER / "killed/samples").glob("*.json"))) < begun + more:
            time.sleep(0.002)
        time.sleep(rng.uniform(0.0, 0.03 if more else 0.3))
        child.send_signal(signal.SIGKILL)
        errors = child.communicate()[1]
        if child.returncode == 0:
            break
        kills += 1
        check(child.returncode == -signal.SIGKILL, f"it goes on, got {child.returncode}: {errors}")
    run(*arguments("killed"))
    check(kills > 2, f"it was killed {kills} times")
    check(tree(FOLDER / "killed") == whole, f"after {kills} kills the bytes are the same")
    child = subprocess.Popen(arguments("stopped"), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while not (FOLDER / "stopped/samples/000000.json").exists() and child.poll() is None:
        time.sleep(0.01)
    child.send_signal(signal.SIGTERM)
    check(child.wait() in (-signal.SIGTERM, 0), "a signal ends it in order")
    check(not list((FOLDER / "stopped").rglob("*.part")), "and leaves nothing half-written")
    run(*arguments("stopped"))
    check(tree(FOLDER / "stopped") == whole, "and it goes on from there")


def refused():
    (FOLDER / "wrong.toml").write_text("[[camera]]\nmount = 'chase'\nfov = 900\n")
    (FOLDER / "file").write_text("no folder")
    wrong = [(["--vary", "sun-hight=1:2"], "--vary: expected a setting of octant fly, got 'sun-hight'"),
             (["--vary", "clouds=1:0"], "--vary: expected clouds from a low end to a high one"),
             (["--vary", "clouds=0:9"], "--vary: clouds: expected"), (["--vary", "view=chase|tower"], "--vary: expected"),
             (["--count", "0"], "--count: expected"), (["--count", "many"], "--count: expected"),
             (["--cameras", str(FOLDER / "wrong.toml")], "wrong.toml:3: fov: expected a number from 1 to 170, got 900"),
             (["--cameras", str(FOLDER / "none.toml")], "none.toml: expected a file"),
             (["--format", "voc"], "--format: expected"), (["--outputs", "rgb,colour"], "--outputs: expected rgb"),
             (["--path", "nowhere.toml"], "nowhere.toml"), (["--terrain", "nowhere.tif"], "nowhere.tif"),
             (["--aircraft", "f16"], "f16"), (["--vary", "aircraft=f15|f16"], "f16"),
             (["--part", "3/2"], "--part: expected K/N"), (["--only", "100"], "--only: expected numbers of samples"),
             (["--only", "1", "--part", "1/2"], "--only: expected no --part"),
             (["--out", str(FOLDER / "file")], "expected a folder, got a file"),
             (["--out", "/proc/none/data"], "/proc"), (["--out", str(FOLDER / "file/data")], "file")]
    for words, expected in wrong:
        out = FOLDER / "refused"
        done = subprocess.run([OCTANT, "dataset", "--terrain", "none", "--size", "32x32", "--quiet"] +
                              ([] if "--out" in words else ["--out", str(out)]) + words, capture_output=True, text=True)
        line = done.stderr
        check(done.returncode == 2 and line.count("\n") == 1 and expected in line, f"{words}: {done.returncode}: {line}")
        check(not out.exists(), f"{words}: nothing is left")
    npz = make("npz")
    done = subprocess.run(arguments("npz", "--vary", "clouds=0:0.5"), capture_output=True, text=True)
    check(done.returncode == 2, "an option given twice is refused")
    done = subprocess.run([w if w != "3" else "4" for w in arguments("npz")], capture_output=True, text=True)
    check(done.returncode == 2 and done.stderr.count("\n") == 1 and "with seed 3, got 4" in done.stderr, done.stderr)
    check((npz / "README.md").exists(), "what is there stays")


CHECKS = {check.__name__: check for check in (npz, coco, kitti, same_bytes, killed, refused)}
shutil.rmtree(FOLDER, ignore_errors=True) # data sets of an earlier program are refused
FOLDER.mkdir(parents=True)
(FOLDER / "cameras.toml").write_text(CAMERAS)
run(OCTANT, "terrain", "make", "--size", "257", "--kind", "hills", "--out", str(FOLDER / "map.tif"), "--quiet")
for name in sys.argv[3:] or CHECKS:
    begin = time.time()
    CHECKS[name]()
    print(f"{name}: {time.time() - begin:.1f} s", flush=True)
print(f"{len(faults)} faults")
sys.exit(1 if faults else 0)
