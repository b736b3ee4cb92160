#include "visuals/planning/aircraft_model.h"

#include "models/collapse_sequence.h"
#include "models/colour_vertex.h"
#include "models/planar/planar_model.h"
#include "models/polygons/polygon_model.h"
#include "sim/base/units.h"
#include "visuals/shading/vertex_normals.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

namespace octant::visuals::planning {

namespace {

/// A coarser level must be better than asked for by this factor before it replaces a finer one.
constexpr double coarsening_margin = 0.7;

std::vector<glm::vec3> given_or_computed_normals(const models::TriangleMesh& mesh) {
    if (mesh.normals.empty()) { return shading::corner_normals(mesh); }
    std::vector<glm::vec3> normals;
    normals.reserve(3 * mesh.triangles.size());
    for (const models::Triangle& corners : mesh.corner_normals) {
        for (const std::uint32_t normal : corners) { normals.push_back(mesh.normals[normal]); }
    }
    return normals;
}

/// The number of a texture in a model's buffers, to which it is added if it is new; 0 for none.
std::uint32_t texture_number(scene::ModelBuffers& buffers, const models::SurfaceTexture& texture) {
    if (texture.picture == nullptr) { return 0; }
    const auto known = std::ranges::find(buffers.textures, texture);
    const auto number = static_cast<std::uint32_t>(known - buffers.textures.begin()) + 1;
    if (known == buffers.textures.end()) { buffers.textures.push_back(texture); }
    return number;
}

/// Gives the corners of a mesh their places in a vertex buffer.
class MipLevelBuilder {
public:
    MipLevelBuilder(scene::ModelBuffers& buffers, const models::TriangleMesh& mesh)
        : buffers_(buffers), mesh_(mesh), newest_(mesh.vertices_m.size(), models::none),
          textures_(mesh.materials.size(), 0) {
        for (std::size_t t = 0; t < mesh.corner_texture_coordinates.size() && !mesh.materials.empty(); ++t) {
            const std::uint32_t material = mesh.triangle_materials[t];
            if (textures_[material] == 0) {
                textures_[material] = texture_number(buffers, mesh.materials[material].texture);
            }
        }
    }

    void add(std::uint32_t triangle, std::span<const glm::vec3> normals) {
        std::array<std::uint32_t, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = vertex_of(triangle, k, normals[std::size_t{3} * triangle + k]);
        }
        const std::size_t first = unclaimed_corner(corners);
        set_provoking_vertex(corners[first], triangle);
        for (std::size_t k = 0; k < 3; ++k) { buffers_.indices.push_back(corners[(first + k) % 3]); }
    }

private:
    /// As ModelVertex::texture.
    std::uint32_t texture_of(std::uint32_t triangle) const {
        const bool has_coordinates = !mesh_.corner_texture_coordinates.empty() &&
                                     mesh_.corner_texture_coordinates[triangle][0] != models::invalid_index;
        return has_coordinates && !mesh_.materials.empty() ? textures_[mesh_.triangle_materials[triangle]] : 0;
    }

    /// Whether the material alone has the colour of a triangle, or of what its picture is multiplied by.
    bool has_colour_of_material(std::uint32_t triangle) const {
        return mesh_.colours.empty() || mesh_.colours_are_means || texture_of(triangle) != 0;
    }

    std::uint32_t colour_of(std::uint32_t triangle, std::uint32_t vertex) const {
        return models::packed_colour(
            !has_colour_of_material(triangle) ? mesh_.colours[vertex] : models::material_colour(mesh_, triangle));
    }

    /// A drawn vertex that looks like this corner, made where there is none.
    std::uint32_t vertex_of(std::uint32_t triangle, std::size_t corner, const glm::vec3& normal) {
        const std::uint32_t vertex = mesh_.triangles[triangle][corner];
        scene::ModelVertex made;
        made.position_m = glm::vec3(mesh_.vertices_m[vertex]);
        made.normal = normal;
        made.colour = colour_of(triangle, vertex);
        made.texture = texture_of(triangle);
        if (made.texture != 0) {
            const glm::vec2& place = mesh_.texture_coordinates[mesh_.corner_texture_coordinates[triangle][corner]];
            made.on_texture = {place.x, 1.0F - place.y};
        }
        for (std::uint32_t at = newest_[vertex]; at != models::none; at = older_[at - first_]) {
            const scene::ModelVertex& drawn = buffers_.vertices[at];
            if (drawn.normal == made.normal && drawn.colour == made.colour && drawn.texture == made.texture &&
                drawn.on_texture == made.on_texture) {
                return at;
            }
        }
        const std::uint32_t at = add_vertex(made);
        older_.back() = newest_[vertex];
        newest_[vertex] = at;
        return at;
    }

