#include "models/procedural/procedural_models.h"
#include "tests/visuals/gl/small_scene.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <vector>

using namespace octant;
using namespace octant::tests;
using scene::DepthUse;
using scene::PaintStep;
using Content = scene::PaintStep::Content;

namespace {

constexpr std::uint32_t unclipped = PaintStep::no_clip;
constexpr int picture_px = 160;

/// A coloured torus, each triangle with three corners of its own, lit at its corners and as a whole.
std::vector<scene::ModelVertex> torus_corners() {
    const models::polygons::PolygonModel quads = models::procedural::torus();
    std::vector<scene::ModelVertex> corners;
    const auto add = [&](const std::array<std::uint32_t, 3>& triangle) {
        std::array<glm::dvec3, 3> at_m;
        for (std::size_t k = 0; k < 3; ++k) { at_m[k] = quads.vertices_m[triangle[k]]; }
        const glm::vec3 face_normal(glm::normalize(glm::cross(at_m[1] - at_m[0], at_m[2] - at_m[0])));
        const glm::dvec3 middle_m = (at_m[0] + at_m[1] + at_m[2]) / 3.0;
        for (const glm::dvec3& vertex_m : at_m) {
            const glm::dvec3 ring_m = glm::normalize(glm::dvec3(vertex_m.x, vertex_m.y, 0.0));
            corners.push_back({.position_m = glm::vec3(vertex_m),
                .normal = glm::vec3(glm::normalize(vertex_m - ring_m)),
                .face_normal = face_normal,
                .colour = models::packed_colour(glm::vec3(0.55 + 0.3 * vertex_m)),
                .face_colour = models::packed_colour(glm::vec3(0.55 + 0.3 * middle_m))});
        }
    };
    for (std::size_t i = 0; i < quads.polygons.size(); ++i) {
        const auto quad = quads.corners(i);
        add({quad[0], quad[1], quad[2]});
        add({quad[0], quad[2], quad[3]});
    }
    return corners;
}

/// A torus 2 m ahead, leaning so that it hides a part of itself, as a level of detail drawn in full and as a mesh of
/// the same triangles that comes with each plan.
class TwoTori {
public:
    TwoTori() : refined_(torus_corners()) {
        level_.vertices = refined_;
        level_.has_depth_drawn_meshes = true;
        for (std::uint32_t i = 0; i < refined_.size(); ++i) {
            level_.indices.push_back(i);
            level_.vertices[i].polygon = i / 3;
        }
    }

    void load(Studio& studio) { studio.renderer().load_models({&level_, 1}); }

    int triangles() const { return static_cast<int>(refined_.size() / 3); }

    scene::FramePlan level_plan(bool smooth) const {
        scene::FramePlan plan = lit_plan();
        plan.smooth.assign(refined_.size() / 3 / 32 + 1, smooth ? ~0U : 0U);
        plan.aircraft = {{.model = 0, .index_count = static_cast<std::uint32_t>(level_.indices.size())}};
        plan.steps.push_back({Content::Aircraft, 0, 1, unclipped, DepthUse::Nearest});
        return plan;
    }

    /// So many triangles smooth, all over the torus. Valid until the next call.
    scene::FramePlan refined_plan(int smooth) {
        scene::FramePlan plan = lit_plan();
        plan.smooth = {1};
        for (int i = 0; i < triangles(); ++i) {
            const bool is_smooth = i * smooth / triangles() != (i + 1) * smooth / triangles();
            refined_[std::size_t{3} * static_cast<std::size_t>(i)].polygon = is_smooth ? 0 : 1;
        }
        plan.refined = {{.vertices = refined_, .indices = level_.indices}};
        plan.steps.push_back({Content::Refined, 0, 1, unclipped, DepthUse::Nearest});
        return plan;
    }

private:
    scene::FramePlan lit_plan() const {
        scene::FramePlan plan = empty_plan();
        plan.ambient = glm::vec3(0.3F);
        plan.sunlight = glm::vec3(0.7F);
        plan.to_sun = glm::normalize(glm::vec3(0.5F, 0.7F, 0.6F));
        plan.parts = {body_};
        plan.depth_boxes = {{{0, 0}, {picture_px, picture_px}}};
        plan.steps = {{Content::ClearDepth, 0, 1, unclipped}};
        return plan;
    }

    scene::ModelBuffers level_;
    std::vector<scene::ModelVertex> refined_;
    glm::mat4 body_ = glm::rotate(ahead(2.0F), -1.2F, glm::vec3(1.0F, 0.2F, 0.0F));
};

int largest_difference(const scene::Picture& one, const scene::Picture& other) {
    int largest = 0;
    for (std::size_t i = 0; i < one.rgba.size(); ++i) {
        largest = std::max(largest, std::abs(int{one.rgba[i]} - int{other.rgba[i]}));
    }
    return largest;
}

int pixels_that_differ(const scene::Picture& one, const scene::Picture& other, int by = 0) {
    int count = 0;
    for (int row = 0; row < one.height; ++row) {
        for (int column = 0; column < one.width; ++column) {
            const Pixel a = pixel(one, column, row);
            const Pixel b = pixel(other, column, row);
            bool differs = false;
            for (std::size_t k = 0; k < 3; ++k) { differs = differs || std::abs(a[k] - b[k]) > by; }
            count += differs ? 1 : 0;
        }
    }
    return count;
}

struct TorusStudio {
    Studio studio{gl::make_osmesa_context(), 1, picture_px, picture_px};
    TwoTori tori;

