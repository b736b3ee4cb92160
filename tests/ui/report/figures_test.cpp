#include "ui/report/figures.h"

#include <catch2/catch.hpp>

#include <cstddef>
#include <limits>
#include <string>

using namespace octant::ui::report;
using Catch::Contains;

namespace {

constexpr double gap = std::numeric_limits<double>::quiet_NaN();

/// Two curves with a band, a gap, a level and marks.
Plot two_curves() {
    Plot plot{"Times of \"a\" & b", "time, s", "ms"};
    plot.series = {{"", "#0072b2", PlotSeries::Style::Area, {0, 1, 2, 3}, {3, 4, gap, 5}, {1, 2, gap, 3}},
        {"old", "#0072b2", PlotSeries::Style::Line, {0, 1, 2, 3}, {2, 3, gap, 4}},
        {"new", "#d55e00", PlotSeries::Style::Line, {0, 1, 2, 3}, {1, 2, 3, 3}}};
    plot.levels = {{"limit", 2.5}};
    plot.marks = {{"climb", 1.0}};
    return plot;
}

std::size_t occurrences_of(const std::string& text, const std::string& word) {
    std::size_t count = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) { ++count; }
    return count;
}

/// The number behind `name="` in an SVG file.
double attribute(const std::string& svg, const std::string& name) {
    const std::string before = " " + name + "=\"";
    return std::stod(svg.substr(svg.find(before) + before.size()));
}

} // namespace

TEST_CASE("a figure has the size that is asked for and the same bytes every time") {
    const std::string svg = figure_svg(two_curves());
    CHECK(attribute(svg, "width") == Approx(88.0 / 25.4 * 72.0).margin(0.01));
    CHECK(attribute(svg, "height") == Approx(58.0 / 25.4 * 72.0).margin(0.01));
    CHECK_THAT(svg, Contains("role=\"img\" aria-label=\"Times of &quot;a&quot; &amp; b\""));
    CHECK(figure_svg(two_curves()) == svg);
    const std::string pdf = figure_pdf(two_curves());
    CHECK(figure_pdf(two_curves()) == pdf);
    CHECK_THAT(pdf, Catch::StartsWith("%PDF-") && Contains("/FontFile") && Contains("/Count 1"));
    CHECK_THAT(pdf, !Contains("CreationDate") && !Contains("ModDate"));
}

TEST_CASE("figures of one page share no ids") {
    Plot other = two_curves();
    other.series.pop_back();
    const std::string first = figure_svg(two_curves());
    const std::string second = figure_svg(other);
    const std::size_t at = first.find("id=\"");
    const std::string id = first.substr(at, first.find('"', at + 4) - at);
    CHECK_THAT(second, !Contains(id));
    CHECK_THAT(first, !Contains("id=\"surface") && !Contains("id=\"glyph") && !Contains("\"#glyph"));
    CHECK(occurrences_of(first, "href=\"#f") == occurrences_of(first, "href=\""));
}

TEST_CASE("curves are told apart without colour only where there are several") {
    Plot plot = two_curves();
    plot.levels.clear();
    plot.marks.clear();
    const std::size_t dashed = occurrences_of(figure_svg(plot), "stroke-dasharray");
    CHECK(dashed == 2); // the second curve and its sample in the key
    plot.series.pop_back();
    CHECK(occurrences_of(figure_svg(plot), "stroke-dasharray") == 0);
}

TEST_CASE("a figure grows where names need more height, and cuts a name that is wider than it") {
    Plot plot = two_curves();
    plot.series.clear();
    for (int i = 0; i < 20; ++i) {
        plot.series.push_back(
            {std::string(400, 'w') + std::to_string(i), "#000000", PlotSeries::Style::Line, {0, 1}, {0, 1}});
    }
    CHECK(attribute(figure_svg(plot), "height") > 20.0 * 9.0 + 60.0);
}

TEST_CASE("every kind of series, axis and fault of data makes a figure") {
    Plot plot{"\xff bytes", "x \xff", "y"};
    CHECK_THAT(figure_svg(plot), Contains("<svg") && Contains("aria-label"));
    plot.series = {{"bars", "red", PlotSeries::Style::Bars, {1, 2, 3}, {1, gap, 3}},
        {"points", "#12345", PlotSeries::Style::Points, {1, 10, 100}, {0, -1, 5}},
        {"empty", "#123456", PlotSeries::Style::Line, {}, {}},
        {"area", "#123456", PlotSeries::Style::Area, {1, 2}, {3, 4}, {1, gap}},
        {"one", "#123456", PlotSeries::Style::Line, {5}, {5}}};
    for (const bool logarithmic : {false, true}) {
        plot.x_logarithmic = plot.y_logarithmic = logarithmic;
        CHECK_THAT(figure_svg(plot), !Contains("nan") && !Contains("inf"));
        CHECK_THAT(figure_pdf(plot), Catch::StartsWith("%PDF-"));
    }
    plot.series = {{"flat", "#000000", PlotSeries::Style::Line, {1, 1}, {2, 2}}};
    plot.x_logarithmic = true;
    CHECK_THAT(figure_svg(plot), !Contains("nan") && !Contains("inf"));
}
