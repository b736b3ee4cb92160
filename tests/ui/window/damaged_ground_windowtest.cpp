#include "sim/base/output_file.h"
#include "tests/damaged_grounds.h"
#include "tests/ui/window/driven_viewer.h"
#include "ui/flight/session.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <filesystem>
#include <string>

using namespace octant;
using namespace octant::tests;

namespace {

/// What a window made of damaged grounds.
struct Outcomes {
    int refused = 0; ///< with a message that names the file
    int named = 0;   ///< told at the end, with exit code 1
};

/// Has the paused window change to a ground and draw the flight's first picture over it.
void change_ground(DrivenViewer& driven, const std::filesystem::path& ground) {
    driven.state().message.text.clear();
    driven.state().next_settings.path.terrain = ground.string();
    driven.turns(3);
}

} // namespace

TEST_CASE("of damaged grounds a window refuses each, names it, or shows what it would be unharmed") {
    const std::filesystem::path sound = scratch_folder() / "sound.ground";
    write_file(sound, sound_ground());
    ui::settings::RunSettings settings = small_flight();
    settings.view.size_px = {160, 120};
    settings.path.name = "turn";
    settings.path.aircraft = {"500md"};
    settings.path.terrain = sound.string();
    const auto driven = DrivenViewer::open(settings);
    if (!driven) { return; }
    driven->strike("space");
    driven->strike("Home");
    const visuals::scene::Picture expected = driven->picture();
    Outcomes outcomes;
    for (std::uint64_t seed = 1; seed <= 200; seed += 8) {
        INFO("seed " << seed);
        Numbers numbers(seed);
        const std::string name = "damaged" + std::to_string(seed) + ".ground";
        const std::filesystem::path file = scratch_folder() / name;
        write_file(file, damaged(sound_ground(), numbers));
        change_ground(*driven, file);
        if (driven->settings().path.terrain != file.string()) {
            CHECK(driven->state().message.text.find(name) != std::string::npos);
            ++outcomes.refused;
        } else {
            const bool same = driven->picture().rgba == expected.rgba;
            const bool named = is_noted(file);
            CHECK((same || named));
            outcomes.named += named ? 1 : 0;
        }
        std::filesystem::remove(file);
    }
    CHECK(outcomes.refused > 5);
    CHECK(outcomes.named > 1);
}
