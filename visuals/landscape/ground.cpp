#include "visuals/landscape/ground.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace octant::visuals::landscape {

double highest_m(const Ground& ground) {
    constexpr int max_steps = 512;
    const glm::dvec2 half_m = ground.half_extent_m();
    const double spacing_m = ground.spacing_m();
    if (spacing_m <= 0.0) { return std::isfinite(ground.mean_height_m()) ? ground.mean_height_m() : 0.0; }
    const auto steps_over = [&](double half) {
        return std::clamp(static_cast<int>(std::lround(2.0 * half / spacing_m)), 1, max_steps);
    };
    const glm::ivec2 steps(steps_over(half_m.x), steps_over(half_m.y));
    double highest = -std::numeric_limits<double>::infinity();
    for (int row = 0; row <= steps.y; ++row) {
        for (int column = 0; column <= steps.x; ++column) {
            const glm::dvec2 share = glm::dvec2(column, row) / glm::dvec2(steps);
            const glm::dvec2 at_m = (2.0 * share - 1.0) * half_m;
            highest = std::max(highest, ground.height_at(at_m.x, at_m.y).value_or(highest));
        }
    }
    return std::isfinite(highest) ? highest : 0.0;
}

MeshSettings mesh_settings(const scene::Settings& settings, bool has_texture) {
    return {settings.ground, settings.view.size_px.y,
        settings.surface.hidden_surface == scene::HiddenSurface::DepthBuffer, has_texture};
}

const nature::Backdrop& Ground::backdrop() const {
    std::call_once(backdrop_once_, [this] {
        if (spacing_m() > 0.0) {
            backdrop_ = nature::make_backdrop({half_extent_m(), mean_height_m(), mean_colour(),
                [this](const glm::dvec2& at_m) { return height_at(at_m.x, at_m.y).value_or(mean_height_m()); },
                [this](const glm::dvec2& at_m, double footprint_m) { return colour_at(at_m.x, at_m.y, footprint_m); },
                [this](const glm::dvec2& at_m, double footprint_m) {
                    return cover_code_at(at_m.x, at_m.y, footprint_m);
                }});
        }
    });
    return backdrop_;
}

std::unique_ptr<GroundMesher> Ground::mesher(const MeshSettings& settings) const {
    assert(has_mesh_settings(settings.ground));
    return make_mesher(settings);
}

std::unique_ptr<GroundMesher> reuse_or_make_mesher(
    std::unique_ptr<GroundMesher> before, const Ground& ground, const MeshSettings& settings) {
    assert(ground.has_mesh_settings(settings.ground));
    if (!before || (&before->ground() != &ground && !before->switch_ground(ground.shared_from_this()))) {
        return ground.mesher(settings);
    }
    before->apply_settings(settings);
    return before;
}

} // namespace octant::visuals::landscape
