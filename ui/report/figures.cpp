#include "ui/report/figures.h"

#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/lazy_library.h"
#include "sim/base/text_file.h"
#include "ui/report/html_text.h"

#include <algorithm>
#include <array>
#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::report {

namespace {

constinit LazyLibrary cairo_library(OCTANT_CAIRO_FILE);

#define OCTANT_CAIRO(name) const LazyFunction<decltype(::name)> name(cairo_library, #name)
OCTANT_CAIRO(cairo_arc);
OCTANT_CAIRO(cairo_clip);
OCTANT_CAIRO(cairo_close_path);
OCTANT_CAIRO(cairo_create);
OCTANT_CAIRO(cairo_destroy);
OCTANT_CAIRO(cairo_fill);
OCTANT_CAIRO(cairo_font_options_create);
OCTANT_CAIRO(cairo_font_options_destroy);
OCTANT_CAIRO(cairo_font_options_set_hint_metrics);
OCTANT_CAIRO(cairo_font_options_set_hint_style);
OCTANT_CAIRO(cairo_image_surface_create);
OCTANT_CAIRO(cairo_image_surface_get_data);
OCTANT_CAIRO(cairo_image_surface_get_stride);
OCTANT_CAIRO(cairo_line_to);
OCTANT_CAIRO(cairo_move_to);
OCTANT_CAIRO(cairo_new_path);
OCTANT_CAIRO(cairo_paint);
OCTANT_CAIRO(cairo_pdf_surface_create_for_stream);
OCTANT_CAIRO(cairo_pdf_surface_set_metadata);
OCTANT_CAIRO(cairo_rectangle);
OCTANT_CAIRO(cairo_restore);
OCTANT_CAIRO(cairo_rotate);
OCTANT_CAIRO(cairo_save);
OCTANT_CAIRO(cairo_select_font_face);
OCTANT_CAIRO(cairo_set_dash);
OCTANT_CAIRO(cairo_set_font_options);
OCTANT_CAIRO(cairo_set_font_size);
OCTANT_CAIRO(cairo_set_line_join);
OCTANT_CAIRO(cairo_set_line_width);
OCTANT_CAIRO(cairo_set_source_rgba);
OCTANT_CAIRO(cairo_show_text);
OCTANT_CAIRO(cairo_status);
OCTANT_CAIRO(cairo_status_to_string);
OCTANT_CAIRO(cairo_stroke);
OCTANT_CAIRO(cairo_surface_destroy);
OCTANT_CAIRO(cairo_surface_finish);
OCTANT_CAIRO(cairo_surface_flush);
OCTANT_CAIRO(cairo_surface_set_device_scale);
OCTANT_CAIRO(cairo_surface_status);
OCTANT_CAIRO(cairo_svg_surface_create_for_stream);
OCTANT_CAIRO(cairo_text_extents);
OCTANT_CAIRO(cairo_translate);
#undef OCTANT_CAIRO

// Lengths are in points, from the upper left corner of the figure.

constexpr double points_per_mm = 72.0 / 25.4;
constexpr double font_size = 7.0;
constexpr double row_height = 9.0;
constexpr double gap = 3.0;
constexpr double sample_width = 18.0; ///< of a curve in the key
constexpr double min_plot_height = 60.0;

struct DestroySurface {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};

struct DestroyContext {
    void operator()(cairo_t* context) const { cairo_destroy(context); }
};

using SurfacePointer = std::unique_ptr<cairo_surface_t, DestroySurface>;
using ContextPointer = std::unique_ptr<cairo_t, DestroyContext>;

void check_cairo(cairo_status_t status) {
    if (status != CAIRO_STATUS_SUCCESS) { throw Error(fmt::format("cairo: {}", cairo_status_to_string(status))); }
}

ContextPointer context_of(cairo_surface_t* surface) {
    ContextPointer context(cairo_create(surface));
    cairo_select_font_face(context.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context.get(), font_size);
    cairo_set_line_join(context.get(), CAIRO_LINE_JOIN_ROUND);
    cairo_font_options_t* const options = cairo_font_options_create();
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_set_font_options(context.get(), options);
    cairo_font_options_destroy(options);
    return context;
}

double width_of(cairo_t* context, const std::string& text) {
    cairo_text_extents_t extents{};
    cairo_text_extents(context, text.c_str(), &extents);
    return extents.x_advance;
}

/// The text, cut where it is wider than that.
std::string fitted(cairo_t* context, std::string text, double max_width) {
    if (width_of(context, text) <= max_width) { return text; }
    while (!text.empty() && width_of(context, text + "...") > max_width) {
        do { text.pop_back(); } while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0U) == 0x80U);
        if (!text.empty() && utf8_length(text.substr(text.size() - 1)) == 0) { text.pop_back(); }
    }
    return text + "...";
}

