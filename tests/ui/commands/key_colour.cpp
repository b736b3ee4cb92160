#include "tests/ui/commands/key_colour.h"

#include "sim/base/output_file.h"
#include "tests/scratch.h"
#include "tests/ui/flight/kept_world.h"
#include "ui/base/data_files.h"
#include "ui/flight/session.h"

#include <cstring>
#include <filesystem>
#include <vector>

namespace octant::tests {

namespace {

long cracks_in(const visuals::scene::Picture& picture) {
    constexpr std::uint32_t key = 0xffff00ffU; // magenta, opaque
    std::vector<std::uint32_t> pixels(picture.rgba.size() / 4);
    std::memcpy(pixels.data(), picture.rgba.data(), picture.rgba.size());
    long cracks = 0;
    for (int x = 0; x < picture.width; ++x) {
        bool below_ground = false;
        for (int y = 0; y < picture.height; ++y) {
            const bool is_key = pixels[static_cast<std::size_t>(y * picture.width + x)] == key;
            cracks += is_key && below_ground ? 1 : 0;
            below_ground = below_ground || !is_key;
        }
    }
    return cracks;
}

/// An aircraft too small to be seen: what is not background is ground.
std::string speck_file() {
    const auto path = scratch_folder() / "speck.obj";
    write_file(path, "v 0 0 0\nv 0.001 0 0\nv 0 0.001 0\nf 1 2 3\n");
    return path.string();
}

} // namespace

ui::settings::RunSettings key_colour_settings(
    const std::string& path, const std::string& aircraft, const std::string& terrain, double rate_hz) {
    ui::settings::RunSettings settings;
    settings.path.name = ui::base::path_file(path, aircraft).string();
    settings.path.aircraft = {speck_file()};
    settings.path.terrain = terrain;
    settings.time.rate_hz = rate_hz;
    settings.view.size_px = {640, 360};
    settings.air.sky = false;
    settings.air.visibility_m = 0.0;
    settings.air.background = {1.0F, 0.0F, 1.0F};
    settings.view.kind = visuals::scene::View::Chase;
    return settings;
}

long cracks_in_flight(const ui::settings::RunSettings& settings) {
    ui::flight::Session session(settings, ui::flight::PictureContent::World, nullptr, kept_world(settings));
    long cracks = 0;
    for (int frame = 0; frame < session.frames(); ++frame) {
        session.draw(frame);
        cracks += cracks_in(session.picture());
    }
    return cracks;
}

long cracks_along(const std::string& path, const std::string& aircraft, const std::string& terrain, double rate_hz) {
    return cracks_in_flight(key_colour_settings(path, aircraft, terrain, rate_hz));
}

} // namespace octant::tests
