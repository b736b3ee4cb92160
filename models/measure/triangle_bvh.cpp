// A bounding volume hierarchy with four boxes a node, after I. Wald, C. Benthin, S. Boulos, "Getting rid of packets",
// 2008. A node's four parts come from splitting twice in two (split()), and the four boxes are tested with one
// instruction each.
//
// Why results are exact although boxes are in float: a box or triangle is skipped only when its distance in float, less
// the largest possible rounding (Probe::slack), exceeds the best distance found so far. So what is skipped cannot hold
// a nearer point.
//
// Splits between bins by the surface area heuristic: I. Wald, "On fast construction of SAH-based bounding volume
// hierarchies", 2007. The cost of a split is the sum over both parts of surface area times number of triangles, which
// stands for the expected work of a search: here in full leaves, as a leaf takes the same time however many triangles
// it holds.
//
// Deviations: from depth 64 on, and where no bin separates the triangles, they are split at the median, so that the
// depth is bounded.

#include "models/measure/triangle_bvh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace octant::models::measure {

// Frames of triangles: a rotation into the plane, a two-dimensional distance to the edges and the height above the
// plane give the distance in float without branches, for several triangles or points at once.

namespace {

float inverse(double value) { return value > 1e-30 ? static_cast<float>(1.0 / value) : 0.0F; }

/// An edge shorter than this has no direction, because its square loses digits.
constexpr double min_length = 1e-100;
/// A height below this share of an edge's length consists of rounding too much to be perpendicular to the other edge.
constexpr double min_height = 1e-8;

/// Any unit vector perpendicular to a unit vector.
glm::dvec3 across(const glm::dvec3& axis) {
    const glm::dvec3 helper = std::abs(axis.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    return glm::normalize(glm::cross(axis, helper));
}

/// Replaces `found` by the nearest point of the segment from corner i to corner j if that is nearer to the origin. The
/// nearest point of a segment without length is its first end.
void update_from_edge(const std::array<glm::dvec3, 3>& corners, int i, int j, NearestOnTriangle& found) {
    const glm::dvec3& start = corners[static_cast<std::size_t>(i)];
    const glm::dvec3& end = corners[static_cast<std::size_t>(j)];
    const glm::dvec3 edge = end - start;
    const double length2 = glm::dot(edge, edge);
    const double along = length2 > 0.0 ? std::clamp(-glm::dot(start, edge) / length2, 0.0, 1.0) : 0.0;
    const glm::dvec3 point = along < 1.0 ? start + along * edge : end;
    const double distance2 = glm::dot(point, point);
    if (distance2 < found.distance2) {
        found = {point, glm::dvec3(0.0), distance2};
        found.weights[i] = 1.0 - along;
        found.weights[j] = along;
    }
}

/// Whether a corner is the point of its triangle nearest to the origin: both edges at it lead away from the origin.
bool is_at_corner(const glm::dvec3& corner, const glm::dvec3& to_one, const glm::dvec3& to_other) {
    return glm::dot(corner, to_one) >= 0.0 && glm::dot(corner, to_other) >= 0.0;
}

/// The point of a triangle's plane that is nearest to the origin, as barycentric weights.
struct NearestInPlane {
    glm::dvec3 weights{-1.0};
    bool uncertain = true; ///< The triangle is nearly a line, and the weights may be wrong.
};

/// The nearest point in the plane of a triangle whose longest edge `base` runs from corner 0 to corner 1. It is found
/// along that edge and along the height over it, which keeps its accuracy for thin triangles. The weights are in the
/// order of the corners.
NearestInPlane nearest_over_base(const glm::dvec3& from, const glm::dvec3& base, const glm::dvec3& side, double base2) {
    const double foot = glm::dot(side, base) / base2;
    const glm::dvec3 height = side - foot * base;
    const double height2 = glm::dot(height, height);
    if (!(height2 > 0.0)) { return {}; }
    const double along = -glm::dot(from, base) / base2;
    const double up = -glm::dot(from + along * base, height) / height2;
    const double end = along - up * foot;
    return {{1.0 - up - end, end, up}, height2 < 1e-12 * base2};
}

/// The nearest point in a triangle's plane: calls nearest_over_base with the longest edge as the base.
NearestInPlane nearest_in_plane(
    const std::array<glm::dvec3, 3>& corners, const glm::dvec3& ab, const glm::dvec3& bc, const glm::dvec3& ca) {
    const double ab2 = glm::dot(ab, ab);
    const double bc2 = glm::dot(bc, bc);
    const double ca2 = glm::dot(ca, ca);
    if (ca2 > std::max(ab2, bc2)) {
        const NearestInPlane found = nearest_over_base(corners[2], ca, -bc, ca2);
        return {{found.weights.y, found.weights.z, found.weights.x}, found.uncertain};
    }
    if (bc2 > ab2) {
        const NearestInPlane found = nearest_over_base(corners[1], bc, -ab, bc2);
        return {{found.weights.z, found.weights.x, found.weights.y}, found.uncertain};
    }
    return ab2 > 0.0 ? nearest_over_base(corners[0], ab, -ca, ab2) : NearestInPlane{};
}

/// The point of a triangle that is nearest to the origin.
NearestOnTriangle nearest_to_origin(const std::array<glm::dvec3, 3>& corners) {
    const auto& [a, b, c] = corners;
    const glm::dvec3 ab = b - a;
    const glm::dvec3 bc = c - b;
    const glm::dvec3 ca = a - c;
    const NearestInPlane plane = nearest_in_plane(corners, ab, bc, ca);
    const glm::dvec3& weights = plane.weights;
    NearestOnTriangle found{a, {1.0, 0.0, 0.0}, glm::dot(a, a)};
    if (weights.x > 0.0 && weights.y > 0.0 && weights.z > 0.0) {
        const glm::dvec3 point = weights.x * a + weights.y * b + weights.z * c;
        const NearestOnTriangle inside{point, weights, glm::dot(point, point)};
        if (!plane.uncertain) { return inside; }
        found = inside.distance2 < found.distance2 ? inside : found;
    }
    if (is_at_corner(a, ab, -ca)) { return {a, {1.0, 0.0, 0.0}, glm::dot(a, a)}; }
    if (is_at_corner(b, bc, -ab)) { return {b, {0.0, 1.0, 0.0}, glm::dot(b, b)}; }
    if (is_at_corner(c, ca, -bc)) { return {c, {0.0, 0.0, 1.0}, glm::dot(c, c)}; }
    if (plane.uncertain || !(weights.z > 0.0)) { update_from_edge(corners, 0, 1, found); }
    if (plane.uncertain || !(weights.x > 0.0)) { update_from_edge(corners, 1, 2, found); }
    if (plane.uncertain || !(weights.y > 0.0)) { update_from_edge(corners, 2, 0, found); }
    return found;
}

} // namespace

NearestOnTriangle nearest_on_triangle(
    const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    NearestOnTriangle found = nearest_to_origin({a - point, b - point, c - point});
    found.point += point;
    return found;
}

PlaneFrame<float> plane_frame(const std::array<glm::dvec3, 3>& corners) {
    const glm::dvec3 ab = corners[1] - corners[0];
    const glm::dvec3 ac = corners[2] - corners[0];
    const double length = glm::length(ab);
    const glm::dvec3 x_axis = length > min_length ? ab / length : glm::dvec3(1.0, 0.0, 0.0);
    const double along = glm::dot(ac, x_axis);
    const glm::dvec3 height = ac - along * x_axis;
    const double up = glm::length(height);
    const glm::dvec3 y_axis = up > min_height * glm::length(ac) ? height / up : across(x_axis);
    PlaneFrame<float> t{};
    t.origin = narrow(corners[0]);
    t.x_axis = narrow(x_axis);
    t.y_axis = narrow(y_axis);
    t.normal = narrow(glm::cross(x_axis, y_axis));
    t.bx = static_cast<float>(length);
    t.cx = static_cast<float>(along);
    t.cy = static_cast<float>(up);
    t.per_ab2 = inverse(length * length);
    t.per_bc2 = inverse((along - length) * (along - length) + up * up);
    t.per_ca2 = inverse(along * along + up * up);
    return t;
}

/// An axis-aligned bounding box in single precision; at first it holds nothing.
struct Extent {
    glm::vec3 min{std::numeric_limits<float>::infinity()};
    glm::vec3 max{-std::numeric_limits<float>::infinity()};

