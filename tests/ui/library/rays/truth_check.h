#pragma once

#include <cstddef>
#include <octant/octant.h>
#include <optional>
#include <string>
#include <vector>

namespace octant::tests {

/// One picture whose truth is checked.
struct View {
    Camera camera;
    Pose pose;
    std::vector<State> states;
    std::vector<State> previous_states;
    /// Of each aircraft: its triangles are found in the previous picture one by one. The others are rigid.
    std::vector<bool> has_moving_parts;
    /// Of clouds above datum; nothing = there are none.
    std::optional<double> cloud_height_m = {};
    /// Whether aircraft sink with their distance from the eye as the ground does.
    bool is_round = true;
};

/// What was found in pictures. A pixel is wrong where its ray, and rays up to a twentieth of a pixel beside it, hit
/// nothing that agrees with it.
struct Findings {
    std::size_t pixels = 0;
    std::size_t of_class[surface_class_count] = {};
    std::size_t beside = 0;     ///< pixels that agree with a ray beside theirs, not with theirs: on an edge
    std::size_t near_edges = 0; ///< wrong pixels up to 2 pixels from an edge of the oracle's picture
    std::size_t wrong_class = 0;
    std::size_t wrong_object = 0;
    std::size_t wrong_depth = 0;
    std::size_t wrong_normal = 0;
    std::size_t wrong_cloud = 0;
    std::size_t flows = 0;         ///< compared
    std::size_t unknown_flows = 0; ///< of aircraft whose triangle is not in the export of the previous picture
    std::size_t wrong_flow = 0;
    std::size_t boxes = 0;
    std::size_t wrong_boxes = 0;
    double largest_depth_error = 0.0; ///< share of the depth
    double largest_flow_error_px = 0.0;
    std::vector<std::string> examples; ///< of what is wrong

    std::size_t wrong() const {
        return wrong_class + wrong_object + wrong_depth + wrong_normal + wrong_cloud + wrong_flow + wrong_boxes;
    }
    void add(const Findings& other);
};

/// Renders a view with all its truth, and its boxes, and compares both with rays through the triangles that the world
/// exports. `world` is copied. `scratch`: a file that is written and removed; `name` begins the examples.
Findings check_view(const World& world, const View& view, const std::string& scratch, const std::string& name);

} // namespace octant::tests
