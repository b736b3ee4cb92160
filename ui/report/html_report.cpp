#include "ui/report/html_report.h"

#include "sim/base/output_file.h"
#include "ui/report/comparison.h"
#include "ui/report/flight_plots.h"
#include "ui/report/html_text.h"
#include "ui/report/loaded_recording.h"
#include "ui/report/run_file.h"
#include "ui/report/slow_pictures.h"
#include "ui/report/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::report {

namespace {

// A plot's numbers stand as JSON in its element: {x, y: labels, x0, x1, y0, y1: ends of the axes or null, log, levels:
// [[name, y]], marks: [[name, x]], bar: width, series: [{n: name, c: colour, s: "line"|"area"|"bars", x: [], y: [], l:
// []}]}. Text is 12 px whatever the width.
constexpr std::string_view drawing = R"js(
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
function shown(v) {
  const size = Math.abs(v);
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
function draw(box) {
  const plot = box.plot, small = box.classList.contains("small");
  const width = Math.max(160, box.clientWidth), height = Number(box.dataset.height);
  const left = small ? 42 : 58, right = 12, top = plot.marks.length ? 30 : 10, bottom = small ? 22 : 40;
  box.querySelectorAll("svg").forEach(old => old.remove());
  const svg = node("svg", {width, height, viewBox: `0 0 ${width} ${height}`, role: "img"}, box);
  const [xa, xb] = ends(plot, "x", false), [ya, yb] = ends(plot, "y", true);
  const half = plot.series.some(s => s.s === "bars") ? plot.bar / 2 : 0;
  const x0 = box.zoom ? box.zoom[0] : plot.x0 ?? xa - half, x1 = box.zoom ? box.zoom[1] : plot.x1 ?? xb + half;
  let y0 = plot.y0 ?? ya - 0.05 * (yb - ya), y1 = plot.y1 ?? yb + 0.05 * (yb - ya);
  if (plot.log) { y0 = Math.max(y0, 0.5); y1 = Math.max(y1, 10 * y0); }
  const scale = plot.log ? Math.log10 : v => v;
  const px = x => left + (x - x0) / (x1 - x0) * (width - left - right);
  const py = y => {
    const part = (scale(plot.log ? Math.max(y, y0) : y) - scale(y0)) / (scale(y1) - scale(y0));
    return height - bottom - part * (height - top - bottom);
  };
  const id = "c" + (draw.count = (draw.count || 0) + 1);
  node("rect", {x: left, y: top, width: width - left - right, height: height - top - bottom},
    node("clipPath", {id}, node("defs", {}, svg)));
  const yTicks = plot.log ? [] : steps(y0, y1, Math.max(2, (height - top - bottom) / 42));
  if (plot.log) for (let v = Math.pow(10, Math.ceil(Math.log10(y0))); v <= y1 * 1.0001; v *= 10) yTicks.push(v);
  for (const v of yTicks) {
    node("line", {x1: left, x2: width - right, y1: py(v), y2: py(v), class: "gridline"}, svg);
    node("text", {x: left - 6, y: py(v) + 4, "text-anchor": "end"}, svg, shown(v));
  }
  for (const v of steps(x0, x1, Math.max(2, (width - left - right) / 80))) {
    node("line", {x1: px(v), x2: px(v), y1: height - bottom, y2: height - bottom + 4, class: "axis"}, svg);
    node("text", {x: px(v), y: height - bottom + 17, "text-anchor": "middle"}, svg, shown(v));
  }
  node("line", {x1: left, x2: width - right, y1: height - bottom, y2: height - bottom, class: "axis"}, svg);
  if (!small) {
    node("text", {x: (left + width - right) / 2, y: height - 6, "text-anchor": "middle"}, svg, plot.x);
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
  listen(box, svg, {px, py, x0, x1, left, right, top, bottom, width, height});
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
  const value = p => at.x0 + (p - at.left) / (at.width - at.left - at.right) * (at.x1 - at.x0);
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
function sortable(table) {
  table.querySelectorAll("thead th").forEach((head, column) => {
    head.tabIndex = 0;
    const sort = () => {
      const up = head.getAttribute("aria-sort") !== "ascending";
      table.querySelectorAll("thead th").forEach(other => other.removeAttribute("aria-sort"));
      head.setAttribute("aria-sort", up ? "ascending" : "descending");
      const body = table.tBodies[0];
      const key = row => row.cells[column].dataset.key ?? row.cells[column].textContent.trim();
      const rows = Array.from(body.rows);
      rows.sort((a, b) => {
        const one = key(a), two = key(b), n = Number(one), m = Number(two);
        const order = one !== "" && two !== "" && !isNaN(n) && !isNaN(m) ? n - m : one.localeCompare(two, "en", {numeric: true});
        return up ? order : -order;
      });
      rows.forEach(row => body.appendChild(row));
    };
    head.addEventListener("click", sort);
    head.addEventListener("keydown", e => { if (e.key === "Enter") sort(); });
  });
}
const boxes = Array.from(document.querySelectorAll(".plot[data-height]"));
for (const box of boxes) box.plot = JSON.parse(box.querySelector("script").textContent);
const drawAll = () => boxes.forEach(draw);
drawAll();
document.querySelectorAll("table.sortable").forEach(sortable);
let waiting = 0;
addEventListener("resize", () => { clearTimeout(waiting); waiting = setTimeout(drawAll, 100); });
)js";

/// What draws a page's plots, with values under the pointer and zoom by dragging, and sorts its tables. Refers to
/// nothing outside the page.
std::string_view page_script() { return drawing; }

std::string number(double value) { return std::isfinite(value) ? fmt::format("{:.6g}", value) : std::string("null"); }

std::string number(const std::optional<double>& value) { return value ? number(*value) : std::string("null"); }

std::string list(std::span<const double> values) {
    std::string text = "[";
    for (const double value : values) {
        text += text.size() > 1 ? "," : "";
        text += std::isfinite(value) ? fmt::format("{:.5g}", value) : std::string("null");
    }
    return text + "]";
}

/// A JSON text that ends no script element.
std::string json_string(std::string_view text) {
    std::string json = "\"";
    for (const char letter : text) {
        const auto byte = static_cast<unsigned char>(letter);
        if (letter == '"' || letter == '\\' || letter == '<' || letter == '&' || byte < 0x20) {
            json += fmt::format("\\u{:04x}", byte);
        } else {
            json += letter;
        }
    }
    return json + "\"";
}

/// Pairs of a name and a number.
template <class Items, class Number>
std::string pairs(const Items& items, Number number_of) {
    std::string text = "[";
    for (const auto& item : items) {
        text += fmt::format("{}[{},{}]", text.size() > 1 ? "," : "", json_string(item.name), number(number_of(item)));
    }
    return text + "]";
}

std::string series_json(const PlotSeries& series) {
    using Style = PlotSeries::Style;
    const char* const style = series.style == Style::Area ? "area" : series.style == Style::Bars ? "bars" : "line";
    std::string json = fmt::format(R"({{"n":{},"c":{},"s":"{}","x":{},"y":{})", json_string(series.name),
        json_string(series.colour), style, list(series.x), list(series.y));
    if (series.style == Style::Area) { json += ",\"l\":" + list(series.y_low); }
    return json + "}";
}

std::string plot_json(const Plot& plot) {
    std::string json = fmt::format(R"({{"x":{},"y":{},"x0":{},"x1":{},"y0":{},"y1":{},"log":{},"bar":{},)",
        json_string(plot.x_label), json_string(plot.y_label), number(plot.x_min), number(plot.x_max),
        number(plot.y_min), number(plot.y_max), plot.y_logarithmic, number(plot.bar_width));
    json += "\"levels\":" + pairs(plot.levels, [](const PlotReferenceLine& level) { return level.y; });
    json += ",\"marks\":" + pairs(plot.marks, [](const PlotMark& mark) { return mark.x; });
    json += ",\"series\":[";
    for (const PlotSeries& series : plot.series) {
        json += &series == &plot.series.front() ? "" : ",";
        json += series_json(series);
    }
    return json + "]}";
}

std::string key_html(const Plot& plot) {
    std::string html;
    for (const PlotSeries& series : plot.series) {
        if (!series.name.empty() && !series.x.empty()) {
            html += fmt::format(
                "<span><i style=\"background:{}\"></i>{}</span>", escaped(series.colour), escaped(series.name));
        }
    }
    return html.empty() ? html : "<div class=\"key\">" + html + "</div>";
}

} // namespace

std::string page_plot(const Plot& plot, PlotWidth place) {
    const bool small = place == PlotWidth::Small;
    const int height_px = place == PlotWidth::FullWidth ? 320 : (small ? 130 : 260);
    return fmt::format("<div class=\"plot{}\" data-height=\"{}\"><h3>{}</h3>{}"
                       "<script type=\"application/json\">{}</script></div>\n",
        place == PlotWidth::FullWidth ? " wide" : (small ? " small" : ""), height_px, escaped(plot.title),
        small ? std::string() : key_html(plot), plot_json(plot));
}

namespace {

/// Of curves in one plot, as HTML has them.
constexpr std::array run_colours{
    "#3b82f6", "#f59e0b", "#10b981", "#ef4444", "#8b5cf6", "#14b8a6", "#ec4899", "#84cc16", "#6366f1", "#a16207"};

/// Names of settings in which some of these recordings differ, in their order. `among`: at least one number of a
/// recording.
std::vector<std::string> differing_settings(Recordings recordings, const std::vector<std::size_t>& among);

/// What tells a recording from the others: its folder's name, or its whole path where names repeat.
std::string label_of(Recordings recordings, const LoadedRecording& recording) {
    const auto same = [&](const auto& each) { return each.name == recording.name; };
    const bool unique = std::ranges::count_if(recordings, same) == 1;
    return unique ? recording.name : recording.display_name;
}

/// The value of a name; empty where there is none.
std::string value_of(const NamedValues& rows, std::string_view name) {
    const auto found = std::ranges::find_if(rows, [&](const auto& row) { return row.first == name; });
    return found == rows.end() ? std::string() : found->second;
}

std::vector<std::string> differing_settings(Recordings recordings, const std::vector<std::size_t>& among) {
    std::vector<std::string> names;
    const NamedValues& first = recordings[among.front()].run.settings;
    for (const auto& row : first) {
        const auto& name = row.first;
        const auto& value = row.second;
        const bool differs = std::ranges::any_of(
            among, [&](std::size_t i) { return value_of(recordings[i].run.settings, name) != value; });
        if (differs) { names.push_back(name); }
    }
    return names;
}

/// A file's name without its folder, as table cells have room for; any other text as it is.
std::string short_value(const std::string& value) {
    if (value == unset_value) { return "not set"; }
    const bool is_path = value.find('/') != std::string::npos;
    return is_path ? std::filesystem::path(value).filename().string() : value;
}

/// A cell of a table, as HTML.
std::string number_cell(double value, int decimals) {
    return fmt::format("<td class=\"number\">{:.{}f}</td>", value, decimals);
}

/// The figure of that key, which there must be.
const Statistic& statistic_named(std::string_view key) {
    return *std::ranges::find(all_statistics(), key, &Statistic::key);
}

/// Where the axis of frame times ends, of all these recordings, milliseconds.
double shared_ceiling_ms(Recordings recordings, const std::vector<std::size_t>& runs) {
    double ceiling_ms = 0.0;
    for (const std::size_t i : runs) { ceiling_ms = std::max(ceiling_ms, plot_ceiling_ms(recordings[i].statistics)); }
    return ceiling_ms;
}

using Indices = std::vector<std::size_t>;

/// "order-method tree, samples 4", by the settings in which variants differ.
std::string variant_label(const LoadedRecording& recording, const std::vector<std::string>& names) {
    std::string label;
    for (const std::string& name : names) {
        label += fmt::format(
            "{}{} {}", label.empty() ? "" : ", ", name, short_value(value_of(recording.run.settings, name)));
    }
    return label.empty() ? "all the same" : label;
}

std::vector<double> values_of(Recordings recordings, const Indices& runs, double (*value)(const Statistics&)) {
    std::vector<double> values;
    for (const std::size_t i : runs) {
        if (recordings[i].statistics.frames > 0) { values.push_back(value(recordings[i].statistics)); }
    }
    return values;
}

/// Whether other programs had a part in the runs' frame times, or other flights on shared cores.
bool is_noisy(Recordings recordings, const Indices& runs) {
    return std::ranges::any_of(runs, [&](std::size_t i) { return !recordings[i].run.noise.empty(); });
}

/// How a variant is set against the first one: where both were quiet, a sure change is better or worse; where one was
/// noisy, it may be the machine's.
enum class Reference { Itself, Quiet, Noisy };

/// Median of a variant's runs, and how it compares with the first variant's.
std::string compared_cells(const std::vector<double>& before, const std::vector<double>& now, Reference reference) {
    if (now.empty() || before.empty()) { return "<td class=\"number\">none</td><td></td>"; }
    std::string html = number_cell(median_of(now), 3);
    if (reference == Reference::Itself) { return html + "<td class=\"soft\">compared with this one</td>"; }
    const RelativeChange change = relative_change(before, now);
    const bool is_decided = change.is_significant() && reference == Reference::Quiet;
    const char* const mark = !is_decided ? "" : (change.share < 0.0 ? "better" : "worse");
    std::string text = fmt::format("{:+.1f} %", 100.0 * change.share);
    if (change.has_interval) {
        text += fmt::format(" ({:+.1f} to {:+.1f} %)", 100.0 * change.low, 100.0 * change.high);
    }
    return html + fmt::format("<td class=\"{}\">{}</td>", mark, text);
}

std::string comparison_table(Recordings recordings, const std::vector<Indices>& variants) {
    Indices all;
    for (const Indices& variant : variants) { all.insert(all.end(), variant.begin(), variant.end()); }
    const std::vector<std::string> names = differing_settings(recordings, all);
    std::string html = "<div class=\"scroll\"><table>\n<thead><tr><th>variant</th><th class=\"number\">runs</th>"
                       "<th class=\"number\">P50, ms</th><th>change</th><th class=\"number\">P99, ms</th>"
                       "<th>change</th></tr></thead>\n<tbody>\n";
    bool noisy = false;
    for (const Indices& variant : variants) {
        const bool is_first = &variant == &variants.front();
        const bool is_loud = is_noisy(recordings, variants.front()) || is_noisy(recordings, variant);
        const Reference reference = is_first ? Reference::Itself : (is_loud ? Reference::Noisy : Reference::Quiet);
        noisy = noisy || reference == Reference::Noisy;
        html += fmt::format("<tr><td>{}</td><td class=\"number\">{}</td>",
            escaped(variant_label(recordings[variant.front()], names)), variant.size());
        for (const char* key : {"p50_ms", "p99_ms"}) {
            const auto value = statistic_named(key).value;
            html += compared_cells(
                values_of(recordings, variants.front(), value), values_of(recordings, variant, value), reference);
        }
        html += "</tr>\n";
    }
    html += "</tbody></table></div>\n<p class=\"note\">Medians over the runs of a variant. In "
            "brackets the 95 % interval of the change by the bootstrap over runs, where both "
            "variants have three runs or more; green or red only where it leaves zero out.";
    if (noisy) {
        html += " Beside noisy runs nothing is called better or worse: other programs, or flights "
                "on the same cores, had a part in their times.";
    }
    return html + "</p>\n";
}

std::string title_of_group(const LoadedRecording& recording) {
    return recording.run.title.empty() ? recording.name : recording.run.title;
}

/// The frame times of a flight's runs over its simulated time, in one plot: as many of each variant as there is room
/// for.
std::string overlaid_plot(Recordings recordings, const std::vector<Indices>& variants, double ceiling_ms) {
    constexpr std::size_t max_curves = 12;
    Plot plot{"Frame time of each run", "simulated time, s", "ms", {}, {}, 0.0, ceiling_ms};
    const std::size_t max_of_each = std::max<std::size_t>(1, max_curves / variants.size());
    std::size_t runs = 0;
    for (std::size_t v = 0; v < variants.size(); ++v) {
        runs += variants[v].size();
        const std::size_t max_here = std::min(max_of_each, max_curves - plot.series.size());
        for (std::size_t k = 0; k < std::min(variants[v].size(), max_here); ++k) {
            const LoadedRecording& recording = recordings[variants[v][k]];
            PlotSeries curve = recording.flight.frame_ms.series(400);
            curve.name = label_of(recordings, recording);
            curve.colour = run_colours[v % run_colours.size()];
            plot.series.push_back(std::move(curve));
        }
    }
    plot.levels = {{"16.67 ms", overrun_16_ms}};
    plot.marks = recordings[variants.front().front()].run.legs;
    const std::string html = page_plot(plot, PlotWidth::FullWidth);
    if (plot.series.size() == runs) { return html; }
    return html + fmt::format("<p class=\"note\">{} of {} runs.</p>\n", plot.series.size(), runs);
}

/// Recordings of the same flight on the same kind of machine beside each other, as HTML: a table of their variants
/// where settings differ, and their frame times in one plot. Says so where no two belong together.
std::string compared_flights_html(Recordings recordings) {
    constexpr std::size_t max_groups = 24;
    std::string html;
    std::size_t shown = 0;
    std::size_t compared = 0;
    for (const Indices& group : comparable_groups(recordings)) {
        if (group.size() < 2) { continue; }
        ++compared;
        if (shown == max_groups) { continue; }
        ++shown;
        const std::vector<Indices> variants = variants_of(recordings, group);
        html += "<div class=\"card\">\n<h3>" + escaped(title_of_group(recordings[group.front()])) + "</h3>\n";
        if (variants.size() > 1) { html += comparison_table(recordings, variants); }
        html += overlaid_plot(recordings, variants, shared_ceiling_ms(recordings, group)) + "</div>\n";
    }
    if (html.empty()) {
        return "<p class=\"note\">No two of these recordings are of the same flight on the same "
               "kind of machine, so none are compared.</p>\n";
    }
    if (shown < compared) {
        html += fmt::format(
            "<p class=\"note\">The first {} of {} flights that were flown more than once.</p>\n", shown, compared);
    }
    return "<h2>The same flight, compared</h2>\n" + html;
}

namespace fs = std::filesystem;

std::vector<std::size_t> all_of(Recordings recordings) {
    std::vector<std::size_t> all(recordings.size());
    for (std::size_t i = 0; i < all.size(); ++i) { all[i] = i; }
    return all;
}

std::string link_of(Recordings recordings, const LoadedRecording& recording, const fs::path& page_folder) {
    const std::string label = escaped(label_of(recordings, recording));
    std::error_code ignored;
    const fs::path page = recording.folder / "report.html";
    const bool is_unpacked = recording.display_name != recording.folder.string(); // and goes with us
    if (page_folder.empty() || is_unpacked || !fs::is_regular_file(page, ignored)) { return label; }
    const fs::path way =
        fs::absolute(page).lexically_normal().lexically_relative(fs::absolute(page_folder).lexically_normal());
    return fmt::format("<a href=\"{}\">{}</a>", url_text(way.generic_string()), label);
}

std::string noise_text_of(const LoadedRecording& recording) {
    std::string text;
    const auto add = [&](bool holds, const char* word) {
        text += holds ? (text.empty() ? "" : ", ") + std::string(word) : "";
    };
    add(recording.ended_early, "ended early");
    add(!recording.run.stopped.empty(), "stopped");
    add(!recording.disagreement.empty(), "rows and summary disagree");
    add(!recording.run.noise.empty(), "noisy");
    add(recording.statistics.frames == 0, "no frames");
    return text;
}

/// Keys of figures and what they are called where there is little room.
constexpr std::array<std::pair<const char*, const char*>, 6> shown_statistics{
    {{"frames", "frames"}, {"p50_ms", "P50, ms"}, {"p99_ms", "P99, ms"}, {"max_ms", "longest, ms"},
        {"low_1pct_fps", "1 % low, 1/s"}, {"overruns_16ms", "above 16.67 ms"}}};

/// How sweeps flew them, where sweeps did: " 24 flown by a sweep one at a time."
std::string batch_context_text(Recordings recordings) {
    std::map<std::string, int> counts;
    for (const LoadedRecording& recording : recordings) {
        const std::string batch_context = value_of(recording.run.facts, batch_context_fact);
        counts[batch_context] += batch_context.empty() ? 0 : 1;
    }
    std::string text;
    for (const auto& [batch_context, count] : counts) {
        text += count == 0 ? "" : fmt::format(" {} flown by a sweep {}.", count, escaped(batch_context));
    }
    return text;
}

std::string runs_table(Recordings recordings, const fs::path& page_folder) {
    constexpr std::size_t max_settings = 6;
    std::vector<std::string> names = differing_settings(recordings, all_of(recordings));
    const std::size_t left_out = names.size() - std::min(names.size(), max_settings);
    names.resize(names.size() - left_out);
    std::string html = "<div class=\"scroll\"><table class=\"sortable runs\">\n<thead><tr>"
                       "<th>flight</th>";
    for (const std::string& name : names) { html += "<th>" + escaped(name) + "</th>"; }
    for (const auto& [key, name] : shown_statistics) { html += fmt::format("<th class=\"number\">{}</th>", name); }
    html += "<th>states</th><th>pictures</th><th>condition</th></tr></thead>\n<tbody>\n";
    for (const LoadedRecording& recording : recordings) {
        html += "<tr><td>" + link_of(recordings, recording, page_folder) + "</td>";
        for (const std::string& name : names) {
            html += "<td>" + escaped(short_value(value_of(recording.run.settings, name))) + "</td>";
        }
        for (const auto& [key, name] : shown_statistics) {
            const Statistic& statistic = statistic_named(key);
            html += number_cell(statistic.value(recording.statistics), std::min(statistic.decimals, 2));
        }
        const std::string condition = noise_text_of(recording);
        html += fmt::format("<td><code>{}</code></td><td><code>{}</code></td><td class=\"{}\">{}</td></tr>\n",
            escaped(recording.run.state_hash.substr(0, 8)), escaped(recording.run.picture_hash.substr(0, 8)),
            condition.empty() ? "" : "worse", condition.empty() ? "good" : condition);
    }
    html += "</tbody></table></div>\n<p class=\"note\">A click on a column's head sorts by it. "
            "States and pictures are the first eight digits of their hashes." +
            batch_context_text(recordings);
    if (left_out > 0) {
        html += fmt::format(" {} more settings differ; they are in the flights' own pages.", left_out);
    }
    return "<div class=\"card\">\n" + html + "</p></div>\n";
}

std::string plot_per_recording(Recordings recordings) {
    const double ceiling_ms = shared_ceiling_ms(recordings, all_of(recordings));
    const std::size_t pieces = recordings.size() > 40 ? 60 : 150;
    double begin_s = 0.0;
    double end_s = 0.0;
    for (const LoadedRecording& recording : recordings) {
        begin_s = std::min(begin_s, recording.flight.begin_s());
        end_s = std::max(end_s, recording.flight.end_s());
    }
    std::string html = "<div class=\"small-plots\">\n";
    for (const LoadedRecording& recording : recordings) {
        Plot plot{label_of(recordings, recording), "simulated time, s", "ms", {}, {}, 0.0, ceiling_ms};
        plot.x_min = begin_s;
        plot.x_max = end_s;
        PlotSeries curve = recording.flight.frame_ms.series(pieces);
        curve.colour = run_colours.front();
        plot.series.push_back(std::move(curve));
        plot.levels = {{"16.67 ms", overrun_16_ms}};
        html += page_plot(plot, PlotWidth::Small);
    }
    return "<h2>Frame time of each flight, ms over seconds, on common axes</h2>\n<div "
           "class=\"card\">" +
           html + "</div></div>\n";
}

std::string pictures(Recordings recordings) {
    constexpr std::size_t max_flights = 24;
    constexpr int widest_px = 320;
    std::vector<const LoadedRecording*> flights;
    for (const LoadedRecording& recording : recordings) {
        if (!recording.pictures.empty()) { flights.push_back(&recording); }
    }
    if (flights.empty()) { return {}; }
    std::string html = "<div class=\"sheet\">\n";
    for (const std::size_t index : evenly_spaced(flights.size(), max_flights)) {
        const LoadedRecording& flight = *flights[index];
        const fs::path& middle = flight.pictures[flight.pictures.size() / 2];
        html += picture_html(middle, widest_px, label_of(recordings, flight) + ", " + middle.filename().string());
    }
    html += "</div>\n";
    if (flights.size() > max_flights) {
        html += fmt::format("<p class=\"note\">{} of {} flights.</p>\n", max_flights, flights.size());
    }
    return "<h2>A picture from the middle of each flight</h2>\n<div class=\"card\">" + html + "</div>\n";
}

/// Settings, program and machine where all recordings have the same.
std::string common_rows(Recordings recordings) {
    const auto table = [&](const char* title, auto rows_of) {
        std::string html =
            fmt::format("<div class=\"card\">\n<h3>{}</h3>\n<div class=\"scroll\"><table>\n<tbody>\n", title);
        for (const auto& row : rows_of(recordings.front())) {
            const auto& name = row.first;
            const auto& value = row.second;
            const bool same = std::ranges::all_of(
                recordings, [&](const LoadedRecording& each) { return value_of(rows_of(each), name) == value; });
            if (same && value != unset_value && !value.empty()) {
                html += fmt::format("<tr><td>{}</td><td><code>{}</code></td></tr>\n", escaped(name), escaped(value));
            }
        }
        return html + "</tbody></table></div></div>\n";
    };
    return "<h2>What all have in common</h2>\n" + table("Settings", [](const LoadedRecording& each) {
        return each.run.settings;
    }) + table("Program and machine", [](const LoadedRecording& each) { return each.run.machine; });
}

/// What a page says of several recordings together: a table with one row each, comparisons among those of the same
/// flight, their curves in common plots, a small plot each with common axes, pictures, and the settings that all share.
/// A recording whose own page lies in its folder is linked from `page_folder`.
std::string several_recordings_html(Recordings recordings, const fs::path& page_folder) {
    return runs_table(recordings, page_folder) + compared_flights_html(recordings) + plot_per_recording(recordings) +
           pictures(recordings) + common_rows(recordings);
}

std::string title_of(const LoadedRecording& recording) {
    return recording.run.title.empty() ? recording.name : recording.run.title;
}

std::string heading(const std::string& text) { return "<h2>" + escaped(text) + "</h2>\n"; }

std::string card(const std::string& inside) { return "<div class=\"card\">\n" + inside + "</div>\n"; }

std::string tile(const char* name, const std::string& value, const std::string& unit) {
    return fmt::format(
        "<div><dt>{}</dt><dd>{} <small>{}</small></dd></div>\n", escaped(name), escaped(value), escaped(unit));
}

std::string badges(const LoadedRecording& recording) {
    const auto badge = [](const char* text, bool bad) {
        return fmt::format("<span class=\"badge{}\">{}</span>\n", bad ? " bad" : "", text);
    };
    std::string html = badge(recording.ended_early ? "ended early" : "ended", recording.ended_early);
    if (!recording.disagreement.empty()) { html += badge("rows and summary disagree", true); }
    if (!recording.run.stopped.empty()) { html += badge("stopped", true); }
    const bool noisy = !recording.run.noise.empty();
    html += badge(noisy ? "noisy" : "quiet machine", noisy);
    if (recording.statistics.frames == 0) { html += badge("no frames", true); }
    std::string notes;
    for (const std::string& reason : recording.run.noise) { notes += reason + " "; }
    if (recording.ended_early) {
        notes += "The flight was cut short: the figures are those of the frames recorded until "
                 "then, and there are no hashes.";
    }
    if (!recording.disagreement.empty()) {
        notes += "Rows are missing or the summary is not theirs; the figures are those of the rows: " +
                 recording.disagreement + ". ";
    }
    if (!recording.run.stopped.empty()) { notes += "Ended by " + recording.run.stopped + ". "; }
    return notes.empty() ? html : html + "<p class=\"note\">" + escaped(notes) + "</p>\n";
}

std::string overview(const LoadedRecording& recording) {
    const Statistics& figures_ms = recording.statistics;
    const double fps = figures_ms.mean_ms > 0.0 ? 1000.0 / figures_ms.mean_ms : 0.0;
    const MachineInfo& machine = recording.run.machine_info;
    std::string html = fmt::format("<p class=\"lead\">{}<br>{}, {} cores</p>\n",
        escaped(title_of(recording) + ", " + machine.start_time_utc), escaped(machine.cpu), machine.cores);
    html += badges(recording);
    html += "<dl class=\"tiles\">\n";
    html += tile("Frames", fmt::format("{}", figures_ms.frames), "counted");
    html += tile("Mean", fmt::format("{:.2f}", figures_ms.mean_ms), "ms");
    html += tile("Rate", fmt::format("{:.1f}", fps), "frames/s");
    html += tile("P50", fmt::format("{:.2f}", figures_ms.p50_ms), "ms");
    html += tile("P99", fmt::format("{:.2f}", figures_ms.p99_ms), "ms");
    html += tile("Longest", fmt::format("{:.2f}", figures_ms.max_ms), "ms");
    html += tile("1 % low", fmt::format("{:.1f}", figures_ms.low_1pct_fps), "frames/s");
    html += tile("Above 16.67 ms", fmt::format("{}", figures_ms.overruns_16ms), "frames");
    if (const TargetRange targets = recording.flight.triangle_targets(); targets.varies()) {
        html += tile("Triangle target", fmt::format("{:.0f}", targets.mean),
            fmt::format("mean of {} to {}", targets.min_triangles, targets.max_triangles));
    }
    return html + "</dl>\n";
}

std::string statistics_table(const LoadedRecording& recording) {
    std::string html = "<div class=\"scroll\"><table>\n<thead><tr><th>Figure</th>"
                       "<th class=\"number\">Value</th><th>Definition</th></tr></thead>\n<tbody>\n";
    for (const Statistic& statistic : all_statistics()) {
        html += fmt::format("<tr><td>{}</td><td class=\"number\">{}</td><td "
                            "class=\"definition\">{}</td></tr>\n",
            escaped(statistic.name), statistic_text(statistic, recording.statistics), escaped(statistic.definition));
    }
    return card(html + "</tbody></table></div>\n<p class=\"note\">frame_ms runs from the start of the frame's "
                       "simulation step to its pixels complete and read; writing pictures and video is outside "
                       "it. n is the number of frames counted. Stress (frames.csv) is the share of a frame's "
                       "time, the simulated time from it to the next, that frame_ms is; where the ground adapts "
                       "it is that share through a first-order filter.</p>\n");
}

std::string rows_table(const char* first, const NamedValues& rows) {
    std::string html =
        fmt::format("<div class=\"scroll\"><table>\n<thead><tr><th>{}</th><th></th></tr></thead>\n<tbody>\n", first);
    for (const auto& [name, value] : rows) {
        html += fmt::format("<tr><td>{}</td><td><code>{}</code></td></tr>\n", escaped(name), escaped(value));
    }
    return card(html + "</tbody></table></div>\n");
}

/// Those that are set; what is not set follows from the others.
NamedValues set_settings_rows(const NamedValues& settings) {
    NamedValues rows;
    std::ranges::copy_if(settings, std::back_inserter(rows),
        [](const auto& row) { return row.second != unset_value && !row.second.empty(); });
    return rows;
}

NamedValues result_rows(const LoadedRecording& recording) {
    NamedValues rows{{"state hash", recording.run.state_hash}, {"picture hash", recording.run.picture_hash},
        {"path offset over the ground (x, y, z), m", recording.run.path_offset}};
    rows.insert(rows.end(), recording.run.facts.begin(), recording.run.facts.end());
    const NamedValues clock = recording.flight.clock.rows();
    rows.insert(rows.end(), clock.begin(), clock.end());
    const NamedValues link = recording.flight.link.rows();
    rows.insert(rows.end(), link.begin(), link.end());
    return rows;
}

std::string plots_html(const LoadedRecording& recording) {
    const double ceiling_ms = plot_ceiling_ms(recording.statistics);
    std::string html = "<div class=\"plots\">\n";
    bool first = true;
    for (Plot& plot : flight_plots(recording.flight, ceiling_ms)) {
        if (plot.x_label.starts_with("simulated time")) { plot.marks = recording.run.legs; }
        html += card(page_plot(plot, first ? PlotWidth::FullWidth : PlotWidth::HalfWidth));
        first = false;
    }
    html += "</div>\n<p class=\"note\">Values under the pointer; drag to zoom, double click for "
            "all of it.";
    if (recording.statistics.max_ms > ceiling_ms) {
        html += " Where a frame took longer than the plot is high, its curve leaves it at the top.";
    }
    return html + "</p>\n";
}

std::string overrun_summary(const LoadedRecording& recording) {
    const auto& counts = recording.flight.slow.above_16_ms();
    std::string text = fmt::format(
        "{} of {} frames took longer than 16.67 ms.", recording.statistics.overruns_16ms, recording.statistics.frames);
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] > 0) { text += fmt::format(" In {} of them {} took most.", counts[i], stage_names[i]); }
    }
    return text;
}

