// Files have a vertex twice where colours or texture coordinates break. Welded it is one vertex of the surface with
// several corners, the wedges of H. Hoppe, "Efficient Implementation of Progressive Meshes", 1998. Here a wedge is a
// vertex and the chart it is seen from; its attributes are those of the original's nearest point in that chart, so that
// nothing runs over a seam, however the seam was simplified.
//
// A seam may have one and the same chart on both sides, such as the seam of a cylinder's mantle. The nearest point
// would then be found on either side of it, so such a chart is cut in two or more, none of which meets itself at a
// seam.

#include "models/simplify/attribute_seams.h"

#include "models/mesh_edges.h"
#include "models/triangle_mesh.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <deque>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>

namespace octant::models::simplify {

namespace {

/// Colours break where a part of them differs by more: a few steps of eight bits do not show.
constexpr float colours_alike = 0.02F;
/// Texture coordinates break where one of them differs by more: the hundredth part of a pixel of a picture 1,000 pixels
/// wide.
constexpr float textures_alike = 1e-5F;

template <typename Vector>
bool is_alike(const Vector& a, const Vector& b, float within) {
    for (int part = 0; part < Vector::length(); ++part) {
        if (!(std::abs(a[part] - b[part]) <= within)) { return false; }
    }
    return true;
}

constexpr double degrees_per_radian = 180.0 / std::numbers::pi;

/// What the corners of a mesh have; either may be empty.
struct Attributes {
    std::span<const CornerColours> colours;
    std::span<const glm::vec2> textures;
    std::span<const Triangle> corner_textures;

    /// Whether they agree at a corner of one triangle and a corner of another.
    bool agree(std::uint32_t t, std::size_t k, std::uint32_t other, std::size_t j) const {
        if (!colours.empty() && !is_alike(colours[t][k], colours[other][j], colours_alike)) { return false; }
        if (corner_textures.empty()) { return true; }
        const std::uint32_t a = corner_textures[t][k];
        const std::uint32_t b = corner_textures[other][j];
        return a == b ||
               (a != invalid_index && b != invalid_index && is_alike(textures[a], textures[b], textures_alike));
    }
};

/// Two triangles with a common edge.
struct Neighbours {
    std::uint32_t first = 0;
    std::uint32_t second = 0;
    bool agree = false; ///< Attributes do not break at the edge.
};

std::vector<Neighbours> neighbours_of(const TriangleMesh& mesh, const Attributes& attributes) {
    const std::vector<TriangleEdge> sides = sorted_triangle_edges(mesh.triangles);
    std::vector<Neighbours> neighbours;
    for_each_edge(sides, [&](std::span<const TriangleEdge> edge) {
        for (std::size_t i = 1; i < edge.size(); ++i) {
            const TriangleEdge& one = edge[i - 1];
            const TriangleEdge& other = edge[i];
            const std::uint32_t first = one.triangle;
            const std::uint32_t second = other.triangle;
            const bool agree = attributes.agree(first, one.min_corner(), second, other.min_corner()) &&
                               attributes.agree(first, one.max_corner(), second, other.max_corner());
            neighbours.push_back({first, second, agree});
        }
    });
    return neighbours;
}

/// Cuts charts that meet themselves at a seam.
class ChartCuts {
public:
    ChartCuts(std::span<const Neighbours> neighbours, std::size_t triangles)
        : neighbours_(neighbours), sets_(triangles), cells_(triangles, invalid_index) {
        for (const Neighbours& pair : neighbours) {
            if (pair.agree) { sets_.join(pair.first, pair.second); }
        }
    }

