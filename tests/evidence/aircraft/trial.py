#!/usr/bin/env python3
"""Reads and flies aircraft files of other programs, and makes a table and contact sheets of them.

  trial.py OCTANT LIST OUT [NAME...]

LIST has a line for each aircraft: its name, its file, relative to the folder of LIST, and perhaps what a look at its
pictures said of its direction and more options of octant fly, with tabs between them. For each one OUT gets a row in
results.jsonl and pictures: three views (octant model info --picture: from the left with the nose to the left, from
above, from ahead) and one of a flight. Its painting order is found (octant draw-order) and tried by rays. table.md is
made of results.jsonl, sheet-N.png of the pictures; they are to be looked at, since whether an aircraft flies nose first
is nothing that this script could know. With NAMEs only those are run again. Uses the program's command line alone;
ffmpeg puts pictures together.
"""
import json
import os
import resource
import shutil
import subprocess
import sys
import time

LIMIT_S = 300.0  # wall clock of a loaded machine; a run beyond 30 CPU seconds counts as too long


def run(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.monotonic()
    try:
        done = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=LIMIT_S)
        code, out, err = done.returncode, done.stdout, done.stderr
    except subprocess.TimeoutExpired:
        code, out, err = "beyond 300 s", "", ""
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu_s = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return code, out, err, cpu_s, time.monotonic() - start


def order_of(octant, file):
    code, text, err, cpu_s, _ = run([octant, "draw-order", file, "--rays", "20000", "--json"])
    order = {"code": code, "cpu_s": cpu_s, "errors": err.strip().splitlines()[-1:]}
    if code in (0, 1):
        found = json.loads(text)
        order |= {key: found.get(key) for key in ("drawn_by", "polygons", "polygons_after_splitting", "cells", "parts",
                                                  "proof_is_whole", "proof_open", "rays_that_hit", "rays_wrong")}
    return order


def trial(octant, name, file, options, out):
    row = {"name": name, "file": file}
    picture = f"{out}/{name}-views.png"
    code, text, err, row["info_cpu_s"], _ = run([octant, "model", "info", file, "--json", "--picture", picture])
    row["info_code"], row["info_errors"] = code, err.strip()
    if code == 0:
        info = json.loads(text)
        row |= {key: info.get(key) for key in ("length_m", "span_m", "height_m", "scale", "axes", "axes_are", "faces",
                                                "pictures", "emissive_pictures", "picture_bytes", "edges", "hard_edges", "normals", "glass_panes", "glass_faces",
                                                "turning_parts", "moving_parts", "notes")}
        row["order"] = order_of(octant, file)
    cache, record = f"{out}/cache-{name}", f"{out}/record-{name}"
    shutil.rmtree(cache, ignore_errors=True)
    os.makedirs(cache)
    flight = [octant, "fly", "straight", "--aircraft", file, "--terrain", "none", "--view", "orbit", "--azimuth", "40",
              "--elevation", "18", "--size", "640x400", "--order-cache", cache, "--json"] + options
    for key, frames in (("first", 1), ("second", 1), ("frames", 12)):
        shutil.rmtree(record, ignore_errors=True)
        more = ["--record", record, "--pictures", "1"] if key == "frames" else []
        warm_up = "2" if key == "frames" else "0"
        code, text, err, cpu_s, wall_s = run(flight + ["--frames", str(frames), "--warm-up", warm_up] + more)
        row[key] = {"code": code, "cpu_s": cpu_s, "wall_s": wall_s}
        if key == "frames":
            row["fly_notes"] = err.strip().splitlines()
            if code == 0:
                row["frame_ms"] = json.loads(text)["p50_ms"]
                shutil.copy(f"{record}/picture-00000.png", f"{out}/{name}-flight.png")
    shutil.rmtree(record, ignore_errors=True)
    shutil.rmtree(cache, ignore_errors=True)
    return row


def order_text(row):
    """How the whole model can be painted in order, and what a flight does near it."""
    order = row.get("order") or {}
    if order.get("drawn_by") is None:
        text = f"none: {order.get('code')}"
    else:
        kinds = {"tree": "cells", "parts": "planes", "tree-and-parts": "cells and planes"}
        text = f"{kinds.get(order['drawn_by'], order['drawn_by'])}, {order['polygons_after_splitting']:,} pieces"
        text += f", {order['rays_wrong']} of {order['rays_that_hit']:,} rays wrong" if order["rays_wrong"] else ""
        text += f", {order['proof_open']} pairs open" if order["proof_open"] else ""
    near = "depth" if any("made ready to be refined" in note for note in row["fly_notes"]) else "order"
    return f"{near}; {text}"


