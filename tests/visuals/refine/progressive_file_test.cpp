#include "sim/base/binary_file.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "tests/visuals/refine/front_check.h"
#include "tests/visuals/refine/made_sequence.h"
#include "visuals/refine/active_mesh.h"
#include "visuals/refine/progressive_file.h"
#include "visuals/refine/selective_refiner.h"

#include <catch2/catch.hpp>

#include <random>

using namespace octant;
using namespace octant::visuals::refine;
using namespace octant::visuals::refine::test;

namespace {

std::filesystem::path file(const std::string& name) { return tests::scratch_folder() / name; }

std::string fault_of(const std::filesystem::path& path) {
    try {
        read_progressive(path);
    } catch (const Error& fault) { return fault.what(); }
    return {};
}

NamedFaces all_faces(const ProgressiveMesh& mesh) {
    SelectiveRefiner refiner(std::make_shared<const ProgressiveMesh>(mesh));
    for (auto node = static_cast<std::uint32_t>(mesh.node_count()); node-- > mesh.leaf_count();) {
        refiner.split(node);
    }
    CHECK(manifold_fault(refiner).empty());
    return active_faces(refiner);
}

void check_same(const ProgressiveMesh& a, const ProgressiveMesh& b) {
    CHECK(a.parts().name == b.parts().name);
    CHECK(a.parts().origin_m == b.parts().origin_m);
    CHECK(a.full_data().positions_m == b.full_data().positions_m);
    CHECK(a.full_data().normals == b.full_data().normals);
    CHECK(a.full_data().colours == b.full_data().colours);
    CHECK(a.parts().faces == b.parts().faces);
    CHECK(a.parts().original_faces == b.parts().original_faces);
    CHECK(a.parts().face_materials == b.parts().face_materials);
    CHECK(a.parts().original_vertices == b.parts().original_vertices);
    REQUIRE(a.node_count() == b.node_count());
    for (auto node = static_cast<std::uint32_t>(a.leaf_count()); node < a.node_count(); ++node) {
        CHECK(a.split_of(node).first == b.split_of(node).first);
        CHECK(a.split_of(node).second == b.split_of(node).second);
        CHECK(a.split_of(node).left_face == b.split_of(node).left_face);
        CHECK(a.split_of(node).right_face == b.split_of(node).right_face);
        CHECK(a.error_m(node) == b.error_m(node));
    }
}

} // namespace

TEST_CASE("a file gives back what was written, face for face") {
    for (const auto& made : {made_sphere(3), made_torus(20, 8), made_ground(20, 4)}) {
        const ProgressiveMesh mesh(collapsed(made));
        write_progressive(file("whole.pm"), mesh);
        const ProgressiveMesh read = read_progressive(file("whole.pm"));
        CHECK(read.parts().notes.empty());
        check_same(mesh, read);
        CHECK(read.parts().materials.size() == made.materials.size());
        CHECK(all_faces(read) == all_faces(mesh));
    }
}

TEST_CASE("materials keep their opacity; a file of version 1 is read, all of it opaque") {
    models::TriangleMesh made = made_sphere(2);
    made.materials = {{.name = "grey"}, {.name = "glass", .colour = {0.2F, 0.4F, 1.0F}, .opacity = 0.3F}};
    made.triangle_materials.assign(made.triangles.size(), 0);
    for (std::size_t t = 0; t < made.triangles.size(); t += 3) { made.triangle_materials[t] = 1; }
    write_progressive(file("glass.pm"), ProgressiveMesh(collapsed(made)));
    const ProgressiveMesh read = read_progressive(file("glass.pm"));
    const models::TriangleMesh finest = finest_mesh(read);
    REQUIRE(finest.materials.size() == 2);
    CHECK(finest.materials[0].opacity == 1.0F);
    CHECK(finest.materials[1].opacity == 0.3F);
    CHECK(finest.materials[1].name == "glass");
    for (std::uint32_t face = 0; face < read.face_count(); ++face) {
        CHECK(finest.triangle_materials[face] == made.triangle_materials[read.original_face(face)]);
    }

    // A tetrahedron of two materials, written by the version before opacities.
    const auto old = from_base64(
        "T0NUUE0NChpUAAAAAQAAAPkAAAAAAAAABAAAAAAAAAAEAAAABAAAAAMAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAADdGV0AgAzMzM/MzMzPzMzM"
        "z8AMzMzPzMzMz8zMzM/kYAwksFhOKBxAAAAAAEAAAAAAAAAAAAAAACrqquqqqoAAFVVAQEAAIA/AAAAAAAAAAD/fwAAqqoAAFVVAgEAAAAAAA"
        "CAPwAAAAAAAP9/VVUAAKqqAwEAAAAAAAAAAAAAgD8AAAAAVVUAAKqqBAAEAgAAAgYAAAYEAQIEBgH19/krFFYhOwgAAAAAAgICBQICAulPZ6s"
        "2Hv9D");
    REQUIRE(old.has_value());
    write_file(file("old.pm"), *old);
    const models::TriangleMesh before = finest_mesh(read_progressive(file("old.pm")));
    CHECK(before.triangles.size() == 4);
    REQUIRE(before.materials.size() == 2);
    for (const models::Material& material : before.materials) { CHECK(material.opacity == 1.0F); }
}

