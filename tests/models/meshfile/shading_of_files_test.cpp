#include "models/meshfile/mesh_file.h"
#include "models/smooth_normals.h"
#include "tests/models/meshfile/mesh_samples.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

using namespace octant::models;
using namespace octant::models::meshfile;
using namespace octant::models::meshfile::test;

namespace {

const std::filesystem::path shading_samples = std::filesystem::path(OCTANT_SOURCE_DIR) / "tests" / "data" / "aircraft";

/// How many corners have the normal of their own triangle, and of how many corners in all.
std::pair<std::size_t, std::size_t> flat_corners(const TriangleMesh& mesh) {
    std::size_t flat = 0;
    for (std::size_t t = 0; t < mesh.corner_normals.size(); ++t) {
        const glm::dvec3 own = normal_of(mesh, mesh.triangles[t]);
        for (const std::uint32_t normal : mesh.corner_normals[t]) {
            flat += glm::dot(own, glm::dvec3(mesh.normals[normal])) > 0.9999 ? 1U : 0U;
        }
    }
    return {flat, 3 * mesh.corner_normals.size()};
}

/// The squares of a box of so many squares a side, their corners numbered from 0, and their normals. Squares of
/// different sides share the vertices of edges.
struct SquaredBox {
    std::vector<glm::ivec3> vertices;
    std::vector<std::array<std::size_t, 4>> squares;
    std::vector<glm::ivec3> normals; ///< of the squares
};

SquaredBox squared_box(int count) {
    SquaredBox box;
    std::map<std::tuple<int, int, int>, std::size_t> known;
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2;
        const bool far = side % 2 == 1;
        for (int i = 0; i < count * count; ++i) {
            const std::array<std::array<int, 2>, 4> round{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
            std::array<std::size_t, 4>& square = box.squares.emplace_back();
            for (std::size_t k = 0; k < 4; ++k) {
                glm::ivec3 at(0);
                at[axis] = far ? count : 0;
                at[(axis + 1) % 3] = i % count + round.at(k)[0];
                at[(axis + 2) % 3] = i / count + round.at(k)[1];
                const auto [place, is_new] = known.try_emplace({at.x, at.y, at.z}, box.vertices.size());
                if (is_new) { box.vertices.push_back(at); }
                square.at(far ? k : 3 - k) = place->second;
            }
            box.normals.emplace_back(0);
            box.normals.back()[axis] = far ? 1 : -1;
        }
    }
    return box;
}

std::string ac3d_box(const std::string& surface_flags, const std::string& crease) {
    const SquaredBox box = squared_box(8);
    std::string text = "AC3Db\nMATERIAL \"grey\" rgb 0.7 0.7 0.7 amb 0.2 0.2 0.2 emis 0 0 0 spec 0 0 0 shi 0 trans 0\n"
                       "OBJECT world\nkids 1\nOBJECT poly\n" +
                       crease + "numvert " + std::to_string(box.vertices.size()) + "\n";
    for (const glm::ivec3& at : box.vertices) {
        text += std::to_string(at.x) + " " + std::to_string(at.y) + " " + std::to_string(at.z) + "\n";
    }
    text += "numsurf " + std::to_string(box.squares.size()) + "\n";
    for (const auto& square : box.squares) {
        text += "SURF " + surface_flags + "\nmat 0\nrefs 4\n";
        for (const std::size_t corner : square) { text += std::to_string(corner) + " 0 0\n"; }
    }
    return text + "kids 0\n";
}

std::string obj_box(bool has_normals) {
    const SquaredBox box = squared_box(20);
    std::string text;
    for (const glm::ivec3& at : box.vertices) {
        text += "v " + std::to_string(at.x) + " " + std::to_string(at.y) + " " + std::to_string(at.z) + "\n";
    }
    for (std::size_t i = 0; i < box.squares.size(); ++i) {
        const glm::ivec3& n = box.normals[i];
        const std::string normal = std::to_string(i + 1);
        if (has_normals) {
            text += "vn " + std::to_string(n.x) + " " + std::to_string(n.y) + " " + std::to_string(n.z) + "\n";
        }
        text += "f";
        for (const std::size_t corner : box.squares[i]) {
            text += " " + std::to_string(corner + 1) + (has_normals ? "//" + normal : "");
        }
        text += "\n";
    }
    return text;
}

/// Two squares that meet at a right angle along z.
const std::string bent_obj = "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 1 -1 0\nv 1 -1 1\n";
const std::string bent_faces = "f 1 4 3 2\nf 2 3 6 5\n";

} // namespace