struct Rgba {
    double red, green, blue, alpha;
};

constexpr Rgba ink{0.0, 0.0, 0.0, 1.0};
constexpr Rgba soft_ink{0.35, 0.35, 0.35, 1.0};
constexpr Rgba grid_grey{0.87, 0.87, 0.87, 1.0};

/// "#rrggbb"; black for anything else.
Rgba colour_of(const std::string& text, double alpha) {
    if (text.size() != 7 || text[0] != '#') { return {0.0, 0.0, 0.0, alpha}; }
    const auto rgb = static_cast<unsigned>(std::strtoul(text.c_str() + 1, nullptr, 16));
    const auto channel = [&](unsigned shift) { return static_cast<double>((rgb >> shift) & 0xFFU) / 255.0; };
    return {channel(16), channel(8), channel(0), alpha};
}

void set_colour(cairo_t* context, const Rgba& colour) {
    cairo_set_source_rgba(context, colour.red, colour.green, colour.blue, colour.alpha);
}

/// Dashes of named curves, by their rank.
void set_dash(cairo_t* context, std::size_t rank) {
    static constexpr std::array<std::array<double, 4>, 6> dashes{{{}, {4.0, 1.6, 4.0, 1.6}, {1.2, 1.4, 1.2, 1.4},
        {6.0, 1.6, 1.2, 1.6}, {2.4, 1.2, 2.4, 1.2}, {8.0, 2.0, 8.0, 2.0}}};
    const auto& dash = dashes[rank % dashes.size()];
    cairo_set_dash(context, dash.data(), dash[0] > 0.0 ? 4 : 0, 0.0);
}

