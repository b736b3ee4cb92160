#include "visuals/nature/detailed_ground.h"
#include "visuals/nature/scenery.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

using namespace octant;
using namespace octant::visuals::nature;
using models::ColourVertex;

namespace {

constexpr int cells = 8;
constexpr double spacing_m = 30.0;

/// Samples of a rough field; triangles of whole cells or of blocks of `block` cells a side.
struct Field {
    std::vector<ColourVertex> vertices;
    std::vector<std::uint32_t> indices;

    Field(const glm::dvec3& eye_m, int block, double roughness_m) {
        for (int row = 0; row <= cells; ++row) {
            for (int column = 0; column <= cells; ++column) {
                const double height_m = roughness_m * std::sin(1.7 * column + 0.6 * row);
                const glm::dvec3 at_m(column * spacing_m, row * spacing_m, height_m);
                vertices.push_back({glm::vec3(at_m - eye_m), 0xff808080U});
            }
        }
        for (int row = 0; row < cells; row += block) {
            for (int column = 0; column < cells; column += block) {
                const auto at = [&](int i, int j) {
                    return static_cast<std::uint32_t>((row + block * j) * (cells + 1) + column + block * i);
                };
                indices.insert(indices.end(), {at(0, 0), at(1, 0), at(1, 1)});
                indices.insert(indices.end(), {at(0, 0), at(1, 1), at(0, 1)});
            }
        }
    }

    visuals::terrain::GroundMesh mesh() const {
        visuals::terrain::GroundMesh mesh;
        mesh.vertices = vertices;
        mesh.indices = indices;
        return mesh;
    }
};

/// Detail for the field, on which so much stands.
struct FieldDetail {
    GroundDecorations decorations;
    DetailedGround ground;

    explicit FieldDetail(const SceneryDensity& density) {
        decorations.push_back(scenery_decoration({glm::dvec2(0.0), glm::ivec2(cells + 1), spacing_m, Daylight({}),
            [density](int, int) { return density; }, false}));
    }

    DetailedGround::Triangles detailed_mesh(
        const visuals::terrain::GroundMesh& mesh, const NearDetailView& view, const NearDetailOptions& detail) {
        return ground.detailed_mesh(mesh, view, detail, decorations);
    }
};

NearDetailView view_from(const glm::dvec3& eye_m) {
    return {eye_m, spacing_m, visuals::terrain::PaintOrder::BackToFront,
        {glm::vec3(0.0F), glm::vec3(0.0F), glm::vec3(0.0F), glm::vec3(0.0F)}, 100000, 100000};
}

const glm::dvec3 low_eye_m(101.0, 87.0, 14.0);
constexpr NearDetailOptions fine_only{true, false};
constexpr NearDetailOptions scenery_only{false, true};

float signed_area2(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

} // namespace

TEST_CASE("detail gives no cracks: every inner edge belongs to two triangles") {
    const Field field(low_eye_m, 1, 6.0);
    FieldDetail near({});
    const auto detailed_mesh = near.detailed_mesh(field.mesh(), view_from(low_eye_m), fine_only);
    CHECK(detailed_mesh.indices.size() > 2 * field.indices.size());
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    for (std::size_t i = 0; i < detailed_mesh.indices.size(); i += 3) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = detailed_mesh.indices[i + k];
            const std::uint32_t to = detailed_mesh.indices[i + (k + 1) % 3];
            ++uses[std::minmax(from, to)];
        }
    }
    for (const auto& [edge, count] : uses) {
        const glm::dvec3 middle = 0.5 * glm::dvec3(detailed_mesh.vertices[edge.first].position_m +
                                                   detailed_mesh.vertices[edge.second].position_m) +
                                  low_eye_m;
        const double end_m = cells * spacing_m;
        const bool border = std::min({middle.x, middle.y, end_m - middle.x, end_m - middle.y}) < 0.01;
        REQUIRE(count == (border ? 1 : 2));
    }
}

