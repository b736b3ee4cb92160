#include "models/procedural/procedural_models.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "ui/world/aircraft_loader.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

using namespace octant;
using namespace octant::ui::world;
using visuals::refine::ProgressiveMesh;

namespace {

/// A coarse ball whose colour is that of its first vertex.
models::TriangleMesh ball(const glm::vec3& colour) {
    models::TriangleMesh mesh = models::procedural::globe();
    mesh.triangles.resize(3000);
    mesh.colours.front() = colour;
    return mesh;
}

std::filesystem::path empty_cache(const std::string& name) {
    const std::filesystem::path folder = tests::scratch_folder() / name;
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    return folder;
}

void check_same(const ProgressiveMesh& a, const ProgressiveMesh& b) {
    CHECK(a.parts().origin_m == b.parts().origin_m);
    CHECK(std::ranges::equal(a.faces(), b.faces()));
    REQUIRE(a.node_count() == b.node_count());
    std::size_t different = 0;
    for (std::uint32_t node = 0; node < a.node_count(); ++node) {
        different += a.position_m(node) != b.position_m(node) ? 1U : 0U;
        different += a.error_m(node) != b.error_m(node) ? 1U : 0U;
    }
    CHECK(different == 0);
    CHECK(std::ranges::equal(a.coarsest_first(), b.coarsest_first()));
}

constexpr std::size_t max_bytes = std::size_t{1} << 24U;

} // namespace

TEST_CASE("a mesh that was made ready before is read, the same to the bit") {
    const auto folder = empty_cache("prepared");
    const RefineMeshOptions input{.file = "ball", .base = 0, .quiet = true};
    const models::TriangleMesh mesh = ball({1.0F, 0.0F, 0.0F});
    const auto file = refine_mesh_cache_file(folder, mesh);
    const RefineMesh made = cached_refine_mesh(folder, input, mesh);
    REQUIRE(std::filesystem::is_regular_file(file));
    const auto written = std::filesystem::last_write_time(file);
    const RefineMesh kept = cached_refine_mesh(folder, input, mesh);
    CHECK(std::filesystem::last_write_time(file) == written);
    check_same(*made.mesh, *kept.mesh);
    check_same(*made.mesh, *make_refine_mesh(input, mesh).mesh);
    CHECK(refine_mesh_cache_file(folder, ball({0.0F, 1.0F, 0.0F})) != file);
}

TEST_CASE("what was repaired in a mesh is told each time, whoever reads it under which name") {
    const auto folder = empty_cache("repaired");
    models::TriangleMesh mesh = ball({1.0F, 0.0F, 0.0F});
    mesh.triangles.push_back(mesh.triangles.front());
    mesh.notes = {"of its file"};
    const auto notes_as = [&](const std::string& name) {
        const RefineMeshOptions input{.file = name, .base = 0, .quiet = true};
        return cached_refine_mesh(folder, input, mesh).notes;
    };
    const std::vector<std::string> made = notes_as("ball");
    REQUIRE(made.size() >= 2);
    CHECK(made[0] == "of its file");
    CHECK_THAT(made[1], Catch::StartsWith("ball: "));
    CHECK(notes_as("ball") == made);
    CHECK(notes_as("other")[1] == "other: " + made[1].substr(std::string("ball: ").size()));
}

TEST_CASE("a prepared mesh that is damaged or cut off is made anew and replaced, with a note") {
    const auto folder = empty_cache("damaged");
    const RefineMeshOptions input{.file = "ball", .base = 0, .quiet = true};
    const models::TriangleMesh mesh = ball({1.0F, 0.0F, 0.0F});
    const auto file = refine_mesh_cache_file(folder, mesh);
    const RefineMesh made = cached_refine_mesh(folder, input, mesh);
    const std::string whole = read_file(file, max_bytes);
    std::string flipped = whole;
    flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 4);
    for (const std::string& bad : {flipped, whole.substr(0, whole.size() - 9), whole + "x", std::string("x")}) {
        write_file(file, bad);
        const RefineMesh anew = cached_refine_mesh(folder, input, mesh);
        REQUIRE_FALSE(anew.notes.empty());
        CHECK_THAT(anew.notes.back(), Catch::Contains("computed anew"));
        check_same(*made.mesh, *anew.mesh);
        CHECK(read_file(file, max_bytes) == whole);
    }
}
