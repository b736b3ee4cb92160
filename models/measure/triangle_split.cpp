// Splits between bins by the surface area heuristic: I. Wald, "On fast construction of SAH-based
// bounding volume hierarchies", 2007. The cost of a split is the sum over both parts of surface
// area times number of triangles, which stands for the expected work of a search: here in full
// leaves, as a leaf takes the same time however many triangles it holds.
//
// Deviations: from depth 64 on, and where no bin separates the triangles, they are split at the
// median, so that the depth is bounded.
#include "models/measure/triangle_split.h"

#include <algorithm>
#include <array>

namespace octant::models::measure {

namespace {

int longest_axis(const Extent& extent) {
    const glm::vec3 size = extent.most - extent.least;
    const int first = size.y > size.x ? 1 : 0;
    return size.z > size[first] ? 2 : first;
}

constexpr std::size_t bin_count = 16;
/// 64 levels and then 32 of halving, two to a node: at most 48 nodes deep, and each lets at most 3
/// of its 4 boxes wait. That is below TriangleBvh's stack.
constexpr int median_depth = 64;
/// Centres closer together than this are not told apart by bins.
constexpr float least_size = 1e-30F;

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

double leaves_of(std::size_t triangles) {
    return static_cast<double>((triangles + leaf_lanes - 1) / leaf_lanes);
}

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
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t bin = 1; bin < bin_count; ++bin) {
        extent.take(extents[bin - 1]);
        count += counts[bin - 1];
        const double cost = extent.half_area() * leaves_of(count) + behind[bin];
        if (count > 0 && count < items.size() && cost < least) {
            least = cost;
            best = bin;
        }
    }
    return best;
}

} // namespace

std::size_t split(std::span<Item> items, int depth) {
    Extent middles;
    for (const Item& item : items) {
        middles.take(item.middle());
    }
    Bins bins;
    bins.axis = longest_axis(middles);
    bins.start = middles.least[bins.axis];
    const float size = middles.most[bins.axis] - bins.start;
    if (size > least_size && depth < median_depth) {
        bins.scale = static_cast<float>(bin_count) / size;
        const std::size_t bin = cheapest_split(items, bins);
        if (bin > 0) {
            const auto behind = std::partition(items.begin(), items.end(), [&](const Item& item) {
                return bins.bin_of(item) < bin;
            });
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

} // namespace octant::models::measure
