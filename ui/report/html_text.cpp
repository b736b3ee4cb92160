#include "ui/report/html_text.h"

#include "sim/base/output_file.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fmt/format.h>

namespace octant::ui::report {

namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";

void append_escaped(std::string& out, char c) {
    constexpr std::string_view special = "&<>\"'";
    constexpr std::array names{"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
    const auto byte = static_cast<unsigned char>(c);
    if (const std::size_t at = special.find(c); at != std::string_view::npos) {
        out += names[at];
    } else if ((byte >= 0x20 && byte != 0x7F) || c == '\n' || c == '\t') {
        out += c;
    }
}

} // namespace

std::string escaped(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        if (length == 1) {
            append_escaped(out, text.front());
        } else {
            out += length == 0 ? replacement : text.substr(0, length);
        }
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return out;
}

std::string script_string(std::string_view text) {
    std::string json = "\"";
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        const auto byte = static_cast<unsigned char>(text.front());
        if (length > 1) {
            json += text.substr(0, length);
        } else if (length == 0) {
            json += replacement;
        } else if (byte < 0x20 || byte == 0x7F || std::string_view("\"\\<&").find(text.front()) != std::string::npos) {
            json += fmt::format("\\u{:04x}", byte);
        } else {
            json += text.front();
        }
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return json + "\"";
}

std::string url_text(std::string_view path) {
    constexpr std::string_view plain = "-._~/";
    std::string text;
    for (const char letter : path) {
        const bool stays = (letter >= '0' && letter <= '9') || (letter >= 'a' && letter <= 'z') ||
                           (letter >= 'A' && letter <= 'Z') || plain.find(letter) != std::string_view::npos;
        text += stays ? std::string(1, letter) : fmt::format("%{:02X}", static_cast<unsigned char>(letter));
    }
    return text;
}

std::string heading_html(std::string_view text) { return fmt::format("<h2>{}</h2>\n", escaped(text)); }

std::string note_html(std::string_view text) { return fmt::format("<p class=\"note\">{}</p>\n", escaped(text)); }

std::string card_html(std::string_view html) { return fmt::format("<div class=\"card\">\n{}</div>\n", html); }

namespace {

constexpr std::string_view style_sheet = R"css(
:root {
  color-scheme: light dark;
  --page: #f6f7f9; --card: #ffffff; --ink: #1b2430; --soft: #5d6b7c; --line: #dde3ea;
  --accent: #2563eb; --bad: #b91c1c; --bad-back: #fdecec; --good: #15803d; --good-back: #e8f6ed;
}
@media (prefers-color-scheme: dark) {
  :root {
    --page: #12161c; --card: #1a2029; --ink: #e4e9f0; --soft: #98a5b5; --line: #2e3743;
    --accent: #7ab0ff; --bad: #ff9b9b; --bad-back: #40201f; --good: #86e0a5; --good-back: #173324;
  }
}
* { box-sizing: border-box; }
body {
  margin: 0; padding: 2rem clamp(1rem, 3vw, 3rem) 4rem; background: var(--page); color: var(--ink);
  font: 15px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif;
}
main { max-width: 1180px; margin: 0 auto; }
main.wide { max-width: 1800px; }
h1 { font-size: 1.75rem; line-height: 1.2; margin: 0 0 .25rem; overflow-wrap: anywhere; }
h2 { font-size: 1.15rem; margin: 2.2rem 0 .7rem; }
h3 { font-size: 1rem; margin: 0 0 .5rem; overflow-wrap: anywhere; }
.lead, .note, figcaption { color: var(--soft); }
.lead { margin: 0; }
.answer { font-size: 1.3rem; font-weight: 650; line-height: 1.35; margin: 0 0 .6rem; overflow-wrap: anywhere; }
:focus-visible { outline: 3px solid var(--accent); outline-offset: 2px; }
.note { font-size: .87rem; margin: .5rem 0 0; }
.card {
  background: var(--card); border: 1px solid var(--line); border-radius: 10px; padding: 1rem 1.1rem;
  min-width: 0; margin-bottom: 1rem;
}
header { margin-bottom: 1rem; }
.badge {
  display: inline-block; border-radius: 99px; padding: .1rem .7rem; margin: .5rem .4rem 0 0;
  font-size: .83rem; font-weight: 600; color: var(--good); background: var(--good-back);
}
.badge.bad { color: var(--bad); background: var(--bad-back); }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(118px, 1fr)); gap: .7rem; margin: 1rem 0 0; }
.tiles dt { color: var(--soft); font-size: .8rem; }
.tiles dd { margin: 0; font-size: 1.35rem; font-weight: 650; font-variant-numeric: tabular-nums; }
.tiles small { font-size: .8rem; font-weight: 400; color: var(--soft); }
.plots { display: grid; gap: 1rem; grid-template-columns: repeat(2, minmax(0, 1fr)); }
.plots .card { margin: 0; }
.plots .card:first-child { grid-column: 1 / -1; }
.small-plots { display: grid; gap: 1rem 1.4rem; grid-template-columns: repeat(auto-fill, minmax(250px, 1fr)); }
.plot { min-width: 0; position: relative; }
.plot h3 { font-size: .9rem; margin: 0 0 .2rem; }
.plot svg { display: block; max-width: 100%; cursor: crosshair; touch-action: pan-y; }
.plot text { font: 12px system-ui, "DejaVu Sans", sans-serif; fill: var(--ink); font-variant-numeric: tabular-nums; }
.plot text.soft { fill: var(--soft); paint-order: stroke; stroke: var(--card); stroke-width: 4px; stroke-linejoin: round; }
.plot .gridline { stroke: var(--line); }
.plot .axis { stroke: var(--soft); }
.plot .level { stroke: var(--bad); stroke-dasharray: 5 4; }
.plot .mark { stroke: var(--soft); stroke-dasharray: 2 3; }
.plot .cross { stroke: var(--ink); opacity: .5; }
.plot .band { fill: var(--accent); opacity: .18; }
.key { display: flex; flex-wrap: wrap; gap: .1rem 1rem; font-size: .8rem; color: var(--soft); margin-bottom: .2rem; }
.key span { overflow-wrap: anywhere; }
.key i { display: inline-block; width: .8rem; height: .8rem; border-radius: 2px; margin-right: .35rem; vertical-align: -.1rem; }
#tip {
  position: absolute; z-index: 2; white-space: pre; pointer-events: none; padding: .35rem .6rem; border-radius: 6px;
  font-size: .8rem; background: var(--ink); color: var(--card);
}
.scroll { /* a shadow at its right edge while there is more to scroll to */
  overflow-x: auto;
  background: linear-gradient(to left, var(--card) 40%, transparent) right / 2rem 100% no-repeat local,
    linear-gradient(to left, var(--soft), transparent) right / .6rem 100% no-repeat;
}
.scroll.tall { max-height: 85vh; overflow: auto; }
table { border-collapse: separate; border-spacing: 0; width: 100%; font-size: .9rem; }
th, td { text-align: left; padding: .32rem .8rem .32rem 0; border-bottom: 1px solid var(--line); vertical-align: baseline; }
td { overflow-wrap: anywhere; }
th { color: var(--soft); font-weight: 600; }
tbody tr:last-child td { border-bottom: 0; }
td:not(.number) { min-width: 6rem; }
td:first-child:not(.number) { min-width: 9rem; width: 22%; }
td.definition { min-width: 14rem; }
.number { text-align: right; padding-right: 1.2rem; font-variant-numeric: tabular-nums; white-space: nowrap; }
th.number { white-space: normal; }
td.slower, td.faster, td.no-change, td.unknown { white-space: nowrap; font-variant-numeric: tabular-nums; }
table.sortable th, table.sortable th:first-child, table.sortable td:first-child { background: var(--card); position: sticky; }
table.sortable th { top: 0; z-index: 1; }
table.sortable th:first-child, table.sortable td:first-child { left: 0; }
table.sortable th:first-child { z-index: 2; }
th button { font: inherit; color: inherit; text-align: inherit; background: none; border: 0; padding: 0; cursor: pointer; }
th[aria-sort=ascending] button::after { content: " \2191"; }
th[aria-sort=descending] button::after { content: " \2193"; }
.filter { display: flex; flex-wrap: wrap; gap: .2rem .8rem; align-items: center; margin-bottom: .5rem; font-size: .87rem; }
.filter input {
  font: inherit; color: inherit; background: var(--page); border: 1px solid var(--soft); border-radius: 6px;
  padding: .2rem .5rem; width: 16rem; max-width: 100%;
}
table.runs { width: auto; font-size: .85rem; }
table.runs td, table.runs td:not(.number) { white-space: nowrap; min-width: 0; }
table.runs td:first-child:not(.number) { width: auto; min-width: 10rem; white-space: normal; }
.card h3 { margin-top: .6rem; }
.card > h3:first-child, .small-plots h3 { margin-top: 0; }
a { color: var(--accent); }
td.soft, .no-change, .unknown { color: var(--soft); }
.faster { color: var(--good); }
.slower, .worse { color: var(--bad); }
.slower, .faster { font-weight: 650; }
td.definition { color: var(--soft); }
.code { font: .86em ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace; overflow-wrap: anywhere; }
.sheet { display: grid; gap: .8rem; grid-template-columns: repeat(auto-fill, minmax(240px, 1fr)); }
figure { margin: 0; }
figure img, figure svg { display: block; width: 100%; height: auto; border-radius: 6px; border: 1px solid var(--line); }
figcaption { font-size: .8rem; padding-top: .2rem; overflow-wrap: anywhere; }
.note + .sheet, .sheet.pairs { margin-top: .8rem; }
.sheet.pairs { grid-template-columns: repeat(2, minmax(0, 1fr)); }
.missing { border: 1px dashed var(--line); border-radius: 6px; padding: 1rem; }
.print-only { display: none; }
@media (max-width: 800px) {
  .plots { grid-template-columns: minmax(0, 1fr); }
  .card { padding: .8rem; }
  td:first-child:not(.number) { min-width: 6.5rem; }
  td.definition { min-width: 9.5rem; }
  td.slower, td.faster, td.no-change, td.unknown { white-space: normal; }
  table.sortable td:first-child:not(.number) { min-width: 9rem; max-width: 12rem; }
}
@media print {
  :root {
    color-scheme: light; --page: #fff; --card: #fff; --ink: #000; --soft: #444; --line: #bbb; --accent: #1d4ed8;
    --bad: #b91c1c; --bad-back: #fff; --good: #15803d; --good-back: #fff;
  }
  @page { size: A4; margin: 12mm; }
  @page wide { size: A4 landscape; margin: 10mm; }
  main.wide { page: wide; }
  main, main.wide { max-width: none; }
  body { padding: 0; font-size: 10pt; }
  .card { border: 0; padding: 0; }
  .card, .scroll, .scroll.tall, .plots { overflow: visible; max-height: none; }
  .scroll { background: none; }
  .key i { print-color-adjust: exact; -webkit-print-color-adjust: exact; } /* printed without backgrounds, too */
  .plot, figure, tr, h3 { break-inside: avoid; }
  h2, h3, .answer { break-after: avoid; }
  thead { display: table-header-group; break-inside: avoid; }
  table { font-size: 8pt; }
  table.runs { font-size: 7pt; width: 100%; }
  th, td, .number, table.runs td, table.runs td:not(.number), td[class] { white-space: normal; padding-right: 1.5mm; }
  td, td:not(.number), td:first-child:not(.number), td.definition, table.sortable td:first-child:not(.number) { min-width: 0; max-width: none; overflow-wrap: anywhere; }
  td.number { white-space: nowrap; overflow-wrap: normal; }
  th button { display: contents; } /* heads with buttons are not repeated on each sheet */
  table.runs td:not(.number) { min-width: 12mm; }
  table.runs td:first-child:not(.number) { min-width: 22mm; }
  table.sortable th, table.sortable th:first-child, table.sortable td:first-child { position: static; }
  .plots { display: block; }
  .wide .plots { display: grid; grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 3mm; }
  .plots .card { margin-bottom: 4mm; }
  .plot svg { width: 100%; height: auto; }
  .small-plots { grid-template-columns: repeat(4, minmax(0, 1fr)); gap: 3mm; }
  .sheet, .sheet.pairs { grid-template-columns: repeat(4, minmax(0, 1fr)); }
  .filter, .tall tbody tr:nth-child(n+501), .tall .plot:nth-of-type(n+61) { display: none; }
  .print-only { display: block; }
}
)css";

