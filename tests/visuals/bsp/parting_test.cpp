#include "sim/base/random_generator.h"
#include "visuals/bsp/partial_bsp_tree.h"
#include "visuals/bsp/polygon_pieces.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <span>

using namespace octant;
using namespace octant::visuals::bsp;
using models::polygons::PolygonModel;

namespace {

using Outline = std::vector<glm::dvec3>;

PolygonModel model_of(const std::vector<Outline>& outlines) {
    PolygonModel model;
    model.materials.emplace_back();
    model.parts.emplace_back("all");
    for (const Outline& outline : outlines) {
        models::polygons::Polygon polygon;
        polygon.first_corner = static_cast<std::uint32_t>(model.corner_vertices.size());
        polygon.corner_count = static_cast<std::uint32_t>(outline.size());
        for (const glm::dvec3& corner : outline) {
            const auto known = std::ranges::find(model.vertices_m, corner);
            model.corner_vertices.push_back(static_cast<std::uint32_t>(known - model.vertices_m.begin()));
            if (known == model.vertices_m.end()) { model.vertices_m.push_back(corner); }
        }
        model.polygons.push_back(polygon);
    }
    return model;
}

/// A square across z, seen from +z.
Outline square(double z, double from_x = 0.0, double size = 1.0) {
    return {{from_x, 0, z}, {from_x + size, 0, z}, {from_x + size, size, z}, {from_x, size, z}};
}

/// A square across y, through the middle of square(0).
Outline upright() { return {{0, 0.5, -0.5}, {1, 0.5, -0.5}, {1, 0.5, 0.5}, {0, 0.5, 0.5}}; }

std::vector<std::uint32_t> all_of(const PolygonPieces& pieces) {
    std::vector<std::uint32_t> items(pieces.count());
    std::iota(items.begin(), items.end(), 0U);
    return items;
}

/// The shell of a ball as `around` times `across` quads and triangles, seen from outside.
PolygonModel ball(int around, int across) {
    std::vector<Outline> outlines;
    const auto at = [&](int i, int j) {
        const double up = 3.14159265358979 * j / across;
        const double turn = 2.0 * 3.14159265358979 * (i % around) / around;
        return glm::dvec3(std::sin(up) * std::cos(turn), std::sin(up) * std::sin(turn), std::cos(up));
    };
    for (int i = 0; i < around; ++i) {
        for (int j = 1; j + 1 < across; ++j) {
            outlines.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
        }
    }
    return model_of(outlines);
}

/// Polygons of 3 to 8 corners here and there, some of them in one plane.
PolygonModel scattered(int count) {
    RandomGenerator dice(7);
    std::vector<Outline> outlines;
    for (int i = 0; i < count; ++i) {
        const int corners = 3 + i % 6;
        const glm::dvec3 across = i % 4 == 0 ? glm::dvec3(0.0, 0.0, 1.0) : glm::normalize(dice.direction());
        const glm::dvec3 right = glm::normalize(glm::cross(across, {0.6, 0.0, 0.8}));
        const glm::dvec3 up = glm::cross(across, right);
        const glm::dvec3 middle{dice.between(-2, 2), dice.between(-2, 2), 1.0 * (i % 3)};
        Outline& outline = outlines.emplace_back();
        for (int k = 0; k < corners; ++k) {
            const double turn = 2.0 * 3.14159265358979 * k / corners;
            outline.push_back(middle + right * std::cos(turn) + up * std::sin(turn));
        }
    }
    return model_of(outlines);
}

} // namespace

TEST_CASE("clusters in painting order never hide one painted later, pair by pair") {
    std::size_t max_clusters = 0;
    for (const int count : {8, 12, 20, 70, 150}) {
        PolygonPieces pieces(scattered(count));
        const std::vector<glm::dvec3> around{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0.4}, {-1, 1, 0.4}};
        pieces.set_swept_hull(5, 0, around, true); // a body
        pieces.set_swept_hull(6, 1, around, false);
        const auto found = occlusion_components(pieces, all_of(pieces));
        max_clusters = std::max(max_clusters, found.size());
        std::vector<std::size_t> cluster_of(pieces.count(), found.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            for (const std::uint32_t piece : found[i]) { cluster_of[piece] = i; }
        }
        for (std::uint32_t occluder = 0; occluder < pieces.count(); ++occluder) {
            REQUIRE(cluster_of[occluder] < found.size());
            for (std::uint32_t far_one = 0; far_one < pieces.count(); ++far_one) {
                if (occluder != far_one && occludes(pieces, occluder, far_one)) {
                    REQUIRE(cluster_of[far_one] <= cluster_of[occluder]);
                }
            }
        }
    }
    CHECK(max_clusters > 1);
}