    void take(const glm::vec3& point) {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }

    void take(const Extent& other) {
        min = glm::min(min, other.min);
        max = glm::max(max, other.max);
    }

    /// Half the surface area; 0 for an empty box.
    double half_area() const {
        const glm::dvec3 size = glm::dvec3(max) - glm::dvec3(min);
        return size.x >= 0.0 ? size.x * size.y + size.y * size.z + size.z * size.x : 0.0;
    }
};

/// A triangle while the tree is being built, with its bounding box.
struct Item {
    Extent extent;
    std::uint32_t triangle = 0;

    glm::vec3 middle() const { return 0.5F * (extent.min + extent.max); }
};

namespace {

int longest_axis(const Extent& extent) {
    const glm::vec3 size = extent.max - extent.min;
    const int first = size.y > size.x ? 1 : 0;
    return size.z > size[first] ? 2 : first;
}

constexpr std::size_t bin_count = 16;
constexpr std::size_t leaf_lanes = 4; // TriangleBvh::lanes.
/// 64 levels and then 32 of halving, two to a node: at most 48 nodes deep, and each lets at most 3 of its 4 boxes wait.
/// That is below TriangleBvh's stack.
constexpr int median_depth = 64;
/// Centres closer together than this are not told apart by bins.
constexpr float min_size = 1e-30F;

/// A division of the longest axis into bins of equal width.
struct Bins {
    float start = 0.0F;
    float scale = 0.0F;
    int axis = 0;

