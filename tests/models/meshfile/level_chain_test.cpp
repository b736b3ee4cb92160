#include "models/meshfile/level_chain.h"
#include "models/meshfile/mesh_join.h"
#include "sim/base/binary_file.h"
#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/text_file.h"
#include "tests/models/meshfile/mesh_samples.h"

#include <catch2/catch.hpp>

#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>

using namespace octant::models;
using namespace octant::models::polygons;
using namespace octant::models::meshfile;
using namespace octant::models::meshfile::test;
using octant::tests::coloured_cube;
using octant::tests::tetrahedron;

namespace {

/// The coloured cube, a tetrahedron and one square with a pivot.
LevelChain sample_chain() {
    LevelChain chain;
    chain.name = "cube and less";
    chain.levels.push_back({coloured_cube(), 0.0});
    chain.levels.back().mesh.vertices_m[2].y = 1.0 / 3.0;
    chain.levels.back().mesh.notes = {"a.obj:3: something"};
    chain.levels.push_back({tetrahedron(), 0.125});
    polygons::PolygonModel model;
    model.name = "square";
    model.vertices_m = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}};
    model.corner_vertices = {0, 1, 2, 3};
    model.polygons = {{0, 4, 0, 1}};
    model.materials = {{.name = "grey", .colour = {0.5F, 0.5F, 0.5F}, .opacity = 0.4F}};
    model.parts = {"body", "rotor"};
    model.pivots = {{1, {1.0, 2.0, 3.0}, {0.0, 1.0, 0.0}, 6.5}};
    model.parents = {0};
    model.notes = {"a note"};
    chain.polygons = model;
    chain.polygons_error_m = 0.25;
    return chain;
}

/// The bytes of a chain file with the size and the checksum that belong to them.
std::string sealed(std::string bytes) {
    const std::string_view body = std::string_view(bytes).substr(32);
    const std::array<std::uint64_t, 2> numbers{body.size(), octant::checksum_of(body)};
    std::memcpy(&bytes[16], numbers.data(), sizeof numbers);
    return bytes;
}

std::string refused_chain(const std::string& bytes) {
    const std::filesystem::path path = file_with("a.chain", bytes);
    try {
        read_chain(path);
    } catch (const octant::Error& error) {
        return std::string(error.what()).substr(path.parent_path().string().size() + 1);
    }
    return {};
}

/// What reading says of a chain that was written.
std::string said(const LevelChain& faulty) {
    const std::filesystem::path path = scratch_file("c.chain");
    write_chain(path, faulty);
    return refused_chain(octant::read_file(path));
}

} // namespace

TEST_CASE("a chain of levels comes back bit for bit, with the polygons behind it") {
    const LevelChain before = sample_chain();
    const std::filesystem::path path = scratch_file("a.chain");
    CHECK(is_chain_file(path));
    CHECK_FALSE(is_chain_file("a.ply"));
    write_chain(path, before);
    const LevelChain after = read_chain(path);
    CHECK(after.name == before.name);
    REQUIRE(after.levels.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(after.levels[i].error_m == before.levels[i].error_m);
        check_same(after.levels[i].mesh, before.levels[i].mesh);
    }
    CHECK(after.polygons_error_m == before.polygons_error_m);
    REQUIRE(after.polygons.has_value());
    const PolygonModel& was = *before.polygons;
    const PolygonModel& is = *after.polygons;
    CHECK(is.name == was.name);
    CHECK(is.vertices_m == was.vertices_m);
    CHECK(is.corner_vertices == was.corner_vertices);
    REQUIRE(is.polygons.size() == 1);
    CHECK(is.polygons[0].corner_count == 4);
    CHECK(is.polygons[0].part == 1);
    CHECK(is.parts == was.parts);
    REQUIRE(is.pivots.size() == 1);
    CHECK(is.pivots[0].point_m == was.pivots[0].point_m);
    CHECK(is.pivots[0].axis == was.pivots[0].axis);
    CHECK(is.pivots[0].turns_per_s == was.pivots[0].turns_per_s);
    CHECK(is.parents == was.parents);
    CHECK(is.notes == was.notes);
    REQUIRE(is.materials.size() == 1);
    CHECK(is.materials[0].opacity == 0.4F);
}

