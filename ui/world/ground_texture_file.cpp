#include "ui/world/ground_texture_file.h"

#include "models/heights/image.h"
#include "models/heights/image_on_ground.h"
#include "sim/base/error.h"
#include "visuals/scene/ground_texture_maker.h"

#include <fmt/format.h>

namespace octant::ui::world {

namespace scene = visuals::scene;
using scene::GroundShading;

void check_untextured_ground(const settings::Settings& settings) {
    const bool draped = settings.air.drape.has_value();
    if (draped || settings.air.ground_shading == GroundShading::Texture) {
        throw Error(fmt::format(
            "{}: expected ground with heights (hills, canyon or a file), got --terrain {}",
            draped ? "--drape" : "--ground-shading texture",
            printable(settings.path.terrain)));
    }
}

std::optional<scene::GroundTexture> load_ground_texture(
    const visuals::terrain::GroundSamples& ground,
    const models::heights::GroundArea& area,
    const settings::Settings& settings,
    DrawnBy drawn_by,
    std::vector<std::string>& notes) {
    if (settings.air.drape) {
        if (settings.air.ground_shading == GroundShading::Vertex) {
            throw Error("--drape: expected --ground-shading texture or auto beside it, got vertex");
        }
        const models::heights::Image drape = models::heights::laid_on_ground(
            models::heights::read_image(*settings.air.drape), area, scene::largest_texture);
        if (!drape.note.empty()) {
            notes.push_back(drape.note);
        }
        return scene::ground_texture(ground, settings.air, &drape);
    }
    const bool textured =
        settings.air.ground_shading == GroundShading::Texture ||
        (settings.air.ground_shading == GroundShading::Auto && drawn_by == DrawnBy::Gpu);
    return textured ? std::optional(scene::ground_texture(ground, settings.air, nullptr))
                    : std::nullopt;
}

} // namespace octant::ui::world
