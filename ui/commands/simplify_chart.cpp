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

namespace octant::ui::commands {

namespace {

using models::meshfile::ChainLevel;
using models::meshfile::LevelChain;

report::Plot plot_of(const LevelChain& chain) {
    report::PlotSeries errors;
    errors.name = "largest distance";
    errors.colour = "#1d6fd1";
    errors.points = true;
    for (const ChainLevel& level : chain.levels) {
        if (level.error_m > 0.0) { // The first one has none, which no logarithmic axis shows.
            errors.x.push_back(static_cast<double>(level.mesh.triangles.size()));
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
std::string spoken(const LevelChain& chain) {
    std::string text;
    for (const ChainLevel& level : chain.levels) {
        text += fmt::format(
            "{}{} faces: {:.3g}",
            text.empty() ? "" : "; ",
            level.mesh.triangles.size(),
            level.error_m);
    }
    return "Largest distance by the number of faces. " + text + ".";
}

/// The picture without what stands before it, with a name and a description.
std::string named_picture(std::string_view svg, const std::string& name, const std::string& text) {
    std::string picture(svg.substr(std::min(svg.find("<svg"), svg.size())));
    for (const auto& [begin, end] :
         {std::pair("<title>", "</title>"), std::pair("<desc>", "</desc>")}) {
        const std::size_t first = picture.find(begin);
        const std::size_t last = picture.find(end);
        if (first != picture.npos && last != picture.npos) {
            picture.erase(first, last + std::string_view(end).size() - first);
        }
    }
    const std::size_t inside = picture.find('>');
    picture.insert(
        inside + 1,
        fmt::format(
            "<title id=\"chart-name\">{}</title><desc id=\"chart-text\">{}</desc>",
            report::escaped(name),
            report::escaped(text)));
    picture.insert(
        std::string_view("<svg").size(),
        " role=\"img\" aria-labelledby=\"chart-name\" aria-describedby=\"chart-text\"");
    return picture;
}

report::HtmlTable table_of(const std::string& mesh, const LevelChain& chain) {
    const double diagonal_m = models::diagonal_m(chain.levels.front().mesh);
    report::HtmlTable table;
    table.header = {"faces", "largest distance", "% of the diagonal", "command"};
    for (const ChainLevel& level : chain.levels) {
        const std::size_t faces = level.mesh.triangles.size();
        const bool is_first = &level == &chain.levels.front();
        table.rows.push_back(
            {fmt::format("{}", faces),
             fmt::format("{:.4g}", level.error_m),
             fmt::format("{:.3g}", 100.0 * level.error_m / diagonal_m),
             is_first ? std::string("the mesh itself")
                      : fmt::format("octant simplify {} OUT --faces {}", mesh, faces)});
    }
    table.note =
        "The largest distance is certified: no point of either surface is farther from the "
        "other one. It is in the units of the file.";
    return table;
}

} // namespace

std::string chart_page(const std::string& mesh, const LevelChain& chain) {
    const auto svg = report::plot_svg(plot_of(chain));
    if (!svg) {
        throw Error(
            "--chart: expected gnuplot on PATH and a mesh that can be simplified, got none");
    }
    const std::string name = "Faces against error of " + mesh;
    return report::page_head(name, "one") + "<header><h1>" + report::escaped(name) +
           "</h1></header>\n<figure class=\"card\" style=\"background:#fff\">\n" +
           named_picture(*svg, name, spoken(chain)) + "</figure>\n<div class=\"card\">\n" +
           report::html_of(table_of(mesh, chain)) + "</div>\n</main>\n</body>\n</html>\n";
}

} // namespace octant::ui::commands
