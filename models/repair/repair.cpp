#include "models/repair/repair.h"

#include "models/mesh_edges.h"
#include "models/repair/consistent_orientation.h"
#include "models/triangle_mesh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <numeric>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace octant::models::repair {

namespace {

constexpr double behind = 1e-5; ///< of the diagonal

/// The triangles by the first vertex at each place.
std::vector<Triangle> welded(const TriangleMesh& mesh, std::span<const std::uint32_t> firsts) {
    std::vector<Triangle> triangles = mesh.triangles;
    for (Triangle& triangle : triangles) {
        for (std::uint32_t& vertex : triangle) { vertex = firsts[vertex]; }
    }
    return triangles;
}

/// For each vertex whether its connected piece has an edge of one triangle only.
std::vector<bool> in_open_piece(std::span<const Triangle> triangles, std::size_t vertices) {
    DisjointSets pieces(vertices);
    for (const Triangle& triangle : triangles) {
        pieces.join(triangle[0], triangle[1]);
        pieces.join(triangle[0], triangle[2]);
    }
    std::vector<bool> is_open(vertices, false);
    const std::vector<TriangleEdge> sides = sorted_triangle_edges(triangles);
    for_each_edge(sides, [&](std::span<const TriangleEdge> edge) {
        if (edge.size() == 1 && edge[0].min_vertex != edge[0].max_vertex) {
            is_open[pieces.group_of(edge[0].min_vertex)] = true;
        }
    });
    for (std::uint32_t v = 0; v < vertices; ++v) { is_open[v] = is_open[pieces.group_of(v)]; }
    return is_open;
}

class Backs {
public:
    Backs(TriangleMesh& mesh, std::vector<glm::dvec3> fronts)
        : mesh_(mesh), fronts_(std::move(fronts)), behind_m_(behind * diagonal_m(mesh)),
          backs_(mesh.vertices_m.size(), invalid_index), normals_(mesh.normals.size(), invalid_index) {}

    void add(std::size_t t) {
        const Triangle front = mesh_.triangles[t];
        mesh_.triangles.push_back({back_of(front[0]), back_of(front[2]), back_of(front[1])});
        if (!mesh_.corner_normals.empty()) {
            const Triangle normals = mesh_.corner_normals[t];
            mesh_.corner_normals.push_back({turned(normals[0]), turned(normals[2]), turned(normals[1])});
        }
        if (!mesh_.corner_texture_coordinates.empty()) {
            const auto [a, b, c] = mesh_.corner_texture_coordinates[t];
            mesh_.corner_texture_coordinates.push_back({a, c, b});
        }
        if (!mesh_.triangle_materials.empty()) {
            mesh_.triangle_materials.push_back(std::uint32_t{mesh_.triangle_materials[t]});
        }
    }

private:
    std::uint32_t back_of(std::uint32_t vertex) {
        if (backs_[vertex] == invalid_index) {
            backs_[vertex] = static_cast<std::uint32_t>(mesh_.vertices_m.size());
            const double length = glm::length(fronts_[vertex]);
            const glm::dvec3 off_m = length > 0.0 ? fronts_[vertex] * (behind_m_ / length) : glm::dvec3(behind_m_);
            mesh_.vertices_m.push_back(mesh_.vertices_m[vertex] - off_m);
            if (!mesh_.colours.empty()) { mesh_.colours.push_back(glm::vec3(mesh_.colours[vertex])); }
        }
        return backs_[vertex];
    }

    std::uint32_t turned(std::uint32_t normal) {
        if (normals_[normal] == invalid_index) {
            normals_[normal] = static_cast<std::uint32_t>(mesh_.normals.size());
            mesh_.normals.push_back(-mesh_.normals[normal]);
        }
        return normals_[normal];
    }

    TriangleMesh& mesh_;
    std::vector<glm::dvec3> fronts_; ///< of each vertex, the sum of the area vectors around it
    double behind_m_;
    std::vector<std::uint32_t> backs_;
    std::vector<std::uint32_t> normals_;
};

} // namespace

std::size_t add_back_faces(TriangleMesh& mesh, const std::vector<bool>& two_sided) {
    const std::size_t count = mesh.triangles.size();
    const std::vector<std::uint32_t> firsts =
        first_duplicates(mesh.vertices_m, {}, std::vector<bool>(mesh.vertices_m.size(), true));
    const std::vector<Triangle> triangles = welded(mesh, firsts);
    const std::vector<bool> is_open = in_open_piece(triangles, mesh.vertices_m.size());
    std::vector<glm::dvec3> sums(mesh.vertices_m.size(), glm::dvec3(0.0));
    for (std::size_t t = 0; t < count; ++t) {
        for (const std::uint32_t vertex : triangles[t]) { sums[vertex] += area_vector(mesh, triangles[t]); }
    }
    for (std::size_t v = 0; v < sums.size(); ++v) { sums[v] = sums[firsts[v]]; }
    Backs backs(mesh, std::move(sums));
    for (std::size_t t = 0; t < count; ++t) {
        if (two_sided[t] && is_open[triangles[t][0]]) { backs.add(t); }
    }
    return mesh.triangles.size() - count;
}

