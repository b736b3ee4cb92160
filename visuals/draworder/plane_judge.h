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

/// Judges planes by what they leave of the edges on cycles, from where polygons lie to them alone:
/// quickly, so that thousands can be looked at. Holds each component's edges in rows of its own, so
/// that small components of large models cost little; of large components it looks at some rows
/// only, evenly spread, which stand for all. Keeps a reference to the faces.
class PlaneJudge {
public:
    PlaneJudge(const ModelFaces& model, const Cycles& cycles);

    void look_at(const Plane& plane);

    /// Edges of the cycles that the plane looked at leaves on one of its sides, in rings or not.
    std::size_t left_in_front() const;
    std::size_t left_behind() const;

private:
    /// A polygon, the ball around it, and where its component's words begin.
    struct Member {
        std::uint32_t polygon = 0;
        glm::dvec3 middle{0.0};
        double radius = 0.0;
        std::size_t first_word = 0;
        std::size_t bit = 0; ///< from the first word on
        std::size_t first_row_word = 0;
        std::size_t words = 0;
        std::size_t weight = 0; ///< how many rows its row stands for
    };

    using Words = std::vector<std::uint64_t>;

    void add(const HidingGraph& graph, const std::vector<std::uint32_t>& component);
    std::size_t left(const Words& hidden, const Words& hiding, const Words& unseen) const;

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
