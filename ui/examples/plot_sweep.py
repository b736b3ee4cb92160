#!/usr/bin/env python3
"""Flies a sweep and plots the frame times in its frames.csv files.

    plot_sweep.py budgets.toml frame-times.png

Needs octant on PATH, python3-pandas and python3-matplotlib. Flights that are done already are not
flown again, so that the plot can be changed and made anew in no time.
"""
import json
import pathlib
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import pandas as pd


def fly(sweep_file, folder):
    """Flies what is not done; the results as octant tells them."""
    run = subprocess.run(
        ["octant", "sweep", sweep_file, "--out", folder, "--json", "--quiet"],
        stdout=subprocess.PIPE,
        text=True,
        check=False,
    )
    if run.returncode == 2:
        sys.exit("octant sweep failed")
    return json.loads(run.stdout)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sweep_file, picture = sys.argv[1:]
    folder = pathlib.Path(sweep_file).stem
    result = fly(sweep_file, folder)
    print(f"{result['done']} of {result['of']} flights, {result['flown']}")

    runs = pd.read_csv(pathlib.Path(folder) / "sweep.csv")
    figure, (over_time, over_budget) = plt.subplots(1, 2, figsize=(12, 4.5))
    for (path, triangles), repeats in runs[runs.done == 1].groupby(["path", "triangles"]):
        name = repeats.run.iloc[0]
        frames = pd.read_csv(pathlib.Path(folder) / "runs" / name / "frames.csv")
        counted = frames[frames.warm_up == 0]
        over_time.plot(counted.sim_time_s, counted.frame_ms, label=f"{path}, {triangles}", lw=0.8)
    over_time.set(xlabel="simulated time, s", ylabel="frame time, ms")
    over_time.legend(fontsize=7)
    for path, flights in runs[runs.done == 1].groupby("path"):
        medians = flights.groupby("triangles").p50_ms.agg(["median", "min", "max"])
        spread = [medians["median"] - medians["min"], medians["max"] - medians["median"]]
        over_budget.errorbar(medians.index, medians["median"], yerr=spread, label=path, capsize=3)
    over_budget.set(xlabel="triangles of ground", ylabel="P50 of frame time, ms")
    over_budget.legend()
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main()
