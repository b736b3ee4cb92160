#include "tests/visuals/terrain/ground_check.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

using namespace octant::visuals::terrain;
using namespace octant::visuals::terrain::test;

namespace {

/// What small moves of the eye do to the ground as drawn.
struct Moves {
    double largest_m = 0.0; ///< of the ground at any sample, in one move
    int vertices = 0;       ///< that came or went
};

Moves moves_of(ErrorGround& ground, const ErrorTarget& wanted) {
    constexpr double move_m = 0.01;
    MeshView view;
    view.earth_radius_m = 0.0;
    Moves moves;
    std::vector<double> before_m;
    std::size_t vertices = 0;
    for (int frame = 0; frame < 200; ++frame) {
        view.eye_m = {-20.0 + move_m * frame, 13.0 - 0.5 * move_m * frame, 8.0 + 0.3 * move_m * frame};
        const GroundMesh mesh = ground.mesher.mesh(view, wanted);
        const auto after_m = drawn_heights_m(mesh, ground.field, {0.0, 0.0, view.eye_m.z});
        for (std::size_t k = 0; k < before_m.size(); ++k) {
            moves.largest_m = std::max(moves.largest_m, std::abs(after_m[k] - before_m[k]));
        }
        moves.vertices += frame > 0 && mesh.vertices.size() != vertices ? 1 : 0;
        vertices = mesh.vertices.size();
        before_m = after_m;
    }
    return moves;
}

octant::models::heights::HeightField stretched(const octant::models::heights::HeightField& field, float times) {
    std::vector<float> heights_m;
    for (int row = 0; row < field.rows(); ++row) {
        for (int column = 0; column < field.columns(); ++column) {
            heights_m.push_back(times * field.height_m(column, row));
        }
    }
    return {field.columns(), field.rows(), field.spacing_m(), std::move(heights_m)};
}

} // namespace

TEST_CASE("with geomorphs the ground moves no faster than the eye lets it, least on rugged ground") {
    struct Ground {
        float height;   ///< times that of rough_field
        double fastest; ///< in wanted errors for a move by the whole distance
    };

    for (const Ground& of : {Ground{1.0F, 11.0}, Ground{200.0F, 6.5}}) {
        for (const int size : {65, 129}) {
            const double height = static_cast<double>(of.height);
            INFO(size << " samples, " << height << " times as high");
            ErrorGround ground(stretched(rough_field(size, size, 4), of.height));
            const double error_px = 4.0 * height;
            const auto max_m = [&](double px) { return of.fastest * 0.01 * px / 869.1 + 2e-5 * height; };
            const Moves smooth = moves_of(ground, {error_px, 1'000'000, true});
            CHECK(smooth.vertices > 30);
            CHECK(smooth.largest_m < max_m(error_px));
            if (size > 65) { continue; }
            const Moves jumping = moves_of(ground, {error_px, unlimited_triangles, false});
            CHECK(jumping.largest_m > 50.0 * smooth.largest_m);
            // Without a budget an error below full_margin_px moves as many pixels as that one.
            const Moves steady = moves_of(ground, {error_px, unlimited_triangles, true});
            CHECK(steady.largest_m < max_m(std::max(error_px, full_margin_px)));
        }
    }
}

TEST_CASE("vertices are between the middle of their ends and their samples by their weight") {
    int between = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        Numbers numbers(seed);
        ErrorGround ground(any_field({65, 65}, numbers));
        MeshView view = any_view(numbers, ground.field);
        view.earth_radius_m = 0.0;
        const GroundMesh mesh = ground.mesher.mesh(view, {any_error_px(numbers), 2000, true});
        for (std::size_t k = 0; k < mesh.vertices.size(); ++k) {
            const VertexMorph& origin = mesh.morphs[k];
            REQUIRE((origin.weight >= 0.0F && origin.weight <= 1.0F));
            if (origin.parent_a == k) {
                CHECK(origin.parent_b == k);
                CHECK(origin.weight == 1.0F);
                continue;
            }
            REQUIRE((origin.parent_a < k && origin.parent_b < k));
            const VertexMorph& a = mesh.morphs[origin.parent_a];
            const VertexMorph& b = mesh.morphs[origin.parent_b];
            REQUIRE(a.column + b.column == 2 * origin.column);
            REQUIRE(a.row + b.row == 2 * origin.row);
            const auto z_m = [&](std::size_t vertex) {
                return static_cast<double>(mesh.vertices[vertex].position_m.z) + view.eye_m.z;
            };
            const double middle_m = 0.5 * (z_m(origin.parent_a) + z_m(origin.parent_b));
            const double sample_m = static_cast<double>(ground.field.height_m(origin.column, origin.row));
            const double weight = static_cast<double>(origin.weight);
            CHECK(z_m(k) == Approx(middle_m + weight * (sample_m - middle_m)).margin(1e-4));
            between += origin.weight > 0.0F && origin.weight < 1.0F ? 1 : 0;
        }
    }
    CHECK(between > 1000);
}

TEST_CASE("without geomorphs all vertices are at their samples, with them the mesh is the same") {
    Numbers numbers(8);
    ErrorGround ground(rough_field(100, 70, 3));
    const MeshView view = any_view(numbers, ground.field);
    const MeshCopy rigid(ground.mesher.mesh(view, {3.0, unlimited_triangles, false}));
    CHECK(std::all_of(
        rigid.morphs.begin(), rigid.morphs.end(), [](const VertexMorph& origin) { return origin.weight == 1.0F; }));
    MeshView whole = view;
    whole.frustum_normals.fill(glm::dvec3(0.0));
    const MeshCopy all_rigid(ground.mesher.mesh(whole, {3.0, unlimited_triangles, false}));
    const MeshCopy all_morphed(ground.mesher.mesh(whole, {3.0, unlimited_triangles, true}));
    CHECK(all_rigid.indices == all_morphed.indices);
}

TEST_CASE("the ground at the border of fields of any size moves as slowly as within") {
    // The wanted error grows by a share a frame. A vertex that bends the ground when it comes or goes moves it 18 to 38
    // times as far in metres per pixel of that error.
    constexpr double growth = 1.002;
    constexpr double max_m_for_a_pixel = 0.002;
    for (const auto& [columns, rows] : {std::pair{52, 37}, {65, 50}, {40, 65}, {100, 70}, {65, 65}}) {
        INFO(columns << " x " << rows);
        ErrorGround ground(stretched(rough_field(columns, rows, 4), 3.0F));
        MeshView view;
        view.earth_radius_m = 0.0;
        view.eye_m = {-20.0, 13.0, 8.0};
        double error_px = 24.0;
        double largest_m_for_a_pixel = 0.0;
        int came_or_went = 0;
        std::size_t vertices = 0;
        std::vector<double> before_m;
        for (int frame = 0; frame < 150; ++frame) {
            error_px *= growth;
            const GroundMesh mesh = ground.mesher.mesh(view, {error_px, 1'000'000, true});
            const auto after_m = drawn_heights_m(mesh, ground.field, {0.0, 0.0, view.eye_m.z});
            for (std::size_t k = 0; k < before_m.size(); ++k) {
                largest_m_for_a_pixel = std::max(largest_m_for_a_pixel, std::abs(after_m[k] - before_m[k]) / error_px);
            }
            came_or_went += frame > 0 && mesh.vertices.size() != vertices ? 1 : 0;
            vertices = mesh.vertices.size();
            before_m = after_m;
        }
        CHECK(came_or_went > 50);
        CHECK(largest_m_for_a_pixel < max_m_for_a_pixel);
    }
}
