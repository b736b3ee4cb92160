#include "models/measure/triangle_bvh.h"

#include "models/measure/nearest_point.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

// I. Wald, "On fast construction of SAH-based bounding volume hierarchies", 2007: splits between
// bins of the longest axis of the triangles' middles, by the surface area heuristic.
// Deviations: below depth 64, and where no bin splits, triangles are split at their median, so that
// the depth is bounded.

namespace octant::models::measure {

namespace {

struct Extent {
    glm::dvec3 least{std::numeric_limits<double>::infinity()};
    glm::dvec3 most{-std::numeric_limits<double>::infinity()};

    void take(const glm::dvec3& point) {
        least = glm::min(least, point);
        most = glm::max(most, point);
    }

    void take(const Extent& other) {
        least = glm::min(least, other.least);
        most = glm::max(most, other.most);
    }

    double half_area() const {
        const glm::dvec3 size = most - least;
        return size.x >= 0.0 ? size.x * size.y + size.y * size.z + size.z * size.x : 0.0;
    }
};

/// A triangle while the tree is built.
struct Item {
    Extent extent;
    glm::dvec3 middle{0.0};
    std::uint32_t triangle = 0;
};

int longest_axis(const Extent& extent) {
    const glm::dvec3 size = extent.most - extent.least;
    const int first = size.y > size.x ? 1 : 0;
    return size.z > size[first] ? 2 : first;
}

constexpr std::size_t bin_count = 16;
constexpr std::size_t leaf_size = 4;
constexpr int median_depth = 64; ///< 64 + 32 levels of halving stay below most_depth

struct Bins {
    double start = 0.0;
    double scale = 0.0;
    int axis = 0;

    std::size_t bin_of(const Item& item) const {
        const double place = (item.middle[axis] - start) * scale;
        return std::min(bin_count - 1, static_cast<std::size_t>(std::max(0.0, place)));
    }
};

/// The first bin behind the cheapest split; 0 when there is none.
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
        behind[bin] = extent.half_area() * static_cast<double>(count);
    }
    extent = {};
    count = 0;
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t bin = 1; bin < bin_count; ++bin) {
        extent.take(extents[bin - 1]);
        count += counts[bin - 1];
        const double cost = extent.half_area() * static_cast<double>(count) + behind[bin];
        if (count > 0 && count < items.size() && cost < least) {
            least = cost;
            best = bin;
        }
    }
    return best;
}

/// Orders the items into two parts, neither of them empty; gives the size of the first.
std::size_t split(std::span<Item> items, int depth) {
    Extent middles;
    for (const Item& item : items) {
        middles.take(item.middle);
    }
    Bins bins;
    bins.axis = longest_axis(middles);
    bins.start = middles.least[bins.axis];
    const double size = middles.most[bins.axis] - bins.start;
    if (size > 0.0 && depth < median_depth) {
        bins.scale = static_cast<double>(bin_count) / size;
        const std::size_t bin = cheapest_split(items, bins);
        if (bin > 0) {
            const auto behind =
                std::stable_partition(items.begin(), items.end(), [&](const Item& item) {
                    return bins.bin_of(item) < bin;
                });
            return static_cast<std::size_t>(behind - items.begin());
        }
    }
    const std::size_t half = items.size() / 2;
    std::ranges::sort(items, [&](const Item& one, const Item& other) {
        const double difference = one.middle[bins.axis] - other.middle[bins.axis];
        return difference < 0.0 || (difference == 0.0 && one.triangle < other.triangle);
    });
    return half;
}

} // namespace

struct TriangleBvh::Builder {
    TriangleBvh& tree;
    std::vector<Item> items;
    double margin = 0.0; ///< for the rounding of positions relative to the centre

    Box box_of(std::span<const Item> part) const {
        Extent extent;
        for (const Item& item : part) {
            extent.take(item.extent);
        }
        Box box{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            constexpr float far = std::numeric_limits<float>::infinity();
            const int a = static_cast<int>(axis);
            box.least[axis] = std::nextafter(static_cast<float>(extent.least[a] - margin), -far);
            box.most[axis] = std::nextafter(static_cast<float>(extent.most[a] + margin), far);
        }
        return box;
    }