    std::uint32_t add_vertex(const scene::ModelVertex& vertex) {
        buffers_.vertices.push_back(vertex);
        older_.push_back(models::none);
        is_first_.push_back(0);
        return static_cast<std::uint32_t>(buffers_.vertices.size() - 1);
    }

    /// A corner with which no triangle begins yet; its vertex is doubled where all three are taken.
    std::size_t unclaimed_corner(std::array<std::uint32_t, 3>& corners) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (is_first_[corners[k] - first_] == 0) { return k; }
        }
        corners[0] = add_vertex(scene::ModelVertex(buffers_.vertices[corners[0]]));
        return 0;
    }

    void set_provoking_vertex(std::uint32_t vertex, std::uint32_t triangle) {
        is_first_[vertex - first_] = 1;
        buffers_.vertices[vertex].polygon = triangle;
        buffers_.vertices[vertex].face_normal = models::normal_of(mesh_, mesh_.triangles[triangle], {0.0, 0.0, -1.0});
        buffers_.vertices[vertex].face_colour =
            models::packed_colour(has_colour_of_material(triangle) ? models::material_colour(mesh_, triangle)
                                                                   : models::mean_colour(mesh_, triangle));
    }

    scene::ModelBuffers& buffers_;
    const models::TriangleMesh& mesh_;
    std::uint32_t first_ = static_cast<std::uint32_t>(buffers_.vertices.size());
    /// The drawn vertex of each of the mesh's.
    std::vector<std::uint32_t> newest_;
    /// Another drawn vertex of the same one, by drawn vertex.
    std::vector<std::uint32_t> older_;
    std::vector<std::uint8_t> is_first_;
    /// For each of the mesh's materials as ModelVertex::texture.
    std::vector<std::uint32_t> textures_;
};

} // namespace

MeshLevel append_level(scene::ModelBuffers& buffers, const MeshSource& source) {
    const models::TriangleMesh& mesh = *source.mesh;
    const std::vector<glm::vec3> normals = given_or_computed_normals(mesh);
    MeshLevel level;
    level.error_m = source.error_m;
    level.shaded = shading::shaded_polygons(mesh, normals);
    level.range.first_index = static_cast<std::uint32_t>(buffers.indices.size());
    level.range.index_count = static_cast<std::uint32_t>(3 * mesh.triangles.size());
    level.range.polygons = static_cast<int>(mesh.triangles.size());
    MipLevelBuilder maker(buffers, mesh);
    for (std::uint32_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) { maker.add(triangle, normals); }
    buffers.has_depth_drawn_meshes = true;
    return level;
}

int select_level(std::span<const double> errors_m, double max_m, int before) {
    assert(!errors_m.empty());
    const auto coarsest_level_within = [&](double limit_m) {
        int level = static_cast<int>(errors_m.size()) - 1;
        while (level > 0 && errors_m[static_cast<std::size_t>(level)] > limit_m) { --level; }
        return level;
    };
    const int coarsest_sufficient = coarsest_level_within(max_m);
    if (before < 0 || coarsest_sufficient < before) { return coarsest_sufficient; }
    return std::max(before, coarsest_level_within(coarsening_margin * max_m));
}

namespace {

using Quantity = overlay::Dial::Quantity;

constexpr std::array<std::pair<std::string_view, Quantity>, 5> named_dials{
    {{"dial_speed", Quantity::Speed}, {"dial_altitude", Quantity::Altitude}, {"dial_attitude", Quantity::Attitude},
        {"dial_heading", Quantity::Heading}, {"dial_load", Quantity::LoadFactor}}};

/// The largest circle about the middle of a polygon's corners.
overlay::Dial dial_in(const models::polygons::PolygonModel& model, std::size_t polygon, Quantity quantity) {
    const auto corners = model.corners(polygon);
    glm::dvec3 middle_m(0.0);
    for (const std::uint32_t corner : corners) {
        middle_m += model.vertices_m[corner] / static_cast<double>(corners.size());
    }
    double radius_m = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 from_m = model.vertices_m[corners[i]];
        const glm::dvec3 along = glm::normalize(model.vertices_m[corners[(i + 1) % corners.size()]] - from_m);
        radius_m = std::min(radius_m, glm::length(glm::cross(along, middle_m - from_m)));
    }
    return {quantity, middle_m, radius_m};
}

} // namespace