    /// For each triangle a number that all triangles of its chart have, and no others.
    std::vector<std::uint32_t> charts() {
        std::vector<std::uint32_t> whole(cells_.size());
        for (std::uint32_t t = 0; t < whole.size(); ++t) { whole[t] = sets_.group_of(t); }
        if (!find_self_meetings(whole)) { return whole; }
        grow_cells();
        join_cells();
        for (std::uint32_t t = 0; t < whole.size(); ++t) {
            whole[t] = cells_[t] == invalid_index ? whole[t] : sets_.group_of(cells_[t]);
        }
        return whole;
    }

private:
    /// Every triangle at a seam between a chart and itself begins a cell, called by its number.
    bool find_self_meetings(const std::vector<std::uint32_t>& whole) {
        for (const Neighbours& pair : neighbours_) {
            if (!pair.agree && whole[pair.first] == whole[pair.second]) {
                cells_[pair.first] = pair.first;
                cells_[pair.second] = pair.second;
                meetings_[pair.first].insert(pair.second);
                meetings_[pair.second].insert(pair.first);
            }
        }
        return !meetings_.empty();
    }

    /// Each triangle of these charts joins the cell that begins the fewest steps away.
    void grow_cells() {
        std::vector<std::vector<std::uint32_t>> next_to(cells_.size());
        for (const Neighbours& pair : neighbours_) {
            if (pair.agree) {
                next_to[pair.first].push_back(pair.second);
                next_to[pair.second].push_back(pair.first);
            }
        }
        std::deque<std::uint32_t> waiting;
        for (const auto& [triangle, others] : meetings_) { waiting.push_back(triangle); }
        while (!waiting.empty()) {
            const std::uint32_t triangle = waiting.front();
            waiting.pop_front();
            for (const std::uint32_t other : next_to[triangle]) {
                if (cells_[other] == invalid_index) {
                    cells_[other] = cells_[triangle];
                    waiting.push_back(other);
                }
            }
        }
    }

    /// Cells become one, those with the longest common borders first, unless they meet at a seam.
    void join_cells() {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> borders;
        for (const Neighbours& pair : neighbours_) {
            if (pair.agree && cells_[pair.first] != cells_[pair.second]) {
                ++borders[std::minmax(cells_[pair.first], cells_[pair.second])];
            }
        }
        using Border = std::pair<std::pair<std::uint32_t, std::uint32_t>, std::size_t>;
        std::vector<Border> sorted(borders.begin(), borders.end());
        std::ranges::stable_sort(sorted, std::ranges::greater(), &Border::second);
        sets_ = DisjointSets(cells_.size());
        for (const Border& border : sorted) {
            join(sets_.group_of(border.first.first), sets_.group_of(border.first.second));
        }
    }

    void join(std::uint32_t a, std::uint32_t b) {
        if (a == b || meetings_[a].contains(b)) { return; }
        const auto [first, later] = std::minmax(a, b);
        sets_.join(first, later);
        for (const std::uint32_t other : meetings_[later]) {
            meetings_[other].erase(later);
            meetings_[other].insert(first);
            meetings_[first].insert(other);
        }
        meetings_.erase(later);
    }

