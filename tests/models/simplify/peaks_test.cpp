#include "models/measure/triangle_bvh.h"
#include "models/simplify/peaks.h"
#include "models/simplify/ring_heights.h"
#include "models/simplify/triangle_samples.h"
#include "tests/models/simplify/simplify_meshes.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <vector>

using namespace octant::models;
using namespace octant::models::simplify;
using namespace octant::tests;

TEST_CASE("the samples of a grid stand for a triangle's whole area, its middle in the balance") {
    for (const int fields : {1, 2, 5}) {
        double sum = 0.0;
        glm::dvec3 middle(0.0);
        for (const TriangleSample& sample : sample_grid(fields)) {
            sum += sample.share;
            middle += sample.share * sample.weights;
        }
        CHECK(sum == Approx(1.0));
        CHECK(glm::distance(middle, glm::dvec3(1.0 / 3.0)) < 1e-12);
    }
    CHECK(sample_grid(2).size() == 6);
}

TEST_CASE("heights keep the largest squared distance and weighted sums") {
    Heights heights;
    heights.add(4.0, 0.5);
    heights.add(1.0, 2.0);
    CHECK(heights.most2 == 4.0);
    CHECK(heights.squares == 4.0);
    CHECK(heights.powers == 0.5 * 256.0 + 2.0);
}

TEST_CASE("a vertex that stands out is drawn back to the surface") {
    const TriangleMesh flat = strip(4, 4);
    const WorkingUnits units = WorkingUnits::of(flat, 0.1);
    const TargetMesh target(flat, units);
    WorkingSurface surface(flat, units);
    TrackedPoints points(target, 1000);
    const measure::TriangleBvh bvh(target.places, flat.triangles);
    std::uint32_t inner = none;
    for (std::uint32_t v = 0; v < surface.mesh.vertex_slots(); ++v) {
        if (!surface.mesh.is_boundary_vertex(v)) {
            inner = v;
        }
    }
    REQUIRE(inner != none);
    surface.places[inner].z += 0.05;
    lower_peaks(surface, points, {target, bvh}, {});
    CHECK(std::abs(surface.places[inner].z) < 0.02);
}

TEST_CASE("large triangles are looked at closely") {
    const TriangleMesh fine = strip(8, 8);
    const TriangleMesh coarse = strip(1, 1);
    const WorkingUnits units = WorkingUnits::of(fine, 0.1);
    const TargetMesh target(fine, units);
    const WorkingSurface surface(coarse, units);
    TrackedPoints points(target, 1000);
    points.assign_all(std::vector<std::uint32_t>(points.size(), 0), surface.mesh.face_slots());
    const measure::TriangleBvh bvh(target.places, fine.triangles);
    RingHeights around(surface, points, {target, bvh}, {.of_all = 1'000});
    around.take_face(0);
    around.seen({});
    CHECK(around.samples().size() == sample_grid(16).size());
    RingHeights loosely(surface, points, {target, bvh});
    loosely.take_face(0);
    loosely.seen({});
    CHECK(loosely.samples().size() == sample_grid(8).size());
}