    TorusStudio() { tori.load(studio); }

    scene::Picture picture(const scene::FramePlan& plan, HiddenSurfaceMode mode = HiddenSurfaceMode::InOrder) {
        return studio.picture(plan, mode);
    }
};

} // namespace

TEST_CASE("a refined mesh looks as the same mesh drawn in full, smooth and flat") {
    TorusStudio here;
    const scene::Picture smooth = here.picture(here.tori.level_plan(true));
    const scene::Picture flat = here.picture(here.tori.level_plan(false));
    CHECK(pixels_that_differ(smooth, here.picture(empty_plan())) > 4000);
    CHECK(pixels_that_differ(smooth, flat, 2) > 2000);
    CHECK(largest_difference(smooth, here.picture(here.tori.refined_plan(here.tori.triangles()))) <= 1);
    CHECK(largest_difference(flat, here.picture(here.tori.refined_plan(0))) <= 1);
}

TEST_CASE("of a refined mesh each pixel is as all smooth or as all flat, and some are as each") {
    TorusStudio here;
    const scene::Picture smooth = here.picture(here.tori.refined_plan(here.tori.triangles()));
    const scene::Picture flat = here.picture(here.tori.refined_plan(0));
    const scene::Picture hybrid = here.picture(here.tori.refined_plan(here.tori.triangles() / 2));
    int as_smooth = 0;
    int as_flat = 0;
    int other = 0;
    for (int row = 0; row < picture_px; ++row) {
        for (int column = 0; column < picture_px; ++column) {
            const Pixel here_px = pixel(hybrid, column, row);
            const bool like_smooth = here_px == pixel(smooth, column, row);
            const bool like_flat = here_px == pixel(flat, column, row);
            as_smooth += like_smooth && !like_flat ? 1 : 0;
            as_flat += like_flat && !like_smooth ? 1 : 0;
            other += !like_smooth && !like_flat ? 1 : 0;
        }
    }
    CHECK(other == 0);
    CHECK(as_smooth > 500);
    CHECK(as_flat > 500);
}

TEST_CASE("a refined mesh hides itself and is hidden by ground before it, and by depth anywhere") {
    TorusStudio here;
    scene::FramePlan painted = here.tori.refined_plan(here.tori.triangles() / 3);
    CHECK(largest_difference(here.picture(painted), here.picture(painted, HiddenSurfaceMode::ByDepth)) == 0);
    Triangles ground;
    ground.add({-1.0F, -1.0F, 0.0F, 1.0F}, 0.5F, green); // the left half, before the torus
    ground.add({0.0F, -1.0F, 1.0F, 1.0F}, 5.0F, green);  // the right half, behind it
    painted.ground = {ground.vertices, {}};
    painted.repaint_indices = ground.indices;
    painted.steps = {{Content::ClearDepth, 0, 1, unclipped},
        {Content::GroundRepaint, 0, 12, unclipped, DepthUse::DepthOnly},
        {Content::Refined, 0, 1, unclipped, DepthUse::Nearest}};
    const scene::Picture free = here.picture(here.tori.refined_plan(here.tori.triangles() / 3));
    const scene::Picture cut = here.picture(painted);
    for (int row = 0; row < picture_px; ++row) {
        for (int column = 0; column < picture_px; ++column) {
            const Pixel expected = column < picture_px / 2 ? grey_px : pixel(free, column, row);
            REQUIRE(pixel(cut, column, row) == expected);
        }
    }
}

TEST_CASE("tints show what is smooth and what is flat") {
    TorusStudio here;
    scene::FramePlan plan = here.tori.refined_plan(here.tori.triangles() / 2);
    plan.ambient = glm::vec3(1.0F);
    plan.sunlight = glm::vec3(0.0F);
    plan.refined[0].tints = {.smooth = models::packed_colour(blue), .flat = models::packed_colour(red)};
    const scene::Picture picture = here.picture(plan);
    CHECK(count_of(picture, blue_px) > 1000);
    CHECK(count_of(picture, red_px) > 1000);
    CHECK(
        count_of(picture, blue_px) + count_of(picture, red_px) + count_of(picture, grey_px) == picture_px * picture_px);
}

TEST_CASE("depth is cleared within an inset alone, as large as the picture too") {
    TorusStudio here;
    const scene::FramePlan plan = here.tori.refined_plan(here.tori.triangles());
    const scene::Picture alone = here.picture(plan);
    scene::Picture picture;
    gl::Renderer& renderer = here.studio.renderer();
    renderer.draw(empty_plan());
    renderer.draw_inset(plan, {0, 0, picture_px, picture_px});
    renderer.finish_and_read(picture);
    CHECK(largest_difference(alone, picture) == 0);
    renderer.warm_up();
    CHECK(largest_difference(alone, here.picture(plan)) == 0);
}