    std::span<const Neighbours> neighbours_;
    DisjointSets sets_;
    std::vector<std::uint32_t> cells_; ///< of triangles in charts that meet themselves
    /// For each cell, by the first number of its set, those that it meets at seams.
    std::map<std::uint32_t, std::set<std::uint32_t>> meetings_;
};

/// Vertices where charts meet, and those next to them: their colours were fitted to a mean.
std::vector<bool> near_seams(const TriangleMesh& made) {
    std::vector<std::uint32_t> mark_at(made.vertices_m.size(), invalid_index);
    std::vector<bool> on_seam(made.vertices_m.size(), false);
    for (std::size_t t = 0; t < made.triangles.size(); ++t) {
        for (const std::uint32_t vertex : made.triangles[t]) {
            on_seam[vertex] =
                on_seam[vertex] || (mark_at[vertex] != invalid_index && mark_at[vertex] != made.triangle_materials[t]);
            mark_at[vertex] = made.triangle_materials[t];
        }
    }
    std::vector<bool> near = on_seam;
    for (const auto& [a, b, c] : made.triangles) {
        if (on_seam[a] || on_seam[b] || on_seam[c]) { near[a] = near[b] = near[c] = true; }
    }
    return near;
}

/// Where texture coordinates are looked at in a triangle, besides its corners, where they are right.
std::vector<glm::dvec3> sample_weights() {
    constexpr int fields = 4;
    std::vector<glm::dvec3> weights;
    for (int i = 0; i <= fields; ++i) {
        for (int j = 0; i + j <= fields; ++j) {
            const glm::dvec3 weight(i, j, fields - i - j);
            if (std::max({weight.x, weight.y, weight.z}) < fields) {
                weights.push_back(weight / static_cast<double>(fields));
            }
        }
    }
    return weights;
}

glm::dvec3 place_m(const TriangleMesh& mesh, const Triangle& triangle, const glm::dvec3& weights) {
    return weights.x * mesh.vertices_m[triangle[0]] + weights.y * mesh.vertices_m[triangle[1]] +
           weights.z * mesh.vertices_m[triangle[2]];
}

/// The longest side of a triangle: its corner before the next one, and its squared length.
std::pair<std::size_t, double> longest_side(const TriangleMesh& mesh, const Triangle& triangle) {
    std::pair<std::size_t, double> longest(0, -1.0);
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 side = mesh.vertices_m[triangle[(k + 1) % 3]] - mesh.vertices_m[triangle[k]];
        if (glm::dot(side, side) > longest.second) { longest = {k, glm::dot(side, side)}; }
    }
    return longest;
}

/// Divides edges of a mesh at their midpoints, each triangle at most once.
class EdgeDivision {
public:
    explicit EdgeDivision(TriangleMesh& mesh) : mesh_(mesh), is_divided_(mesh.triangles.size(), false) {
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                sides_[{mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]}] = {t, k};
            }
        }
    }

    void divide(std::uint32_t triangle, std::size_t side) {
        const std::uint32_t from = mesh_.triangles[triangle][side];
        const std::uint32_t to = mesh_.triangles[triangle][(side + 1) % 3];
        const auto other = sides_.find({to, from});
        if (is_divided_[triangle] || (other != sides_.end() && is_divided_[other->second.first])) { return; }
        const auto middle = static_cast<std::uint32_t>(mesh_.vertices_m.size());
        mesh_.vertices_m.push_back(0.5 * (mesh_.vertices_m[from] + mesh_.vertices_m[to]));
        if (!mesh_.colours.empty()) { mesh_.colours.push_back(0.5F * (mesh_.colours[from] + mesh_.colours[to])); }
        cut(triangle, side, middle);
        if (other != sides_.end()) { cut(other->second.first, other->second.second, middle); }
    }

    /// Triangles that were divided, and the new ones.
    std::vector<std::uint32_t> changed() const {
        std::vector<std::uint32_t> triangles;
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            if (t >= is_divided_.size() || is_divided_[t]) { triangles.push_back(t); }
        }
        return triangles;
    }

private:
    /// The triangle keeps the first half of the side, a new one gets the other.
    void cut(std::uint32_t t, std::size_t side, std::uint32_t middle) {
        const std::size_t next = (side + 1) % 3;
        is_divided_[t] = true;
        Triangle half = mesh_.triangles[t];
        half[side] = middle;
        mesh_.triangles[t][next] = middle;
        mesh_.triangles.push_back(half);
        if (!mesh_.triangle_materials.empty()) {
            mesh_.triangle_materials.push_back(std::uint32_t{mesh_.triangle_materials[t]});
        }
    }

    TriangleMesh& mesh_;
    std::vector<bool> is_divided_; ///< of the triangles at the beginning
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::uint32_t, std::size_t>> sides_;
};

} // namespace