    std::size_t bin_of(const Item& item) const {
        const float place = (item.middle()[axis] - start) * scale;
        return std::min(bin_count - 1, static_cast<std::size_t>(std::max(0.0F, place)));
    }
};

double leaves_of(std::size_t triangles) { return static_cast<double>((triangles + leaf_lanes - 1) / leaf_lanes); }

/// The first bin of the second part at the cheapest split; 0 when all items lie in one bin.
std::size_t cheapest_split(std::span<const Item> items, const Bins& bins) {
    std::array<Extent, bin_count> extents;
    std::array<std::size_t, bin_count> counts{};
    for (const Item& item : items) {
        const std::size_t bin = bins.bin_of(item);
        extents[bin].take(item.extent);
        ++counts[bin];
    }
    std::array<double, bin_count> behind{};
    Extent extent;
    std::size_t count = 0;
    for (std::size_t bin = bin_count - 1; bin > 0; --bin) {
        extent.take(extents[bin]);
        count += counts[bin];
        behind[bin] = extent.half_area() * leaves_of(count);
    }
    extent = {};
    count = 0;
    std::size_t best = 0;
    double min = std::numeric_limits<double>::infinity();
    for (std::size_t bin = 1; bin < bin_count; ++bin) {
        extent.take(extents[bin - 1]);
        count += counts[bin - 1];
        const double cost = extent.half_area() * leaves_of(count) + behind[bin];
        if (count > 0 && count < items.size() && cost < min) {
            min = cost;
            best = bin;
        }
    }
    return best;
}

/// Reorders the items into two parts, neither of them empty, and returns the size of the first. The split is between
/// bins on the longest axis of the centres, by the surface area heuristic; from depth 64 on, and where no bin separates
/// them, it is at the median. There must be at least two items.
std::size_t split(std::span<Item> items, int depth) {
    Extent middles;
    for (const Item& item : items) { middles.take(item.middle()); }
    Bins bins;
    bins.axis = longest_axis(middles);
    bins.start = middles.min[bins.axis];
    const float size = middles.max[bins.axis] - bins.start;
    if (size > min_size && depth < median_depth) {
        bins.scale = static_cast<float>(bin_count) / size;
        const std::size_t bin = cheapest_split(items, bins);
        if (bin > 0) {
            const auto behind =
                std::partition(items.begin(), items.end(), [&](const Item& item) { return bins.bin_of(item) < bin; });
            return static_cast<std::size_t>(behind - items.begin());
        }
    }
    const std::size_t half = items.size() / 2;
    std::ranges::sort(items, [&](const Item& one, const Item& other) {
        const float difference = one.middle()[bins.axis] - other.middle()[bins.axis];
        return difference < 0.0F || (difference == 0.0F && one.triangle < other.triangle);
    });
    return half;
}

/// The relative error of a distance in single precision, against the largest number that enters it.
constexpr double rounding = 4e-6;
/// In the tree's units. A point farther away than this is moved to it: every box is then in reach.
constexpr double farthest_place = 1e9;
/// A smaller mesh is treated as being this large.
constexpr double min_size_m = 1e-150;

double largest(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

} // namespace

struct TriangleBvh::Builder {
    TriangleBvh& tree;
    std::span<const glm::dvec3> vertices_m;
    std::span<const Triangle> triangles;
    std::vector<Item> items; ///< In the tree's units.

