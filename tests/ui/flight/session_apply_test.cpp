#include "models/heights/height_field_export.h"
#include "sim/base/error.h"
#include "tests/scratch.h"
#include "ui/flight/session.h"
#include "visuals/groundfile/ground_import.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "fake_renderer.h"

using namespace octant;
using namespace octant::tests;
namespace scene = octant::visuals::scene;
using ui::settings::RunSettings;

namespace {

/// A file of rough ground on which the straight path fits.
std::filesystem::path ground_file() {
    const std::filesystem::path file = scratch_folder() / "rough.tif";
    if (std::filesystem::exists(file)) { return file; }
    constexpr int side = 129;
    std::vector<float> heights_m;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            heights_m.push_back(static_cast<float>(std::lround(150.0 * std::sin(column / 5.0) * std::cos(row / 7.0))));
        }
    }
    models::heights::write_height_field(file, {side, side, 100.0, heights_m});
    return file;
}

RunSettings small_settings() {
    RunSettings settings;
    settings.path.terrain = ground_file().string();
    settings.path.heading_deg = 0.0;
    settings.view.size_px = {64, 48};
    settings.ground.triangles = 800;
    settings.surface.shadows = false;
    return settings;
}

constexpr double step_s = 0.05;

/// A session without any drawing, picture by picture.
class Flown {
public:
    explicit Flown(const RunSettings& settings)
        : session_(settings, ui::flight::PictureContent::World,
              std::make_unique<FakeRenderer>(log_, settings.view.size_px)) {
        log_->calls.clear();
    }

    /// The next picture; the one after it is begun beside it.
    ui::report::FrameRecord picture() {
        const double time_s = step_s * pictures_++;
        return session_.draw_at(time_s, time_s + step_s);
    }

    void apply(const RunSettings& settings) {
        log_->calls.clear();
        session_.apply(settings);
    }

    ui::flight::Session& session() { return session_; }

    RendererLog& log() { return *log_; }

    std::uint64_t last_ground() const { return log_->grounds.back(); }

private:
    std::shared_ptr<RendererLog> log_ = std::make_shared<RendererLog>();
    ui::flight::Session session_;
    int pictures_ = 0;
};

/// Whether two sessions draw the same from here on.
void check_same_pictures(Flown& a, Flown& b) {
    CHECK(a.session().settings() == b.session().settings());
    for (int i = 0; i < 3; ++i) {
        const ui::report::FrameRecord of_a = a.picture();
        const ui::report::FrameRecord of_b = b.picture();
        CHECK(of_a.sim_time_s == of_b.sim_time_s);
        CHECK(of_a.eye_m == of_b.eye_m);
        CHECK(of_a.triangle_target == of_b.triangle_target);
        CHECK(of_a.terrain_triangles == of_b.terrain_triangles);
        CHECK(a.last_ground() == b.last_ground());
        CHECK(a.log().size_px == b.log().size_px);
    }
}

/// After a refused change of settings a session draws what one draws that was never asked.
void check_refused(const RunSettings& begun, const std::function<void(RunSettings&)>& change,
    const std::string& refused_call, const std::vector<std::string>& calls) {
    Flown asked(begun);
    Flown never_asked(begun);
    asked.picture();
    never_asked.picture();
    RunSettings changed = begun;
    change(changed);
    asked.log().refuses = refused_call;
    CHECK_THROWS_AS(asked.apply(changed), Error);
    CHECK(asked.log().calls == calls);
    check_same_pictures(asked, never_asked);
    CHECK_NOTHROW(asked.apply(changed));
    CHECK(asked.session().settings() == changed);
    asked.picture();
}

} // namespace

TEST_CASE("what only a recording goes by changes nothing of a flight that goes on") {
    Flown changed(small_settings());
    Flown unchanged(small_settings());
    changed.picture();
    unchanged.picture();
    RunSettings settings = small_settings();
    settings.time.rate_hz = 30.0;
    settings.time.frames = 7;
    settings.time.pictures = 2;
    changed.apply(settings);
    CHECK(changed.log().calls.empty());
    CHECK(changed.session().settings() == settings);
    changed.apply(small_settings());
    check_same_pictures(changed, unchanged);
}

