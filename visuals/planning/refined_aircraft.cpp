#include "visuals/planning/refined_aircraft.h"

#include "visuals/planning/aircraft_model.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

namespace octant::visuals::planning {

shading::ShadingRuleSettings shading_rule_of(const scene::ShadingSettings& settings) {
    shading::ShadingRuleSettings rule;
    rule.rule = settings.rule == scene::HybridRule::Paper ? shading::ShadingRule::Paper : shading::ShadingRule::Error;
    return rule;
}

namespace {

/// The bit of RefinedDraw::first_smooth that flat triangles have.
constexpr std::uint32_t flat_polygon = 1;

float part_of(std::uint32_t colour, unsigned shift) { return static_cast<float>(colour >> shift & 0xffU); }

float colour_sum(std::uint32_t colour) {
    return (part_of(colour, 0) + part_of(colour, 8) + part_of(colour, 16)) / 255.0F;
}

std::uint32_t mean_colour(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    std::uint32_t mean = 0xff000000U;
    for (unsigned shift = 0; shift < 24; shift += 8) {
        const std::uint32_t sum = (a >> shift & 0xffU) + (b >> shift & 0xffU) + (c >> shift & 0xffU);
        mean |= (sum + 1) / 3 << shift;
    }
    return mean;
}

/// For each material of a hierarchy whether it is transparent; empty where none of its faces is, or all are.
std::vector<bool> transparent_materials(const refine::ProgressiveMeshData& parts) {
    std::vector<bool> is_clear;
    for (const models::Material& material : parts.materials) { is_clear.push_back(models::is_transparent(material)); }
    const auto count = std::ranges::count_if(parts.face_materials, [&](auto material) { return is_clear[material]; });
    const bool are_some = count > 0 && static_cast<std::size_t>(count) < parts.face_materials.size();
    return are_some ? is_clear : std::vector<bool>();
}

} // namespace

RefinedAircraft::RefinedAircraft(std::shared_ptr<const refine::ProgressiveMesh> mesh,
    const refine::ViewRefinerOptions& options, const scene::ShadingSettings& shading,
    std::shared_ptr<const refine::MeshTextures> textures, std::shared_ptr<const refine::MeshCreases> creases)
    : refiner_(std::move(mesh), options, textures),
      textures_(shading.show_model == scene::ModelDisplay::None ? std::move(textures) : nullptr),
      creases_(std::move(creases)), is_left_out_(transparent_materials(refiner_.front().mesh().parts())),
      selector_(shading_rule_of(shading)),
      lights_corners_(shading.rule != scene::HybridRule::Paper && (textures_ || creases_)),
      shows_levels_(shading.show_model == scene::ModelDisplay::Levels) {}

refine::RefinedFrame RefinedAircraft::update(const glm::dmat4& body_to_eye_world, const FrameView& view, bool first) {
    const glm::dmat3 turn(body_to_eye_world); // a vector times it is turned back
    refine::RefineView in_body;
    in_body.eye_m = -glm::dvec3(body_to_eye_world[3]) * turn;
    in_body.forward = view_direction(view.camera) * turn;
    for (std::size_t i = 0; i < view.frustum.size(); ++i) { in_body.side_normals[i] = view.frustum[i] * turn; }
    in_body.focal_px = 1.0 / view.pixel_rad;
    if (first) { refiner_.refine_fully(in_body); }
    const refine::RefinedFrame frame = refiner_.update(in_body);
    const bool changed = first || frame.splits + frame.collapses > 0;
    front_changed_ = front_changed_ || changed;
    drawn_changed_ = drawn_changed_ || changed || frame.moving > 0;
    return frame;
}

void RefinedAircraft::forget_frames() {
    refiner_.restart();
    selector_.forget_choices();
    choosing_ = false;
    all_flat_ = false;
    front_changed_ = true;
    drawn_changed_ = true;
}

scene::ModelVertex RefinedAircraft::drawn(std::uint32_t slot) const {
    const refine::ProgressiveMesh& mesh = refiner_.front().mesh();
    const refine::RefinedVertex& vertex = refiner_.front().vertices()[slot];
    scene::ModelVertex drawn;
    drawn.position_m = vertex.position_m + glm::vec3(mesh.parts().origin_m);
    drawn.normal = refine::unpacked(vertex.normal);
    drawn.colour = vertex.colour;
    const std::uint32_t node = refiner_.front().node_at(slot);
    if (shows_levels_ && node != refine::none) {
        drawn.colour = level_colour(mesh.error_m(node), mesh.half_diagonal_m());
    }
    return drawn;
}

/// The chart of a face; 0 without textures.
std::uint32_t RefinedAircraft::chart_of(std::uint32_t face) const {
    const std::vector<std::uint16_t>& charts = refiner_.front().mesh().parts().face_materials;
    return textures_ && !charts.empty() ? charts[face] : 0;
}

/// The colour on a chart of a vertex whose node has another one.
std::uint32_t RefinedAircraft::colour_on(std::uint32_t number, std::uint32_t colour_of_node) const {
    const refine::ChartSurface& chart = textures_->charts[number];
    return chart.texture != 0 || chart.is_plain ? chart.colour : colour_of_node;
}

/// Puts a slot's vertex on the picture of a chart.
void RefinedAircraft::put_on_texture(scene::ModelVertex& vertex, std::uint32_t slot, std::uint32_t number) const {
    const refine::ChartSurface& chart = textures_->charts[number];
    vertex.texture = chart.texture;
    vertex.colour = colour_on(number, vertex.colour);
    if (chart.texture == 0) { return; }
    vertex.on_texture = refiner_.place_on_picture(slot, number);
}

/// Gives the slots whose nodes lie on several charts a vertex for each but the first.
void RefinedAircraft::add_chart_vertices() {
    chart_vertices_.resize(slot_count_);
    for (std::uint32_t slot = 0; slot < slot_count_; ++slot) {
        const std::uint32_t node = refiner_.front().node_at(slot);
        if (node == refine::none) { continue; }
        const auto places = textures_->places_of(node);
        if (places.size() < 2) { continue; }
        chart_vertices_[slot] = static_cast<std::uint32_t>(vertices_.size());
        const scene::ModelVertex plain = drawn(slot);
        for (const refine::ChartPlace& at : places.subspan(1)) {
            vertices_.push_back(plain);
            put_on_texture(vertices_.back(), slot, at.chart);
        }
    }
}

/// The vertex of a slot on a chart that its node touches; without textures the slot.
std::uint32_t RefinedAircraft::corner_vertex(std::uint32_t slot, std::uint32_t chart) const {
    if (!textures_) { return slot; }
    const auto places = textures_->places_of(refiner_.front().node_at(slot));
    if (places.front().chart == chart) { return slot; }
    const auto at = std::ranges::lower_bound(places, chart, {}, &refine::ChartPlace::chart);
    assert(at != places.end() && at->chart == chart);
    return chart_vertices_[slot] + static_cast<std::uint32_t>(at - places.begin() - 1);
}

/// Takes over what has been written of the front's vertices.
void RefinedAircraft::follow_front() {
    refine::SelectiveRefiner& front = refiner_.front();
    front.take_dirty_vertices(ranges_);
    slot_count_ = front.vertices().size();
    vertices_.resize(slot_count_);
    for (const refine::SlotRange& range : ranges_) {
        for (std::size_t slot = range.first; slot < range.end; ++slot) {
            scene::ModelVertex vertex = drawn(static_cast<std::uint32_t>(slot));
            const std::uint32_t node = refiner_.front().node_at(static_cast<std::uint32_t>(slot));
            if (textures_ && node != refine::none) {
                put_on_texture(vertex, static_cast<std::uint32_t>(slot), textures_->places_of(node).front().chart);
            }
            vertices_[slot] = vertex;
        }
    }
}

/// The normal of a face at a crease; nothing where its corner has that of the slot's vertex.
std::optional<glm::vec3> RefinedAircraft::crease_normal(
    std::uint32_t slot, std::uint32_t face, std::size_t corner) const {
    if (!creases_ || !creases_->is_creased[refiner_.front().node_at(slot)]) { return std::nullopt; }
    constexpr float same_cosine = 0.9986F;
    const glm::vec3 normal = refine::unpacked(creases_->corner_normals[face].at(corner));
    return glm::dot(normal, vertices_[slot].normal) > same_cosine ? std::nullopt : std::optional(normal);
}

/// Makes the points at which light is computed: the front's vertices and, where lights_corners_, one for each corner
/// that has another normal or colour than its vertex.
void RefinedAircraft::make_points() {
    points_.clear();
    for (const scene::ModelVertex& vertex : std::span(vertices_).first(slot_count_)) {
        points_.push_back({vertex.position_m, vertex.normal, colour_sum(vertex.colour)});
    }
    if (!lights_corners_) { return; }
    const refine::SelectiveRefiner& front = refiner_.front();
    corner_points_.assign(front.indices().begin(), front.indices().end());
    for (std::size_t place = 0; 3 * place < corner_points_.size(); ++place) {
        const auto corners = std::span(corner_points_).subspan(3 * place, 3);
        if (corners[0] == corners[1]) {
            continue; // a place without a triangle
        }
        const std::uint32_t face = front.face_at(place);
        for (std::size_t k = 0; k < 3; ++k) {
            shading::ShadingPoint point = points_[corners[k]];
            const auto normal = crease_normal(corners[k], face, k);
            const std::uint32_t of_slot = vertices_[corners[k]].colour;
            const std::uint32_t colour =
                textures_ ? colour_on(chart_of(face), front.vertices()[corners[k]].colour) : of_slot;
            if (!normal && colour == of_slot) { continue; }
            point.normal = normal.value_or(point.normal);
            point.colour_sum = colour_sum(colour);
            corners[k] = static_cast<std::uint32_t>(points_.size());
            points_.push_back(point);
        }
    }
}

/// Copies the numbers of the triangles whose blocks changed in the front.
void RefinedAircraft::follow_labels() {
    refine::SelectiveRefiner& front = refiner_.front();
    front.take_dirty_faces(ranges_);
    labels_.resize(front.indices().size() / 3);
    for (const refine::SlotRange& range : ranges_) {
        for (std::size_t place = range.first; place < range.end; ++place) { labels_[place] = front.face_at(place); }
    }
}

void RefinedAircraft::shade(const glm::dvec3& eye_m, const shading::ShadingLight& light, int smooth) {
    assert(smooth >= 0 && smooth <= triangles());
    const bool chooses = smooth > 0 && smooth < triangles();
    const bool all_flat = smooth == 0;
    if (chooses != choosing_ || all_flat != all_flat_) {
        front_changed_ = true;
        drawn_changed_ = true;
    }
    choosing_ = chooses;
    all_flat_ = all_flat;
    if (!chooses) { return; }
    if (drawn_changed_) {
        follow_front();
        follow_labels();
        make_points();
    }
    const shading::DynamicMesh mesh{.points = points_,
        .indices = lights_corners_ ? std::span<const std::uint32_t>(corner_points_) : refiner_.front().indices(),
        .labels = labels_,
        .triangle_count = refiner_.front().face_count(),
        .centre_m = glm::vec3(refiner_.front().mesh().middle_m())};
    const bool chosen = selector_.choose(mesh, eye_m, light, static_cast<std::size_t>(smooth), front_changed_);
    front_changed_ = false;
    drawn_changed_ = drawn_changed_ || chosen;
}

/// Gives a flat triangle a first corner of its own.
void RefinedAircraft::write_flat(std::span<const std::uint32_t> corners) {
    const scene::ModelVertex& second = vertices_[corners[1]];
    const scene::ModelVertex& third = vertices_[corners[2]];
    scene::ModelVertex first = vertices_[corners[0]];
    const glm::vec3 across = glm::cross(second.position_m - first.position_m, third.position_m - first.position_m);
    const float size = glm::length(across);
    first.face_normal = size > 0.0F ? across / size : first.normal;
    first.face_colour = mean_colour(first.colour, second.colour, third.colour);
    first.polygon = flat_polygon;
    indices_.push_back(static_cast<std::uint32_t>(vertices_.size()));
    indices_.push_back(corners[1]);
    indices_.push_back(corners[2]);
    vertices_.push_back(first);
}

/// A vertex of its own for a corner at a crease, with the normal that the face has there; else the vertex as it is.
std::uint32_t RefinedAircraft::creased_vertex(
    std::uint32_t vertex, std::uint32_t slot, std::uint32_t face, std::size_t corner) {
    const auto normal = crease_normal(slot, face, corner);
    if (!normal) { return vertex; }
    scene::ModelVertex own = vertices_[vertex];
    own.normal = *normal;
    vertices_.push_back(own);
    return static_cast<std::uint32_t>(vertices_.size() - 1);
}

void RefinedAircraft::write_indices() {
    const refine::SelectiveRefiner& front = refiner_.front();
    const auto shared = front.indices();
    const auto smooth = selector_.smooth();
    if (textures_) { add_chart_vertices(); }
    indices_.clear();
    for (std::size_t place = 0; 3 * place < shared.size(); ++place) {
        const auto slots = shared.subspan(3 * place, 3);
        if (slots[0] == slots[1]) {
            continue; // a place without a triangle
        }
        const std::uint32_t face = front.face_at(place);
        if (!is_left_out_.empty() && is_left_out_[front.mesh().parts().face_materials[face]]) { continue; }
        const std::uint32_t chart = chart_of(face);
        const std::array<std::uint32_t, 3> corners{
            corner_vertex(slots[0], chart), corner_vertex(slots[1], chart), corner_vertex(slots[2], chart)};
        if (all_flat_ || (choosing_ && smooth[place] == 0)) {
            write_flat(corners);
            continue;
        }
        for (std::size_t k = 0; k < 3; ++k) { indices_.push_back(creased_vertex(corners.at(k), slots[k], face, k)); }
    }
}

scene::RefinedDraw RefinedAircraft::draw() {
    const bool is_front = !choosing_ && !all_flat_ && !textures_ && !creases_ && is_left_out_.empty();
    assert(!choosing_ || !front_changed_);
    if (drawn_changed_) {
        follow_front();
        if (!is_front) { write_indices(); }
    }
    drawn_changed_ = false;
    scene::RefinedDraw draw;
    draw.vertices = vertices_;
    draw.indices = is_front ? refiner_.front().indices() : indices_;
    return draw;
}

} // namespace octant::visuals::planning
