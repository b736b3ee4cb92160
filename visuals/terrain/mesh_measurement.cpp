// Measures of meshes for studies, tests and `octant terrain error`: changes of the triangle count, projected error,
// conformity, the mesh's surface, and popping. No flight uses them.
#include "visuals/terrain/mesh_measurement.h"

#include "sim/base/nearest_rank.h"
#include "sim/base/plane.h"
#include "sim/base/thread_pool.h"
#include "visuals/terrain/frustum.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_precision.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <limits>

namespace octant::visuals::terrain {

// Figures for how quietly the number of triangles is held: E. K. Choi, B. S. Shin, "A Quadtree-Based CLOD Method that
// Minimize Flickering Effect", section 4, which plots dn for each frame.
//
// Deviations: the paper gives plots and no figures. Sign changes of dn alone mean nothing, because even the quietest
// run alternates by a few triangles; they are weighted by the amount that is taken back.

ChangeStatistics change_statistics(std::span<const int> triangles, std::size_t first) {
    ChangeStatistics figures;
    if (first < 1 || first >= triangles.size()) { return figures; }
    const auto change = [&](std::size_t k) { return triangles[k] - triangles[k - 1]; };
    const auto frames = static_cast<double>(triangles.size() - first);
    for (std::size_t k = first; k < triangles.size(); ++k) {
        const int size = std::abs(change(k));
        figures.mean += size / frames;
        figures.largest = std::max(figures.largest, size);
        if (k > first && (change(k) > 0) != (change(k - 1) > 0)) {
            figures.flicker_triangles += std::min(size, std::abs(change(k - 1))) / frames;
        }
    }
    return figures;
}

std::optional<int> frames_until_constant(std::span<const int> triangles, std::size_t stable_frames) {
    std::size_t first = triangles.size();
    while (first > 0 && triangles[first - 1] == triangles.back()) { --first; }
    return triangles.size() - first < stable_frames ? std::nullopt : std::optional(static_cast<int>(first));
}

std::optional<int> frames_until_within(std::span<const int> triangles, int target, double share, int stable_frames) {
    int near = 0;
    for (std::size_t k = 0; k < triangles.size(); ++k) {
        near = std::abs(triangles[k] - target) <= share * target ? near + 1 : 0;
        if (near == stable_frames) { return static_cast<int>(k) + 1 - stable_frames; }
    }
    return std::nullopt;
}

// The error of a mesh in pixels against the full-resolution ground: the measure by which the paper's quadtree and the
// default mesh are compared.
//
// Each triangle is rasterised in plan over the samples that it covers, its border included. One bit for each sample
// ensures that each counts once (both triangles at an edge have the same height there). Rows are divided into bands,
// always the same ones, which threads share.

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
    const double area2 = octant::signed_area2(glm::dvec2(a), glm::dvec2(b), glm::dvec2(c));
    if (area2 == 0.0) { return {}; }
    return {((b.z - a.z) * (c.y - a.y) - (c.z - a.z) * (b.y - a.y)) / area2,
        ((c.z - a.z) * (b.x - a.x) - (b.z - a.z) * (c.x - a.x)) / area2};
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

ProjectedErrorMeter::ProjectedErrorMeter(GroundSamples ground, int threads) : ground_(ground), threads_(threads) {
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
    band.covered =
        BitMatrix(static_cast<std::size_t>(band.end_row - band.first_row), static_cast<std::size_t>(ground_.columns()));
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
        const auto band_row = static_cast<std::size_t>(row - band.first_row);
        for (int column = first; column <= last; ++column) {
            if (band.covered.has(band_row, static_cast<std::size_t>(column))) { continue; }
            band.covered.add(band_row, static_cast<std::size_t>(column));
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
        const auto band_row = static_cast<std::size_t>(row - band.first_row);
        for (int column = 0; column < ground_.columns(); ++column) {
            if (!band.covered.has(band_row, static_cast<std::size_t>(column))) {
                const glm::dvec3 sample_m = picture.sample_m(ground_, column, row);
                band.uncovered += picture.view.shows(picture.view.seen_m(sample_m)) ? 1 : 0;
            }
        }
    }
}

// Tests that a mesh of the ground is conforming, by matching edges: the property that the paper's fans and the
// bisection promise, and that cracks violate.
//
// Edges are sorted by their vertices' numbers. An edge with a single triangle is allowed at the field's border and
// where the frustum does not see it. A vertex inside an edge leaves that edge open, so that only open edges need to be
// compared with vertices, and only with those of open edges.

namespace {

/// A triangle's side, by its vertices' numbers.
struct Edge {
    std::uint32_t low;
    std::uint32_t high;
    bool is_forward; ///< from low to high