    Box build(std::size_t first, std::size_t count, int depth) {
        const std::span<Item> part = std::span(items).subspan(first, count);
        Box box = box_of(part);
        if (count <= leaf_size) {
            box.first = static_cast<std::uint32_t>(first);
            box.count = static_cast<std::uint32_t>(count);
            return box;
        }
        box.first = static_cast<std::uint32_t>(tree.nodes_.size());
        tree.nodes_.emplace_back();
        const std::size_t left = split(part, depth);
        const Box one = build(first, left, depth + 1);
        const Box other = build(first + left, count - left, depth + 1);
        tree.nodes_[box.first] = {{one, other}};
        return box;
    }
};

TriangleBvh::TriangleBvh(const TriangleMesh& mesh)
    : TriangleBvh(mesh.vertices_m, mesh.triangles) {}

TriangleBvh::TriangleBvh(
    std::span<const glm::dvec3> vertices_m, std::span<const Triangle> triangles) {
    if (triangles.empty()) {
        return;
    }
    Extent whole;
    for (const Triangle& triangle : triangles) {
        for (const std::uint32_t vertex : triangle) {
            assert(vertex < vertices_m.size());
            whole.take(vertices_m[vertex]);
        }
    }
    centre_ = 0.5 * (whole.least + whole.most);
    const glm::dvec3 farthest = glm::max(glm::abs(whole.least), glm::abs(whole.most));
    rounding_m_ = 64.0 * std::numeric_limits<double>::epsilon() *
                  std::max({farthest.x, farthest.y, farthest.z});
    Builder builder{*this, std::vector<Item>(triangles.size()), rounding_m_};
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        Item& item = builder.items[i];
        for (const std::uint32_t vertex : triangles[i]) {
            item.extent.take(vertices_m[vertex] - centre_);
        }
        item.middle = 0.5 * (item.extent.least + item.extent.most);
        item.triangle = static_cast<std::uint32_t>(i);
    }
    nodes_.reserve(triangles.size());
    const Box root = builder.build(0, triangles.size(), 0);
    if (root.count > 0) { // a leaf alone: a node with it and an empty half
        Box empty{};
        empty.least.fill(std::numeric_limits<float>::infinity());
        empty.most.fill(-std::numeric_limits<float>::infinity());
        nodes_.push_back({{root, empty}});
    }
    corners_.reserve(triangles.size());
    triangles_.reserve(triangles.size());
    for (const Item& item : builder.items) {
        const Triangle& triangle = triangles[item.triangle];
        corners_.push_back(
            {vertices_m[triangle[0]], vertices_m[triangle[1]], vertices_m[triangle[2]]});
        triangles_.push_back(item.triangle);
    }
}

struct TriangleBvh::Search {
    NearestOnMesh found;
    double reach2 = 0.0; ///< nothing farther is looked at
};

void TriangleBvh::search_leaf(const Box& leaf, const glm::dvec3& point, Search& search) const {
    for (std::size_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
        const auto& [a, b, c] = corners_[i];
        const NearestOnTriangle here = detail::nearest_to_origin({a - point, b - point, c - point});
        const bool tie = here.distance2 == search.reach2 && triangles_[i] < search.found.triangle;
        if (here.distance2 < search.reach2 || tie) {
            search.found = {triangles_[i], here.point, here.weights, here.distance2};
            search.reach2 = here.distance2;
        }
    }
}

NearestOnMesh TriangleBvh::nearest(const glm::dvec3& point, double within_m) const {
    Search search;
    search.reach2 = std::min(within_m * within_m, std::numeric_limits<double>::max());
    if (nodes_.empty()) {
        return {};
    }

    struct Waiting {
        const Box* box;
        double distance2;
    };

    const glm::dvec3 local = point - centre_;
    std::array<Waiting, most_depth> waiting;
    std::size_t count = 0;
    const Node* node = nodes_.data();
    while (node != nullptr) {
        const Box* near = &node->halves[0];
        const Box* far = &node->halves[1];
        double near2 = box_distance2(*near, local);
        double far2 = box_distance2(*far, local);
        if (far2 < near2) {
            std::swap(near, far);
            std::swap(near2, far2);
        }
        waiting[count++] = {far, far2};
        waiting[count++] = {near, near2};
        node = nullptr;
        while (count > 0 && node == nullptr) {
            const Waiting next = waiting[--count];
            if (!(next.distance2 <= search.reach2)) {
                continue;
            }
            if (next.box->count == 0) {
                node = &nodes_[next.box->first];
            } else {
                search_leaf(*next.box, point, search);
            }
        }
    }
    search.found.point += point;
    return search.found;
}

} // namespace octant::models::measure