TEST_CASE("detail keeps samples, turns no triangle over and covers the same ground") {
    const Field field(low_eye_m, 1, 6.0);
    FieldDetail near({});
    const auto detailed_mesh = near.detailed_mesh(field.mesh(), view_from(low_eye_m), fine_only);
    for (std::size_t i = 0; i < field.vertices.size(); ++i) {
        REQUIRE(detailed_mesh.vertices[i].position_m == field.vertices[i].position_m);
    }
    double area_m2 = 0.0;
    for (std::size_t i = 0; i < detailed_mesh.indices.size(); i += 3) {
        const float twice_m2 = signed_area2(detailed_mesh.vertices[detailed_mesh.indices[i]].position_m,
            detailed_mesh.vertices[detailed_mesh.indices[i + 1]].position_m,
            detailed_mesh.vertices[detailed_mesh.indices[i + 2]].position_m);
        REQUIRE(twice_m2 > 0.0F);
        area_m2 += 0.5 * static_cast<double>(twice_m2);
    }
    const double side_m = cells * spacing_m;
    CHECK(area_m2 == Approx(side_m * side_m).epsilon(1e-4));
}

TEST_CASE("the parts of a triangle come from far to near, or the reverse") {
    const Field field(low_eye_m, cells, 3.0);
    for (const auto order : {visuals::terrain::PaintOrder::BackToFront, visuals::terrain::PaintOrder::FrontToBack}) {
        auto mesh = field.mesh();
        mesh.indices = mesh.indices.first(3); // the triangle below the diagonal, which holds the eye
        NearDetailView view = view_from(low_eye_m);
        view.order = order;
        FieldDetail near({});
        const auto detailed_mesh = near.detailed_mesh(mesh, view, fine_only);
        const auto triangle_at = [&](const glm::vec3& at) {
            for (std::size_t i = 0; i < detailed_mesh.indices.size(); i += 3) {
                const auto corner = [&](std::size_t k) {
                    return detailed_mesh.vertices[detailed_mesh.indices[i + k]].position_m;
                };
                if (signed_area2(corner(0), corner(1), at) >= 0.0F && signed_area2(corner(1), corner(2), at) >= 0.0F &&
                    signed_area2(corner(2), corner(0), at) >= 0.0F) {
                    return static_cast<int>(i / 3);
                }
            }
            return -1;
        };
        int compared = 0;
        for (int tick = 0; tick < 400; ++tick) {
            const double turn = tick * 2.39996;
            const glm::vec3 way(std::cos(turn), std::sin(turn), 0.0);
            const int nearer = triangle_at(way * (3.0F + 0.11F * static_cast<float>(tick)));
            const int farther = triangle_at(way * (9.0F + 0.2F * static_cast<float>(tick)));
            if (nearer >= 0 && farther >= 0 && nearer != farther) {
                ++compared;
                REQUIRE((order == visuals::terrain::PaintOrder::BackToFront) == (farther < nearer));
            }
        }
        CHECK(compared > 100);
    }
}

TEST_CASE("from afar, and on level ground, nothing is moved") {
    const glm::dvec3 high_m(120.0, 120.0, 3000.0);
    const Field field(high_m, 1, 6.0);
    FieldDetail near({});
    CHECK(near.detailed_mesh(field.mesh(), view_from(high_m), fine_only).indices.size() == field.indices.size());
    const Field level(low_eye_m, 1, 0.0);
    const auto detailed_mesh = near.detailed_mesh(level.mesh(), view_from(low_eye_m), fine_only);
    for (const ColourVertex& vertex : detailed_mesh.vertices) {
        REQUIRE(vertex.position_m.z == Approx(-14.0));
        REQUIRE(vertex.colour == 0xff808080U);
    }
}

TEST_CASE("detail grows from nothing: a small move of the eye moves no vertex far") {
    const auto heights_from = [](const glm::dvec3& eye_m) {
        const Field field(eye_m, 1, 6.0);
        FieldDetail near({});
        std::map<std::pair<long, long>, double> heights;
        for (const ColourVertex& vertex : near.detailed_mesh(field.mesh(), view_from(eye_m), fine_only).vertices) {
            const glm::dvec3 at_m = glm::dvec3(vertex.position_m) + eye_m;
            heights[{std::lround(at_m.x * 64.0), std::lround(at_m.y * 64.0)}] = at_m.z;
        }
        return heights;
    };
    const auto before = heights_from(low_eye_m);
    const auto after = heights_from(low_eye_m + glm::dvec3(0.3, 0.2, 0.0));
    int both = 0;
    double max_rad = 0.0;
    for (const auto& [at, height_m] : before) {
        const auto found = after.find(at);
        if (found != after.end()) {
            ++both;
            const double distance_m = glm::length(
                glm::dvec3(static_cast<double>(at.first) / 64.0, static_cast<double>(at.second) / 64.0, height_m) -
                low_eye_m);
            max_rad = std::max(max_rad, std::abs(found->second - height_m) / distance_m);
        }
    }
    CHECK(both > 200);
    CHECK(max_rad < 0.25 / 869.0 * 4.0);
}

