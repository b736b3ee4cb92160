#include "models/made/made_up.h"
#include "tests/visuals/gl/small_scene.h"
#include "visuals/scene/mesh_levels.h"
#include "visuals/scene/refined_aircraft.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cstdlib>

using namespace octant;
using namespace octant::tests;
using scene::HiddenSurface;
using scene::PaintStep;
using What = scene::PaintStep::What;

namespace {

constexpr std::uint32_t whole = PaintStep::whole;
constexpr int picture_px = 160;

/// A coloured torus of triangles whose normals are those of its vertices.
models::TriangleMesh torus_mesh() {
    const models::polygons::PolygonModel quads = models::made::torus();
    models::TriangleMesh mesh;
    mesh.name = "torus";
    mesh.vertices_m = quads.vertices_m;
    for (const glm::dvec3& vertex_m : mesh.vertices_m) {
        mesh.colours.push_back(glm::vec3(0.55 + 0.3 * vertex_m));
    }
    for (std::size_t i = 0; i < quads.polygons.size(); ++i) {
        const auto corners = quads.corners(i);
        mesh.triangles.push_back({corners[0], corners[1], corners[2]});
        mesh.triangles.push_back({corners[0], corners[2], corners[3]});
    }
    for (const glm::dvec3& vertex_m : mesh.vertices_m) {
        const glm::dvec3 ring_m = glm::normalize(glm::dvec3(vertex_m.x, vertex_m.y, 0.0));
        mesh.normals.emplace_back(glm::normalize(vertex_m - ring_m));
    }
    mesh.corner_normals = mesh.triangles;
    return mesh;
}

/// A torus 2 m ahead, leaning so that it hides a part of itself, as a level of detail drawn in full
/// and as a refined mesh of the same triangles.
class TwoTori {
public:
    TwoTori() {
        scene::append_level(level_, {&mesh_, 0.0});
        models::CollapseSequence sequence;
        sequence.original = mesh_;
        refined_.emplace(
            std::make_shared<const visuals::refine::ProgressiveMesh>(sequence), scene::Settings());
        refined_->update(glm::dmat4(body_), {}, true);
    }

    void load(Studio& studio) {
        studio.context().make_current();
        studio.renderer().load_models({&level_, 1});
    }

    int triangles() const { return refined_->triangles(); }

    scene::FramePlan level_plan(bool smooth) const {
        scene::FramePlan plan = lit_plan();
        plan.smooth.assign(mesh_.triangles.size() / 32 + 1, smooth ? ~0U : 0U);
        plan.aircraft = {
            {.model = 0, .index_count = static_cast<std::uint32_t>(level_.indices.size())}};
        plan.steps.push_back({What::Solid, 0, 1, whole});
        return plan;
    }

    /// Valid until the next call.
    scene::FramePlan refined_plan(int smooth) {
        scene::FramePlan plan = lit_plan();
        plan.smooth = {1};
        visuals::shading::ShadingLight light;
        light.to_light = plan.to_sun * glm::mat3(body_);
        const glm::vec3 eye_m = -glm::vec3(body_[3]) * glm::mat3(body_);
        refined_->shade(glm::dvec3(eye_m), light, smooth);
        plan.refined = {refined_->draw()};
        plan.steps.push_back({What::Refined, 0, 1, whole});
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
        plan.steps = {{What::ClearDepth, 0, 1, whole}};
        return plan;
    }

    models::TriangleMesh mesh_ = torus_mesh();
    scene::ModelBuffers level_;
    std::optional<scene::RefinedAircraft> refined_;
    glm::mat4 body_ = glm::rotate(ahead(2.0F), -1.2F, glm::vec3(1.0F, 0.2F, 0.0F));
};

int largest_difference(const gl::Picture& one, const gl::Picture& other) {
    int largest = 0;
    for (std::size_t i = 0; i < one.rgba.size(); ++i) {
        largest = std::max(largest, std::abs(int{one.rgba[i]} - int{other.rgba[i]}));
    }
    return largest;
}

int pixels_that_differ(const gl::Picture& one, const gl::Picture& other, int by = 0) {
    int count = 0;
    for (int row = 0; row < one.height; ++row) {
        for (int column = 0; column < one.width; ++column) {
            const Pixel a = pixel(one, column, row);
            const Pixel b = pixel(other, column, row);
            bool differs = false;
            for (std::size_t k = 0; k < 3; ++k) {
                differs = differs || std::abs(a[k] - b[k]) > by;
            }
            count += differs ? 1 : 0;
        }
    }
    return count;
}

struct TorusStudio {
    Studio studio{gl::make_osmesa_context(), 1, picture_px, picture_px};
    TwoTori tori;

