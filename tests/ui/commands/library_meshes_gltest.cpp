#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_checks.h"
#include "tests/ui/commands/command_line.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fmt/format.h>
#include <iostream>
#include <string>
#include <vector>

using namespace octant;
using octant::tests::run_octant;

namespace {

constexpr std::string_view triangle = "Geode {\n num_drawables 1\n Geometry {\n"
                                      "  Primitives 1 {\n   DrawArrays TRIANGLES 0 3\n  }\n"
                                      "  VertexArray Vec3Array 3 {\n   0 0 0\n   4 0 0\n"
                                      "   0 3 0\n  }\n }\n}\n";

constexpr std::string_view square =
    "xof 0303txt 0032\nMesh {\n 4;\n 0;0;0;,\n 1;0;0;,\n 1;1;0;,\n 0;1;0;;\n 1;\n 4;0,1,2,3;;\n"
    " MeshTextureCoords {\n  4;\n  0;0;,\n  1;0;,\n  1;1;,\n  0;1;;\n }\n}\n";

/// What the program says of a file of this text.
tests::ProgramRun information(const std::string& name, std::string_view text) {
    static const auto folder = tests::empty_folder("library-meshes");
    write_file(folder / name, text);
    return run_octant({"model", "info", (folder / name).string()});
}

bool has_libraries() {
    const bool has = run_octant({"--version"}).out.find("by Assimp") != std::string::npos;
    if (!has) { std::cout << "SKIPPED: built without Assimp and OpenSceneGraph\n"; }
    return has;
}

} // namespace

TEST_CASE("meshes that libraries read come through, switches that are all off shown whole") {
    if (!has_libraries()) { return; }
    const auto by_assimp = information("square.x", square);
    CHECK(by_assimp.exit_code == 0);
    CHECK_THAT(by_assimp.out, Catch::Contains("faces           2"));
    const auto by_osg = information("triangle.osg", triangle);
    CHECK(by_osg.exit_code == 0);
    CHECK_THAT(by_osg.out, Catch::Contains("faces           1"));
    CHECK_THAT(by_assimp.out, Catch::Contains("a guess, the shape does not say it clearly"));
    CHECK_THAT(by_osg.out, Catch::Contains("nose towards "));
    const auto switched = information(
        "switched.osg", "Switch {\n ValueList {\n  0\n }\n num_children 1\n " + std::string(triangle) + "}\n");
    CHECK(switched.exit_code == 0);
    CHECK_THAT(switched.out, Catch::Contains("faces           1"));
}

TEST_CASE("one aircraft in metres, centimetres and inches is 10 m long, and stands upright") {
    if (!has_libraries()) { return; }
    const std::filesystem::path folder = std::filesystem::path(OCTANT_SOURCE_DIR) / "tests" / "data" / "aircraft";
    for (const char* name : {"fbx_m.fbx", "fbx_cm.fbx", "fbx_in.fbx", "dae_cm.dae"}) {
        CAPTURE(name);
        const auto run = run_octant({"model", "info", (folder / name).string()});
        CHECK(run.exit_code == 0);
        CHECK_THAT(run.out, Catch::Matches("(.|\\n)*length_m +(10|9.9999)[0-9.]*\\n(.|\\n)*"));
        CHECK_THAT(run.out, Catch::Contains("nose towards -x, up +y: guessed from the shape"));
        CHECK_THAT(run.out, Catch::Contains("metres"));
    }
}

TEST_CASE("what is no aircraft's length is told with the likely unit and the option that sets it") {
    const auto folder = tests::empty_folder("aircraft-units");
    const auto said_of = [&](double size, std::vector<std::string> more) {
        std::string text;
        for (const double x : {0.0, size}) {
            text += fmt::format("v {} 0 0\nv {} {} 0\nv {} 0 {}\n", x, x, 0.2 * size, x, 0.1 * size);
        }
        write_file(folder / "plane.obj", text + "f 1 2 4\nf 2 5 4\nf 3 1 4\nf 6 3 4\n");
        std::vector<std::string> words{"model", "info", (folder / "plane.obj").string()};
        words.insert(words.end(), more.begin(), more.end());
        return run_octant(words).err;
    };
    CHECK_THAT(said_of(1500.0, {}), Catch::Contains("its unit is likely centimetres: --aircraft-scale 0.01"));
    CHECK_THAT(said_of(500.0, {}), Catch::Contains("its unit is likely centimetres: --aircraft-scale 0.01"));
    CHECK_THAT(said_of(400.0, {}), Catch::Contains("its unit is likely inches: --aircraft-scale 0.0254"));
    CHECK_THAT(said_of(150.0, {}), Catch::Contains("its unit is likely feet: --aircraft-scale 0.3048"));
    CHECK_THAT(said_of(15'000.0, {}), Catch::Contains("its unit is likely millimetres: --aircraft-scale 0.001"));
    CHECK_THAT(
        said_of(0.5, {}), Catch::Contains("no unit of length makes it one, --aircraft-scale 20 makes it about 10 m"));
    CHECK_THAT(said_of(15.0, {}), !Catch::Contains("--aircraft-scale"));
    CHECK_THAT(said_of(1500.0, {"--aircraft-scale", "0.01"}), !Catch::Contains("--aircraft-scale"));
}

TEST_CASE("texture coordinates of files that libraries read go through simplification") {
    if (!has_libraries()) { return; }
    const auto folder = tests::empty_folder("library-textures");
    write_file(folder / "square.x", square);
    const std::string out = (folder / "out.obj").string();
    const auto run = run_octant({"simplify", (folder / "square.x").string(), out, "--faces", "2"});
    CHECK(run.exit_code == 0);
    CHECK_THAT(read_text_file(out), Catch::Contains("\nvt 1 1\n"));
}

TEST_CASE("what a library cannot read is told in its words, once") {
    if (!has_libraries()) { return; }
    const auto refused = information("none.lwo", "this is no mesh");
    tests::check_refusal(refused, "none.lwo: expected a mesh that Assimp can read, got '");
    CHECK(refused.err.find("expected") == refused.err.rfind("expected"));
    tests::check_refusal(
        information("none.osg", "nothing"), "none.osg: expected a scene that OpenSceneGraph can read, got none");
}
