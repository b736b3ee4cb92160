// Convex regions by the double description method: T. S. Motzkin, H. Raiffa, G. L. Thompson, R. M. Thrall, "The double
// description method", 1953. The region is known both by its half-spaces and by its generating rays. A cut keeps the
// rays in front of the new plane and adds one for each edge between a ray in front and one behind it. Edges are found
// by the combinatorial test of adjacency in K. Fukuda, A. Prodon, "Double description method revisited", 1996,
// proposition 7.
//
// Deviations:
// - Heights within 1e-10 of a plane count as on it.
// - Lines are kept apart from the rays, so that a region bounded by fewer than three planes needs
//   no artificial box around it.
#include "visuals/draworder/view_region.h"

#include <glm/geometric.hpp>

#include <cassert>
#include <cmath>
#include <span>

namespace octant::visuals::draworder {

namespace {

/// Planes that meet at a smaller angle, about, leave too few digits of where they meet.
constexpr double min_slope = 1e-4;

/// A half-space as a vector, whose dot product with a homogeneous point is the height.
glm::dvec4 front_of(const Plane& plane) { return {plane.normal, plane.offset_m}; }

} // namespace

ViewRegion ViewRegion::all_space() {
    ViewRegion all;
    all.lines_ = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
    all.rays_ = {{{0, 0, 0, 1}, {}}};
    all.facets_ = {{0, 0, 0, 1}};
    return all;
}

bool ViewRegion::intersects_front_of(const Plane& plane) const {
    const glm::dvec4 front = front_of(plane);
    for (const glm::dvec4& line : lines_) {
        if (std::abs(glm::dot(front, line)) > on_plane) { return true; }
    }
    for (const Ray& ray : rays_) {
        if (glm::dot(front, ray.at) > on_plane) { return true; }
    }
    return false;
}

std::optional<ViewRegion> ViewRegion::cut(const Plane& plane) const {
    const glm::dvec4 front = front_of(plane);
    std::size_t steepest = 0;
    double steepness = on_plane;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        const double slope = std::abs(glm::dot(front, lines_[i]));
        if (slope > steepness) {
            steepness = slope;
            steepest = i + 1;
        }
    }
    if (steepest > 0) { return cut_across_line(front, steepest - 1); }
    std::vector<double> heights;
    heights.reserve(rays_.size());
    bool some_front = false;
    bool some_back = false;
    for (const Ray& ray : rays_) {
        heights.push_back(glm::dot(front, ray.at));
        some_front = some_front || heights.back() > on_plane;
        some_back = some_back || heights.back() < -on_plane;
    }
    if (!some_front) { return std::nullopt; }
    return some_back ? cut_rays(front, heights) : *this;
}

/// The line becomes the one ray that is not on the new facet; everything else slides along it onto the facet.
ViewRegion ViewRegion::cut_across_line(const glm::dvec4& front, std::size_t line) const {
    assert(facets_.size() <= max_planes);
    ViewRegion out = *this;
    const double slope = glm::dot(front, lines_[line]);
    out.is_well_conditioned_ = is_well_conditioned_ && std::abs(slope) > min_slope;
    const glm::dvec4 inward = lines_[line] * (slope > 0.0 ? 1.0 : -1.0);
    const auto slid = [&](const glm::dvec4& at) {
        return glm::normalize(at - inward * (glm::dot(front, at) / std::abs(slope)));
    };
    out.lines_.erase(out.lines_.begin() + static_cast<std::ptrdiff_t>(line));
    for (glm::dvec4& other : out.lines_) { other = slid(other); }
    Ray added{inward, {}};
    for (std::size_t facet = 0; facet < facets_.size(); ++facet) { added.on[facet] = true; }
    for (Ray& ray : out.rays_) {
        ray.at = slid(ray.at);
        ray.on[facets_.size()] = true;
    }
    out.rays_.push_back(added);
    out.facets_.push_back(front);
    out.straighten();
    return out;
}

/// Makes the lines perpendicular to one another and the rays to the lines: what generates a region is then the same
/// whatever the axes are.
void ViewRegion::straighten() {
    const auto without = [](glm::dvec4 at, std::span<const glm::dvec4> lines) {
        for (const glm::dvec4& line : lines) { at -= line * glm::dot(line, at); }
        return glm::normalize(at);
    };
    for (std::size_t i = 0; i < lines_.size(); ++i) { lines_[i] = without(lines_[i], std::span(lines_).first(i)); }
    for (Ray& ray : rays_) { ray.at = without(ray.at, lines_); }
}

