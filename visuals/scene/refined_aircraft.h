#pragma once

#include "visuals/refine/view_refiner.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/settings.h"

#include <glm/mat4x4.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace octant::visuals::scene {

/// What an aircraft is refined for. World axes with the eye at the origin.
struct RefineLook {
    std::array<glm::dvec3, 4> frustum{}; ///< frustum_normals
    glm::dvec3 ahead{0.0, 1.0, 0.0};     ///< unit vector
    double pixel_rad = 0.001;
};

/// One aircraft's mesh, kept as fine as each frame needs it. Several share a hierarchy. Keeps its
/// memory.
class RefinedAircraft {
public:
    /// The hierarchy is in body axes.
    RefinedAircraft(std::shared_ptr<const refine::ProgressiveMesh> mesh, const Settings& settings);

    /// One frame; nothing is done where nothing has moved. `first`: it was not seen in the frame
    /// before, so it is made fit at once.
    refine::RefinedFrame
    update(const glm::dmat4& body_to_eye_world, const RefineLook& look, bool first);

    int triangles() const { return static_cast<int>(refiner_.front().face_count()); }

    /// The mesh of the last update() for drawing. `smooth`: corners share vertices; else each
    /// triangle has its own, with its own normal. Until the next call.
    RefinedDraw draw(bool smooth);

private:
    ModelVertex drawn(const refine::RefinedVertex& vertex) const;
    void fill_shared();
    void fill_apart();

    refine::ViewRefiner refiner_;
    std::vector<ModelVertex> vertices_;
    std::vector<std::uint32_t> indices_;
};

} // namespace octant::visuals::scene