namespace {

struct Key {
    std::array<std::uint64_t, 3> place{};
    std::array<std::uint32_t, 3> colour{};

    bool operator==(const Key&) const = default;
};

struct KeyHash {
    std::size_t operator()(const Key& key) const {
        std::uint64_t hash = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            hash = (hash ^ key.place[k]) * 0x9e3779b97f4a7c15ULL;
            hash ^= hash >> 29U;
            hash = (hash ^ key.colour[k]) * 0xbf58476d1ce4e5b9ULL;
            hash ^= hash >> 32U;
        }
        return hash;
    }
};

} // namespace

std::vector<std::uint32_t> first_duplicates(
    std::span<const glm::dvec3> vertices_m, std::span<const glm::vec3> colours, const std::vector<bool>& used) {
    std::unordered_map<Key, std::uint32_t, KeyHash> first_of;
    first_of.reserve(vertices_m.size());
    std::vector<std::uint32_t> firsts(vertices_m.size(), invalid_index);
    for (std::uint32_t v = 0; v < firsts.size(); ++v) {
        if (!used[v]) { continue; }
        Key key;
        for (int k = 0; k < 3; ++k) {
            const auto part = static_cast<std::size_t>(k);
            key.place[part] = std::bit_cast<std::uint64_t>(vertices_m[v][k] + 0.0); // -0 + 0 is 0
            if (!colours.empty()) { key.colour[part] = std::bit_cast<std::uint32_t>(colours[v][k] + 0.0F); }
        }
        firsts[v] = first_of.try_emplace(key, v).first->second;
    }
    return firsts;
}

namespace {

/// Sets the colour of each welded vertex to the mean over all vertices welded to it. `welded` is the result of
/// first_duplicates. Does nothing without colours.
void average_colours(std::vector<glm::vec3>& colours, std::span<const std::uint32_t> welded) {
    std::vector<glm::vec3> sums(colours.size(), glm::vec3(0.0F));
    std::vector<std::uint32_t> counts(colours.size(), 0);
    for (std::uint32_t v = 0; v < colours.size(); ++v) {
        if (welded[v] != invalid_index) {
            sums[welded[v]] += colours[v];
            ++counts[welded[v]];
        }
    }
    for (std::uint32_t v = 0; v < colours.size(); ++v) {
        if (counts[v] > 1) { colours[v] = sums[v] / static_cast<float>(counts[v]); }
    }
}

} // namespace

std::vector<std::string> describe_counts(const RepairCounts& counts) {
    std::vector<std::string> lines;
    const auto add = [&](std::size_t count, std::string_view one, std::string_view many) {
        if (count > 0) { lines.push_back(fmt::format("{} {}", count, count == 1 ? one : many)); }
    };
    add(counts.unreferenced_vertices, "vertex of no triangle taken out", "vertices of no triangle taken out");
    add(counts.duplicate_vertices, "duplicate vertex welded", "duplicate vertices welded");
    add(counts.degenerate_triangles, "triangle without an area taken out", "triangles without an area taken out");
    add(counts.duplicate_triangles, "doubled triangle taken out", "doubled triangles taken out");
    add(counts.flipped_triangles, "triangle turned to agree with its neighbours",
        "triangles turned to agree with their neighbours");
    add(counts.split_edges, "edge split that more than two triangles or two that disagree share",
        "edges split that more than two triangles or two that disagree share");
    add(counts.split_vertices, "vertex split where several fans of triangles met",
        "vertices split where several fans of triangles met");
    add(counts.boundary_loops, "hole or open rim left as it is", "holes or open rims left as they are");
    return lines;
}

namespace {

/// Of the diagonal. A float has 24 bits, a text of six digits half a millionth.
constexpr double rounding = 1e-6;

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
    std::size_t operator()(const Cell& cell) const {
        std::uint64_t hash = 0;
        for (const std::int64_t part : cell) {
            hash = (hash ^ static_cast<std::uint64_t>(part)) * 0x9e3779b97f4a7c15ULL;
            hash ^= hash >> 29U;
        }
        return hash;
    }
};

std::vector<std::uint32_t> rim_vertices(const TriangleMesh& mesh) {
    std::vector<bool> on_rim(mesh.vertices_m.size(), false);
    const std::vector<TriangleEdge> sides = sorted_triangle_edges(mesh.triangles);
    for_each_edge(sides, [&](std::span<const TriangleEdge> edge) {
        if (edge.size() == 1) {
            on_rim[edge[0].min_vertex] = true;
            on_rim[edge[0].max_vertex] = true;
        }
    });
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t v = 0; v < on_rim.size(); ++v) {
        if (on_rim[v]) { vertices.push_back(v); }
    }
    return vertices;
}

