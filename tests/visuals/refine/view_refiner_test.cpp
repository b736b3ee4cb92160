#include "tests/visuals/refine/front_check.h"
#include "tests/visuals/refine/made_sequence.h"
#include "visuals/refine/view_refiner.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <cmath>
#include <map>
#include <numbers>

using namespace octant;
using namespace octant::visuals::refine;
using namespace octant::visuals::refine::test;

namespace {

std::shared_ptr<const ProgressiveMesh> sphere(int cuts) {
    return std::make_shared<const ProgressiveMesh>(collapsed(made_sphere(cuts)));
}

RefineView view_from(const glm::dvec3& eye_m) {
    return picture_view(eye_m, glm::dvec3(0.0), {0.0, 0.0, 1.0}, 50.0 * std::numbers::pi / 180.0, 1280.0, 720.0);
}

/// Around the sphere, nearer and farther.
RefineView on_path(double frame) {
    const double turn = 0.01 * frame;
    const double away_m = 3.0 + 1.2 * std::sin(0.03 * frame);
    return view_from(away_m * glm::dvec3(std::cos(turn), std::sin(turn), 0.3));
}

void refine_fully(ViewRefiner& refiner, const RefineView& view) {
    for (int frame = 0; frame < 2000 && !refiner.update(view).settled; ++frame) {}
}

/// Pixels right of and above the middle of the picture; the point is ahead.
glm::dvec2 pixel(const RefineView& view, const glm::dvec3& point_m) {
    const glm::dvec3 right = glm::normalize(glm::cross(view.forward, glm::dvec3(0.0, 0.0, 1.0)));
    const glm::dvec3 up = glm::cross(right, view.forward);
    const glm::dvec3 seen_m = point_m - view.eye_m;
    return glm::dvec2(glm::dot(right, seen_m), glm::dot(up, seen_m)) * (view.focal_px / glm::dot(view.forward, seen_m));
}

} // namespace

TEST_CASE("an error is as large as it looks, by distance, side and direction") {
    const auto mesh = sphere(3);
    const std::uint32_t node = static_cast<std::uint32_t>(mesh->leaf_count());
    const glm::dvec3 out = glm::normalize(glm::dvec3(mesh->position_m(node)));
    const auto px = [&](const RefineView& view) { return projected_error_px(*mesh, node, view); };
    const double error_m = static_cast<double>(mesh->error_m(node));
    const double radius_m = static_cast<double>(mesh->radius_m(node));
    const double at_m = glm::length(glm::dvec3(mesh->position_m(node)));
    RefineView view = view_from(10.0 * out);
    CHECK(px(view) == Approx(view.focal_px * error_m / (10.0 - at_m - radius_m)).epsilon(1e-4));
    CHECK(px(view_from(-10.0 * out)) == 0.0);
    const glm::dvec3 aside = glm::normalize(glm::cross(out, glm::dvec3(0.3, 0.4, 0.5)));
    const double beside_px = px(view_from(10.0 * aside));
    CHECK(beside_px > 1.5 * view.focal_px * error_m / (10.0 + radius_m));
    RefineView away = view;
    away.side_normals[0] = out; // inside lies farther out than the eye
    CHECK(px(away) == Approx(0.1 * px(view)));
}

TEST_CASE("no node shows a larger error than its parent") {
    const auto mesh = sphere(4);
    for (int frame = 0; frame < 300; frame += 17) {
        const RefineView view = on_path(frame);
        for (auto node = static_cast<std::uint32_t>(mesh->leaf_count()); node < mesh->node_count(); ++node) {
            if (mesh->parent(node) != none) {
                CHECK(projected_error_px(*mesh, node, view) <=
                      projected_error_px(*mesh, mesh->parent(node), view) * (1.0 + 1e-9));
            }
        }
    }
}

TEST_CASE("for a standing eye the mesh settles, and then nothing happens") {
    ViewRefiner refiner(sphere(4), {.error_px = 8.0});
    const RefineView view = on_path(0);
    refine_fully(refiner, view);
    const RefinerCounts counts = refiner.front().counts();
    CHECK(refiner.front().active_count() > 30);
    CHECK(refiner.front().active_count() < refiner.front().mesh().leaf_count());
    std::vector<SlotRange> dirty;
    refiner.front().take_dirty_vertices(dirty);
    for (int frame = 0; frame < 20; ++frame) {
        const RefinedFrame done = refiner.update(view);
        CHECK(done.splits + done.collapses + done.moving == 0);
        CHECK(done.settled);
    }
    refiner.front().take_dirty_vertices(dirty);
    CHECK(dirty.empty());
    CHECK(refiner.front().counts().blocked == counts.blocked);
    CHECK(refiner.front().flipped_faces() == 0);
}

TEST_CASE("settled, every node that shows too large an error is split") {
    for (const bool geomorphs : {false, true}) {
        ViewRefiner refiner(sphere(4), {.error_px = 6.0, .geomorphs = geomorphs});
        for (int frame = 0; frame < 400; frame += 80) {
            const RefineView view = on_path(frame);
            refine_fully(refiner, view);
            const ProgressiveMesh& mesh = refiner.front().mesh();
            for (auto node = static_cast<std::uint32_t>(mesh.leaf_count()); node < mesh.node_count(); ++node) {
                const double error_px = projected_error_px(mesh, node, view);
                CHECK((error_px <= 6.0 || refiner.front().is_split(node)));
            }
            CHECK(refiner.front().flipped_faces() == 0);
        }
    }
}

