#include "models/heights/height_field_export.h"
#include "models/measure/mesh_distance.h"
#include "models/polygons/obj_reader.h"
#include "models/polygons/polygon_model.h"
#include "sim/aircraft_kind.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "tests/scratch.h"
#include "ui/base/data_files.h"
#include "ui/world/scene_ground.h"
#include "ui/world/world.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

using namespace octant;
using ui::settings::RunSettings;
using ui::world::RenderDevice;

namespace {

/// Rolling ground of 26 by 26 km as a file.
std::string rolling_ground() {
    constexpr int side = 257;
    std::vector<float> heights_m;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            heights_m.push_back(
                static_cast<float>(std::lround(60.0 * std::sin(column / 9.0) + 40.0 * std::cos(row / 13.0))));
        }
    }
    const std::filesystem::path file = tests::scratch_folder() / "rolling.tif";
    models::heights::write_height_field(file, {side, side, 101.5625, heights_m});
    return file.string();
}

RunSettings over(const std::string& terrain) {
    RunSettings settings;
    settings.path.terrain = terrain;
    return settings;
}

} // namespace

TEST_CASE("a model is framed alike however its hidden surfaces are removed") {
    RunSettings settings = over("none");
    settings.path.aircraft = {OCTANT_SOURCE_DIR "/tests/fuzz/corpus/crash-bent-11.obj"};
    const ui::world::World painted = ui::world::load_world(settings);
    settings.surface.hidden_surface = visuals::scene::HiddenSurface::DepthBuffer;
    const ui::world::World by_depth = ui::world::load_world(settings);
    const auto& ordered = painted.scene.model_of(0);
    const auto& as_given = by_depth.scene.model_of(0);
    REQUIRE(ordered.polygons.vertices_m != as_given.polygons.vertices_m); // moved into planes
    CHECK(ordered.subject.radius_m == as_given.subject.radius_m);
    CHECK(ordered.subject.pilot_eye_m == as_given.subject.pilot_eye_m);
}

TEST_CASE("no point of a detailed aircraft is farther from the plain one than its row says") {
    int detailed = 0;
    for (const sim::AircraftKind& kind : sim::aircraft_kinds()) {
        if (kind.simple_type_name.empty()) { continue; }
        ++detailed;
        const auto aircraft_shape = [](std::string_view name) {
            const auto file = ui::base::aircraft_file(std::string(name));
            return models::polygons::mesh_from_polygons(models::polygons::read_obj(file));
        };
        models::measure::DistanceOptions options;
        options.tightness = 1.005;
        options.samples = 0;
        const models::measure::MeshDistance distance =
            models::measure::distance(aircraft_shape(kind.name), aircraft_shape(kind.simple_type_name), options);
        INFO(kind.name << ": " << distance.max_hausdorff_m() << " m");
        CHECK(distance.max_hausdorff_m() <= kind.simple_model_error_m);
        CHECK(distance.min_hausdorff_m() > 0.95 * kind.simple_model_error_m); // no larger than need be
    }
    CHECK(detailed >= 2);
}

TEST_CASE("a world has each model once, however many aircraft fly it, and the first one's cockpit") {
    RunSettings settings = over("none");
    settings.path.aircraft = {"500md", "f15", "500md"};
    const ui::world::World world = ui::world::load_world(settings);
    CHECK(world.scene.aircraft == std::vector<std::uint32_t>{0, 1, 0});
    CHECK(world.scene.model_of(0).polygons.name == "500md");
    CHECK(world.scene.model_of(1).polygons.name == "f15");
    CHECK(world.scene.models.size() == 2U + (world.scene.cockpit ? 1U : 0U));
    CHECK(world.flight.title == "500md straight over none");
    CHECK(ui::world::formation_of(world.scene, world.flight).framed_radius_m(1.0) > 1.0);
}