def cells_of(row):
    parts = [row.get("turning_parts") or 0, row.get("moving_parts") or 0]
    return [row["name"], f"{row['faces']:,}", f"{row['length_m']:.1f}, {row['span_m']:.1f}",
            (row.get("axes_are") or "").split(":")[0][:40], row.get("direction") or "",
            f"{len(row.get('pictures') or [])}, {(row.get('picture_bytes') or 0) / 2**20:.0f}",
            f"{row['hard_edges']:,} of {row['edges']:,}" + ("" if row["normals"] == "of the file" else " made"),
            f"{row['glass_panes']}" if row["glass_panes"] else "", "{}, {}".format(*parts) if any(parts) else "",
            f"{row['first']['cpu_s']:.1f}, {row['second']['cpu_s']:.1f}",
            f"{row['frame_ms']:.0f}" if "frame_ms" in row else str(row["frames"]["code"]), order_text(row)]


def table(rows):
    lines = ["| aircraft | triangles | length, span, m | axes | direction | pictures, MiB | hard edges | panes | turn, move "
             "| first, second start, CPU s | frame, ms | near; order of all |",
             "|" + "---|" * 12]
    for row in rows:
        if row["info_code"] != 0:
            lines.append(f"| {row['name']} | refused: {row['info_errors'].splitlines()[-1][-160:]} |" + " |" * 10)
        else:
            lines.append("| " + " | ".join(cells_of(row)) + " |")
    return "\n".join(lines) + "\n"


def sheets(rows, out):
    cells = [row["name"] for row in rows if os.path.exists(f"{out}/{row['name']}-views.png")]
    for first in range(0, len(cells), 8):
        part, command, graph = cells[first:first + 8], ["ffmpeg", "-y", "-v", "error"], []
        for i, name in enumerate(part):
            flight = f"{out}/{name}-flight.png"
            command += ["-i", f"{out}/{name}-views.png", "-i", flight if os.path.exists(flight) else f"{out}/{name}-views.png"]
            fit = "scale=600:300:force_original_aspect_ratio=decrease,pad=600:300:(ow-iw)/2:(oh-ih)/2"
            graph += [f"[{2 * i}:v]{fit}[a{i}]", f"[{2 * i + 1}:v]{fit}[b{i}]",
                      f"[a{i}][b{i}]hstack,drawtext=text='{name}':fontsize=20:fontcolor=white:box=1:boxcolor=black:x=4:y=4[c{i}]"]
        graph.append("".join(f"[c{i}]" for i in range(len(part))) + (f"vstack=inputs={len(part)}" if len(part) > 1 else "null"))
        subprocess.run(command + ["-filter_complex", ";".join(graph), "-frames:v", "1", f"{out}/sheet-{first // 8}.png"], check=True)


def main():
    octant, listing, out = sys.argv[1:4]
    wanted = set(sys.argv[4:])
    os.makedirs(out, exist_ok=True)
    results = f"{out}/results.jsonl"
    rows = {}
    if os.path.exists(results):
        with open(results, encoding="utf-8") as file:
            rows = {row["name"]: row for row in map(json.loads, file)}
    with open(listing, encoding="utf-8") as file:
        entries = [line.rstrip("\n").split("\t") for line in file if "\t" in line]
    for name, path, *more in entries:
        if (wanted and name not in wanted) or (not wanted and name in rows):
            continue
        file = os.path.join(os.path.dirname(os.path.abspath(listing)), path)
        rows[name] = trial(octant, name, file, more[1].split() if len(more) > 1 else [], out)
        print(name, rows[name]["info_code"], rows[name]["frames"], rows[name].get("axes_are"), flush=True)
        with open(results, "w", encoding="utf-8") as file:
            file.writelines(json.dumps(rows[one]) + "\n" for one, *_ in entries if one in rows)
    ordered = [rows[name] | {"direction": more[0] if more else ""} for name, _, *more in entries if name in rows]
    with open(f"{out}/table.md", "w", encoding="utf-8") as file:
        file.write(table(ordered))
    sheets(ordered, out)


main()