TEST_CASE("along a path no node is split and collapsed, or collapsed and split, within 10 frames") {
    for (const double speed : {0.3, 1.0}) {
        for (const bool geomorphs : {false, true}) {
            ViewRefiner refiner(sphere(4), {.error_px = 6.0, .geomorphs = geomorphs});
            const ProgressiveMesh& mesh = refiner.front().mesh();
            std::map<std::uint32_t, int> last; // frame of each node's last change
            std::vector<bool> split(mesh.node_count(), false);
            int collapsed = 0;
            int soon = 0;
            for (int frame = 0; frame < 700; ++frame) {
                refiner.update(on_path(speed * frame));
                for (auto node = static_cast<std::uint32_t>(mesh.leaf_count()); node < mesh.node_count(); ++node) {
                    if (refiner.front().is_split(node) == split[node]) { continue; }
                    split[node] = !split[node];
                    collapsed += split[node] ? 0 : 1;
                    const auto known = last.find(node);
                    soon += known != last.end() && frame - known->second <= 10 ? 1 : 0;
                    last[node] = frame;
                }
            }
            CHECK(collapsed > 50);
            CHECK(soon == 0);
        }
    }
}

TEST_CASE("a node that was collapsed is split at once when the eye jumps near") {
    ViewRefiner refiner(sphere(4), {.error_px = 6.0, .geomorphs = false});
    const RefineView near = view_from({3.0, 0.0, 0.0});
    refine_fully(refiner, near);
    const std::size_t fine = refiner.front().active_count();
    const RefineView far = view_from({60.0, 0.0, 0.0});
    while (refiner.front().active_count() > fine / 2) { REQUIRE_FALSE(refiner.update(far).settled); }
    refiner.update(near);
    CHECK(10 * refiner.front().active_count() > 9 * fine);
}

TEST_CASE("settle makes the mesh fit a view at once, and then its frame does nothing") {
    for (const bool geomorphs : {false, true}) {
        ViewRefiner refiner(sphere(4), {.error_px = 6.0, .operations = 3, .geomorphs = geomorphs});
        for (const double frame : {0.0, 300.0, 40.0}) {
            const RefineView view = on_path(frame);
            refiner.refine_fully(view);
            const ProgressiveMesh& mesh = refiner.front().mesh();
            for (auto node = static_cast<std::uint32_t>(mesh.leaf_count()); node < mesh.node_count(); ++node) {
                CHECK((projected_error_px(mesh, node, view) <= 6.0 || refiner.front().is_split(node)));
            }
            for (std::uint32_t slot = 0; slot < refiner.front().vertices().size(); ++slot) {
                const std::uint32_t node = refiner.front().node_at(slot);
                CHECK((node == none || refiner.front().vertices()[slot].position_m == mesh.position_m(node)));
            }
            const RefinedFrame done = refiner.update(view);
            CHECK(done.splits + done.collapses + done.moving == 0);
            CHECK(done.settled);
            CHECK(refiner.front().flipped_faces() == 0);
        }
    }
}

TEST_CASE("with geomorphs no vertex moves by a pixel in one frame, seen from one eye") {
    ViewRefiner refiner(sphere(4), {.error_px = 4.0});
    const ProgressiveMesh& mesh = refiner.front().mesh();
    refine_fully(refiner, on_path(0));
    double largest_px = 0.0;
    std::size_t moved = 0;
    for (int frame = 1; frame < 250; ++frame) {
        // Where each leaf's ancestor was drawn before.
        std::vector<glm::vec3> before(mesh.leaf_count());
        for (std::uint32_t leaf = 0; leaf < mesh.leaf_count(); ++leaf) {
            const std::uint32_t node = refiner.front().active_ancestor(leaf);
            before[leaf] = refiner.front().vertices()[refiner.front().slot(node)].position_m;
        }
        const RefineView view = on_path(frame);
        moved += refiner.update(view).moving;
        for (std::uint32_t leaf = 0; leaf < mesh.leaf_count(); ++leaf) {
            const std::uint32_t node = refiner.front().active_ancestor(leaf);
            const glm::vec3 now = refiner.front().vertices()[refiner.front().slot(node)].position_m;
            largest_px = std::max(
                largest_px, glm::distance(pixel(view, glm::dvec3(before[leaf])), pixel(view, glm::dvec3(now))));
        }
    }
    CHECK(largest_px < 1.0);
    CHECK(largest_px > 0.1);
    CHECK(moved > 500);
}

TEST_CASE("a budget of operations is kept, the worst errors first") {
    ViewRefiner refiner(sphere(4), {.error_px = 2.0, .operations = 10, .geomorphs = false, .repair = false});
    const RefineView view = on_path(0);
    std::size_t before = refiner.front().active_count();
    for (int frame = 0; frame < 20; ++frame) {
        const RefinedFrame done = refiner.update(view);
        CHECK(done.splits <= 10 + refiner.front().counts().forced_by_rule);
        CHECK_FALSE(done.settled);
        CHECK(refiner.front().active_count() > before);
        before = refiner.front().active_count();
    }
}

TEST_CASE("several fronts share a hierarchy and do not know of each other") {
    const auto mesh = sphere(3);
    ViewRefiner one(mesh, {.error_px = 5.0});
    ViewRefiner other(mesh, {.error_px = 5.0});
    ViewRefiner alone(mesh, {.error_px = 5.0});
    for (int frame = 0; frame < 100; ++frame) {
        one.update(on_path(frame));
        other.update(on_path(300 - frame));
        alone.update(on_path(frame));
    }
    CHECK(active_faces(one.front()) == active_faces(alone.front()));
    CHECK(active_faces(one.front()) != active_faces(other.front()));
}