overlay::InstrumentLayout dials_of(const models::polygons::PolygonModel& cockpit, const sim::AircraftLimits& limits) {
    overlay::InstrumentLayout layout;
    layout.speed_kt = overlay::speed_scale_kt(limits.max_speed_mps);
    layout.load_g = overlay::load_scale_g(limits.min_load_factor, limits.max_load_factor);
    for (const auto& [name, quantity] : named_dials) {
        const auto polygon = std::ranges::find_if(
            cockpit.polygons, [&, part = name](const auto& one) { return cockpit.parts[one.part] == part; });
        if (polygon != cockpit.polygons.end()) {
            const auto index = static_cast<std::size_t>(polygon - cockpit.polygons.begin());
            layout.dials.push_back(dial_in(cockpit, index, quantity));
        }
    }
    return layout;
}

namespace {

/// A triangle of a fan with less than this share of its polygon's area is a sliver: its corners may come to lie on one
/// line, and drivers differ about which way such a triangle faces.
constexpr double sliver_share = 1e-6;

/// The corner around which a polygon's triangles have no slivers: the first one, or where several corners lie on one
/// side with it, the one whose least triangle is largest.
std::uint32_t fan_corner(const models::polygons::PolygonModel& model, std::uint32_t polygon) {
    const auto corners = model.corners(polygon);
    const auto at_m = [&](std::size_t corner) -> const glm::dvec3& {
        return model.vertices_m[corners[corner % corners.size()]];
    };
    const glm::dvec3 normal = models::polygons::normal_of(model, polygon);
    double whole_m2 = 0.0;
    const auto min_area_m2 = [&](std::size_t from) {
        double min_m2 = std::numeric_limits<double>::max();
        whole_m2 = 0.0;
        for (std::size_t k = from + 1; k + 1 < from + corners.size(); ++k) {
            const glm::dvec3 cross_m2 = glm::cross(at_m(k) - at_m(from), at_m(k + 1) - at_m(from));
            const double area_m2 = glm::dot(cross_m2, normal);
            min_m2 = std::min(min_m2, area_m2);
            whole_m2 += area_m2;
        }
        return min_m2;
    };
    double max_m2 = min_area_m2(0);
    std::uint32_t best = 0;
    if (corners.size() == 3 || max_m2 >= sliver_share * whole_m2) { return best; }
    for (std::uint32_t corner = 1; corner < corners.size(); ++corner) {
        if (const double min_m2 = min_area_m2(corner); min_m2 > max_m2) {
            max_m2 = min_m2;
            best = corner;
        }
    }
    return best;
}

/// As ModelVertex::colour.
std::uint32_t drawn_colour(const models::Material& material) {
    const std::uint32_t colour = models::packed_colour(material.colour);
    if (!is_glass(material)) { return colour; }
    const auto alpha = static_cast<std::uint32_t>(std::lround(254.0F * std::clamp(material.opacity, 0.0F, 1.0F)));
    return (colour & 0x00ffffffU) | alpha << 24U;
}

class BufferBuilder {
public:
    BufferBuilder(const models::polygons::PolygonModel& model, std::span<const glm::vec3> normals)
        : model_(model), normals_(normals) {
        for (const models::Material& material : model.materials) {
            textures_.push_back(texture_number(buffers_, material.texture));
        }
        for (std::uint32_t i = 0; i < model.polygons.size(); ++i) {
            add_corners(i);
            apexes_.push_back(fan_corner(model, i));
        }
    }

    /// Appends polygons as triangle fans in the order given.
    template <class Polygons>
    scene::IndexRange append(const Polygons& polygons) {
        scene::IndexRange range;
        range.first_index = static_cast<std::uint32_t>(buffers_.indices.size());
        for (const std::uint32_t polygon : polygons) {
            const auto [first, count] =
                std::pair(model_.polygons[polygon].first_corner, model_.polygons[polygon].corner_count);
            const std::uint32_t apex = apexes_[polygon];
            for (std::uint32_t corner = apex + 2; corner < apex + count; ++corner) {
                buffers_.indices.insert(
                    buffers_.indices.end(), {first + apex, first + (corner - 1) % count, first + corner % count});
            }
            ++range.polygons;
        }
        range.index_count = static_cast<std::uint32_t>(buffers_.indices.size()) - range.first_index;
        return range;
    }

