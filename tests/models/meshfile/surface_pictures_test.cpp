#include "models/meshfile/mesh_file.h"
#include "models/repair/repair.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/models/meshfile/mesh_samples.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <iterator>
#include <string>
#include <utility>

using namespace octant;
using namespace octant::models;
using namespace octant::models::meshfile;
using namespace octant::models::repair;
using namespace octant::models::meshfile::test;

namespace {

/// A BMP of two pixels side by side: red, then blue.
std::string red_and_blue() {
    std::string bytes = "BM";
    const auto add = [&](std::uint32_t number, int size) {
        for (int i = 0; i < size; ++i) { bytes += static_cast<char>(number >> (8 * i) & 0xffU); }
    };
    for (const auto& [number, size] :
        std::initializer_list<std::pair<std::uint32_t, int>>{{62, 4}, {0, 4}, {54, 4}, {40, 4}, {2, 4}, {1, 4}, {1, 2},
            {24, 2}, {0, 4}, {8, 4}, {2835, 4}, {2835, 4}, {0, 4}, {0, 4}, {0xff0000, 3}, {0x0000ff, 3}, {0, 2}}) {
        add(number, size);
    }
    return bytes;
}

/// A TIFF of one pixel of this opacity.
std::string tiff_of_opacity(std::uint32_t opacity) {
    std::string bytes = "II";
    const auto add = [&](std::uint32_t number, int size) {
        for (int i = 0; i < size; ++i) { bytes += static_cast<char>(number >> (8 * i) & 0xffU); }
    };
    add(42, 2);
    add(20, 4);                         // where the directory stands
    add(0x00ff00U | opacity << 24U, 4); // the pixel, at byte 8
    add(0x00080008U, 4);                // bits of its parts, at byte 12
    add(0x00080008U, 4);
    constexpr std::uint32_t entries[][3] = {{256, 1, 1}, {257, 1, 1}, {258, 4, 12}, {259, 1, 1}, {262, 1, 2},
        {273, 1, 8}, {277, 1, 4}, {278, 1, 1}, {279, 1, 4}, {338, 1, 2}};
    add(std::size(entries), 2);
    for (const auto& [tag, count, value] : entries) {
        add(tag, 2);
        add(3, 2); // a short number
        add(count, 4);
        add(value, 4);
    }
    add(0, 4);
    return bytes;
}

} // namespace

TEST_CASE("the picture of an AC3D surface colours its vertices, if it is asked for") {
    file_with("two.bmp", red_and_blue());
    const auto file = file_with("square.ac", ac3d_square("0x0"));
    CHECK(read_mesh(file).colours.empty());
    const TriangleMesh mesh = read_mesh(file, {.pictures = true});
    REQUIRE(mesh.colours.size() == 4);
    CHECK(mesh.colours[0].x > 0.75F);
    CHECK(mesh.colours[3].x > 0.75F);
    CHECK(mesh.colours[0].y == 0.0F);
    CHECK(mesh.colours[1].z > 0.75F);
    CHECK(mesh.colours[2].z > 0.75F);
}

TEST_CASE("what is mostly transparent is left out or glass, unless nothing else is there") {
    const std::string plain = "OBJECT poly\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf 1\nSURF 0x0\n"
                              "mat 0\nrefs 3\n0 0 0\n1 0 0\n2 0 0\nkids 0\n";
    std::string two = ac3d_square("0x0");
    two.replace(two.find("kids 1"), 6, "kids 2");
    for (const std::uint32_t opacity : {255U, 20U, 5U}) {
        file_with("two.bmp", tiff_of_opacity(opacity));
        const bool is_transparent = opacity < 128U;
        const TriangleMesh mesh = read_mesh(file_with("two.ac", two + plain), {.pictures = true});
        CHECK(mesh.triangles.size() == (is_transparent ? 1U : 3U));
        CHECK(mesh.notes.size() == (is_transparent ? 1U : 0U));
        const auto alone = file_with("alone.ac", ac3d_square("0x0"));
        CHECK(read_mesh(alone, {.pictures = true}).triangles.size() == 2);
        const MeshParts parts = read_parts(file_with("two.ac", two + plain), {.pictures = true});
        CHECK(parts.body.triangles.size() == (is_transparent ? 1U : 3U));
        CHECK(parts.clear.triangles.size() == (opacity == 20U ? 2U : 0U));
        CHECK(parts.body.notes.size() == (opacity == 5U ? 1U : 0U));
        if (opacity == 20U) { // in steps of a 64th
            const float seen = parts.clear.materials[parts.clear.triangle_materials[0]].opacity;
            CHECK(seen == Approx(20.0 / 255.0).margin(1.0 / 128.0));
        }
        if (is_transparent) {
            CHECK(read_parts(alone, {.pictures = true}).body.triangles.empty());
            CHECK(read_rotating_model(alone, {.pictures = true}).body.triangles.size() == 2);
        }
    }
}

