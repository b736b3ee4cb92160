#pragma once

#include "ui/settings/settings.h"
#include "visuals/landscape/ground.h"
#include "visuals/scene/ground_texture.h"

#include <optional>
#include <string>
#include <vector>

namespace octant::ui::world {

/// What decides whether a texture is worth its time where the settings leave it open.
enum class RenderDevice { Cpu, Gpu };

/// The texture of the ground; nothing where it is drawn by its vertices' colours. What a person should be told goes to
/// `notes`. The settings have passed settings::check_settings. Throws Error for a drape that cannot be read or laid
/// over the ground.
std::optional<visuals::scene::GroundTexture> load_ground_texture(const visuals::landscape::GroundTextureSource& ground,
    const settings::RunSettings& settings, RenderDevice device, std::vector<std::string>& notes);

} // namespace octant::ui::world