    bool joins_same(const Edge& other) const { return low == other.low && high == other.high; }

    auto operator<=>(const Edge&) const = default;
};

/// All edges of a mesh, sorted.
std::vector<Edge> edges_of(const GroundMesh& mesh) {
    std::vector<Edge> edges;
    edges.reserve(mesh.indices.size());
    for (std::size_t k = 0; k < mesh.indices.size(); ++k) {
        const std::uint32_t from = mesh.indices[k];
        const std::uint32_t to = mesh.indices[k % 3 == 2 ? k - 2 : k + 1];
        edges.push_back({std::min(from, to), std::max(from, to), from < to});
    }
    std::ranges::sort(edges);
    return edges;
}

/// Whether any part of a line (relative to the eye) is inside the frustum by more than rounding.
bool is_seen(const glm::dvec3& a_m, const glm::dvec3& b_m, const MeshView& view) {
    const double rounding_m = 1e-2 + 1e-6 * std::max(glm::length(a_m), glm::length(b_m));
    double first = 0.0;
    double last = 1.0;
    for (const glm::dvec3& normal : view.frustum_normals) {
        if (normal == glm::dvec3(0.0)) { continue; }
        const double at_a = glm::dot(normal, a_m) - rounding_m;
        const double at_b = glm::dot(normal, b_m) - rounding_m;
        if (at_a < 0.0 && at_b < 0.0) { return false; }
        if (at_a < 0.0) {
            first = std::max(first, at_a / (at_a - at_b));
        } else if (at_b < 0.0) {
            last = std::min(last, at_a / (at_a - at_b));
        }
    }
    return first < last;
}

/// An order of positions: west before east, then south before north.
bool before(const glm::dvec2& a, const glm::dvec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

/// Vertices by their places in samples east and north.
using Places = std::vector<glm::dvec2>;

/// Counts vertices strictly inside open edges.
int count_t_junctions(const std::vector<Edge>& open, const Places& places) {
    std::vector<std::uint32_t> sorted;
    for (const Edge& edge : open) {
        sorted.push_back(edge.low);
        sorted.push_back(edge.high);
    }
    const auto by_place = [&](std::uint32_t a, std::uint32_t b) { return before(places[a], places[b]); };
    std::ranges::sort(sorted, by_place);
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    int corners = 0;
    for (const Edge& edge : open) {
        const auto [first, end] = std::minmax(edge.low, edge.high, by_place);
        for (auto at = std::upper_bound(sorted.begin(), sorted.end(), first, by_place);
             at != sorted.end() && before(places[*at], places[end]); ++at) {
            corners += octant::signed_area2(places[first], places[end], places[*at]) == 0.0 ? 1 : 0;
        }
    }
    return corners;
}

/// Counts vertices of triangles at places that another one has.
int count_duplicates(const GroundMesh& mesh, const Places& places) {
    std::vector<std::uint32_t> used(mesh.indices.begin(), mesh.indices.end());
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::ranges::sort(used, [&](std::uint32_t a, std::uint32_t b) { return before(places[a], places[b]); });
    int doubled = 0;
    for (std::size_t k = 1; k < used.size(); ++k) { doubled += places[used[k]] == places[used[k - 1]] ? 1 : 0; }
    return doubled;
}

} // namespace

std::string Conformity::text() const {
    return fmt::format("{} open edges, {} corners on edges, {} crowded edges, {} turned triangles, {} doubled "
                       "vertices",
        open_edges, t_junctions, overlapping_edges, inverted_triangles, duplicate_vertices);
}

Conformity check_conformity(const GroundSamples& ground, const GroundMesh& mesh, const MeshView& view) {
    Places places; // snapped to the grid
    for (const models::ColourVertex& vertex : mesh.vertices) {
        const glm::dvec2 world_m = glm::dvec2(vertex.position_m) + glm::dvec2(view.eye_m);
        places.push_back(glm::round((world_m + ground.half_extent_m()) * (snap_steps_per_sample / ground.spacing_m())) /
                         snap_steps_per_sample);
    }
    Conformity found;
    for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3) {
        const double area2 =
            octant::signed_area2(places[mesh.indices[k]], places[mesh.indices[k + 1]], places[mesh.indices[k + 2]]);
        found.inverted_triangles += area2 > 0.0 ? 0 : 1;
    }
    const glm::dvec2 last(ground.columns() - 1, ground.rows() - 1);
    const auto on_border = [&](const glm::dvec2& a, const glm::dvec2& b) {
        return (a.x == b.x && (a.x == 0.0 || a.x == last.x)) || (a.y == b.y && (a.y == 0.0 || a.y == last.y));
    };
    const std::vector<Edge> edges = edges_of(mesh);
    std::vector<Edge> open;
    for (std::size_t k = 0; k < edges.size();) {
        std::size_t end = k;
        std::array<int, 2> ways{};
        for (; end < edges.size() && edges[end].joins_same(edges[k]); ++end) { ++ways[edges[end].is_forward ? 1 : 0]; }
        found.overlapping_edges += ways[0] > 1 || ways[1] > 1 ? 1 : 0;
        const auto& [low, high, is_forward] = edges[k];
        if (end - k == 1 && !on_border(places[low], places[high])) {
            open.push_back(edges[k]);
            const bool seen =
                is_seen(glm::dvec3(mesh.vertices[low].position_m), glm::dvec3(mesh.vertices[high].position_m), view);
            found.open_edges += seen ? 1 : 0;
        }
        k = end;
    }
    found.t_junctions = count_t_junctions(open, places);
    found.duplicate_vertices = count_duplicates(mesh, places);
    return found;
}

// Point location in a mesh of very different triangles: a hashed hierarchical grid, in which every triangle is entered
// at the level of its own size.

namespace {

constexpr double smallest_cell_m = 1.0;
constexpr std::uint32_t none = ~std::uint32_t{0};

/// A position this far beyond an edge, as a share of the triangle's size, still belongs to the triangle. That is more
/// than the rounding of floats far from the eye.
constexpr double edge_share = 1e-6;

glm::ivec2 cell_of(const glm::dvec2& place_m, double cell_m) { return glm::ivec2(glm::floor(place_m / cell_m)); }

} // namespace

void MeshSurface::set_mesh(const GroundMesh& mesh, const glm::dvec3& eye_m) {
    eye_m_ = eye_m;
    indices_.assign(mesh.indices.begin(), mesh.indices.end());
    vertices_m_.clear();
    for (const models::ColourVertex& vertex : mesh.vertices) { vertices_m_.emplace_back(vertex.position_m); }
    entries_.clear();
    levels_used_ = 0;
    slots_.assign(std::bit_ceil(indices_.size() + 1), none);
    const auto triangles = static_cast<std::uint32_t>(indices_.size() / 3);
    for (std::uint32_t triangle = 0; triangle < triangles; ++triangle) { add(triangle); }
}

MeshSurface::Corners MeshSurface::corners_of(std::uint32_t triangle) const {
    const std::size_t first = 3 * static_cast<std::size_t>(triangle);
    return {vertices_m_[indices_[first]], vertices_m_[indices_[first + 1]], vertices_m_[indices_[first + 2]]};
}

std::size_t MeshSurface::slot_of(std::uint32_t level, std::int32_t column, std::int32_t row) const {
    const std::uint64_t place =
        std::uint64_t{static_cast<std::uint32_t>(column)} << 32U | static_cast<std::uint32_t>(row);
    const std::uint64_t mixed = (place ^ std::uint64_t{level} << 58U) * 0x9e3779b97f4a7c15ULL;
    return static_cast<std::size_t>(mixed >> 32U) & (slots_.size() - 1);
}

void MeshSurface::add(std::uint32_t triangle) {
    const auto [a, b, c] = corners_of(triangle);
    const glm::dvec2 min_m = glm::min(glm::min(glm::dvec2(a), glm::dvec2(b)), glm::dvec2(c));
    const glm::dvec2 max_m = glm::max(glm::max(glm::dvec2(a), glm::dvec2(b)), glm::dvec2(c));
    const double margin_m = edge_share * (max_m.x - min_m.x + max_m.y - min_m.y);
    const double size_m = std::max(max_m.x - min_m.x, max_m.y - min_m.y) + 2.0 * margin_m;
    const int level = std::clamp(static_cast<int>(std::ceil(std::log2(size_m))), 0, levels - 1);
    const double cell_m = std::ldexp(smallest_cell_m, level);
    levels_used_ |= 1U << static_cast<unsigned>(level);
    const glm::ivec2 first = cell_of(min_m - margin_m, cell_m);
    const glm::ivec2 last = cell_of(max_m + margin_m, cell_m);
    for (int row = first.y; row <= last.y; ++row) {
        for (int column = first.x; column <= last.x; ++column) {
            const auto level_number = static_cast<std::uint32_t>(level);
            std::uint32_t& slot = slots_[slot_of(level_number, column, row)];
            entries_.push_back({level_number, column, row, triangle, slot});
            slot = static_cast<std::uint32_t>(entries_.size() - 1);
        }
    }
}

bool MeshSurface::covers(std::uint32_t triangle, const glm::dvec2& place_m) const {
    const auto [a, b, c] = corners_of(triangle);
    const glm::dvec2 p(a);
    const glm::dvec2 q(b);
    const glm::dvec2 r(c);
    const double min_area = -edge_share * octant::signed_area2(p, q, r);
    return octant::signed_area2(p, q, place_m) >= min_area && octant::signed_area2(q, r, place_m) >= min_area &&
           octant::signed_area2(r, p, place_m) >= min_area;
}

std::optional<std::uint32_t> MeshSurface::triangle_at(double x_m, double y_m) const {
    const glm::dvec2 place_m = glm::dvec2(x_m, y_m) - glm::dvec2(eye_m_);
    for (std::uint32_t left = levels_used_; left != 0; left &= left - 1) {
        const auto level = static_cast<std::uint32_t>(std::countr_zero(left));
        const glm::ivec2 cell = cell_of(place_m, std::ldexp(smallest_cell_m, static_cast<int>(level)));
        for (std::uint32_t k = slots_[slot_of(level, cell.x, cell.y)]; k != none;) {
            const Entry& entry = entries_[k];
            if (entry.level == level && entry.column == cell.x && entry.row == cell.y &&
                covers(entry.triangle, place_m)) {
                return entry.triangle;
            }
            k = entry.next;
        }
    }
    return std::nullopt;
}

std::optional<double> MeshSurface::height_at(double x_m, double y_m) const {
    const auto triangle = triangle_at(x_m, y_m);
    if (!triangle) { return std::nullopt; }
    const auto [a, b, c] = corners_of(*triangle);
    const glm::dvec2 place_m = glm::dvec2(x_m, y_m) - glm::dvec2(eye_m_);
    const double whole = octant::signed_area2(glm::dvec2(a), glm::dvec2(b), glm::dvec2(c));
    if (whole == 0.0) { return eye_m_.z + a.z; }
    const double of_b = octant::signed_area2(glm::dvec2(a), place_m, glm::dvec2(c)) / whole;
    const double of_c = octant::signed_area2(glm::dvec2(a), glm::dvec2(b), place_m) / whole;
    return eye_m_.z + a.z + of_b * (b.z - a.z) + of_c * (c.z - a.z);
}

std::optional<double> MeshSurface::first_hit(const glm::dvec3& from_m, const glm::dvec3& to_m) const {
    const glm::dvec3 start = from_m - eye_m_;
    const glm::dvec3 way = to_m - from_m;
    double nearest = std::numeric_limits<double>::infinity();
    const auto triangles = static_cast<std::uint32_t>(indices_.size() / 3);
    for (std::uint32_t triangle = 0; triangle < triangles; ++triangle) {
        const auto [a, b, c] = corners_of(triangle);
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        const double approach = glm::dot(normal, way);
        if (approach == 0.0) { continue; }
        const double share = glm::dot(normal, a - start) / approach;
        if (share < 0.0 || share > 1.0 || share >= nearest) { continue; }
        if (covers(triangle, glm::dvec2(start + way * share))) { nearest = share; }
    }
    return nearest <= 1.0 ? std::optional(nearest) : std::nullopt;
}

// Popping: the jumps of vertices, which geomorphs remove. The quadtree paper counts triangles only. `octant study
// popping` plots it along flights.
//
// Most vertices of a mesh are in the next one, too, and tell its height there. A vertex that only one of two meshes has
// lies in the middle of an edge that is within one triangle of the other mesh (bisection_mesher.cpp), so that the other
// surface's height is the mean of that at the edge's ends. Only where a mesh does not tell the ends of its vertices is
// its surface searched.

namespace {

/// The cell of a grid that is finer than samples lie apart.
glm::i64vec2 cell_of(const glm::dvec2& place_m) {
    constexpr double cell_m = 0.25;
    return glm::i64vec2(glm::floor(place_m / cell_m));
}

} // namespace

void PoppingMeter::Frame::set_mesh(const GroundMesh& mesh, const PerspectiveView& view) {
    view_ = view;
    vertices_.assign(mesh.vertices.begin(), mesh.vertices.end());
    indices_.assign(mesh.indices.begin(), mesh.indices.end());
    morphs_.assign(mesh.morphs.begin(), mesh.morphs.end());
    has_surface_ = false;
    used_.assign(vertices_.size(), 0);
    for (const std::uint32_t vertex : indices_) { used_[vertex] = 1; }
    vertices_m_.clear();
    slots_.assign(std::bit_ceil(4 * vertices_.size() + 1), 0);
    for (std::uint32_t vertex = 0; vertex < vertices_.size(); ++vertex) {
        vertices_m_.push_back(view.eye_m + glm::dvec3(vertices_[vertex].position_m));
        // Vertices that are only ends of others are on the surface; what else is unused may not be.
        if (used_[vertex] == 0 && morphs_.empty()) { continue; }
        std::size_t slot = slot_of(cell_of(glm::dvec2(vertices_m_.back())));
        while (slots_[slot] != 0) { slot = (slot + 1) & (slots_.size() - 1); }
        slots_[slot] = vertex + 1;
    }
}

template <typename Take>
void PoppingMeter::Frame::for_each_used(const Take& set_mesh) const {
    for (std::uint32_t vertex = 0; vertex < used_.size(); ++vertex) {
        if (used_[vertex] != 0) { set_mesh(vertex, vertices_m_[vertex]); }
    }
}

std::size_t PoppingMeter::Frame::slot_of(const glm::i64vec2& cell) const {
    const auto column = static_cast<std::uint64_t>(cell.x);
    const auto row = static_cast<std::uint64_t>(cell.y);
    const std::uint64_t mixed = (column << 32U ^ (row & 0xffffffffU)) * 0x9e3779b97f4a7c15ULL;
    return static_cast<std::size_t>(mixed >> 32U) & (slots_.size() - 1);
}

/// The height of this mesh's own vertex at a place; nothing where it has none.
std::optional<double> PoppingMeter::Frame::own_height_at(const glm::dvec3& place_m) const {
    constexpr double rounding = 1e-6; // Positions are floats from the eye.
    const glm::dvec2 place(place_m);
    const glm::dvec2 away_m = glm::abs(place - glm::dvec2(view_.eye_m));
    const double near_m = rounding * (away_m.x + away_m.y);
    const glm::i64vec2 first = cell_of(place - near_m);
    const glm::i64vec2 last = cell_of(place + near_m);
    glm::i64vec2 cell = first;
    for (cell.y = first.y; cell.y <= last.y; ++cell.y) {
        for (cell.x = first.x; cell.x <= last.x; ++cell.x) {
            for (std::size_t slot = slot_of(cell); slots_[slot] != 0; slot = (slot + 1) & (slots_.size() - 1)) {
                const glm::dvec3& own_m = vertices_m_[slots_[slot] - 1];
                const glm::dvec2 off_m = glm::abs(glm::dvec2(own_m) - place);
                if (off_m.x + off_m.y <= near_m) { return own_m.z; }
            }
        }
    }
    return std::nullopt;
}

std::optional<double> PoppingMeter::Frame::height_at(const Frame& other, std::uint32_t vertex) {
    const glm::dvec3& place_m = other.vertices_m_[vertex];
    if (const auto own_m = own_height_at(place_m)) { return own_m; }
    if (!morphs_.empty() && !other.morphs_.empty()) {
        const VertexMorph& origin = other.morphs_[vertex];
        if (origin.parent_a != vertex) {
            const auto from_a = height_at(other, origin.parent_a);
            const auto from_b = height_at(other, origin.parent_b);
            return from_a && from_b ? std::optional(0.5 * (*from_a + *from_b)) : std::nullopt;
        }
    }
    if (!has_surface_) {
        GroundMesh mesh;
        mesh.vertices = vertices_;
        mesh.indices = indices_;
        surface_.set_mesh(mesh, view_.eye_m);
        has_surface_ = true;
    }
    return surface_.height_at(place_m.x, place_m.y);
}

std::optional<VertexPopping> PoppingMeter::next(const GroundMesh& mesh, const PerspectiveView& view) {
    Frame& later = frames_[taken_ % 2];
    Frame& earlier = frames_[(taken_ + 1) % 2];
    later.set_mesh(mesh, view);
    if (++taken_ == 1) { return std::nullopt; }
    VertexPopping largest;
    compare_at(later, earlier, later, largest);
    compare_at(earlier, later, later, largest);
    return largest;
}

/// Compares the vertices of `own` with the surface of `other`, as seen from `later`.
void PoppingMeter::compare_at(const Frame& own, Frame& other, const Frame& later, VertexPopping& largest) {
    const PerspectiveView& view = later.view();
    own.for_each_used([&](std::uint32_t vertex, const glm::dvec3& vertex_m) {
        const auto shows = [&vertex_m](const PerspectiveView& picture) {
            return picture.shows(picture.seen_m(vertex_m - picture.eye_m));
        };
        if (!shows(own.view()) || !shows(other.view())) { return; }
        const auto height_m = other.height_at(own, vertex);
        if (!height_m) { return; }
        const glm::dvec3 there = view.seen_m(glm::dvec3(vertex_m.x, vertex_m.y, *height_m) - view.eye_m);
        if (there.z < view.near_m) { return; }
        const glm::dvec3 seen = view.seen_m(vertex_m - view.eye_m);
        const double popping_px = glm::distance(view.pixel(seen), view.pixel(there));
        if (popping_px > largest.popping_px) { largest = {popping_px, vertex_m}; }
    });
}

} // namespace octant::visuals::terrain