/// A small filled shape around a place, by the rank of its curve.
void draw_marker(cairo_t* context, std::size_t rank, double x, double y) {
    constexpr double radius = 1.7;
    static const std::array<std::vector<std::pair<double, double>>, 5> corners{
        {{}, {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {{-1.2, 1}, {0, -1.3}, {1.2, 1}},
            {{-1.4, 0}, {0, -1.4}, {1.4, 0}, {0, 1.4}}, {{-1.2, -1}, {0, 1.3}, {1.2, -1}}}};
    cairo_set_dash(context, nullptr, 0, 0.0);
    cairo_new_path(context);
    const auto& shape = corners[rank % corners.size()];
    if (shape.empty()) { cairo_arc(context, x, y, radius, 0.0, 6.283185307179586); }
    for (const auto& [right, down] : shape) { cairo_line_to(context, x + radius * right, y + radius * down); }
    cairo_close_path(context);
    cairo_fill(context);
}

/// Ends of an axis, and where its plane begins and ends on paper.
struct FigureAxis {
    double from = 0.0;
    double to = 1.0;
    bool is_logarithmic = false;
    double begin = 0.0;
    double end = 0.0;

    double place(double value) const {
        const double share = is_logarithmic ? std::log(std::max(value, from) / from) / std::log(to / from)
                                            : (value - from) / (to - from);
        return begin + share * (end - begin);
    }
};

/// Numbers at round steps, some `count` of them; only whole ones if asked for.
std::vector<double> round_steps(double from, double to, double count, bool is_whole) {
    const double raw = (to - from) / std::max(1.0, count);
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    double step = power;
    for (const double factor : {10.0, 5.0, 2.0, 1.0}) {
        if (factor * power >= raw * 0.999) { step = factor * power; }
    }
    step = is_whole ? std::max(1.0, step) : step;
    std::vector<double> found;
    const double first = std::ceil(from / step - 1e-9);
    for (int i = 0; (first + i) * step <= to + step * 1e-9 && i < 1000; ++i) { found.push_back((first + i) * step); }
    // One number tells no scale.
    return found.size() < 2 && count < 16.0 && !is_whole ? round_steps(from, to, 2.0 * count, is_whole) : found;
}

/// 1, 2 and 5 times the powers of ten on a logarithmic axis; only the powers where they are many.
std::vector<double> round_powers(double from, double to) {
    std::vector<double> found;
    for (double power = std::floor(std::log10(from)); power <= std::log10(to); ++power) {
        for (const double factor : {1.0, 2.0, 5.0}) {
            const double value = factor * std::pow(10.0, power);
            const bool is_shown = factor == 1.0 || to / from < 300.0;
            if (is_shown && value >= from * 0.999 && value <= to * 1.001) { found.push_back(value); }
        }
    }
    return found;
}

/// A number at an axis.
std::string tick_text(double value) {
    const double size = std::abs(value);
    return size >= 10000.0 ? fmt::format("{:.6g}k", value / 1000.0) : fmt::format("{:.6g}", size < 1e-12 ? 0.0 : value);
}

/// Least and greatest of the finite values that `lists` of a plot's series have.
std::pair<double, double> value_ends(
    const Plot& plot, std::initializer_list<std::vector<double> PlotSeries::*> lists, bool positive) {
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for (const PlotSeries& series : plot.series) {
        for (const auto list : lists) {
            for (const double value : series.*list) {
                if (!std::isfinite(value) || (positive && value <= 0.0)) { continue; }
                least = std::min(least, value);
                most = std::max(most, value);
            }
        }
    }
    if (least > most) { return {positive ? 1.0 : 0.0, positive ? 10.0 : 1.0}; }
    return least == most && !positive ? std::pair(least - 0.5, most + 0.5) : std::pair(least, most);
}

bool has_bars(const Plot& plot) {
    return std::ranges::find(plot.series, PlotSeries::Style::Bars, &PlotSeries::style) != plot.series.end();
}

/// The axis with ends that can be drawn.
FigureAxis checked(FigureAxis axis) {
    if (!std::isfinite(axis.from) || !std::isfinite(axis.to)) { axis.from = axis.to = 0.0; }
    if (axis.is_logarithmic && axis.from <= 0.0) { axis.from = axis.to > 0.0 ? axis.to / 1000.0 : 1.0; }
    if (axis.to <= axis.from) { axis.to = axis.is_logarithmic ? 10.0 * axis.from : axis.from + 1.0; }
    return axis;
}

FigureAxis x_axis_of(const Plot& plot) {
    const auto [least, most] = value_ends(plot, {&PlotSeries::x}, plot.x_logarithmic);
    const double half = has_bars(plot) ? plot.bar_width / 2.0 : 0.0;
    FigureAxis axis{.is_logarithmic = plot.x_logarithmic};
    axis.from = plot.x_min.value_or(plot.x_logarithmic ? least / 1.1 : least - half);
    axis.to = plot.x_max.value_or(plot.x_logarithmic ? most * 1.1 : most + half);
    return checked(axis);
}

FigureAxis y_axis_of(const Plot& plot) {
    const auto [least, most] = value_ends(plot, {&PlotSeries::y, &PlotSeries::y_low}, plot.y_logarithmic);
    FigureAxis axis{.is_logarithmic = plot.y_logarithmic};
    const double margin = 0.05 * (most - least);
    axis.from = plot.y_min.value_or(plot.y_logarithmic ? least / 1.2 : least - margin);
    axis.to = plot.y_max.value_or(plot.y_logarithmic ? most * 1.2 : most + margin);
    if (plot.y_logarithmic) { axis.to = std::max(axis.to, 5.0 * axis.from); }
    return checked(axis);
}

/// A text at its place: the left end of its base line.
struct PlacedText {
    std::string text;
    double x = 0.0;
    std::size_t row = 0;
};

/// Where everything stands.
struct FigureLayout {
    double width = 0.0;
    double height = 0.0;
    FigureAxis x;
    FigureAxis y;
    std::vector<double> x_ticks;
    std::vector<double> y_ticks;
    std::vector<std::size_t> ranks;      ///< of each series: series of one colour share dashes and marker
    std::vector<std::size_t> key_series; ///< named series that have points
    std::vector<PlacedText> key;         ///< as many; x is the sample's
    std::vector<PlacedText> mark_names;
    std::size_t mark_rows = 0;
    std::size_t key_rows = 0;
};

/// Named series come first in the order of their colours; an unnamed one has the rank of its colour.
std::vector<std::size_t> ranks_of(const Plot& plot) {
    std::vector<std::string_view> colours;
    for (const bool named : {true, false}) {
        for (const PlotSeries& series : plot.series) {
            if (series.name.empty() != named && std::ranges::find(colours, series.colour) == colours.end()) {
                colours.push_back(series.colour);
            }
        }
    }
    std::vector<std::size_t> ranks;
    for (const PlotSeries& series : plot.series) {
        ranks.push_back(static_cast<std::size_t>(std::ranges::find(colours, series.colour) - colours.begin()));
    }
    return ranks;
}

/// Puts the key's entries in rows above the plot.
void place_key(cairo_t* context, const Plot& plot, FigureLayout& layout) {
    double x = layout.x.begin;
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
        const PlotSeries& series = plot.series[i];
        if (series.name.empty() || series.x.empty()) { continue; }
        const double max_width = layout.x.end - layout.x.begin - sample_width - gap;
        const std::string name = fitted(context, one_line(series.name), max_width);
        const double width = sample_width + gap + width_of(context, name);
        if (layout.key.empty() || x + width > layout.x.end) {
            ++layout.key_rows;
            x = layout.x.begin;
        }
        layout.key_series.push_back(i);
        layout.key.push_back({name, x, layout.key_rows - 1});
        x += width + 3.0 * gap;
    }
}

