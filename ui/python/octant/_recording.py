"""What a flight left behind: the files of a recording as arrays (octant.recording)."""

from __future__ import annotations

import json
import os
import zipfile
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

from ._octant import Error

__all__ = ["Recording"]


def _column(name, words):
    """Whole numbers, else numbers with NaN for what is empty, else text."""
    if not name.endswith("_hash"):
        for kind in (np.int64, np.float64):
            try:
                return np.array([kind(word) if word or kind is np.int64 else np.nan for word in words], kind)
            except ValueError:
                continue
    return np.array(words)


def _table(text, file, is_complete):
    """Columns of CSV text by name. A last line without its end is left out where the flight was killed."""
    lines = text.split("\n")
    unfinished = lines.pop()
    rows, names = [], None
    for number, line in enumerate(lines, 1):
        if line.startswith("#"):
            continue
        words = line.rstrip("\r").split(",")
        if names is None:
            names = words
        elif len(words) != len(names):
            raise Error(f"{file}:{number}: expected {len(names)} columns, got {len(words)}")
        else:
            rows.append(words)
    if names is None or (unfinished and is_complete):
        raise Error(f"{file}:{len(lines) + 1}: expected lines of columns, got no end of a line")
    columns = zip(*rows) if rows else ([] for _ in names)
    return {name: _column(name, words) for name, words in zip(names, columns)}


class Recording:
    """A recording: frames, track, counters (dictionaries of columns, NumPy arrays) and run (what run.json says).

    pandas.DataFrame(recording.frames) is a table; the columns of frames are those of ``frames.csv``.
    """

    path: str
    run: dict[str, Any]

    def __init__(self, path: Union[str, "os.PathLike[str]"]) -> None:
        self.path = os.fspath(path)
        self.run = self._run()
        if self.run.get("format") != "octant recording":
            raise Error(f"{self.path}: expected a recording of octant fly, got another folder or file")
        self._tables: dict[str, dict[str, NDArray[Any]]] = {}

    def _read(self, name):
        try:
            if os.path.isdir(self.path):
                with open(os.path.join(self.path, name), encoding="utf-8", newline="") as file:
                    return file.read()
            with zipfile.ZipFile(self.path) as packed:
                return packed.read(name).decode("utf-8")
        except KeyError:
            raise Error(f"{self.path}: expected {name} in it, got none") from None
        except zipfile.BadZipFile:
            raise Error(f"{self.path}: expected the folder of a recording or a packed one, got another file") from None
        except OSError as fault:
            raise Error(f"{os.path.join(self.path, name)}: {fault.strerror}") from None
        except UnicodeDecodeError:
            raise Error(f"{os.path.join(self.path, name)}: expected UTF-8 text, got other bytes") from None

    def _run(self):
        text = self._read("run.json")
        try:
            run = json.loads(text)
        except json.JSONDecodeError as fault:
            raise Error(f"{os.path.join(self.path, 'run.json')}:{fault.lineno}: {fault.msg}") from None
        return run if isinstance(run, dict) else {}

    def _columns(self, name):
        if name not in self._tables:
            is_complete = self.run.get("summary") is not None
            self._tables[name] = _table(self._read(name), os.path.join(self.path, name), is_complete)
        return self._tables[name]

    @property
    def frames(self) -> dict[str, NDArray[Any]]:
        """The columns of frames.csv, a row for each frame. Times in ms are wall time; hashes are text."""
        return self._columns("frames.csv")

    @property
    def track(self) -> dict[str, NDArray[Any]]:
        """The columns of track.csv: the flight as a path."""
        return self._columns("track.csv")

    @property
    def counters(self) -> dict[str, NDArray[Any]]:
        """The columns of counters.csv: what the kernel counted in each frame."""
        return self._columns("counters.csv")

    def __repr__(self):
        return f"<octant.Recording {self.path}>"
