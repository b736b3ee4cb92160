#include "models/polygons/obj_reader.h"
#include "visuals/draworder/ordered_model.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <string>
#include <vector>

using namespace octant;
using models::polygons::PolygonModel;
using visuals::draworder::OrderedModel;

namespace {

constexpr std::size_t most_polygons = 64;
/// Of smaller models a double that far away keeps too few digits.
constexpr double least_radius_m = 1e-3;

/// A way to turn, scale or move a model, in this sequence.
struct Motion {
    std::string name;
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};
    double scale = 1.0;
    glm::dvec3 move_m{0.0};

    glm::dvec3 operator()(const glm::dvec3& at_m) const { return turn * at_m * scale + move_m; }
};

std::vector<Motion> motions() {
    std::vector<Motion> all;
    for (const auto& axis : {glm::dvec3(0, 0, 1), glm::dvec3(1, -2, 0.5)}) {
        all.push_back(
            {.name = fmt::format("turned about ({}, {}, {})", axis.x, axis.y, axis.z),
             .turn = glm::angleAxis(glm::radians(33.7), glm::normalize(axis))});
    }
    for (const double scale : {1e-6, 1e6}) {
        all.push_back({.name = fmt::format("{} times", scale), .scale = scale});
    }
    all.push_back({.name = "moved by 1e6 m", .move_m = glm::dvec3(1e6, -1e6, 1e6)});
    return all;
}

/// With a share of the time for the proof that is smaller than by default: it has no part in which
/// lists are found.
OrderedModel ordered_after(PolygonModel model, const Motion& motion) {
    for (glm::dvec3& vertex_m : model.vertices_m) {
        vertex_m = motion(vertex_m);
    }
    for (models::polygons::Pivot& pivot : model.pivots) {
        pivot.point_m = motion(pivot.point_m);
        pivot.axis = motion.turn * pivot.axis;
    }
    visuals::draworder::OrderOptions options;
    options.seconds = 4.0;
    return visuals::draworder::ordered(std::move(model), options);
}

/// What differs between two orders; empty if their lists, nodes and splits are the same.
std::string difference(const OrderedModel& a, const OrderedModel& b) {
    if (a.drawn_by != b.drawn_by || a.splits != b.splits ||
        a.model.polygons.size() != b.model.polygons.size()) {
        return fmt::format("{} splits, not {}", b.splits, a.splits);
    }
    if (a.order.cell_count() != b.order.cell_count()) {
        return fmt::format("{} lists, not {}", b.order.cell_count(), a.order.cell_count());
    }
    for (int cell = 0; cell < a.order.cell_count(); ++cell) {
        if (!std::ranges::equal(a.order.polygons_of(cell), b.order.polygons_of(cell))) {
            return fmt::format("another list {}", cell);
        }
    }
    const auto is_same = [](const auto& one, const auto& other) {
        return one.kind == other.kind && one.front == other.front && one.back == other.back &&
               one.along == other.along && one.against == other.against;
    };
    return std::ranges::equal(a.order.nodes(), b.order.nodes(), is_same) ? "" : "other nodes";
}

} // namespace

TEST_CASE("moving, scaling and turning a model change neither its lists nor its cells") {
    std::vector<std::filesystem::path> files;
    const std::filesystem::path folder = OCTANT_SOURCE_DIR "/tests/fuzz/corpus";
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    int moved = 0;
    for (const char* aircraft : {"f15", "500md", "concave"}) {
        files.push_back(fmt::format("{}/models/{}.obj", OCTANT_SOURCE_DIR, aircraft));
    }
    for (const std::filesystem::path& file : files) {
        const PolygonModel model = models::polygons::read_obj(file);
        if (model.polygons.size() > most_polygons) {
            continue;
        }
        ++moved;
        const OrderedModel still = ordered_after(model, {});
        for (const Motion& motion : motions()) {
            if (motion.move_m != glm::dvec3(0.0) &&
                models::polygons::radius_m(model) < least_radius_m) {
                continue;
            }
            INFO(file.filename().string() << " " << motion.name);
            CHECK(difference(still, ordered_after(model, motion)) == "");
        }
    }
    CHECK(moved > 30);
}