/// Puts the names of marks in up to three rows above the plot, right of their lines; leaves out those that would lie
/// over others.
void place_mark_names(cairo_t* context, const Plot& plot, FigureLayout& layout) {
    std::array<double, 3> free{};
    for (const PlotMark& mark : plot.marks) {
        if (!(mark.x >= layout.x.from && mark.x <= layout.x.to)) { continue; }
        const std::string name = one_line(mark.name);
        const double x = layout.x.place(mark.x);
        const double end = x + width_of(context, name);
        const auto row = std::ranges::find_if(free, [&](double taken) { return x >= taken; });
        if (row == free.end() || end > layout.width) { continue; }
        *row = end + gap;
        const auto index = static_cast<std::size_t>(row - free.begin());
        layout.mark_names.push_back({name, x, index});
        layout.mark_rows = std::max(layout.mark_rows, index + 1);
    }
}

FigureLayout layout_of(const Plot& plot, FigureSize size) {
    const SurfacePointer surface(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1));
    const ContextPointer context = context_of(surface.get());
    FigureLayout layout;
    layout.ranks = ranks_of(plot);
    layout.width = size.width_mm * points_per_mm;
    layout.height = size.height_mm * points_per_mm;
    layout.x = x_axis_of(plot);
    layout.y = y_axis_of(plot);
    const double bottom = 2.0 * row_height + 2.0 * gap;
    layout.y_ticks = plot.y_logarithmic ? round_powers(layout.y.from, layout.y.to)
                                        : round_steps(layout.y.from, layout.y.to,
                                              std::max(2.0, (layout.height - bottom) / 24.0), false);
    double tick_width = 0.0;
    for (const double tick : layout.y_ticks) {
        tick_width = std::max(tick_width, width_of(context.get(), tick_text(tick)));
    }
    layout.x.begin = row_height + 2.0 * gap + tick_width;
    layout.x.end = layout.width - 2.0 * gap;
    const bool is_whole = std::ranges::all_of(plot.series, [](const PlotSeries& series) {
        return std::ranges::all_of(series.x, [](double x) { return std::floor(x) == x; });
    });
    layout.x_ticks = plot.x_logarithmic ? round_powers(layout.x.from, layout.x.to)
                                        : round_steps(layout.x.from, layout.x.to,
                                              std::max(2.0, (layout.x.end - layout.x.begin) / 36.0), is_whole);
    place_key(context.get(), plot, layout);
    place_mark_names(context.get(), plot, layout);
    layout.y.end = gap + row_height * static_cast<double>(layout.key_rows + layout.mark_rows);
    layout.height = std::max(layout.height, layout.y.end + min_plot_height + bottom);
    layout.y.begin = layout.height - bottom;
    return layout;
}

/// Draws one figure on a surface.
class FigurePainter {
public:
    FigurePainter(const Plot& plot, const FigureLayout& layout, cairo_surface_t* surface)
        : plot_(plot), layout_(layout), context_(context_of(surface)) {}

