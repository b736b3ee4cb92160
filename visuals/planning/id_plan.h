#pragma once

#include "visuals/planning/scene.h"
#include "visuals/scene/frame_plan.h"

#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::planning {

/// Turns plans into plans whose picture says in each pixel's colour which polygon it shows: of an aircraft (a split
/// polygon counts as one, each aircraft for itself), which triangle of the ground or which colour of a road or a runway
/// on it; 0 is nothing. The painting steps stay those of the plan, but for sky and overlay, so that a renderer draws
/// both alike. For pictures with one sample a pixel, of plans without shadows.
class IdPlan {
public:
    /// The scene must outlive it. Throws Error for one with a mesh that is refined in each frame: its triangles have no
    /// numbers.
    explicit IdPlan(const Scene& scene);

    /// What a renderer has to load for these plans, in place of the scene's models.
    const std::vector<scene::ModelBuffers>& models() const { return models_; }

    /// Valid until the next call, and as long as `plan`. A triangle of the ground has the same number in every plan in
    /// which its corners lie in the same places.
    const scene::FramePlan& of(const scene::FramePlan& plan);

private:
    void add_ground(const scene::FramePlan& plan, std::span<const std::uint32_t> indices);

    /// One or two for each aircraft, then the cockpit.
    std::vector<scene::ModelBuffers> models_;
    /// By AircraftDraw::first_part.
    std::vector<std::uint32_t> model_of_part_;

    /// An aircraft that a plan may draw as another model of the scene, which has numbers too.
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
