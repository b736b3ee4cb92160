#include "sim/base/output_file.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_checks.h"
#include "tests/ui/commands/command_line.h"
#include "tests/ui/flight/small_ground.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <unistd.h>

using namespace octant;
using octant::tests::run_octant;

namespace {

std::filesystem::path folder() {
    static const auto made = tests::empty_folder("bad-input");
    return made;
}

std::string file_with(const std::string& name, std::string_view bytes) {
    write_file(folder() / name, bytes);
    return (folder() / name).string();
}

/// Flies with each line's options into a folder, over small ground where they name none, and expects one line, exit
/// code 2 and no recording.
void check_flights_refused(const tests::Refusals& refusals) {
    const auto out = folder() / "out";
    std::filesystem::remove_all(out);
    for (auto [line, expected] : refusals) {
        const bool has_ground =
            line.find("--terrain ") != std::string::npos || line.find("--settings ") != std::string::npos;
        line += has_ground ? "" : " --terrain " + tests::small_ground();
        tests::check_refusals("fly", {{line + " --frames 2 --record " + out.string(), expected}});
        CHECK_FALSE(std::filesystem::exists(out));
    }
}

constexpr std::string_view good_path = R"(aircraft = "f15"
title = "test"
rate_hz = 20
samples = 40
min_clearance_m = 100
[start]
north_m = 0
east_m = 0
height_m = 200
heading_deg = 0
speed_mps = 200
[[leg]]
fly = "straight"
duration_s = 2
)";

std::string changed(std::string_view text, std::string_view from, std::string_view to) {
    std::string result(text);
    const std::size_t at = result.find(from);
    REQUIRE(at != std::string::npos);
    return result.replace(at, from.size(), to);
}

} // namespace

TEST_CASE("the path that the wrong ones are made from is good") {
    const tests::ProgramRun run =
        run_octant({"fly", file_with("good.toml", good_path), "--frames", "2", "--size", "64x36", "--quiet"});
    INFO(run.err);
    CHECK(run.exit_code == 0);
}

TEST_CASE("a wrong path is refused in one line with exit code 2") {
    check_flights_refused({{"somewhere", "expected straight, jinking, pop-up, turn"},
        {"/nowhere/path.toml", "/nowhere/path.toml: expected a file, found none"},
        {folder().string() + "/", "expected"}, {file_with("empty.toml", ""), "empty.toml"},
        {file_with("binary.toml", std::string_view("\0\1\2", 3)), "expected text, got binary data"},
        {file_with("truncated.toml", good_path.substr(0, good_path.size() / 2)), "truncated.toml"},
        {file_with("nan.toml", changed(good_path, "speed_mps = 200", "speed_mps = nan")), "nan.toml:11:"},
        {file_with("negative.toml", changed(good_path, "rate_hz = 20", "rate_hz = -20")), "negative.toml:3:"},
        {file_with("huge.toml", changed(good_path, "samples = 40", "samples = 2000000000")), "huge.toml:4:"}});
    const std::string asks = file_with("asks.toml", changed(good_path, "fly = \"straight\"\nduration_s = 2",
                                                        "fly = \"pull\"\nload_factor_g = 9\nto_climb_deg = 20"));
    check_flights_refused({{asks, "asks.toml:12: expected a load factor of at most 7.33 for f15, got 9"},
        {file_with("track.csv", "t_s,north_m\n0,1\n"), "track.csv:1:"}});
}

TEST_CASE("a drape that cannot be laid over the ground is refused in one line with exit code 2") {
    check_flights_refused({{"straight --drape /nowhere/map.png", "/nowhere/map.png: expected a file, found none"},
        {"straight --drape " + file_with("words.png", "words"), "words.png: expected an image that GDAL can read"},
        {"straight --drape map.png --ground-look shading=vertex",
            "--drape: expected --ground-look shading=texture or auto beside it, got vertex"},
        {"straight --drape map.png --terrain background60", "--drape: expected ground with heights"},
        {"straight --ground-look shading=texture --terrain none",
            "--ground-look shading=texture: expected ground with heights"}});
}

TEST_CASE("a coordinate system that is none is refused, whether or not the ground needs one") {
    const std::string expected = "--terrain-system: expected a coordinate system such as EPSG:4326, got 'EPSG:99999'";
    check_flights_refused({{"straight --terrain hills --terrain-system EPSG:99999", expected},
        {"straight --terrain none --terrain-system EPSG:99999", expected}});
}

TEST_CASE("clouds in the ground, and what is seen through beside a depth buffer, are refused") {
    check_flights_refused(
        {{"straight --clouds 0.4 --cloud-height 10", "--cloud-height: expected more than the highest ground, "},
            {"straight --clouds 1.5", "clouds"},
            {"straight --show path-ribbon --hidden-surface depth-buffer",
                "--show path-ribbon: expected --hidden-surface octant or back-face beside it, got depth-buffer"}});
}

