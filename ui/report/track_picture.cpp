#include "ui/report/track_picture.h"

#include "ui/report/figures.h"
#include "ui/report/plots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace octant::ui::report {

namespace {

constexpr double m_per_km = 1000.0;
constexpr std::array track_colours{"#1f5fbf", "#d9822b", "#2a9d5b", "#a23bb3", "#c2413b", "#6b7280"};
constexpr std::size_t most_named = 6;

const char* colour_of_track(std::size_t index) { return track_colours[std::min(index, track_colours.size() - 1)]; }

/// A curve with at most so many points, and a gap where nothing was recorded.
PlotSeries thinned(const TrackCurve& curve, std::size_t index, const std::vector<double>& x, double x_unit,
    const std::vector<double>& y, double y_unit) {
    constexpr std::size_t most_points = 4000;
    PlotSeries series{.name = index < most_named ? curve.name : "", .colour = colour_of_track(index)};
    const std::size_t step = std::max<std::size_t>(1, x.size() / most_points);
    auto gap = curve.gap_after.begin();
    for (std::size_t i = 0; i < x.size(); ++i) {
        const bool is_at_gap = gap != curve.gap_after.end() && *gap == i;
        if (i % step == 0 || is_at_gap || i + 1 == x.size()) {
            series.x.push_back(x[i] / x_unit);
            series.y.push_back(y[i] / y_unit);
        }
        if (is_at_gap) {
            ++gap;
            series.x.push_back(x[i] / x_unit);
            series.y.push_back(std::numeric_limits<double>::quiet_NaN());
        }
    }
    return series;
}

/// The range of a map's axes: what the tracks take, in the shape of the picture.
void set_map_ranges(Plot& map, double width_over_height) {
    double least_x = 0.0;
    double most_x = 0.0;
    double least_y = 0.0;
    double most_y = 0.0;
    bool is_first = true;
    for (const PlotSeries& series : map.series) {
        for (std::size_t i = 0; i < series.x.size(); ++i) {
            if (!std::isfinite(series.y[i])) { continue; }
            least_x = is_first ? series.x[i] : std::min(least_x, series.x[i]);
            most_x = is_first ? series.x[i] : std::max(most_x, series.x[i]);
            least_y = is_first ? series.y[i] : std::min(least_y, series.y[i]);
            most_y = is_first ? series.y[i] : std::max(most_y, series.y[i]);
            is_first = false;
        }
    }
    constexpr double margin = 1.08;
    constexpr double least_height_km = 0.02;
    const double height =
        margin * std::max({most_y - least_y, (most_x - least_x) / width_over_height, least_height_km});
    map.x_min = 0.5 * (least_x + most_x - width_over_height * height);
    map.x_max = 0.5 * (least_x + most_x + width_over_height * height);
    map.y_min = 0.5 * (least_y + most_y - height);
    map.y_max = 0.5 * (least_y + most_y + height);
}

} // namespace

Picture track_picture(std::span<const TrackCurve> curves) {
    Plot map{"Map", "east, km", "north, km"};
    Plot profile{"Heights", "time, s", "height, m"};
    // The first track is drawn last, over the others.
    for (std::size_t i = curves.size(); i-- > 0;) {
        const TrackCurve& curve = curves[i];
        map.series.push_back(thinned(curve, i, curve.east_m, m_per_km, curve.north_m, m_per_km));
        profile.series.push_back(thinned(curve, i, curve.time_s, 1.0, curve.height_m, 1.0));
    }
    if (!curves.empty()) {
        for (const std::size_t at : curves.front().gap_after) {
            profile.marks.push_back({"gap", curves.front().time_s[at]});
        }
    }
    constexpr FigureSize map_size{160.0, 110.0};
    constexpr FigureSize profile_size{160.0, 50.0};
    constexpr double px_per_mm = 6.0;
    set_map_ranges(map, shape_of_axes(map, map_size));
    Picture upper = figure_picture(map, map_size, px_per_mm);
    const Picture lower = figure_picture(profile, profile_size, px_per_mm);
    upper.bytes.insert(upper.bytes.end(), lower.bytes.begin(), lower.bytes.end());
    upper.height_px += lower.height_px;
    return upper;
}

} // namespace octant::ui::report
