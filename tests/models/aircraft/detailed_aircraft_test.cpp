#include "models/polygons/obj_reader.h"
#include "models/polygons/obj_writer.h"
#include "models/polygons/polygon_model.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/models/aircraft/detailed_aircraft.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>

#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace octant;
using namespace octant::models;

namespace {

std::vector<polygons::PolygonModel> both() {
    return {aircraft::test::detailed_f15(), aircraft::test::detailed_500md()};
}

std::filesystem::path shipped(const polygons::PolygonModel& model, const char* ending) {
    return std::filesystem::path(OCTANT_SOURCE_DIR) / "models" / (model.name + ending);
}

std::pair<glm::dvec3, glm::dvec3> extent_of(const polygons::PolygonModel& model) {
    glm::dvec3 least(std::numeric_limits<double>::max());
    glm::dvec3 most(std::numeric_limits<double>::lowest());
    for (const glm::dvec3& vertex_m : model.vertices_m) {
        least = glm::min(least, vertex_m);
        most = glm::max(most, vertex_m);
    }
    return {least, most};
}

} // namespace

TEST_CASE("the shipped detailed aircraft are the output of their generators") {
    for (const polygons::PolygonModel& model : both()) {
        INFO(model.name << ": OCTANT_APPROVE=1 rewrites the files");
        const polygons::ObjText text = polygons::obj_text(model, {}, shipped(model, ".mtl").filename().string());
        if (std::getenv("OCTANT_APPROVE") != nullptr) {
            write_file(shipped(model, ".obj"), text.obj);
            write_file(shipped(model, ".mtl"), text.mtl);
        }
        CHECK(read_text_file(shipped(model, ".obj")) == text.obj);
        CHECK(read_text_file(shipped(model, ".mtl")) == text.mtl);
    }
}

TEST_CASE("detailed aircraft are of convex planar polygons, 300 to 1,500, read back without notes") {
    for (const polygons::PolygonModel& model : both()) {
        INFO(model.name);
        CHECK(model.polygons.size() >= 300);
        CHECK(model.polygons.size() <= 1500);
        int faults = 0;
        for (std::size_t i = 0; i < model.polygons.size(); ++i) {
            faults += polygons::polygon_fault(model, i, 1e-7) ? 1 : 0;
        }
        CHECK(faults == 0);
        const polygons::PolygonModel read = polygons::read_obj(shipped(model, ".obj"));
        CHECK(read.notes.empty());
        CHECK(read.polygons.size() == model.polygons.size());
    }
}

TEST_CASE("detailed aircraft have their types' published sizes") {
    const auto [f15_min, f15_max] = extent_of(aircraft::test::detailed_f15());
    CHECK(f15_max.x - f15_min.x == Approx(19.43).margin(0.1));  // length
    CHECK(f15_max.y - f15_min.y == Approx(13.05).margin(0.01)); // span
    CHECK(f15_min.y == -f15_max.y);
    CHECK(f15_max.z - f15_min.z == Approx(4.34).margin(0.03)); // height, gear up
    const auto [md_min, md_max] = extent_of(aircraft::test::detailed_500md());
    CHECK(md_max.y - md_min.y == Approx(8.04).epsilon(0.06)); // rotor, one blade ahead
    CHECK(1.20 + md_max.z == Approx(2.4).margin(0.05));       // skids 1.20 below the origin
}
