#include "ui/settings/settings.h"
#include "ui/settings/settings_check.h"
#include "ui/settings/settings_text.h"

#include <catch2/catch.hpp>

#include <string>

using namespace octant;
namespace scene = visuals::scene;
using ui::settings::RunSettings;

namespace {

void check_refused(const RunSettings& settings, const std::string& message) {
    CHECK_THROWS_WITH(ui::settings::check_settings(settings), message);
}

} // namespace

TEST_CASE("the defaults contradict nothing") { CHECK_NOTHROW(ui::settings::check_settings(RunSettings())); }

TEST_CASE("only the numbers of samples that renderers offer are taken") {
    RunSettings settings;
    settings.view.samples = 4;
    CHECK_NOTHROW(ui::settings::check_settings(settings));
    settings.view.samples = 2;
    check_refused(settings, "--samples: expected 1, 4 or 16, got 2");
    settings.view.samples = 16;
    CHECK_NOTHROW(ui::settings::check_settings(settings));
    settings.drawing.renderer = ui::settings::RendererKind::Gl;
    check_refused(settings, "--samples: expected 1 or 4 beside --renderer gl, got 16");
}

TEST_CASE("a time is a day that a calendar has, and a minute of it") {
    RunSettings settings;
    settings.air.time = "2024-06-21T05:30";
    CHECK_NOTHROW(ui::settings::check_settings(settings));
    settings.air.time = "2023-02-29T12:00";
    check_refused(settings, "--time: expected a day and an hour as YYYY-MM-DDTHH:MM, got '2023-02-29T12:00'");
}

TEST_CASE("clouds are refused beside a depth buffer, a ribbon without a path") {
    RunSettings settings;
    settings.air.clouds = 0.5;
    settings.view.path_ribbon = true;
    settings.surface.effects = true;
    CHECK_NOTHROW(ui::settings::check_settings(settings));
    settings.path.name = std::string(ui::settings::live_path);
    check_refused(settings, "--show path-ribbon: expected a path or a track, got what others fly");
    settings.view.path_ribbon = false;
    CHECK_NOTHROW(ui::settings::check_settings(settings));
    settings.surface.hidden_surface = scene::HiddenSurface::DepthBuffer;
    check_refused(settings, "--clouds: expected --hidden-surface octant or back-face beside it, got depth-buffer");
    settings.air.clouds = 0.0;
    CHECK_NOTHROW(ui::settings::check_settings(settings)); // effects have depths
}

TEST_CASE("eye points are refused where the view does not take them") {
    RunSettings settings;
    settings.view.eye_m = glm::dvec3(1.0, 2.0, 3.0);
    check_refused(settings, "--eye: expected --view tower or free beside it, got --view chase");
    settings.view.kind = scene::View::Tower;
    CHECK_NOTHROW(ui::settings::check_settings(settings));
    settings.view.look_m = settings.view.eye_m;
    check_refused(settings, "--look: expected --view free beside it, got --view tower");
    settings.view.kind = scene::View::Free;
    check_refused(settings, "--look: expected another point than --eye, got the same");
    settings.view.look_m.reset();
    check_refused(settings, "--view free: expected --eye X,Y,Z and --look X,Y,Z, got at most one of them");
}

TEST_CASE("a free inset needs the free view") {
    RunSettings settings;
    settings.view.inset = scene::View::Free;
    check_refused(settings, "--inset free: expected --view free beside it, got --view chase");
}

TEST_CASE("a share of smooth polygons needs hybrid shading, and its distances their order") {
    RunSettings settings;
    settings.shading.kind = scene::AircraftShading::Flat;
    CHECK_NOTHROW(ui::settings::check_settings(settings));
    settings.shading.smooth_share = 0.5;
    check_refused(settings,
        "--shading: expected hybrid beside --adapt shading, --smooth-share, --paper-shading device-ratio or "
        "--shading-rule paper, got flat");
    settings.shading.kind = scene::AircraftShading::Hybrid;
    settings.shading.near_m = 5.0;
    settings.shading.far_m = 2.0;
    check_refused(settings, "--paper-shading far: expected more than near (5), got 2");
}

TEST_CASE("terrain follows the frame time only where its triangles are counted") {
    RunSettings settings;
    settings.adapt.terrain = true;
    CHECK_NOTHROW(ui::settings::check_settings(settings));
    settings.path.terrain = "none";
    check_refused(settings, "--adapt terrain: expected ground with levels of detail, got none");
    settings.ground.lod.control = visuals::terrain::DetailControl::Damped;
    check_refused(settings, "--adapt terrain: expected --terrain-lod screen-error or exact, got --terrain-lod " +
                                ui::settings::text_of(settings.ground.lod));
}

TEST_CASE("the screen error is refused beside what only the quadtree has") {
    RunSettings settings;
    settings.ground.lod.metric = visuals::terrain::GroundMetric::Midpoint;
    settings.ground.error_px = 1.0;
    check_refused(settings, "--error-px: expected --terrain-lod screen-error, got --terrain-lod exact");
    settings.ground.lod.metric = visuals::terrain::GroundMetric::ScreenError;
    CHECK_NOTHROW(ui::settings::check_settings(settings));
    settings.ground.lod.control = visuals::terrain::DetailControl::Damped;
    check_refused(settings, "--mesh screen-error: expected --detail exact without --roughness-c, --fans or "
                            "--propagation, got one that only --terrain-lod exact or paper has");
}

TEST_CASE("a texture needs ground with heights, and a drape ground that is lit at each pixel") {
    RunSettings settings;
    settings.air.drape = "map.png";
    CHECK_NOTHROW(ui::settings::check_settings(settings));
    settings.air.ground_shading = scene::GroundShading::Vertex;
    check_refused(settings, "--drape: expected --ground-look shading=texture or auto beside it, got vertex");
    settings.path.terrain = "background60";
    check_refused(settings, "--drape: expected ground with heights (hills, canyon or a file), got --terrain "
                            "background60");
    settings.air.drape.reset();
    CHECK_NOTHROW(ui::settings::check_settings(settings));
    settings.air.ground_shading = scene::GroundShading::Texture;
    check_refused(settings,
        "--ground-look shading=texture: expected ground with heights (hills, canyon or a file), got "
        "--terrain background60");
}
