#pragma once

#include "models/heights/image_on_ground.h"
#include "ui/settings/settings.h"
#include "visuals/scene/ground_texture.h"
#include "visuals/terrain/ground_samples.h"

#include <optional>
#include <string>
#include <vector>

namespace octant::ui::world {

/// What decides whether a texture is worth its time where the settings leave it open.
enum class DrawnBy { Processor, Gpu };

/// Throws Error where the settings ask for a texture and the ground has no heights to make one of.
void check_untextured_ground(const settings::Settings& settings);

/// The texture of the ground; nothing where it is drawn by its vertices' colours. What a person
/// should be told goes to `notes`. `area`: of the samples. Throws Error for a drape that cannot be
/// read or laid over the ground, and for one that the settings give no texture for.
std::optional<visuals::scene::GroundTexture> load_ground_texture(
    const visuals::terrain::GroundSamples& ground,
    const models::heights::GroundArea& area,
    const settings::Settings& settings,
    DrawnBy drawn_by,
    std::vector<std::string>& notes);

} // namespace octant::ui::world
