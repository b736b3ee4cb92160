#include "visuals/planning/scene_order.h"

#include "visuals/bsp/component_search.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace octant::visuals::planning {

class SceneOrder::Search {
public:
    /// Boxes with the eye at the origin.
    void arrange(std::span<const OrientedBox> boxes) {
        place_bodies(boxes);
        find_windows();
        overlap_groups_.clear();
        members_.clear();
        std::uint32_t body = 0;
        const auto add_single_bodies_until = [&](std::size_t end) {
            for (; body < end; ++body) { add_overlap_group(std::span(&body, 1), 0); }
        };
        std::size_t next = 0;
        while (next < windows_.size()) {
            auto [first, last] = windows_[next++];
            while (next < windows_.size() && windows_[next].first <= last) {
                last = std::max(last, windows_[next++].second);
            }
            add_single_bodies_until(first);
            arrange_window(first, last);
            body = last + 1;
        }
        add_single_bodies_until(bodies_.size());
    }

    /// Farthest first: no member of a group hides any part of a member of a later one from the eye.
    std::span<const OverlapGroup> overlap_groups() const { return overlap_groups_; }

    /// The boxes of a group, by index, ascending.
    std::span<const std::uint32_t> members(const OverlapGroup& overlap_group) const {
        return std::span(members_).subspan(overlap_group.first, overlap_group.count);
    }

private:
    struct Body {
        OrientedBox box;
        double radius_m = 0.0;
        double power_m2 = 0.0;
        /// A unit vector.
        glm::dvec3 towards{0.0};
        /// Of half the angle over which the sphere is seen.
        double sine = 0.0;
        double cosine = 0.0;
        /// Whether the sphere holds the eye.
        bool around_eye = false;
        /// The index of the box.
        std::uint32_t index = 0;
    };

    /// False only if the spheres around two boxes do not overlap in the picture.
    static bool may_overlap_on_screen(const Body& a, const Body& b) {
        return a.around_eye || b.around_eye ||
               glm::dot(a.towards, b.towards) >= a.cosine * b.cosine - a.sine * b.sine - 1e-9;
    }

    void place_bodies(std::span<const OrientedBox> boxes) {
        bodies_.clear();
        for (std::uint32_t i = 0; i < boxes.size(); ++i) {
            Body& body = bodies_.emplace_back();
            body.box = boxes[i];
            body.index = i;
            body.radius_m = radius_m(body.box);
            const double distance_m = glm::length(body.box.centre_m);
            body.power_m2 = distance_m * distance_m - body.radius_m * body.radius_m;
            body.around_eye = distance_m <= body.radius_m;
            if (!body.around_eye) {
                body.towards = body.box.centre_m / distance_m;
                body.sine = body.radius_m / distance_m;
                body.cosine = std::sqrt(1.0 - body.sine * body.sine);
            }
        }
        std::ranges::sort(bodies_, [](const Body& a, const Body& b) {
            return a.power_m2 != b.power_m2 ? a.power_m2 > b.power_m2 : a.index < b.index;
        });
    }

    /// Sweeps along x for bodies whose spheres intersect. A window is a range of bodies_ from a body to one that it
    /// hides although that comes later.
    void find_windows() {
        windows_.clear();
        by_x_.resize(bodies_.size());
        std::iota(by_x_.begin(), by_x_.end(), 0U);
        const auto min_x = [&](std::uint32_t i) { return bodies_[i].box.centre_m.x - bodies_[i].radius_m; };
        std::ranges::sort(by_x_,
            [&](std::uint32_t a, std::uint32_t b) { return min_x(a) != min_x(b) ? min_x(a) < min_x(b) : a < b; });
        for (std::size_t i = 0; i < by_x_.size(); ++i) {
            const Body& body = bodies_[by_x_[i]];
            const double max_x = body.box.centre_m.x + body.radius_m;
            for (std::size_t k = i + 1; k < by_x_.size() && min_x(by_x_[k]) <= max_x; ++k) {
                const Body& other = bodies_[by_x_[k]];
                const glm::dvec3 apart_m = other.box.centre_m - body.box.centre_m;
                const double radii_m = body.radius_m + other.radius_m;
                if (glm::dot(apart_m, apart_m) > radii_m * radii_m) { continue; }
                const auto [earlier, later] = std::minmax(by_x_[i], by_x_[k]);
                if (occlusion_pair(bodies_[earlier].box, bodies_[later].box).a_occludes_b) {
                    windows_.emplace_back(earlier, later);
                }
            }
        }
        std::ranges::sort(windows_);
    }

