#include "ui/report/plots.h"

#include "ui/report/html_text.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <span>
#include <string_view>

namespace octant::ui::report {

namespace {

// A plot's numbers stand as JSON in its element: {x, y: labels, x0, x1, y0, y1: ends of the axes or null, xlog, log: of
// y, levels: [[name, y]], marks: [[name, x]], bar: width, series: [{n: name, c: colour, s:
// "line"|"points"|"area"|"bars", x: [], y: [], l: []}]}. Text is 12 px whatever the width.
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
function draw(box) {
  const plot = box.plot, small = box.classList.contains("small");
  const width = Math.max(160, box.clientWidth), height = Number(box.dataset.height);
  const left = small ? 42 : 66, right = 12, top = plot.marks.length ? 30 : 10, bottom = small ? 22 : 40;
  box.querySelectorAll("svg").forEach(old => old.remove());
  const svg = node("svg", {width, height, viewBox: `0 0 ${width} ${height}`, role: "img",
    "aria-label": box.querySelector("h3").textContent}, box);
  const [xa, xb] = ends(plot, "x", false), [ya, yb] = ends(plot, "y", true);
  const half = plot.series.some(s => s.s === "bars") ? plot.bar / 2 : 0;
  const x0 = box.zoom ? box.zoom[0] : plot.x0 ?? (plot.xlog ? xa / 1.1 : xa - half);
  const x1 = box.zoom ? box.zoom[1] : plot.x1 ?? (plot.xlog ? xb * 1.1 : xb + half);
  const y0 = plot.y0 ?? (plot.log ? ya / 1.2 : ya - 0.05 * (yb - ya));
  const y1 = plot.log ? Math.max(plot.y1 ?? yb * 1.2, 5 * y0) : plot.y1 ?? yb + 0.05 * (yb - ya);
  const part = (v, from, to, log) => log ? Math.log(Math.max(v, from) / from) / Math.log(to / from) : (v - from) / (to - from);
  const px = x => left + part(x, x0, x1, plot.xlog) * (width - left - right);
  const py = y => height - bottom - part(y, y0, y1, plot.log) * (height - top - bottom);
  const id = "c" + (draw.count = (draw.count || 0) + 1);
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
    static constexpr std::array names{"line", "points", "area", "bars"};
    const char* const style = names[static_cast<std::size_t>(series.style)];
    std::string json = fmt::format(R"({{"n":{},"c":{},"s":"{}","x":{},"y":{})", json_string(series.name),
        json_string(series.colour), style, list(series.x), list(series.y));
    if (series.style == Style::Area) { json += ",\"l\":" + list(series.y_low); }
    return json + "}";
}

std::string plot_json(const Plot& plot) {
    std::string json = fmt::format(R"({{"x":{},"y":{},"x0":{},"x1":{},"y0":{},"y1":{},"xlog":{},"log":{},"bar":{},)",
        json_string(plot.x_label), json_string(plot.y_label), number(plot.x_min), number(plot.x_max),
        number(plot.y_min), number(plot.y_max), plot.x_logarithmic, plot.y_logarithmic, number(plot.bar_width));
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

std::string_view page_script() { return drawing; }

} // namespace octant::ui::report