TEST_CASE("settings that contradict each other or cannot be loaded leave a session as it was") {
    check_refused(small_settings(),
        [](RunSettings& settings) {
            settings.view.size_px = {32, 32};
        },
        "resize", {"resize 32x32"});
    Flown asked(small_settings());
    Flown never_asked(small_settings());
    asked.picture();
    never_asked.picture();
    RunSettings wrong = small_settings();
    wrong.ground.lod.metric = visuals::terrain::GroundMetric::Midpoint;
    wrong.ground.error_px = 1.0;
    CHECK_THROWS_AS(asked.apply(wrong), Error);
    wrong = small_settings();
    wrong.path.terrain = (scratch_folder() / "none.tif").string();
    CHECK_THROWS_AS(asked.apply(wrong), Error);
    CHECK(asked.log().calls.empty());
    check_same_pictures(asked, never_asked);
}

TEST_CASE("a texture that the renderer has no memory for leaves a session as it was") {
    const auto texture_and_size = [](RunSettings& settings) {
        settings.air.ground_shading = scene::GroundShading::Texture;
        settings.view.size_px = {32, 32};
    };
    check_refused(small_settings(), texture_and_size, "texture", {"resize 32x32", "texture", "resize 64x48"});
}

TEST_CASE("a texture in other colours that is refused leaves a session with the one it had") {
    RunSettings textured = small_settings();
    textured.air.ground_shading = scene::GroundShading::Texture;
    check_refused(textured, [](RunSettings& settings) { settings.air.palette = scene::Palette::Arid; }, "texture",
        {"resize 64x48", "texture", "resize 64x48"});
}

TEST_CASE("another world is loaded into the renderer once its ground has gone there") {
    Flown flown(small_settings());
    flown.picture();
    RunSettings settings = small_settings();
    settings.air.ground_shading = scene::GroundShading::Texture;
    settings.path.aircraft = {"f15", "f15"};
    flown.apply(settings);
    // Of the aircraft and of the cockpit around its pilot.
    CHECK(flown.log().calls == std::vector<std::string>{"resize 64x48", "texture", "models 2"});
}

TEST_CASE("a change while ground is meshed ahead gives the pictures of ground meshed in time") {
    RunSettings ahead = small_settings();
    RunSettings in_time = small_settings();
    in_time.ground.mesh_async = false;
    Flown a(ahead);
    Flown b(in_time);
    const auto change = [&](const std::function<void(RunSettings&)>& by) {
        by(ahead);
        by(in_time);
        a.apply(ahead);
        b.apply(in_time);
        a.picture();
        b.picture();
        CHECK(a.last_ground() == b.last_ground());
    };
    a.picture();
    b.picture();
    REQUIRE(a.last_ground() == b.last_ground());
    const std::uint64_t before = a.last_ground();
    change([](RunSettings& settings) { settings.air.sun_azimuth_deg = 90.0; });
    CHECK(a.last_ground() != before);
    change([](RunSettings& settings) { settings.air.palette = scene::Palette::Arid; });
    change([](RunSettings& settings) { settings.view.size_px = {128, 96}; });
    change([](RunSettings& settings) { settings.ground.error_px = 2.0; });
    change([](RunSettings& settings) { settings.view.inset = scene::View::Chase; });
    change([](RunSettings& settings) { settings.air.sun_elevation_deg = 60.0; });
    change([](RunSettings& settings) {
        settings.ground.lod.metric = visuals::terrain::GroundMetric::Midpoint;
        settings.ground.error_px.reset();
    });
}

TEST_CASE("another visibility makes nothing anew, and an inset sees it too") {
    RunSettings settings = small_settings();
    settings.view.inset = scene::View::Chase;
    settings.air.haze_height_m = 0.0;
    Flown flown(settings);
    flown.picture();
    settings.air.visibility_m = 1234.0;
    flown.apply(settings);
    flown.picture();
    CHECK(flown.log().calls.empty());
    CHECK(flown.log().visibilities_m.back() == 1234.0F);
    CHECK(flown.log().visibilities_m[flown.log().visibilities_m.size() - 2] == 1234.0F);
}

