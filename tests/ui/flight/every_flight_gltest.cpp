#include "tests/ui/flight/kept_world.h"
#include "ui/flight/session.h"
#include "visuals/scene/picture.h"

#include <catch2/catch.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>

using namespace octant;
using ui::flight::Session;
using visuals::scene::View;

namespace {

/// A dozen frames from the whole path.
ui::settings::RunSettings small_flight(
    const std::string& path, const std::string& aircraft, const std::string& ground) {
    ui::settings::RunSettings settings;
    settings.path.name = path;
    settings.path.aircraft = {aircraft};
    settings.path.terrain = ground;
    settings.time.rate_hz = 0.3;
    settings.time.frames = 12;
    settings.view.size_px = {160, 90};
    settings.ground.triangles = 3000;
    return settings;
}

/// Flies from the start in that view; returns the last picture's pixels.
visuals::scene::PictureBytes flown_in(Session& session, View view) {
    ui::settings::RunSettings settings = session.settings();
    settings.view.kind = view;
    session.apply(settings);
    session.begin_at(0.0);
    const double frame_s = 1.0 / session.rate_hz();
    const std::uint64_t at_start = session.state_hash();
    for (int frame = 0; frame < session.frames(); ++frame) {
        const double next_s = (frame + 1) * frame_s;
        session.draw_at(frame * frame_s, frame + 1 < session.frames() ? std::optional<double>(next_s) : std::nullopt);
        const auto& pixels = session.picture().rgba;
        CHECK(std::set<std::uint8_t>(pixels.begin(), pixels.end()).size() > 10);
    }
    CHECK(session.state_hash() != at_start);
    return session.picture().rgba;
}

} // namespace

TEST_CASE("every path, aircraft, view and built-in ground flies") {
    constexpr std::array views = {View::Chase, View::Cockpit, View::Tower, View::Orbit};
    for (const std::string ground : {"hills", "canyon", "background60"}) {
        for (const std::string path : {"straight", "jinking", "pop-up", "turn"}) {
            const std::string aircraft = (ground.size() + path.size()) % 2 == 1 ? "f15" : "500md";
            INFO(ground << " " << path << " " << aircraft);
            const auto settings = small_flight(path, aircraft, ground);
            Session session(settings, ui::flight::PictureContent::World, nullptr, tests::kept_world(settings));
            REQUIRE(session.frames() > 5);
            std::set<visuals::scene::PictureBytes> pictures;
            for (const View view : views) {
                INFO("view " << static_cast<int>(view));
                pictures.insert(flown_in(session, view));
            }
            CHECK(pictures.size() == views.size());
        }
    }
}
