// Files have a vertex twice where colours break. Welded it is one vertex of the surface with
// several corners, the wedges of H. Hoppe, "Efficient Implementation of Progressive Meshes", 1998.
// Here a wedge is a vertex and the chart it is seen from; its colour is that of the original's
// nearest point in that chart, so that no colour runs over a seam, however the seam was simplified.
#include "models/simplify/colour_seams.h"

#include "models/measure/triangle_bvh.h"
#include "models/no_index.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <utility>

namespace octant::models::simplify {

namespace {

/// Colours break where a part of them differs by more: a few steps of eight bits do not show.
constexpr float alike_within = 0.02F;

bool is_alike(const glm::vec3& a, const glm::vec3& b) {
    for (int part = 0; part < 3; ++part) {
        if (std::abs(a[part] - b[part]) > alike_within) {
            return false;
        }
    }
    return true;
}

/// A triangle's side, from its smaller vertex to its larger one.
struct ColouredSide {
    std::array<std::uint32_t, 2> ends{};
    std::array<glm::vec3, 2> colours{};
    std::uint32_t triangle = 0;
};

std::vector<ColouredSide>
sorted_sides(const TriangleMesh& mesh, std::span<const CornerColours> corner_colours) {
    std::vector<ColouredSide> sides;
    sides.reserve(3 * mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            std::size_t from = k;
            std::size_t to = (k + 1) % 3;
            if (mesh.triangles[t][from] > mesh.triangles[t][to]) {
                std::swap(from, to);
            }
            sides.push_back(
                {{mesh.triangles[t][from], mesh.triangles[t][to]},
                 {corner_colours[t][from], corner_colours[t][to]},
                 t});
        }
    }
    std::ranges::stable_sort(sides, {}, &ColouredSide::ends);
    return sides;
}

/// For each triangle the first one of its chart.
std::vector<std::uint32_t>
charts_of(const TriangleMesh& mesh, std::span<const CornerColours> corner_colours) {
    std::vector<std::uint32_t> charts(mesh.triangles.size());
    std::iota(charts.begin(), charts.end(), 0U);
    const auto first_of = [&](std::uint32_t triangle) {
        while (charts[triangle] != triangle) {
            charts[triangle] = charts[charts[triangle]];
            triangle = charts[triangle];
        }
        return triangle;
    };
    const std::vector<ColouredSide> sides = sorted_sides(mesh, corner_colours);
    for (std::size_t i = 1; i < sides.size(); ++i) {
        const ColouredSide& one = sides[i - 1];
        const ColouredSide& other = sides[i];
        if (one.ends == other.ends && is_alike(one.colours[0], other.colours[0]) &&
            is_alike(one.colours[1], other.colours[1])) {
            const auto [first, later] =
                std::minmax({first_of(one.triangle), first_of(other.triangle)});
            charts[later] = first;
        }
    }
    for (std::uint32_t t = 0; t < charts.size(); ++t) {
        charts[t] = first_of(t);
    }
    return charts;
}

/// Vertices where charts meet, and those next to them: their colours were fitted to a mean.
std::vector<bool> near_seams(const TriangleMesh& made) {
    std::vector<std::uint32_t> mark_at(made.vertices_m.size(), no_index);
    std::vector<bool> on_seam(made.vertices_m.size(), false);
    for (std::size_t t = 0; t < made.triangles.size(); ++t) {
        for (const std::uint32_t vertex : made.triangles[t]) {
            on_seam[vertex] = on_seam[vertex] || (mark_at[vertex] != no_index &&
                                                  mark_at[vertex] != made.triangle_materials[t]);
            mark_at[vertex] = made.triangle_materials[t];
        }
    }
    std::vector<bool> near = on_seam;
    for (const auto& [a, b, c] : made.triangles) {
        if (on_seam[a] || on_seam[b] || on_seam[c]) {
            near[a] = near[b] = near[c] = true;
        }
    }
    return near;
}

/// Gives wedges their vertices and colours.
class WedgeMaker {
public:
    WedgeMaker(const TriangleMesh& original, std::span<const CornerColours> corner_colours)
        : original_(original)
        , corner_colours_(corner_colours) {}