TEST_CASE("a FlightGear model says in which folder its pictures lie") {
    const auto mesh = file_with("painted.ac", ac3d_square("0x0"));
    const std::filesystem::path folder = mesh.parent_path() / "Skins" / "Texture-RAF";
    std::filesystem::create_directories(folder);
    std::filesystem::remove(mesh.parent_path() / "two.bmp");
    write_file(folder / "two.bmp", red_and_blue());
    const auto model = [](const std::string& where) {
        return read_mesh(file_with("painted.xml", "<PropertyList><path>painted.ac</path>" + where + "</PropertyList>"),
            {.pictures = true});
    };
    CHECK(model("").colours.empty());
    for (const std::string name : {"Skins/Texture-RAF/", "/Skins/Texture-RAF"}) {
        const TriangleMesh painted = model("<texture-path>" + name + "</texture-path>");
        CHECK(painted.notes.empty());
        REQUIRE(painted.colours.size() == 4);
        CHECK(painted.colours[0].x > 0.75F);
    }
}

TEST_CASE("a picture that is missing is told, and the material's colour stays") {
    const auto file = file_with("lonely.ac", ac3d_square("0x0"));
    std::filesystem::remove(file.parent_path() / "two.bmp");
    const TriangleMesh mesh = read_mesh(file, {.pictures = true});
    CHECK(mesh.colours.empty());
    REQUIRE(mesh.notes.size() == 1);
    CHECK_THAT(mesh.notes[0], Catch::Contains("expected a picture 'two.bmp', got none"));
}

TEST_CASE("a two-sided sheet gets a back that welding keeps apart") {
    const auto file = file_with("sheet.ac", ac3d_square("0x20"));
    CHECK(read_mesh(file).triangles.size() == 2);
    const TriangleMesh mesh = read_mesh(file, {.backs = true});
    REQUIRE(mesh.triangles.size() == 4);
    CHECK(normal_of(mesh, mesh.triangles[0]).z == Approx(1.0));
    CHECK(normal_of(mesh, mesh.triangles[2]).z == Approx(-1.0));
    CHECK(repaired(mesh).counts.shells == 2);
    const auto one_sided = file_with("sheet.ac", ac3d_square("0x0"));
    CHECK(read_mesh(one_sided, {.backs = true}).triangles.size() == 2);
}

TEST_CASE("clear materials come apart, of AC3D and FlightGear files and of all that were written of them") {
    std::string two = ac3d_square("0x0");
    two.replace(two.find("kids 1"), 6, "kids 2");
    two.insert(two.find("OBJECT world"),
        "MATERIAL \"glass\" rgb 0.5 0.5 0.6 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0.7\n");
    const std::string pane = "OBJECT poly\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf 1\nSURF 0x0\n"
                             "mat 1\nrefs 3\n0 0 0\n1 0 0\n2 0 0\nkids 0\n";
    const auto file = file_with("canopy.ac", two + pane);
    const auto check = [](const RotatingModel& model) {
        CHECK(model.body.triangles.size() == 2);
        REQUIRE(model.clear.triangles.size() == 1);
        CHECK(model.clear.materials[model.clear.triangle_materials[0]].opacity == Approx(0.3F));
    };
    check(read_rotating_model(file, {}));
    check(read_rotating_model(file_with("canopy.xml", "<PropertyList><path>canopy.ac</path></PropertyList>"), {}));
    CHECK(read_mesh(file).triangles.size() == 3); // as one mesh all of it is there

    std::string all = ac3d_square("0x0");
    all.replace(all.find("trans 0"), 7, "trans 1");
    const RotatingModel unseen = read_rotating_model(file_with("unseen.ac", all), {});
    CHECK(unseen.body.triangles.size() == 2);
    CHECK(unseen.clear.triangles.empty());

    for (const char* const name : {"written.gltf", "written.glb", "written.ac", "written.obj", "written.wrl"}) {
        INFO(name);
        const auto written = file.parent_path() / name;
        write_mesh(written, read_mesh(file));
        check(read_rotating_model(written, {}));
    }
}
