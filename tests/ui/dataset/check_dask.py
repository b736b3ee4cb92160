#!/usr/bin/env python3
"""Runs the example that makes a data set by Dask workers, kills one of them, and compares with a set made at once.

check_dask.py OCTANT EXAMPLE FOLDER
"""
import hashlib
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

octant, example, folder = sys.argv[1], sys.argv[2], Path(sys.argv[3])
OPTIONS = ["--path", "turn", "--terrain", "none", "--size", "96x64", "--outputs", "rgb", "--vary", "clouds=0:0.7",
           "--count", "200", "--seed", "9", "--format", "npz"]


def tree(path):
    return {str(file.relative_to(path)): hashlib.sha256(file.read_bytes()).hexdigest()
            for file in sorted(path.rglob("*")) if file.is_file()}


shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
child = subprocess.Popen([sys.executable, example, str(folder / "dask"), *OPTIONS], stdout=subprocess.PIPE, text=True,
                         env={**os.environ, "OCTANT": octant, "WORKERS": "2"})
first = child.stdout.readline()
if first.startswith("SKIPPED"):
    print(first, end="")
    sys.exit(0)
workers = [int(number) for number in re.findall(r"\d+", first)]
deadline = time.time() + 60
while not (folder / "dask/samples/000000.json").exists() and child.poll() is None and time.time() < deadline:
    time.sleep(0.005)
made_then = len(list((folder / "dask/samples").glob("*.json")))
os.kill(workers[0], signal.SIGKILL)
output = child.communicate(timeout=600)[0]
print(f"workers {workers}, one killed after {made_then} samples\n{output}", end="")
subprocess.run([octant, "dataset", *OPTIONS, "--out", str(folder / "whole"), "--quiet"], check=True)
faults = []
if child.returncode != 0:
    faults.append(f"the example ended with {child.returncode}")
if len(workers) != 2 or made_then >= 200:
    faults.append("expected two workers, one killed before the end")
if tree(folder / "dask") != tree(folder / "whole"):
    faults.append("the files differ from those of a set made at once")
print(*faults, sep="\n")
sys.exit(1 if faults else 0)
