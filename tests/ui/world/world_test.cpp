#include "models/heights/height_field_export.h"
#include "models/measure/mesh_distance.h"
#include "models/polygons/obj_reader.h"
#include "models/polygons/polygon_model.h"
#include "sim/aircraft_kind.h"
#include "sim/base/axes.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "tests/scratch.h"
#include "ui/base/data_files.h"
#include "ui/settings/settings.h"
#include "ui/world/scene_ground.h"
#include "ui/world/world.h"
#include "visuals/landscape/ground.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/tower.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

using namespace octant;
using ui::settings::RunSettings;
using ui::world::load_world;
using ui::world::RenderDevice;
using ui::world::World;

namespace {

/// Rolling ground of 26 by 26 km as a file, -100 to 100 m high and lifted.
std::string rolling_ground(const std::string& name = "rolling.tif", double lift_m = 0.0) {
    constexpr int side = 257;
    std::vector<float> heights_m;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            heights_m.push_back(
                static_cast<float>(lift_m + std::round(60.0 * std::sin(column / 9.0) + 40.0 * std::cos(row / 13.0))));
        }
    }
    const std::filesystem::path file = tests::scratch_folder() / name;
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
    const World painted = load_world(settings);
    settings.surface.hidden_surface = visuals::scene::HiddenSurface::DepthBuffer;
    const World by_depth = load_world(settings);
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
    const World world = load_world(settings);
    CHECK(world.scene.aircraft == std::vector<std::uint32_t>{0, 1, 0});
    CHECK(world.scene.model_of(0).polygons.name == "500md");
    CHECK(world.scene.model_of(1).polygons.name == "f15");
    CHECK(world.scene.models.size() == 2U + (world.scene.cockpit ? 1U : 0U));
    CHECK(world.flight.title == "500md straight over none");
    CHECK(ui::world::formation_of(world.scene, world.flight).framed_radius_m(1.0) > 1.0);
}

TEST_CASE("an aircraft that flies beyond its limits in formation is noted, once") {
    const auto notes_of = [](std::vector<std::string> aircraft, const std::string& path) {
        RunSettings settings = over("none");
        settings.path.aircraft = std::move(aircraft);
        settings.path.name = path;
        std::vector<std::string> notes = load_world(settings).notes;
        std::erase_if(
            notes, [](const std::string& note) { return note.find("beyond its limits") == std::string::npos; });
        return notes;
    };
    // 250 m/s are 486 kt; the 500MD's never-exceed speed is 152 kt.
    CHECK(notes_of({"f15", "500md", "500md"}, "straight") ==
          std::vector<std::string>{"500md in formation is flown beyond its limits: speed in kt up to "
                                   "486 (at most 152)"});
    // A turn of 4 g at a bank of 75.5 degrees, the 500MD's limits are 2 g and 60 degrees.
    const std::vector<std::string> in_turn = notes_of({"f15", "500md"}, "turn");
    REQUIRE(in_turn.size() == 1);
    CHECK_THAT(in_turn.front(), Catch::Contains("load factor up to 3.99") && Catch::Contains("bank"));
    // 60 m/s are 117 kt; the F-15's slowest is 80 m/s.
    CHECK(notes_of({"500md", "f15"}, "straight") ==
          std::vector<std::string>{"f15 in formation is flown beyond its limits: speed in kt down to "
                                   "117 (at least 156)"});
    for (const std::string path : {"straight", "jinking", "pop-up", "turn"}) {
        CHECK(notes_of({"f15", "f15-detailed"}, path).empty());
        CHECK(notes_of({"500md", "500md-detailed"}, path).empty());
    }
}

