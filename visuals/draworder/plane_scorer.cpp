// The first and coarsest of three judgements in the search for a plane (view_space_tree.cpp). For eyes
// in front of a plane, a polygon behind it or in it cannot hide one in front of it or in it, so
// such edges disappear; counting them takes a few operations on rows of bits. What remains may
// still contain edges that the exact test would remove.
#include "visuals/draworder/plane_scorer.h"

#include "visuals/draworder/bit_count.h"
#include "visuals/draworder/candidate_planes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>

namespace octant::visuals::draworder {

namespace {

/// Of a component at most about this many rows are looked at.
constexpr std::size_t max_rows = 192;

bool has(const std::vector<std::uint64_t>& words, std::size_t first_word, std::size_t bit) {
    return ((words[first_word + bit / 64] >> (bit % 64)) & 1U) != 0;
}

/// A bounding sphere: the mean of the corners and the distance of the farthest one.
std::pair<glm::dvec3, double> ball_around(const std::vector<glm::dvec3>& corners) {
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& corner : corners) {
        middle += corner / static_cast<double>(corners.size());
    }
    double radius = 0.0;
    for (const glm::dvec3& corner : corners) {
        radius = std::max(radius, glm::distance(corner, middle));
    }
    return {middle, radius};
}

void set(std::vector<std::uint64_t>& words, std::size_t first_word, std::size_t bit) {
    words[first_word + bit / 64] |= std::uint64_t{1} << (bit % 64);
}

} // namespace

PlaneScorer::PlaneScorer(const ModelFaces& model, const CyclicPart& cycles)
    : model_(model)
    , edges_(cycles.edges) {
    for (const std::vector<std::uint32_t>& component : cycles.components) {
        add(cycles.inner, component);
    }
}

/// Adds the rows of a component.
void PlaneScorer::add(const OcclusionGraph& graph, const std::vector<std::uint32_t>& component) {
    const std::size_t words = (component.size() + 63) / 64;
    const std::size_t step = component.size() / max_rows + 1;
    const std::size_t first_word = front_or_on_.size();
    for (Words* sets : {&front_or_on_, &back_or_on_, &unseen_in_front_, &unseen_behind_}) {
        sets->resize(first_word + words, 0);
    }
    for (std::size_t bit = 0; bit < component.size(); ++bit) {
        const std::uint32_t polygon = component[bit];
        const auto [middle, radius] = ball_around(model_.faces[polygon].corners);
        const std::size_t weight = bit % step == 0 ? step : 0;
        members_.push_back({polygon, middle, radius, first_word, bit, rows_.size(), words, weight});
        if (weight == 0) {
            continue;
        }
        rows_.resize(rows_.size() + words, 0);
        for (std::size_t other = 0; other < component.size(); ++other) {
            if (graph.occludes(component[other], polygon)) {
                set(rows_, members_.back().first_row_word, other);
            }
        }
    }
}

void PlaneScorer::set_plane(const Plane& plane) {
    for (Words* sets : {&front_or_on_, &back_or_on_, &unseen_in_front_, &unseen_behind_}) {
        std::ranges::fill(*sets, std::uint64_t{0});
    }
    some_unseen_ = false;
    const double on = model_.tolerances.on_plane;
    for (const Member& member : members_) {
        const double height = distance_m(plane, member.middle);
        PlaneSide side{height > member.radius, height < -member.radius};
        if (!side.before && !side.behind) {
            side = side_of(plane, model_.faces[member.polygon], on);
        }
        if (side.before) {
            set(front_or_on_, member.first_word, member.bit);
        }
        if (side.behind) {
            set(back_or_on_, member.first_word, member.bit);
        }
        const auto& own = model_.faces[member.polygon].plane;
        if (side.before && side.behind && own) {
            const bool along = glm::dot(plane.normal, own->normal) > 0.0;
            set(along ? unseen_behind_ : unseen_in_front_, member.first_word, member.bit);
            some_unseen_ = true;
        }
    }
}

/// The number of edges that do not disappear on one side of the plane: `occluded` are the polygons on
/// that side or in the plane, `occluders` those on the other side or in it, and `unseen` those that
/// face away from all eyes there.
std::size_t PlaneScorer::left(const Words& occluded, const Words& occluders, const Words& unseen) const {
    std::size_t ended = 0;
    Words mask;
    for (const Member& member : members_) {
        const auto row = std::span(rows_).subspan(member.first_row_word, member.words);
        if (member.weight == 0) {
            continue;
        }
        const bool parted = has(occluded, member.first_word, member.bit);
        if (!some_unseen_) {
            const auto others = std::span(occluders).subspan(member.first_word, member.words);
            ended += parted ? member.weight * count_common_bits(row, others) : 0;
            continue;
        }
        const bool removed = has(unseen, member.first_word, member.bit);
        mask.resize(member.words);
        for (std::size_t word = 0; word < member.words; ++word) {
            const std::size_t at = member.first_word + word;
            mask[word] =
                removed ? ~std::uint64_t{0} : unseen[at] | (parted ? occluders[at] : std::uint64_t{0});
        }
        ended += member.weight * count_common_bits(row, mask);
    }
    return edges_ - std::min(ended, edges_);
}

std::size_t PlaneScorer::edges_left_in_front() const {
    return left(front_or_on_, back_or_on_, unseen_in_front_);
}

std::size_t PlaneScorer::edges_left_behind() const {
    return left(back_or_on_, front_or_on_, unseen_behind_);
}

} // namespace octant::visuals::draworder
