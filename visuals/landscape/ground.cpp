#include "visuals/landscape/ground.h"

#include "visuals/landscape/ground_palette.h"
#include "visuals/nature/runway.h"
#include "visuals/roads/road_network.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace octant::visuals::landscape {

double highest_m(const Ground& ground) {
    constexpr int max_steps = 512;
    const glm::dvec2 half_m = ground.half_extent_m();
    const double spacing_m = ground.spacing_m();
    if (spacing_m <= 0.0) { return std::isfinite(ground.mean_height_m()) ? ground.mean_height_m() : 0.0; }
    const auto steps_over = [&](double half) {
        return std::clamp(static_cast<int>(std::lround(2.0 * half / spacing_m)), 1, max_steps);
    };
    const glm::ivec2 steps(steps_over(half_m.x), steps_over(half_m.y));
    double highest = -std::numeric_limits<double>::infinity();
    for (int row = 0; row <= steps.y; ++row) {
        for (int column = 0; column <= steps.x; ++column) {
            const glm::dvec2 share = glm::dvec2(column, row) / glm::dvec2(steps);
            const glm::dvec2 at_m = (2.0 * share - 1.0) * half_m;
            highest = std::max(highest, ground.height_at(at_m.x, at_m.y).value_or(highest));
        }
    }
    return std::isfinite(highest) ? highest : 0.0;
}

MeshSettings mesh_settings(const scene::Settings& settings, bool has_texture) {
    return {settings.ground, settings.air, settings.surface.hidden_surface == scene::HiddenSurface::DepthBuffer,
        has_texture, settings.surface.shadows};
}

const nature::Backdrop& Ground::backdrop() const {
    std::call_once(backdrop_once_, [this] {
        if (spacing_m() > 0.0) {
            backdrop_ = nature::make_backdrop({half_extent_m(), mean_height_m(), mean_colour(), water_level_m(),
                [this](const glm::dvec2& at_m) { return height_at(at_m.x, at_m.y).value_or(mean_height_m()); },
                [this](const glm::dvec2& at_m, double footprint_m) { return colour_at(at_m.x, at_m.y, footprint_m); },
                [this](const glm::dvec2& at_m, double footprint_m) {
                    return cover_code_at(at_m.x, at_m.y, footprint_m);
                }});
        }
    });
    return backdrop_;
}

namespace {

constexpr glm::vec3 asphalt(0.44F, 0.43F, 0.41F); ///< display values under a light of 1
constexpr double road_px = 1.2;                   ///< what looks as wide has its own colour ...
constexpr double min_road_px = 0.6;               ///< ... and what looks narrower is not painted
constexpr double level_error_px = 0.25;
constexpr double farthest_road_m = 40000.0; ///< roads beyond it are never painted
constexpr int max_road_triangles = 1200;
constexpr double max_road_share = 0.06; ///< of the triangles that are aimed at

/// A unit vector upwards from the ground.
glm::vec3 normal_of(const Ground& ground, const glm::dvec2& at_m) {
    const double step_m = ground.spacing_m();
    const double own_m = ground.height_at(at_m.x, at_m.y).value_or(0.0);
    const auto height_m = [&](double x_m, double y_m) { return ground.height_at(x_m, y_m).value_or(own_m); };
    return glm::vec3(glm::normalize(glm::dvec3(height_m(at_m.x - step_m, at_m.y) - height_m(at_m.x + step_m, at_m.y),
        height_m(at_m.x, at_m.y - step_m) - height_m(at_m.x, at_m.y + step_m), 2.0 * step_m)));
}

glm::vec3 light_at(const Ground& ground, const nature::Daylight& day, const glm::dvec2& at_m) {
    const nature::LightVisibility left = ground.light_visibility(at_m.x, at_m.y);
    const float towards = std::max(glm::dot(normal_of(ground, at_m), glm::vec3(day.to_sun())), 0.0F);
    return day.ambient() * left.sky + day.sunlight() * (towards * left.sun);
}

/// The stretch of a road from one point to the next, on the plan around the eye.
nature::GroundPatch::Corners patch_of(
    const roads::RoadPoint& from, const roads::RoadPoint& to, const glm::dvec2& eye_m) {
    const glm::dvec2 from_m = from.at_m - eye_m;
    const glm::dvec2 to_m = to.at_m - eye_m;
    return {
        from_m - from.to_left_edge_m, to_m - to.to_left_edge_m, to_m + to.to_left_edge_m, from_m + from.to_left_edge_m};
}

/// From farther off a road looks too narrow.
double max_distance_of(double pixel_rad) {
    return std::min(2.0 * roads::half_width_m / (min_road_px * pixel_rad), farthest_road_m);
}

/// The coarsest level that looks right from so far.
std::size_t level_from(double distance_m, double pixel_rad) {
    const double allowed_m = level_error_px * distance_m * pixel_rad;
    std::size_t level = 0;
    while (level + 1 < roads::level_error_m.size() && roads::level_error_m[level + 1] <= allowed_m) { ++level; }
    return level;
}

/// The roads of a ground. Each section is shown by a level of detail; what looks about as narrow as a pixel takes the
/// colour of the ground before it is left out.
class RoadDecoration final : public nature::GroundDecoration {
public:
    /// The ground must outlive it.
    RoadDecoration(const Ground& ground, std::shared_ptr<const roads::RoadNetwork> network, const nature::Daylight& day)
        : ground_(ground), network_(std::move(network)), day_(day) {
        std::size_t segments = 0;
        for (const roads::RoadSection& section : network_->sections()) {
            SectionLight& own = sections_.emplace_back();
            const glm::dvec2 middle_m = 0.5 * (section.min_m + section.max_m);
            own.middle_m = glm::dvec3(middle_m, ground.height_at(middle_m.x, middle_m.y).value_or(0.0));
            own.radius_m = 0.5 * glm::distance(section.min_m, section.max_m);
            lowest_m_ = std::min(lowest_m_, own.middle_m.z);
            for (std::size_t level = 0; level < section.levels.size(); ++level) {
                own.first_light[level] = segments;
                segments += section.levels[level].size() - 1;
            }
        }
        lights_.resize(segments);
        seen_of_.resize(sections_.size());
    }