TEST_CASE("light that is made while pictures are drawn is that of a change in between") {
    RunSettings settings = small_settings();
    settings.view.inset = scene::View::Orbit;
    Flown followed(settings);
    Flown at_once(settings);
    followed.picture();
    at_once.picture();
    settings.air.time = "2026-06-21T08:30";
    const std::uint64_t before = followed.last_ground();
    CHECK_FALSE(followed.session().follow_time_of_day(std::nullopt));
    CHECK_FALSE(followed.session().follow_time_of_day(settings.air.time)); // begins
    while (!followed.session().follow_time_of_day(settings.air.time)) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    CHECK_FALSE(followed.session().follow_time_of_day(settings.air.time));
    at_once.apply(settings);
    check_same_pictures(followed, at_once);
    CHECK(followed.last_ground() != before);

    settings.air.time = "2026-06-21T18:30";
    CHECK_FALSE(followed.session().follow_time_of_day(settings.air.time));
    settings.air.palette = scene::Palette::Arid; // loads its own light
    followed.apply(settings);
    at_once.apply(settings);
    CHECK_FALSE(followed.session().follow_time_of_day(settings.air.time));
    check_same_pictures(followed, at_once);
}

TEST_CASE("ground in another light has the colours of ground that was loaded so") {
    RunSettings settings = small_settings();
    Flown relit(settings);
    relit.picture();
    settings.air.sun_azimuth_deg = 100.0;
    settings.air.water_level_m = 20.0;
    Flown lit(settings);
    relit.apply(settings);
    lit.picture();
    relit.picture();
    lit.picture();
    CHECK(relit.last_ground() == lit.last_ground());
}

TEST_CASE("another light, palette or view reads no terrain again, whatever is drawn of it") {
    const std::filesystem::path map = scratch_folder() / "read_once.tif";
    const std::filesystem::path imported = scratch_folder() / "read_once.ground";
    for (const auto& [terrain, mesh] : {std::pair{map, visuals::terrain::GroundMetric::ScreenError},
             std::pair{map, visuals::terrain::GroundMetric::Midpoint},
             std::pair{imported, visuals::terrain::GroundMetric::ScreenError}}) {
        for (const auto shading : {scene::GroundShading::Vertex, scene::GroundShading::Texture}) {
            CAPTURE(terrain, static_cast<int>(mesh), static_cast<int>(shading));
            std::filesystem::copy_file(ground_file(), map, std::filesystem::copy_options::overwrite_existing);
            if (terrain == imported) {
                std::filesystem::remove(imported);
                visuals::groundfile::import_ground(
                    {map}, imported, {}, [](auto /*stage*/, double /*done*/) { return false; });
            }
            RunSettings settings = small_settings();
            settings.path.terrain = terrain.string();
            settings.ground.lod.metric = mesh;
            settings.air.ground_shading = shading;
            RunSettings changed = settings;
            changed.air.sun_azimuth_deg = 100.0;
            changed.air.palette = scene::Palette::Arid;
            Flown relit(settings);
            Flown lit(changed);
            relit.picture();
            lit.picture();
            REQUIRE(relit.last_ground() != lit.last_ground());
            std::filesystem::remove(map);
            std::filesystem::remove(imported);

            const bool is_textured = shading == scene::GroundShading::Texture;
            const std::uint64_t texture_of_lit = lit.log().texture;
            relit.apply(changed);
            relit.picture();
            lit.picture();
            CHECK(relit.last_ground() == lit.last_ground());
            CHECK(relit.log().texture == texture_of_lit);
            CHECK((texture_of_lit != 0) == is_textured);

            changed.view.inset = scene::View::Chase;
            relit.apply(changed);
            CHECK(relit.log().calls == std::vector<std::string>{"resize 64x48"});
            const std::size_t grounds = relit.log().grounds.size();
            relit.picture();
            CHECK(relit.log().grounds.size() == grounds + 2);
        }
    }
}