TEST_CASE("a cut shares its corners with the other piece and with neighbours along the edge") {
    PolygonModel model = model_of({square(0), square(0, 1.0)});
    PolygonPieces pieces(model);
    const Plane plane{{0, 1, 0}, 0.0};
    CHECK(pieces.cut(0, plane) == 2);
    CHECK(pieces.sides_reached(0, plane).before);
    CHECK_FALSE(pieces.sides_reached(0, plane).behind);
    CHECK(pieces[2].plane == pieces[0].plane);
    pieces.write_to(model);
    CHECK(model.polygons.size() == 3);
    CHECK(model.parents == std::vector<std::uint32_t>{0, 1, 0});
    CHECK(model.polygons[0].corner_count == 4);
    CHECK(model.polygons[1].corner_count == 5); // the cut meets its left side
    CHECK(model.vertices_m.size() == 8);
    CHECK(glm::distance(model.vertices_m.back(), glm::dvec3(0, 0.5, 0)) +
              glm::distance(model.vertices_m[6], glm::dvec3(1, 0.5, 0)) <
          1e-12);
}

TEST_CASE("nothing is written where nothing was cut") {
    PolygonModel model = model_of({square(0), square(1)});
    const PolygonModel before = model;
    PolygonPieces(model).write_to(model);
    CHECK(model.vertices_m == before.vertices_m);
    CHECK(model.corner_vertices == before.corner_vertices);
    CHECK(model.parents.empty());
}

TEST_CASE("cuts that cross one another leave no corner of a neighbour out") {
    PolygonModel model = model_of({square(0)});
    PolygonPieces pieces(model);
    const std::uint32_t left = pieces.cut(0, {{1, 0, 0}, 0.0});
    pieces.cut(0, {{0, 1, 0}, 0.0}); // ends in the middle of the first cut
    pieces.write_to(model);
    CHECK(model.polygons[left].corner_count == 5);
}

TEST_CASE("a bent polygon becomes triangles") {
    Outline bent = square(0);
    bent[2].z = 0.1;
    PolygonModel model = model_of({bent, square(1)});
    const PolygonPieces pieces(model);
    CHECK(pieces.count() == 3);
    CHECK(pieces[2].source == 0);
    CHECK(pieces[0].corners.size() == 3);
}

TEST_CASE("plates that face one way hide one another in one direction only") {
    const PolygonPieces pieces(model_of({square(0), square(1), upright()}));
    CHECK(occludes(pieces, 1, 0));
    CHECK_FALSE(occludes(pieces, 0, 1));
    CHECK(occludes(pieces, 0, 2)); // they cross
    CHECK(occludes(pieces, 2, 0));
    const std::vector<std::uint32_t> plates{0, 1};
    CHECK(occlusion_components(pieces, plates) == std::vector<std::vector<std::uint32_t>>{{0}, {1}});
    const auto all = occlusion_components(pieces, all_of(pieces));
    CHECK(all == std::vector<std::vector<std::uint32_t>>{{0, 2}, {1}});
}

TEST_CASE("of overlapping polygons in one plane the later one of the file is painted later") {
    const PolygonPieces pieces(model_of({square(0), square(0, 0.2, 0.5), square(0, 1.0)}));
    CHECK(occludes(pieces, 1, 0));
    CHECK_FALSE(occludes(pieces, 0, 1));
    CHECK_FALSE(occludes(pieces, 2, 0)); // they only touch
    CHECK_FALSE(occludes(pieces, 0, 2));
}

TEST_CASE("a convex shell is one list without a cut, however many polygons it has") {
    PolygonPieces pieces(ball(30, 32));
    const PartialBspTree tree = partial_bsp_tree(pieces, all_of(pieces));
    CHECK(tree.lists.size() == 1);
    CHECK(tree.root == ~0);
    PolygonPieces larger(ball(60, 62)); // 3,600 polygons, parted before their graphs are looked at
    const PartialBspTree parted = partial_bsp_tree(larger, all_of(larger));
    CHECK(larger.added() < 500);
    std::size_t listed = 0;
    for (const auto& list : parted.lists) { listed += list.size(); }
    CHECK(listed == larger.count());
    CHECK(parted.depth < 40);
}

TEST_CASE("plates that pass through one another are cut once") {
    PolygonPieces pieces(model_of({square(0), upright()}));
    const PartialBspTree tree = partial_bsp_tree(pieces, all_of(pieces));
    CHECK(pieces.added() == 1);
    std::multiset<std::uint32_t> listed;
    for (const auto& list : tree.lists) { listed.insert(list.begin(), list.end()); }
    CHECK(listed == std::multiset<std::uint32_t>{0, 1, 2});
    CHECK(tree.unsplit_cycles.empty());
}

TEST_CASE("what a turning polygon sweeps is never cut, and what it meets is told of") {
    PolygonModel model = model_of({square(0), square(3), square(0.5)});
    PolygonPieces pieces(model);
    const std::vector<glm::dvec3> around{
        {-1, -1, -0.2}, {2, -1, -0.2}, {2, 2, 0.2}, {-1, 2, 0.2}, {0, 0, 0.2}, {0, 0, -0.2}};
    pieces.set_swept_hull(0, 0, around, true);
    const PartialBspTree tree = partial_bsp_tree(pieces, all_of(pieces));
    CHECK(pieces.added() == 0);
    CHECK(tree.unsplit_cycles.empty());
    PolygonPieces met(model_of({square(0), upright()}));
    met.set_swept_hull(0, 0, around, true);
    CHECK(partial_bsp_tree(met, all_of(met)).unsplit_cycles.size() == 1);
}