    scene::ModelBuffers take() { return std::move(buffers_); }

private:
    void add_corners(std::size_t polygon) {
        const glm::vec3 normal(models::polygons::normal_of(model_, polygon));
        const std::uint32_t colour = drawn_colour(model_.materials[model_.polygons[polygon].material]);
        const std::optional<std::uint32_t> pivot = models::polygons::pivot_of(model_, polygon);
        const std::uint32_t part = pivot ? *pivot + 1 : 0;
        for (const std::uint32_t vertex : model_.corners(polygon)) {
            const std::size_t corner = buffers_.vertices.size();
            buffers_.vertices.push_back({glm::vec3(model_.vertices_m[vertex]), normals_[corner], normal, colour, colour,
                part, static_cast<std::uint32_t>(polygon)});
            if (model_.corner_texture_coordinates.empty()) { continue; }
            const glm::vec2& place = model_.corner_texture_coordinates[corner];
            if (std::isnan(place.x)) { continue; }
            buffers_.vertices.back().on_texture = {place.x, 1.0F - place.y};
            buffers_.vertices.back().texture = textures_[model_.polygons[polygon].material];
        }
    }

    const models::polygons::PolygonModel& model_;
    std::span<const glm::vec3> normals_;
    /// The first corner of each polygon's fan.
    std::vector<std::uint32_t> apexes_;
    /// For each of the model's materials as ModelVertex::texture.
    std::vector<std::uint32_t> textures_;
    scene::ModelBuffers buffers_;
};

/// A model in which every vertex on a side of a polygon is also a corner of it, so that renderers round both alike:
/// where a side has no corner of its own in such a place, single pixels between the two may belong to neither. Normals
/// and texture coordinates there are those of the side.
models::polygons::PolygonModel closed(models::polygons::PolygonModel model, std::vector<glm::vec3>& normals) {
    const auto on_sides = models::planar::t_junctions(model);
    if (on_sides.empty()) { return model; }
    std::vector<std::uint32_t> corners;
    std::vector<glm::vec3> corner_normals;
    const std::vector<glm::vec2> places = std::exchange(model.corner_texture_coordinates, {});
    auto next = on_sides.begin();
    for (models::polygons::Polygon& polygon : model.polygons) {
        const std::size_t first = polygon.first_corner;
        const std::size_t count = polygon.corner_count;
        polygon.first_corner = static_cast<std::uint32_t>(corners.size());
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t corner = first + k;
            corners.push_back(model.corner_vertices[corner]);
            corner_normals.push_back(normals[corner]);
            const std::size_t other = first + (k + 1) % count;
            const glm::vec3& end = normals[other];
            if (!places.empty()) { model.corner_texture_coordinates.push_back(places[corner]); }
            for (; next != on_sides.end() && next->corner == corner; ++next) {
                const auto share = static_cast<float>(next->share);
                corners.push_back(next->vertex);
                corner_normals.push_back(glm::mix(normals[corner], end, share));
                if (!places.empty()) {
                    model.corner_texture_coordinates.push_back(glm::mix(places[corner], places[other], share));
                }
            }
        }
        polygon.corner_count = static_cast<std::uint32_t>(corners.size()) - polygon.first_corner;
    }
    model.corner_vertices = std::move(corners);
    normals = std::move(corner_normals);
    return model;
}

std::vector<std::uint32_t> first_vertices_of(const models::polygons::PolygonModel& closed) {
    std::vector<std::uint32_t> first;
    first.reserve(closed.polygons.size() + 1);
    for (const models::polygons::Polygon& polygon : closed.polygons) { first.push_back(polygon.first_corner); }
    first.push_back(static_cast<std::uint32_t>(closed.corner_vertices.size()));
    return first;
}