    /// A point in the tree's units.
    glm::dvec3 scaled(const glm::dvec3& point_m) const { return (point_m - tree.centre_m_) * tree.per_size_; }

    /// Sets one of a node's boxes to the bounds of some items.
    void set_box(Node& node, std::size_t lane, std::span<const Item> part) const {
        Extent extent;
        for (const Item& item : part) { extent.take(item.extent); }
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<std::size_t>(axis);
            node.min[i][lane] = extent.min[axis];
            node.max[i][lane] = extent.max[axis];
        }
    }

    /// Makes a leaf of up to four items and returns its number with leaf_bit.
    std::uint32_t leaf(std::size_t first, std::size_t count) const {
        Leaf made;
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const Item& item = items[first + std::min(lane, count - 1)];
            const auto& [a, b, c] = triangles[item.triangle];
            const PlaneFrame<float> frame =
                plane_frame({scaled(vertices_m[a]), scaled(vertices_m[b]), scaled(vertices_m[c])});
            for (std::size_t axis = 0; axis < 3; ++axis) {
                made.origin[axis][lane] = frame.origin[axis];
                made.x_axis[axis][lane] = frame.x_axis[axis];
                made.y_axis[axis][lane] = frame.y_axis[axis];
            }
            made.bx[lane] = frame.bx;
            made.cx[lane] = frame.cx;
            made.cy[lane] = frame.cy;
        }
        tree.firsts_.push_back(static_cast<std::uint32_t>(first));
        tree.leaves_.push_back(made);
        return static_cast<std::uint32_t>(tree.leaves_.size() - 1) | leaf_bit;
    }

    /// Makes a leaf or a subtree of some items, whichever they need.
    std::uint32_t below(std::size_t first, std::size_t count, int depth) {
        return count <= lanes ? leaf(first, count) : build(first, count, depth);
    }

    /// Makes a node of up to four parts by splitting the items twice, and returns its number.
    std::uint32_t build(std::size_t first, std::size_t count, int depth) {
        const auto number = static_cast<std::uint32_t>(tree.nodes_.size());
        tree.nodes_.push_back(empty_node());
        std::size_t lane = 0;
        const auto add = [&](std::size_t from, std::size_t size) {
            const std::uint32_t made = below(from, size, depth + 2);
            set_box(tree.nodes_[number], lane, std::span(items).subspan(from, size));
            tree.nodes_[number].below[lane++] = made;
        };
        const auto add_half = [&](std::size_t from, std::size_t size) {
            if (size <= lanes) {
                add(from, size);
                return;
            }
            const std::size_t left = split(std::span(items).subspan(from, size), depth + 1);
            add(from, left);
            add(from + left, size - left);
        };
        const std::size_t left = count > 1 ? split(std::span(items).subspan(first, count), depth) : count;
        add_half(first, left);
        if (left < count) { add_half(first + left, count - left); }
        return number;
    }

