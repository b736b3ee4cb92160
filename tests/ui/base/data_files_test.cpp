#include "models/polygons/obj_reader.h"
#include "sim/base/error.h"
#include "ui/base/data_files.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

using namespace octant;

TEST_CASE("built-in names lead to files, files stay what they are, other names are refused") {
    CHECK(ui::base::aircraft_file("f15").filename() == "f15.obj");
    CHECK(ui::base::aircraft_file("./mine.obj") == "./mine.obj");
    CHECK(ui::base::path_file("turn", "500md").filename() == "500md-turn.toml");
    CHECK(ui::base::path_file("turn", "mine.obj").filename() == "f15-turn.toml");
    CHECK_THROWS_WITH(ui::base::aircraft_file("f16"),
        "aircraft: expected f15, 500md, f15-detailed, 500md-detailed, concave or an OBJ file, got "
        "'f16'");
    CHECK_THROWS_WITH(ui::base::path_file("loop", "f15"), Catch::Contains("expected straight, jinking, pop-up, turn"));
}

TEST_CASE("every known aircraft has its model, its cockpit and its four paths") {
    const auto models = ui::base::data_folder() / "models";
    for (const sim::AircraftKind& kind : sim::aircraft_kinds()) {
        CHECK(std::filesystem::is_regular_file(models / kind.model_file));
        CHECK(std::filesystem::is_regular_file(models / kind.cockpit_file));
        for (const std::string_view path : ui::base::built_in_paths) {
            CHECK(std::filesystem::is_regular_file(ui::base::path_file(std::string(path), std::string(kind.name))));
        }
    }
}

TEST_CASE("what is only a shape flies as an F-15, and a name that nothing has not at all") {
    CHECK(ui::base::aircraft_kind_of("500md").name == "500md");
    CHECK(ui::base::aircraft_kind_of("concave").name == "f15");
    CHECK(ui::base::aircraft_kind_of("./mine.obj").name == "f15");
    CHECK_THROWS_AS(ui::base::aircraft_kind_of("f16"), Error);
    CHECK_THROWS_AS(ui::base::path_file("turn", "f16"), Error);
}

TEST_CASE("OCTANT_DATA names the data folder when it holds data") {
    const auto usual = ui::base::data_folder();
    setenv("OCTANT_DATA", "/nowhere", 1);
    CHECK(ui::base::data_folder() == usual);
    setenv("OCTANT_DATA", OCTANT_SOURCE_DIR, 1);
    CHECK(ui::base::data_folder() == OCTANT_SOURCE_DIR);
    unsetenv("OCTANT_DATA");
}

TEST_CASE("the shipped aircraft have the paper's counts and the aircraft's sizes") {
    struct Expected {
        const char* name;
        std::size_t vertices;
        std::size_t polygons;
    };

    for (const Expected& expected :
        {Expected{"f15", 63, 43}, Expected{"500md", 111, 64}, Expected{"concave", 14, 10}}) {
        const models::polygons::PolygonModel model = models::polygons::read_obj(ui::base::aircraft_file(expected.name));
        CHECK(model.vertices_m.size() == expected.vertices);
        CHECK(model.polygons.size() == expected.polygons);
        CHECK(model.name == expected.name);
    }
}

TEST_CASE("the F-15 is 19.43 m long, 13.05 m wide and 4.34 m high, and mirror-symmetric") {
    const models::polygons::PolygonModel model = models::polygons::read_obj(ui::base::aircraft_file("f15"));
    glm::dvec3 least(1e9);
    glm::dvec3 most(-1e9);
    for (const glm::dvec3& v : model.vertices_m) {
        least = glm::min(least, v);
        most = glm::max(most, v);
        const bool has_twin = std::any_of(model.vertices_m.begin(), model.vertices_m.end(),
            [&](const glm::dvec3& w) { return glm::length(w - glm::dvec3(v.x, -v.y, v.z)) < 1e-6; });
        CHECK(has_twin);
    }
    CHECK((most - least).x == Approx(19.43).epsilon(0.02));
    CHECK((most - least).y == Approx(13.05).epsilon(0.02));
    CHECK((most - least).z == Approx(4.34).epsilon(0.02));
}

TEST_CASE("the 500MD's body is 7.1 m long, its hub 2.7 m over the skids, its rotor 8.05 m across") {
    const models::polygons::PolygonModel model = models::polygons::read_obj(ui::base::aircraft_file("500md"));
    double nose = -1e9;
    double tail = 1e9;
    double skids = -1e9;
    double rotor = 0.0;
    REQUIRE(model.pivots.size() == 2);
    const auto found = std::find_if(model.pivots.begin(), model.pivots.end(),
        [&](const models::polygons::Pivot& pivot) { return model.parts[pivot.part] == "rotor"; });
    REQUIRE(found != model.pivots.end());
    const models::polygons::Pivot& hub = *found;
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        const bool turns = model.polygons[i].part == hub.part;
        for (const std::uint32_t vertex : model.corners(i)) {
            const glm::dvec3 v = model.vertices_m[vertex];
            if (turns) {
                rotor = std::max(rotor, std::hypot(v.x - hub.point_m.x, v.y - hub.point_m.y));
            } else {
                nose = std::max(nose, v.x);
                tail = std::min(tail, v.x);
                skids = std::max(skids, v.z);
            }
        }
    }
    CHECK(nose - tail == Approx(7.1).epsilon(0.01));
    CHECK(skids - hub.point_m.z == Approx(2.7).epsilon(0.01));
    CHECK(2.0 * rotor == Approx(8.05).epsilon(0.01));
}

TEST_CASE("what lies in a folder of the program's own is called by the file that it came from") {
    const ui::base::PathAlias one("/own/octant-a1/one", "flights/one.zip");
    const ui::base::PathAlias other("/own/octant-b2/one", "one.zip");
    CHECK(ui::base::with_path_aliases("/own/octant-a1/one/frames.csv:3: expected a number, got 'x'") ==
          "flights/one.zip/frames.csv:3: expected a number, got 'x'");
    CHECK(ui::base::with_path_aliases("/own/octant-b2/one differs from /own/octant-a1/one") ==
          "one.zip differs from flights/one.zip");
    CHECK(ui::base::with_path_aliases("/own/octant-c3/one: found none") == "/own/octant-c3/one: found none");
}
