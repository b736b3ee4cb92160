#include "ui/terrain/terrain_check.h"

#include "sim/base/units.h"
#include "ui/base/progress.h"
#include "ui/terrain/ground_view.h"
#include "visuals/gl/gl_renderer.h"
#include "visuals/planning/ground_frame.h"
#include "visuals/terrain/ground_query.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <numbers>

namespace octant::ui::terrain {

namespace terrain = visuals::terrain;

namespace {

/// Splitmix64: the same numbers everywhere.
class RandomNumbers {
public:
    RandomNumbers(std::uint64_t seed, std::uint64_t number)
        : state_(seed * 0x9e3779b97f4a7c15ULL ^ number * 0xd1342543de82ef95ULL) {}

    double between(double low, double high) {
        constexpr double steps = 9007199254740992.0; // 2^53
        return low + (high - low) * (static_cast<double>(next() >> 11U) / steps);
    }

    /// A number between two positive ones whose logarithm is spread evenly.
    double scaled_between(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }

    bool is_one_in(std::uint64_t times) { return next() % times == 0; }

private:
    std::uint64_t next() {
        state_ += 0x9e3779b97f4a7c15ULL;
        std::uint64_t z = state_;
        z = (z ^ z >> 30U) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ z >> 27U) * 0x94d049bb133111ebULL;
        return z ^ z >> 31U;
    }

    std::uint64_t state_;
};

} // namespace

RandomView random_view(const terrain::GroundSamples& ground, bool by_error, std::uint64_t seed, std::uint64_t number) {
    RandomNumbers numbers(seed, number);
    const glm::dvec2 half_m = ground.half_extent_m();
    const double reach = numbers.between(0.0, 1.0) < 0.3 ? 1.4 : 1.0;
    const double x_m = reach * numbers.between(-half_m.x, half_m.x);
    const double y_m = reach * numbers.between(-half_m.y, half_m.y);
    const double below_m =
        terrain::ground_height_m(ground, std::clamp(x_m, -half_m.x, half_m.x), std::clamp(y_m, -half_m.y, half_m.y))
            .value_or(0.0);
    const glm::dvec3 eye_m(x_m, y_m, below_m + numbers.scaled_between(2.0, 20000.0));
    const double heading_rad = numbers.between(0.0, 2.0 * std::numbers::pi);
    const double pitch_rad = rad_from_deg(numbers.between(-90.0, 30.0));
    const glm::dvec3 ahead(
        std::sin(heading_rad) * std::cos(pitch_rad), std::cos(heading_rad) * std::cos(pitch_rad), std::sin(pitch_rad));
    RandomView view;
    view.camera = visuals::scene::camera_looking_at(eye_m, eye_m + ahead);
    view.camera.vertical_fov_rad = rad_from_deg(numbers.scaled_between(5.0, 100.0));
    if (numbers.is_one_in(2)) {
        view.triangles = static_cast<int>(numbers.scaled_between(100.0, 60000.0));
    } else {
        view.coarseness = by_error ? numbers.scaled_between(0.25, 32.0) : 1.0 / numbers.scaled_between(2.0, 64.0);
    }
    return view;
}

namespace planning = visuals::planning;
namespace scene = visuals::scene;

namespace {

constexpr std::uint32_t ground_colour = 0xff808080U;

/// Places along a ray at which it is compared with the mesh, nearest first, each this much farther than the last.
constexpr double step_factor = 1.02;
constexpr double beyond_mesh_factor = 1.2; ///< of the mesh's reach: below its lowest vertex for certain

} // namespace

CrackFinder::CrackFinder(const glm::ivec2& size_px, const glm::dvec2& half_extent_m)
    : size_px_(size_px), half_extent_m_(half_extent_m),
      renderer_(visuals::gl::make_gl_renderer(visuals::gl::OffscreenContext::OsMesa, size_px, 1)) {
    renderer_->load_models({});
    renderer_->warm_up();
}

void CrackFinder::draw(const visuals::terrain::GroundMesh& mesh, const scene::Camera& camera) {
    vertices_.assign(mesh.vertices.begin(), mesh.vertices.end());
    reach_m_ = 0.0;
    lowest_m_ = std::numeric_limits<double>::infinity();
    highest_m_ = -lowest_m_;
    for (models::ColourVertex& vertex : vertices_) {
        vertex.colour = ground_colour;
        reach_m_ = std::max(reach_m_, static_cast<double>(glm::length(vertex.position_m)));
        const double height_m = camera.eye_m.z + static_cast<double>(vertex.position_m.z);
        lowest_m_ = std::min(lowest_m_, height_m);
        highest_m_ = std::max(highest_m_, height_m);
    }
    scene::FramePlan plan;
    plan.world_to_view = scene::world_to_view(camera);
    plan.view_to_clip = scene::view_to_clip(camera, static_cast<double>(size_px_.x) / size_px_.y);
    plan.background = {1.0F, 0.0F, 1.0F};
    const planning::GroundFrame ground{{vertices_, mesh.indices}, {}, {}};
    plan.ground = planning::front_facing(ground, camera.vertical_fov_rad / size_px_.y, facing_);
    plan.steps.push_back(
        {scene::PaintStep::Content::Ground, 0, static_cast<std::uint32_t>(plan.ground.indices.size())});
    renderer_->draw(plan);
    renderer_->finish_and_read(picture_);
}

