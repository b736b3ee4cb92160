#pragma once

#include "visuals/scene/settings.h"
#include "visuals/shading/shading_rule.h"

namespace octant::visuals::planning {

/// The rule by which visuals/shading is to choose the polygons, or the triangles of a refined mesh, that are smooth.
shading::ShadingRuleSettings shading_rule_of(const scene::ShadingSettings& settings);

} // namespace octant::visuals::planning
