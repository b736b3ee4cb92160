// The error of a mesh in pixels against the full-resolution ground: the measure by which the paper's quadtree and the
// default mesh are compared.
//
// Each triangle is rasterised in plan over the samples that it covers, its border included. One bit for each sample
// sees to it that each counts once (both triangles at an edge have the same height there). Rows are divided into bands,
// always the same ones, which threads share.
#include "visuals/terrain/projected_error.h"

#include "sim/base/nearest_rank.h"
#include "sim/base/parallel_for.h"
#include "visuals/terrain/curvature_drop.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace octant::visuals::terrain {

namespace {

constexpr int rows_per_band = 64;

/// Vertices are snapped to this fraction of a sample, which floats far from the eye still resolve.
constexpr double snap_steps_per_sample = 256.0;

/// Wider than rounding, and far narrower than that fraction.
constexpr double row_tolerance = 1e-7;

/// The slopes of a triangle, metres for a sample east and north.
struct Slope {
    double east = 0.0;
    double north = 0.0;
};

Slope slope_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double signed_area2 = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (signed_area2 == 0.0) { return {}; }
    return {((b.z - a.z) * (c.y - a.y) - (c.z - a.z) * (b.y - a.y)) / signed_area2,
        ((c.z - a.z) * (b.x - a.x) - (b.z - a.z) * (c.x - a.x)) / signed_area2};
}

/// The part of a row of samples that lies within a triangle in plan.
struct RowInterval {
    double first;
    double last;
};

RowInterval row_interval(const std::array<glm::dvec3, 3>& corner, double row) {
    RowInterval part{1e30, -1e30};
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3& a = corner[k];
        const glm::dvec3& b = corner[(k + 1) % 3];
        if (row < std::min(a.y, b.y) || row > std::max(a.y, b.y)) { continue; }
        const double at = a.y == b.y ? a.x : a.x + (row - a.y) * (b.x - a.x) / (b.y - a.y);
        part.first = std::min({part.first, at, a.y == b.y ? b.x : at});
        part.last = std::max({part.last, at, a.y == b.y ? b.x : at});
    }
    return part;
}

/// Whether a triangle in view axes is not wholly outside one plane of the frustum.
bool touches_frustum(const std::array<glm::dvec3, 3>& seen, const PerspectiveView& view) {
    const double wide = view.half_width_px / view.focal_px;
    const double tall = view.half_height_px / view.focal_px;
    const auto all = [&](const auto& outside) { return std::all_of(seen.begin(), seen.end(), outside); };
    return !all([&](const glm::dvec3& p) { return p.z < view.near_m; }) &&
           !all([&](const glm::dvec3& p) { return p.x > wide * p.z; }) &&
           !all([&](const glm::dvec3& p) { return -p.x > wide * p.z; }) &&
           !all([&](const glm::dvec3& p) { return p.y > tall * p.z; }) &&
           !all([&](const glm::dvec3& p) { return -p.y > tall * p.z; });
}

int triangles_in_view(const GroundMesh& mesh, const PerspectiveView& view) {
    int count = 0;
    for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3) {
        std::array<glm::dvec3, 3> seen{};
        for (std::size_t i = 0; i < 3; ++i) {
            seen[i] = view.seen_m(glm::dvec3(mesh.vertices[mesh.indices[k + i]].position_m));
        }
        count += touches_frustum(seen, view) ? 1 : 0;
    }
    return count;
}

/// A percentile by nearest rank; reorders the values.
double nearest_rank(std::vector<float>& values, int permille) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank_of(values.size(), permille) - 1);
    std::nth_element(values.begin(), at, values.end());
    return static_cast<double>(*at);
}

/// The figures over all errors; reorders them.
void summarise(std::vector<float>& errors_px, ProjectedError& error) {
    if (errors_px.empty()) { return; }
    double sum = 0.0;
    double sum_of_squares = 0.0;
    for (const float value : errors_px) {
        const auto error_px = static_cast<double>(value);
        sum += error_px;
        sum_of_squares += error_px * error_px;
    }
    const auto count = static_cast<double>(errors_px.size());
    error.samples = static_cast<std::int64_t>(errors_px.size());
    error.mean_px = sum / count;
    error.rms_px = std::sqrt(sum_of_squares / count);
    error.maximum_px = static_cast<double>(*std::max_element(errors_px.begin(), errors_px.end()));
    error.p999_px = nearest_rank(errors_px, 999);
    error.p99_px = nearest_rank(errors_px, 990);
}

} // namespace

/// What is the same for all samples of a picture.
struct ProjectedErrorMeter::Picture {
    const PerspectiveView& view;
    double earth_radius_m;
    glm::dvec2 first_m; ///< The first sample's position relative to the eye.

    /// The position of a sample relative to the eye, lowered by curvature.
    glm::dvec3 sample_m(const GroundSamples& ground, int column, int row) const {
        const double x = first_m.x + column * ground.spacing_m();
        const double y = first_m.y + row * ground.spacing_m();
        return {x, y, ground.height_m(column, row) - view.eye_m.z - curvature_drop_m(x * x + y * y, earth_radius_m)};
    }
};