TEST_CASE("a file is no known aircraft because of its name, and says whose path it borrows") {
    const std::filesystem::path file = tests::scratch_folder() / "f15.obj";
    write_file(file, "v 0 0 -4\nv 2 0 4\nv -2 0 4\nv 0 1 4\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
    RunSettings settings = over("none");
    settings.path.aircraft = {file.string()};
    const World world = load_world(settings);
    CHECK(world.leader_kind == nullptr);
    CHECK_FALSE(world.scene.cockpit);
    CHECK(glm::distance(world.scene.model_of(0).subject.pilot_eye_m, sim::aircraft_kind("f15").pilot_eye_m) > 0.1);
    CHECK(std::ranges::any_of(world.notes,
        [](const std::string& note) { return note.find("flies the straight path of f15") != std::string::npos; }));
}

TEST_CASE("an OBJ file flies as polygons, with glass too, and as a mesh where pictures become colours of vertices") {
    const std::filesystem::path folder = tests::scratch_folder();
    const auto has_mesh = [&](std::string_view material, bool textures = true) {
        write_file(folder / "dart.mtl", "newmtl skin\n" + std::string(material) + "\n");
        const std::filesystem::path file = folder / "dart.obj";
        write_file(file, "mtllib dart.mtl\nusemtl skin\nv 0 0 -4\nv 2 0 4\nv -2 0 4\nv 0 1 4\n"
                         "vt 0 0\nf 1/1 2/1 3/1\nf 1/1 4/1 2/1\nf 1/1 3/1 4/1\nf 2/1 4/1 3/1\n");
        RunSettings settings = over("none");
        settings.path.aircraft = {file.string()};
        settings.surface.textures = textures;
        return load_world(settings).scene.model_of(0).progressive != nullptr;
    };
    write_file(folder / "skin.png", "of no use, which is noted");
    CHECK_FALSE(has_mesh("Kd 1 0 0"));
    CHECK_FALSE(has_mesh("map_Kd gone.png"));
    CHECK_FALSE(has_mesh("d 1"));
    CHECK_FALSE(has_mesh("d 0.4"));
    CHECK_FALSE(has_mesh("map_Kd skin.png"));
    CHECK(has_mesh("map_Kd skin.png", false));
}

TEST_CASE("a path file of an unknown aircraft is refused with its line") {
    const std::filesystem::path file = tests::scratch_folder() / "kite.toml";
    write_file(file, "title = \"a kite\"\naircraft = \"kite\"\nrate_hz = 20\nsamples = 20\n"
                     "min_clearance_m = 5\n[start]\nnorth_m = 0\neast_m = 0\nheight_m = 100\n"
                     "heading_deg = 0\nspeed_mps = 100\n[[leg]]\nfly = \"straight\"\nduration_s = 1\n");
    RunSettings settings = over("none");
    settings.path.name = file.string();
    CHECK_THROWS_WITH(
        load_world(settings), Catch::Contains("kite.toml:2: expected aircraft f15 or 500md or f15-detailed or "
                                              "500md-detailed, got 'kite'"));
}

TEST_CASE("a path is laid over ground from a file with the clearance that it asks for") {
    const World world = load_world(over(rolling_ground()));
    CHECK(world.flight.lowest_clearance_m >= 150.0 - 1e-6);
    CHECK(world.flight.trajectory.end_s() == Approx(39.95).margin(0.06));
    CHECK(world.flight.rate_hz == 20.0);
    CHECK(world.ground.name == "rolling.tif, 257 x 257 samples, 101.6 m apart");
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
    const World world = load_world(settings);
    const ui::world::PlacedFlight& flight = world.flight;
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
    CHECK_THROWS_WITH(load_world(settings), Catch::Contains("the first one to begin at 0 s"));
    settings.path.aircraft = {"f15", "500md=no-such-path"};
    CHECK_THROWS_AS(load_world(settings), Error);
}

TEST_CASE("aircraft of an ACMI recording fly as they flew beside each other, each as what its type says") {
    const std::filesystem::path file = tests::scratch_folder() / "two.acmi";
    write_file(file, "FileType=text/acmi/tacview\nFileVersion=2.2\n#5\n1,T=8|47|900,Type=Air+FixedWing\n"
                     "2,T=8|47.001|950,Type=Air+Rotorcraft\n3,T=8|47|0,Type=Sea+Watercraft\n#6\n"
                     "1,T=8|47.001|900\n2,T=8|47.0012|950\n#9\n1,T=8|47.004|900\n");
    RunSettings settings = over(rolling_ground());
    settings.path.name = file.string();
    settings.path.heading_deg = 90.0;
    const World world = load_world(settings);
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

TEST_CASE("aircraft of one log and of another file fly on one clock of UTC, the asked-for one first") {
    const std::string tracks = std::string(OCTANT_SOURCE_DIR) + "/tests/flightpaths/tracks/";
    const std::filesystem::path file = tests::scratch_folder() / "later.gpx";
    // 1538840575, the first second of the log, is 2018-10-06 15:42:55.
    write_file(file, "<gpx><trk><name>LATE</name><trkseg>"
                     "<trkpt lat='49.31' lon='-123'><ele>3000</ele><time>2018-10-06T15:43:25Z</time></trkpt>"
                     "<trkpt lat='49.32' lon='-123'><ele>3000</ele><time>2018-10-06T15:43:45Z</time></trkpt>"
                     "</trkseg></trk></gpx>");
    RunSettings settings = over("none");
    settings.path.name = tracks + "opensky-two-b.csv";
    settings.path.follow = "two";
    settings.path.tracks = {file.string()};
    settings.path.track_offset_s = 2.0;
    const World world = load_world(settings);
    const ui::world::PlacedFlight& flight = world.flight;
    CHECK(flight.name == "TWO");
    REQUIRE(world.scene.aircraft.size() == 3);
    REQUIRE(flight.other_trajectories.size() == 2);
    CHECK(flight.other_names.at(1) == "ONE");
    CHECK(flight.other_names.at(2) == "LATE");
    CHECK(flight.other_trajectories.at(2).start_s() == Approx(32.0));
    // 49.31 N is 556 m north of the first place of TWO, 49.305 N, 123 W.
    const glm::dvec3 apart_m =
        flight.other_trajectories.at(2).samples().front().position_m - flight.trajectory.samples().front().position_m;
    CHECK(apart_m.x == Approx(0.0).margin(1.0));
    CHECK(apart_m.y == Approx(556.0).margin(2.0));

    settings.path.follow = "nobody";
    CHECK_THROWS_WITH(load_world(settings), Catch::Contains("--follow: expected one of the 2 aircraft (ONE, TWO)"));
    settings.path.follow = {};
    settings.path.tracks = {tracks + "ballistic-zoom.csv"};
    CHECK_THROWS_WITH(load_world(settings), Catch::Contains("--track: expected recordings with latitudes"));
    settings.path.name = "turn";
    settings.path.follow = "ONE";
    CHECK_THROWS_WITH(
        load_world(settings), Catch::Contains("--follow: expected a recorded track, got 'f15-turn.toml'"));
}

TEST_CASE("an ACMI recording that leaves the map is refused with its name") {
    const std::filesystem::path file = tests::scratch_folder() / "far.acmi";
    write_file(file, "FileType=text/acmi/tacview\nFileVersion=2.2\n#0\n1,T=8|47|900\n#900\n1,T=8|49|900\n");
    RunSettings settings = over(rolling_ground());
    settings.path.name = file.string();
    CHECK_THROWS_WITH(
        load_world(settings), Catch::Contains("far.acmi: path leaves the map at every heading") &&
                                  Catch::EndsWith("km north of its middle, and --terrain none has no end"));
}

TEST_CASE("what cannot be loaded is said before anything is flown") {
    CHECK_THROWS_AS(load_world(over("no-such-ground.tif")), Error);
    RunSettings settings = over("none");
    settings.path.aircraft = {"no-such-aircraft"};
    CHECK_THROWS_AS(load_world(settings), Error);
    RunSettings off_the_map = over(rolling_ground());
    off_the_map.path.place = "12000,12000";
    CHECK_THROWS_AS(load_world(off_the_map), Error);
}

TEST_CASE("a ground is loaded with what is to be said of it, and textured where that is asked") {
    RunSettings settings = over(rolling_ground());
    const ui::world::SceneGround bare = ui::world::load_scene_ground(settings, RenderDevice::Cpu);
    CHECK(bare.texture == nullptr);
    CHECK_FALSE(bare.info.place);
    REQUIRE(bare.notes.size() == 1);
    CHECK_THAT(bare.notes[0], Catch::Contains("place on the earth is not known, so it is shown as moist, temperate "
                                              "land; --ground-look palette=arid shows a desert"));
    settings.air.palette = visuals::scene::Palette::Temperate;
    CHECK(ui::world::load_scene_ground(settings, RenderDevice::Cpu).notes.empty());
    settings.air.palette.reset();
    settings.air.ground_shading = visuals::scene::GroundShading::Texture;
    const ui::world::SceneGround textured = ui::world::load_scene_ground(settings, RenderDevice::Cpu);
    REQUIRE(textured.texture);
    CHECK(textured.texture->albedo.width == 257);
    CHECK(textured.info.name == bare.info.name + ", textured");
    CHECK(textured.ground->height_at(100.0, -300.0) == bare.ground->height_at(100.0, -300.0));
}

TEST_CASE("pictures are taken at the path's samples or at a rate, as long as is asked for") {
    RunSettings settings = over("none");
    const ui::world::PlacedFlight flight = load_world(settings).flight;
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
    const auto says_so = [](const World& world) {
        return std::ranges::any_of(world.notes, [](const std::string& note) { return note.starts_with("tower: "); });
    };
    const World known = load_world(settings);
    CHECK(!says_so(known));
    double nearest_m = 1e9;
    for (const sim::AircraftState& state : known.flight.trajectory.samples()) {
        nearest_m = std::min(nearest_m, glm::distance(state.position_m, known.points.tower.eye_m));
    }
    CHECK(nearest_m < 3000.0);
    settings.path.name = std::string(ui::settings::live_path);
    const World live = load_world(settings);
    CHECK(says_so(live));
    CHECK(live.scene.path == nullptr);
    REQUIRE(known.scene.path != nullptr);
    CHECK(known.scene.path->points.size() > 10);
}

TEST_CASE("clouds that would lie in the ground are refused with its height") {
    RunSettings settings = over(rolling_ground());
    settings.air.clouds = 0.4;
    settings.air.cloud_height_m = 101.0;
    CHECK_NOTHROW(load_world(settings));
    settings.air.cloud_height_m = 99.0;
    CHECK_THROWS_WITH(load_world(settings), "--cloud-height: expected more than the highest ground, 100.0 m, got 99");
}

namespace {

/// Least distance between any two aircraft of a formation, metres.
double min_distance_m(int aircraft, double radius_m) {
    const ui::world::Formation formation(aircraft, radius_m);
    sim::AircraftState leader;
    leader.body_to_world = body_to_world_from_euler({0.7, 0.2, 0.4});
    std::vector<glm::dvec3> places_m = {leader.position_m};
    double min_m = std::numeric_limits<double>::infinity();
    for (int number = 1; number < aircraft; ++number) {
        const glm::dvec3 place_m = formation.wingman_state(leader, number).position_m;
        for (const glm::dvec3& other_m : places_m) { min_m = std::min(min_m, glm::distance(place_m, other_m)); }
        places_m.push_back(place_m);
    }
    return min_m;
}

} // namespace

TEST_CASE("aircraft of a formation keep apart, however many there are") {
    for (const int aircraft : {2, 3, 9, 10, 16, 100, 1000}) {
        INFO(aircraft << " aircraft");
        CHECK(min_distance_m(aircraft, 10.0) >= 17.0 - 1e-9);
    }
}

TEST_CASE("no aircraft of a formation flies below its leader") {
    const ui::world::Formation formation(1000, 10.0);
    const sim::AircraftState leader;
    for (int number = 1; number < 1000; ++number) {
        REQUIRE(formation.wingman_state(leader, number).position_m.z >= leader.position_m.z);
    }
}

// Worlds that share what is loaded of the same inputs.

namespace {

const std::string corners = "v 0 0 -4\nv 2 0 4\nv -2 0 4\nv 0 1 4\n";

std::filesystem::path wedge(const std::string& head) {
    std::filesystem::path shape = tests::scratch_folder() / "wedge.obj";
    write_file(shape, head + corners + "f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
    return shape;
}

/// As if the file had been written two seconds from now.
void age(const std::filesystem::path& file) {
    std::filesystem::last_write_time(file, std::filesystem::last_write_time(file) + std::chrono::seconds(2));
}

World shared_world(const RunSettings& settings, const World& other) {
    return load_world(settings, RenderDevice::Cpu, &other);
}

} // namespace

TEST_CASE("a world shares with another what is loaded of the same inputs, and loads the rest") {
    const std::filesystem::path shape = wedge("");
    RunSettings settings;
    settings.path.terrain = rolling_ground();
    settings.path.aircraft = {shape.string()};
    const World first = load_world(settings);

    settings.path.name = "turn";
    const World turn = shared_world(settings, first);
    CHECK(turn.scene.ground == first.scene.ground);
    CHECK(turn.scene.models.front() == first.scene.models.front());
    CHECK(turn.ground.name == first.ground.name);

    RunSettings elsewhere = settings;
    elsewhere.path.terrain = "none";
    const World over_none = shared_world(elsewhere, first);
    CHECK(over_none.scene.ground != first.scene.ground);
    CHECK(over_none.scene.models.front() == first.scene.models.front());
    CHECK(shared_world(settings, over_none).scene.ground != over_none.scene.ground);

    RunSettings textured = settings;
    textured.air.ground_shading = visuals::scene::GroundShading::Texture;
    CHECK(shared_world(textured, first).scene.ground_texture);

    settings.path.axes = "back,up,left";
    CHECK(shared_world(settings, first).scene.models.front() != first.scene.models.front());
    settings.path.axes = "auto";
    settings.path.terrain_height_scale = 2.0;
    CHECK(shared_world(settings, first).scene.ground != first.scene.ground);
    settings.path.terrain_height_scale.reset();

    write_file(shape, corners + "f 1 2 3\n");
    age(shape);
    age(settings.path.terrain);
    const World rewritten = shared_world(settings, first);
    CHECK(rewritten.scene.model_of(0).polygons.polygons.size() == 1);
    CHECK(rewritten.scene.ground != first.scene.ground);
}

TEST_CASE("what a shared world's files name is loaded anew once it is written anew") {
    const std::filesystem::path materials = tests::scratch_folder() / "wedge.mtl";
    write_file(materials, "newmtl one\nKd 1 0 0\n");
    const std::filesystem::path shape = wedge("mtllib wedge.mtl\nusemtl one\n");
    const std::filesystem::path heights = rolling_ground("behind.tif");
    const std::filesystem::path map = tests::scratch_folder() / "map.vrt";
    write_file(map, "<VRTDataset rasterXSize=\"257\" rasterYSize=\"257\"><GeoTransform>0, 101.5625, 0, 0, 0, "
                    "-101.5625</GeoTransform><VRTRasterBand dataType=\"Float32\" band=\"1\"><SimpleSource>"
                    "<SourceFilename relativeToVRT=\"1\">behind.tif</SourceFilename><SourceBand>1</SourceBand>"
                    "</SimpleSource></VRTRasterBand></VRTDataset>\n");
    RunSettings settings;
    settings.path.terrain = map.string();
    settings.path.aircraft = {shape.string()};
    const World first = load_world(settings);
    const World same = shared_world(settings, first);
    CHECK(same.scene.ground == first.scene.ground);
    CHECK(same.scene.models.front() == first.scene.models.front());

    write_file(materials, "newmtl one\nKd 0 0 1\n");
    age(materials);
    rolling_ground("behind.tif", 500.0);
    age(heights);
    const World anew = shared_world(settings, first);
    CHECK(anew.scene.models.front() != first.scene.models.front());
    CHECK(*anew.scene.ground->height_at(0.0, 0.0) > *first.scene.ground->height_at(0.0, 0.0) + 400.0);
}

// What the tower's pictures show over whole flights, by rays of this test's own.

namespace octant {

namespace {

/// How far a ray goes until ground stops it. Beyond the map the ground goes on at its border's height.
std::optional<double> ground_along(
    const visuals::landscape::Ground& ground, const glm::dvec3& from_m, const glm::dvec3& way, double reach_m) {
    double height_m = 0.0;
    for (double along_m = 4.0; along_m < reach_m; along_m += std::max(3.0, 0.01 * along_m)) {
        const glm::dvec3 at_m = from_m + along_m * way;
        height_m = ground.height_at(at_m.x, at_m.y).value_or(height_m);
        if (at_m.z < height_m) { return along_m; }
    }
    return std::nullopt;
}

/// The share of a picture that shows sky, by seven by five rays.
double sky_share(const visuals::landscape::Ground& ground, const visuals::scene::Camera& camera) {
    constexpr double far_m = 30000.0;
    const double half = std::tan(0.5 * camera.vertical_fov_rad);
    int sky = 0;
    int rays = 0;
    for (int column = -3; column <= 3; ++column) {
        for (int row = -2; row <= 2; ++row, ++rays) {
            const glm::dvec3 way = camera.view_to_world *
                                   glm::normalize(glm::dvec3(column / 3.5 * half * 16.0 / 9.0, row / 2.5 * half, -1.0));
            const bool is_ground = way.z < -0.003 || ground_along(ground, camera.eye_m, way, far_m).has_value();
            sky += is_ground ? 0 : 1;
        }
    }
    return static_cast<double>(sky) / rays;
}

/// Counts of a flight's pictures, one a second.
struct Pictures {
    int all = 0;
    int hidden = 0; ///< ground stands before the aircraft
    int small = 0;  ///< the sphere around it fills less than 0.15 of the picture's height
    int relief = 0; ///< a tenth of the picture is sky, a tenth ground
    int no_sky = 0;
};

void count(const char* path, const char* aircraft, const char* terrain, Pictures& pictures) {
    ui::settings::RunSettings settings;
    settings.path.name = path;
    settings.path.aircraft = {aircraft};
    settings.path.terrain = terrain;
    settings.view.kind = visuals::scene::View::Tower;
    const World world = load_world(settings);
    const visuals::landscape::Ground& ground = *world.scene.ground;
    const double radius_m = world.scene.model_of(0).subject.radius_m;
    const sim::Trajectory& flight = world.flight.trajectory;
    for (double time_s = flight.start_s(); time_s < flight.end_s(); time_s += 1.0) {
        const glm::dvec3 at_m = flight.state_at(time_s).position_m;
        const visuals::scene::Camera camera = visuals::scene::tower_camera(world.points.tower, at_m, radius_m);
        const double distance_m = glm::distance(camera.eye_m, at_m);
        const glm::dvec3 way = (at_m - camera.eye_m) / distance_m;
        const double size = radius_m / (distance_m * std::tan(0.5 * camera.vertical_fov_rad));
        const double sky = sky_share(ground, camera);
        ++pictures.all;
        pictures.hidden += ground_along(ground, camera.eye_m, way, distance_m - radius_m) ? 1 : 0;
        pictures.small += size < 0.15 ? 1 : 0;
        pictures.relief += sky >= 0.1 && sky <= 0.9 ? 1 : 0;
        pictures.no_sky += sky == 0.0 ? 1 : 0;
    }
}

} // namespace

TEST_CASE("over whole flights the tower sees the aircraft, large, and mostly relief and sky") {
    Pictures pictures;
    for (const char* path : {"straight", "jinking", "pop-up", "turn"}) {
        count(path, "f15", "hills", pictures);
        count(path, "500md", "canyon", pictures);
    }
    REQUIRE(pictures.all > 200);
    INFO(pictures.small << " small, " << pictures.relief << " before relief and sky, " << pictures.no_sky
                        << " without sky, of " << pictures.all);
    CHECK(pictures.hidden == 0);
    CHECK(pictures.small < 0.05 * pictures.all);
    CHECK(pictures.relief > 0.7 * pictures.all);
    CHECK(pictures.no_sky < 0.1 * pictures.all);
}

} // namespace octant