/// Draws a page's plots when they come into view, with values under the pointer and zoom by dragging; sorts and filters
/// its tables; makes the rows of long tables and the plots of long lists while the reader scrolls. Refers to nothing
/// outside the page.
constexpr std::string_view drawing_script = R"js(
"use strict";
const NS = "http://www.w3.org/2000/svg";
function node(name, attributes, parent, text) {
  const made = document.createElementNS(NS, name);
  for (const key in attributes) made.setAttribute(key, attributes[key]);
  if (text !== undefined) made.textContent = text;
  if (parent) parent.appendChild(made);
  return made;
}
function steps(from, to, most) {
  const raw = (to - from) / Math.max(1, most);
  const power = Math.pow(10, Math.floor(Math.log10(raw)));
  const step = [1, 2, 5, 10].map(f => f * power).find(f => f >= raw * 0.999);
  const found = [];
  for (let v = Math.ceil(from / step - 1e-9) * step; v <= to + step * 1e-9; v += step) found.push(v);
  if (found.length < 2 && most < 16) return steps(from, to, most * 2); // one number tells no scale
  return found.map(v => Number(v.toPrecision(10)));
}
function powers(from, to) {
  const found = [];
  for (let p = Math.floor(Math.log10(from)); p <= Math.log10(to); ++p)
    for (const f of to / from < 300 ? [1, 2, 5] : [1]) {
      const v = f * Math.pow(10, p);
      if (v >= from * 0.999 && v <= to * 1.001) found.push(v);
    }
  return found;
}
function shown(v) {
  const size = Math.abs(v);
  if (size > 0 && size < 0.001) return v.toExponential().replace(/(\.\d)\d+/, "$1");
  if (size >= 10000) return (v / 1000).toLocaleString("en", {maximumFractionDigits: 1}) + "k";
  return v.toLocaleString("en", {maximumFractionDigits: size >= 100 ? 0 : size >= 1 ? 2 : 4});
}
function ends(plot, key, low) {
  let least = Infinity, most = -Infinity;
  for (const s of plot.series)
    for (const list of [s[key], low ? s.l : undefined]) {
      if (!list) continue;
      for (const v of list) if (v !== null) { least = Math.min(least, v); most = Math.max(most, v); }
    }
  if (least > most) return [0, 1];
  return least === most ? [least - 0.5, most + 0.5] : [least, most];
}
function described(plot, xs, ys) {
  const range = ([from, to]) => `${shown(from)} to ${shown(to)}`;
  const axis = (name, ends, log) => `${name || "no unit"}${log ? ", logarithmic" : ""}, ${range(ends)}`;
  return `Upwards: ${axis(plot.y, ys, plot.log)}. To the right: ${axis(plot.x, xs, plot.xlog)}. ` +
    plot.series.filter(s => s.x.length).map(s => `${s.n || "Values"}: ${range(ends({series: [s]}, "y", false))}.`).join(" ");
}
let paper = Infinity; // width of a plot that is printed, so that its text can be read
function draw(box) {
  const plot = box.plot, small = box.classList.contains("small");
  const width = Math.max(160, Math.min(paper, box.clientWidth)), height = Number(box.dataset.height);
  const left = small ? 42 : 66, right = 12, top = plot.marks.length ? 30 : 10, bottom = small ? 22 : 40;
  box.querySelectorAll("svg").forEach(old => old.remove());
  const id = "c" + (draw.count = (draw.count || 0) + 1);
  const svg = node("svg", {width, height, viewBox: `0 0 ${width} ${height}`, role: "img",
    "aria-label": box.querySelector("h3").textContent, "aria-describedby": id + "d"}, box);
  const [xa, xb] = ends(plot, "x", false), [ya, yb] = ends(plot, "y", true);
  const half = plot.series.some(s => s.s === "bars") ? plot.bar / 2 : 0;
  const x0 = box.zoom ? box.zoom[0] : plot.x0 ?? (plot.xlog ? xa / 1.1 : xa - half);
  const x1 = box.zoom ? box.zoom[1] : plot.x1 ?? (plot.xlog ? xb * 1.1 : xb + half);
  const y0 = plot.y0 ?? (plot.log ? ya / 1.2 : ya - 0.05 * (yb - ya));
  const y1 = plot.log ? Math.max(plot.y1 ?? yb * 1.2, 5 * y0) : plot.y1 ?? yb + 0.05 * (yb - ya);
  const part = (v, from, to, log) => log ? Math.log(Math.max(v, from) / from) / Math.log(to / from) : (v - from) / (to - from);
  const px = x => left + part(x, x0, x1, plot.xlog) * (width - left - right);
  const py = y => height - bottom - part(y, y0, y1, plot.log) * (height - top - bottom);
  node("desc", {id: id + "d"}, svg, described(plot, [x0, x1], [y0, y1]));
  node("rect", {x: left, y: top, width: width - left - right, height: height - top - bottom},
    node("clipPath", {id}, node("defs", {}, svg)));
  for (const v of plot.log ? powers(y0, y1) : steps(y0, y1, Math.max(2, (height - top - bottom) / 42))) {
    node("line", {x1: left, x2: width - right, y1: py(v), y2: py(v), class: "gridline"}, svg);
    node("text", {x: left - 6, y: py(v) + 4, "text-anchor": "end"}, svg, shown(v));
  }
  for (const v of plot.xlog ? powers(x0, x1) : steps(x0, x1, Math.max(2, (width - left - right) / 80))) {
    node("line", {x1: px(v), x2: px(v), y1: height - bottom, y2: height - bottom + 4, class: "axis"}, svg);
    node("text", {x: px(v), y: height - bottom + 17, "text-anchor": "middle"}, svg, shown(v));
  }
  node("line", {x1: left, x2: width - right, y1: height - bottom, y2: height - bottom, class: "axis"}, svg);
  if (!small) {
    node("text", {x: (left + width - right) / 2, y: height - 6, "text-anchor": "middle"}, svg,
      plot.x + (plot.xlog ? " (logarithmic)" : ""));
    node("text", {x: 13, y: (top + height - bottom) / 2, "text-anchor": "middle",
      transform: `rotate(-90 13 ${(top + height - bottom) / 2})`}, svg,
      plot.y + (plot.log ? " (logarithmic)" : ""));
  }
  const inside = node("g", {"clip-path": `url(#${id})`}, svg);
  for (const s of plot.series) {
    if (s.s === "bars") {
      for (let i = 0; i < s.x.length; ++i) {
        const to = py(s.y[i]);
        node("rect", {x: px(s.x[i] - half), width: Math.max(1, px(s.x[i] + half) - px(s.x[i] - half)),
          y: to, height: Math.max(0, height - bottom - to), fill: s.c}, inside);
      }
      continue;
    }
    let path = "", pen = "M";
    for (let i = 0; i < s.x.length; ++i) {
      if (s.y[i] === null) { pen = "M"; continue; }
      path += pen + px(s.x[i]).toFixed(1) + " " + py(s.y[i]).toFixed(1);
      pen = "L";
    }
    if (s.s === "area" && s.x.length) {
      for (let i = s.x.length - 1; i >= 0; --i) path += "L" + px(s.x[i]).toFixed(1) + " " + py(s.l[i]).toFixed(1);
      node("path", {d: path + "Z", fill: s.c, "fill-opacity": 0.75}, inside);
    } else {
      node("path", {d: path, fill: "none", stroke: s.c, "stroke-width": 1.4, "stroke-linejoin": "round"}, inside);
    }
    for (let i = 0; s.s === "points" && i < s.x.length; ++i)
      if (s.y[i] !== null) node("circle", {cx: px(s.x[i]), cy: py(s.y[i]), r: 3, fill: s.c}, inside);
  }
  for (const [name, y] of plot.levels) {
    if (y < y0 || y > y1) continue;
    node("line", {x1: left, x2: width - right, y1: py(y), y2: py(y), class: "level"}, svg);
    if (!small) node("text", {x: width - right - 2, y: py(y) - 4, "text-anchor": "end", class: "soft"}, svg, name);
  }
  let free = -Infinity;
  for (const [name, x] of plot.marks) {
    if (x < x0 || x > x1) continue;
    node("line", {x1: px(x), x2: px(x), y1: top - 6, y2: height - bottom, class: "mark"}, svg);
    const wide = 7 * name.length;
    if (px(x) >= free && px(x) + wide < width) {
      node("text", {x: px(x) + 3, y: top - 10, class: "soft"}, svg, name);
      free = px(x) + wide + 8;
    }
  }
  listen(box, svg, {px, py, x0, x1, left, right, top, bottom, width, height, xlog: plot.xlog});
}
function nearest(list, x) {
  let low = 0, high = list.length - 1;
  while (high - low > 1) { const half = (low + high) >> 1; if (list[half] < x) low = half; else high = half; }
  return Math.abs(list[low] - x) <= Math.abs(list[high] - x) ? low : high;
}
function listen(box, svg, at) {
  const cross = node("line", {class: "cross", y1: at.top, y2: at.height - at.bottom, visibility: "hidden"}, svg);
  const band = node("rect", {class: "band", y: at.top, height: at.height - at.top - at.bottom, visibility: "hidden"}, svg);
  const tip = document.getElementById("tip");
  const place = e => e.clientX - svg.getBoundingClientRect().left;
  const value = p => {
    const part = (p - at.left) / (at.width - at.left - at.right);
    return at.xlog ? at.x0 * Math.pow(at.x1 / at.x0, part) : at.x0 + part * (at.x1 - at.x0);
  };
  let begun = null;
  svg.addEventListener("pointerdown", e => { begun = place(e); svg.setPointerCapture(e.pointerId); });
  svg.addEventListener("dblclick", () => { box.zoom = null; draw(box); });
  svg.addEventListener("pointerleave", () => { tip.hidden = true; cross.setAttribute("visibility", "hidden"); });
  svg.addEventListener("pointerup", e => {
    const ended = place(e);
    if (begun !== null && Math.abs(ended - begun) > 8) {
      box.zoom = [value(Math.min(begun, ended)), value(Math.max(begun, ended))];
      tip.hidden = true;
      draw(box);
    }
    begun = null;
  });
  svg.addEventListener("pointermove", e => {
    const p = place(e), x = value(p);
    if (begun !== null) {
      band.setAttribute("x", Math.min(begun, p));
      band.setAttribute("width", Math.abs(p - begun));
      band.setAttribute("visibility", "visible");
    }
    if (x < at.x0 || x > at.x1) { tip.hidden = true; return; }
    const pointer = e.clientY - svg.getBoundingClientRect().top;
    let lines = [];
    for (const s of box.plot.series) {
      if (!s.x.length) continue;
      const i = nearest(s.x, x);
      if (s.y[i] === null) continue;
      lines.push({gap: Math.abs(at.py(s.y[i]) - pointer), x: s.x[i],
        text: (s.n ? s.n + ": " : "") + shown(s.s === "area" ? s.y[i] - s.l[i] : s.y[i])});
    }
    if (!lines.length) return;
    const first = lines.reduce((a, b) => a.gap < b.gap ? a : b);
    if (lines.length > 6) lines = [first];
    cross.setAttribute("x1", at.px(first.x));
    cross.setAttribute("x2", at.px(first.x));
    cross.setAttribute("visibility", "visible");
    tip.textContent = [box.plot.x + " " + shown(first.x)].concat(lines.map(l => l.text)).join("\n");
    tip.hidden = false;
    tip.style.left = Math.min(e.pageX + 14, document.documentElement.clientWidth - tip.offsetWidth - 8) + "px";
    tip.style.top = e.pageY + 14 + "px";
  });
}
function element(name, attributes, parent, text) {
  const made = document.createElement(name);
  for (const key in attributes) made.setAttribute(key, attributes[key]);
  if (text !== undefined) made.textContent = text;
  if (parent) parent.appendChild(made);
  return made;
}
// Calls more() each time when the end of a scrolled box comes near, as long as that returns true.
function whenReached(box, more) {
  const end = element("div", {style: "height: 1px"}, box);
  const watch = new IntersectionObserver(found => {
    if (!found.some(each => each.isIntersecting) || !more()) return;
    watch.unobserve(end);
    watch.observe(end);
  }, {root: box, rootMargin: "800px"});
  watch.observe(end);
}
const beforePrint = []; // makes what is printed without having been in view
const printedRows = 500, printedPlots = 60;
const signs = {slower: "\u25B2", faster: "\u25BC", "no-change": "=", unknown: "?"};
function rowOf(cells, classes) {
  const row = document.createElement("tr");
  cells.forEach((cell, i) => {
    const [text, look, link] = typeof cell === "string" ? [cell] : cell;
    const made = element("td", {class: [classes[i], look].filter(Boolean).join(" ")}, row);
    if (signs[look]) { element("span", {role: "img", "aria-label": look}, made, signs[look]); made.append(" "); }
    if (link) element("a", {href: link}, made, text); else made.append(text);
  });
  return row;
}
function sortable(table) {
  const box = table.parentNode, body = table.tBodies[0], heads = Array.from(table.querySelectorAll("thead th"));
  const json = box.querySelector("script"), data = json && JSON.parse(json.textContent);
  const text = cell => typeof cell === "string" ? cell : cell[0];
  const rows = data ? data.rows.map(cells => ({cells: cells.map(text), make: () => rowOf(cells, data.classes)}))
    : Array.from(body.rows).map(row => ({cells: Array.from(row.cells).map(cell => cell.textContent.trim()), row}));
  const step = data ? 100 : rows.length;
  let order = rows, made = body.rows.length;
  const more = count => {
    const part = document.createDocumentFragment();
    for (; count > 0 && made < order.length; --count, ++made) part.appendChild(order[made].row ??= order[made].make());
    body.appendChild(part);
    return made < order.length;
  };
  let sorted = null, words = [];
  const status = rows.length > 20 ? filterOf(box, rows.length, typed => { words = typed; show(); }) : null;
  function show() {
    order = rows.filter(row => words.every(word => (row.all ??= row.cells.join("\n").toLowerCase()).includes(word)));
    if (sorted) order = inOrder(order, sorted);
    made = 0;
    body.replaceChildren();
    more(step);
    box.scrollTop = 0;
    if (status) status(order.length);
  }
  heads.forEach((head, column) => {
    const button = element("button", {type: "button"}, null, head.textContent);
    head.replaceChildren(button);
    button.addEventListener("click", () => {
      const up = head.getAttribute("aria-sort") !== "ascending";
      heads.forEach(other => other.removeAttribute("aria-sort"));
      head.setAttribute("aria-sort", up ? "ascending" : "descending");
      sorted = {column, up};
      show();
    });
  });
  if (!data) return;
  whenReached(box, () => more(step));
  beforePrint.push(() => more(printedRows - made));
}
// Numbers by value where all cells of the column are numbers, with a mark before or a unit behind; else as text.
function inOrder(rows, {column, up}) {
  const number = /^(?:[\u25B2\u25BC=?] )?([+-]?\d+(?:\.\d+)?)(?: .*)?$/;
  const filled = rows.filter(row => row.cells[column] !== ""), numeric = filled.every(row => number.test(row.cells[column]));
  const compare = new Intl.Collator("en", {numeric: true}).compare;
  const key = row => numeric ? Number(number.exec(row.cells[column])[1]) : row.cells[column];
  const keyed = filled.map(row => [key(row), row]);
  keyed.sort(numeric ? (a, b) => a[0] - b[0] : (a, b) => compare(a[0], b[0]));
  if (!up) keyed.reverse();
  return keyed.map(pair => pair[1]).concat(rows.filter(row => row.cells[column] === ""));
}
// A field that filters rows by words, above a table; returns what tells how many are left.
function filterOf(box, count, use) {
  const line = element("div", {class: "filter"});
  const label = element("label", {}, line, "Rows with the words ");
  const field = element("input", {type: "search"}, label);
  const told = element("span", {"aria-live": "polite"}, line, `${count} rows`);
  field.addEventListener("input", () => use(field.value.toLowerCase().split(/\s+/).filter(Boolean)));
  box.before(line);
  return left => { told.textContent = left === count ? `${count} rows` : `${left} of ${count} rows`; };
}
let curveList = null;
function curve(index) {
  curveList ??= JSON.parse(document.getElementById("curves").textContent);
  return curveList[index];
}
// Boxes of a list of plots, which have their curves in common.
function plotList(box) {
  const data = JSON.parse(box.querySelector("script").textContent), inside = box.querySelector(".many");
  let made = 0;
  const more = count => {
    for (; count > 0 && made < data.plots.length; --count, ++made) {
      const own = data.plots[made];
      const plot = Object.assign({}, data.common, own);
      const plotBox = element("div", {class: "plot" + data.look, "data-height": data.height}, inside);
      element("h3", {}, plotBox, own.title ?? curve(own.series[0].k).n);
      if (data.look !== " small") keyOf(plot, plotBox);
      plotBox.style.minHeight = data.height + 24 + "px";
      plotBox.find = () => ({...plot, series: plot.series.map(s => ({...curve(s.k), ...s}))});
      watched.observe(plotBox);
    }
    return made < data.plots.length;
  };
  more(24);
  whenReached(box, () => more(24));
  beforePrint.push(() => more(printedPlots - made));
}
function keyOf(plot, box) {
  const key = element("div", {class: "key"}, box);
  const names = new Map(plot.series.map(s => [s.g ?? curve(s.k).n, s.c])); // curves of a group share an entry
  for (const [name, colour] of names) {
    const entry = element("span", {}, key);
    element("i", {style: "background:" + colour}, entry);
    entry.append(name);
  }
}
const watched = new IntersectionObserver(found => {
  for (const each of found) if (each.isIntersecting) drawSeen(each.target);
}, {rootMargin: "400px"});
function drawSeen(box) {
  watched.unobserve(box);
  box.plot ??= box.find();
  draw(box);
}
const boxes = () => Array.from(document.querySelectorAll(".plot[data-height]"));
for (const box of boxes()) {
  box.find = () => JSON.parse(box.querySelector("script").textContent);
  box.style.minHeight = Number(box.dataset.height) + 24 + "px";
  watched.observe(box);
}
document.querySelectorAll(".plot-list").forEach(plotList);
document.querySelectorAll("table.sortable").forEach(sortable);
// Whoever has no pointer scrolls with the arrow keys.
const focusable = () => document.querySelectorAll(".scroll").forEach(box => {
  if (box.scrollWidth > box.clientWidth + 1 || box.scrollHeight > box.clientHeight + 1) box.tabIndex = 0;
});
focusable();
addEventListener("beforeprint", () => {
  beforePrint.forEach(make => make());
  paper = 700;
  boxes().forEach(drawSeen);
});
addEventListener("afterprint", () => {
  paper = Infinity;
  boxes().forEach(drawSeen);
});
let waiting = 0, wide = innerWidth;
addEventListener("resize", () => {
  if (innerWidth === wide) return;
  wide = innerWidth;
  clearTimeout(waiting);
  waiting = setTimeout(() => { boxes().forEach(box => watched.observe(box)); focusable(); }, 100);
});
)js";

} // namespace

std::string page_head(std::string_view title, std::string_view lead, bool is_wide) {
    return fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                       "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                       "<title>{0} - Octant</title>\n<style>{1}</style>\n</head>\n<body>\n<main{2}>\n"
                       "<header><p class=\"lead\">{3}</p><h1>{0}</h1></header>\n",
        escaped(title), style_sheet, is_wide ? " class=\"wide\"" : "", escaped(lead));
}

std::string page_end() {
    return fmt::format(
        "</main>\n<div id=\"tip\" hidden></div>\n<script>{}</script>\n</body>\n</html>\n", drawing_script);
}

} // namespace octant::ui::report