TEST_CASE("an aircraft that flies beyond its limits in formation is told of, once") {
    const auto told = [](std::vector<std::string> aircraft, const std::string& path) {
        RunSettings settings = over("none");
        settings.path.aircraft = std::move(aircraft);
        settings.path.name = path;
        std::vector<std::string> notes = ui::world::load_world(settings).notes;
        std::erase_if(
            notes, [](const std::string& note) { return note.find("beyond its limits") == std::string::npos; });
        return notes;
    };
    // 250 m/s are 486 kt; the 500MD's never-exceed speed is 152 kt.
    CHECK(told({"f15", "500md", "500md"}, "straight") ==
          std::vector<std::string>{"500md in formation is flown beyond its limits: speed in kt up to "
                                   "486 (at most 152)"});
    // A turn of 4 g at a bank of 75.5 degrees, the 500MD's limits are 2 g and 60 degrees.
    const std::vector<std::string> in_turn = told({"f15", "500md"}, "turn");
    REQUIRE(in_turn.size() == 1);
    CHECK_THAT(in_turn.front(), Catch::Contains("load factor up to 3.99") && Catch::Contains("bank"));
    // 60 m/s are 117 kt; the F-15's slowest is 80 m/s.
    CHECK(told({"500md", "f15"}, "straight") == std::vector<std::string>{
                                                    "f15 in formation is flown beyond its limits: speed in kt down to "
                                                    "117 (at least 156)"});
    for (const std::string path : {"straight", "jinking", "pop-up", "turn"}) {
        CHECK(told({"f15", "f15-detailed"}, path).empty());
        CHECK(told({"500md", "500md-detailed"}, path).empty());
    }
}

