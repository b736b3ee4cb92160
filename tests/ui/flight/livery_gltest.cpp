#include "sim/base/output_file.h"
#include "sim/base/random_generator.h"
#include "tests/scratch.h"
#include "tests/ui/flight/kept_world.h"
#include "tests/ui/flight/layer_rays.h"
#include "ui/flight/renderer_choice.h"
#include "ui/report/png_file.h"
#include "visuals/planning/planner.h"
#include "visuals/scene/camera.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <fmt/format.h>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

using namespace octant;
using namespace octant::tests;
namespace planning = octant::visuals::planning;
namespace scene = octant::visuals::scene;
namespace settings = octant::ui::settings;

namespace {

constexpr int livery_width = 256;
constexpr int livery_height = 128;
using Livery = std::function<std::array<int, 3>(int, int)>; ///< of a column and a row from the top, 0..255

std::array<int, 3> stripes(int column, int row) {
    const bool is_line = column % 32 == 0 || row % 16 == 0;
    const bool is_band = row > 40 && row < 52;
    return is_line ? std::array{60, 60, 70} : is_band ? std::array{200, 30, 40} : std::array{225, 225, 230};
}

std::array<int, 3> camouflage(int column, int row) {
    const double waves = std::sin(column * 0.11) + std::sin(row * 0.19 + 1.3) + std::sin((column + 2 * row) * 0.07);
    return waves > 0.8 ? std::array{70, 80, 50} : waves > -0.4 ? std::array{140, 120, 80} : std::array{50, 55, 60};
}

/// Letters of the size of a few texels, in rows.
std::array<int, 3> titles(int column, int row) {
    const bool is_letter = row / 4 % 4 == 1 && (column / 3 * 7 + row * 5) % 11 < 5;
    return is_letter ? std::array{20, 40, 120} : std::array{240, 240, 240};
}

/// A spindle of rings and a wing through it, with a livery over both, as an OBJ file with its picture. More than 2,000
/// triangles are flown as a refined mesh, fewer polygons in painting order.
std::string livery_aircraft(const std::string& name, const Livery& livery, int rings, int sides) {
    std::vector<std::byte> rgb;
    for (int row = 0; row < livery_height; ++row) {
        for (int column = 0; column < livery_width; ++column) {
            for (const int part : livery(column, row)) { rgb.push_back(static_cast<std::byte>(part)); }
        }
    }
    ui::report::Picture picture{livery_width, livery_height, 3, std::move(rgb)};
    ui::report::write_png(scratch_folder() / (name + ".png"), picture.view());
    write_file(scratch_folder() / (name + ".mtl"), fmt::format("newmtl skin\nKd 1 1 1\nmap_Kd {}.png\n", name));
    std::string text = fmt::format("mtllib {}.mtl\nusemtl skin\n", name);
    for (int ring = 0; ring <= rings; ++ring) {
        const double along = static_cast<double>(ring) / rings;
        const double radius_m = 0.15 + std::sin(along * std::numbers::pi);
        for (int side = 0; side <= sides; ++side) {
            const double round = static_cast<double>(side) / sides;
            const double turn = round * 2.0 * std::numbers::pi;
            text += fmt::format("v {} {} {}\nvt {} {}\n", 12.0 * along - 6.0, radius_m * std::cos(turn),
                radius_m * std::sin(turn), along, round);
        }
    }
    for (int ring = 0; ring < rings; ++ring) {
        for (int side = 0; side < sides; ++side) {
            const int at = ring * (sides + 1) + side + 1;
            const int next = at + sides + 1;
            text += fmt::format("f {0}/{0} {1}/{1} {2}/{2}\nf {0}/{0} {2}/{2} {3}/{3}\n", at, at + 1, next + 1, next);
        }
    }
    text += "v -2 0 -7\nv 0 0 -7\nv 1 0 7\nv -1 0 7\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
            "f -4/-4 -3/-3 -2/-2 -1/-1\nf -1/-1 -2/-2 -3/-3 -4/-4\n";
    write_file(scratch_folder() / (name + ".obj"), text);
    return (scratch_folder() / (name + ".obj")).string();
}

/// How two pictures of an aircraft differ.
struct Comparison {
    int pixels = 0;    ///< of the aircraft
    int different = 0; ///< by more than the bound in a part of the colour