    /// Takes the chart from which the next wedges are seen.
    void see_from(std::vector<std::uint32_t> triangles) {
        triangles_ = std::move(triangles);
        std::vector<Triangle> corners;
        for (const std::uint32_t triangle : triangles_) {
            corners.push_back(original_.triangles[triangle]);
        }
        bvh_ = measure::TriangleBvh(original_.vertices_m, corners);
        vertex_of_.clear();
    }

    /// The vertex of a wedge: the given one for the first chart that asks, or a copy of it.
    std::uint32_t wedge_at(TriangleMesh& made, std::uint32_t vertex) {
        const auto [at, is_new] = vertex_of_.try_emplace(vertex, vertex);
        if (is_new) {
            taken_.resize(std::max(taken_.size(), std::size_t{vertex} + 1), false);
            if (taken_[vertex]) {
                at->second = static_cast<std::uint32_t>(made.vertices_m.size());
                made.vertices_m.push_back(glm::dvec3(made.vertices_m[vertex]));
                made.colours.emplace_back();
            }
            taken_[vertex] = true;
            made.colours[at->second] = colour_at(made.vertices_m[vertex]);
        }
        return at->second;
    }

private:
    glm::vec3 colour_at(const glm::dvec3& place_m) const {
        const measure::NearestOnMesh nearest = bvh_.nearest(place_m);
        const CornerColours& colours = corner_colours_[triangles_[nearest.triangle]];
        const glm::vec3 weights(nearest.weights);
        return weights.x * colours[0] + weights.y * colours[1] + weights.z * colours[2];
    }

    const TriangleMesh& original_;
    std::span<const CornerColours> corner_colours_;
    std::vector<std::uint32_t> triangles_; ///< of the chart
    measure::TriangleBvh bvh_{std::span<const glm::dvec3>(), std::span<const Triangle>()};
    std::map<std::uint32_t, std::uint32_t> vertex_of_;
    std::vector<bool> taken_; ///< vertices that are some chart's own already
};

} // namespace

ColourSeams::ColourSeams(TriangleMesh mesh, std::vector<CornerColours> corner_colours)
    : marked_(std::move(mesh))
    , corner_colours_(std::move(corner_colours)) {
    if (corner_colours_.empty()) {
        return;
    }
    materials_ = std::exchange(marked_.materials, {});
    const std::vector<std::uint32_t> charts = charts_of(marked_, corner_colours_);
    std::vector<std::uint32_t> materials = std::exchange(marked_.triangle_materials, {});
    materials.resize(charts.size(), no_index);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> marks;
    for (std::size_t t = 0; t < charts.size(); ++t) {
        const auto next = static_cast<std::uint32_t>(marked_.materials.size());
        const auto [at, is_new] = marks.try_emplace({charts[t], materials[t]}, next);
        if (is_new) {
            materials_of_marks_.push_back(materials[t]);
            marked_.materials.emplace_back();
        }
        marked_.triangle_materials.push_back(at->second);
    }
}

TriangleMesh ColourSeams::broken(TriangleMesh made) const {
    if (corner_colours_.empty()) {
        return made;
    }
    const std::vector<bool> near = near_seams(made);
    std::vector<std::vector<std::uint32_t>> made_of(materials_of_marks_.size());
    for (std::uint32_t t = 0; t < made.triangles.size(); ++t) {
        made_of[made.triangle_materials[t]].push_back(t);
    }
    std::vector<std::vector<std::uint32_t>> original_of(materials_of_marks_.size());
    for (std::uint32_t t = 0; t < marked_.triangles.size(); ++t) {
        original_of[marked_.triangle_materials[t]].push_back(t);
    }
    WedgeMaker wedges(marked_, corner_colours_);
    for (std::size_t mark = 0; mark < made_of.size(); ++mark) {
        if (made_of[mark].empty()) {
            continue;
        }
        wedges.see_from(std::move(original_of[mark]));
        for (const std::uint32_t t : made_of[mark]) {
            for (std::uint32_t& vertex : made.triangles[t]) {
                vertex = near[vertex] ? wedges.wedge_at(made, vertex) : vertex;
            }
        }
    }
    give_materials_back(made);
    return made;
}

void ColourSeams::give_materials_back(TriangleMesh& made) const {
    made.materials = materials_;
    for (std::uint32_t& mark : made.triangle_materials) {
        mark = materials_of_marks_[mark];
    }
    if (materials_.empty()) {
        made.triangle_materials.clear();
    }
}

} // namespace octant::models::simplify