/// Takes back what would make corners of one triangle one.
void keep_corners_apart(const TriangleMesh& mesh, std::vector<std::uint32_t>& firsts) {
    for (const Triangle& triangle : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t one = triangle[k];
            const std::uint32_t other = triangle[(k + 1) % 3];
            if (one != other && firsts[one] == firsts[other]) {
                firsts[one] = one;
                firsts[other] = other;
            }
        }
    }
}

/// Rims of a mesh that touch but for rounding: for each vertex on an edge of one triangle only the first such one
/// within a millionth of the mesh's diagonal, perhaps itself, where welding it makes no triangle's corners one. Itself
/// for all other vertices.
std::vector<std::uint32_t> close_boundaries(const TriangleMesh& mesh) {
    std::vector<std::uint32_t> firsts(mesh.vertices_m.size());
    std::iota(firsts.begin(), firsts.end(), 0U);
    const double near_m = rounding * diagonal_m(mesh);
    if (!(near_m > 0.0)) { return firsts; }
    const glm::dvec3 origin_m = bounds_of(mesh).min_m;
    std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> kept;
    for (const std::uint32_t vertex : rim_vertices(mesh)) {
        const glm::dvec3& place_m = mesh.vertices_m[vertex];
        const glm::dvec3 scaled = (place_m - origin_m) / near_m;
        const Cell own{std::llround(scaled.x), std::llround(scaled.y), std::llround(scaled.z)};
        std::uint32_t first = vertex;
        for (int i = 0; i < 27; ++i) {
            const auto found = kept.find({own[0] + i % 3 - 1, own[1] + i / 3 % 3 - 1, own[2] + i / 9 - 1});
            if (found == kept.end()) { continue; }
            for (const std::uint32_t other : found->second) {
                if (glm::distance(mesh.vertices_m[other], place_m) <= near_m) { first = std::min(first, other); }
            }
        }
        firsts[vertex] = first;
        if (first == vertex) { kept[own].push_back(vertex); }
    }
    keep_corners_apart(mesh, firsts);
    return firsts;
}

/// Twice a triangle's area, as a part of the square of its longest coordinate difference, up to which it has none: what
/// rounding leaves of corners on a line.
constexpr double no_area = 1e-13;

bool has_area(const glm::dvec3& a_m, const glm::dvec3& b_m, const glm::dvec3& c_m) {
    const glm::dvec3 ab_m = b_m - a_m;
    const glm::dvec3 ac_m = c_m - a_m;
    double longest_m = 0.0;
    for (int k = 0; k < 3; ++k) { longest_m = std::max({longest_m, std::abs(ab_m[k]), std::abs(ac_m[k])}); }
    return longest_m > 0.0 && glm::length(glm::cross(ab_m / longest_m, ac_m / longest_m)) > no_area;
}

class Repairing {
public:
    Repairing(TriangleMesh&& mesh, Seams seams) : mesh_(std::move(mesh)), seams_(seams), named_(mesh_.triangles) {}

    RepairedMesh repair() {
        if (seams_ == Seams::Welded) { take_corner_colours(); }
        weld(first_duplicates(
            mesh_.vertices_m, seams_ == Seams::Welded ? std::vector<glm::vec3>() : mesh_.colours, referenced()));
        if (seams_ == Seams::Welded) { weld(close_boundaries(mesh_)); }
        split_at_junctions();
        take_out_triangles();
        orient();
        split_vertices();
        take_out_vertices();
        counts_.shells = count_shells(mesh_);
        counts_.boundary_loops = count_boundary_loops(mesh_);
        if (!colours_break()) { corner_colours_.clear(); }
        return {std::move(mesh_), std::move(corner_colours_), counts_};
    }

private:
    std::vector<bool> referenced() const {
        std::vector<bool> used(mesh_.vertices_m.size(), false);
        for (const Triangle& triangle : mesh_.triangles) {
            for (const std::uint32_t vertex : triangle) { used[vertex] = true; }
        }
        return used;
    }

    void take_corner_colours() {
        for (const auto& [a, b, c] : mesh_.colours.empty() ? std::vector<Triangle>() : named_) {
            corner_colours_.push_back({mesh_.colours[a], mesh_.colours[b], mesh_.colours[c]});
        }
    }

