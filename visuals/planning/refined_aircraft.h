#pragma once

#include "visuals/planning/frame_view.h"
#include "visuals/refine/mesh_creases.h"
#include "visuals/refine/mesh_textures.h"
#include "visuals/refine/view_refiner.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/settings.h"
#include "visuals/shading/dynamic_mesh_shading.h"
#include "visuals/shading/shading_rule.h"

#include <glm/mat4x4.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace octant::visuals::planning {

/// The settings of the rule by which visuals/shading chooses smooth polygons.
shading::ShadingRuleSettings shading_rule_of(const scene::ShadingSettings& settings);

/// The progressive mesh of one aircraft, refined for each frame. Several aircraft share a hierarchy. Only parts of the
/// mesh that have changed since the last frame are computed again.
class RefinedAircraft {
public:
    /// The hierarchy is in body axes. Its transparent faces are not drawn, unless all are: AircraftModel::glass shows
    /// them. `textures`: the pictures on it; `creases`: its edges; null: none.
    RefinedAircraft(std::shared_ptr<const refine::ProgressiveMesh> mesh, const refine::ViewRefinerOptions& options,
        const scene::ShadingSettings& shading, std::shared_ptr<const refine::MeshTextures> textures = {},
        std::shared_ptr<const refine::MeshCreases> creases = {});

    /// Refines the mesh for a frame; does nothing where nothing has moved. `first`: the aircraft was not drawn as this
    /// mesh in the last frame; the mesh is then refined fully, without geomorphs.
    refine::RefinedFrame update(const glm::dmat4& body_to_eye_world, const FrameView& view, bool first);

    /// Forgets all frames: the next update(), whose `first` must be true, does not depend on them.
    void forget_frames();

    int triangles() const { return static_cast<int>(refiner_.front().face_count()); }

    /// Chooses which triangles of the last update() are smooth: exactly `smooth`, from 0 to triangles(). Eye and light
    /// are in body axes. The rule Error lights each triangle's corners with the normals and colours that draw() gives
    /// them, so that an edge in sight costs no smooth triangle; the rule Paper lights vertices, as printed.
    void shade(const glm::dvec3& eye_m, const shading::ShadingLight& light, int smooth);

    /// The mesh of the last update(), shaded by the last shade(); all smooth before the first shade(). Corners share
    /// vertices, but the first vertex of a flat triangle is its own and has the triangle's normal and mean colour, and
    /// so are corners at creases.
    /// Valid until the next call.
    scene::RefinedDraw draw();

private:
    scene::ModelVertex drawn(std::uint32_t slot) const;
    std::uint32_t chart_of(std::uint32_t face) const;
    std::uint32_t colour_on(std::uint32_t number, std::uint32_t colour_of_node) const;
    void put_on_texture(scene::ModelVertex& vertex, std::uint32_t slot, std::uint32_t number) const;
    void add_chart_vertices();
    std::uint32_t corner_vertex(std::uint32_t slot, std::uint32_t chart) const;
    void follow_front();
    std::optional<glm::vec3> crease_normal(std::uint32_t slot, std::uint32_t face, std::size_t corner) const;
    void make_points();
    void follow_labels();
    void write_indices();
    void write_flat(std::span<const std::uint32_t> corners);
    std::uint32_t creased_vertex(std::uint32_t vertex, std::uint32_t slot, std::uint32_t face, std::size_t corner);

    refine::ViewRefiner refiner_;
    /// Null where none are shown.
    std::shared_ptr<const refine::MeshTextures> textures_;
    std::shared_ptr<const refine::MeshCreases> creases_;
    /// For each material of the hierarchy whether its faces are left out; empty: none.
    std::vector<bool> is_left_out_;
    shading::DynamicMeshSelector selector_;
    /// Whether the selector lights the corners of triangles one by one; else vertices.
    bool lights_corners_;
    bool shows_levels_;
    /// Whether some triangles are smooth and some are not.
    bool choosing_ = false;
    /// Whether all are flat, where none is chosen.
    bool all_flat_ = false;
    /// Whether the front has changed since the selector has seen it.
    bool front_changed_ = true;
    /// Whether anything has changed since draw().
    bool drawn_changed_ = true;
    /// The number of vertices_ that are slots of the front. With textures each lies on the first chart of its node, and
    /// those on its further charts follow; last come the first vertices of flat triangles.
    std::size_t slot_count_ = 0;
    /// For each slot its vertex on the second chart of its node; with textures only.
    std::vector<std::uint32_t> chart_vertices_;
    std::vector<scene::ModelVertex> vertices_;
    /// One for each slot, then those of corners that differ from their slot's vertex.
    std::vector<shading::ShadingPoint> points_;
    /// For each corner of the front's indices its point; with lights_corners_ only.
    std::vector<std::uint32_t> corner_points_;
    /// One for each place of the front's indices.
    std::vector<std::uint32_t> labels_;
    std::vector<std::uint32_t> indices_;
    std::vector<refine::SlotRange> ranges_;
};

} // namespace octant::visuals::planning
