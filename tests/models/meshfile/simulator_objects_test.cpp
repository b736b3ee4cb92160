#include "models/meshfile/mesh_file.h"
#include "models/part_motion.h"
#include "sim/base/units.h"
#include "tests/models/meshfile/mesh_samples.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <cmath>
#include <filesystem>
#include <string>

using namespace octant::models;
using namespace octant::models::meshfile;
using namespace octant::models::meshfile::test;

namespace {

const std::string xplane_start = "I\n800\nOBJ\n\nPOINT_COUNTS 4 0 0 6\n";
const std::string xplane_points =
    "VT 0 0 0 0 1 0 0 0 # 0\nVT 1 0 0 0 1 0 1 0\nVT 1 0 -1 0 1 0 1 1\nVT 0 0 -1 0 1 0 0 1\n"
    "IDX10 0 2 1 0 3 2 0 2 1 0\nIDX 3\nIDX 2\n";

const std::string srf = "Surf\nV -1 0 2\nV 1 0 2\nV 0 0 3 R\nV 0 1 2\nF\nC 255 0 0\nN 0 0 2 0 -1 0\nV 0 1 2\nE\n"
                        "F\nC 31744\nN 0 0 2 0 0 0\nV 0 1 3\nE\nE\nZA 1 102\nE\n";

std::string dnm(const std::string& parts) { return "DYNAMODEL\nDNMVER 1\nPCK \"a.srf\" 18\n" + srf + parts + "END\n"; }

std::string part(const std::string& name, int kind, const std::string& more) {
    return "SRF \"" + name + "\"\nFIL a.srf\nCLA " + std::to_string(kind) + "\n" + more + "END\n";
}

/// Where a point of a part is with one control at a position.
glm::dvec3 placed(const RotatingPart& part, FlightControl control, double position, const glm::dvec3& point_m) {
    ControlPositions positions{};
    positions[static_cast<std::size_t>(control)] = position;
    return glm::dvec3(placement_by(part.moves, positions) * glm::dvec4(point_m, 1.0));
}

} // namespace

TEST_CASE("an X-Plane object is read by its first lines, its fronts and normals as it has them") {
    const auto file = file_with("wing.obj", xplane_start + xplane_points + "TRIS 0 6\n");
    CHECK(is_xplane_object(file));
    const TriangleMesh mesh = read_mesh(file);
    REQUIRE(mesh.triangles.size() == 2);
    for (std::size_t t = 0; t < 2; ++t) {
        CHECK(normal_of(mesh, mesh.triangles[t]).y == Approx(1.0));
        CHECK(mesh.normals[mesh.corner_normals[t][0]] == glm::vec3(0.0F, 1.0F, 0.0F));
    }
    CHECK(axes_of_format(file)->text() == "right,up,back");
    CHECK_FALSE(is_xplane_object(file_with("other.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")));
    CHECK_FALSE(is_xplane_object("no-such-file.obj"));
}

TEST_CASE("animations of an X-Plane object rest at the value 0, hide what they hide and keep the nearest level") {
    const auto bounds = [](const std::string& commands) {
        return bounds_of(read_mesh(file_with("wing.obj", xplane_start + xplane_points + commands)));
    };
    CHECK(bounds("ANIM_begin\nANIM_trans 0 0 0 0 8 0 -1 1 sim/gear\nTRIS 0 6\nANIM_end\n").max_m.y == Approx(4.0));
    CHECK(bounds("ANIM_begin\nANIM_trans 5 0 0\nTRIS 0 6\nANIM_end\n").max_m.x == Approx(6.0));
    CHECK(bounds("ANIM_begin\nANIM_rotate 0 0 1 90 0 0 1 sim/flap\nTRIS 0 6\nANIM_end\n").max_m.y == Approx(1.0));
    CHECK(bounds("ANIM_begin\nANIM_rotate_begin 0 0 1 sim/x\nANIM_rotate_key -1 0\nANIM_rotate_key 1 180\n"
                 "ANIM_rotate_end\nTRIS 0 6\nANIM_end\n")
              .max_m.y == Approx(1.0));
    CHECK(bounds("TRIS 0 3\nANIM_begin\nANIM_hide 0 0 sim/on\nANIM_trans 9 0 0\nTRIS 0 6\nANIM_end\n").max_m.x ==
          Approx(1.0));
    CHECK(bounds("ANIM_begin\nANIM_hide 0 9 sim/on\nANIM_show 1 1 sim/graphics/view/view_is_external\nTRIS 0 6\n"
                 "ANIM_end\n")
              .max_m.x == Approx(1.0));
    const TriangleMesh near = read_mesh(file_with(
        "wing.obj", xplane_start + xplane_points + "ATTR_LOD 0 900\nTRIS 0 3\nATTR_LOD 900 9000\nTRIS 0 6\n"));
    CHECK(near.triangles.size() == 1);
    CHECK_THAT(near.notes.back(), Catch::Contains("2 triangles"));
}