    void draw() {
        set_colour(cairo(), {1.0, 1.0, 1.0, 1.0});
        cairo_paint(cairo());
        draw_axes();
        cairo_save(cairo());
        const FigureAxis& x = layout_.x;
        const FigureAxis& y = layout_.y;
        cairo_rectangle(cairo(), x.begin, y.end, x.end - x.begin, y.begin - y.end);
        cairo_clip(cairo());
        for (std::size_t i = 0; i < plot_.series.size(); ++i) { draw_series(plot_.series[i], layout_.ranks[i]); }
        cairo_restore(cairo());
        draw_levels();
        draw_marks();
        draw_key();
        check_cairo(cairo_status(cairo()));
    }

private:
    cairo_t* cairo() const { return context_.get(); }

    /// `share` of the text's width lies left of the place.
    void draw_text(const std::string& text, double x, double y, double share) {
        cairo_move_to(cairo(), x - share * width_of(cairo(), text), y);
        cairo_show_text(cairo(), text.c_str());
    }

    void draw_line(double x0, double y0, double x1, double y1, const Rgba& colour, double width = 0.5) {
        set_colour(cairo(), colour);
        cairo_set_line_width(cairo(), width);
        cairo_move_to(cairo(), x0, y0);
        cairo_line_to(cairo(), x1, y1);
        cairo_stroke(cairo());
    }

    void draw_axes() {
        const FigureAxis& x = layout_.x;
        const FigureAxis& y = layout_.y;
        constexpr double tick_length = 2.0;
        constexpr double text_drop = 2.5; // of digits, to stand level with their line
        for (const double tick : layout_.y_ticks) {
            draw_line(x.begin, y.place(tick), x.end, y.place(tick), grid_grey);
            set_colour(cairo(), ink);
            draw_text(tick_text(tick), x.begin - gap, y.place(tick) + text_drop, 1.0);
        }
        for (const double tick : layout_.x_ticks) {
            draw_line(x.place(tick), y.begin, x.place(tick), y.begin + tick_length, soft_ink);
            set_colour(cairo(), ink);
            draw_text(tick_text(tick), x.place(tick), y.begin + row_height, 0.5);
        }
        draw_line(x.begin, y.begin, x.end, y.begin, soft_ink);
        set_colour(cairo(), ink);
        const auto label = [](const std::string& text, bool log) {
            return one_line(text) + (log ? " (logarithmic)" : "");
        };
        draw_text(label(plot_.x_label, x.is_logarithmic), (x.begin + x.end) / 2.0, layout_.height - gap, 0.5);
        cairo_save(cairo());
        cairo_translate(cairo(), font_size, (y.begin + y.end) / 2.0);
        cairo_rotate(cairo(), -1.5707963267948966);
        draw_text(label(plot_.y_label, y.is_logarithmic), 0.0, 0.0, 0.5);
        cairo_restore(cairo());
    }

    static bool is_point(const PlotSeries& series, std::size_t i) {
        return i < series.y.size() && std::isfinite(series.x[i]) && std::isfinite(series.y[i]);
    }

    void draw_series(const PlotSeries& series, std::size_t rank) {
        switch (series.style) {
        case PlotSeries::Style::Bars:
            draw_bars(series);
            break;
        case PlotSeries::Style::Area:
            draw_area(series);
            break;
        case PlotSeries::Style::Line:
        case PlotSeries::Style::Points:
            draw_curve(series, rank);
            break;
        }
    }

    void draw_bars(const PlotSeries& series) {
        set_colour(cairo(), colour_of(series.colour, 1.0));
        const double half = plot_.bar_width / 2.0;
        for (std::size_t i = 0; i < series.x.size(); ++i) {
            if (!is_point(series, i)) { continue; }
            const double left = layout_.x.place(series.x[i] - half);
            const double width = std::max(0.5, layout_.x.place(series.x[i] + half) - left);
            const double top = layout_.y.place(series.y[i]);
            cairo_rectangle(cairo(), left, top, width, std::max(0.0, layout_.y.begin - top));
            cairo_fill(cairo());
        }
    }

