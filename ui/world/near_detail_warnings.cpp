#include "ui/world/near_detail_warnings.h"

#include <algorithm>
#include <fmt/format.h>

namespace octant::ui::world {

namespace {

/// Why a ground shows neither; empty where it does.
std::string reason_for_no_near_detail(const World& world, const visuals::scene::GroundSettings& settings) {
    if (world.scene.ground->spacing_m() <= 0.0) {
        return fmt::format("{} has no samples between which there could be any", world.ground_name);
    }
    if (visuals::scene::ground_metric(settings) != visuals::scene::GroundMetric::ScreenError) {
        return "only ground that is refined by screen-error shows any";
    }
    return {};
}

} // namespace

std::vector<std::string> near_detail_warnings(
    const World& world, const visuals::scene::GroundSettings& settings, std::span<const std::string> given) {
    const std::string why = reason_for_no_near_detail(world, settings);
    const Ellipsoid below = ellipsoid_below(world.ground_place);
    const std::string textured = world.scene.ground_texture ? "where a texture colours the ground there is none"
                                 : !below.is_earth()
                                     ? fmt::format("nothing grows or is built on {}", name_of_body(below))
                                     : "";
    std::vector<std::string> notes;
    const auto note = [&](const std::string& option, bool is_on, const std::string& reason) {
        if (is_on && !reason.empty() && std::ranges::find(given, option) != given.end()) {
            notes.push_back(fmt::format("{} shows nothing: {}", option, reason));
        }
    };
    note("--near-detail", settings.near_detail, why);
    note("--scenery", settings.scenery, why.empty() ? textured : why);
    note("--roads", settings.roads, why.empty() ? textured : why);
    return notes;
}

} // namespace octant::ui::world