TEST_CASE("a faulty X-Plane object is refused in one line that says where") {
    const auto fault = [](const std::string& text) { return error_of("wing.obj", xplane_start + text); };
    CHECK(fault("VT 0 0\n") == "wing.obj:6: expected a coordinate, got none");
    CHECK(fault("IDX 0\n") == "wing.obj:6: expected VT lines before IDX, got none");
    CHECK(fault(xplane_points + "TRIS 0 15\n") == "wing.obj:13: expected a number of indices of 0 to 12, got '15'");
    CHECK(fault(xplane_points + "ANIM_end\n") == "wing.obj:13: expected ANIM_begin before ANIM_end, got none");
    CHECK_THAT(fault(xplane_points), Catch::Contains("expected at least one triangle, got none"));
    std::string deep = xplane_points;
    for (int i = 0; i < 200; ++i) { deep += "ANIM_begin\n"; }
    CHECK_THAT(fault(deep), Catch::Contains("expected animations at most 100 deep"));
    std::string bomb = xplane_points;
    for (int i = 0; i < 40; ++i) { bomb += "ANIM_begin\nANIM_trans 1e12 0 0\n"; }
    CHECK_THAT(fault(bomb + "TRIS 0 6\n"), Catch::Contains("expected vertices within bounds"));
}

TEST_CASE("a surface of YSFlight is turned into a right-handed one, with colours, glass and smooth vertices") {
    const TriangleMesh mesh = read_mesh(file_with("one.srf", srf));
    REQUIRE(mesh.triangles.size() == 2);
    CHECK(mesh.vertices_m[0] == glm::dvec3(1.0, 0.0, 2.0));
    CHECK(normal_of(mesh, mesh.triangles[0]).y == Approx(-1.0));
    CHECK(mesh.materials[mesh.triangle_materials[0]].colour == glm::vec3(1.0F, 0.0F, 0.0F));
    CHECK(mesh.materials[mesh.triangle_materials[1]].colour == glm::vec3(0.0F, 1.0F, 0.0F));
    CHECK(axes_of_format("one.srf")->text() == "left,up,forward");
    const MeshParts parts = read_parts(file_with("one.srf", srf), {});
    REQUIRE(parts.clear.triangles.size() == 1);
    CHECK(parts.clear.materials[parts.clear.triangle_materials[0]].opacity == Approx(0.6));
}

TEST_CASE("parts of a YSFlight model stand in their first state, hidden ones and flames are left out, rotors turn") {
    const std::string body = part("body", 0, "POS 0 0 0 0 0 0 1\nCNT 0 0 0\nNCH 1\nCLD \"gear\"\n");
    const std::string gear = part("gear", 0, "STA 0 0 0 0 0 0 0\nSTA 0 0 0 0 0 0 1\nPOS 0 -5 0 0 0 0 1\nCNT 0 0 0\n");
    const std::string flame = part("flame", 2, "POS 0 0 -50 0 0 0 1\n");
    const std::string rotor = part("rotor", 3, "POS 4 2 0 0 16384 0 1\nCNT 0 0 2\n");
    const auto file = file_with("plane.dnm", dnm(body + gear + flame + rotor));
    const TriangleMesh mesh = read_mesh(file);
    CHECK(mesh.triangles.size() == 4); // body and rotor
    CHECK(bounds_of(mesh).min_m.y > -2.0);
    CHECK(bounds_of(mesh).min_m.z > -3.0);
    const RotatingModel model = read_rotating_model(file, {});
    CHECK(model.body.triangles.size() == 1);
    CHECK(model.clear.triangles.size() == 1);
    REQUIRE(model.parts.size() == 2);
    const RotatingPart& shown_later = model.parts[0];
    CHECK(shown_later.about.turns_per_s == 0.0);
    CHECK_FALSE(is_shown_at_rest(shown_later.moves));
    CHECK(placed(shown_later, FlightControl::Gear, 1.0, {}) == glm::dvec3(0.0));
    CHECK(glm::length(model.parts[1].about.direction) == Approx(1.0));
    CHECK(model.parts[1].about.turns_per_s > 0.0);
}

