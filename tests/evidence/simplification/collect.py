#!/usr/bin/env python3
"""Collects the meshes of meshes.csv as OBJ files into a folder.

collect.py --into FOLDER --peers BUILD [--repositories FOLDER] [--shared ../shared/data] [--only NAME,...]

A row's repository is OWNER/NAME on GitHub, looked for as OWNER+NAME (or OWNER+NAME/repo) in the folder of
repositories and cloned into it when it is missing, or "shared": a path below the folder of shared data.
The column blob is the Git hash of the file, so that everybody measures the same mesh.
Conversion: "mesh" (by assimp, welded by position), "obj" (copied: the file's own precision) or "subdivide N".
BUILD has octant-mesh-to-obj: cmake -S tests/peers -B BUILD && cmake --build BUILD.
"""
import argparse
import csv
import gzip
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).parent


def rows():
    with open(HERE / "meshes.csv", newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def repository_of(folder, name):
    place = folder / name.replace("/", "+")
    for git in (place / ".git", place / "repo/.git", place / "repo", place):
        if (git / "HEAD").exists():
            return git
    subprocess.run(["git", "clone", "-q", "--depth", "1", f"https://github.com/{name}", str(place)], check=True)
    return place / ".git"


def content(row, options):
    if row["repository"] == "shared":
        path = pathlib.Path(options.shared) / row["path"]
        data = path.read_bytes()
        return gzip.decompress(data) if path.suffix == ".gz" else data
    git = ["git", f"--git-dir={repository_of(pathlib.Path(options.repositories), row['repository'])}"]
    name = subprocess.run(git + ["rev-parse", f"HEAD:{row['path']}"], capture_output=True, text=True)
    blob = name.stdout.strip()
    if row["blob"] and not blob.startswith(row["blob"]):
        print(f"{row['name']}: the file has changed since: blob {blob[:10]}, expected {row['blob']}", file=sys.stderr)
    return subprocess.run(git + ["cat-file", "blob", row["blob"] or blob], capture_output=True, check=True).stdout


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--into", required=True)
    parser.add_argument("--peers", required=True)
    parser.add_argument("--repositories", default="repositories")
    parser.add_argument("--shared", default="../shared/data")
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    into = pathlib.Path(options.into)
    into.mkdir(parents=True, exist_ok=True)
    chosen = options.only.split(",") if options.only else None
    missing = 0
    for row in rows():
        out = into / (row["name"] + ".obj")
        if out.exists() or (chosen and row["name"] not in chosen):
            continue
        try:
            data = content(row, options)
            if row["conversion"] == "obj":
                out.write_bytes(data)
                continue
            with tempfile.TemporaryDirectory() as scratch:
                source = pathlib.Path(scratch) / pathlib.Path(row["path"].removesuffix(".gz")).name
                source.write_bytes(data)
                extra = ["--" + word if i == 0 else word for i, word in enumerate(row["conversion"].split())]
                extra = [] if row["conversion"] == "mesh" else extra
                subprocess.run([pathlib.Path(options.peers) / "octant-mesh-to-obj", source, out] + extra,
                               check=True, stdout=subprocess.DEVNULL)
        except (OSError, subprocess.CalledProcessError) as error:
            missing += 1
            print(f"{row['name']}: not collected: {error}", file=sys.stderr)
    sys.exit(1 if missing else 0)


if __name__ == "__main__":
    main()
