#pragma once

#include "visuals/planning/frame_view.h"
#include "visuals/refine/view_refiner.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/settings.h"
#include "visuals/shading/dynamic_mesh_shading.h"
#include "visuals/shading/shading_rule.h"

#include <glm/mat4x4.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace octant::visuals::planning {

/// The rule by which visuals/shading is to choose the polygons, or the triangles of a refined mesh, that are smooth.
shading::ShadingRuleSettings shading_rule_of(const scene::ShadingSettings& settings);

/// One aircraft's mesh, kept as fine as each frame needs it. Several share a hierarchy. Keeps its memory; what stays
/// from frame to frame is not worked out again.
class RefinedAircraft {
public:
    /// The hierarchy is in body axes.
    RefinedAircraft(std::shared_ptr<const refine::ProgressiveMesh> mesh, const refine::ViewRefinerOptions& options,
        const scene::ShadingSettings& shading);

    /// One frame; nothing is done where nothing has moved. `first`: it was not seen in the frame before, so it is made
    /// fit at once.
    refine::RefinedFrame update(const glm::dmat4& body_to_eye_world, const FrameView& view, bool first);

    int triangles() const { return static_cast<int>(refiner_.front().face_count()); }

    /// Chooses which triangles of the last update() are smooth: exactly `smooth`, from 0 to triangles(). Eye and light
    /// are in body axes.
    void shade(const glm::dvec3& eye_m, const shading::ShadingLight& light, int smooth);

    /// The mesh of the last update() for drawing, shaded as shade() chose after it, before the first one all smooth.
    /// Corners share vertices, but a flat triangle's first one is its own, with its normal and the mean of its corners'
    /// colours. Until the next call.
    scene::RefinedDraw draw();

private:
    scene::ModelVertex drawn(std::uint32_t slot) const;
    void follow_front();
    void follow_labels();
    void write_indices();
    void write_flat(std::span<const std::uint32_t> corners);

    refine::ViewRefiner refiner_;
    shading::DynamicMeshSelector selector_;
    bool shows_levels_;
    /// Whether some triangles are smooth and some are not.
    bool choosing_ = false;
    /// Whether all are flat, where none is chosen.
    bool all_flat_ = false;
    /// Whether the front has changed since the selector has seen it.
    bool front_changed_ = true;
    /// Whether anything has changed since draw().
    bool drawn_changed_ = true;
    /// How many of vertices_ are slots of the front; those of flat triangles lie behind them.
    std::size_t slot_count_ = 0;
    std::vector<scene::ModelVertex> vertices_;
    /// One for each slot.
    std::vector<shading::ShadingPoint> points_;
    /// One for each place of the front's indices.
    std::vector<std::uint32_t> labels_;
    std::vector<std::uint32_t> indices_;
    std::vector<refine::SlotRange> ranges_;
};

} // namespace octant::visuals::planning