    /// Nothing stands on a road, and more houses stand along it.
    void limit_scenery(const glm::dvec2& middle_m, double cell_m, nature::SceneryDensity& density) const override {
        constexpr double along_road_m = 90.0;
        constexpr float houses_along_road = 8.0F; ///< times as many
        if (network_->is_near(middle_m, cell_m * 0.75 + roads::half_width_m)) {
            density = {};
        } else if (density.houses > 0.0F && network_->is_near(middle_m, along_road_m + cell_m)) {
            density.houses = std::min(houses_along_road * density.houses, 0.3F);
        }
    }

    int max_patch_triangles(const glm::dvec3& eye_m, double pixel_rad, int triangle_target) const override {
        const double reach_m = max_distance_of(pixel_rad);
        if (!is_within(eye_m, reach_m)) { return 0; }
        const double most = std::min<double>(max_road_triangles, max_road_share * triangle_target);
        return static_cast<int>(most * std::min(2.0 - 2.0 * (eye_m.z - lowest_m_) / reach_m, 1.0));
    }

    bool begin_lying(const glm::dvec3& eye_m, double pixel_rad) override {
        eye_m_ = eye_m;
        pixel_rad_ = pixel_rad;
        reach_m_ = max_distance_of(pixel_rad);
        ++frame_;
        seen_.clear();
        return is_within(eye_m, reach_m_);
    }

    bool may_lie_in(const glm::dvec2& min_m, const glm::dvec2& max_m) const override {
        const glm::dvec2 first_m = glm::max(min_m, glm::dvec2(eye_m_) - reach_m_);
        const glm::dvec2 last_m = glm::min(max_m, glm::dvec2(eye_m_) + reach_m_);
        return first_m.x <= last_m.x && first_m.y <= last_m.y && network_->may_intersect(first_m, last_m);
    }

    void find_patches(
        const glm::dvec2& min_m, const glm::dvec2& max_m, std::vector<nature::GroundPatch>& patches) override {
        const glm::dvec2 eye_m(eye_m_);
        if (!network_->may_intersect(min_m + eye_m, max_m + eye_m)) { return; }
        numbers_.clear();
        network_->sections_in_box(min_m + eye_m, max_m + eye_m, numbers_);
        std::ranges::sort(numbers_);
        numbers_.erase(std::unique(numbers_.begin(), numbers_.end()), numbers_.end());
        for (const std::uint32_t number : numbers_) {
            if (seen_of_[number].frame != frame_) { choose(number); }
            for (std::size_t i = seen_of_[number].first; i < seen_of_[number].end; ++i) {
                const nature::GroundPatch& patch = seen_[i];
                if (patch.min_m.x < max_m.x && patch.max_m.x > min_m.x && patch.min_m.y < max_m.y &&
                    patch.max_m.y > min_m.y) {
                    patches.push_back(patch);
                }
            }
        }
    }

private:
    struct SectionLight {
        glm::dvec3 middle_m{0.0};
        double radius_m = 0.0;
        /// For each level the place of its segments in lights_.
        std::array<std::size_t, roads::level_error_m.size()> first_light{};
        std::array<bool, roads::level_error_m.size()> is_lit{};
    };