    /// Fills each piece between gaps.
    void draw_area(const PlotSeries& series) {
        set_colour(cairo(), colour_of(series.colour, series.name.empty() ? 0.25 : 0.75));
        const auto is_there = [&](std::size_t i) {
            return is_point(series, i) && i < series.y_low.size() && std::isfinite(series.y_low[i]);
        };
        for (std::size_t begin = 0; begin < series.x.size();) {
            std::size_t end = begin;
            while (end < series.x.size() && is_there(end)) { ++end; }
            for (std::size_t i = begin; i < end; ++i) { line_to(series.x[i], series.y[i]); }
            for (std::size_t i = end; i-- > begin;) { line_to(series.x[i], series.y_low[i]); }
            if (end > begin) {
                cairo_close_path(cairo());
                cairo_fill(cairo());
            }
            begin = end + 1;
        }
    }

    void line_to(double x, double y) { cairo_line_to(cairo(), layout_.x.place(x), layout_.y.place(y)); }

    void draw_curve(const PlotSeries& series, std::size_t rank) {
        set_colour(cairo(), colour_of(series.colour, 1.0));
        cairo_set_line_width(cairo(), 0.9);
        const bool is_told_apart = layout_.key.size() > 1 && !series.name.empty();
        set_dash(cairo(), is_told_apart ? rank : 0);
        bool is_gap = true;
        for (std::size_t i = 0; i < series.x.size(); ++i) {
            if (!is_point(series, i)) {
                is_gap = true;
            } else if (std::exchange(is_gap, false)) {
                cairo_move_to(cairo(), layout_.x.place(series.x[i]), layout_.y.place(series.y[i]));
            } else {
                line_to(series.x[i], series.y[i]);
            }
        }
        cairo_stroke(cairo());
        const bool is_points = series.style == PlotSeries::Style::Points;
        constexpr std::size_t markers_on_line = 7;
        const std::size_t step = is_points ? 1 : std::max<std::size_t>(1, series.x.size() / markers_on_line);
        const std::size_t first = is_points ? 0 : step * (2 * (rank % markers_on_line) + 1) / (2 * markers_on_line);
        for (std::size_t i = first; (is_points || is_told_apart) && i < series.x.size(); i += step) {
            if (is_point(series, i)) {
                draw_marker(cairo(), rank, layout_.x.place(series.x[i]), layout_.y.place(series.y[i]));
            }
        }
        set_dash(cairo(), 0);
    }

    void draw_levels() {
        for (const PlotReferenceLine& level : plot_.levels) {
            if (!(level.y >= layout_.y.from && level.y <= layout_.y.to)) { continue; }
            const double y = layout_.y.place(level.y);
            set_dash(cairo(), 1);
            draw_line(layout_.x.begin, y, layout_.x.end, y, soft_ink);
            set_dash(cairo(), 0);
            draw_text(one_line(level.name), layout_.x.end, y - 1.5, 1.0);
        }
    }

    void draw_marks() {
        for (const PlotMark& mark : plot_.marks) {
            if (!(mark.x >= layout_.x.from && mark.x <= layout_.x.to)) { continue; }
            const double x = layout_.x.place(mark.x);
            set_dash(cairo(), 2);
            draw_line(x, layout_.y.end, x, layout_.y.begin, soft_ink);
            set_dash(cairo(), 0);
        }
        set_colour(cairo(), ink);
        for (const PlacedText& name : layout_.mark_names) {
            draw_text(name.text, name.x, layout_.y.end - gap - row_height * static_cast<double>(name.row), 0.0);
        }
    }

    void draw_key() {
        for (std::size_t i = 0; i < layout_.key.size(); ++i) {
            const PlacedText& entry = layout_.key[i];
            const PlotSeries& series = plot_.series[layout_.key_series[i]];
            const std::size_t rank = layout_.ranks[layout_.key_series[i]];
            const double base = row_height * static_cast<double>(entry.row + 1);
            const double middle = base - 2.5;
            const bool is_line = series.style == PlotSeries::Style::Line || series.style == PlotSeries::Style::Points;
            if (is_line) {
                if (layout_.key.size() > 1) { set_dash(cairo(), rank); }
                draw_line(entry.x, middle, entry.x + sample_width, middle, colour_of(series.colour, 1.0), 0.9);
                set_dash(cairo(), 0);
                if (layout_.key.size() > 1 || series.style == PlotSeries::Style::Points) {
                    draw_marker(cairo(), rank, entry.x + sample_width / 2.0, middle);
                }
            } else {
                set_colour(cairo(), colour_of(series.colour, series.style == PlotSeries::Style::Bars ? 1.0 : 0.75));
                cairo_rectangle(cairo(), entry.x, middle - 2.5, sample_width, 5.0);
                cairo_fill(cairo());
            }
            set_colour(cairo(), ink);
            draw_text(entry.text, entry.x + sample_width + gap, base, 0.0);
        }
    }