/// AircraftModel::neighbours. Where several polygons meet at a side, it is the one that is bent least from the first.
std::vector<std::uint32_t> neighbours_of(
    const models::polygons::PolygonModel& closed, std::span<const scene::ModelVertex> drawn) {
    const auto position_of = [&](std::uint32_t corner) {
        const glm::dvec3& at_m = closed.vertices_m[closed.corner_vertices[corner]];
        return std::array{at_m.x, at_m.y, at_m.z};
    };
    std::vector<std::uint32_t> sorted(closed.corner_vertices.size());
    std::iota(sorted.begin(), sorted.end(), 0U);
    std::ranges::sort(sorted, {}, position_of);
    std::vector<std::uint32_t> places(sorted.size()); // equal numbers at equal positions
    for (std::uint32_t i = 1; i < sorted.size(); ++i) {
        const bool is_new = position_of(sorted[i]) != position_of(sorted[i - 1]);
        places[sorted[i]] = places[sorted[i - 1]] + (is_new ? 1U : 0U);
    }

    struct Side {
        std::array<std::uint32_t, 3> key; ///< part, and the places of its ends, the lower one first
        bool is_reversed;
        std::uint32_t corner;
        std::uint32_t polygon;
    };

    std::vector<Side> sides;
    sides.reserve(sorted.size());
    std::vector<glm::dvec3> normals;
    for (std::uint32_t polygon = 0; polygon < closed.polygons.size(); ++polygon) {
        normals.push_back(models::polygons::normal_of(closed, polygon));
        const models::polygons::Polygon& own = closed.polygons[polygon];
        for (std::uint32_t i = 0; i < own.corner_count; ++i) {
            const std::uint32_t corner = own.first_corner + i;
            const std::uint32_t from = places[corner];
            const std::uint32_t to = places[own.first_corner + (i + 1) % own.corner_count];
            sides.push_back({{drawn[corner].part, std::min(from, to), std::max(from, to)}, from > to, corner, polygon});
        }
    }
    std::ranges::stable_sort(sides, {}, &Side::key);
    std::vector<std::uint32_t> neighbours(sorted.size(), models::none);
    for (auto first = sides.begin(); first != sides.end();) {
        const auto end = std::find_if(first, sides.end(), [&](const Side& side) { return side.key != first->key; });
        for (auto side = first; side != end; ++side) {
            double least_bent = -std::numeric_limits<double>::infinity();
            for (auto other = first; other != end; ++other) {
                const double cosine = glm::dot(normals[side->polygon], normals[other->polygon]);
                if (other->is_reversed == side->is_reversed || cosine <= least_bent) { continue; }
                least_bent = cosine;
                neighbours[side->corner] = other->polygon;
            }
        }
        first = end;
    }
    return neighbours;
}

/// Where the triangles of each polygon of a list begin, and where those of the last one end.
std::vector<std::uint32_t> first_indices_of(
    const models::polygons::PolygonModel& model, std::span<const std::uint32_t> list) {
    std::vector<std::uint32_t> first{0};
    first.reserve(list.size() + 1);
    for (const std::uint32_t polygon : list) {
        first.push_back(first.back() + 3 * (model.polygons[polygon].corner_count - 2));
    }
    return first;
}

/// The runs of a list of a model's polygons; none where all are opaque and none is a blade.
std::vector<OpacityRun> opacity_runs_of(const models::polygons::PolygonModel& model,
    std::span<const std::uint32_t> list, std::span<const RotorDisc> discs = {},
    std::span<const std::uint32_t> disc_of_polygon = {}) {
    std::vector<OpacityRun> runs;
    bool is_any_special = false;
    for (std::uint32_t i = 0; i < list.size(); ++i) {
        const models::Material& material = model.materials[model.polygons[list[i]].material];
        const float opacity = is_transparent(material) ? material.opacity : 1.0F;
        OpacityRun run{i, opacity, discs.empty() ? models::none : disc_of_polygon[list[i]]};
        for (std::size_t side = 0; side < 2 && run.disc != models::none; ++side) {
            run.has_side[side] = discs[run.disc].sides[side].polygon == list[i];
        }
        is_any_special = is_any_special || opacity < 1.0F || run.disc != models::none;
        if (!runs.empty()) { run.first = runs.back().first; }
        if (runs.empty() || run != runs.back()) {
            run.first = i;
            runs.push_back(run);
        }
    }
    return is_any_special ? runs : std::vector<OpacityRun>();
}

} // namespace