TEST_CASE("a number of halvings is held by longer edges, and none is cut off") {
    const Field field(low_eye_m, 1, 20.0);
    NearDetailView view = view_from(low_eye_m);
    const auto triangles_of = [&](const NearDetailView& own) {
        FieldDetail near({});
        return near.detailed_mesh(field.mesh(), own, fine_only).indices.size() / 3;
    };
    const std::size_t given = field.indices.size() / 3;
    const std::size_t asked = triangles_of(view) - given;
    REQUIRE(asked > 2000);
    for (const double share : {0.9, 0.5, 0.25, 0.1}) {
        view.max_splits = static_cast<std::size_t>(share * static_cast<double>(asked));
        const double detailed_mesh = static_cast<double>(triangles_of(view) - given);
        CHECK(detailed_mesh < 0.98 * static_cast<double>(view.max_splits));
        CHECK(detailed_mesh > 0.7 * static_cast<double>(view.max_splits));
        NearDetailView free = view;
        free.max_splits = asked;
        free.min_edge_rad = FieldDetail({}).detailed_mesh(field.mesh(), view, fine_only).min_edge_rad;
        CHECK(static_cast<double>(triangles_of(free) - given) == detailed_mesh);
    }
}

TEST_CASE("what must look long to be halved changes steadily as the eye moves") {
    FieldDetail near({});
    double last_rad = 0.0;
    for (int step = 0; step < 200; ++step) {
        const glm::dvec3 eye_m = low_eye_m + glm::dvec3(0.2, 0.1, 0.05) * static_cast<double>(step);
        NearDetailView view = view_from(eye_m);
        view.max_splits = 600;
        const Field field(eye_m, 1, 20.0);
        const auto min_edge_rad = static_cast<double>(near.detailed_mesh(field.mesh(), view, fine_only).min_edge_rad);
        CHECK(min_edge_rad > static_cast<double>(view.min_edge_rad));
        if (step > 0) { CHECK(std::abs(min_edge_rad / last_rad - 1.0) < 0.02); }
        last_rad = min_edge_rad;
    }
}

TEST_CASE("without a limit of triangles the width of the picture counts for nothing") {
    const auto view_of = [](double width_rad, double focal_px) {
        NearDetailView view = view_from(low_eye_m);
        apply_detail_budget({std::nullopt, width_rad, focal_px, 14.0}, {}, view);
        return view;
    };
    const NearDetailView narrow = view_of(0.2, 869.0);
    const NearDetailView wide = view_of(2.0, 869.0);
    CHECK(narrow.min_edge_rad == wide.min_edge_rad);
    CHECK(narrow.range_ratio == wide.range_ratio);
    CHECK(narrow.max_splits == wide.max_splits);
    CHECK(narrow.max_scenery_triangles == wide.max_scenery_triangles);
    CHECK(view_of(1.4, 2.0 * 869.0).min_edge_rad == Approx(0.5F * narrow.min_edge_rad));
}

TEST_CASE("what stands on the ground stands within its triangle, whichever mesh it is") {
    const SceneryDensity forest{0.5F, 0.3F, 0.0F, 0.05F, 1.0F};
    const auto places_of = [&](int block) {
        const Field field(low_eye_m, block, 0.0);
        FieldDetail near(forest);
        const auto detailed_mesh = near.detailed_mesh(field.mesh(), view_from(low_eye_m), scenery_only);
        std::multiset<std::pair<long, long>> places;
        for (std::size_t i = field.vertices.size(); i < detailed_mesh.vertices.size(); ++i) {
            const glm::vec3& at_m = detailed_mesh.vertices[i].position_m;
            places.insert({std::lround(at_m.x * 16.0F), std::lround(at_m.y * 16.0F)});
        }
        std::vector<std::uint32_t> all(field.indices.size() / 3);
        for (std::uint32_t i = 0; i < all.size(); ++i) { all[i] = i; }
        for (const std::uint32_t triangle : all) {
            std::vector<std::uint32_t> own{triangle};
            near.ground.replace(own, 0);
            const auto corner = [&](std::size_t k) {
                return field.vertices[field.indices[3 * triangle + k]].position_m;
            };
            REQUIRE(own.size() >= 1);
            for (const std::uint32_t part : own) {
                for (std::size_t k = 0; k < 3; ++k) {
                    const glm::vec3 at_m = detailed_mesh.vertices[detailed_mesh.indices[3 * part + k]].position_m;
                    for (std::size_t side = 0; side < 3; ++side) {
                        REQUIRE(signed_area2(corner(side), corner((side + 1) % 3), at_m) > -1.0F);
                    }
                }
            }
        }
        return places;
    };
    const auto detail_triangles = places_of(1);
    CHECK(detail_triangles.size() > 500);
    CHECK(places_of(cells) == detail_triangles);
}