AttributeSeams::AttributeSeams(TriangleMesh mesh, std::vector<CornerColours> corner_colours)
    : marked_(std::move(mesh)), corner_colours_(std::move(corner_colours)),
      textures_(std::exchange(marked_.texture_coordinates, {})),
      corner_textures_(std::exchange(marked_.corner_texture_coordinates, {})),
      normals_(std::exchange(marked_.normals, {})), corner_normals_(std::exchange(marked_.corner_normals, {})) {
    if (!corner_colours_.empty() || has_texture_coordinates()) {
        const std::vector<Neighbours> neighbours =
            neighbours_of(marked_, {corner_colours_, textures_, corner_textures_});
        const std::vector<std::uint32_t> charts = ChartCuts(neighbours, marked_.triangles.size()).charts();
        mark(charts);
        next_to_.assign(marked_.triangles.size(), {invalid_index, invalid_index, invalid_index});
        for (const Neighbours& pair : neighbours) {
            if (charts[pair.first] == charts[pair.second]) {
                *std::ranges::find(next_to_[pair.first], invalid_index) = pair.second;
                *std::ranges::find(next_to_[pair.second], invalid_index) = pair.first;
            }
        }
    } else if (has_normals() || has_colours()) {
        mark(std::vector<std::uint32_t>(marked_.triangles.size(), 0));
    }
}

/// Gives each chart and each material in it a material of its own.
void AttributeSeams::mark(const std::vector<std::uint32_t>& charts) {
    materials_ = std::exchange(marked_.materials, {});
    std::vector<std::uint32_t> materials = std::exchange(marked_.triangle_materials, {});
    materials.resize(charts.size(), invalid_index);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> marks;
    std::vector<std::vector<std::uint32_t>> triangles;
    for (std::uint32_t t = 0; t < charts.size(); ++t) {
        const auto next = static_cast<std::uint32_t>(marked_.materials.size());
        const auto [at, is_new] = marks.try_emplace({charts[t], materials[t]}, next);
        if (is_new) {
            material_of_mark_.push_back(materials[t]);
            marked_.materials.emplace_back();
            triangles.emplace_back();
        }
        marked_.triangle_materials.push_back(at->second);
        triangles[at->second].push_back(t);
    }
    for (std::vector<std::uint32_t>& of_chart : triangles) { charts_.push_back(chart_of(std::move(of_chart))); }
    if (charts_.size() == 1 && materials_.empty()) {
        marked_.materials.clear();
        marked_.triangle_materials.clear();
    }
}

AttributeSeams::Chart AttributeSeams::chart_of(std::vector<std::uint32_t> triangles) const {
    std::vector<Triangle> corners;
    for (const std::uint32_t t : triangles) { corners.push_back(marked_.triangles[t]); }
    measure::TriangleBvh bvh(marked_.vertices_m, corners);
    return {std::move(triangles), std::move(bvh)};
}

/// Where a triangle has moved off its chart a little, its corners may be nearest to another end of the chart. Texture
/// coordinates then change more within the triangle than between its corners.
std::optional<AttributeSeams::Chart> AttributeSeams::discontinuous_part(
    const TriangleMesh& made, std::size_t triangle) const {
    constexpr double jump2 = 0.0625; // of the squared difference between corners
    const Chart& chart = charts_[chart_at(made, triangle)];
    const auto at = [&](const glm::dvec3& at_m) { return texture_at(chart, chart.bvh.nearest(at_m)); };
    const Triangle& corners = made.triangles[triangle];
    std::array<glm::dvec2, 3> places;
    for (std::size_t k = 0; k < 3; ++k) { places.at(k) = at(made.vertices_m[corners[k]]); }
    double largest2 = 0.0;
    double off2 = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        const glm::dvec2 side = places.at(next) - places.at(k);
        const glm::dvec3 middle_m = 0.5 * (made.vertices_m[corners[k]] + made.vertices_m[corners[next]]);
        const glm::dvec2 off = 0.5 * (places.at(next) + places.at(k)) - at(middle_m);
        largest2 = std::max(largest2, glm::dot(side, side));
        off2 = std::max(off2, glm::dot(off, off));
    }
    if (off2 <= jump2 * largest2) { return std::nullopt; }
    const glm::dvec3 centre_m = place_m(made, corners, glm::dvec3(1.0 / 3.0));
    double reach_m = 0.0;
    for (const std::uint32_t corner : corners) {
        reach_m = std::max(reach_m, 1.5 * glm::distance(made.vertices_m[corner], centre_m));
    }
    const measure::NearestOnMesh nearest = chart.bvh.nearest(centre_m);
    reach_m += std::sqrt(nearest.distance2);
    std::vector<std::uint32_t> part{chart.triangles[nearest.triangle]};
    std::set<std::uint32_t> is_met{part.front()};
    for (std::size_t i = 0; i < part.size(); ++i) {
        for (const std::uint32_t other : next_to_[part[i]]) {
            const bool is_near =
                other != invalid_index && std::ranges::any_of(marked_.triangles[other], [&](std::uint32_t vertex) {
                    return glm::distance(marked_.vertices_m[vertex], centre_m) <= reach_m;
                });
            if (is_near && is_met.insert(other).second) { part.push_back(other); }
        }
    }
    return chart_of(std::move(part));
}