TEST_CASE("a file is no known aircraft because of its name, and says whose path it borrows") {
    const std::filesystem::path file = tests::scratch_folder() / "f15.obj";
    write_file(file, "v 0 0 -4\nv 2 0 4\nv -2 0 4\nv 0 1 4\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
    RunSettings settings = over("none");
    settings.path.aircraft = {file.string()};
    const ui::world::World world = ui::world::load_world(settings);
    CHECK(world.leader_kind == nullptr);
    CHECK_FALSE(world.scene.cockpit);
    CHECK(glm::distance(world.scene.model_of(0).subject.pilot_eye_m, sim::aircraft_kind("f15").pilot_eye_m) > 0.1);
    CHECK(std::ranges::any_of(world.notes,
        [](const std::string& note) { return note.find("flies the straight path of f15") != std::string::npos; }));
}

TEST_CASE("an OBJ file with pictures or glass flies as a mesh, which shows them") {
    const std::filesystem::path folder = tests::scratch_folder();
    const auto has_mesh = [&](std::string_view material) {
        write_file(folder / "dart.mtl", "newmtl skin\n" + std::string(material) + "\n");
        const std::filesystem::path file = folder / "dart.obj";
        write_file(file, "mtllib dart.mtl\nusemtl skin\nv 0 0 -4\nv 2 0 4\nv -2 0 4\nv 0 1 4\n"
                         "vt 0 0\nf 1/1 2/1 3/1\nf 1/1 4/1 2/1\nf 1/1 3/1 4/1\nf 2/1 4/1 3/1\n");
        RunSettings settings = over("none");
        settings.path.aircraft = {file.string()};
        return ui::world::load_world(settings).scene.model_of(0).progressive != nullptr;
    };
    write_file(folder / "skin.png", "of no use, which is noted");
    CHECK_FALSE(has_mesh("Kd 1 0 0"));
    CHECK_FALSE(has_mesh("map_Kd gone.png"));
    CHECK_FALSE(has_mesh("d 1"));
    CHECK(has_mesh("d 0.4"));
    CHECK(has_mesh("map_Kd skin.png"));
}

TEST_CASE("a path file of an unknown aircraft is refused with its line") {
    const std::filesystem::path file = tests::scratch_folder() / "kite.toml";
    write_file(file, "title = \"a kite\"\naircraft = \"kite\"\nrate_hz = 20\nsamples = 20\n"
                     "min_clearance_m = 5\n[start]\nnorth_m = 0\neast_m = 0\nheight_m = 100\n"
                     "heading_deg = 0\nspeed_mps = 100\n[[leg]]\nfly = \"straight\"\nduration_s = 1\n");
    RunSettings settings = over("none");
    settings.path.name = file.string();
    CHECK_THROWS_WITH(ui::world::load_world(settings),
        Catch::Contains("kite.toml:2: expected aircraft f15 or 500md or f15-detailed or "
                        "500md-detailed, got 'kite'"));
}

TEST_CASE("a path is laid over ground from a file with the clearance that it asks for") {
    const ui::world::World world = ui::world::load_world(over(rolling_ground()));
    CHECK(world.flight.lowest_clearance_m >= 150.0 - 1e-6);
    CHECK(world.flight.trajectory.end_s() == Approx(39.95).margin(0.06));
    CHECK(world.flight.rate_hz == 20.0);
    CHECK(world.ground_name == "rolling.tif, 257 x 257 samples, 101.6 m apart");
    CHECK_FALSE(world.scene.ground_texture);
    for (const sim::AircraftState& sample : world.flight.trajectory.samples()) {
        const auto ground_m = world.scene.ground->height_at(sample.position_m.x, sample.position_m.y);
        REQUIRE(ground_m);
        CHECK(sample.position_m.z - *ground_m > 140.0);
    }
}

TEST_CASE("aircraft with paths of their own begin beside the first one, by its clock") {
    RunSettings settings = over(rolling_ground());
    settings.path.aircraft = {"f15=pop-up", "500md=turn@2s", "f15", "f15=jinking"};
    const ui::world::World world = ui::world::load_world(settings);
    const ui::world::Flight& flight = world.flight;
    CHECK(flight.title == "f15 pop-up over rolling");
    REQUIRE(flight.other_trajectories.size() == 2);
    const sim::Trajectory& turn = flight.other_trajectories.at(1);
    const sim::Trajectory& jinking = flight.other_trajectories.at(3);
    CHECK(turn.start_s() == 2.0);
    CHECK(jinking.start_s() == 0.0);
    const auto start = flight.trajectory.samples().front();
    const glm::dvec3 beside_m = jinking.samples().front().position_m - start.position_m;
    CHECK(glm::length(glm::dvec2(beside_m)) > 10.0);
    CHECK(glm::length(glm::dvec2(beside_m)) < 100.0);

    const ui::world::Formation formation = ui::world::formation_of(world.scene, flight);
    std::vector<sim::AircraftState> states(4);
    ui::world::formation_states(flight, formation, start, 0.0, states);
    CHECK_FALSE(states[1].is_present);
    CHECK(states[2].position_m == formation.wingman_state(start, 1).position_m);
    CHECK(states[3].position_m == jinking.samples().front().position_m);
    ui::world::formation_states(flight, formation, start, 5.0, states);
    CHECK(states[1].position_m == turn.state_at(5.0).position_m);
    CHECK(states[1].time_s == start.time_s);

    settings.path.aircraft = {"f15=turn@2s"};
    CHECK_THROWS_WITH(ui::world::load_world(settings), Catch::Contains("the first one to begin at 0 s"));
    settings.path.aircraft = {"f15", "500md=no-such-path"};
    CHECK_THROWS_AS(ui::world::load_world(settings), Error);
}

TEST_CASE("a recording's aircraft fly as they flew beside each other, each as what its type says") {
    const std::filesystem::path file = tests::scratch_folder() / "two.acmi";
    write_file(file, "FileType=text/acmi/tacview\nFileVersion=2.2\n#5\n1,T=8|47|900,Type=Air+FixedWing\n"
                     "2,T=8|47.001|950,Type=Air+Rotorcraft\n3,T=8|47|0,Type=Sea+Watercraft\n#6\n"
                     "1,T=8|47.001|900\n2,T=8|47.0012|950\n#9\n1,T=8|47.004|900\n");
    RunSettings settings = over(rolling_ground());
    settings.path.name = file.string();
    settings.path.heading_deg = 90.0;
    const ui::world::World world = ui::world::load_world(settings);
    CHECK(world.scene.aircraft.size() == 2);
    CHECK(world.scene.model_of(1).polygons.name == "500md");
    REQUIRE(world.flight.other_trajectories.size() == 1);
    const sim::AircraftState& first = world.flight.trajectory.samples().front();
    const sim::AircraftState& other = world.flight.other_trajectories.at(1).samples().front();
    const glm::dvec3 apart_m = other.position_m - first.position_m;
    CHECK(apart_m.x == Approx(111.2).margin(0.1)); // north, turned to the east
    CHECK(apart_m.y == Approx(0.0).margin(1e-6));
    CHECK(apart_m.z == Approx(50.0));
    CHECK(world.flight.lowest_clearance_m == Approx(50.0));
}

TEST_CASE("a recording that leaves the map is refused with its name") {
    const std::filesystem::path file = tests::scratch_folder() / "far.acmi";
    write_file(file, "FileType=text/acmi/tacview\nFileVersion=2.2\n#0\n1,T=8|47|900\n#900\n1,T=8|49|900\n");
    RunSettings settings = over(rolling_ground());
    settings.path.name = file.string();
    CHECK_THROWS_WITH(
        ui::world::load_world(settings), Catch::Contains("far.acmi: path leaves the map at every heading") &&
                                             Catch::EndsWith("km north of its middle, and --terrain none has no end"));
}

TEST_CASE("what cannot be loaded is said before anything is flown") {
    CHECK_THROWS_AS(ui::world::load_world(over("no-such-ground.tif")), Error);
    RunSettings settings = over("none");
    settings.path.aircraft = {"no-such-aircraft"};
    CHECK_THROWS_AS(ui::world::load_world(settings), Error);
    RunSettings off_the_map = over(rolling_ground());
    off_the_map.path.place = "12000,12000";
    CHECK_THROWS_AS(ui::world::load_world(off_the_map), Error);
}

TEST_CASE("a ground is loaded with what is to be said of it, and textured where that is asked") {
    RunSettings settings = over(rolling_ground());
    const ui::world::SceneGround bare = ui::world::load_scene_ground(settings, RenderDevice::Cpu);
    CHECK(bare.texture == nullptr);
    CHECK(bare.notes.empty());
    CHECK_FALSE(bare.place);
    settings.air.ground_shading = visuals::scene::GroundShading::Texture;
    const ui::world::SceneGround textured = ui::world::load_scene_ground(settings, RenderDevice::Cpu);
    REQUIRE(textured.texture);
    CHECK(textured.texture->albedo.width == 257);
    CHECK(textured.name == bare.name + ", textured");
    CHECK(textured.ground->height_at(100.0, -300.0) == bare.ground->height_at(100.0, -300.0));
}

TEST_CASE("pictures are taken at the path's samples or at a rate, as long as is asked for") {
    RunSettings settings = over("none");
    const ui::world::Flight flight = ui::world::load_world(settings).flight;
    settings.time.seconds = 2.0;
    CHECK(ui::world::picture_times_of(settings, flight).times_s.size() == 121);
    settings.time.frame_per_sample = true;
    const ui::world::PictureTimes by_sample = ui::world::picture_times_of(settings, flight);
    CHECK(by_sample.times_s.size() == 41);
    CHECK(by_sample.rate_hz == 20.0);
    settings.time.frames = 7;
    CHECK(ui::world::picture_times_of(settings, flight).times_s.size() == 7);
    settings.time.start_s = 1000.0;
    CHECK_THROWS_AS(ui::world::picture_times_of(settings, flight), Error);
}

TEST_CASE("the tower of a known flight stands by it; a live one's says that it knows no flight") {
    RunSettings settings = over(rolling_ground());
    settings.view.kind = octant::visuals::scene::View::Tower;
    const auto says_so = [](const ui::world::World& world) {
        return std::ranges::any_of(world.notes, [](const std::string& note) { return note.starts_with("tower: "); });
    };
    const ui::world::World known = ui::world::load_world(settings);
    CHECK(!says_so(known));
    double nearest_m = 1e9;
    for (const sim::AircraftState& state : known.flight.trajectory.samples()) {
        nearest_m = std::min(nearest_m, glm::distance(state.position_m, known.points.tower.eye_m));
    }
    CHECK(nearest_m < 3000.0);
    settings.path.name = std::string(ui::settings::live_path);
    const ui::world::World live = ui::world::load_world(settings);
    CHECK(says_so(live));
    CHECK(live.scene.path == nullptr);
    REQUIRE(known.scene.path != nullptr);
    CHECK(known.scene.path->points.size() > 10);
}

TEST_CASE("clouds that would lie in the ground are refused with its height") {
    RunSettings settings = over(rolling_ground());
    settings.air.clouds = 0.4;
    settings.air.cloud_height_m = 101.0;
    CHECK_NOTHROW(ui::world::load_world(settings));
    settings.air.cloud_height_m = 99.0;
    CHECK_THROWS_WITH(
        ui::world::load_world(settings), "--cloud-height: expected more than the highest ground, 100.0 m, got 99");
}
