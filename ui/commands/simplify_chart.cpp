// A page that shows what each level of detail of a mesh costs, so that one can be picked by sight.
#include "ui/commands/simplify_chart.h"

#include "sim/base/error.h"
#include "ui/report/html_style.h"
#include "ui/report/html_text.h"
#include "ui/report/plots.h"

#include <algorithm>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::commands {

namespace {

using Levels = std::vector<ChartLevel>;

report::Plot plot_of(const Levels& levels) {
    report::PlotSeries errors;
    errors.name = "largest distance";
    errors.colour = "#1d6fd1";
    errors.points = true;
    for (const ChartLevel& level : levels) {
        if (level.error_m > 0.0) { // A logarithmic axis shows no exact ones.
            errors.x.push_back(static_cast<double>(level.faces));
            errors.y.push_back(level.error_m);
        }
    }
    report::Plot plot;
    plot.x_label = "faces";
    plot.y_label = "largest distance to the mesh, in its units";
    plot.x_logarithmic = true;
    plot.y_logarithmic = true;
    plot.height_px = 420;
    plot.series.push_back(std::move(errors));
    return plot;
}

/// What a screen reader says of the plot.
std::string chart_alt_text(const Levels& levels) {
    std::string text;
    for (const ChartLevel& level : levels) {
        text += fmt::format("{}{} faces: {:.3g}", text.empty() ? "" : "; ", level.faces, level.error_m);
    }
    return "Largest distance by the number of faces. " + text + ".";
}

/// The picture without what stands before it, with a name and a description.
std::string named_picture(std::string_view svg, const std::string& name, const std::string& text) {
    std::string picture(svg.substr(std::min(svg.find("<svg"), svg.size())));
    for (const auto& [begin, end] : {std::pair("<title>", "</title>"), std::pair("<desc>", "</desc>")}) {
        const std::size_t first = picture.find(begin);
        const std::size_t last = picture.find(end);
        if (first != picture.npos && last != picture.npos) {
            picture.erase(first, last + std::string_view(end).size() - first);
        }
    }
    const std::size_t inside = picture.find('>');
    picture.insert(inside + 1, fmt::format("<title id=\"chart-name\">{}</title><desc id=\"chart-text\">{}</desc>",
                                   report::escaped(name), report::escaped(text)));
    picture.insert(std::string_view("<svg").size(),
        " role=\"img\" aria-labelledby=\"chart-name\" aria-describedby=\"chart-text\"");
    return picture;
}

report::HtmlTable table_of(const Levels& levels, double diagonal_m) {
    report::HtmlTable table;
    table.header = {"faces", "largest distance", "% of the diagonal", "made by"};
    for (const ChartLevel& level : levels) {
        table.rows.push_back({fmt::format("{}", level.faces), fmt::format("{:.4g}", level.error_m),
            fmt::format("{:.3g}", 100.0 * level.error_m / diagonal_m), level.made_by});
    }
    table.note = "The largest distance is certified: no point of either surface is farther from the "
                 "other one. It is in the units of the file, before coordinates are rounded by the format "
                 "of OUT.";
    return table;
}

} // namespace

std::string chart_page(const std::string& mesh, const Levels& levels, double diagonal_m) {
    const std::string name = "Faces against error of " + mesh;
    std::string figure;
    const report::Plot plot = plot_of(levels);
    if (!plot.series.front().x.empty()) {
        const auto svg = report::plot_svg(plot);
        if (!svg) { throw Error("--chart: expected gnuplot on PATH, got none"); }
        figure = "<figure class=\"card\" style=\"background:#fff\">\n" +
                 named_picture(*svg, name, chart_alt_text(levels)) + "</figure>\n";
    }
    return report::page_head(name, "one") + "<header><h1>" + report::escaped(name) + "</h1></header>\n" + figure +
           "<div class=\"card\">\n" + report::html_of(table_of(levels, diagonal_m)) +
           "</div>\n</main>\n</body>\n</html>\n";
}

} // namespace octant::ui::commands