TEST_CASE("flat surfaces of AC3D keep the normals of their polygons, smooth ones bend up to the crease angle") {
    const auto [flat, all] = flat_corners(read_mesh(file_with("box.ac", ac3d_box("0x0", ""))));
    CHECK(all > 1000);
    CHECK(flat == all);
    const auto [by_45, all_by_45] = flat_corners(read_mesh(file_with("box.ac", ac3d_box("0x10", "crease 45\n"))));
    CHECK(by_45 == all_by_45); // boxes bend by 90 degrees
    const auto [by_default, all_by_default] = flat_corners(read_mesh(file_with("box.ac", ac3d_box("0x10", ""))));
    CHECK(by_default == all_by_default);
    const auto [by_180, all_by_180] = flat_corners(read_mesh(file_with("box.ac", ac3d_box("0x10", "crease 180\n"))));
    CHECK(by_180 < all_by_180);
}

TEST_CASE("normals of OBJ files are theirs, without any there are none") {
    const auto [flat, all] = flat_corners(read_mesh(file_with("box.obj", obj_box(true))));
    CHECK(all > 10'000);
    CHECK(flat == all);
    CHECK(read_mesh(file_with("box.obj", obj_box(false))).corner_normals.empty());
}

TEST_CASE("smoothing groups of OBJ files tell flat from smooth polygons") {
    const auto corners_of = [](const std::string& group) {
        return flat_corners(read_mesh(file_with("bent.obj", bent_obj + group + bent_faces)));
    };
    CHECK(corners_of("s off\n") == std::pair<std::size_t, std::size_t>(12, 12));
    CHECK(corners_of("s 0\n") == std::pair<std::size_t, std::size_t>(12, 12));
    CHECK(corners_of("s 1\n").first == 6);
    CHECK(corners_of("s on\n").first == 6);
    const auto two_groups =
        flat_corners(read_mesh(file_with("bent.obj", bent_obj + "s 1\nf 1 4 3 2\ns 2\nf 2 3 6 5\n")));
    CHECK(two_groups.first == 12);
    const TriangleMesh smooth = read_mesh(file_with("bent.obj", bent_obj + "s 1\n" + bent_faces));
    bool has_bisector = false;
    for (const glm::vec3& normal : smooth.normals) {
        has_bisector = has_bisector || glm::distance(normal, glm::vec3(0.70710678F, 0.70710678F, 0.0F)) < 1e-5F;
    }
    CHECK(has_bisector);
}

TEST_CASE("glTF without normals is flat") {
    const TriangleMesh mesh = read_mesh(shading_samples / "nose-x.glb");
    const auto [flat, all] = flat_corners(mesh);
    CHECK(all == 3 * mesh.triangles.size());
    CHECK(flat == all);
}

TEST_CASE("a vertex of very many triangles gets one normal, quickly") {
    std::string fan = "v 0 0 1\n";
    constexpr int count = 20'000;
    for (int i = 0; i < count; ++i) {
        const double angle = 6.283185307179586 * i / count;
        fan += "v " + std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " 0\n";
    }
    fan += "s 1\n";
    for (int i = 0; i < count; ++i) {
        fan += "f 1 " + std::to_string(i + 2) + " " + std::to_string((i + 1) % count + 2) + "\n";
    }
    const TriangleMesh mesh = read_mesh(file_with("fan.obj", fan));
    CHECK(glm::distance(mesh.normals[mesh.corner_normals[0][0]], glm::vec3(0.0F, 0.0F, 1.0F)) < 1e-4F);
}

TEST_CASE("faces that share one edge are compared at most twice in pairs, and all of them are neighbours") {
    constexpr std::uint32_t count = 300;
    std::vector<glm::dvec3> vertices_m{{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i < count; ++i) { // runs along the edge upwards and downwards by turns
        const double angle_rad = 3.0 * i / count;
        vertices_m.emplace_back(std::cos(angle_rad), std::sin(angle_rad), 0.5);
        triangles.push_back(i % 2 == 0 ? Triangle{0, 1, i + 2} : Triangle{1, 0, i + 2});
    }
    std::vector<SmoothFace> faces;
    for (const Triangle& triangle : triangles) {
        const glm::dvec3 along_m = vertices_m[triangle[1]] - vertices_m[triangle[0]];
        const glm::dvec3 normal =
            glm::normalize(glm::cross(along_m, vertices_m[triangle[2]] - vertices_m[triangle[0]]));
        faces.push_back({triangle, normal, {Smoothing::flat + 1}});
    }
    std::size_t compared = 0;
    const std::vector<glm::vec3> normals = smooth_normals(faces, vertices_m, &compared);
    CHECK(compared > 0);
    CHECK(compared <= std::size_t{2} * 2 * count * count + 2 * count); // two vertices of all faces
    for (std::uint32_t i = 0; i < count; ++i) { CHECK(normals[3 * i] == normals[i % 2 == 0 ? 0 : 3]); }
    CHECK(normals[0] == normals[4]); // both at the vertex of number 0
}

TEST_CASE("blades of a FlightGear rotor stand around it by their numbers") {
    const TriangleMesh mesh = read_mesh(shading_samples / "rotor" / "heli.xml");
    const BoundingBox bounds = bounds_of(mesh);
    CHECK(bounds.max_m.y - bounds.min_m.y == Approx(10.4).margin(0.2)); // not 2, as of three blades in one place
    const RotatingModel model = read_rotating_model(shading_samples / "rotor" / "heli.xml", {});
    REQUIRE(model.parts.size() == 1);
    CHECK(model.parts[0].mesh.triangles.size() == 36);
    CHECK(model.parts[0].about.direction == glm::dvec3(0.0, 0.0, 1.0));
}

TEST_CASE("what an aircraft's own file states of properties decides what is shown and where it stands") {
    file_with("tank.ac", ac3d_square("0x0", "tank"));
    file_with("body.ac", ac3d_square("0x0", "body"));
    file_with("stated.xml", "<PropertyList><path>tank.ac</path>"
                            "<animation><type>select</type><object-name>tank</object-name><condition><equals>"
                            "<property>/sim/fit</property><value>ferry</value></equals></condition></animation>"
                            "<animation><type>translate</type><object-name>tank</object-name>"
                            "<property>sim/shift[1]/m</property><factor>2</factor>"
                            "<axis><x>1</x><y>0</y><z>0</z></axis></animation>"
                            "<model><name>always</name><path>body.ac</path></model></PropertyList>");
    const auto set_file = [](const std::string& properties) {
        return file_with("stated-set.xml",
            "<PropertyList><sim><model><path>stated.xml</path></model>" + properties + "</sim></PropertyList>");
    };
    CHECK(read_mesh(set_file("<fit>short</fit>")).triangles.size() == 2);
    const TriangleMesh mesh = read_mesh(set_file("<fit>ferry</fit><shift n=\"1\"><m>5</m></shift>"));
    REQUIRE(mesh.triangles.size() == 4);
    CHECK(bounds_of(mesh).max_m.x == Approx(11.0));
}
