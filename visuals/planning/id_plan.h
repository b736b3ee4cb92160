#pragma once

#include "visuals/planning/scene.h"
#include "visuals/scene/frame_plan.h"

#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::planning {

/// Turns plans into plans whose pictures have polygon numbers as colours: each polygon of each aircraft (a split
/// polygon is one), each triangle of the ground and each colour of a road or a runway has a number; 0 is the
/// background. Sky and overlay are left out; the other painting steps are those of the plan, so that a renderer draws
/// both in the same way. For pictures with one sample a pixel, of plans without shadows.
class IdPlan {
public:
    /// The scene must outlive it. Throws Error for one with a progressive mesh, whose triangles have no numbers.
    explicit IdPlan(const Scene& scene);

    /// The models that a renderer must load for these plans, in place of the scene's.
    const std::vector<scene::ModelBuffers>& models() const { return models_; }

    /// The plan with numbers, valid until the next call and as long as `plan`. A triangle of the ground has the same
    /// number in every plan in which its corners have the same positions.
    const scene::FramePlan& of(const scene::FramePlan& plan);

private:
    void add_ground(const scene::FramePlan& plan, std::span<const std::uint32_t> indices);

    /// One or two for each aircraft, then the cockpit.
    std::vector<scene::ModelBuffers> models_;
    /// The index is AircraftDraw::first_part.
    std::vector<std::uint32_t> model_of_part_;

    /// An aircraft with a far model, which has numbers of its own.
    struct FarModelIds {
        std::uint32_t first_part = 0;
        /// Index into Scene::models.
        std::uint32_t far_model = 0;
        /// Index into models_.
        std::uint32_t numbered = 0;
    };

    std::vector<FarModelIds> far_ids_of_part_;
    std::vector<models::ColourVertex> vertices_;
    std::vector<std::uint32_t> indices_;
    scene::FramePlan plan_;
};

} // namespace octant::visuals::planning
