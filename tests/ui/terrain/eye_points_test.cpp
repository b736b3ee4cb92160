#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "tests/scratch.h"
#include "ui/terrain/ground_view.h"

#include <catch2/catch.hpp>

#include <string>

using namespace octant;
using namespace octant::ui::terrain;

TEST_CASE("eye points are the rows of one map, wrong ones named by line") {
    const auto file = tests::scratch_folder() / "points.csv";
    write_file(file, "# comment\nmap,x_m,y_m,agl_m,heading_deg,pitch_deg\na,1,2,300,90,-8\nb,5,6,7,8,9\n"
                     "a,-1,-2,10,0,0\n");
    const auto points = read_eye_points(file, "a");
    REQUIRE(points.size() == 2);
    CHECK(points[0].line == 3);
    CHECK(points[1].y_m == -2.0);
    CHECK_THROWS_AS(read_eye_points(file, "c"), Error);
    write_file(file, "a,1,2,300,ninety,-8\n");
    CHECK_THROWS_WITH(read_eye_points(file, "a"), Catch::Contains("points.csv:1: expected map,x_m,y_m"));
}

TEST_CASE("an eye point stands above the ground and looks along its heading") {
    const models::heights::HeightField field(3, 3, 1000.0, std::vector<float>(9, 50.0F));
    const auto camera = camera_at({1, 100.0, 200.0, 300.0, 90.0, 0.0}, visuals::terrain::GroundSamples(field), 45.0);
    CHECK(camera.eye_m.z == Approx(350.0));
    const glm::dvec3 ahead = camera.view_to_world * glm::dvec3(0.0, 0.0, -1.0);
    CHECK(ahead.x == Approx(1.0));
    CHECK_THROWS_AS(camera_at({1, 5000.0, 0.0, 300.0, 0.0, 0.0}, visuals::terrain::GroundSamples(field), 45.0), Error);
}