    const Plot& plot_;
    const FigureLayout& layout_;
    ContextPointer context_;
};

/// Takes what cairo writes.
cairo_status_t append_bytes(void* text, const unsigned char* bytes, unsigned count) {
    static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
    return CAIRO_STATUS_SUCCESS;
}

/// `create(layout, text)` makes a surface that is written into a text.
template <class Create>
std::string figure_of(const Plot& plot, FigureSize size, const Create& create) {
    const FigureLayout layout = layout_of(plot, size);
    std::string text;
    const SurfacePointer surface(create(layout, text));
    check_cairo(cairo_surface_status(surface.get()));
    FigurePainter(plot, layout, surface.get()).draw();
    cairo_surface_finish(surface.get());
    check_cairo(cairo_surface_status(surface.get()));
    return text;
}

/// Puts `more` behind each of those words in a text.
std::string with_inserted(std::string text, std::string_view word, std::string_view more) {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + word.size())) {
        text.insert(at + word.size(), more);
    }
    return text;
}

} // namespace

std::string figure_svg(const Plot& plot, FigureSize size) {
    std::string svg = figure_of(plot, size, [](const FigureLayout& layout, std::string& text) {
        return cairo_svg_surface_create_for_stream(append_bytes, &text, layout.width, layout.height);
    });
    // cairo numbers the surfaces of a program: that id is of no use and differs from call to call.
    constexpr std::string_view surface_id = " id=\"surface";
    if (const std::size_t at = svg.find(surface_id); at != std::string::npos) {
        svg.erase(at, svg.find('"', at + surface_id.size()) + 1 - at);
    }
    const std::string prefix = fmt::format("f{:08x}-", checksum_of(svg) & 0xFFFFFFFFU);
    for (const std::string_view word : {"id=\"", "href=\"#", "url(#"}) { svg = with_inserted(svg, word, prefix); }
    return with_inserted(svg, "<svg", fmt::format(" role=\"img\" aria-label=\"{}\"", escaped(plot.title)));
}

std::string figure_pdf(const Plot& plot, FigureSize size) {
    return figure_of(plot, size, [&](const FigureLayout& layout, std::string& text) {
        cairo_surface_t* const surface =
            cairo_pdf_surface_create_for_stream(append_bytes, &text, layout.width, layout.height);
        cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE, one_line(plot.title).c_str());
        cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, nullptr);
        return surface;
    });
}

Picture figure_picture(const Plot& plot, FigureSize size, double px_per_mm) {
    const FigureLayout layout = layout_of(plot, size);
    const double scale = px_per_mm / points_per_mm;
    Picture picture{static_cast<int>(std::lround(layout.width * scale)),
        static_cast<int>(std::lround(layout.height * scale)), 3, {}};
    const SurfacePointer surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, picture.width_px, picture.height_px));
    check_cairo(cairo_surface_status(surface.get()));
    cairo_surface_set_device_scale(surface.get(), scale, scale);
    FigurePainter(plot, layout, surface.get()).draw();
    cairo_surface_flush(surface.get());
    const auto* const data = cairo_image_surface_get_data(surface.get());
    const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get()));
    constexpr std::size_t bytes_a_pixel = 4;
    for (std::size_t y = 0; y < static_cast<std::size_t>(picture.height_px); ++y) {
        for (std::size_t x = 0; x < static_cast<std::size_t>(picture.width_px); ++x) {
            std::uint32_t pixel = 0; // red in its third byte, in the order of the processor
            std::memcpy(&pixel, data + y * stride + bytes_a_pixel * x, sizeof(pixel));
            for (const unsigned shift : {16U, 8U, 0U}) {
                picture.bytes.push_back(static_cast<std::byte>(pixel >> shift & 0xFFU));
            }
        }
    }
    return picture;
}

double shape_of_axes(const Plot& plot, FigureSize size) {
    const FigureLayout layout = layout_of(plot, size);
    return (layout.x.end - layout.x.begin) / (layout.y.begin - layout.y.end);
}

} // namespace octant::ui::report
