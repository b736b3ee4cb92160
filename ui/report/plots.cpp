#include "ui/report/plots.h"

#include "ui/report/html_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <set>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::report {

namespace {

constexpr std::size_t max_printed_plots = 60; ///< of a list, as the page's style sheet and script have it

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

/// Pairs of a name and a number.
template <class Items, class Number>
std::string pairs(const Items& items, Number number_of) {
    std::string text = "[";
    for (const auto& item : items) {
        text += fmt::format("{}[{},{}]", text.size() > 1 ? "," : "", script_string(item.name), number(number_of(item)));
    }
    return text + "]";
}

std::string series_json(const PlotSeries& series) {
    using Style = PlotSeries::Style;
    static constexpr std::array names{"line", "points", "area", "bars"};
    const char* const style = names[static_cast<std::size_t>(series.style)];
    std::string json = series.shared_curve ? fmt::format(R"({{"k":{})", *series.shared_curve)
                                           : fmt::format(R"({{"n":{},"x":{},"y":{})", script_string(series.name),
                                                 list(series.x), list(series.y));
    if (series.shared_curve && !series.name.empty()) { json += ",\"g\":" + script_string(series.name); }
    json += fmt::format(R"(,"c":{},"s":"{}")", script_string(series.colour), style);
    if (series.style == Style::Area) { json += ",\"l\":" + list(series.y_low); }
    return json + "}";
}

/// Names and values in JSON of what the script needs of a plot, but for its series.
std::vector<std::pair<std::string_view, std::string>> members_of(const Plot& plot) {
    return {{"x", script_string(plot.x_label)}, {"y", script_string(plot.y_label)}, {"x0", number(plot.x_min)},
        {"x1", number(plot.x_max)}, {"y0", number(plot.y_min)}, {"y1", number(plot.y_max)},
        {"xlog", fmt::format("{}", plot.x_logarithmic)}, {"log", fmt::format("{}", plot.y_logarithmic)},
        {"bar", number(plot.bar_width)},
        {"levels", pairs(plot.levels, [](const PlotReferenceLine& level) { return level.y; })},
        {"marks", pairs(plot.marks, [](const PlotMark& mark) { return mark.x; })}};
}

std::string series_list_json(const Plot& plot) {
    std::string json = "\"series\":[";
    for (const PlotSeries& series : plot.series) {
        json += &series == &plot.series.front() ? "" : ",";
        json += series_json(series);
    }
    return json + "]";
}

std::string plot_json(const Plot& plot) {
    std::string json = "{";
    for (const auto& [name, value] : members_of(plot)) { json += fmt::format("\"{}\":{},", name, value); }
    return json + series_list_json(plot) + "}";
}

/// A plot of a list: its title, its series and what is not the same as in the list's first plot.
std::string listed_plot_json(const Plot& plot, const Plot& first) {
    std::string json = plot.title.empty() ? "{" : fmt::format("{{\"title\":{},", script_string(plot.title));
    const auto common = members_of(first);
    const auto own = members_of(plot);
    for (std::size_t i = 0; i < own.size(); ++i) {
        if (own[i] != common[i]) { json += fmt::format("\"{}\":{},", own[i].first, own[i].second); }
    }
    return json + series_list_json(plot) + "}";
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

/// What readers without script see: a note and pictures.
std::string without_script(std::string_view pictures) {
    return fmt::format("<noscript>{}{}</noscript>", note_html("Plots are drawn by the page's script."), pictures);
}

/// The plot with the points of its shared curves, and names as the script shows them.
Plot with_points(Plot plot, std::span<const PlotSeries> curves) {
    std::set<std::string> groups;
    if (plot.title.empty()) { plot.title = curves[*plot.series.front().shared_curve].name; }
    for (PlotSeries& series : plot.series) {
        const PlotSeries& curve = curves[*series.shared_curve];
        if (series.name.empty()) {
            series.name = curve.name;
        } else if (!groups.insert(series.name).second) {
            series.name.clear(); // the first of them stands for all
        }
        series.x = curve.x;
        series.y = curve.y;
    }
    return plot;
}

int height_px(PlotWidth width) { return width == PlotWidth::FullWidth ? 320 : (width == PlotWidth::Small ? 130 : 260); }

/// Class of a plot's box, with a space before it.
const char* look_of(PlotWidth width) {
    return width == PlotWidth::FullWidth ? " wide" : (width == PlotWidth::Small ? " small" : "");
}

} // namespace

std::string page_plot(const Plot& plot, PlotWidth width, PlotPicture picture_of) {
    return fmt::format("<div class=\"plot{}\" data-height=\"{}\"><h3>{}</h3>{}"
                       "<script type=\"application/json\">{}</script>{}</div>\n",
        look_of(width), height_px(width), escaped(plot.title),
        width == PlotWidth::Small ? std::string() : key_html(plot), plot_json(plot),
        without_script(picture_of != nullptr ? picture_of(plot) : std::string()));
}

std::string page_curves(std::span<const PlotSeries> curves) {
    std::string json = "[";
    for (const PlotSeries& curve : curves) {
        json += &curve == &curves.front() ? "" : ",\n";
        json += fmt::format(R"({{"n":{},"x":{},"y":{}}})", script_string(curve.name), list(curve.x), list(curve.y));
    }
    return fmt::format("<script type=\"application/json\" id=\"curves\">{}]</script>\n", json);
}

std::string page_plot_list(
    std::span<const Plot> plots, std::span<const PlotSeries> curves, PlotWidth width, PlotPicture picture_of) {
    constexpr std::size_t max_pictures = 12;
    if (plots.empty()) { return {}; }
    std::string common;
    for (const auto& [name, value] : members_of(plots.front())) {
        common += fmt::format("{}\"{}\":{}", common.empty() ? "" : ",", name, value);
    }
    std::string list;
    for (const Plot& plot : plots) { list += (list.empty() ? "" : ",\n") + listed_plot_json(plot, plots.front()); }
    std::string html =
        fmt::format("<div class=\"scroll tall plot-list\"><div class=\"many{}\"></div>"
                    "<script type=\"application/json\">{{\"look\":\"{}\",\"height\":{},\"common\":{{{}}},"
                    "\"plots\":[{}]}}</script></div>\n",
            width == PlotWidth::Small ? " small-plots" : (width == PlotWidth::HalfWidth ? " plots" : ""),
            look_of(width), height_px(width), common, list);
    std::string pictures;
    for (const Plot& plot : plots.first(picture_of != nullptr ? std::min(plots.size(), max_pictures) : 0)) {
        pictures += picture_of(with_points(plot, curves));
    }
    html += without_script(pictures) + "\n";
    if (plots.size() > max_printed_plots) {
        html += fmt::format("<p class=\"note print-only\">The first {} of {} plots are printed.</p>\n",
            max_printed_plots, plots.size());
    }
    return html;
}

} // namespace octant::ui::report