    static Node empty_node() {
        Node node{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            node.min[axis] = Floats{} + std::numeric_limits<float>::infinity();
            node.max[axis] = Floats{} - std::numeric_limits<float>::infinity();
        }
        return node;
    }
};

TriangleBvh::TriangleBvh(const TriangleMesh& mesh) : TriangleBvh(mesh.vertices_m, mesh.triangles) {}

TriangleBvh::TriangleBvh(std::span<const glm::dvec3> vertices_m, std::span<const Triangle> triangles) {
    if (triangles.empty()) { return; }
    glm::dvec3 min_m(std::numeric_limits<double>::infinity());
    glm::dvec3 max_m(-std::numeric_limits<double>::infinity());
    for (const Triangle& triangle : triangles) {
        for (const std::uint32_t vertex : triangle) {
            assert(vertex < vertices_m.size());
            min_m = glm::min(min_m, vertices_m[vertex]);
            max_m = glm::max(max_m, vertices_m[vertex]);
        }
    }
    centre_m_ = 0.5 * (min_m + max_m);
    const double size_m = 0.5 * largest(max_m - min_m);
    per_size_ = size_m > min_size_m ? 1.0 / size_m : 1.0 / min_size_m;
    const glm::dvec3 farthest = glm::max(glm::abs(min_m), glm::abs(max_m));
    rounding_m_ = 64.0 * std::numeric_limits<double>::epsilon() * largest(farthest);
    Builder builder{*this, vertices_m, triangles, std::vector<Item>(triangles.size())};
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        Item& item = builder.items[i];
        for (const std::uint32_t vertex : triangles[i]) {
            item.extent.take(glm::vec3(builder.scaled(vertices_m[vertex])));
        }
        item.triangle = static_cast<std::uint32_t>(i);
    }
    nodes_.reserve(triangles.size() / (2 * lanes) + 1);
    leaves_.reserve(triangles.size() / (lanes - 1) + 1);
    builder.build(0, triangles.size(), 0);
    firsts_.push_back(static_cast<std::uint32_t>(triangles.size()));
    triangles_.reserve(triangles.size());
    for (const Item& item : builder.items) { triangles_.push_back(item.triangle); }
    builder.items = std::vector<Item>(); // They are as large as the corners that are copied next.
    take_corners(vertices_m, triangles);
}

/// Copies the corners of the triangles in the order of the leaves, so that what lies near in space lies near in memory.
void TriangleBvh::take_corners(std::span<const glm::dvec3> vertices_m, std::span<const Triangle> triangles) {
    std::vector<std::uint32_t> places(vertices_m.size(), NearestOnMesh::none);
    corners_.reserve(triangles.size());
    vertices_m_.reserve(vertices_m.size());
    for (const std::uint32_t number : triangles_) {
        Triangle& corners = corners_.emplace_back(triangles[number]);
        for (std::uint32_t& corner : corners) {
            if (places[corner] == NearestOnMesh::none) {
                places[corner] = static_cast<std::uint32_t>(vertices_m_.size());
                vertices_m_.push_back(vertices_m[corner]);
            }
            corner = places[corner];
        }
    }
}