std::uint32_t AttributeSeams::chart_at(const TriangleMesh& made, std::size_t triangle) {
    return made.triangle_materials.empty() ? 0 : made.triangle_materials[triangle];
}

bool AttributeSeams::is_textured(const Chart& chart) const {
    return has_texture_coordinates() && corner_textures_[chart.triangles.front()][0] != invalid_index;
}

AttributeSeams::Lookup AttributeSeams::lookup(const TriangleMesh& made, std::size_t triangle) const {
    Lookup found;
    found.chart = &charts_[chart_at(made, triangle)];
    found.is_textured = is_textured(*found.chart);
    if (found.is_textured) { found.part = discontinuous_part(made, triangle); }
    found.facing = normal_of(made, made.triangles[triangle]);
    found.middle_m = place_m(made, made.triangles[triangle], glm::dvec3(1.0 / 3.0));
    return found;
}

glm::dvec2 AttributeSeams::texture_at(const Chart& chart, const measure::NearestOnMesh& nearest) const {
    const auto [a, b, c] = corner_textures_[chart.triangles[nearest.triangle]];
    return nearest.weights.x * glm::dvec2(textures_[a]) + nearest.weights.y * glm::dvec2(textures_[b]) +
           nearest.weights.z * glm::dvec2(textures_[c]);
}

glm::dvec3 AttributeSeams::colour_at(const Chart& chart, const measure::NearestOnMesh& nearest) const {
    const std::uint32_t triangle = chart.triangles[nearest.triangle];
    glm::dvec3 sum(0.0);
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec3& colour =
            corner_colours_.empty() ? marked_.colours[marked_.triangles[triangle][k]] : corner_colours_[triangle][k];
        sum += nearest.weights[static_cast<int>(k)] * glm::dvec3(colour);
    }
    return sum;
}

/// At a crease the nearest point (`known`, if not null) may lie on the wrong side. Where the triangle there faces
/// another way, points further inside the triangle of the result are asked.
glm::dvec3 AttributeSeams::normal_at(
    const Lookup& lookup, const glm::dvec3& at_m, const measure::NearestOnMesh* known) const {
    constexpr double agreeing_cosine = 0.7;
    constexpr std::array<double, 4> pulls = {0.0, 0.1, 0.4, 1.0}; // shares of the way to the middle
    for (const double pull : pulls) {
        const measure::NearestOnMesh nearest = known != nullptr && pull == 0.0
                                                   ? *known
                                                   : lookup.chart->bvh.nearest(at_m + pull * (lookup.middle_m - at_m));
        const std::uint32_t triangle = lookup.chart->triangles[nearest.triangle];
        const auto [a, b, c] = corner_normals_[triangle];
        const glm::dvec3 sum = nearest.weights.x * glm::dvec3(normals_[a]) +
                               nearest.weights.y * glm::dvec3(normals_[b]) +
                               nearest.weights.z * glm::dvec3(normals_[c]);
        const double length = glm::length(sum);
        if (length > 0.0 &&
            glm::dot(normal_of(marked_, marked_.triangles[triangle]), lookup.facing) >= agreeing_cosine) {
            return sum / length;
        }
    }
    return lookup.facing;
}

