#include "ui/terrain/crack_finder.h"

#include "ui/terrain/ground_view.h"
#include "visuals/gl/make_renderer.h"
#include "visuals/planning/front_facing.h"
#include "visuals/planning/step_writer.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace octant::ui::terrain {

namespace planning = visuals::planning;
namespace scene = visuals::scene;

namespace {

constexpr std::uint32_t ground_colour = 0xff808080U;

/// Places along a ray at which it is compared with the mesh, nearest first, each this much farther
/// than the last.
constexpr double step_factor = 1.02;
constexpr double beyond_mesh_factor = 1.2; ///< of the mesh's reach: below its lowest vertex for certain

} // namespace

CrackFinder::CrackFinder(const glm::ivec2& size_px, const glm::dvec2& half_extent_m)
    : size_px_(size_px)
    , half_extent_m_(half_extent_m)
    , renderer_(visuals::gl::make_osmesa_renderer(size_px, 1)) {
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
    planning::StepWriter(plan).add_ground();
    renderer_->draw(plan);
    renderer_->finish_and_read(picture_);
}

bool CrackFinder::is_key(int x, int y) const {
    const auto pixel = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(size_px_.x) +
                            static_cast<std::size_t>(x));
    return picture_.rgba[pixel + 1] == 0;
}

/// Whether a ray is above the mesh at one place and below it at a later one, by more than half a
/// pixel each. Where there is no mesh, its lowest and highest vertex stand for it: none is needed
/// where the frustum does not reach down to the ground, and holes have none.
bool CrackFinder::goes_below(const glm::dvec3& ray) const {
    bool was_above = false;
    for (double distance_m = 1.0; distance_m < beyond_mesh_factor * reach_m_; distance_m *= step_factor) {
        const glm::dvec3 at_m = view_.eye_m + ray * distance_m;
        const auto height_m = surface_.height_at(at_m.x, at_m.y);
        if (std::abs(at_m.x) > half_extent_m_.x || std::abs(at_m.y) > half_extent_m_.y) {
            continue;
        }
        const double half_pixel_m = 0.5 * distance_m / view_.focal_px;
        was_above = was_above || at_m.z > height_m.value_or(highest_m_) + half_pixel_m;
        if (was_above && at_m.z < height_m.value_or(lowest_m_) - half_pixel_m) {
            return true;
        }
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
            if (!below_ground || tested) {
                continue;
            }
            tested = true;
            if (!taken) {
                surface_.set_mesh(mesh, camera.eye_m);
                taken = true;
            }
            const glm::dvec3 ray = glm::normalize(
                view_.ahead + view_.right * ((x + 0.5 - view_.half_width_px) / view_.focal_px) +
                view_.up * ((view_.half_height_px - y - 0.5) / view_.focal_px));
            cracks += goes_below(ray) ? 1 : 0;
        }
    }
    return cracks;
}

} // namespace octant::ui::terrain
