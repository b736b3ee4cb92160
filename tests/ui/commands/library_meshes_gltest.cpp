#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_checks.h"
#include "tests/ui/commands/command_line.h"

#include <catch2/catch.hpp>

#include <iostream>
#include <string>

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
    CHECK_THAT(by_assimp.out, Catch::Contains("nose towards -z, up +y: taken for granted"));
    CHECK_THAT(by_osg.out, Catch::Contains("nose towards +y, up +z: taken for granted"));
    const auto switched = information(
        "switched.osg", "Switch {\n ValueList {\n  0\n }\n num_children 1\n " + std::string(triangle) + "}\n");
    CHECK(switched.exit_code == 0);
    CHECK_THAT(switched.out, Catch::Contains("faces           1"));
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
