#include "visuals/landscape/ground.h"

#include <cassert>

namespace octant::visuals::landscape {

MeshSettings mesh_settings(const scene::Settings& settings, bool textured) {
    return {
        settings.ground,
        settings.view.size_px.y,
        settings.surface.hidden_surface == scene::HiddenSurface::DepthBuffer,
        textured};
}

const nature::Backdrop& Ground::surroundings() const {
    std::call_once(surroundings_once_, [this] {
        if (spacing_m() > 0.0) {
            surroundings_ = nature::backdrop_of(
                {half_extent_m(),
                 mean_height_m(),
                 mean_colour(),
                 [this](const glm::dvec2& at_m) {
                     return height_at(at_m.x, at_m.y).value_or(mean_height_m());
                 },
                 [this](const glm::dvec2& at_m, double footprint_m) {
                     return colour_at(at_m.x, at_m.y, footprint_m);
                 }});
        }
    });
    return surroundings_;
}

std::unique_ptr<GroundMesher> Ground::mesher(const MeshSettings& settings) const {
    assert(is_meshed_as(settings.ground));
    return make_mesher(settings);
}

std::unique_ptr<GroundMesher> mesher_after(
    std::unique_ptr<GroundMesher> before, const Ground& ground, const MeshSettings& settings) {
    assert(ground.is_meshed_as(settings.ground));
    if (!before || (&before->ground() != &ground && !before->move_to(ground.shared_from_this()))) {
        return ground.mesher(settings);
    }
    before->follow(settings);
    return before;
}

} // namespace octant::visuals::landscape
