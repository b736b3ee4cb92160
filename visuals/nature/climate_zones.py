#!/usr/bin/python3
"""Writes climate_zones.h: groups of Koeppen-Geiger zones of the land, half a degree apart.

Usage: climate_zones.py climatezones.rda > climate_zones.h
The input is data/climatezones.rda of the R package kgc 1.0.0.2 (BSD 2-clause), whose authors include the map's.
"""
import lzma
import struct
import sys

import numpy as np

COLUMNS, ROWS = 720, 360
HEADER = '''// Written by climate_zones.py from data/climatezones.rda of the R package kgc 1.0.0.2, December 2017, whose source is
// http://koeppen-geiger.vu-wien.ac.at/present.htm: M. Kottek, J. Grieser, C. Beck, B. Rudolf, F. Rubel, "World Map of
// the Koeppen-Geiger climate classification updated", Meteorologische Zeitschrift 15, 2006. Licence:
//
// Copyright (c) 2017, Chelsey Bryant, Nicholas R. Wheeler, Franz Rubel, Roger H. French
//
// Redistribution and use in source and binary forms, with or without modification, are permitted provided that the
// following conditions are met:
//
// Redistributions of source code must retain the above copyright notice, this list of conditions and the following
// disclaimer.
//
// Redistributions in binary form must reproduce the above copyright notice, this list of conditions and the following
// disclaimer in the documentation and/or other materials provided with the distribution.
//
// THIS SOFTWARE IS PROVIDED BY THE COPYRIGHT HOLDERS AND CONTRIBUTORS "AS IS" AND ANY EXPRESS OR IMPLIED WARRANTIES,
// INCLUDING, BUT NOT LIMITED TO, THE IMPLIED WARRANTIES OF MERCHANTABILITY AND FITNESS FOR A PARTICULAR PURPOSE ARE
// DISCLAIMED. IN NO EVENT SHALL THE COPYRIGHT HOLDER OR CONTRIBUTORS BE LIABLE FOR ANY DIRECT, INDIRECT, INCIDENTAL,
// SPECIAL, EXEMPLARY, OR CONSEQUENTIAL DAMAGES (INCLUDING, BUT NOT LIMITED TO, PROCUREMENT OF SUBSTITUTE GOODS OR
// SERVICES; LOSS OF USE, DATA, OR PROFITS; OR BUSINESS INTERRUPTION) HOWEVER CAUSED AND ON ANY THEORY OF LIABILITY,
// WHETHER IN CONTRACT, STRICT LIABILITY, OR TORT (INCLUDING NEGLIGENCE OR OTHERWISE) ARISING IN ANY WAY OUT OF THE USE
// OF THIS SOFTWARE, EVEN IF ADVISED OF THE POSSIBILITY OF SUCH DAMAGE.
#pragma once

#include <string_view>

namespace octant::visuals::nature {

/// Half degrees of longitude from west to east, row after row from the south, as runs: a letter, then how many there
/// are if more than one. d = desert (zones BW), s = steppe (BS), h = dry hot summers (Csa, Dsa), w = dry cooler summers
/// (other Cs and Ds), m = moist land, o = none of the map's land.
constexpr std::string_view climate_zone_runs =
'''


def read_data(path):
    """All vectors of an R data file, in its order: numbers as arrays, texts as lists."""
    with open(path, "rb") as file:
        data = lzma.decompress(file.read())
    at = data.index(b"X\n") + 2 + 12  # versions of format and writers
    found = []

    def whole():
        nonlocal at
        at += 4
        return struct.unpack(">i", data[at - 4:at])[0]

    def numbers(kind):
        nonlocal at
        count = whole()
        values = np.frombuffer(data, kind, count, at)
        at += values.nbytes
        found.append(values)

    def item():
        nonlocal at
        flags = whole()
        kind, has_attributes, has_tag = flags & 255, flags & 512, flags & 1024
        if kind in (254, 255):  # nothing; a symbol that came before
            return
        if kind == 1:
            item()
        elif kind == 2:  # pairs up to the end of their list
            if has_attributes:
                item()
            if has_tag:
                item()
            item()
            item()
            return
        elif kind == 9:
            length = whole()
            at += max(length, 0)
            return data[at - max(length, 0):at].decode()
        elif kind in (10, 13):
            numbers(">i4")
        elif kind == 14:
            numbers(">f8")
        elif kind == 16:
            found.append([item() for _ in range(whole())])
        elif kind == 19:
            for _ in range(whole()):
                item()
        else:
            sys.exit(f"{path}: expected a list of numbers and texts, got an object of kind {kind}")
        if has_attributes:
            item()

    item()
    return found


def group_of(zone):
    if zone.startswith("BW"):
        return "d"
    if zone.startswith("BS"):
        return "s"
    if zone[:2] in ("Cs", "Ds"):
        return "h" if zone.endswith("a") else "w"
    return "m"


def main():
    latitude, longitude, zone, names = read_data(sys.argv[1])[:4]
    groups = [["o"] * COLUMNS for _ in range(ROWS)]
    for south, west, number in zip(latitude, longitude, zone):
        groups[round(2 * (south + 89.75))][round(2 * (west + 179.75))] = group_of(names[number - 1].strip())
    runs = []
    for group in (group for row in groups for group in row):
        if runs and runs[-1][0] == group:
            runs[-1][1] += 1
        else:
            runs.append([group, 1])
    text = "".join(group + (str(count) if count > 1 else "") for group, count in runs)
    lines = [f'    "{text[i:i + 112]}"' for i in range(0, len(text), 112)]
    print(HEADER + "\n".join(lines) + ";\n\n} // namespace octant::visuals::nature")


if __name__ == "__main__":
    main()