bool CrackFinder::is_key(int x, int y) const {
    const auto pixel =
        4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(size_px_.x) + static_cast<std::size_t>(x));
    return picture_.rgba[pixel + 1] == 0;
}

/// Whether a ray is above the mesh at one place and below it at a later one, by more than half a pixel each. Where
/// there is no mesh, its lowest and highest vertex stand for it: none is needed where the frustum does not reach down
/// to the ground, and holes have none.
bool CrackFinder::goes_below(const glm::dvec3& ray) const {
    bool was_above = false;
    for (double distance_m = 1.0; distance_m < beyond_mesh_factor * reach_m_; distance_m *= step_factor) {
        const glm::dvec3 at_m = view_.eye_m + ray * distance_m;
        const auto height_m = surface_.height_at(at_m.x, at_m.y);
        if (std::abs(at_m.x) > half_extent_m_.x || std::abs(at_m.y) > half_extent_m_.y) { continue; }
        const double half_pixel_m = 0.5 * distance_m / view_.focal_px;
        was_above = was_above || at_m.z > height_m.value_or(highest_m_) + half_pixel_m;
        if (was_above && at_m.z < height_m.value_or(lowest_m_) - half_pixel_m) { return true; }
    }
    return false;
}

int CrackFinder::cracks(const visuals::terrain::GroundMesh& mesh, const scene::Camera& camera) {
    draw(mesh, camera);
    view_ = picture_view(camera, size_px_);
    bool taken = false;
    int cracks = 0;
    for (int x = 0; x < size_px_.x; ++x) {
        bool below_ground = false;
        bool tested = false; // of a run of key pixels below ground, the first
        for (int y = 0; y < size_px_.y; ++y) {
            if (!is_key(x, y)) {
                below_ground = true;
                tested = false;
                continue;
            }
            if (!below_ground || tested) { continue; }
            tested = true;
            if (!taken) {
                surface_.set_mesh(mesh, camera.eye_m);
                taken = true;
            }
            const glm::dvec3 ray =
                glm::normalize(view_.ahead + view_.right * ((x + 0.5 - view_.half_width_px) / view_.focal_px) +
                               view_.up * ((view_.half_height_px - y - 0.5) / view_.focal_px));
            cracks += goes_below(ray) ? 1 : 0;
        }
    }
    return cracks;
}

namespace {

constexpr glm::ivec2 size_px{320, 180};

void add(terrain::Conformity& sum, const terrain::Conformity& found) {
    sum.open_edges += found.open_edges;
    sum.t_junctions += found.t_junctions;
    sum.overlapping_edges += found.overlapping_edges;
    sum.inverted_triangles += found.inverted_triangles;
    sum.duplicate_vertices += found.duplicate_vertices;
}

} // namespace

TerrainCheckResult check_terrain(MeshMaker& maker, const TerrainCheck& check) {
    const std::unique_ptr<CrackFinder> pictures =
        check.draw_every > 0 ? std::make_unique<CrackFinder>(size_px, maker.ground().half_extent_m()) : nullptr;
    GroundViewOptions seen;
    seen.size_px = size_px;
    seen.earth_radius_m = check.earth_radius_m;
    TerrainCheckResult check_result;
    base::Progress progress("views", check.views, check.quiet, "views");
    for (int number = 0; number < check.views; number += check.every) {
        const RandomView random = random_view(
            maker.ground(), check.by_error, static_cast<std::uint64_t>(check.seed), static_cast<std::uint64_t>(number));
        const terrain::MeshView view = mesh_view(random.camera, seen);
        const terrain::GroundMesh mesh =
            random.triangles ? maker.mesh_within(view, *random.triangles) : maker.mesh(view, random.coarseness);
        const terrain::Conformity found = terrain::check_conformity(maker.ground(), mesh, view);
        add(check_result.edges, found);
        int key_pixels = 0;
        if (pictures && check_result.views % check.draw_every == 0) {
            key_pixels = pictures->cracks(mesh, random.camera);
            ++check_result.drawn;
        }
        ++check_result.views;
        check_result.triangles += mesh.counters.triangles;
        check_result.key_pixels += key_pixels;
        if (!found.is_conforming() || key_pixels > 0) {
            ++check_result.cracked_views;
            base::print_note(check.quiet, fmt::format("view {}: {}, {} key pixels", number, found.text(), key_pixels));
        }
        progress.show(number + 1, fmt::format("{} with faults", check_result.cracked_views));
    }
    return check_result;
}

} // namespace octant::ui::terrain