/// A probe at a point. Its slack covers the rounding of the point and of all that is computed from it: up to fifty
/// roundings of 2^-24 each, and those of the double precision before.
TriangleBvh::Probe TriangleBvh::probe(const glm::dvec3& point_m) const {
    const glm::dvec3 local = (point_m - centre_m_) * per_size_;
    Probe made;
    const glm::dvec3 within = glm::clamp(local, glm::dvec3(-farthest_place), glm::dvec3(farthest_place));
    for (int axis = 0; axis < 3; ++axis) {
        made.place[static_cast<std::size_t>(axis)] = Floats{} + static_cast<float>(within[axis]);
    }
    made.slack = rounding * (1.0 + largest(glm::abs(local))) + rounding_m_ * per_size_;
    return made;
}

/// Sets how far to look, rounded up; everything is looked at where the slack is too large.
void TriangleBvh::Probe::set_reach(double distance) {
    const double reach = distance + slack;
    const bool all = slack > 1.0 || !(reach < farthest_place);
    reach2 = all ? std::numeric_limits<float>::max() : static_cast<float>((1.0 + rounding) * reach * reach);
}

/// The state of one search for the nearest point.
struct TriangleBvh::Search {
    NearestOnMesh found;
    /// The square of the best distance so far; nothing farther is looked at.
    double reach2_m2 = 0.0;
    Probe probe;
};

void TriangleBvh::search_leaf(std::uint32_t leaf, const glm::dvec3& point_m, Search& search) const {
    const std::uint32_t first = firsts_[leaf];
    const std::size_t count = firsts_[leaf + 1] - first;
    Floats distances2;
    triangle_distances2(distances2, leaves_[leaf], search.probe);
    for (std::size_t looked = 0; looked < count; ++looked) {
        std::size_t i = 0;
        for (std::size_t lane = 1; lane < count; ++lane) { i = distances2[lane] < distances2[i] ? lane : i; }
        if (!(distances2[i] <= search.probe.reach2)) { return; }
        distances2[i] = std::numeric_limits<float>::infinity();
        const auto& [a, b, c] = corners_[first + i];
        const std::uint32_t triangle = triangles_[first + i];
        const NearestOnTriangle here =
            nearest_to_origin({vertices_m_[a] - point_m, vertices_m_[b] - point_m, vertices_m_[c] - point_m});
        const bool tie = here.distance2 == search.reach2_m2 && triangle < search.found.triangle;
        if (here.distance2 < search.reach2_m2 || tie) {
            search.found = {triangle, here.point, here.weights, here.distance2};
            search.reach2_m2 = here.distance2;
            search.probe.set_reach(std::sqrt(here.distance2) * per_size_);
        }
    }
}

NearestOnMesh TriangleBvh::nearest(const glm::dvec3& point, double within_m) const {
    if (nodes_.empty()) { return {}; }
    Search search;
    search.reach2_m2 = std::min(within_m * within_m, std::numeric_limits<double>::max());
    search.probe = probe(point);
    search.probe.set_reach(within_m * per_size_);

    std::array<float, max_waiting> away2; // The squared distances of the boxes that wait.
    std::array<std::uint32_t, max_waiting> waiting;
    std::size_t count = 0;
    away2[count] = 0.0F;
    waiting[count++] = 0;
    Floats distances2;
    while (count > 0) {
        --count;
        if (!(away2[count] <= search.probe.reach2)) { continue; }
        const std::uint32_t next = waiting[count];
        if ((next & leaf_bit) != 0) {
            search_leaf(next & ~leaf_bit, point, search);
            continue;
        }
        const Node& node = nodes_[next];
        box_distances2(distances2, node, search.probe);
        const std::size_t first = count;
        for (std::size_t i = 0; i < lanes; ++i) {
            const float here2 = distances2[i];
            if (!(here2 <= search.probe.reach2)) { continue; }
            // Sorted so that the nearest box comes last and is looked at first.
            std::size_t place = count++;
            for (; place > first && away2[place - 1] < here2; --place) {
                away2[place] = away2[place - 1];
                waiting[place] = waiting[place - 1];
            }
            away2[place] = here2;
            waiting[place] = node.below[i];
        }
    }
    search.found.point += point;
    return search.found;
}

} // namespace octant::models::measure