AttributeSeams::Values AttributeSeams::values_at(const Lookup& lookup, const glm::dvec3& at_m) const {
    const Chart& own = lookup.own();
    const measure::NearestOnMesh nearest = own.bvh.nearest(at_m);
    Values values;
    if (lookup.is_textured) { values.texture = texture_at(own, nearest); }
    if (has_normals()) { values.normal = normal_at(lookup, at_m, lookup.part ? nullptr : &nearest); }
    if (has_colours()) { values.colour = colour_at(own, nearest); }
    return values;
}

MeshPoint AttributeSeams::near_point(const glm::dvec3& at_m, std::span<const std::uint32_t> from) const {
    constexpr std::size_t max_vain_steps = 12;
    const auto nearest_on = [&](std::uint32_t triangle) {
        const auto& [a, b, c] = marked_.triangles[triangle];
        return measure::nearest_on_triangle(at_m, marked_.vertices_m[a], marked_.vertices_m[b], marked_.vertices_m[c]);
    };
    std::set<std::pair<double, std::uint32_t>> waiting; // by their squared distances
    std::set<std::uint32_t> is_met;
    const auto meet = [&](std::uint32_t triangle) {
        if (is_met.insert(triangle).second) { waiting.emplace(nearest_on(triangle).distance2, triangle); }
    };
    std::ranges::for_each(from, meet);
    assert(!waiting.empty());
    std::pair<double, std::uint32_t> best = *waiting.begin();
    for (std::size_t vain = 0; !waiting.empty() && vain < max_vain_steps; ++vain) {
        const std::pair<double, std::uint32_t> next = *waiting.begin();
        waiting.erase(waiting.begin());
        if (next < best) {
            best = next;
            vain = 0;
        }
        for (const std::uint32_t other : next_to_[next.second]) {
            if (other != invalid_index &&
                marked_.triangle_materials[other] == marked_.triangle_materials[next.second]) {
                meet(other);
            }
        }
    }
    return {best.second, nearest_on(best.second).weights};
}

glm::vec2 AttributeSeams::texture_coordinates(const MeshPoint& point) const {
    const auto& [a, b, c] = corner_textures_[point.triangle];
    assert(a != invalid_index);
    return glm::vec2(point.shares.x * glm::dvec2(textures_[a]) + point.shares.y * glm::dvec2(textures_[b]) +
                     point.shares.z * glm::dvec2(textures_[c]));
}

TriangleMesh AttributeSeams::with_colours(TriangleMesh made) const {
    if (!corner_colours_.empty()) { take_colours(made); }
    if (!charts_.empty()) { take_materials(made); }
    return made;
}

TriangleMesh AttributeSeams::with_attributes(TriangleMesh made) const {
    if (is_marked(made)) {
        made.texture_coordinates = textures_;
        made.corner_texture_coordinates = corner_textures_;
        made.normals = normals_;
        made.corner_normals = corner_normals_;
    } else {
        take_corners(made);
    }
    return with_colours(std::move(made));
}

/// Whether nothing was simplified.
bool AttributeSeams::is_marked(const TriangleMesh& made) const {
    return made.triangles == marked_.triangles && made.vertices_m == marked_.vertices_m;
}

/// Gives wedges near seams the colour of their chart: the vertex itself for the first chart, a copy of it for each
/// other one.
void AttributeSeams::take_colours(TriangleMesh& made) const {
    const std::vector<bool> near = near_seams(made);
    std::vector<bool> is_taken(made.vertices_m.size(), false);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> wedges;
    for (std::size_t t = 0; t < made.triangles.size(); ++t) {
        const std::uint32_t chart = made.triangle_materials[t];
        for (std::uint32_t& vertex : made.triangles[t]) {
            if (!near[vertex]) { continue; }
            const auto [at, is_new] = wedges.try_emplace({chart, vertex}, vertex);
            if (is_new && is_taken[vertex]) {
                at->second = static_cast<std::uint32_t>(made.vertices_m.size());
                made.vertices_m.push_back(glm::dvec3(made.vertices_m[vertex]));
                made.colours.emplace_back();
            }
            if (is_new) {
                is_taken[vertex] = true;
                const Chart& own = charts_[chart];
                made.colours[at->second] = glm::vec3(colour_at(own, own.bvh.nearest(made.vertices_m[vertex])));
            }
            vertex = at->second;
        }
    }
}