TEST_CASE("surfaces and gear of a YSFlight model move between their states, and what they hold moves with them") {
    // The second state is nose up, and for ailerons a roll to the left.
    const std::string flap = part("elevator", 6,
        "POS 0 0 -8 0 0 0 1\nCNT 0 0 0\nSTA 0 0 0 0 0 0 1\n"
        "STA 0 0 0 0 8192 0 1\nSTA 0 0 0 0 -8192 0 1\nNCH 1\nCLD \"tab\"\n");
    const std::string tab = part("tab", 99, "POS 0 0 -1 0 0 0 1\nCNT 0 0 0\n");
    const std::string gear = part("gear", 0, "POS 0 0 0 0 0 0 1\nCNT 0 0 0\nSTA 0 0 0 0 0 0 1\nSTA 0 -2 0 0 0 0 1\n");
    const std::string body = part("body", 99, "POS 0 0 0 0 0 0 1\nCNT 0 0 0\n");
    const RotatingModel model = read_rotating_model(file_with("plane.dnm", dnm(body + flap + tab + gear)), {});
    REQUIRE(model.parts.size() == 3);
    // 8192 of 65536 is an eighth of a turn; the hinge lies at z = -8 and x leads to the left.
    const double half = std::sqrt(0.5);
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
        const glm::dvec3 up = placed(model.parts[i], FlightControl::Pitch, 1.0, {0.0, 0.0, -9.0});
        const glm::dvec3 down = placed(model.parts[i], FlightControl::Pitch, -1.0, {0.0, 0.0, -9.0});
        CHECK(std::abs(up.y) == Approx(half));
        CHECK(up.y == Approx(-down.y));
        CHECK(up.z == Approx(-8.0 - half));
    }
    CHECK(placed(model.parts[2], FlightControl::Gear, 1.0, {}).y == Approx(-2.0));
    CHECK(placed(model.parts[2], FlightControl::Gear, 0.5, {}).y == Approx(-1.0));
    CHECK(placed(model.parts[2], FlightControl::Gear, 0.1, {}).y == 0.0); // the doors open first
}

TEST_CASE("propellers, surfaces and gear of an X-Plane object move by their datarefs, all else rests") {
    const std::string object =
        "TRIS 0 3\n"
        "ANIM_begin\nANIM_trans 0 2 0 0 2 0 0 0 none\nANIM_rotate 0 0 1 0 360 0 360 "
        "sim/flightmodel2/engines/propeller_rotation_angle_deg[0]\nTRIS 3 3\nANIM_end\n"
        "ANIM_begin\nANIM_trans 5 0 0\nANIM_rotate_begin 1 0 0 sim/flightmodel2/wing/aileron1_deg[0]\n"
        "ANIM_rotate_key -20 -20\nANIM_rotate_key 20 40\nANIM_rotate_end\nTRIS 0 6\nANIM_end\n"
        "ANIM_begin\nANIM_hide 0 0.01 sim/flightmodel2/gear/deploy_ratio[1]\nTRIS 0 3\nANIM_end\n"
        "ANIM_begin\nANIM_rotate 0 0 1 0 360 0 360 sim/flightmodel2/gear/tire_rotation_angle_deg[0]\nTRIS 0 3\n"
        "ANIM_end\n";
    const auto file = file_with("plane.obj", xplane_start + xplane_points + object);
    const RotatingModel model = read_rotating_model(file, {});
    CHECK(model.body.triangles.size() == 2); // and the tyre
    REQUIRE(model.parts.size() == 3);
    CHECK(model.parts[0].about.turns_per_s == Approx(40.0));
    CHECK(model.parts[0].about.point_m == glm::dvec3(0.0, 2.0, 0.0));
    CHECK(model.parts[0].about.direction == glm::dvec3(0.0, 0.0, 1.0));
    // At rest between its keys it stands at 10 degrees; its dataref counts 20 degrees each way.
    const glm::dvec3 off = placed(model.parts[1], FlightControl::Roll, 1.0, {5.0, 1.0, 0.0});
    CHECK(std::atan2(off.z, off.y) == Approx(octant::rad_from_deg(30.0)));
    CHECK(placed(model.parts[1], FlightControl::Pitch, 1.0, {5.0, 1.0, 0.0}) == glm::dvec3(5.0, 1.0, 0.0));
    CHECK_FALSE(is_shown_at_rest(model.parts[2].moves));
    CHECK(placed(model.parts[2], FlightControl::Gear, 1.0, {1.0, 0.0, 0.0}).x == 1.0);
    CHECK(placed(model.parts[2], FlightControl::Gear, 0.0, {1.0, 0.0, 0.0}).x == 0.0);
    CHECK(read_mesh(file).triangles.size() == 5); // without the hidden gear
}

