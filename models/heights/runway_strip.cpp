#include "models/heights/runway_strip.h"

#include "sim/base/units.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace octant::models::heights {

glm::dvec2 RunwayStrip::along() const { return {std::sin(heading_rad), std::cos(heading_rad)}; }

glm::dvec2 RunwayStrip::left() const { return {-std::cos(heading_rad), std::sin(heading_rad)}; }

glm::dvec2 RunwayStrip::strip_from_world(const glm::dvec2& place_m) const {
    const glm::dvec2 from_begin_m = place_m - begin_m;
    return {glm::dot(from_begin_m, along()), glm::dot(from_begin_m, left())};
}

glm::dvec2 RunwayStrip::place(const glm::dvec2& along_left_m) const {
    return begin_m + along() * along_left_m.x + left() * along_left_m.y;
}

double RunwayStrip::distance_m(const glm::dvec2& place_m) const {
    const glm::dvec2 at_m = strip_from_world(place_m);
    const double beyond_m = std::max({-at_m.x, at_m.x - length_m, 0.0});
    const double beside_m = std::max(std::abs(at_m.y) - 0.5 * width_m, 0.0);
    return std::hypot(beyond_m, beside_m);
}

double RunwayStrip::plane_m(const glm::dvec2& place_m) const {
    return height_m + rise * glm::dot(place_m - begin_m, along());
}

namespace {

/// Up to here from the runway all samples lie in its plane. Of a cell whose nearest point is levelled the farthest
/// corner is a diagonal away.
double level_m(double spacing_m) { return level_margin_m + std::sqrt(2.0) * spacing_m; }

/// A rectangle of samples: first and last column and row, inclusive.
struct SampleBox {
    glm::ivec2 first;
    glm::ivec2 last;
};

/// The samples that may be within `reach_m` of a runway.
SampleBox samples_around(const RunwayStrip& strip, const HeightField& field, double reach_m) {
    glm::dvec2 min = strip.begin_m;
    glm::dvec2 max = strip.begin_m;
    for (const double along_m : {0.0, strip.length_m}) {
        for (const double left_m : {-0.5 * strip.width_m, 0.5 * strip.width_m}) {
            const glm::dvec2 corner = strip.place({along_m, left_m});
            min = glm::min(min, corner);
            max = glm::max(max, corner);
        }
    }
    const glm::dvec2 last(field.columns() - 1, field.rows() - 1);
    const auto sample_at = [&](const glm::dvec2& at_m) {
        return glm::clamp((at_m + field.half_extent_m()) / field.spacing_m(), glm::dvec2(0.0), last);
    };
    return {glm::ivec2(glm::floor(sample_at(min - reach_m))), glm::ivec2(glm::ceil(sample_at(max + reach_m)))};
}

/// The height of the levelled ground at a position whose original height is `own_m`.
double levelled_m(const RunwayStrip& strip, double spacing_m, const glm::dvec2& place_m, double own_m) {
    const double beyond_m = std::max(strip.distance_m(place_m) - level_m(spacing_m), 0.0);
    if (beyond_m >= side_slope_end_m) { return own_m; }
    const double plane_m = strip.plane_m(place_m);
    const double side_m = side_slope * beyond_m;
    const double graded_m = std::clamp(own_m, plane_m - side_m, plane_m + side_m);
    return glm::mix(graded_m, own_m, glm::smoothstep(0.5 * side_slope_end_m, side_slope_end_m, beyond_m));
}

} // namespace

double reach_m(const HeightField& field) { return level_m(field.spacing_m()) + side_slope_end_m; }

HeightField levelled(const HeightField& field, const RunwayStrip& strip) {
    const auto columns = static_cast<std::size_t>(field.columns());
    std::vector<float> heights_m;
    heights_m.reserve(columns * static_cast<std::size_t>(field.rows()));
    for (int row = 0; row < field.rows(); ++row) {
        for (int column = 0; column < field.columns(); ++column) { heights_m.push_back(field.height_m(column, row)); }
    }
    const SampleBox box = samples_around(strip, field, reach_m(field));
    for (int row = box.first.y; row <= box.last.y; ++row) {
        for (int column = box.first.x; column <= box.last.x; ++column) {
            float& height_m = heights_m[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)];
            height_m = static_cast<float>(levelled_m(
                strip, field.spacing_m(), glm::dvec2(field.sample_m(column, row)), static_cast<double>(height_m)));
        }
    }
    HeightField level(field.columns(), field.rows(), field.spacing_m(), std::move(heights_m));
    level.name = field.name;
    level.place = field.place;
    level.system = field.system;
    level.filled_voids = field.filled_voids;
    return level;
}