AircraftModel aircraft_model(models::polygons::PolygonModel polygons, draworder::DrawOrder order,
    const glm::dvec3& eye_m, std::vector<glm::vec3> normals) {
    if (normals.empty()) { normals = shading::corner_normals(polygons); }
    assert(normals.size() == polygons.corner_vertices.size());
    const models::polygons::PolygonModel drawn = closed(polygons, normals);
    shading::ShadedPolygons shaded = shading::shaded_polygons(drawn, normals);
    BufferBuilder maker(drawn, normals);
    std::vector<std::uint32_t> first_indices = first_indices_of(drawn, order.polygons());
    maker.append(order.polygons());
    std::vector<std::uint32_t> file_list = models::polygons::distinct_polygons(polygons);
    const scene::IndexRange all = maker.append(file_list);
    const double radius_m = models::polygons::radius_m(polygons);
    const AxisAlignedBox hull = model_bounds(polygons);
    scene::ModelBuffers buffers = maker.take();
    std::vector<std::uint32_t> neighbours = neighbours_of(drawn, buffers.vertices);
    AircraftModel model{std::move(polygons), std::move(order), std::move(buffers), first_vertices_of(drawn),
        std::move(neighbours), std::move(first_indices), all, std::move(file_list), hull, {radius_m, eye_m},
        std::move(shaded), {}, nullptr, nullptr, {0.0}};
    RotorDiscs found = find_discs(model.polygons);
    model.discs = std::move(found.discs);
    model.disc_of_polygon = std::move(found.disc_of_polygon);
    model.opacity_runs = opacity_runs_of(model.polygons, model.order.polygons(), model.discs, model.disc_of_polygon);
    return model;
}

namespace {

/// Makes hull and radius of a model hold a point of its mesh too.
void include(AircraftModel& model, const glm::dvec3& point_m) {
    model.hull.min_m = glm::min(model.hull.min_m, point_m);
    model.hull.max_m = glm::max(model.hull.max_m, point_m);
    model.subject.radius_m = std::max(model.subject.radius_m, glm::length(point_m));
}

} // namespace

void add_levels(AircraftModel& model, std::span<const MeshSource> sources, double polygons_error_m) {
    model.errors_m.clear();
    for (const MeshSource& source : sources) {
        model.levels.push_back(append_level(model.buffers, source));
        model.errors_m.push_back(source.error_m);
        for (const glm::dvec3& vertex_m : source.mesh->vertices_m) { include(model, vertex_m); }
    }
    model.errors_m.push_back(polygons_error_m);
    assert(std::ranges::is_sorted(model.errors_m));
}

void add_progressive(AircraftModel& model, std::shared_ptr<const refine::ProgressiveMesh> mesh, double polygons_error_m,
    std::shared_ptr<const refine::MeshTextures> textures) {
    assert(model.buffers.textures.empty());
    if (textures) { model.buffers.textures = textures->textures; }
    model.progressive_textures = std::move(textures);
    const glm::dvec3& origin_m = mesh->parts().origin_m;
    for (std::uint32_t node = 0; node < mesh->node_count(); ++node) {
        include(model, origin_m + glm::dvec3(mesh->position_m(node)));
    }
    model.progressive = std::move(mesh);
    model.errors_m = {0.0, polygons_error_m};
    model.buffers.has_depth_drawn_meshes = true;
}

