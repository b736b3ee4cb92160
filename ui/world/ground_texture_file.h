#pragma once

#include "models/heights/height_field.h"
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

/// The texture of the ground; nothing where it is drawn by its vertices' colours. What a person
/// should be told goes to `notes`. `area` and `place`: of the samples. The settings have passed
/// settings::check_settings. Throws Error for a drape that cannot be read or laid over the ground.
std::optional<visuals::scene::GroundTexture> load_ground_texture(
    const visuals::terrain::GroundSamples& ground,
    const models::heights::GroundArea& area,
    const settings::RunSettings& settings,
    const std::optional<models::heights::GeoPlace>& place,
    DrawnBy drawn_by,
    std::vector<std::string>& notes);

} // namespace octant::ui::world
