#!/usr/bin/env python3
"""Makes a data set by Dask workers: each task is a few samples, and a worker that dies costs only those that it was at.

dask_dataset.py FOLDER [OPTION...]: options are those of `octant dataset`; all workers must see the folder.
OCTANT names the program, WORKERS the number of workers (2), SCHEDULER the address of a scheduler in place of own workers.
"""
import os
import subprocess
import sys

try:
    from distributed import Client, LocalCluster, as_completed
except ImportError:
    print("SKIPPED: python3-distributed is not installed")
    sys.exit(0)

OCTANT = os.environ.get("OCTANT", "octant")
TASK_SAMPLES = 10


def make(options, part, parts):
    """Makes a part of the samples; those that are finished are left as they are."""
    words = [OCTANT, "dataset", *options, "--part", f"{part}/{parts}", "--threads", "1", "--quiet"]
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip())


def count_in(options):
    return int(options[options.index("--count") + 1]) if "--count" in options else 100


def main():
    options = ["--out", os.path.abspath(sys.argv[1]), *sys.argv[2:]]
    parts = min(10000, -(-count_in(options) // TASK_SAMPLES))
    address = os.environ.get("SCHEDULER")
    cluster = address or LocalCluster(n_workers=int(os.environ.get("WORKERS", "2")), threads_per_worker=1,
                                      dashboard_address=None)
    with Client(cluster) as client:
        print("workers:", *(worker["pid"] for worker in client.run(lambda: {"pid": os.getpid()}).values()), flush=True)
        tasks = [client.submit(make, options, part, parts, retries=5, pure=False) for part in range(1, parts + 1)]
        for done, task in enumerate(as_completed(tasks), 1):
            task.result()
            print(f"{done} of {parts} tasks", flush=True)
    subprocess.run([OCTANT, "dataset", *options, "--quiet"], check=True)  # ends the data set: annotations, README.md


if __name__ == "__main__":
    main()
