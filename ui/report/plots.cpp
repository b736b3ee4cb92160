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

} // namespace octant::ui::report