/// The slowest frames with their reasons.
HtmlTable slowest_table(std::span<const SlowFrame> slowest, bool has_counters) {
    HtmlTable table;
    table.header = {"frame", "at, s", "ms", "took most", "ms", "grew most over its median", "triangles", "change"};
    if (has_counters) {
        table.header.insert(table.header.end(), {"page faults", "switches", "stolen, ms"});
        table.note = "Switches: how often another program was given the processor. Stolen: by the "
                     "host for other machines, in the kernel's steps of 10 ms, of all processors.";
    }
    for (const SlowFrame& frame : slowest) {
        std::vector<std::string> row = {fmt::format("{}", frame.record.frame),
            fmt::format("{:.2f}", frame.record.sim_time_s), fmt::format("{:.2f}", frame.record.frame_ms),
            std::string(stage_names[frame.longest_stage]), fmt::format("{:.2f}", frame.stage_ms[frame.longest_stage]),
            fmt::format("{} by {:.2f} ms", stage_names[frame.slowed_stage], frame.slowdown_ms),
            fmt::format("{}", frame.record.terrain_triangles), fmt::format("{:+}", frame.record.triangle_change)};
        if (has_counters) {
            const FrameCounters& counters = frame.record.counters;
            row.insert(row.end(), {fmt::format("{}", counters.page_faults), fmt::format("{}", counters.switches),
                                      fmt::format("{:.0f}", counters.stolen_ms)});
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

/// The kept picture nearest to a frame.
const std::filesystem::path& nearest_picture(std::span<const std::filesystem::path> pictures, int frame) {
    return *std::ranges::min_element(pictures, {}, [&](const std::filesystem::path& picture) {
        return std::abs(picture_frame(picture.filename().string()).value_or(0) - frame);
    });
}

/// The picture of a slow frame: its own, else the kept one nearest to it; empty where there is none.
std::string slow_picture_html(const LoadedRecording& recording, const FrameRecord& frame) {
    constexpr int widest_px = 320;
    const std::string caption = fmt::format("frame {}, {:.2f} ms", frame.frame, frame.frame_ms);
    const auto own = recording.folder / slow_picture_name(frame.frame);
    if (is_file(own)) { return picture_html(own, widest_px, caption); }
    if (recording.pictures.empty()) { return {}; }
    const std::filesystem::path& picture = nearest_picture(recording.pictures, frame.frame);
    const std::string name = picture.filename().string();
    return picture_html(picture, widest_px, caption + ": nearest picture, " + name);
}

std::string slowest_html(const LoadedRecording& recording) {
    const std::vector<SlowFrame>& slowest = recording.slowest;
    std::string sheet;
    for (std::size_t i = 0; i < std::min(SlowPictures::max_shown, slowest.size()); ++i) {
        sheet += slow_picture_html(recording, slowest[i].record);
    }
    return card("<p>" + overrun_summary(recording) + "</p>\n" +
                html_of(slowest_table(slowest, recording.has_counters)) +
                (sheet.empty() ? "" : "<div class=\"sheet\">\n" + sheet + "</div>\n"));
}

std::string one_html(const LoadedRecording& recording) {
    std::string html = card(overview(recording));
    html += heading("Plots") + plots_html(recording);
    const std::string sheet = contact_sheet_html(recording.pictures);
    html += sheet.empty() ? sheet : heading("Pictures") + card(sheet);
    html += heading("Frame times") + statistics_table(recording);
    html += heading("The slowest frames and why") + slowest_html(recording);
    html += heading("Results") + rows_table("Result", result_rows(recording));
    html += heading("Settings") + rows_table("Setting", set_settings_rows(recording.run.settings));
    return html + heading("Program and machine") + rows_table("Entry", recording.run.machine);
}

std::string page_title(Recordings recordings) {
    if (recordings.size() == 1) { return title_of(recordings.front()); }
    return fmt::format("{} flights compared", recordings.size());
}

} // namespace

std::string html_report(
    Recordings recordings, std::span<const HtmlTable> first_tables, const std::filesystem::path& page_folder) {
    std::string html = page_head(page_title(recordings), recordings.size() > 1 ? "several" : "one");
    html +=
        "<header><p class=\"lead\">Octant flight report</p><h1>" + escaped(page_title(recordings)) + "</h1></header>\n";
    for (const HtmlTable& table : first_tables) { html += card(html_of(table)); }
    if (recordings.size() == 1) {
        html += one_html(recordings.front());
    } else if (!recordings.empty()) {
        html += several_recordings_html(recordings, page_folder);
    }
    return html + "</main>\n<div id=\"tip\" hidden></div>\n<script>" + std::string(page_script()) +
           "</script>\n</body>\n</html>\n";
}

} // namespace octant::ui::report