    /// The patches of a section in seen_, if they have been chosen in this frame.
    struct SectionPatches {
        std::uint64_t frame = 0;
        std::size_t first = 0;
        std::size_t end = 0;
    };

    /// False only for an eye from which no road can be seen.
    bool is_within(const glm::dvec3& eye_m, double reach_m) const {
        const glm::dvec2 at_m(eye_m);
        return eye_m.z - lowest_m_ < reach_m && network_->may_intersect(at_m - reach_m, at_m + reach_m);
    }

    void light(std::uint32_t number, std::size_t level) {
        const std::vector<roads::RoadPoint>& points = network_->sections()[number].levels[level];
        for (std::size_t i = 1; i < points.size(); ++i) {
            lights_[sections_[number].first_light[level] + i - 1] =
                light_at(ground_, day_, 0.5 * (points[i - 1].at_m + points[i].at_m));
        }
        sections_[number].is_lit[level] = true;
    }

    /// The segments of a section as this frame shows them, none where they look too narrow.
    void choose(std::uint32_t number) {
        const SectionLight& section = sections_[number];
        const double nearest_m = std::max(glm::distance(section.middle_m, eye_m_) - section.radius_m, 1.0);
        const std::size_t level = level_from(nearest_m, pixel_rad_);
        const std::vector<roads::RoadPoint>& points = network_->sections()[number].levels[level];
        if (!section.is_lit[level]) { light(number, level); }
        seen_of_[number] = {frame_, seen_.size(), seen_.size()};
        for (std::size_t i = 1; i < points.size(); ++i) {
            const glm::dvec2 at_m = 0.5 * (points[i - 1].at_m + points[i].at_m);
            const double distance_m = glm::distance(glm::dvec3(at_m, section.middle_m.z), eye_m_);
            const double seen_px = 2.0 * roads::half_width_m / (distance_m * pixel_rad_);
            if (seen_px <= min_road_px) { continue; }
            nature::GroundPatch& patch = seen_.emplace_back(patch_of(points[i - 1], points[i], glm::dvec2(eye_m_)));
            patch.colour = asphalt * lights_[section.first_light[level] + i - 1];
            patch.own_share =
                static_cast<float>(std::clamp((seen_px - min_road_px) / (road_px - min_road_px), 0.0, 1.0));
            patch.is_required = false;
            patch.is_on_water = false;
        }
        seen_of_[number].end = seen_.size();
    }

    const Ground& ground_;
    std::shared_ptr<const roads::RoadNetwork> network_;
    nature::Daylight day_;
    double lowest_m_ = std::numeric_limits<double>::infinity(); ///< of the roads
    std::vector<SectionLight> sections_;
    std::vector<glm::vec3> lights_; ///< of segments, computed when they are first seen
    glm::dvec3 eye_m_{0.0};
    double pixel_rad_ = 0.0;
    double reach_m_ = 0.0;
    std::vector<SectionPatches> seen_of_; ///< one a section
    std::vector<nature::GroundPatch> seen_;
    std::vector<std::uint32_t> numbers_;
    std::uint64_t frame_ = 0;
};

} // namespace

nature::GroundDecorations Ground::lying_decorations(const MeshSettings& settings) const {
    nature::GroundDecorations decorations;
    const nature::Daylight day = daylight_of(settings.air);
    if (runway()) { decorations.push_back(nature::runway_decoration(runway(), day)); }
    if (settings.ground.roads && !settings.has_texture) {
        if (auto network = road_network()) {
            decorations.push_back(std::make_unique<RoadDecoration>(*this, std::move(network), day));
        }
    }
    return decorations;
}

std::unique_ptr<GroundMesher> Ground::mesher(const MeshSettings& settings) const {
    assert(has_mesh_settings(settings.ground));
    std::unique_ptr<GroundMesher> mesher = make_mesher();
    mesher->apply_settings(settings);
    return mesher;
}

void GroundMesher::apply_settings(const MeshSettings& settings) { decorations_ = ground().lying_decorations(settings); }

std::unique_ptr<GroundMesher> reuse_or_make_mesher(
    std::unique_ptr<GroundMesher> before, const Ground& ground, const MeshSettings& settings) {
    assert(ground.has_mesh_settings(settings.ground));
    if (!before || (&before->ground() != &ground && !before->switch_ground(ground.shared_from_this()))) {
        return ground.mesher(settings);
    }
    before->apply_settings(settings);
    return before;
}

} // namespace octant::visuals::landscape