TEST_CASE("an aircraft of X-Plane has its objects at their places, without those of its interior") {
    const auto folder = file_with("plane.acf", "I\n1100 Version\nACF\nPROPERTIES_BEGIN\n"
                                               "P acf/_cgY -1.0\nP acf/_cgZ 4.0\n"
                                               "P _obja/0/_v10_att_file_stl body.obj\n"
                                               "P _obja/0/_v10_att_z_acf_prt_ref 10.0\n"
                                               "P _obja/0/_obj_flags 24\nP _obja/1/_v10_att_file_stl seats.obj\n"
                                               "P _obja/1/_obj_flags 29\nP _obja/2/_v10_att_file_stl lost.obj\n"
                                               "P _obja/2/_obj_flags 4\nPROPERTIES_END\n")
                            .parent_path();
    std::filesystem::create_directories(folder / "objects");
    for (const char* const name : {"body.obj", "seats.obj"}) {
        const auto object = file_with(name, xplane_start + xplane_points + "TRIS 0 6\n");
        std::filesystem::rename(object, folder / "objects" / name);
    }
    const TriangleMesh mesh = read_mesh(folder / "plane.acf");
    CHECK(mesh.triangles.size() == 2);
    CHECK(bounds_of(mesh).max_m.z == Approx(6.0 * 0.3048)); // from the centre of gravity
    CHECK(bounds_of(mesh).min_m.y == Approx(0.3048));
    REQUIRE(mesh.notes.size() == 2);
    CHECK_THAT(mesh.notes[0], Catch::Contains("lost.obj") && Catch::Contains("this object is left out"));
    CHECK_THAT(mesh.notes[1], Catch::Contains("1 objects of its interior are not read"));
    CHECK(axes_of_format("plane.acf")->text() == "right,up,back");
    CHECK(error_of("old.acf", "i\n800\nACF\n") ==
          "old.acf: expected an aircraft of X-Plane 10 or later, got one that Plane-Maker has to save anew");
    CHECK_THAT(error_of("older.acf", std::string("i\x0b\0\0", 4)), Catch::Contains("X-Plane 10 or later"));
    CHECK(error_of("bare.acf", "I\n1100 Version\nACF\n") ==
          "bare.acf: expected objects with surfaces in P _obja lines, got none");
}

TEST_CASE("faulty files of YSFlight are refused in one line, and parts that hold each other end") {
    CHECK(error_of("one.srf", "SURFACE\n") == "one.srf:1: expected SURF, got 'SURFACE'");
    CHECK(error_of("one.srf", "SURF\nV 0 0 x\n") == "one.srf:2: expected a number, got 'x'");
    CHECK(error_of("one.srf", "SURF\nF\nV 0 1 2\n") == "one.srf:3: expected vertices before a polygon, got none");
    CHECK(error_of("one.srf", "SURF\nV 0 0 0\nF\nV 0 1 2\n") ==
          "one.srf:4: expected the number of a vertex of 0 to 0, got '1'");
    CHECK_THAT(error_of("plane.dnm", "DYNAMODEL\nDNMVER 1\n"), Catch::Contains("expected a part (SRF), got none"));
    CHECK_THAT(error_of("plane.dnm", "DYNAMODEL\nPCK a\n"), Catch::Contains("expected PCK, a name and a number"));
    const std::string ring = part("a", 0, "CLD \"b\"\n") + part("b", 0, "CLD \"a\"\n");
    CHECK_THAT(error_of("plane.dnm", dnm(ring)), Catch::Contains("expected at least one triangle, got none"));
    const TriangleMesh missing =
        read_mesh(file_with("plane.dnm", dnm(part("a", 0, "") + "SRF \"b\"\nFIL none.srf\nCLA 0\nEND\n")));
    CHECK_THAT(missing.notes.back(), Catch::Contains("1 surfaces of its parts are missing, such as 'none.srf'"));
}

TEST_CASE("files of other kinds are named, with a program that converts them where there is one") {
    const auto fault = [](const std::string& name, const std::string& text) { return error_of(name, text); };
    CHECK(fault("plane.txt", xplane_start) ==
          "plane.txt: expected a mesh file, got an X-Plane object, whose name ends in .obj");
    CHECK(fault("plane.zip", "PK\x03\x04...") == "plane.zip: expected a mesh file, got a zip archive: unpack it first");
    CHECK_THAT(fault("plane.usdz", "x"), Catch::Contains("Blender writes it as glTF"));
    CHECK_THAT(fault("plane.foo", "x"), Catch::Contains("expected a mesh file (.obj, "));
}