    /// Whether a corner's colour differs from its vertex's by more than a few steps of eight bits.
    bool colours_break() const {
        constexpr float a_few_steps = 0.01F;
        for (std::size_t t = 0; t < corner_colours_.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::vec3 off = corner_colours_[t][k] - mesh_.colours[mesh_.triangles[t][k]];
                if (glm::dot(off, off) > a_few_steps * a_few_steps) { return true; }
            }
        }
        return false;
    }

    /// Puts the vertex that each is to become in its place, none or itself for one that stays.
    void weld(const std::vector<std::uint32_t>& welded) {
        average_colours(mesh_.colours, welded);
        for (std::uint32_t v = 0; v < welded.size(); ++v) {
            counts_.duplicate_vertices += static_cast<std::size_t>(welded[v] != v && welded[v] != invalid_index);
        }
        for (Triangle& triangle : mesh_.triangles) {
            for (std::uint32_t& vertex : triangle) { vertex = welded[vertex]; }
        }
    }

    bool is_degenerate(const Triangle& triangle) const {
        const auto [a, b, c] = triangle;
        return a == b || b == c || c == a || !has_area(mesh_.vertices_m[a], mesh_.vertices_m[b], mesh_.vertices_m[c]);
    }

    /// The triangles at each edge between vertices that are marked, but for those left out.
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> triangles_at_edges(
        const std::vector<bool>& marked, const std::vector<bool>& left_out) const {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> found;
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            for (std::size_t i = 0; i < 3 && !(t < left_out.size() && left_out[t]); ++i) {
                const std::uint32_t from = mesh_.triangles[t][i];
                const std::uint32_t to = mesh_.triangles[t][(i + 1) % 3];
                if (marked[from] && marked[to]) { found[std::minmax(from, to)].push_back(t); }
            }
        }
        return found;
    }

    /// A triangle without an area that has three vertices closes a T-junction: its middle vertex lies on its longest
    /// side. The neighbour at that side is split at the vertex, so that nothing opens when the triangle is taken out.
    void split_at_junctions() {
        std::vector<std::uint32_t> thin;
        std::vector<bool> marked(mesh_.vertices_m.size(), false);
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            const auto [a, b, c] = mesh_.triangles[t];
            if (a != b && b != c && c != a && is_degenerate(mesh_.triangles[t])) {
                thin.push_back(t);
                marked[a] = marked[b] = marked[c] = true;
            }
        }
        std::vector<bool> done(mesh_.triangles.size(), false);
        for (bool changed = !thin.empty(); changed;) {
            changed = false;
            const auto at_edges = triangles_at_edges(marked, done);
            std::vector<bool> touched(mesh_.triangles.size(), false);
            for (const std::uint32_t t : thin) {
                changed = (!done[t] && split_neighbour(t, at_edges, touched, done)) || changed;
            }
        }
    }

    /// A vertex on a side of a triangle.
    struct OnSide {
        std::uint32_t vertex = 0;
        std::uint32_t name = 0; ///< of the vertex, in named_
        float part = 0.5F;      ///< of the side's length, from its first corner
        glm::vec3 colour;       ///< of the corners there
    };

    /// Divides a triangle at a vertex on its side from corner `from` to the next one. The part at `from` stays in
    /// place, the other one comes last.
    void divide_side(std::uint32_t triangle, std::size_t from, const OnSide& middle) {
        const std::size_t to = (from + 1) % 3;
        const auto divide_corners = [&](auto& list, const auto& at_middle) {
            list.push_back(list[triangle]);
            list.back()[from] = at_middle;
            list[triangle][to] = at_middle;
        };
        divide_corners(mesh_.triangles, middle.vertex);
        divide_corners(named_, middle.name);
        if (!corner_colours_.empty()) { divide_corners(corner_colours_, middle.colour); }
        if (!mesh_.corner_normals.empty()) {
            divide_corners(mesh_.corner_normals, std::uint32_t(mesh_.corner_normals[triangle][from]));
        }
        if (!mesh_.corner_texture_coordinates.empty()) {
            const Triangle corners = mesh_.corner_texture_coordinates[triangle];
            auto at_middle = invalid_index;
            if (corners[from] != invalid_index && corners[to] != invalid_index) {
                at_middle = static_cast<std::uint32_t>(mesh_.texture_coordinates.size());
                mesh_.texture_coordinates.push_back(glm::mix(
                    mesh_.texture_coordinates[corners[from]], mesh_.texture_coordinates[corners[to]], middle.part));
            }
            divide_corners(mesh_.corner_texture_coordinates, at_middle);
        }
        if (!mesh_.triangle_materials.empty()) {
            mesh_.triangle_materials.push_back(std::uint32_t(mesh_.triangle_materials[triangle]));
        }
    }

    /// Splits the neighbour at the longest side of a triangle without an area, if it is the only one there, has an area
    /// and was not split in this round.
    bool split_neighbour(std::uint32_t thin,
        const std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>>& at_edges,
        std::vector<bool>& touched, std::vector<bool>& done) {
        const Triangle corners = mesh_.triangles[thin];
        const auto length_m = [&](std::size_t i) {
            return glm::distance(mesh_.vertices_m[corners[i]], mesh_.vertices_m[corners[(i + 1) % 3]]);
        };
        std::size_t side = 0;
        for (const std::size_t i : {1U, 2U}) { side = length_m(i) > length_m(side) ? i : side; }
        const std::size_t middle = (side + 2) % 3;
        const auto found = at_edges.find(std::minmax(corners[side], corners[(side + 1) % 3]));
        if (found == at_edges.end() || found->second.size() != 2) { return false; }
        const std::uint32_t other = found->second[0] == thin ? found->second[1] : found->second[0];
        if (other == thin || touched[other] || is_degenerate(mesh_.triangles[other])) { return false; }
        std::size_t from = 0;
        while (mesh_.triangles[other][(from + 2) % 3] == corners[side] ||
               mesh_.triangles[other][(from + 2) % 3] == corners[(side + 1) % 3]) {
            ++from;
        }
        touched[other] = done[thin] = true;
        const std::uint32_t begin = mesh_.triangles[other][from];
        divide_side(other, from,
            {corners[middle], named_[thin][middle],
                static_cast<float>(
                    glm::distance(mesh_.vertices_m[begin], mesh_.vertices_m[corners[middle]]) / length_m(side)),
                corner_colours_.empty() ? glm::vec3(0.0F) : corner_colours_[thin][middle]});
        return true;
    }

    /// Whether a triangle names its vertices in the order of `rising` or of a rotation of it.
    bool turns_as(std::uint32_t triangle, const Triangle& rising) const {
        const Triangle& corners = mesh_.triangles[triangle];
        const auto at = static_cast<std::size_t>(std::ranges::find(corners, rising[0]) - corners.begin());
        return corners[(at + 1) % 3] == rising[1];
    }

    /// Triangles with the same three vertices.
    struct Doubles {
        std::span<const std::pair<Triangle, std::uint32_t>> all; ///< sorted vertices, triangle
        std::ptrdiff_t rising = 0;                               ///< as many more turn as the sorted vertices do
    };

    /// Triangles that hang together by edges.
    struct WrittenShell {
        std::ptrdiff_t times = 0; ///< it was written: the common divisor of Doubles::rising
        bool is_closed = true;    ///< as many triangles pass each edge one way as the other
    };

    /// By the group of their triangles.
    std::vector<WrittenShell> written_shells(std::span<const Doubles> doubles, DisjointSets& groups) const {
        std::vector<WrittenShell> shells(mesh_.triangles.size());
        const std::vector<TriangleEdge> sides = sorted_triangle_edges(mesh_.triangles);
        for_each_edge(sides, [&](std::span<const TriangleEdge> edge) {
            for (const TriangleEdge& side : edge) { groups.join(edge[0].triangle, side.triangle); }
        });
        for_each_edge(sides, [&](std::span<const TriangleEdge> edge) {
            const auto rising = std::ranges::count_if(edge, &TriangleEdge::rises);
            if (2 * rising != std::ranges::ssize(edge)) { shells[groups.group_of(edge[0].triangle)].is_closed = false; }
        });
        for (const Doubles& one : doubles) {
            std::ptrdiff_t& times = shells[groups.group_of(one.all[0].second)].times;
            times = std::gcd(times, one.rising);
        }
        return shells;
    }

    /// Of triangles of a closed shell with the same three vertices as many stay as keep it closed: a triangle and its
    /// back are a wall between two bodies, or a sheet. A shell that was written several times stays once. Of an open
    /// shell the first one of the turn that more of them have stays.
    void take_out_doubles(std::span<const Doubles> found) {
        std::vector<bool> stays(mesh_.triangles.size(), true);
        DisjointSets groups(mesh_.triangles.size());
        const std::vector<WrittenShell> shells = written_shells(found, groups);
        for (const auto& [all, rising] : found) {
            if (all.size() == 1) { continue; }
            const auto turns = [&](const auto& one) { return turns_as(one.second, one.first); };
            const bool most = rising == 0 ? turns(all.front()) : rising > 0;
            const WrittenShell& shell = shells[groups.group_of(all.front().second)];
            std::array<std::ptrdiff_t, 2> wanted{1, 1}; // falling, rising
            if (!shell.is_closed || rising != 0) {
                wanted[most ? 1 : 0] = shell.is_closed ? std::abs(rising) / shell.times : 1;
                wanted[most ? 0 : 1] = 0;
            }
            for (const auto& one : all) {
                stays[one.second] = wanted[turns(one) ? 1 : 0]-- > 0;
                counts_.duplicate_triangles += static_cast<std::size_t>(!stays[one.second]);
            }
        }
        keep_triangles(stays);
    }

    void take_out_triangles() {
        std::vector<bool> stays(mesh_.triangles.size(), true);
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            stays[t] = !is_degenerate(mesh_.triangles[t]);
            counts_.degenerate_triangles += static_cast<std::size_t>(!stays[t]);
        }
        keep_triangles(stays);
        std::vector<std::pair<Triangle, std::uint32_t>> sorted; // vertices, triangle
        sorted.reserve(mesh_.triangles.size());
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            sorted.emplace_back(mesh_.triangles[t], t);
            std::ranges::sort(sorted.back().first);
        }
        std::ranges::sort(sorted);
        std::vector<Doubles> found;
        for (std::size_t first = 0, last = 0; first < sorted.size(); first = last) {
            found.emplace_back();
            while (last < sorted.size() && sorted[last].first == sorted[first].first) {
                found.back().rising += turns_as(sorted[last].second, sorted[last].first) ? 1 : -1;
                ++last;
            }
            found.back().all = std::span(sorted).subspan(first, last - first);
        }
        if (found.size() < sorted.size()) { take_out_doubles(found); }
    }

    template <typename T>
    static void keep(std::vector<T>& things, const std::vector<bool>& stays) {
        if (things.empty()) { return; }
        std::size_t kept = 0;
        for (std::size_t i = 0; i < things.size(); ++i) {
            if (stays[i]) { things[kept++] = things[i]; }
        }
        things.resize(kept);
    }

    void keep_triangles(const std::vector<bool>& stays) {
        keep(mesh_.triangles, stays);
        keep(named_, stays);
        keep(corner_colours_, stays);
        keep(mesh_.corner_normals, stays);
        keep(mesh_.corner_texture_coordinates, stays);
        keep(mesh_.triangle_materials, stays);
    }

    void orient() {
        const std::vector<TriangleEdge> sides = sorted_triangle_edges(mesh_.triangles);
        ConsistentOrientation turns = consistent_orientation(mesh_.triangles, sides, named_);
        turned_ = std::move(turns.turned);
        counts_.flipped_triangles += turns.count;
        counts_.split_edges += turns.non_manifold_edges;
        join_fans();
        turn_triangles();
    }

    /// Joins the corners of triangles around each vertex into fans. Fans may meet again elsewhere, which would
    /// duplicate a side. Then a pair of triangles is split at the middle of the side, so that the mesh stays closed,
    /// and a triangle without a neighbour there stays separate.
    void join_fans() {
        is_apart_.assign(mesh_.triangles.size(), false);
        const std::size_t split_before = counts_.split_edges;
        do {
            counts_.split_edges = split_before;
            join_but_apart(sorted_triangle_edges(mesh_.triangles));
        } while (part_repeated_sides());
    }

    /// Whether a side runs from its smaller vertex to its larger one once its triangle is turned.
    bool rises(const TriangleEdge& side) const { return side.rises != (turned_[side.triangle] != 0); }

    /// Joins the corners of two triangles at both ends of the edge they share and agree about. A corner's number is
    /// three times its triangle's plus its place.
    void join_but_apart(const std::vector<TriangleEdge>& sides) {
        fans_ = DisjointSets(mesh_.triangles.size() * 3);
        mates_.assign(mesh_.triangles.size(), {invalid_index, invalid_index, invalid_index});
        for_each_joint(sides, named_, [&](std::span<const TriangleEdge> edge) {
            if (edge.size() > 2) {
                join_bodies(edge);
            } else if (edge.size() == 2 && !join(edge[0], edge[1])) {
                ++counts_.split_edges;
            }
        });
    }

    bool join(const TriangleEdge& one, const TriangleEdge& other) {
        if (rises(one) == rises(other) || is_apart_[one.triangle] || is_apart_[other.triangle]) { return false; }
        fans_.join(corner_of(one, true), corner_of(other, true));
        fans_.join(corner_of(one, false), corner_of(other, false));
        mates_[one.triangle][one.corner] = other.triangle;
        mates_[other.triangle][other.corner] = one.triangle;
        return true;
    }

    /// Joins two triangles each at an edge where bodies touch: those with the inside of one body between them. Nothing
    /// where the triangles at the edge bound no bodies.
    void join_bodies(std::span<const TriangleEdge> edge) {
        const glm::dvec3& from_m = mesh_.vertices_m[edge[0].min_vertex];
        const glm::dvec3 along_m = mesh_.vertices_m[edge[0].max_vertex] - from_m;
        const auto outwards_m = [&](const TriangleEdge& side) {
            return mesh_.vertices_m[mesh_.triangles[side.triangle][(side.corner + 2U) % 3U]] - from_m;
        };
        const glm::dvec3 up = glm::cross(along_m, outwards_m(edge[0]));
        const glm::dvec3 right = glm::cross(up, along_m) / glm::length(along_m);

        struct Turn {
            double turn; ///< around the edge from its first triangle on, rises from 0 to 4
            bool enters; ///< the body lies behind it
            TriangleEdge side;
        };

        std::vector<Turn> around;
        for (const TriangleEdge& side : edge) {
            const glm::dvec3 out_m = outwards_m(side);
            const double x = glm::dot(out_m, right);
            const double y = glm::dot(out_m, up);
            const double part = y / std::max(std::abs(x) + std::abs(y), std::numeric_limits<double>::min());
            around.push_back({x < 0.0 ? 2.0 - part : (y < 0.0 ? 4.0 + part : part), !rises(side), side});
        }
        // Of two that coincide the one that leaves a body comes first: none has its back in it.
        std::ranges::stable_sort(around, {}, [](const Turn& one) { return std::pair(one.turn, one.enters); });
        if (2 * std::ranges::count_if(around, &Turn::enters) != std::ranges::ssize(around)) { return; }
        std::vector<TriangleEdge> entered;
        for (int round = 0; round < 2; ++round) {
            for (const Turn& one : around) {
                if (one.enters && round == 0) {
                    entered.push_back(one.side);
                } else if (!one.enters && !entered.empty() &&
                           mates_[one.side.triangle][one.side.corner] == invalid_index) {
                    join(entered.back(), one.side);
                    entered.pop_back();
                }
            }
        }
    }

    /// Of each side that would come twice the later one is parted; false where there is none.
    bool part_repeated_sides() {
        std::vector<std::array<std::uint32_t, 3>> ends; // of a side: from, to; its corner
        ends.reserve(mesh_.triangles.size() * 3);
        for (std::uint32_t corner = 0; corner < mesh_.triangles.size() * 3; ++corner) {
            const std::uint32_t t = corner / 3;
            const std::uint32_t from = fans_.group_of(corner);
            const std::uint32_t to = fans_.group_of(t * 3 + (corner + 1) % 3);
            ends.push_back(turned_[t] != 0 ? std::array{to, from, corner} : std::array{from, to, corner});
        }
        std::ranges::sort(ends);
        bool any = false;
        std::vector<bool> touched(mesh_.triangles.size(), false);
        for (std::size_t i = 1; i < ends.size(); ++i) {
            if (ends[i][0] != ends[i - 1][0] || ends[i][1] != ends[i - 1][1]) { continue; }
            any = true;
            const auto mate_of = [&](const std::array<std::uint32_t, 3>& end) {
                return mates_[end[2] / 3][end[2] % 3];
            };
            const std::uint32_t triangle = ends[i][2] / 3;
            const std::uint32_t mate = mate_of(ends[i]);
            if (mate == invalid_index) {
                is_apart_[triangle] = true;
            } else if (mate_of(ends[i - 1]) == invalid_index) {
                is_apart_[ends[i - 1][2] / 3] = true;
            } else if (ends[i][0] < ends[i][1] && !touched[triangle] && !touched[mate]) {
                touched[triangle] = touched[mate] = true;
                divide(ends[i][2]); // each pair has the side both ways
            }
        }
        return any;
    }

    /// Divides a triangle and its mate at the middle of the side that a corner begins.
    void divide(std::uint32_t corner) {
        const std::uint32_t triangle = corner / 3;
        const std::uint32_t mate = mates_[triangle][corner % 3];
        const std::uint32_t from = mesh_.triangles[triangle][corner % 3];
        const std::uint32_t to = mesh_.triangles[triangle][(corner + 1) % 3];
        std::size_t mate_from = 0;
        while (std::minmax(mesh_.triangles[mate][mate_from], mesh_.triangles[mate][(mate_from + 1) % 3]) !=
               std::minmax(from, to)) {
            ++mate_from;
        }
        const std::uint32_t middle = copy_of(from);
        mesh_.vertices_m[middle] = 0.5 * (mesh_.vertices_m[from] + mesh_.vertices_m[to]);
        if (!mesh_.colours.empty()) { mesh_.colours[middle] = 0.5F * (mesh_.colours[from] + mesh_.colours[to]); }
        for (const auto& [at, k] : {std::pair<std::uint32_t, std::size_t>(triangle, corner % 3), {mate, mate_from}}) {
            const glm::vec3 colour = corner_colours_.empty()
                                         ? glm::vec3(0.0F)
                                         : 0.5F * (corner_colours_[at][k] + corner_colours_[at][(k + 1) % 3]);
            divide_side(at, k, {middle, middle, 0.5F, colour});
            turned_.push_back(std::uint8_t(turned_[at]));
            is_apart_.push_back(false);
        }
    }

    /// At the smaller or the larger vertex of a side.
    static std::uint32_t corner_of(const TriangleEdge& side, bool at_least) {
        const std::uint32_t place = side.rises == at_least ? side.corner : (side.corner + 1U) % 3U;
        return side.triangle * 3 + place;
    }

    /// One vertex a fan: the first fan keeps the vertex, each other one gets a copy at the end.
    void split_vertices() {
        std::vector<std::uint32_t> fan_at(mesh_.vertices_m.size(), invalid_index);
        std::vector<std::uint32_t> vertex_of(mesh_.triangles.size() * 3, invalid_index);
        std::vector<bool> is_split(mesh_.vertices_m.size(), false);
        for (std::uint32_t corner = 0; corner < vertex_of.size(); ++corner) {
            std::uint32_t& vertex = mesh_.triangles[corner / 3][place_of(corner)];
            const std::uint32_t fan = fans_.group_of(corner);
            if (vertex_of[fan] == invalid_index && fan_at[vertex] == invalid_index) {
                fan_at[vertex] = fan;
                vertex_of[fan] = vertex;
            } else if (vertex_of[fan] == invalid_index) {
                counts_.split_vertices += static_cast<std::size_t>(!is_split[vertex]);
                is_split[vertex] = true;
                vertex_of[fan] = copy_of(vertex);
            }
            vertex = vertex_of[fan];
        }
    }

    /// Where a corner stands now that its triangle may have been turned.
    std::size_t place_of(std::uint32_t corner) const {
        const std::size_t place = corner % 3;
        return turned_[corner / 3] != 0 && place > 0 ? 3 - place : place;
    }

    std::uint32_t copy_of(std::uint32_t vertex) {
        mesh_.vertices_m.push_back(glm::dvec3(mesh_.vertices_m[vertex]));
        if (!mesh_.colours.empty()) { mesh_.colours.push_back(glm::vec3(mesh_.colours[vertex])); }
        return static_cast<std::uint32_t>(mesh_.vertices_m.size() - 1);
    }

    void turn_triangles() {
        for (std::size_t t = 0; t < turned_.size(); ++t) {
            if (turned_[t] == 0) { continue; }
            std::swap(mesh_.triangles[t][1], mesh_.triangles[t][2]);
            if (!corner_colours_.empty()) { std::swap(corner_colours_[t][1], corner_colours_[t][2]); }
            if (!mesh_.corner_texture_coordinates.empty()) {
                Triangle& corners = mesh_.corner_texture_coordinates[t];
                std::swap(corners[1], corners[2]);
            }
            if (!mesh_.corner_normals.empty()) {
                std::swap(mesh_.corner_normals[t][1], mesh_.corner_normals[t][2]);
                turn_normals(t);
            }
        }
    }

    /// Turns the normals that point to the back of triangle t.
    void turn_normals(std::size_t t) {
        const glm::dvec3 front = area_vector(mesh_, mesh_.triangles[t]);
        for (std::uint32_t& normal : mesh_.corner_normals[t]) {
            if (glm::dot(front, glm::dvec3(mesh_.normals[normal])) < 0.0) {
                const auto next = static_cast<std::uint32_t>(mesh_.normals.size());
                const auto [at, is_new] = turned_normals_.try_emplace(normal, next);
                if (is_new) { mesh_.normals.push_back(-mesh_.normals[normal]); }
                normal = at->second;
            }
        }
    }

    /// Also those that only the triangles taken out had.
    void take_out_vertices() {
        const std::vector<bool> stays = referenced();
        std::vector<std::uint32_t> places(stays.size(), invalid_index);
        std::uint32_t kept = 0;
        std::size_t gone = 0;
        for (std::size_t v = 0; v < stays.size(); ++v) {
            gone += static_cast<std::size_t>(!stays[v]);
            places[v] = stays[v] ? kept++ : invalid_index;
        }
        counts_.unreferenced_vertices = gone - counts_.duplicate_vertices;
        keep(mesh_.vertices_m, stays);
        keep(mesh_.colours, stays);
        for (Triangle& triangle : mesh_.triangles) {
            for (std::uint32_t& vertex : triangle) { vertex = places[vertex]; }
        }
    }

    TriangleMesh mesh_;
    Seams seams_;
    std::vector<Triangle> named_; ///< the triangles by the vertices of the file
    RepairCounts counts_;
    std::vector<CornerColours> corner_colours_;
    std::vector<std::uint8_t> turned_; ///< 1 for triangles that are to be turned
    std::vector<bool> is_apart_;       ///< triangles that share no vertex with others
    std::vector<Triangle> mates_;      ///< the triangle joined at each side that a corner begins, or invalid_index
    std::unordered_map<std::uint32_t, std::uint32_t> turned_normals_;
    DisjointSets fans_{0}; ///< of corners
};

} // namespace

RepairedMesh repaired(TriangleMesh mesh, Seams seams) { return Repairing(std::move(mesh), seams).repair(); }

} // namespace octant::models::repair
