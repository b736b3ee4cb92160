#!/usr/bin/env python3
"""Recomputes every figure of the pages that pages.sh makes, from their recordings, with no code of Octant's.

  recompute_pages.py FOLDER            prints a table; exit code 1 where a figure is wrong or was not recomputed
  recompute_pages.py --captures FOLDER writes frame times as PresentMon, CapFrameX and MangoHud record them

Needs numpy and scipy. A text with digits that nothing recomputes counts as a fault.
"""
import csv
import html.parser
import json
import math
import re
import sys
from pathlib import Path

import numpy

from recompute_statistics import STAGES, Comparison, Recording, centre_of, holm, nearest_rank, write_captures


# Pages.

class Node:
    def __init__(self, tag, attributes, parent):
        self.tag, self.attributes, self.parent, self.children, self.told = tag, attributes, parent, [], False

    def text(self):
        return "".join(c if isinstance(c, str) else c.text() for c in self.children)

    def all(self, tag, css_class=None):
        found = []
        for child in self.children:
            if isinstance(child, Node):
                if child.tag == tag and (css_class is None or css_class in child.attributes.get("class", "").split()):
                    found.append(child)
                found += child.all(tag, css_class)
        return found


class PageParser(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.root = self.node = Node("", {}, None)
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        made = Node(tag, dict(attributes), self.node)
        self.node.children.append(made)
        if tag not in ("meta", "img", "br", "path", "rect", "use"):
            self.node = made

    def handle_startendtag(self, tag, attributes):
        self.node.children.append(Node(tag, dict(attributes), self.node))

    def handle_endtag(self, tag):
        while self.node.tag != tag and self.node.parent:
            self.node = self.node.parent
        self.node = self.node.parent or self.node

    def handle_data(self, text):
        self.node.children.append(text)


class Number:
    """A figure as the page is to show it: with `decimals`, or `digits` significant ones."""

    def __init__(self, value, decimals=0, signed=False, digits=None):
        self.value, self.decimals, self.signed, self.digits = float(value), decimals, signed, digits

    def is_shown_by(self, text):
        if self.signed != text.startswith(("+", "-")) and not (text.startswith("-") and self.value < 0):
            return False
        shown = float(text)
        if self.digits:
            return abs(shown - self.value) <= 0.5001 * 10 ** (math.floor(math.log10(abs(self.value))) + 1 - self.digits)
        decimals = len(text.split(".")[1]) if "." in text else 0
        return decimals == self.decimals and abs(shown - self.value) <= 0.5 * 10**-self.decimals * (1 + 1e-6) + 1e-9 * abs(self.value)

    def __str__(self):
        return f"{self.value:.8g}"


NUMBER = r"([+-]?\d+(?:\.\d+)?(?:e[+-]?\d+)?)"


class Page:
    def __init__(self, file):
        self.file = file
        self.root = PageParser(file.read_text()).root
        self.figures = self.points = 0
        self.wrong, self.not_told = [], []
        self.main = self.root.all("main")[0]

    def expect(self, node, *pieces):
        """The node's text is these pieces: texts and Numbers."""
        node.told = True
        self.expect_text(node.text().strip(), *pieces)

    def expect_text(self, text, *pieces):
        text = re.sub(r"\s+", " ", text)
        pattern = "".join(NUMBER if isinstance(p, Number) else re.escape(re.sub(r"\s+", " ", p)) for p in pieces)
        found = re.fullmatch(pattern.strip(), text)
        numbers = [p for p in pieces if isinstance(p, Number)]
        self.figures += max(1, len(numbers)) if any(c.isdigit() for c in text) or numbers else 0
        if not found or not all(n.is_shown_by(t) for n, t in zip(numbers, found.groups())):
            self.wrong.append(f"{text!r}: expected {''.join(map(str, pieces))!r}")

    def is_same(self, what, shown, expected):
        self.figures += 1
        if shown != expected:
            self.wrong.append(f"{what}: {shown!r}: expected {expected!r}")

    def card_after(self, heading):
        """The part behind a heading of that beginning; None where there is no such heading."""
        parts = [c for c in self.main.children if isinstance(c, Node)]
        for at, part in enumerate(parts):
            if part.tag == "h2" and part.text().startswith(heading):
                part.told = True
                return parts[at + 1]
        return None

    def rows_of(self, table):
        """Cells of a table: nodes, or texts where the page's script makes the rows."""
        rows = [row.all("td") for row in table.all("tbody")[0].all("tr")]
        scripts = [c for c in table.parent.children if isinstance(c, Node) and c.tag == "script"]
        if scripts:
            listed = [[c if isinstance(c, str) else c[0] for c in row] for row in json.loads(scripts[0].text())["rows"]]
            self.is_same("rows in HTML", [[c.text() for c in row] for row in rows], listed[:len(rows)])
            rows += listed[len(rows):]
        return rows

    def expect_cell(self, cell, *pieces):
        if isinstance(cell, str):
            self.expect_text(cell, *pieces)
        else:
            self.expect(cell, *pieces)

    def expect_table(self, table, header, expected):
        heads = table.all("th")
        self.is_same("heads", [h.text() for h in heads], header)
        for head in heads:
            head.told = True
        rows = self.rows_of(table)
        self.is_same("rows", len(rows), len(expected))
        for row, cells in zip(rows, expected):
            for cell, pieces in zip(row, cells):
                self.expect_cell(cell, *(pieces if isinstance(pieces, (list, tuple)) else [pieces]))

    def expect_points(self, what, shown, expected):
        """Numbers of a plot: five digits each, six for axes."""
        self.points += len(expected)
        close = len(shown) == len(expected) and all(
            (a is None and not math.isfinite(b)) or (a is not None and abs(a - b) <= 0.51e-4 * abs(b) + 1e-12)
            for a, b in zip(shown, expected))
        if not close:
            self.wrong.append(f"plot, {what}: {str(shown)[:80]}: expected {str(list(expected))[:80]}")

    def untold(self):
        """Texts with digits that nothing has recomputed."""
        found = []

        def walk(node, told):
            told = told or node.told or node.tag in ("script", "style", "svg")
            for child in node.children:
                if isinstance(child, Node):
                    walk(child, told)
                elif not told and any(c.isdigit() for c in child):
                    found.append(child.strip())
        walk(self.root.all("body")[0], False)
        return found


def ceiling_ms(recording):
    needed = min(recording.statistics["Longest, ms"][0], 2.5 * recording.statistics["P99, ms"][0])
    return 1.05 * (needed if needed < 4.5 else max(18.0, needed))


LEVEL = [["16.67 ms", 16.67]]
TOP = ["Frames", "P50, ms", "P99, ms", "Longest, ms", "1 % low, frames/s", "Overruns of 16.67 ms"]


def check_values(page, heading, rows):
    card = page.card_after(heading)
    if not rows:
        page.is_same(heading, card, None)
        return
    cells = page.rows_of(card.all("table")[0])
    page.is_same(heading, len(cells), len(rows))
    for (name, value), (left, right) in zip(rows, cells):
        page.expect(left, name)
        page.expect(right, value)


def shown_rows(rows):
    return [(k, v) for k, v in rows if v not in ("null", "")]


def check_one(page, r):
    figures = r.statistics
    for node in page.main.all("header")[0].all("h1") + page.root.all("title"):
        node.told = True  # the title of the flight
        page.is_same("title", node.text().replace(" - Octant", ""), r.title)
    cards = page.main.all("div", "card")
    lead = cards[0].all("p", "lead")[0]
    page.expect(lead, r.title + ", " + (r.format or r.start) + r.machine_text)
    badges = (["ended"] if r.ended and not r.format else []) + (["quiet machine"] if not r.noise and not r.format else []) + r.faults()
    page.is_same("badges", [b.text() for b in cards[0].all("span", "badge")], badges)
    for note in cards[0].all("p", "note"):
        page.expect(note, "".join(n + " " for n in r.noise).strip())
    tiles = [(d.all("dt")[0], d.all("dd")[0]) for d in cards[0].all("div")]
    expected = [(k.split(", ")[0], Number(*figures[k]), k.split(", ")[1] if ", " in k else "frames") for k in TOP]
    expected.append(("Rate", Number(1000 / figures["Mean, ms"][0], 1), "frames/s"))
    target = [] if r.format else r.row["triangle_target"]
    if len(target) and min(target) < max(target):
        expected.append(("Triangle target", Number(numpy.mean(target)), f"mean of {min(target):.0f} to {max(target):.0f}"))
    page.is_same("tiles", len(tiles), len(expected))
    for (name, value), (key, number, unit) in zip(tiles, expected):
        page.expect(name, key)
        page.expect(value, number, " " + unit)
    card = page.card_after("Frame times")
    table = card.all("table")[0]
    page.expect_table(table, ["Figure", "Value", "Definition"], [[k, [Number(*v)]] for k, v in figures.items()])
    for cell in table.all("td", "definition"):
        cell.told = True
    check_slowest(page, r)
    if r.format:
        check_values(page, "Results", r.facts)
    else:
        check_values(page, "Results", [("state hash", r.state_hash), ("picture hash", r.picture_hash),
                                       ("path offset over the ground (x, y, z), m", r.path_offset)] + r.facts)
    check_values(page, "Settings", shown_rows(r.settings))
    check_values(page, "Program and machine", shown_rows(r.machine))
    check_plots_of_one(page, r)
    check_pictures(page, [(p, p.name) for p in pictures_of(r)])


def pictures_of(r):
    return sorted(r.path.glob("picture-*.png"), key=lambda p: int(p.stem[8:])) if r.path.is_dir() else []


def check_pictures(page, pictures):
    card = page.card_after("Pictures") or page.card_after("A picture")
    captions = card.all("figcaption") if card else []
    page.is_same("pictures", [c.text() for c in captions], [name for _, name in pictures])
    for caption in captions:
        caption.told = True


def check_slowest(page, r):
    card = page.card_after("The slowest frames")
    ms = r.frame_ms
    order = sorted(range(len(ms)), key=lambda k: -ms[k])[:12]
    over = ms > 16.67
    pieces = [Number(over.sum()), " of ", Number(len(ms)), " frames took longer than 16.67 ms."]
    longest = None
    if r.stage_ms:
        stages = numpy.array(r.stage_ms)
        longest = numpy.argmax(stages, axis=0)
        for s, name in enumerate(STAGES):
            if (over & (longest == s)).any():
                pieces += [" In ", Number((over & (longest == s)).sum()), f" of them {name} took most."]
        medians = [nearest_rank(numpy.sort(s), 0.5) for s in stages]
    page.expect(card.all("p")[0], *pieces)
    header = ["frame", "at, s", "ms"]
    if r.stage_ms:
        header += ["took most", "ms", "grew most over its median", "triangles", "change"]
    if r.has_counters:
        header += ["page faults", "switches", "stolen, ms"]
    rows = []
    for k in order:
        frame = int(r.row["frame"][k])
        row = [[Number(frame)], [Number(r.time_s[k], 2)], [Number(ms[k], 2)]]
        if r.stage_ms:
            growth = stages[:, k] - medians
            grown = int(numpy.argmax(growth))
            row += [STAGES[longest[k]], [Number(stages[longest[k], k], 2)], [f"{STAGES[grown]} by ", Number(growth[grown], 2), " ms"],
                    [Number(r.row["terrain_triangles"][k])], [Number(r.row["triangle_change"][k], 0, True)]]
        if r.has_counters:
            row += [[Number(v)] for v in r.counters.get(frame, (0, 0, 0))]
        rows.append(row)
    page.expect_table(card.all("table")[0], header, rows)
    if r.has_counters:
        note = card.all("p", "note")[0]
        note.told = note.text().startswith("Switches: how often") and "in the kernel's steps of 10 ms" in note.text()
    captions = card.all("figcaption")
    for caption, k in zip(captions, order):
        frame = int(r.row["frame"][k])
        pieces = ["frame ", Number(frame), ", ", Number(ms[k], 2), " ms"]
        if not (r.path / f"slow-{frame:05}.png").is_file():
            near = min(pictures_of(r), key=lambda p: abs(int(p.stem[8:]) - frame))
            pieces.append(f": nearest picture, {near.name}")
        page.expect(caption, *pieces)


def check_plots_of_one(page, r):
    plots = {box.all("h3")[0].text(): json.loads(box.all("script")[0].text()) for box in page.main.all("div", "plot")}
    warm = r.warm_up
    curve = plots["Frame time"]
    page.expect_points("warm-up", curve["series"][0]["y"], r.all["frame_ms"][warm])
    page.expect_points("frame times", curve["series"][1]["y"], r.frame_ms)
    page.expect_points("simulated times", curve["series"][1]["x"], r.time_s)
    page.expect_points("height", [curve["y1"]], [ceiling_ms(r)])
    page.is_same("levels", curve["levels"], LEVEL)
    page.expect_points("legs", [x for _, x in curve["marks"]], [x for _, x in r.legs])
    page.is_same("names of legs", [n for n, _ in curve["marks"]], [n for n, _ in r.legs])
    bars = plots["Histogram"]
    width = bars["bar"] / 0.9
    top = min(r.statistics["Longest, ms"][0], 1.6 * r.statistics["P99, ms"][0])
    numbers = numpy.minimum(numpy.floor(numpy.minimum(r.frame_ms, top) / width), math.floor(top / width))
    found, counts = numpy.unique(numbers, return_counts=True)
    page.expect_points("bars", bars["series"][0]["y"], counts)
    page.expect_points("places of bars", bars["series"][0]["x"], (found + 0.5) * width)
    if r.format:
        return
    base = numpy.zeros(len(r.frame_ms))
    for s, series in enumerate(plots["Stages, stacked"]["series"]):
        page.expect_points("stages, from", series["l"][::2], base)
        base = base + r.stage_ms[s]
        page.expect_points("stages, to", series["y"][::2], base)
    curves = {"Terrain triangles": "terrain_triangles", "Change of terrain triangles from frame to frame": "triangle_change",
              "Triangle target": "triangle_target", "Stress": "stress"}
    for title, key in curves.items():
        if title in plots:
            page.expect_points(title, plots[title]["series"][0]["y"], r.row[key])
    page.is_same("plots", len(plots), 7 if min(r.row["triangle_target"]) < max(r.row["triangle_target"]) else 5)


# Pages of several flights.

def variants_of(recordings, baseline=None):
    """Flights with their variants: lists of recordings, in the order of the first of each."""
    flights = {}
    for r in recordings:
        flight, drawing = r.differing()
        flights.setdefault(flight, {}).setdefault(drawing, []).append(r)
    compared = []
    for variants in flights.values():
        names = sorted({name for name, _ in set.union(*map(set, variants)) - set.intersection(*map(set, variants))},
                       key=[name for name, _ in next(iter(variants))].index)
        named = []
        for drawing, own in variants.items():
            values = dict(drawing)
            words = [f"{n} {'not set' if values[n] == 'null' else values[n]}" for n in names]
            named.append((", ".join(words) or "all the same", own))
        if baseline:
            named.sort(key=lambda v: all(r.name != baseline for r in v[1]))
        compared.append((next(iter(named))[1][0].title, named))
        if baseline:
            compared[-1] = (next(iter(variants.values()))[0].title, named)
    return compared


MARK = {"slower": "\u25b2", "faster": "\u25bc", "no-change": "=", "unknown": "?"}


def interval_pieces(c):
    sign = -1 if c.share < 0 else 1
    low, high = sorted((sign * c.low, sign * c.high))
    return [" (", Number(low, 1), " to ", Number(high, 1), " %)"]


def place_pieces(c):
    pieces = []
    if c.frames_changed:
        pieces += ["frames ", Number(c.first_frame + c.frames_changed[0]), "-", Number(c.first_frame + c.frames_changed[1])]
    if c.stage:
        pieces += [", " if pieces else "", f"{c.stage[0]} stage ", Number(c.stage[1], signed=True, digits=2), " ms"]
    return pieces


def answer_pieces(changes, limit, within):
    if len(changes) > 1:
        changed = sum(c.changed() for c in changes)
        untold = sum(not c.change or (c.high > limit + within and not (c.changed() and c.low > limit)) for c in changes)
        pieces = [Number(changed), " of ", Number(len(changes)), " variants changed"]
        known = [c.change[0] for c in changes if c.change]
        if known:
            pieces += [", geometric mean ", Number(100 * math.expm1(numpy.mean(known)), 1, True), " %"]
        return pieces + (["; ", Number(untold), " cannot be told"] if untold else [])
    c = changes[0]
    if not c.change:
        return ["cannot tell (", Number(c.share, 1, True), " % by the medians): expected three flights or more of each, got ",
                Number(c.runs[0]), " and ", Number(c.runs[1])]
    pieces = [Number(abs(c.share), 1), " % " + ("faster" if c.share < 0 else "slower")] + interval_pieces(c)
    if c.changed():
        place = place_pieces(c)
        return pieces + (["; "] + place if place else [])
    if c.outcome(limit, within) == "unknown":
        return ["cannot tell: between "] + end_pieces(c.low) + [" and "] + end_pieces(c.high)
    return ["no change found: "] + pieces


def end_pieces(share):
    return [Number(abs(share), 1), " % " + ("faster" if share < 0 else "slower")]


def change_pieces(c, outcome, with_interval):
    pieces = [MARK[outcome] + " ", Number(c.share, 1, True), " %"]
    return pieces + ([" (", Number(c.low, 1, True), " to ", Number(c.high, 1, True), " %)"] if with_interval and c.change else [])


def check_several(page, recordings, compared, changes, limit=0.0, within=2.0, folder=None, matrix_notes=()):
    for node in page.main.all("h1") + page.root.all("title"):
        page.expect(node, Number(len(recordings)), " flights" + (" compared" if changes else "") + (" - Octant" if node.tag == "title" else ""))
    first = page.main.all("div", "card")[0]
    answer = first.all("p", "answer")[0]
    outcomes = [c.outcome(limit, within) for c in changes]
    if not changes:
        page.expect(answer, answer.text()) if answer.text().startswith("Nothing is compared") else page.is_same("answer", answer.text(), "")
    else:
        mark = MARK[outcomes[0]] + " " if len(changes) == 1 else ""
        page.expect(answer, mark, *answer_pieces(changes, limit, within), ".")
        more = first.all("p")[1]
        if len(changes) == 1:
            page.expect(more, more.text().strip()) if more.text().startswith(f"{changes[0].new_name}, compared with {changes[0].old_name}.") else \
                page.is_same("compared", more.text(), changes[0].new_name)
        else:
            counts = [outcomes.count(o) for o in ("slower", "faster", "no-change", "unknown")]
            page.expect(more, "\u25b2 ", Number(counts[0]), " slower, \u25bc ", Number(counts[1]), " faster, = ", Number(counts[2]),
                        " without a change, ? ", Number(counts[3]), " that cannot be told.")
        check_matrix(page, first, compared, changes, outcomes, limit + within)
        check_changes(page, compared, changes, outcomes)
    check_runs(page, recordings)
    check_shared_plots(page, recordings, compared)
    own = [(r, pictures_of(r)) for r in recordings]
    shown = [(p[len(p) // 2], f"{r.name}, {p[len(p) // 2].name}") for r, p in own if p]
    all_shown = len(shown)
    if len(shown) > 24:
        shown = [shown[i * (len(shown) - 1) // 23] for i in range(24)]
    check_pictures(page, shown)
    if all_shown > 24:
        page.expect(page.card_after("A picture").all("p", "note")[0], Number(24), " of ", Number(all_shown), " flights, evenly spaced.")
    for heading, of in (("Settings that all", "settings"), ("Program and machine that all", "machine")):
        common = [row for row in shown_rows(getattr(recordings[0], of)) if all(row in getattr(r, of) for r in recordings)]
        check_values(page, heading, common)


def check_matrix(page, card, compared, changes, outcomes, excluded):
    variants = []
    for _, named in compared:
        variants += [name for name, _ in named if len(named) > 1 and name not in variants]
    cells, flights, at = {}, [], 0
    for flight, named in compared:
        if len(named) < 2:
            continue
        flights.append(flight)
        cells[named[0][0], flight] = [Number(changes[at].old_ms, 3), " ms"]
        for name, _ in named[1:]:
            cells[name, flight] = change_pieces(changes[at], outcomes[at], False)
            at += 1
    page.expect_table(card.all("table")[0], ["variant"] + flights, [[v] + [cells.get((v, f), "") for f in flights] for v in variants])
    note = card.all("p", "note")[-1]
    found = re.search(r"certain at (\S+) % .* slowdown above (\S+) % excluded", note.text())
    page.is_same("note", found and (found[1], float(found[2])), ("5", excluded))
    note.told = True


def check_changes(page, compared, changes, outcomes):
    card = page.card_after("Changes")
    one_baseline = len({c.old_name for c in changes}) == 1
    several = sum(len(named) > 1 or len(named[0][1]) > 1 for _, named in compared) > 1
    header = (["flight"] if several else []) + ["variant", "change", "where"] + ([] if one_baseline else ["baseline"]) + \
        ["runs", "baseline, ms", "ms", "P99 of baseline, ms", "P99, ms"]
    rows = []
    for c, outcome in zip(changes, outcomes):
        where = ["; " if p == ", " else p for p in place_pieces(c)]
        for is_so, words in ((c.pairing == "figures", "by medians"), (not c.same_states, "other states"), (not c.same_pictures, "other pictures")):
            where += [("; " if where else "") + words] if is_so else []
        p99 = [float(numpy.median([r.statistics["P99, ms"][0] for r in side if r.statistics])) for side in (c.old, c.new)]
        row = {"flight": c.flight, "variant": c.new_name, "baseline": c.old_name, "runs": [Number(c.runs[0]), "+", Number(c.runs[1])],
               "baseline, ms": [Number(c.old_ms, 3)], "ms": [Number(c.new_ms, 3)], "change": change_pieces(c, outcome, True),
               "where": where, "P99 of baseline, ms": [Number(p99[0], 3)], "P99, ms": [Number(p99[1], 3)]}
        rows.append([row[h] for h in header])
    page.expect_table(card.all("table")[0], header, rows)
    note = card.all("p", "note")[0]
    for pairing, words in (("rounds", "more than 2.5 standard deviations off, are left out"), ("frames", "with room for drift"),
                           ("figures", "the medians of the flights' frame times are compared")):
        page.is_same(words, words in note.text(), any(c.pairing == pairing for c in changes))
    paused = sum(numpy.sum(r.paused) for c in changes for r in c.old + c.new)
    for count in re.findall(r"count in no figure and no curve: (\d+)", note.text()):
        page.is_same("paused frames", int(count), int(paused))
    for note in card.all("p", "note"):
        note.told = True


def check_runs(page, recordings):
    card = page.card_after("All flights")
    names = []
    for name, _ in recordings[0].settings:
        if len({dict(r.settings).get(name) for r in recordings}) > 1:
            names.append(name)
    header = ["flight"] + names[:6] + TOP + ["states", "pictures", "condition"]
    shown = [h.text() for h in card.all("th")]
    if "pictures" in names and shown.count("pictures") == 1:  # how many pictures are written is no setting of the flight
        names.remove("pictures")
        header = ["flight"] + names[:6] + TOP + ["states", "pictures", "condition"]
    rows = []
    for r in recordings:
        values = dict(r.settings)
        row = [r.name] + ["not set" if values[n] == "null" else values[n] for n in names[:6]]
        row += [[Number(r.statistics[k][0], min(2, r.statistics[k][1]))] for k in TOP]
        rows.append(row + [r.state_hash[:8], r.picture_hash[:8], ", ".join(r.faults()) or r.format or "good"])
    page.expect_table(card.all("table")[0], header, rows)
    note = card.all("p", "note")[-1]
    flown = [dict(r.facts).get("swept") for r in recordings]
    pieces = ["The button in a column's head sorts by it. States and pictures are the first eight digits of their hashes."]
    for how in sorted(set(flown) - {None}):
        pieces += [" ", Number(flown.count(how)), f" flown by a sweep {how}."]
    paused = sum(int(numpy.sum(r.paused)) for r in recordings)
    if paused:
        pieces += [" Frames in which the program was stopped, as in the turns of octant compare, count in no figure and no curve: ",
                   Number(paused), " (column paused of frames.csv)."]
    page.expect(note, *pieces)
    for other in card.all("p", "note")[:-1]:
        if "rows" in other.text():
            page.expect(other, "The first ", Number(100), " of ", Number(len(recordings)), " rows: the page's script makes the others. "
                        "A sweep's sweep.csv and octant report --json have all of them.")


def check_shared_plots(page, recordings, compared):
    curves = json.loads(next(s for s in page.root.all("script") if s.attributes.get("id") == "curves").text())
    page.is_same("curves", [c["n"] for c in curves], [r.name for r in recordings])
    for curve, r in zip(curves, recordings):
        page.expect_points(f"times of {r.name}", curve["x"], r.time_s)
        page.expect_points(f"frame times of {r.name}", curve["y"], r.frame_ms)
    lists = [(box, json.loads(box.all("script")[0].text())) for box in page.main.all("div", "plot-list")]
    shown = [(flight, named) for flight, named in compared if len(named) > 1 or len(named[0][1]) > 1]
    index = {id(r): i for i, r in enumerate(recordings)}
    if shown:
        box, data = lists[0]
        page.is_same("plots of flights", len(data["plots"]), len(shown))
        for plot, (flight, named) in zip(data["plots"], shown):
            each = max(1, 12 // len(named))
            drawn = [r for _, own in named for r in own[:each]][:12]
            runs = sum(len(own) for _, own in named)
            title = flight + (f" ({len(drawn)} of {runs} runs)" if len(drawn) < runs else "")
            page.is_same("plot", plot["title"], title)
            page.is_same("curves of a plot", [s["k"] for s in plot["series"]], [index[id(r)] for r in drawn])
            names = [name for name, own in named for _ in own[:each]][:12] if len(named) > 1 else [None] * len(drawn)
            page.is_same("groups of curves", [s.get("g") for s in plot["series"]], names)
            top = max(ceiling_ms(r) for _, own in named for r in own)
            page.expect_points("height", [plot.get("y1", data["common"]["y1"])], [top])
            legs = named[0][1][0].legs
            page.is_same("legs", [n for n, _ in plot.get("marks", data["common"]["marks"])], [n for n, _ in legs])
        for caption in box.parent.all("figcaption"):
            caption.told = True
            page.is_same("caption", caption.text() in [p["title"] for p in data["plots"]], True)
    page.card_after("Frame time of each flight")
    small = lists[-1][1]
    page.is_same("small plots", [p["series"][0]["k"] for p in small["plots"]], list(range(len(recordings))))
    page.expect_points("common axes", [small["common"][k] for k in ("x0", "x1", "y1")],
                       [0.0, max(r.all["sim_time_s"][-1] for r in recordings), max(map(ceiling_ms, recordings))])
    for note in page.main.all("p", "print-only"):
        page.expect(note, "The first ", Number(60), " of ", Number(len(recordings)), " plots are printed.")


def changes_of(compared, alternate=False):
    changes = [Comparison(flight, named[0][0], name, named[0][1], own, alternate)
               for flight, named in compared for name, own in named[1:]]
    known = [c for c in changes if c.change]
    by_student = lambda change: len(change) > 4 and change[4] * len(known) > 0.05
    for c, p in zip(known, holm([c.change[5 if by_student(c.change) else 3] for c in known])):
        c.adjusted = p
    return changes


def check_compare_files(page, folder, changes):
    """compare.csv and compare.json beside the page."""
    with open(folder / "compare.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    data = json.loads((folder / "compare.json").read_text())
    page.is_same("rows of compare.csv", len(rows), len(changes))
    for row, flight, c in zip(rows, data["flights"], changes):
        expected = {"old_runs": Number(c.runs[0]), "new_runs": Number(c.runs[1]), "frames": Number(c.frames),
                    "old_ms": Number(c.old_ms, 3), "new_ms": Number(c.new_ms, 3), "change_percent": Number(c.share, 2),
                    "low_percent": Number(c.low, 2), "high_percent": Number(c.high, 2), "p": Number(c.change[3], 4),
                    "adjusted_p": Number(c.adjusted, 4), "mann_whitney_p": Number(c.u, 4), "changed": Number(c.changed()),
                    "stage_change_ms": Number(c.stage[1], 3) if c.stage else None,
                    "first_frame": Number(c.first_frame + c.frames_changed[0]) if c.frames_changed else None,
                    "last_frame": Number(c.first_frame + c.frames_changed[1]) if c.frames_changed else None,
                    "frames_change_ms": Number(c.frames_changed[2], 3) if c.frames_changed else None,
                    "same_states": Number(c.same_states), "same_pictures": Number(c.same_pictures)}
        for key, number in expected.items():
            page.expect_text(row[key], number if number else "")
            value = flight[key]
            close = value is None if number is None else abs(float(value) - number.value) <= 1e-7 * max(1, abs(number.value))
            page.is_same(f"compare.json, {key}", value if not close else None, None)
        page.is_same("stage", row["stage"], c.stage[0] if c.stage else "")
        page.is_same("pairing", row["pairing"], c.pairing)
    return data


def check_paper(page, folder, recordings):
    """The table of --paper: csv against the recordings, Markdown and LaTeX against csv."""
    cells = {}
    for r in recordings:
        values = dict(r.settings)
        cells.setdefault((values["path"], values["aircraft"], values["order-method"]), []).append(r)
    with open(folder / "table.csv", newline="") as file:
        rows = list(csv.reader(file))
    order = sorted(cells, key=lambda c: [list(cells).index(k) for k in cells if k[:2] == c[:2]][0])
    page.is_same("rows of the table", len(rows) - 1, len(cells))
    for row, key in zip(rows[1:], order):
        own = [r.statistics for r in cells[key]]
        shown = dict(zip(rows[0], row))
        frames = min(s["Frames"][0] for s in own)
        median = lambda name: float(numpy.median([s[name][0] for s in own]))
        change = centre_of(numpy.log([s["P50, ms"][0] for s in own])) if len(own) >= 3 else None
        page.is_same("cell", (shown["path"], shown["aircraft"], shown["order-method"]), key)
        expected = {"repeats": Number(len(own)), "frames": Number(frames), "median, ms": Number(median("P50, ms"), 3),
                    "95 % from, ms": Number(min(math.exp(change[1]), median("P50, ms")), 3),
                    "95 % to, ms": Number(max(math.exp(change[2]), median("P50, ms")), 3), "mean, ms": Number(median("mean".title() + ", ms"), 3)}
        for name, least, decimals in (("P95, ms", 20, 3), ("P99, ms", 100, 3), ("P99.9, ms", 1000, 3), ("1 % low, frames/s", 100, 2)):
            if frames >= least:
                expected[name] = Number(median(name), decimals)
        page.is_same("columns", set(rows[0]), {"path", "aircraft", "order-method"} | set(expected))
        for name, number in expected.items():
            page.expect_text(shown[name], number)
    number = r"\d+\.\d+|\d+"
    lines = [re.findall(number, " ".join(row)) for row in rows[1:]]
    markdown = [line for line in (folder / "table.md").read_text().split("\n") if line.startswith("| ")][2:]
    latex = (folder / "table.tex").read_text().split("\\midrule\n")[1].split("\\bottomrule")[0].split("\n")[:-1]
    for what, table in (("Markdown", [line.replace("|", " ") for line in markdown]),
                        ("LaTeX", [line.replace("&", " ") for line in latex])):
        page.is_same(what, [re.findall(number, line) for line in table], lines)


def flown(folder):
    """Recordings of a sweep that are done, in the order of its file."""
    with open(folder / "sweep.csv", newline="") as file:
        return [Recording(folder / "runs" / row["run"]) for row in csv.DictReader(file) if row["done"] == "1"]


def check_not_done(page, folder):
    with open(folder / "sweep.csv", newline="") as file:
        states = [row["state"] for row in csv.DictReader(file)]
    for title in page.main.all("h3"):
        if title.text() == "Flights that are not done":
            rows = page.rows_of(title.parent.all("table")[0])
            for row in rows[:-1]:
                row[0].told = True
                found = re.fullmatch(r"ended by SIG\w+(?: after (\d+) of (\d+) frames)?", row[1].text())
                row[1].told = found is not None
                if found and found[1]:
                    r = Recording(folder / "runs" / row[0].text())
                    page.is_same("frames of a stopped flight", [found[1], found[2]], [str(r.frames), dict(r.settings)["frames"]])
            page.is_same("stopped and failed", len(rows) - 1, len([s for s in states if s in ("failed", "stopped")]))
            page.expect(rows[-1][0], Number(states.count("not begun")), " flights")


def check_pages(root):
    pages = []

    def page_of(name):
        pages.append((name, Page(root / name)))
        return pages[-1][1]

    def several(name, recordings, baseline=None):
        page = page_of(name)
        compared = variants_of(recordings, baseline)
        check_several(page, recordings, compared, changes_of(compared))
        return page

    def flown_comparison(name, flight, sides):
        page = page_of(f"{name}/result/compare.html")
        folder = root / name / "result" / flight
        count = len(list(folder.glob("old-r*")))
        old, new = [[Recording(folder / f"{side}-r{i}") for i in range(1, count + 1)] for side in ("old", "new")]
        compared = [(flight, [(sides[0], old), (sides[1], new)])]
        changes = changes_of(compared, True)
        check_several(page, [r for pair in zip(old, new) for r in pair], compared, changes)
        check_compare_files(page, root / name / "result", changes)
        for table in page.main.all("table"):
            if [h.text() for h in table.all("th")] == ["flight", "old", "new"]:
                middle = changes[0].first_frame + sum(changes[0].frames_changed[:2]) // 2
                for cell in page.rows_of(table)[0][1:]:
                    page.expect(cell, f"picture-{middle:05}.png")
        return page

    check_one(page_of("one/flight/report.html"), Recording(root / "one/flight"))
    several("repeats/report.html", [Recording(p) for p in sorted((root / "repeats").glob("r?"))])
    several("settings/report.html", [Recording(root / f"settings/{s}-{i}") for s in ("exact", "depth") for i in (1, 2, 3)])
    flown_comparison("files", "flight", ("files/few.json", "files/many.json"))
    given = json.loads((root / "delayed/result/compare.json").read_text())
    flown_comparison("delayed", "few", (given["old"]["given"], given["new"]["given"]))
    several("matrix/report.html", flown(root / "matrix"))
    paper = flown(root / "paper")
    check_paper(several("paper/report.html", paper), root / "paper/paper", paper)
    turn = sorted((root / "matrix/runs").glob("*turn*"))
    several("baseline/report.html", [Recording(p) for p in turn], turn[-1].name)
    check_not_done(several("stopped/report.html", flown(root / "stopped")), root / "stopped")
    short = flown(root / "short")
    check_paper(several("short/report.html", short), root / "short/paper", short)
    captures = root / "captures"
    check_one(page_of("captures/one.html"), Recording(captures / "presentmon-1.csv"))
    several("captures/report.html", [Recording(captures / n) for n in
            [f"presentmon-{i}.csv" for i in (1, 2, 3)] + ["capframex-a1.csv", "capframex-a2.csv", "capframex-b1.csv", "capframex-b2.csv",
                                                          "capframex-a3.json", "capframex-b3.json", "mangohud-1.csv"]])
    old, new = [[Recording(p) for p in sorted((captures / side).glob("*.csv"))] for side in ("old", "new")]
    page = page_of("captures/result/compare.html")
    for r in old + new:
        r.application = ""
    compared = [("old-1.csv", [("captures/old", old), ("captures/new", new)])]
    changes = changes_of(compared)
    check_several(page, old + new, compared, changes)
    check_compare_files(page, captures / "result", changes)
    several("many/report.html", [Recording(p) for p in sorted((root / "many").glob("r*"), key=lambda p: str(p)) if p.is_dir()])
    print("| page | figures | of these wrong | points of plots | not recomputed |\n|---|---|---|---|---|")
    bad = 0
    for name, page in pages:
        rest = page.untold()
        bad += len(page.wrong) + len(rest)
        print(f"| {name} | {page.figures} | {len(page.wrong)} | {page.points} | {len(rest)} |")
    print(f"| all | {sum(p.figures for _, p in pages)} | {sum(len(p.wrong) for _, p in pages)} | {sum(p.points for _, p in pages)} | |")
    for name, page in pages:
        for line in page.wrong[:40]:
            print(f"{name}: wrong: {line}")
        for line in page.untold()[:20]:
            print(f"{name}: not recomputed: {line}")
    return bad


if __name__ == "__main__":
    if sys.argv[1] == "--captures":
        write_captures(Path(sys.argv[2]))
    else:
        sys.exit(1 if check_pages(Path(sys.argv[1])) else 0)