namespace {

constexpr double aim_after_m = 300.0;
constexpr double place_step_m = 300.0; ///< between places that are looked at
constexpr double heading_step_deg = 10.0;
constexpr int heading_steps = 9;          ///< to the left, and one less to the right
constexpr double from_path_per_m = 200.0; ///< that count as much as a metre of earthwork
constexpr double from_begin_per_m = 500.0;
constexpr double turn_per_m_deg = 15.0;
constexpr double finest_m = 15.0; ///< samples nearer to each other are not all looked at

bool lies_within(const RunwayStrip& strip, const glm::dvec2& half_extent_m) {
    const double beside_m = 0.5 * strip.width_m + level_margin_m;
    for (const double along_m : {-level_margin_m, strip.length_m + level_margin_m}) {
        for (const double left_m : {-beside_m, beside_m}) {
            const glm::dvec2 corner = glm::abs(strip.place({along_m, left_m}));
            if (corner.x > half_extent_m.x || corner.y > half_extent_m.y) { return false; }
        }
    }
    return true;
}

/// Lays the strip, which lies within the field, into the plane that is nearest to the ground: least squares of height
/// over the way along, then lifted until cutting and heaping up are alike. Returns about the earthwork on the runway
/// and beside it.
double fit(RunwayStrip& strip, const HeightField& field) {
    constexpr int stations = 31;
    const double beside_m = 0.5 * strip.width_m + level_margin_m;
    std::array<std::array<double, 3>, stations> heights_m;
    double mean_m = 0.0;
    double moment = 0.0;
    double spread = 0.0;
    for (int i = 0; i < stations; ++i) {
        const double along_m = strip.length_m * i / (stations - 1);
        const double from_middle_m = along_m - 0.5 * strip.length_m;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec2 at_m = strip.place({along_m, beside_m * (k - 1)});
            const double height_m = field.height_at(at_m.x, at_m.y).value_or(0.0);
            heights_m[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] = height_m;
            mean_m += height_m / (3 * stations);
            moment += from_middle_m * height_m;
            spread += from_middle_m * from_middle_m;
        }
    }
    strip.rise = std::clamp(moment / spread, -max_rise, max_rise);
    strip.height_m = mean_m - 0.5 * strip.length_m * strip.rise;
    double min_m = std::numeric_limits<double>::infinity();
    double max_m = -min_m;
    for (int i = 0; i < stations; ++i) {
        const double plane_m = strip.height_m + strip.rise * strip.length_m * i / (stations - 1);
        for (const double height_m : heights_m[static_cast<std::size_t>(i)]) {
            min_m = std::min(min_m, height_m - plane_m);
            max_m = std::max(max_m, height_m - plane_m);
        }
    }
    strip.height_m += 0.5 * (min_m + max_m);
    return 0.5 * (max_m - min_m);
}

/// No plane has its ends and its middle all nearer to the ground than this.
double min_earthwork_m(const RunwayStrip& strip, const HeightField& field) {
    const auto height_m = [&](double along_m) {
        const glm::dvec2 at_m = strip.place({along_m, 0.0});
        return field.height_at(at_m.x, at_m.y).value_or(0.0);
    };
    const double begin_m = height_m(0.0);
    const double end_m = height_m(strip.length_m);
    const double bend_m = height_m(0.5 * strip.length_m) - 0.5 * (begin_m + end_m);
    const double too_steep_m = std::abs(end_m - begin_m) - max_rise * strip.length_m;
    return 0.5 * std::max(std::abs(bend_m), too_steep_m);
}

/// The farthest that a sample is moved; nothing where the runway would touch water.
std::optional<double> earthwork_m(const RunwayStrip& strip, const HeightField& field, double water_m) {
    if (strip.height_m <= water_m || strip.height_m + strip.rise * strip.length_m <= water_m) { return std::nullopt; }
    const int stride = std::max(static_cast<int>(finest_m / field.spacing_m()), 1);
    const SampleBox box = samples_around(strip, field, reach_m(field));
    double max_m = 0.0;
    for (int row = box.first.y; row <= box.last.y; row += stride) {
        for (int column = box.first.x; column <= box.last.x; column += stride) {
            const glm::dvec3 at_m = field.sample_m(column, row);
            const glm::dvec2 place_m(at_m);
            if (at_m.z <= water_m && strip.distance_m(place_m) <= level_margin_m) { return std::nullopt; }
            const double level_m = levelled_m(strip, field.spacing_m(), place_m, at_m.z);
            max_m = std::max(max_m, std::abs(level_m - at_m.z));
        }
    }
    return max_m;
}

