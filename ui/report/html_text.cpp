#include "ui/report/html_text.h"

#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "ui/report/plots.h"

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
h1 { font-size: 1.75rem; line-height: 1.2; margin: 0 0 .25rem; }
h2 { font-size: 1.15rem; margin: 2.2rem 0 .7rem; }
h3 { font-size: 1rem; margin: 0 0 .5rem; overflow-wrap: anywhere; }
.lead, .note, figcaption { color: var(--soft); }
.lead { margin: 0; }
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
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: .9rem; }
th, td { text-align: left; padding: .32rem .8rem .32rem 0; border-bottom: 1px solid var(--line); vertical-align: top; overflow-wrap: anywhere; }
th { color: var(--soft); font-weight: 600; }
tbody tr:last-child td { border-bottom: 0; }
td:first-child:not(.number) { min-width: 9rem; width: 22%; }

.number { text-align: right; padding-right: 1.6rem; font-variant-numeric: tabular-nums; white-space: nowrap; }
table.sortable th { cursor: pointer; white-space: normal; }
table.sortable th[aria-sort=ascending]::after { content: " \25B2"; }
table.sortable th[aria-sort=descending]::after { content: " \25BC"; }
table.runs { width: auto; }
table.runs th { overflow-wrap: normal; }
table.runs td { white-space: nowrap; overflow-wrap: normal; }
table.runs td:first-child { width: auto; min-width: 13rem; white-space: normal; overflow-wrap: anywhere; }
table.runs .number { padding-right: 1.6rem; }
.card h3 { margin-top: .6rem; }
.card > h3:first-child, .small-plots h3 { margin-top: 0; }
a { color: var(--accent); }
td.soft { color: var(--soft); }
.better { color: var(--good); }
.worse { color: var(--bad); }
td.definition { color: var(--soft); }
.code { font: .86em ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace; overflow-wrap: anywhere; }
.sheet { display: grid; gap: .8rem; grid-template-columns: repeat(auto-fill, minmax(240px, 1fr)); }
figure { margin: 0; }
figure img { display: block; width: 100%; height: auto; border-radius: 6px; border: 1px solid var(--line); }
figcaption { font-size: .8rem; padding-top: .2rem; overflow-wrap: anywhere; }
.note + .sheet { margin-top: .8rem; }
.missing { border: 1px dashed var(--line); border-radius: 6px; padding: 1rem; }
@media (max-width: 800px) {
  .plots { grid-template-columns: minmax(0, 1fr); }
}
@media print {
  :root { --page: #fff; --card: #fff; --ink: #000; --soft: #444; --line: #bbb; }
  body { padding: 0; font-size: 10pt; }
  .card, figure, tr { break-inside: avoid; }
  .sheet { grid-template-columns: repeat(4, 1fr); }
  h2 { break-after: avoid; }
}
)css";

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
        "</main>\n<div id=\"tip\" hidden></div>\n<script>{}</script>\n</body>\n</html>\n", page_script());
}

} // namespace octant::ui::report
