#!/usr/bin/env python3
"""A walk through table 6 of the 1989 paper on painting order, cell by cell.

    paper_table.py [FOLDER [PICTURE.png]]

Runs as a script; editors that know cells (lines with %%) run it step by step, as a notebook. Needs
octant on PATH, python3-pandas and python3-matplotlib. What is flown already is not flown again.
"""
# %% What the walk writes
import json
import pathlib
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import pandas as pd

folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "table-6")
picture = sys.argv[2] if len(sys.argv) > 2 else "table-6.png"

# %% The experiment: four paths, two aircraft, three ways to hide what is hidden
#
# The paper flies an F-15 and a 500MD along four paths over a background of 60 polygons, one frame a
# path sample, and says how many seconds a flight took by its painting order. `octant study` flies
# the same by the order, by a depth buffer and by nothing but the removal of back faces, each frame
# by all three in turn, so that they see the same machine.
if not (folder / "table-6.csv").exists():
    subprocess.run(
        ["octant", "study", "flights", "--out", folder, "--size", "320x240", "--json", "--quiet"],
        stdout=subprocess.DEVNULL,
        check=True,
    )
table = pd.read_csv(folder / "table-6.csv")
print(table[["aircraft", "path", "frames", "paper, s", "ours, s, octant order"]].to_string())

# %% How much faster than in 1989, and is it even over the flights?
#
# The paper's frames take 34 to 37 ms whatever is flown. If ours scale alike, the ratio is the same
# in each row, and what varies between rows is work that the paper's machine did not notice.
table["times as fast"] = table["paper, s"] / table["ours, s, octant order"]
print(table.groupby("aircraft")["times as fast"].describe()[["min", "mean", "max"]].round(1))

# %% The order against the depth buffer
#
# The paper's claim: painting in order is quicker than a depth buffer. Above 1, it holds here too.
against = table.set_index(["aircraft", "path"])["median: depth buffer / octant"]
print(against.unstack().round(2).to_string())

# %% One flight, frame by frame: the cell of the order changes, the frame time does not
#
# frames.csv has a row for each frame. `draw_cell` names the cell of space that the eye is in, for
# which the painting order was worked out beforehand.
flight = folder / "f15-turn"
frames = pd.read_csv(flight / "frames.csv")
with open(flight / "run.json") as file:
    run = json.load(file)
print(f"{run['title']}: {run['summary']['frames']} frames, median {run['summary']['p50_ms']:.2f} ms")

# %% The picture
figure, (over_rows, over_time) = plt.subplots(1, 2, figsize=(12, 4.5))
names = table["aircraft"] + " " + table["path"]
ways = ["octant order", "depth buffer", "back faces only"]
for number, way in enumerate(ways):
    place = [row + 0.26 * (number - 1) for row in range(len(table))]
    over_rows.bar(place, 1000 * table[f"ours, s, {way}"] / table["frames"], 0.25, label=way)
over_rows.set_xticks(range(len(table)), names, rotation=30, ha="right")
over_rows.set(ylabel="mean frame time, ms", title="Table 6, ours")
over_rows.margins(y=0.3)
over_rows.legend(fontsize=8, loc="upper right")
points = over_time.scatter(
    frames.sim_time_s, frames.frame_ms, c=frames.draw_cell, s=6, cmap="turbo"
)
over_time.set(
    xlabel="simulated time, s",
    ylabel="frame time, ms",
    ylim=(0, 2 * frames.frame_ms.quantile(0.99)),
    title=run["title"],
)
figure.colorbar(points, label="cell of the painting order")
figure.tight_layout()
figure.savefig(picture, dpi=110)
print(f"picture: {picture}")
