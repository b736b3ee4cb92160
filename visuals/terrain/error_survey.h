#pragma once

#include "visuals/terrain/error_rule.h"
#include "visuals/terrain/fan_triangles.h"
#include "visuals/terrain/limit_search.h"
#include "visuals/terrain/step_count.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::terrain {

/// What a mesh by screen-space error is wanted to be.
struct ErrorTarget {
    double error_px = 1.0; ///< at or above zero; 0: everything that is not on straight lines
    /// More error is allowed where this would be exceeded; any_triangles: it never is.
    int most_triangles = 32000;
    bool geomorphs = true;

    bool operator==(const ErrorTarget&) const = default;
};

/// With geomorphs a vertex is at its sample where its error, as seen from its region of influence,
/// is this many times the one wanted, and still between its ends where it is no more than that. A
/// vertex on its way is so drawn up to 1.04 times the error wanted beside its sample; with 2 never
/// above it, but half again as fast.
inline constexpr float morph_ratio = 2.5F;

inline constexpr int any_triangles = 1 << 30;

/// A node whose fan is in the mesh at some limits, with the limits above which its parts are.
struct alignas(64) ErrorNode {
    FourFloats middle{};                  ///< mid-points of fan_edges
    FourFloats quadrant{};                ///< fans of the children
    std::array<std::uint32_t, 4> child{}; ///< nodes of those that were looked at; 0 = none
    float on = 0.0F;                      ///< the fan: its centre
    std::uint16_t column = 0;
    std::uint16_t row = 0;
    std::uint8_t level = 0;
    std::uint8_t hidden = 0; ///< quadrants outside the frustum or the field
};

/// Collects what a mesh by screen-space error is made of, and finds the error that spends a budget
/// of triangles, exactly and before the mesh is made: see BudgetSurvey, whose limits on C are here
/// those of ErrorRule.
class ErrorSurvey {
public:
    /// The rule must outlive the survey.
    explicit ErrorSurvey(const ErrorRule& rule)
        : rule_(&rule) {}

    /// The limit that belongs to the smallest error at or above the target's up to which no mesh
    /// has more than its triangles. The root's fan is always there.
    float limit_for(const ErrorTarget& target);

    /// The nodes of meshes up to the limit last found, and more; parents before children. The first
    /// stands for none, then comes the root.
    std::span<const ErrorNode> nodes() const { return std::span(nodes_).first(count_); }

    int nodes_tested() const { return nodes_tested_; }

private:
    /// A node to be surveyed.
    struct Visit {
        ErrorPlace place;
        unsigned planes = 0;  ///< that it may reach beyond
        float on = 0.0F;      ///< critical value of its centre
        float error_m = 0.0F; ///< of its centre
        int replaced = 0;     ///< triangles of its parent that it takes the place of
    };

    /// What is found out about the children of a node.
    struct Children {
        std::array<unsigned, 4> planes{};
        unsigned hidden = 0;
    };

    void start(float high);
    Visit root_visit() const;
    std::size_t next_node();
    template <bool counting>
    std::uint32_t visit(const Visit& from);
    static ErrorPlace child_place(const ErrorPlace& place, unsigned quadrant);
    void test_children(const Visit& from, Children& children);
    void count(const Visit& from, const ErrorNode& node, std::array<int, 4>& replaced);

    const ErrorRule* rule_;
    std::vector<ErrorNode> nodes_;
    std::size_t count_ = 0;
    StepCount steps_;
    std::array<std::array<HeightGaps, 4>, 16> gaps_; ///< by level and quadrant, while walking
    float high_ = 0.0F;
    float margin_ = 0.0F;     ///< how far beside samples is drawn, in errors of the parent's centre
    int most_triangles_ = 0;  ///< a walk stops where it has counted more
    bool more_above_ = false; ///< something visible is only above high_
    int nodes_tested_ = 0;
    double last_error_px_ = 0.0; ///< 0: none yet
};

} // namespace octant::visuals::terrain