TEST_CASE("things are painted from far to near and face outwards") {
    const Field field(low_eye_m, cells, 0.0);
    FieldDetail near({0.3F, 0.3F, 0.2F, 0.1F, 1.0F});
    const auto detailed_mesh = near.detailed_mesh(field.mesh(), view_from(low_eye_m), scenery_only);
    std::vector<std::uint32_t> own{0};
    near.ground.replace(own, 0);
    REQUIRE(own.size() > 100);
    double last_m = 1e9;
    glm::vec3 last_at(0.0F);
    int scenery_triangles = 0;
    for (std::size_t i = 1; i < own.size(); ++i) {
        const glm::vec3 at = detailed_mesh.vertices[detailed_mesh.indices[3 * own[i]]].position_m;
        if (glm::length(glm::vec2(at - last_at)) > 13.0F) { // another thing
            const double distance_m = glm::length(glm::vec2(at));
            CHECK(distance_m < last_m + 12.0);
            last_m = distance_m;
            ++scenery_triangles;
        }
        last_at = at;
    }
    CHECK(scenery_triangles > 10);
}

TEST_CASE("triangles that detail adds and those of what stands there are counted apart") {
    const Field field(low_eye_m, 1, 6.0);
    const std::size_t given = field.indices.size() / 3;
    FieldDetail near({0.3F, 0.3F, 0.2F, 0.1F, 1.0F});
    for (const NearDetailOptions& detail : {fine_only, scenery_only, NearDetailOptions{true, true}}) {
        const auto detailed_mesh = near.detailed_mesh(field.mesh(), view_from(low_eye_m), detail);
        CHECK((detailed_mesh.detail_triangles > 0) == detail.has_subdivision);
        CHECK((detailed_mesh.scenery_triangles > 0) == detail.scenery);
        CHECK(given + detailed_mesh.detail_triangles + detailed_mesh.scenery_triangles ==
              detailed_mesh.indices.size() / 3);
    }
    const auto bare = near.detailed_mesh(field.mesh(), view_from(low_eye_m), {false, true});
    std::vector<std::uint32_t> all(given);
    std::iota(all.begin(), all.end(), 0U);
    near.ground.replace(all, 0);
    CHECK(all.size() == given + bare.scenery_triangles);
}

TEST_CASE("shadows lie just in front of the ground, are darker than it and keep its covers") {
    const Field field(low_eye_m, 1, 0.0);
    const auto triangles_of = [&](bool has_shadows, visuals::terrain::PaintOrder order,
                                  std::vector<ColourVertex>& vertices) {
        NearDetailView view = view_from(low_eye_m);
        view.order = order;
        DetailedGround ground;
        GroundDecorations decorations;
        decorations.push_back(scenery_decoration({glm::dvec2(0.0), glm::ivec2(cells + 1), spacing_m, Daylight({}),
            [](int, int) {
                return SceneryDensity{0.1F, 0.1F, 0.0F, 0.0F, 1.0F};
            },
            has_shadows}));
        const auto mesh = ground.detailed_mesh(field.mesh(), view, {true, true}, decorations);
        for (const ColourVertex& vertex : mesh.vertices) {
            const bool is_ground = vertex.colour == 0xff808080U;
            if (vertex.colour >> 24U == 0xffU && !is_ground) { vertices.push_back(vertex); }
        }
        return mesh.scenery_triangles;
    };
    for (const auto order : {visuals::terrain::PaintOrder::BackToFront, visuals::terrain::PaintOrder::FrontToBack}) {
        std::vector<ColourVertex> none;
        std::vector<ColourVertex> shadows;
        const std::size_t without = triangles_of(false, order, none);
        const std::size_t with = triangles_of(true, order, shadows);
        CHECK(with > without);
        CHECK(none.empty());
        CHECK(shadows.size() > 50);
        for (const ColourVertex& vertex : shadows) {
            REQUIRE(vertex.position_m.z > -14.0F * (1.0F - 0x1p-16F));
            REQUIRE(vertex.position_m.z < -13.99F);
            REQUIRE((vertex.colour & 0xffU) < 0x80U);
        }
    }
}
