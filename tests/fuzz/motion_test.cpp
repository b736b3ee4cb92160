#include "models/polygons/obj_reader.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "visuals/draworder/ordered_model.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>
#include <string>
#include <string_view>
#include <vector>

using namespace octant;
using models::polygons::PolygonModel;
using visuals::draworder::OrderedModel;

namespace {

constexpr std::size_t max_polygons = 64;
/// Larger models are moved in one way each, by turns, for the sake of time.
constexpr std::size_t few_polygons = 4;
/// Of smaller models a double that far away keeps too few digits.
constexpr double min_radius_m = 1e-3;
/// Numbers above are refused in files.
constexpr double max_coordinate_m = 1e7;

/// A way to turn, scale or move a model, in this sequence.
struct Motion {
    std::string name;
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};
    double scale = 1.0;
    glm::dvec3 move_m{0.0};

    glm::dvec3 operator()(const glm::dvec3& at_m) const { return turn * at_m * scale + move_m; }
};

/// Words `first` to `first` + 2 of a line as a vector, `first` + 2 being there.
glm::dvec3 vector_in(const std::vector<std::string_view>& words, std::size_t first) {
    glm::dvec3 out{0.0};
    for (std::size_t i = 0; i < 3; ++i) {
        out[static_cast<glm::length_t>(i)] = finite_number(words[first + i]).value();
    }
    return out;
}

/// A line of an OBJ file after a motion: vertices and pivots, with all their digits.
std::string moved_line(std::string_view line, const Motion& motion) {
    const auto words = split_words(line);
    if (words.size() > 3 && words[0] == "v") {
        const glm::dvec3 to = motion(vector_in(words, 1));
        return fmt::format("v {} {} {}", to.x, to.y, to.z);
    }
    if (words.size() > 9 && words[1] == "pivot" && words[6] == "axis") {
        const glm::dvec3 to = motion(vector_in(words, 3));
        const glm::dvec3 axis = motion.turn * vector_in(words, 7);
        return fmt::format("# pivot {} {} {} {} axis {} {} {} {}", words[2], to.x, to.y, to.z, axis.x, axis.y, axis.z,
            fmt::join(words.begin() + 10, words.end(), " "));
    }
    return std::string(line);
}

/// The motions that doubles and the reader have digits for.
std::vector<Motion> motions(double radius_m) {
    std::vector<Motion> all;
    for (const auto& axis : {glm::dvec3(0, 0, 1), glm::dvec3(1, -2, 0.5)}) {
        all.push_back({.name = fmt::format("turned about ({}, {}, {})", axis.x, axis.y, axis.z),
            .turn = glm::angleAxis(glm::radians(33.7), glm::normalize(axis))});
    }
    for (const double scale : {1e-6, 1e6}) { all.push_back({.name = fmt::format("{} times", scale), .scale = scale}); }
    all.push_back({.name = "moved by 1e6 m", .move_m = glm::dvec3(1e6, -1e6, 1e6)});
    std::erase_if(all, [&](const Motion& motion) {
        return (motion.move_m != glm::dvec3(0.0) && radius_m < min_radius_m) ||
               motion.scale * radius_m > max_coordinate_m;
    });
    return all;
}

/// The order of a file whose vertices and pivots were moved in it, before anything was read: what the reader cuts must
/// be cut alike, too. The proof has a smaller share of the time than by default, as it has no part in which lists are
/// found.
OrderedModel ordered_after(const std::filesystem::path& file, const Motion& motion) {
    std::string text;
    const std::string given = read_text_file(file);
    for (const std::string_view line : split_lines(given)) { text += moved_line(line, motion) + "\n"; }
    const std::filesystem::path moved = tests::scratch_folder() / "moved.obj";
    write_file(moved, text);
    visuals::draworder::OrderOptions options;
    options.seconds = 4.0;
    return visuals::draworder::ordered(models::polygons::read_obj(moved), options);
}

/// What differs between two orders; empty if their lists, nodes and splits are the same.
std::string difference(const OrderedModel& a, const OrderedModel& b) {
    if (a.found_by != b.found_by || a.splits != b.splits || a.model.polygons.size() != b.model.polygons.size()) {
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
               one.coplanar_front == other.coplanar_front && one.coplanar_back == other.coplanar_back;
    };
    return std::ranges::equal(a.order.nodes(), b.order.nodes(), is_same) ? "" : "other nodes";
}

} // namespace

TEST_CASE("moving, scaling and turning a model change neither its lists nor its cells") {
    std::vector<std::filesystem::path> files;
    const std::filesystem::path folder = OCTANT_SOURCE_DIR "/tests/fuzz/corpus";
    for (const auto& entry : std::filesystem::directory_iterator(folder)) { files.push_back(entry.path()); }
    std::sort(files.begin(), files.end());
    std::size_t moved = 0;
    std::set<std::string> ways_of_large;
    for (const char* aircraft : {"f15", "500md", "concave"}) {
        files.push_back(fmt::format("{}/models/{}.obj", OCTANT_SOURCE_DIR, aircraft));
    }
    for (const std::filesystem::path& file : files) {
        const PolygonModel model = models::polygons::read_obj(file);
        if (model.polygons.size() > max_polygons) { continue; }
        std::vector<Motion> ways = motions(models::polygons::radius_m(model));
        REQUIRE(!ways.empty());
        if (model.polygons.size() > few_polygons) {
            ways = {ways[moved % ways.size()]};
            ways_of_large.insert(ways.front().name);
        }
        ++moved;
        const OrderedModel still = ordered_after(file, {});
        for (const Motion& motion : ways) {
            INFO(file.filename().string() << " " << motion.name);
            CHECK(difference(still, ordered_after(file, motion)) == "");
        }
    }
    CHECK(moved > 30);
    CHECK(ways_of_large.size() == 5);
}
