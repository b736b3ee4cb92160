#pragma once

#include "visuals/planning/scene.h"
#include "visuals/scene/frame_plan.h"

#include <glm/vec3.hpp>

#include <string>

namespace octant::ui::library {

/// The triangles of a plan as OBJ in world axes (World::export_scene). `scene`: that of the plan.
std::string obj_of(
    const visuals::scene::FramePlan& plan, const visuals::planning::Scene& scene, const glm::dvec3& eye_m);

} // namespace octant::ui::library