/// Gives corners texture coordinates and normals.
void AttributeSeams::take_corners(TriangleMesh& made) const {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> wedges;
    std::map<std::array<float, 3>, std::uint32_t> known_normals;
    made.corner_texture_coordinates.assign(
        has_texture_coordinates() ? made.triangles.size() : 0, {invalid_index, invalid_index, invalid_index});
    made.corner_normals.resize(has_normals() ? made.triangles.size() : 0);
    const bool has_corners = has_texture_coordinates() || has_normals();
    for (std::size_t t = 0; t < made.triangles.size() && has_corners; ++t) {
        const Lookup from = lookup(made, t);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = made.triangles[t][k];
            const glm::dvec3& at_m = made.vertices_m[vertex];
            if (from.is_textured) {
                const auto next = static_cast<std::uint32_t>(made.texture_coordinates.size());
                const auto [at, is_new] =
                    from.part ? std::pair(wedges.end(), true) : wedges.try_emplace({chart_at(made, t), vertex}, next);
                if (is_new) {
                    made.texture_coordinates.push_back(glm::vec2(texture_at(from.own(), from.own().bvh.nearest(at_m))));
                }
                made.corner_texture_coordinates[t][k] = from.part ? next : at->second;
            }
            if (has_normals()) {
                const glm::vec3 normal(normal_at(from, at_m, nullptr));
                const auto [at, is_new] = known_normals.try_emplace(
                    {normal.x, normal.y, normal.z}, static_cast<std::uint32_t>(made.normals.size()));
                if (is_new) { made.normals.push_back(normal); }
                made.corner_normals[t][k] = at->second;
            }
        }
    }
}

void AttributeSeams::take_materials(TriangleMesh& made) const {
    made.materials = materials_;
    for (std::uint32_t& mark : made.triangle_materials) { mark = material_of_mark_[mark]; }
    if (materials_.empty()) { made.triangle_materials.clear(); }
}

std::array<AttributeSeams::SquaredErrors, 3> AttributeSeams::squares(const TriangleMesh& made, std::size_t triangle,
    const std::vector<std::optional<glm::dvec3>>& vertex_colours) const {
    static const std::vector<glm::dvec3> samples = sample_weights();
    const Triangle& corners = made.triangles[triangle];
    const Lookup from = lookup(made, triangle);
    std::array<Values, 3> at_corners;
    for (std::size_t k = 0; k < 3; ++k) {
        at_corners.at(k) = values_at(from, made.vertices_m[corners[k]]);
        if (!vertex_colours.empty() && vertex_colours[corners[k]]) {
            at_corners.at(k).colour = *vertex_colours[corners[k]];
        }
    }
    std::array<SquaredErrors, 3> squares;
    for (const glm::dvec3& weights : samples) {
        Values off = values_at(from, place_m(made, corners, weights));
        const glm::dvec3 right_normal = off.normal;
        off.normal = glm::dvec3(0.0);
        for (std::size_t k = 0; k < 3; ++k) {
            const double weight = weights[static_cast<int>(k)];
            off.texture -= weight * at_corners.at(k).texture;
            off.normal += weight * at_corners.at(k).normal;
            off.colour -= weight * at_corners.at(k).colour;
        }
        const double angle_deg = degrees_per_radian * std::atan2(glm::length(glm::cross(right_normal, off.normal)),
                                                          glm::dot(right_normal, off.normal));
        const std::array<double, 3> squared = {
            glm::dot(off.texture, off.texture), angle_deg * angle_deg, glm::dot(off.colour, off.colour)};
        for (std::size_t kind = 0; kind < 3; ++kind) {
            squares.at(kind).max = std::max(squares.at(kind).max, squared.at(kind));
            squares.at(kind).mean += squared.at(kind) / static_cast<double>(samples.size());
        }
    }
    return squares;
}

