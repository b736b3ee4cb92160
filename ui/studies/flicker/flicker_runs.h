#pragma once

#include "models/heights/height_field.h"
#include "visuals/terrain/bisection_mesher.h"
#include "visuals/terrain/ground_tiles.h"
#include "visuals/terrain/quadtree_mesher.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace octant::ui::studies::flicker {

/// A height field under the paper's quadtree with literal roughness and crack-free propagation, K = 0.5 + 0.79 / C_min,
/// and under the default mesh. Stays where it is.
struct FlickerGround {
    explicit FlickerGround(models::heights::HeightField made);

    models::heights::HeightField field;
    visuals::terrain::Quadtree tree;
    std::vector<std::uint32_t> colours; ///< nothing is drawn: all the same
    visuals::terrain::QuadtreeMesher mesher;
    visuals::terrain::GroundTiles tiles;
    visuals::terrain::BisectionMesher error_mesher;
};

/// Parameters by the paper's letters.
struct FlickerSettings {
    double roughness_weight = 5.0;            ///< c
    int target_triangles = 32000;             ///< N_target
    double first_resolution = 16.0;           ///< C_0
    double triangles_per_resolution = 1000.0; ///< a
    int averaged_frames = 4;                  ///< r
};

/// What was counted in a frame.
struct CountedFrame {
    int triangles = 0;
    int fans = 0;
    double resolution = 0.0; ///< C; 0 for a way that has none
    /// The N'(C) that the control uses, triangles per unit of C; 0 for a method without it.
    double estimated_gain = 0.0;
};

/// Makes the mesh of the next frame.
using CountNextFrame = std::function<CountedFrame(const visuals::terrain::MeshView& view)>;

/// A method that holds the number of triangles near the target.
struct TriangleControl {
    const char* name;
    bool holds_target;
    /// Begins a run. The ground must outlive it.
    CountNextFrame (*start)(FlickerGround& ground, const FlickerSettings& settings);
};

inline constexpr std::size_t previous_control = 0; ///< of triangle_controls
inline constexpr std::size_t damped_control = 1;
inline constexpr std::size_t dead_band_control = 2;
inline constexpr std::size_t tuned_control = 3;
inline constexpr std::size_t literal_control = 4;
inline constexpr std::size_t exact_control = 5;
inline constexpr std::size_t screen_error_control = 6;

/// Previous, damped as printed, damped with dead band, damped with its own gain, literal and exact, all with the
/// paper's mesh, and the default mesh: the numbers above.
std::span<const TriangleControl> triangle_controls();

/// A run: each frame's count.
struct FlickerRun {
    std::vector<int> triangles;
    std::vector<int> fans;
    std::vector<double> resolution;
    std::vector<double> estimated_gain;
};

FlickerRun run_along(const TriangleControl& triangle_control, FlickerGround& ground, const FlickerSettings& settings,
    std::span<const visuals::terrain::MeshView> views);

/// A view 300 m above the ground, pitched 6 degrees down: of 25 positions and eight headings, the one in which the
/// paper's rule makes most triangles at c = 5 and C = 16. Aspect 16:9, field of view 45 degrees.
visuals::terrain::MeshView roughest_view(FlickerGround& ground);

/// Views once around an ellipse over the field, 300 m above the ground, looking along the path with the pitch of
/// roughest_view().
std::vector<visuals::terrain::MeshView> ellipse_views(const FlickerGround& ground, int frames);

} // namespace octant::ui::studies::flicker