/// The best site so far, and by what it is the best.
class Search {
public:
    Search(const HeightField& field, const RunwayRequest& request) : field_(field), request_(request) {}

    /// `apart`: what way and turn count for.
    void look_at(RunwayStrip strip, double apart) {
        if (apart >= least_ || !lies_within(strip, field_.half_extent_m()) ||
            apart + cost_of(min_earthwork_m(strip, field_)) >= least_ ||
            apart + cost_of(fit(strip, field_)) >= least_) {
            return;
        }
        const std::optional<double> work_m = earthwork_m(strip, field_, request_.water_m);
        if (work_m && apart + cost_of(*work_m) < least_) {
            least_ = apart + cost_of(*work_m);
            best_ = {strip, *work_m, apart == 0.0};
        }
    }

    /// Whether nothing is better that is so far apart.
    bool ends_at(double apart) const { return apart >= least_; }

    const std::optional<RunwaySite>& best() const { return best_; }

private:
    /// Too much is worse than any way and turn.
    static double cost_of(double earthwork_m) { return earthwork_m + (earthwork_m > max_earthwork_m ? 1000.0 : 0.0); }

    const HeightField& field_;
    const RunwayRequest& request_;
    double least_ = std::numeric_limits<double>::infinity();
    std::optional<RunwaySite> best_;
};

/// The middle of a runway, and what its way from the path counts for.
struct Middle {
    glm::dvec2 at_m;
    double apart = 0.0;
};

/// All of them on a grid around the path, the least apart first.
std::vector<Middle> middles_near(const std::vector<glm::dvec2>& path_m) {
    glm::dvec2 min_m = path_m.front();
    glm::dvec2 max_m = path_m.front();
    for (const glm::dvec2& place_m : path_m) {
        min_m = glm::min(min_m, place_m);
        max_m = glm::max(max_m, place_m);
    }
    const glm::dvec2 from_m = min_m - runway_search_radius_m;
    const glm::ivec2 steps((max_m + runway_search_radius_m - from_m) / place_step_m);
    std::vector<Middle> middles;
    for (int north = 0; north <= steps.y; ++north) {
        for (int east = 0; east <= steps.x; ++east) {
            const glm::dvec2 at_m = from_m + place_step_m * glm::dvec2(east, north);
            double away_m = std::numeric_limits<double>::infinity();
            for (const glm::dvec2& place_m : path_m) { away_m = std::min(away_m, glm::distance(place_m, at_m)); }
            if (away_m <= runway_search_radius_m) {
                const double begin_m = glm::distance(path_m.front(), at_m);
                middles.push_back({at_m, away_m / from_path_per_m + begin_m / from_begin_per_m});
            }
        }
    }
    std::ranges::stable_sort(middles, {}, &Middle::apart);
    return middles;
}

void look_around(const RunwayRequest& request, Search& search) {
    for (const Middle& middle : middles_near(request.path_m)) {
        if (search.ends_at(middle.apart)) { return; }
        for (int step = -heading_steps; step < heading_steps; ++step) {
            const double turned_deg = heading_step_deg * step;
            RunwayStrip strip;
            strip.heading_rad = request.heading_rad + rad_from_deg(turned_deg);
            strip.begin_m = middle.at_m - strip.along() * (0.5 * strip.length_m);
            search.look_at(strip, middle.apart + std::abs(turned_deg) / turn_per_m_deg);
        }
    }
}

} // namespace

std::optional<RunwaySite> runway_site(const HeightField& field, const RunwayRequest& request) {
    assert(!request.path_m.empty());
    Search search(field, request);
    RunwayStrip strip;
    strip.heading_rad = request.heading_rad;
    strip.begin_m = request.path_m.front() - strip.along() * aim_after_m;
    search.look_at(strip, 0.0);
    if (!search.best() || search.best()->earthwork_m > max_earthwork_m) { look_around(request, search); }
    return search.best();
}

} // namespace octant::models::heights