ProjectedErrorMeter::ProjectedErrorMeter(GroundSamples ground, int threads)
    : ground_(ground), threads_(threads), words_per_row_((static_cast<std::size_t>(ground.columns()) + 63) / 64) {
    assert(threads >= 1);
    for (int row = 0; row < ground.rows(); row += rows_per_band) {
        Band& band = bands_.emplace_back();
        band.first_row = row;
        band.end_row = std::min(row + rows_per_band, ground.rows());
    }
}

ProjectedError ProjectedErrorMeter::measure(
    const GroundMesh& mesh, const PerspectiveView& view, double earth_radius_m) {
    const Picture picture{view, earth_radius_m, -ground_.half_extent_m() - glm::dvec2(view.eye_m)};
    grid_vertices_.clear();
    for (const models::ColourVertex& vertex : mesh.vertices) {
        const glm::dvec3 from_eye_m(vertex.position_m);
        const glm::dvec2 grid = (glm::dvec2(from_eye_m) - picture.first_m) / ground_.spacing_m();
        grid_vertices_.emplace_back(glm::round(grid * snap_steps_per_sample) / snap_steps_per_sample, from_eye_m.z);
    }
    parallel_for(bands_.size(), threads_,
        [&](std::size_t band, std::size_t /*worker*/) { measure_band(bands_[band], mesh.indices, picture); });
    ProjectedError error;
    error.triangles_in_view = triangles_in_view(mesh, view);
    errors_px_.clear();
    for (const Band& band : bands_) {
        errors_px_.insert(errors_px_.end(), band.errors_px.begin(), band.errors_px.end());
        error.uncovered += band.uncovered;
    }
    summarise(errors_px_, error);
    return error;
}

void ProjectedErrorMeter::measure_band(Band& band, std::span<const std::uint32_t> indices, const Picture& picture) {
    band.covered.assign(words_per_row_ * static_cast<std::size_t>(band.end_row - band.first_row), 0);
    band.errors_px.clear();
    for (std::size_t k = 0; k + 2 < indices.size(); k += 3) {
        const glm::dvec3& a = grid_vertices_[indices[k]];
        const glm::dvec3& b = grid_vertices_[indices[k + 1]];
        const glm::dvec3& c = grid_vertices_[indices[k + 2]];
        if (std::max({a.y, b.y, c.y}) >= band.first_row && std::min({a.y, b.y, c.y}) <= band.end_row - 1) {
            measure_triangle(band, {a, b, c}, picture);
        }
    }
    count_uncovered(band, picture);
}

void ProjectedErrorMeter::measure_triangle(Band& band, const Corners& corners, const Picture& picture) const {
    const auto& [a, b, c] = corners;
    const Slope slope = slope_of(a, b, c);
    const int first_row = std::max(band.first_row, static_cast<int>(std::ceil(std::min({a.y, b.y, c.y}))));
    const int last_row = std::min(band.end_row - 1, static_cast<int>(std::floor(std::max({a.y, b.y, c.y}))));
    const PerspectiveView& view = picture.view;
    for (int row = first_row; row <= last_row; ++row) {
        const RowInterval part = row_interval(corners, row);
        const int first = std::max(0, static_cast<int>(std::ceil(part.first - row_tolerance)));
        const int last = std::min(ground_.columns() - 1, static_cast<int>(std::floor(part.last + row_tolerance)));
        std::uint64_t* const covered =
            band.covered.data() + static_cast<std::size_t>(row - band.first_row) * words_per_row_;
        for (int column = first; column <= last; ++column) {
            const auto at = static_cast<std::size_t>(column);
            const std::uint64_t bit = std::uint64_t{1} << (at % 64);
            if ((covered[at / 64] & bit) != 0) { continue; }
            covered[at / 64] |= bit;
            const glm::dvec3 sample_m = picture.sample_m(ground_, column, row);
            const glm::dvec3 seen = view.seen_m(sample_m);
            if (!view.shows(seen)) { continue; }
            const double surface_m = a.z + slope.east * (column - a.x) + slope.north * (row - a.y);
            glm::dvec3 drawn = view.seen_m({sample_m.x, sample_m.y, surface_m});
            drawn.z = std::max(drawn.z, view.near_m);
            band.errors_px.push_back(static_cast<float>(glm::distance(view.pixel(seen), view.pixel(drawn))));
        }
    }
}

void ProjectedErrorMeter::count_uncovered(Band& band, const Picture& picture) const {
    band.uncovered = 0;
    for (int row = band.first_row; row < band.end_row; ++row) {
        const std::uint64_t* const covered =
            band.covered.data() + static_cast<std::size_t>(row - band.first_row) * words_per_row_;
        for (int column = 0; column < ground_.columns(); ++column) {
            const auto at = static_cast<std::size_t>(column);
            if ((covered[at / 64] >> (at % 64) & 1U) == 0) {
                const glm::dvec3 sample_m = picture.sample_m(ground_, column, row);
                band.uncovered += picture.view.shows(picture.view.seen_m(sample_m)) ? 1 : 0;
            }
        }
    }
}

} // namespace octant::visuals::terrain