namespace {

/// A part at rest, and where each control alone and all of them together put it at the ends of their positions.
std::vector<glm::dmat4> extremes_of(const models::PartMoves& moves) {
    std::vector<glm::dmat4> placements{glm::dmat4(1.0)};
    models::ControlPositions least{};
    models::ControlPositions most{};
    for (const models::PartMove& move : moves) {
        const auto control = static_cast<std::size_t>(move.control);
        least[control] = models::least_position(move.control);
        most[control] = 1.0;
        for (const double position : {least[control], most[control]}) {
            models::ControlPositions alone{};
            alone[control] = position;
            placements.push_back(models::placement_by(moves, alone));
        }
    }
    placements.push_back(models::placement_by(moves, least));
    placements.push_back(models::placement_by(moves, most));
    return placements;
}

AxisAlignedBox bounds_of_part(std::span<const scene::ModelVertex> vertices, const models::polygons::Pivot* pivot) {
    AxisAlignedBox bounds{
        glm::dvec3(std::numeric_limits<double>::max()), glm::dvec3(std::numeric_limits<double>::lowest())};
    for (const scene::ModelVertex& vertex : vertices) {
        const glm::dvec3 place_m(vertex.position_m);
        const AxisAlignedBox reached =
            pivot == nullptr ? AxisAlignedBox{place_m, place_m} : rotation_bounds(*pivot, place_m);
        bounds.min_m = glm::min(bounds.min_m, reached.min_m);
        bounds.max_m = glm::max(bounds.max_m, reached.max_m);
    }
    return bounds;
}

/// The triangles of an index buffer from `first` on.
scene::IndexRange range_behind(std::uint32_t first, std::span<const std::uint32_t> indices) {
    const auto count = static_cast<std::uint32_t>(indices.size() - first);
    return {first, count, static_cast<int>(count / 3)};
}

bool turns(const RotorDisc& disc, const MovingPartMesh& part) {
    return part.pivot && std::ranges::find(disc.pivots, *part.pivot) != disc.pivots.end();
}

/// RotorDisc::root_m with parts that are meshes: without a hub 0. Nothing where they cover most of the disc.
std::optional<double> hub_radius_m(
    const AircraftModel& model, const RotorDisc& disc, std::span<const MovingPartMesh> parts) {
    const double radius_m = std::max(disc.sides[0].radius_m, disc.sides[1].radius_m);
    DiscCoverage coverage(model.polygons.pivots[disc.pivots.front()], radius_m);
    for (const MovingPartMesh& part : parts) {
        if (!turns(disc, part)) { continue; }
        for (const models::Triangle& triangle : part.mesh->triangles) {
            const auto& places_m = part.mesh->vertices_m;
            coverage.add(std::array{places_m[triangle[0]], places_m[triangle[1]], places_m[triangle[2]]});
        }
    }
    return coverage.hub_radius_m();
}

/// Writes RotorDisc::root_m with parts that are meshes, and removes the discs most of which they cover.
void fit_discs(AircraftModel& model, std::span<const MovingPartMesh> parts) {
    std::vector<RotorDisc> kept;
    std::vector<std::uint32_t> numbers; // of each disc among those, models::none of the others
    for (const RotorDisc& disc : model.discs) {
        const std::optional<double> hub_m = hub_radius_m(model, disc, parts);
        numbers.push_back(hub_m ? static_cast<std::uint32_t>(kept.size()) : models::none);
        if (!hub_m) { continue; }
        kept.push_back(disc);
        kept.back().root_m = *hub_m;
    }
    model.discs = std::move(kept);
    if (model.discs.empty()) { model.disc_of_polygon.clear(); }
    for (std::uint32_t& disc : model.disc_of_polygon) { disc = disc == models::none ? disc : numbers[disc]; }
    model.opacity_runs = opacity_runs_of(model.polygons, model.order.polygons(), model.discs, model.disc_of_polygon);
}

/// Moves the triangles of a disc's blades from the index buffer, from `first` on, to `blades`.
void take_blades(AircraftModel& model, const RotorDisc& disc, std::uint32_t first, std::vector<std::uint32_t>& blades) {
    const models::polygons::Pivot& axis = model.polygons.pivots[disc.pivots.front()];
    std::vector<std::uint32_t>& indices = model.buffers.indices;
    std::size_t kept = first;
    for (std::size_t i = first; i < indices.size(); i += 3) {
        const std::array corners{indices[i], indices[i + 1], indices[i + 2]};
        const bool is_blade = std::ranges::any_of(corners, [&](std::uint32_t corner) {
            const glm::dvec3 off_m = glm::dvec3(model.buffers.vertices[corner].position_m) - axis.point_m;
            return glm::length(off_m - glm::dot(off_m, axis.axis) * axis.axis) > disc.root_m;
        });
        if (is_blade) {
            blades.insert(blades.end(), corners.begin(), corners.end());
        } else {
            std::ranges::copy(corners, indices.begin() + static_cast<std::ptrdiff_t>(kept));
            kept += 3;
        }
    }
    indices.resize(kept);
}

} // namespace

