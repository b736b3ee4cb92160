#include "visuals/nature/near_detail_histogram.h"

#include "visuals/nature/near_detail_edges.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace octant::visuals::nature {

namespace {

/// Of the halvings that may be made: edges are halved for their neighbours' sake, too.
constexpr float share_aimed_at = 0.85F;
constexpr std::uint32_t bits_of_one = 127U << 23U;
constexpr unsigned bin_shift = 18; ///< 32 bins for each doubling

/// Whether a triangle is so far off that none of its edges looks longer.
bool is_far(const std::array<glm::vec3, 3>& triangle, float min_edge_rad) {
    const auto& [a, b, c] = triangle;
    const float longest2 = std::max({squared_length(b - a), squared_length(c - b), squared_length(a - c)});
    const float over_longest = 1.0F + 1.0F / min_edge_rad;
    return squared_length(a) >= over_longest * over_longest * longest2;
}

} // namespace

float NearDetailHistogram::min_edge_rad_for_budget(const terrain::GroundMesh& mesh, const NearDetailView& view) {
    view_ = view;
    min_angular_size2_ = view.min_edge_rad * view.min_edge_rad;
    split_counts_.fill(0);
    counted_ = 0;
    is_near_.resize(mesh.indices.size() / 3);
    for (std::size_t i = 0; i < is_near_.size(); ++i) {
        const Triangle triangle{
            mesh.vertices[mesh.indices[3 * i]].position_m,
            mesh.vertices[mesh.indices[3 * i + 1]].position_m,
            mesh.vertices[mesh.indices[3 * i + 2]].position_m};
        is_near_[i] = is_far(triangle, view.min_edge_rad) ? 0 : 1;
        if (is_near_[i] != 0) {
            count(triangle, min_angular_size2_ * static_cast<float>(1U << (bins / bins_an_octave)), 0);
        }
    }
    const float aim = share_aimed_at * static_cast<float>(view.max_splits);
    auto left = static_cast<float>(counted_);
    std::size_t bin = 0;
    while (bin < bins && left - static_cast<float>(split_counts_[bin]) > aim) {
        left -= static_cast<float>(split_counts_[bin++]);
    }
    if (left <= aim || bin == bins) {
        return view.min_edge_rad * std::exp2(0.5F * static_cast<float>(bin) / bins_an_octave);
    }
    const float part = (left - aim) / static_cast<float>(split_counts_[bin]);
    const float octaves = (static_cast<float>(bin) + part) / bins_an_octave;
    return view.min_edge_rad * std::exp2(0.5F * octaves);
}

/// As NearDetailMesh halves it, by the longest edge. Parts are halved no sooner than the whole.
void NearDetailHistogram::count(const Triangle& triangle, float max_look2, int depth) {
    if (depth >= max_split_depth || (depth > 0 && is_outside(view_, triangle))) {
        return;
    }
    std::size_t longest = 0;
    float length2 = 0.0F;
    for (std::size_t k = 0; k < 3; ++k) {
        const float own2 = squared_plan_length_m2(triangle[k], triangle[(k + 1) % 3]);
        if (own2 > length2) {
            length2 = own2;
            longest = k;
        }
    }
    const glm::vec3& a = triangle[longest];
    const glm::vec3& b = triangle[(longest + 1) % 3];
    const glm::vec3& c = triangle[(longest + 2) % 3];
    const float seen2 = std::min(squared_angular_size(a, b), max_look2);
    if (seen2 <= min_angular_size2_ || !is_splittable(view_, a, b)) {
        return;
    }
    const std::uint32_t doublings = std::bit_cast<std::uint32_t>(seen2 / min_angular_size2_);
    const std::size_t bin = (doublings - bits_of_one) >> bin_shift;
    ++split_counts_[std::min(bin, bins - 1)];
    ++counted_;
    const glm::vec3 middle = 0.5F * (a + b);
    count({a, middle, c}, seen2, depth + 1);
    count({middle, b, c}, seen2, depth + 1);
}

} // namespace octant::visuals::nature
