#pragma once

#include "sim/base/plane.h"
#include "visuals/draworder/components.h"
#include "visuals/draworder/model_faces.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::draworder {

/// Estimates what a plane that cuts eye space leaves of the cyclic edges, from where polygons lie
/// to the plane alone. This is quick, so that thousands of planes can be judged. The edges of each
/// component are held in rows of their own, so that small components of large models cost little;
/// of large components only some rows are looked at, evenly spread, and stand for all. Keeps a
/// reference to the faces.
class PlaneScorer {
public:
    PlaneScorer(const ModelFaces& model, const CyclicPart& cycles);

    /// Turns to a plane.
    void set_plane(const Plane& plane);

    /// The number of cyclic edges that remain for eyes in front of the plane, whether still on
    /// cycles or not.
    std::size_t edges_left_in_front() const;
    /// The number of cyclic edges that remain for eyes behind the plane.
    std::size_t edges_left_behind() const;

private:
    /// A polygon of a component, with a bounding sphere, and where its bits are.
    struct Member {
        std::uint32_t polygon = 0;
        glm::dvec3 middle{0.0};
        double radius = 0.0;
        /// The index of its component's first word in the sets below.
        std::size_t first_word = 0;
        /// Its own bit, counted from that word.
        std::size_t bit = 0;
        /// The index of its row's first word in rows_.
        std::size_t first_row_word = 0;
        std::size_t words = 0;
        /// How many rows its row stands for; 0 when it has none.
        std::size_t weight = 0;
    };

    using Words = std::vector<std::uint64_t>;

    void add(const OcclusionGraph& graph, const std::vector<std::uint32_t>& component);
    std::size_t left(const Words& occluded, const Words& occluders, const Words& unseen) const;

    const ModelFaces& model_;
    std::vector<Member> members_;
    Words rows_;
    Words front_or_on_;
    Words back_or_on_;
    Words unseen_in_front_;
    Words unseen_behind_;
    bool some_unseen_ = false;
    std::size_t edges_ = 0;
};

} // namespace octant::visuals::draworder