    TorusStudio() { tori.load(studio); }

    gl::Picture picture(const scene::FramePlan& plan) { return studio.picture(plan); }
};

} // namespace

TEST_CASE("a refined mesh looks as the same mesh drawn in full, smooth and flat") {
    TorusStudio here;
    const gl::Picture smooth = here.picture(here.tori.level_plan(true));
    const gl::Picture flat = here.picture(here.tori.level_plan(false));
    CHECK(pixels_that_differ(smooth, here.picture(empty_plan())) > 4000);
    CHECK(pixels_that_differ(smooth, flat, 2) > 2000);
    // Normals are packed.
    CHECK(
        largest_difference(smooth, here.picture(here.tori.refined_plan(here.tori.triangles()))) <=
        1);
    CHECK(largest_difference(flat, here.picture(here.tori.refined_plan(0))) <= 1);
}

TEST_CASE("of a refined mesh each pixel is as all smooth or as all flat, and some are as each") {
    TorusStudio here;
    const gl::Picture smooth = here.picture(here.tori.refined_plan(here.tori.triangles()));
    const gl::Picture flat = here.picture(here.tori.refined_plan(0));
    const gl::Picture hybrid = here.picture(here.tori.refined_plan(100));
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
    scene::FramePlan painted = here.tori.refined_plan(50);
    scene::FramePlan by_depth = painted;
    by_depth.hidden_surface = HiddenSurface::DepthBuffer;
    by_depth.depth_boxes.clear();
    CHECK(largest_difference(here.picture(painted), here.picture(by_depth)) == 0);
    Triangles ground;
    ground.add({-1.0F, -1.0F, 0.0F, 1.0F}, 0.5F, green); // the left half, before the torus
    ground.add({0.0F, -1.0F, 1.0F, 1.0F}, 5.0F, green);  // the right half, behind it
    painted.ground = {ground.vertices, {}};
    painted.repaint_indices = ground.indices;
    painted.steps = {
        {What::ClearDepth, 0, 1, whole},
        {What::GroundDepth, 0, 12, whole},
        {What::Refined, 0, 1, whole}};
    const gl::Picture free = here.picture(here.tori.refined_plan(50));
    const gl::Picture cut = here.picture(painted);
    for (int row = 0; row < picture_px; ++row) {
        for (int column = 0; column < picture_px; ++column) {
            const Pixel expected = column < picture_px / 2 ? grey_px : pixel(free, column, row);
            REQUIRE(pixel(cut, column, row) == expected);
        }
    }
}

TEST_CASE("tints show what is smooth and what is flat") {
    TorusStudio here;
    scene::FramePlan plan = here.tori.refined_plan(100);
    plan.ambient = glm::vec3(1.0F);
    plan.sunlight = glm::vec3(0.0F);
    plan.refined[0].tints = {
        .smooth = models::packed_colour(blue), .flat = models::packed_colour(red)};
    const gl::Picture picture = here.picture(plan);
    CHECK(count_of(picture, blue_px) > 1000);
    CHECK(count_of(picture, red_px) > 1000);
    CHECK(
        count_of(picture, blue_px) + count_of(picture, red_px) + count_of(picture, grey_px) ==
        picture_px * picture_px);
}

TEST_CASE("depth is cleared within an inset alone, as large as the picture too") {
    TorusStudio here;
    const scene::FramePlan plan = here.tori.refined_plan(here.tori.triangles());
    const gl::Picture alone = here.picture(plan);
    gl::Picture picture;
    gl::Renderer& renderer = here.studio.renderer();
    renderer.draw(empty_plan());
    renderer.draw_inset(plan, {0, 0, picture_px, picture_px});
    renderer.finish_and_read(picture);
    CHECK(largest_difference(alone, picture) == 0);
    renderer.warm_up();
    CHECK(largest_difference(alone, here.picture(plan)) == 0);
}
