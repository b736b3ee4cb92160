#include "ui/world/ground_texture_file.h"

#include "models/heights/image.h"
#include "visuals/landscape/ground_palette.h"
#include "visuals/landscape/ground_texture_maker.h"

namespace octant::ui::world {

namespace landscape = visuals::landscape;
namespace scene = visuals::scene;
using scene::GroundShading;

std::optional<scene::GroundTexture> load_ground_texture(const landscape::GroundTextureSource& ground,
    const settings::RunSettings& settings, RenderDevice device, std::vector<std::string>& notes) {
    const visuals::nature::Climate climate = landscape::climate_at(ground.place);
    if (settings.air.drape) {
        const models::heights::Image drape = models::heights::resampled_to_ground(
            models::heights::read_image(*settings.air.drape), ground.area, landscape::max_texture_size_px);
        if (!drape.note.empty()) { notes.push_back(drape.note); }
        return landscape::ground_texture(ground.samples, settings.air, &drape, climate);
    }
    const bool textured = settings.air.ground_shading == GroundShading::Texture ||
                          (settings.air.ground_shading == GroundShading::Auto && device == RenderDevice::Gpu);
    return textured ? std::optional(landscape::ground_texture(ground.samples, settings.air, nullptr, climate))
                    : std::nullopt;
}

} // namespace octant::ui::world
