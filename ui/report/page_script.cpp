#include "ui/report/page_script.h"

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

} // namespace

std::string_view page_script() { return drawing; }

} // namespace octant::ui::report
