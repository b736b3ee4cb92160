#include "ui/base/json_value.h"
#include "ui/report/plots.h"
#include "ui/report/table.h"

#include <catch2/catch.hpp>

#include <array>
#include <fmt/format.h>
#include <limits>

using namespace octant;
using namespace octant::ui::report;
using Catch::Contains;

namespace {

struct Run {
    std::string name;
    int faces = 0;
    double time_ms = 0.0;
    std::optional<double> ratio;
    bool done = false;
    std::uint64_t hash = 0;
};

constexpr std::array columns{column<&Run::name>("name", "run"), column<&Run::faces>("faces", "faces"),
    column<&Run::time_ms>("time_ms", "time, ms", 2, "Median."), column<&Run::ratio>("ratio", "ratio", -3),
    column<&Run::done>("done", "done"), hash_column<&Run::hash>("hash", "hash")};

const Run first{"a, b", 12, 1.239, 0.12345, true, 0xabc};
const Run second{"c", 3, 20.0, {}, false, 1};

} // namespace

TEST_CASE("a table is written as CSV, Markdown, JSON and text") {
    ResultTable table{.title = "Speed", .note = "measured"};
    table.add({{"name", "a"}, {"ms, median", "{:.1f}", 1.5}});
    table.add({{"name", "b, \"c\""}, {"ms, median", ""}});
    CHECK_THAT(markdown_of(std::vector<ResultTable>{{.title = "a", .header = {"x|y"}}}), Contains("| x\\|y |"));
    CHECK(csv_of(table) == "name,\"ms, median\"\na,1.5\n\"b, \"\"c\"\"\",\n");
    CHECK(markdown_of(std::span(&table, 1)) ==
          "# Speed\n\n| name | ms, median |\n| --- | --- |\n| a | 1.5 |\n| b, \"c\" |  |\n\nmeasured\n");
    const std::string json = json_of(std::span<const ResultTable>(&table, 1));
    CHECK_THAT(json, Contains("\"ms, median\": 1.5") && Contains(R"("name": "b, \"c\"")"));
    CHECK(text_of(table) == "name    ms, median\na       1.5\nb, \"c\"  \n");
}

TEST_CASE("a table is LaTeX with its units in a line of their own, and nothing special left as it is") {
    ResultTable table{.note = "95 % of #1"};
    table.add({{"name", "a_b{c}\\d"}, {"median, ms", "{:.1f}", -1.5}, {"n", ""}});
    table.add({{"name", "--<x>|\"~^$&"}, {"median, ms", "2.0"}, {"n", 3}});
    CHECK(latex_of(table) ==
          "{\\footnotesize\\setlength{\\tabcolsep}{3pt}\\noindent\n"
          "\\begin{tabular}{@{}lrr@{}}\n\\toprule\nname & median & n \\\\\n & ms &  \\\\\n\\midrule\n"
          "a\\_b\\{c\\}\\textbackslash{}d & $-1.5$ &  \\\\\n"
          "-{}-{}\\textless{}x\\textgreater{}\\textbar{}{''}\\textasciitilde{}\\textasciicircum{}\\$\\& & 2.0 & "
          "3 \\\\\n\\bottomrule\n\\end{tabular}\n\n\\smallskip\\noindent\n95 \\% of \\#1\n\\par}\n");
    ResultTable long_table;
    for (int i = 0; i < 46; ++i) { long_table.add({{"i", i}}); }
    const std::string latex = latex_of(long_table);
    CHECK(latex.find("\\begin{tabular}", latex.find("44 \\")) < latex.find("45 \\"));
}

TEST_CASE("a row is written as CSV, JSON, cells and schema from one list of columns") {
    CHECK(csv_header(columns) == "name,faces,time_ms,ratio,done,hash\n");
    CHECK(csv_line(columns, first) == "\"a, b\",12,1.24,0.123,1,0000000000000abc\n");
    CHECK(csv_line(columns, second) == "c,3,20.00,,0,0000000000000001\n");
    CHECK(ui::base::json_of_results(json_of(columns, first)) ==
          "{\n  \"name\": \"a, b\",\n  \"faces\": 12,\n  \"time_ms\": 1.239,\n  \"ratio\": 0.12345,\n"
          "  \"done\": true,\n  \"hash\": \"0000000000000abc\"\n}\n");
    CHECK_THAT(ui::base::json_of_results(json_of(columns, second)), Contains("\"ratio\": null"));
    ResultTable table;
    table.add(cells_of(columns, first));
    table.add(cells_of(columns, second));
    CHECK(text_of(table) == "run   faces  time, ms  ratio  done  hash\n"
                            "a, b     12      1.24  0.123     1  0000000000000abc\n"
                            "c         3     20.00            0  0000000000000001\n");
    const std::string schema = ui::base::json_of_results(schema_of(columns));
    CHECK_THAT(schema, Contains("\"time_ms\": {\n      \"type\": \"number\",\n      \"minimum\": 0,\n"
                                "      \"description\": \"Median.\"\n    }"));
    CHECK_THAT(schema, Contains("\"number\",\n        \"null\"") && Contains("\"pattern\": \"^[0-9a-f]{16}$\""));
}

TEST_CASE("a plot stands in a page with its data, gaps, axes and quotes") {
    Plot plot{"<Title>", "x", "it's \"y\"", {}, {{"limit", 2.5}}, 0.0};
    plot.x_logarithmic = true;
    plot.marks = {{"leg", 1.5}};
    plot.series = {{"a < b", "#102030", PlotSeries::Style::Points, {1, 2, 3}, {4, 0, 6}},
        {"", "#405060", PlotSeries::Style::Area, {1, 2}, {3, 4}, {1, 2}}};
    plot.series[0].y[1] = std::numeric_limits<double>::quiet_NaN();
    const std::string html = page_plot(plot, PlotWidth::FullWidth);
    CHECK_THAT(html, Contains("<h3>&lt;Title&gt;</h3>") && Contains("a &lt; b</span>"));
    CHECK_THAT(
        html, Contains(R"("y":"it's \u0022y\u0022","x0":null,"x1":null,"y0":0,"y1":null,"xlog":true,"log":false)"));
    CHECK_THAT(html, Contains(R"("levels":[["limit",2.5]],"marks":[["leg",1.5]])"));
    CHECK_THAT(html, Contains(R"({"n":"a \u003c b","x":[1,2,3],"y":[4,null,6],"c":"#102030","s":"points"})"));
    CHECK_THAT(html, Contains(R"({"n":"","x":[1,2],"y":[3,4],"c":"#405060","s":"area","l":[1,2]})"));
    CHECK(page_plot(plot, PlotWidth::FullWidth) == html);
    plot.series[0].name = "</script>";
    const std::string attack = page_plot(plot, PlotWidth::Small);
    CHECK_THAT(attack, Contains("\"n\":\"\\u003c/script>\"") && Contains("[[\"leg\",1.5]]"));
    CHECK(attack.find("</script>") == attack.rfind("</script>"));
}

TEST_CASE("plots of a list share their curves and what the first of them has") {
    const std::array curves{PlotSeries{"a\xFF", "", PlotSeries::Style::Line, {1, 2}, {3, 4}}};
    CHECK(page_curves(curves) ==
          "<script type=\"application/json\" id=\"curves\">[{\"n\":\"a\uFFFD\",\"x\":[1,2],\"y\":[3,4]}]</script>\n");
    std::vector<Plot> plots(70, Plot{"", "s", "ms"});
    for (Plot& plot : plots) { plot.series = {{.name = "", .colour = "#102030", .shared_curve = 0}}; }
    plots[1].title = "</script>";
    plots[1].y_max = 7.0;
    const std::string html = page_plot_list(plots, curves, PlotWidth::Small);
    CHECK_THAT(html, Contains(R"("common":{"x":"s","y":"ms","x0":null,)"));
    CHECK_THAT(html, Contains("\"plots\":[{\"series\":[{\"k\":0,\"c\":\"#102030\",\"s\":\"line\"}]},\n"
                              "{\"title\":\"\\u003c/script>\",\"y1\":7,\"series\""));
    CHECK_THAT(html, Contains("The first 60 of 70 plots are printed."));
    CHECK(page_plot_list({}, curves, PlotWidth::Small).empty());
    const std::string pictured = page_plot_list(plots, curves, PlotWidth::Small,
        [](const Plot& each) { return fmt::format("<i>{}</i>", each.series[0].y[1]); });
    CHECK_THAT(pictured, Contains("<i>4</i><i>4</i>"));
}