TEST_CASE("glass of levels keeps its opacity; a file of version 1 is read, all of it opaque") {
    LevelChain chain = sample_chain();
    TriangleMesh& mesh = chain.levels[1].mesh;
    mesh.materials = {{.name = "grey"}, {.name = "glass", .opacity = 0.3F}};
    mesh.triangle_materials.assign(mesh.triangles.size(), 1);
    mesh.triangle_materials[0] = 0;
    const std::filesystem::path path = scratch_file("a.chain");
    write_chain(path, chain);
    TriangleMesh read = read_chain(path).levels[1].mesh;
    const TriangleMesh clear = take_transparent(read);
    CHECK(read.triangles.size() == 1);
    CHECK(clear.triangles.size() == mesh.triangles.size() - 1);
    CHECK(clear.materials[clear.triangle_materials[0]].opacity == 0.3F);
    mesh.materials[1].opacity = 1.5F;
    CHECK_THAT(said(chain), Catch::Contains("expected colours and opacities of 0 to 1 before"));

    // A red and blue tetrahedron, written by the version before opacities.
    const auto old = octant::from_base64(
        "b2N0Y2hhaW4BAAAAAAAAAJoCAAAAAAAAT/EAOXSMIs4DAAAAAAAAAHRldAEAAAAAAAAAAAAAAAMAAAAAAAAAdGV0BAAAAAAAAAAAAAAAAAAAA"
        "AAAAAAAAAAAAAAAAAAAAAAAAAAAAADwPwAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAPA/AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"
        "AAAAAA8D8AAAAAAAAAAAQAAAAAAAAAAAAAAAIAAAABAAAAAAAAAAEAAAADAAAAAAAAAAMAAAACAAAAAQAAAAIAAAADAAAAAAAAAAAAAAAAAAA"
        "AAAAAAAIAAAAAAAAAAQAAAAAAAABhAACAPwAAAAAAAAAAAQAAAAAAAABiAAAAAAAAAAAAAIA/BAAAAAAAAAAAAAAAAAAAAAEAAAABAAAAAAAA"
        "AAAAAAABAAAAAAAAAAAAAAADAAAAAAAAAHRldAQAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA8D8AAAAAAAAAAAAAAAAAA"
        "AAAAAAAAAAAAAAAAAAAAADwPwAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAPA/DAAAAAAAAAAAAAAAAgAAAAEAAAAAAAAAAQAAAAMAAA"
        "AAAAAAAwAAAAIAAAABAAAAAgAAAAMAAAAEAAAAAAAAAAAAAAADAAAAAAAAAAAAAAADAAAAAwAAAAAAAAAAAAAABgAAAAMAAAABAAAAAAAAAAk"
        "AAAADAAAAAQAAAAAAAAACAAAAAAAAAAgAAAAAAAAAY29sb3VyLTEAAIA/AAAAAAAAAAAIAAAAAAAAAGNvbG91ci0yAAAAAAAAAAAAAIA/AQAA"
        "AAAAAAAHAAAAAAAAAGRlZmF1bHQAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA=");
    REQUIRE(old.has_value());
    const LevelChain before = read_chain(file_with("old.chain", *old));
    REQUIRE(before.levels.size() == 1);
    REQUIRE(before.levels[0].mesh.triangles.size() == 4);
    REQUIRE(before.levels[0].mesh.materials.size() == 2);
    CHECK(before.levels[0].mesh.materials[1].name == "b");
    CHECK(before.levels[0].mesh.materials[1].colour == glm::vec3(0.0F, 0.0F, 1.0F));
    for (const Material& material : before.levels[0].mesh.materials) { CHECK(material.opacity == 1.0F); }
    REQUIRE(before.polygons.has_value());
    CHECK(before.polygons->materials[0].opacity == 1.0F);
}

TEST_CASE("a chain without polygons has none when it is read") {
    LevelChain chain = sample_chain();
    chain.polygons.reset();
    const std::filesystem::path path = scratch_file("a.chain");
    write_chain(path, chain);
    CHECK_FALSE(read_chain(path).polygons.has_value());
}