TEST_CASE("a wrong aircraft is refused in one line with exit code 2") {
    check_flights_refused(
        {{"straight --aircraft f16",
             "aircraft: expected f15, 500md, f15-detailed, 500md-detailed, concave or an OBJ file, got 'f16'"},
            {"straight --aircraft /nowhere/a.obj", "/nowhere/a.obj: expected a file, found none"},
            {"straight --aircraft " + file_with("empty.obj", ""), "empty.obj"},
            {"straight --aircraft " + file_with("bin.obj", std::string_view("v 0\0", 4)), "binary"},
            {"straight --aircraft " + file_with("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"), "index.obj:4:"},
            {"straight --aircraft " + file_with("nan.obj", "v 0 0 nan\n"), "nan.obj:1:"},
            {"straight --aircraft " + file_with("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"),
                "line.obj: expected at least one polygon with an area, got none"}});
}

TEST_CASE("a wrong terrain is refused in one line with exit code 2") {
    check_flights_refused(
        {{"straight --terrain mountains", "terrain: expected hills, canyon or a file, got 'mountains'"},
            {"straight --terrain /nowhere/map.tif", "/nowhere/map.tif"},
            {"straight --terrain " + file_with("empty.tif", ""), "empty.tif"},
            {"straight --terrain " + file_with("text.tif", "no map at all"), "text.tif"},
            {"straight --terrain " + file_with("small.pgm", "P2\n3 3\n255\n0 0 0\n0 0 0\n0 0 0\n"), "map"},
            {"straight --terrain " + tests::empty_folder("no-maps").string(),
                "no-maps: expected maps of heights that GDAL reads, found none"}});
}

TEST_CASE("wrong settings and options are refused in one line with exit code 2") {
    check_flights_refused({{"straight --settings /nowhere/run.json", "/nowhere/run.json: expected a file, found none"},
        {"straight --settings " + file_with("cut.json", "{\n\"size\": \"64x"), "cut.json:2:"},
        {"straight --settings " + file_with("key.json", "{\n\"sise\": \"64x36\"\n}"),
            "key.json:2: expected the name of a setting, got 'sise'"},
        {"straight --settings " + file_with("type.json", "{\n\n\"triangles\": \"many\"}"),
            "type.json:3: triangles: expected a whole number from 100 to"},
        {"straight --settings " + file_with("list.json", "[1]"), "list.json:1:"},
        {"straight --size 64", "--size: expected WIDTHxHEIGHT"},
        {"straight --triangles -5", "--triangles: expected a whole number"},
        {"straight --fov nan", "--fov: expected a number"},
        {"straight --view inside", "--view: expected one of chase, cockpit, tower, orbit, free"},
        {"straight --view free", "--view free: expected --eye X,Y,Z and --look X,Y,Z"},
        {"straight --view free --eye 1,2,3 --look 1,2,3", "--look: expected another point than --eye"},
        {"straight --eye 1,2,3", "--eye: expected --view tower or free"},
        {"straight --settings " + file_with("deep.json", std::string(100000, '[')),
            "deep.json: expected at most 64 levels"},
        {"straight --video /nowhere/x.mp4", "/nowhere/x.mp4: expected a file that can be written"},
        {"straight --samples 3", "--samples: expected 1, 4 or 16, got 3"},
        {"straight --no-such-option", "--no-such-option"}, {"straight --place 1e9,0", "leaves the map"},
        {"straight --terrain hills --height-mode datum --place 0,0 --ground-look water-level=x",
            "--ground-look water-level: expected a number"}});
}

TEST_CASE("a recording that cannot be written is refused in one line with exit code 2") {
    const std::string taken = file_with("taken", "a file");
    tests::check_refusals("fly", {{"straight --frames 2 --size 64x36 --record " + taken, "taken"},
                                     {"straight --frames 2 --size 64x36 --record " + folder().string(), "bad-input"}});
    CHECK(std::filesystem::exists(taken));
}

TEST_CASE("a report on what is no recording is refused in one line with exit code 2") {
    tests::check_refusals(
        "report", {{"/nowhere", "/nowhere"}, {folder().string(), "bad-input"}, {file_with("f.json", "{}"), "f.json"}});
}

TEST_CASE("terrain commands refuse wrong input in one line with exit code 2") {
    const std::string same = " --triangles 500 --eye 0,0,900 --look 0,0,900";
    const std::string mesh = (folder() / "mesh.ply").string();
    const std::string map = (folder() / "x.tif").string();
    tests::check_refusals("terrain",
        {{"mesh hills --out " + mesh + same, "--look: expected another point than --eye"},
            {"error hills" + same, "--look: expected another point than --eye"},
            {"query hills --at 0,0 --as-drawn" + same, "--look: expected another point"},
            {"query hills --at 0", "--at: expected X,Y, X,Y,Z or a CSV file, got '0'"},
            {"info /nowhere.tif", "/nowhere.tif"},
            {"make --kind swamp --out " + map, "--kind: expected hills or canyon"},
            {"make --size 1 --out " + map, "--size"}, {"make --size 17 --out /nowhere/x.tif", "/nowhere/x.tif"},
            {"make --size 17 --out /dev/full", "/dev/full"}});
    CHECK_FALSE(std::filesystem::exists(mesh));
    CHECK_FALSE(std::filesystem::exists(map));
}