    double share() const { return static_cast<double>(different) / std::max(pixels, 1); }
};

constexpr int bound = 12; ///< levels of 255

/// Pictures of both renderers from so many directions, 1.3 to 4 radii away, before black, by even light and the sun's.
Comparison compared(
    const std::string& file, scene::HiddenSurface hidden, int views, float ambient = 1.0F, float sunlight = 0.0F) {
    settings::RunSettings wanted;
    wanted.path.terrain = "none";
    wanted.path.aircraft = {file};
    wanted.view.size_px = {240, 160};
    wanted.view.samples = 1;
    wanted.surface.hidden_surface = hidden;
    wanted.surface.aircraft_error_px = 0.25;
    wanted.surface.effects = false;
    wanted.surface.order_cache = "none";
    wanted.drawing.raster_threads = 1;
    const ui::world::World world = kept_world(wanted);
    std::vector<scene::ModelBuffers> models;
    for (const auto& model : world.scene.models) { models.push_back(model->buffers); }
    planning::Planner planner(world.scene, wanted);
    std::vector<sim::AircraftState> states(1);
    states[0].position_m.z = 3000.0;
    RandomGenerator dice(11);
    const double radius_m = world.scene.model_of(0).subject.radius_m;
    std::array<std::unique_ptr<scene::Renderer>, 2> renderers;
    for (std::size_t i = 0; i < renderers.size(); ++i) {
        wanted.drawing.renderer = i == 0 ? settings::RendererKind::Raster : settings::RendererKind::Gl;
        renderers.at(i) = ui::flight::make_renderer(wanted);
        renderers.at(i)->load_models(models);
    }
    Comparison all;
    for (int view = 0; view < views; ++view) {
        const glm::dvec3 eye_m = states[0].position_m + dice.between(1.3, 4.0) * radius_m * dice.direction();
        scene::FramePlan plan = planner.plan({scene::camera_looking_at(eye_m, states[0].position_m), states}).plan;
        const std::vector<std::uint32_t> smooth = plan.smooth;
        keep_only_aircraft(plan);
        plan.ambient = glm::vec3(ambient);
        plan.sunlight = glm::vec3(sunlight);
        plan.smooth = smooth; // triangles of refined meshes have no flat colours
        std::array<scene::Picture, 2> pictures;
        for (std::size_t i = 0; i < renderers.size(); ++i) {
            renderers.at(i)->draw(plan);
            renderers.at(i)->finish_and_read(pictures.at(i));
        }
        REQUIRE(pictures[0].rgba.size() == pictures[1].rgba.size());
        for (std::size_t at = 0; at < pictures[0].rgba.size(); at += 4) {
            int most = 0;
            int brightest = 0;
            for (std::size_t part = 0; part < 3; ++part) {
                const int one = std::to_integer<int>(std::byte{pictures[0].rgba[at + part]});
                const int other = std::to_integer<int>(std::byte{pictures[1].rgba[at + part]});
                most = std::max(most, std::abs(one - other));
                brightest = std::max({brightest, one, other});
            }
            all.pixels += brightest > 0 ? 1 : 0;
            all.different += most > bound ? 1 : 0;
        }
    }
    return all;
}

} // namespace

TEST_CASE("both renderers show the same livery, in painting order, by depth and on a refined mesh") {
    const auto [name, livery] =
        GENERATE(table<std::string, Livery>({{"stripes", stripes}, {"camouflage", camouflage}, {"titles", titles}}));
    const bool is_mesh = GENERATE(false, true);
    const std::string file =
        is_mesh ? livery_aircraft(name + "-mesh", livery, 60, 24) : livery_aircraft(name, livery, 16, 12);
    for (const auto hidden : {scene::HiddenSurface::Octant, scene::HiddenSurface::DepthBuffer}) {
        const Comparison found = compared(file, hidden, 8);
        INFO(name << (is_mesh ? ", refined" : ", polygons") << ", hidden surfaces " << static_cast<int>(hidden) << ": "
                  << found.different << " of " << found.pixels);
        CHECK(found.pixels > 8000);
        CHECK(found.share() < 0.005);
    }
}

TEST_CASE("both renderers show a pale livery as bright where it has more than full light") {
    const bool is_mesh = GENERATE(false, true);
    const std::string file =
        is_mesh ? livery_aircraft("pale-mesh", stripes, 60, 24) : livery_aircraft("pale", stripes, 16, 12);
    const Comparison found = compared(file, scene::HiddenSurface::Octant, 8, 0.5F, 0.9F);
    INFO((is_mesh ? "refined: " : "polygons: ") << found.different << " of " << found.pixels);
    CHECK(found.pixels > 8000);
    CHECK(found.share() < 0.005);
}

TEST_CASE("both renderers show the same of aircraft without pictures") {
    const std::string name = GENERATE("glass/glass.obj", "glass/glassfine.obj", "glass/canfirst.ac", "nose-x.obj");
    const Comparison found =
        compared(OCTANT_SOURCE_DIR "/tests/data/aircraft/" + name, scene::HiddenSurface::Octant, 8);
    INFO(name << ": " << found.different << " of " << found.pixels);
    CHECK(found.pixels > 2000);
    CHECK(found.share() < 0.005);
}