AttributeErrors AttributeSeams::errors(const TriangleMesh& made, LookAt which) const {
    constexpr std::size_t enough = 8'000;
    if (charts_.empty() || is_marked(made)) { return {}; }
    const std::vector<bool> near = corner_colours_.empty() ? std::vector<bool>() : near_seams(made);
    std::vector<std::optional<glm::dvec3>> colours(made.colours.size());
    for (std::size_t vertex = 0; vertex < colours.size(); ++vertex) {
        if (near.empty() || !near[vertex]) { colours[vertex] = glm::dvec3(made.colours[vertex]); }
    }
    const std::size_t stride =
        which == LookAt::AllTriangles ? 1 : std::max<std::size_t>(1, made.triangles.size() / enough);
    AttributeErrors errors;
    const std::array<AttributeError*, 3> kinds = {&errors.texture, &errors.normal_deg, &errors.colour};
    std::array<double, 3> areas{};
    for (std::size_t t = 0; t < made.triangles.size(); t += stride) {
        const std::array<SquaredErrors, 3> found = squares(made, t, colours);
        const double area = glm::length(area_vector(made, made.triangles[t]));
        for (std::size_t kind = 0; kind < 3; ++kind) {
            if (kind == 0 && !is_textured(charts_[chart_at(made, t)])) { continue; }
            kinds.at(kind)->max = std::max(kinds.at(kind)->max, std::sqrt(found.at(kind).max));
            kinds.at(kind)->rms += area * found.at(kind).mean;
            areas.at(kind) += area;
        }
    }
    for (std::size_t kind = 0; kind < 3; ++kind) {
        double& rms = kinds.at(kind)->rms;
        rms = areas.at(kind) > 0.0 ? std::sqrt(rms / areas.at(kind)) : 0.0;
    }
    return errors;
}

TriangleMesh AttributeSeams::divided(TriangleMesh made, const AttributeBounds& bounds, std::size_t max_faces) const {
    if (charts_.empty() || is_marked(made)) { return made; }
    // Where an attribute breaks within a triangle, dividing it again and again does not help.
    constexpr double smallest2 = 1.0 / 1024.0;
    const auto is_large = [&](std::size_t t) {
        const Chart& chart = charts_[chart_at(made, t)];
        const glm::dvec3 middle_m = place_m(made, made.triangles[t], glm::dvec3(1.0 / 3.0));
        const std::uint32_t original = chart.triangles[chart.bvh.nearest(middle_m).triangle];
        return longest_side(made, made.triangles[t]).second >
               smallest2 * longest_side(marked_, marked_.triangles[original]).second;
    };
    const auto is_off = [&](std::size_t t) {
        const std::array<SquaredErrors, 3> found = squares(made, t, {});
        return found[0].max > bounds.texture * bounds.texture || found[1].max > bounds.normal_deg * bounds.normal_deg ||
               (std::isfinite(bounds.colour) && found[2].max > bounds.colour * bounds.colour);
    };
    std::vector<std::uint32_t> waiting(made.triangles.size()); // Triangles that may be off.
    std::iota(waiting.begin(), waiting.end(), 0U);
    while (made.triangles.size() < max_faces) {
        std::vector<std::uint32_t> off;
        for (const std::uint32_t t : waiting) {
            if (is_off(t) && is_large(t)) { off.push_back(t); }
        }
        if (off.empty()) { break; }
        EdgeDivision division(made);
        for (const std::uint32_t t : off) {
            if (made.triangles.size() < max_faces) { division.divide(t, longest_side(made, made.triangles[t]).first); }
        }
        waiting = division.changed();
        waiting.insert(waiting.end(), off.begin(), off.end());
        std::ranges::sort(waiting);
        waiting.erase(std::unique(waiting.begin(), waiting.end()), waiting.end());
    }
    for (std::size_t t = 0; t < made.triangles.size() && std::isfinite(bounds.colour); ++t) {
        const Chart& chart = charts_[chart_at(made, t)];
        for (const std::uint32_t vertex : made.triangles[t]) {
            made.colours[vertex] = glm::vec3(colour_at(chart, chart.bvh.nearest(made.vertices_m[vertex])));
        }
    }
    return made;
}

} // namespace octant::models::simplify
