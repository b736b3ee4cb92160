#include "ui/world/near_ground_notes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace octant::ui::world {

namespace {

/// Why a ground shows neither; empty where it does.
std::string why_none(const World& world, const visuals::scene::GroundSettings& settings) {
    if (world.scene.ground->spacing_m() <= 0.0) {
        return fmt::format("{} has no samples between which there could be any", world.ground_name);
    }
    if (visuals::scene::ground_metric(settings) != visuals::scene::GroundMetric::ScreenError) {
        return "only ground that is refined by screen-error shows any";
    }
    return {};
}

} // namespace

std::vector<std::string> near_ground_notes(
    const World& world,
    const visuals::scene::GroundSettings& settings,
    std::span<const std::string> given) {
    const std::string why = why_none(world, settings);
    const Ellipsoid below = ellipsoid_below(world.ground_place);
    const std::string textured =
        world.scene.ground_texture ? "where a texture colours the ground there is none"
        : !below.is_earth() ? fmt::format("nothing grows or is built on {}", name_of_body(below))
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

std::optional<std::string>
note_of_low_eye(const glm::dvec3& eye_m, const std::optional<double>& ground_m) {
    if (!ground_m || eye_m.z >= *ground_m) {
        return std::nullopt;
    }
    constexpr double clear_m = 2.0;
    return fmt::format(
        "--eye {0:g},{1:g},{2:g} lies {3:.1f} m under the ground, which is {4:.1f} m high there: "
        "--eye "
        "{0:g},{1:g},{5:.0f} lies above it",
        eye_m.x,
        eye_m.y,
        eye_m.z,
        *ground_m - eye_m.z,
        *ground_m,
        std::ceil(*ground_m + clear_m));
}

} // namespace octant::ui::world
