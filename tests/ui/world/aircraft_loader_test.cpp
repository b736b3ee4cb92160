#include "models/procedural/procedural_models.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "tests/ui/world/user_cache.h"
#include "ui/world/aircraft_loader.h"
#include "ui/world/mesh_loader.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

using namespace octant;
using namespace octant::ui::world;
namespace fs = std::filesystem;
namespace world = octant::ui::world;
using visuals::refine::ProgressiveMesh;

TEST_CASE("orders are kept in the user's cache, in a named folder or not at all") {
    const fs::path folder = tests::empty_folder("order-folder");
    const tests::UserCache cache(folder);
    CHECK(world::order_cache_folder("user") == folder / "octant" / "orders");
    CHECK(fs::is_directory(folder / "octant" / "orders"));
    CHECK(world::order_cache_folder((folder / "mine").string()) == folder / "mine");
    CHECK(fs::is_directory(folder / "mine"));
    CHECK_FALSE(world::order_cache_folder("none").has_value());
}

TEST_CASE("a user's cache that cannot be made is done without, a named folder is refused") {
    const fs::path folder = tests::empty_folder("order-folder-in-the-way");
    write_file(folder / "octant", "a file where the folder would be");
    const tests::UserCache cache(folder);
    CHECK_FALSE(world::order_cache_folder("user").has_value());
    CHECK_THROWS_AS(world::order_cache_folder((folder / "octant" / "orders").string()), Error);
}

TEST_CASE("what was written first goes until the rest is small enough, and nothing of others") {
    const fs::path folder = tests::empty_folder("order-folder-full");
    const auto now = fs::file_time_type::clock::now();
    const auto put = [&](const std::string& name, std::size_t bytes, int age_hours) {
        write_file(folder / name, std::string(bytes, 'x'));
        fs::last_write_time(folder / name, now - std::chrono::hours(age_hours));
    };
    put("3.order", 100, 3);
    put("1.order", 100, 1);
    put("2.pm", 100, 2);
    put("film.part", 1000, 9);
    put("letter.txt", 1000, 9);       // not of the cache
    put(".octant-1-0.part", 1000, 0); // another run is writing it
    put(".octant-1-1.part", 10, 9);   // left by a run that was killed
    fs::create_directory(folder / "folder.order");
    world::remove_oldest(folder, 250);
    CHECK(fs::exists(folder / "1.order"));
    CHECK(fs::exists(folder / "2.pm"));
    CHECK_FALSE(fs::exists(folder / "3.order"));
    world::remove_oldest(folder, 205);
    CHECK(fs::exists(folder / "2.pm"));
    CHECK_FALSE(fs::exists(folder / ".octant-1-1.part"));
    put("0.pm", 300, 0); // alone is too large: the others stay
    world::remove_oldest(folder, 250);
    CHECK_FALSE(fs::exists(folder / "0.pm"));
    CHECK(fs::exists(folder / "1.order"));
    CHECK(fs::exists(folder / "letter.txt"));
    CHECK(fs::exists(folder / "film.part"));
    CHECK(fs::exists(folder / ".octant-1-0.part"));
    CHECK(fs::exists(folder / "folder.order"));
}

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