void add_moving_parts(AircraftModel& model, std::span<const MovingPartMesh> parts) {
    assert(model.progressive != nullptr && model.turning.index_count == 0);
    model.turning.first_index = static_cast<std::uint32_t>(model.buffers.indices.size());
    fit_discs(model, parts);
    std::vector<std::vector<std::uint32_t>> blades(model.discs.size());
    std::size_t next = model.polygons.pivots.size();
    for (const MovingPartMesh& part : parts) {
        const std::size_t number = part.pivot ? *part.pivot : next++;
        const std::size_t first = model.buffers.vertices.size();
        const MeshLevel level = append_level(model.buffers, {part.mesh, 0.0});
        for (std::size_t disc = 0; disc < blades.size(); ++disc) {
            if (turns(model.discs[disc], part)) {
                take_blades(model, model.discs[disc], level.range.first_index, blades[disc]);
            }
        }
        const auto vertices = std::span(model.buffers.vertices).subspan(first);
        const models::polygons::Pivot* pivot = part.pivot ? &model.polygons.pivots[*part.pivot] : nullptr;
        for (scene::ModelVertex& vertex : vertices) {
            vertex.part = static_cast<std::uint32_t>(number + 1);
            vertex.polygon = 0;
            const AxisAlignedBox reached = bounds_of_part({&vertex, 1}, pivot);
            include(model, reached.min_m);
            include(model, reached.max_m);
        }
        if (part.moves.empty()) { continue; }
        model.moves.resize(std::max(model.moves.size(), number + 1));
        model.moves[number] = part.moves;
        const AxisAlignedBox bounds = bounds_of_part(vertices, pivot);
        for (const glm::dmat4& placement : extremes_of(part.moves)) {
            for (int corner = 0; corner < 8; ++corner) {
                const auto side = [&](int axis) {
                    return ((corner >> axis) & 1) == 0 ? bounds.min_m[axis] : bounds.max_m[axis];
                };
                include(model, glm::dvec3(placement * glm::dvec4(side(0), side(1), side(2), 1.0)));
            }
        }
    }
    model.turning = range_behind(model.turning.first_index, model.buffers.indices);
    for (std::size_t disc = 0; disc < blades.size(); ++disc) {
        const auto first = static_cast<std::uint32_t>(model.buffers.indices.size());
        model.buffers.indices.insert(model.buffers.indices.end(), blades[disc].begin(), blades[disc].end());
        model.discs[disc].blades = range_behind(first, model.buffers.indices);
    }
}

void add_glass(AircraftModel& model, const models::polygons::PolygonModel& glass, draworder::DrawOrder order,
    std::vector<glm::vec3> normals) {
    assert(model.polygon_representation() > 0 && normals.size() == glass.corner_vertices.size());
    const models::polygons::PolygonModel drawn = closed(glass, normals);
    BufferBuilder maker(drawn, normals);
    maker.append(order.polygons());
    std::vector<std::uint32_t> first_indices = first_indices_of(drawn, order.polygons());
    const scene::ModelBuffers made = maker.take();
    const auto first_vertex = static_cast<std::uint32_t>(model.buffers.vertices.size());
    const auto first_index = static_cast<std::uint32_t>(model.buffers.indices.size());
    for (scene::ModelVertex vertex : made.vertices) {
        vertex.polygon = 0;
        vertex.part = 0;
        if (vertex.texture != 0) { vertex.texture = texture_number(model.buffers, made.textures[vertex.texture - 1]); }
        model.buffers.vertices.push_back(vertex);
        include(model, glm::dvec3(vertex.position_m));
    }
    for (const std::uint32_t index : made.indices) { model.buffers.indices.push_back(first_vertex + index); }
    for (std::uint32_t& first : first_indices) { first += first_index; }
    std::vector<OpacityRun> runs = opacity_runs_of(glass, order.polygons());
    model.glass = OrderedGlass{std::move(order), std::move(first_indices), std::move(runs)};
}

double reach_below_m(const AircraftModel& model) {
    float max_m = 0.0F;
    for (const scene::ModelVertex& vertex : model.buffers.vertices) { max_m = std::max(max_m, vertex.position_m.z); }
    return static_cast<double>(max_m);
}

glm::dvec3 pilot_eye_m(const models::polygons::PolygonModel& model) {
    glm::dvec3 min_m(std::numeric_limits<double>::max());
    glm::dvec3 max_m(std::numeric_limits<double>::lowest());
    for (const glm::dvec3& vertex : model.vertices_m) {
        min_m = glm::min(min_m, vertex);
        max_m = glm::max(max_m, vertex);
    }
    return {max_m.x - 0.25 * (max_m.x - min_m.x), 0.5 * (min_m.y + max_m.y), min_m.z};
}

std::uint32_t level_colour(double error_m, double radius_m) {
    // Neighbours differ clearly. The colours repeat: the tenth halving looks as the first.
    constexpr std::array<std::uint32_t, 9> colours{0xff4040e0U, 0xff30a0f8U, 0xff40e0f0U, 0xff50c850U, 0xffc8c030U,
        0xfff09040U, 0xffe050a0U, 0xffa0a0a0U, 0xff6070a8U};
    if (!(error_m > 0.0) || !(radius_m > 0.0)) { return 0xffffffffU; }
    const double halvings = std::floor(-std::log2(error_m / radius_m));
    const double turns = std::floor(halvings / colours.size());
    return colours[static_cast<std::size_t>(halvings - turns * colours.size())];
}

} // namespace octant::visuals::planning