/// Two rays of a cone span an edge of it unless a third one lies on all facets on which both lie.
bool ViewRegion::adjacent(std::size_t a, std::size_t b) const {
    const Facets both = rays_[a].on & rays_[b].on;
    const bool share_enough = lines_.empty() ? both.count() > 1 : lines_.size() > 1 || both.any();
    if (!share_enough) { return false; }
    for (std::size_t i = 0; i < rays_.size(); ++i) {
        if (i != a && i != b && (both & rays_[i].on) == both) { return false; }
    }
    return true;
}

ViewRegion ViewRegion::cut_rays(const glm::dvec4& front, const std::vector<double>& heights) const {
    assert(facets_.size() <= max_planes);
    ViewRegion out;
    out.is_well_conditioned_ = is_well_conditioned_;
    out.lines_ = lines_;
    out.facets_ = facets_;
    out.facets_.push_back(front);
    out.rays_.reserve(rays_.size() + 4);
    for (std::size_t i = 0; i < rays_.size(); ++i) {
        if (heights[i] >= -on_plane) {
            out.rays_.push_back(rays_[i]);
            if (heights[i] <= on_plane) { out.rays_.back().on[facets_.size()] = true; }
        }
    }
    for (std::size_t i = 0; i < rays_.size(); ++i) {
        for (std::size_t j = 0; heights[i] > on_plane && j < rays_.size(); ++j) {
            if (heights[j] < -on_plane && adjacent(i, j)) {
                const glm::dvec4 at = rays_[j].at * heights[i] - rays_[i].at * heights[j];
                const double length = glm::length(at);
                out.is_well_conditioned_ = out.is_well_conditioned_ && length > min_slope * (heights[i] - heights[j]);
                Ray added{at / length, rays_[i].on & rays_[j].on};
                added.on[facets_.size()] = true;
                out.rays_.push_back(added);
            }
        }
    }
    return out;
}

void ViewRegion::append_generators(std::vector<glm::dvec4>& generators) const {
    for (const Ray& ray : rays_) { generators.push_back(ray.at); }
    for (const glm::dvec4& line : lines_) {
        generators.push_back(line);
        generators.push_back(-line);
    }
}

std::optional<glm::dvec3> ViewRegion::interior_point() const {
    glm::dvec4 sum(0.0);
    for (const Ray& ray : rays_) { sum += ray.at; }
    if (sum.w <= 0.0) { return std::nullopt; }
    return glm::dvec3(sum.x, sum.y, sum.z) / sum.w;
}

/// A facet is redundant when all rays on it lie on another facet, too, and the region without it is no larger: in a thin
/// region rays are on facets by rounding alone. Where rays are not known well enough to tell, none is.
std::vector<Plane> ViewRegion::planes() const {
    const auto plane_of = [&](std::size_t facet) {
        return Plane{{facets_[facet].x, facets_[facet].y, facets_[facet].z}, facets_[facet].w};
    };
    std::vector<bool> kept(facets_.size(), true);
    const bool is_known = is_well_conditioned_ && interior_point();
    for (std::size_t i = 1; i < facets_.size() && is_known; ++i) {
        for (std::size_t other = 0; other < facets_.size() && kept[i]; ++other) {
            bool within = other != i && kept[other];
            for (const Ray& ray : rays_) { within = within && (!ray.on[i] || ray.on[other]); }
            kept[i] = !within;
        }
    }
    std::optional<ViewRegion> region = all_space();
    for (std::size_t i = 1; i < facets_.size() && region; ++i) {
        if (kept[i]) { region = region->cut(plane_of(i)); }
    }
    for (std::size_t i = 1; i < facets_.size() && region; ++i) {
        const Plane behind{-plane_of(i).normal, -plane_of(i).offset_m};
        if (!kept[i] && region->intersects_front_of(behind)) {
            kept[i] = true;
            region = region->cut(plane_of(i));
        }
    }
    std::vector<Plane> planes;
    for (std::size_t i = 1; i < facets_.size(); ++i) {
        if (kept[i] || !region) { planes.push_back(plane_of(i)); }
    }
    return planes;
}

} // namespace octant::visuals::draworder
