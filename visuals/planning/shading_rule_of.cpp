#include "visuals/planning/shading_rule_of.h"

namespace octant::visuals::planning {

shading::ShadingRuleSettings shading_rule_of(const scene::ShadingSettings& settings) {
    shading::ShadingRuleSettings rule;
    rule.rule = settings.rule == scene::HybridRule::Paper ? shading::ShadingRule::Paper : shading::ShadingRule::Error;
    return rule;
}

} // namespace octant::visuals::planning