TEST_CASE("fewer vertices are a coarser model, the one that the sequence went through") {
    const models::CollapseSequence sequence = collapsed(made_ground(40, 9));
    const ProgressiveMesh mesh(sequence);
    write_progressive(file("prefix.pm"), mesh);
    for (const std::size_t vertices : {100U, 513U, 1000U}) {
        const ProgressiveMesh coarse = read_progressive(file("prefix.pm"), vertices);
        CHECK(coarse.leaf_count() == vertices);
        CHECK(coarse.parts().notes.empty());
        const models::TriangleMesh expected = models::mesh_after(sequence, mesh.leaf_count() - vertices);
        CHECK(all_faces(coarse).size() == expected.triangles.size());
        CHECK(coarse.face_count() == expected.triangles.size());
    }
    CHECK(read_progressive(file("prefix.pm"), 0).leaf_count() == mesh.roots().size());
}

TEST_CASE("a file that was cut off is a coarser model with a note, or refused in its base") {
    const ProgressiveMesh mesh(collapsed(made_ground(40, 9)));
    write_progressive(file("all.pm"), mesh);
    const std::string bytes = read_file(file("all.pm"));
    std::size_t last = mesh.roots().size();
    int coarser = 0;
    for (std::size_t size = 0; size < bytes.size(); size += bytes.size() / 40) {
        write_file(file("cut.pm"), bytes.substr(0, size));
        const std::string fault = fault_of(file("cut.pm"));
        if (!fault.empty()) {
            CHECK(size < 400);
            CHECK_THAT(fault, Catch::Contains("cut.pm: at byte ") && Catch::Contains(": expected "));
            continue;
        }
        const ProgressiveMesh cut = read_progressive(file("cut.pm"));
        REQUIRE(cut.parts().notes.size() == 1);
        CHECK(cut.parts().notes[0].find("splits are whole") != std::string::npos);
        CHECK(finest_mesh(cut).notes == cut.parts().notes);
        CHECK(cut.leaf_count() >= last);
        last = cut.leaf_count();
        coarser += all_faces(cut).size() == cut.face_count() ? 1 : 0;
    }
    CHECK(last > 1000);
    CHECK(coarser > 30);
}

TEST_CASE("a thousand damaged files are refused in one line or are whole") {
    const ProgressiveMesh mesh(collapsed(made_ground(12, 1)));
    write_progressive(file("good.pm"), mesh);
    const std::string good = read_file(file("good.pm"));
    std::mt19937_64 numbers(7);
    int refused = 0;
    for (int i = 0; i < 1000; ++i) {
        std::string bytes = good;
        const std::size_t changes = 1 + numbers() % 4;
        for (std::size_t k = 0; k < changes; ++k) { bytes[numbers() % bytes.size()] = static_cast<char>(numbers()); }
        if (numbers() % 8 == 0) { bytes.insert(numbers() % bytes.size(), 1, '\0'); }
        write_file(file("bad.pm"), bytes);
        const std::string fault = fault_of(file("bad.pm"));
        refused += fault.empty() ? 0 : 1;
        CHECK((bytes == good || !fault.empty() || bytes.size() <= good.size()));
        CHECK(fault.find('\n') == std::string::npos);
    }
    CHECK(refused > 950);
}

TEST_CASE("what is no progressive mesh, too long or of another version is refused") {
    write_file(file("text.pm"), "solid nothing");
    CHECK(fault_of(file("text.pm")).find("expected a progressive mesh") != std::string::npos);
    CHECK(fault_of(file("none.pm")).find("expected a file, found none") != std::string::npos);
    write_progressive(file("long.pm"), ProgressiveMesh(collapsed(made_sphere(1))));
    write_file(file("longer.pm"), read_file(file("long.pm")) + "x");
    CHECK(fault_of(file("longer.pm")).find("bytes, got") != std::string::npos);
}

TEST_CASE("a file takes fewer than 70 bytes a vertex") {
    const ProgressiveMesh mesh(collapsed(made_torus(60, 30)));
    write_progressive(file("size.pm"), mesh);
    CHECK(std::filesystem::file_size(file("size.pm")) < 70 * mesh.leaf_count());
}