TEST_CASE("a file that is no chain, of another version, cut or changed is refused") {
    const std::filesystem::path path = scratch_file("b.chain");
    write_chain(path, sample_chain());
    const std::string good = octant::read_file(path);
    CHECK(refused_chain(good).empty());
    CHECK(refused_chain("octopus!") == "a.chain: at byte 0: expected a chain of levels, got another file");
    CHECK_THAT(refused_chain("oct"), Catch::StartsWith("a.chain: at byte 0: expected a chain of levels (8"));
    std::string newer = good;
    newer[8] = 3;
    CHECK(refused_chain(newer) == "a.chain: at byte 8: expected version 1 to 2, got 3");
    CHECK_THAT(refused_chain(good.substr(0, good.size() - 1)), Catch::StartsWith("a.chain: at byte 16: "));
    for (std::size_t byte = 0; byte < good.size(); ++byte) {
        std::string changed = good;
        changed[byte] = static_cast<char>(changed[byte] ^ 1);
        const std::string fault = refused_chain(changed);
        REQUIRE(fault.starts_with("a.chain: at byte "));
        REQUIRE((byte < 32 || fault.starts_with("a.chain: at byte 24: expected the checksum ")));
    }
}

TEST_CASE("a chain whose checksum is right but whose content is not is refused") {
    LevelChain chain = sample_chain();
    chain.levels[1].error_m = -1.0;
    CHECK_THAT(said(chain), Catch::Contains("expected an error of at least 0, got -1"));
    chain = sample_chain();
    chain.levels[0].mesh.triangles[3][1] = 99;
    CHECK_THAT(said(chain), Catch::Contains("expected indices in range before"));
    chain = sample_chain();
    chain.levels[0].mesh.colours.pop_back();
    CHECK_THAT(said(chain), Catch::Contains("expected a colour for each vertex before"));
    chain = sample_chain();
    chain.levels[1].mesh.triangles.clear();
    CHECK_THAT(said(chain), Catch::Contains("expected triangles before"));
    chain = sample_chain();
    chain.levels[0].error_m = 0.01;
    CHECK_THAT(said(chain), Catch::Contains("expected an error of 0 of the finest level, got 0.01"));
    const std::filesystem::path path = scratch_file("d.chain");
    write_chain(path, sample_chain());
    std::string bytes = octant::read_file(path);
    bytes[32 + 4] = 1; // of the name's length: now 2^32 more
    CHECK_THAT(refused_chain(sealed(bytes)), Catch::StartsWith("a.chain: at byte 32: expected a text of at most "));
}

TEST_CASE("polygons of a chain that no model can have are refused") {
    const auto said_of = [](const auto& spoil) {
        LevelChain chain = sample_chain();
        spoil(*chain.polygons);
        return said(chain);
    };
    CHECK(said_of([](PolygonModel&) {}).empty());
    CHECK_THAT(said_of([](PolygonModel& model) { model.parents[0] = 1; }),
        Catch::Contains("expected indices in range before"));
    for (const Polygon& polygon : {Polygon{0, 9, 0, 1}, Polygon{0, 3, 0, 1}, Polygon{1, 3, 0, 1}}) {
        CHECK_THAT( // more corners than there are, one behind or one before that is in none
            said_of([&](PolygonModel& model) { model.polygons[0] = polygon; }),
            Catch::Contains("expected polygons of 3 to 1000 corners, one behind the other before"));
    }
    CHECK_THAT(said_of([](PolygonModel& model) {
        model.pivots[0].axis = {0.0, 0.5, 0.0};
    }),
        Catch::Contains("expected axes of length 1 before"));
    CHECK_THAT(said_of([](PolygonModel& model) { model.pivots.push_back(model.pivots[0]); }),
        Catch::Contains("expected one pivot a part at most before"));
    for (const glm::dvec3 place : {glm::dvec3(0.2, 0.2, 0.0), glm::dvec3(1.0, 1.0, 0.3)}) {
        CHECK_THAT( // a dent, a bend
            said_of([&](PolygonModel& model) { model.vertices_m[2] = place; }),
            Catch::Contains("expected convex planar polygons before"));
    }
}