    /// Adds the groups of bodies first .. last: the strongly connected components of the relation "is hidden by", found
    /// by descending power where there is a choice.
    void arrange_window(std::uint32_t first, std::uint32_t last) {
        const std::uint32_t count = last - first + 1;
        find_occluded(first, count);
        window_.resize(count);
        std::iota(window_.begin(), window_.end(), 0U);
        components_.search(
            count, window_, [&](std::uint32_t body, std::size_t word) { return occluded_[body * words_ + word]; },
            [&](std::span<const std::uint32_t> component) { add_overlap_group(component, first); });
    }

    void find_occluded(std::uint32_t first, std::uint32_t count) {
        words_ = (count + 63) / 64;
        occluded_.assign(count * words_, 0);
        const auto add = [&](std::uint32_t body, std::uint32_t occluded) {
            occluded_[body * words_ + occluded / 64] |= std::uint64_t{1} << occluded % 64;
        };
        for (std::uint32_t a = 0; a < count; ++a) {
            const Body& earlier = bodies_[first + a];
            for (std::uint32_t b = a + 1; b < count; ++b) {
                const Body& later = bodies_[first + b];
                if (!may_overlap_on_screen(earlier, later)) { continue; }
                const OcclusionPair pair = occlusion_pair(earlier.box, later.box);
                if (pair.a_occludes_b) { add(a, b); }
                if (pair.b_occludes_a) { add(b, a); }
            }
        }
    }

    /// `bodies` count from body `first`.
    void add_overlap_group(std::span<const std::uint32_t> bodies, std::uint32_t first) {
        OverlapGroup& overlap_group = overlap_groups_.emplace_back();
        overlap_group.first = static_cast<std::uint32_t>(members_.size());
        overlap_group.count = static_cast<std::uint32_t>(bodies.size());
        overlap_group.box = bodies_[first + bodies.front()].box;
        AxisAlignedBox extent = world_bounds(overlap_group.box);
        for (const std::uint32_t body : bodies) {
            const AxisAlignedBox own = world_bounds(bodies_[first + body].box);
            extent.min_m = glm::min(extent.min_m, own.min_m);
            extent.max_m = glm::max(extent.max_m, own.max_m);
            members_.push_back(bodies_[first + body].index);
        }
        if (overlap_group.count > 1) {
            overlap_group.box = oriented_box(extent);
            std::ranges::sort(std::span(members_).subspan(overlap_group.first));
        }
    }

    /// By descending power.
    std::vector<Body> bodies_;
    std::vector<std::uint32_t> by_x_;
    /// The first and the last body of each.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> windows_;
    /// Of a window, counted from its first body: for each body a row of words_ words with the bits of those it can
    /// hide.
    std::vector<std::uint64_t> occluded_;
    std::size_t words_ = 0;
    std::vector<std::uint32_t> window_; ///< 0, 1, ...
    bsp::ComponentSearch components_;
    std::vector<OverlapGroup> overlap_groups_;
    std::vector<std::uint32_t> members_;
};

SceneOrder::SceneOrder() : search_(std::make_unique<Search>()) {}

SceneOrder::~SceneOrder() = default;

void SceneOrder::arrange(std::span<const OrientedBox> boxes) { search_->arrange(boxes); }

std::span<const OverlapGroup> SceneOrder::overlap_groups() const { return search_->overlap_groups(); }

std::span<const std::uint32_t> SceneOrder::members(const OverlapGroup& group) const { return search_->members(group); }

} // namespace octant::visuals::planning
