#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <optional>

namespace octant::ui::report {

/// What the kernel counted of this program during a frame. Differs from run to run.
struct FrameCounters {
    long page_faults = 0;
    long switches = 0;      ///< involuntary: another program got the processor
    double stolen_ms = 0.0; ///< by the host for other machines, in the steps of the kernel's clock
};

/// One line of frames.csv. Times in milliseconds are wall time; everything else is repeatable.
struct FrameRecord {
    int frame = 0;
    bool warm_up = false; ///< recorded, but left out of the statistics
    double sim_time_s = 0.0;
    double wall_s = 0.0;   ///< when this frame began, since the first frame began
    double frame_ms = 0.0; ///< simulation step begun to pixels read
    double sim_ms = 0.0;
    double plan_ms = 0.0;
    double draw_ms = 0.0;
    double read_ms = 0.0;
    double mesh_wait_ms = 0.0; ///< of plan_ms: waiting for ground that is meshed ahead
    double draw_wait_ms = 0.0; ///< of draw_ms: the thread that draws had no processor
    double record_ms = 0.0;    ///< writing pictures and video, outside frame_ms
    int terrain_triangles = 0;
    int terrain_fans = 0;
    int detail_triangles = 0;  ///< of terrain_triangles: detail below the samples
    int scenery_triangles = 0; ///< of terrain_triangles: what stands on it, roads and a runway
    int aircraft_polygons = 0; ///< in the lists drawn, before back-face culling
    int draw_cell = 0;         ///< cell of the first aircraft's draw order
    double resolution_c = 0.0; ///< C of the terrain in this frame
    int triangle_change = 0;   ///< terrain triangles minus those of the frame before
    /// frame_ms over the frame's share of simulated time; filtered where the ground adapts, then not finite while
    /// warming up.
    double stress = 0.0;
    int overrun = 0;    ///< 1 when frame_ms is above 16.67
    int draw_calls = 0; ///< of the graphics library, or steps painted where there is none
    int shadow_triangles = 0;
    int transparent_triangles = 0;
    int cuts = 0;      ///< ground triangles and aircraft polygons painted again, cut by planes
    int unordered = 0; ///< aircraft painted by depth, as they meet others in too many places
    glm::dvec3 eye_m{0.0};
    glm::dvec3 aircraft_m{0.0};  ///< first aircraft, world
    double aircraft_agl_m = 0.0; ///< first aircraft above the ground below it
    int triangle_target = 0;     ///< terrain triangles that this frame was to have
    /// How far any sample of the terrain in the picture may lie from its triangles, but for detail that is made up near
    /// the eye; 0 where C decides.
    double error_px = 0.0;
    /// By the clock only, else not finite: from the input that the frame shows, or from the moment that it was due, to
    /// the picture finished.
    double latency_ms = std::numeric_limits<double>::quiet_NaN();
    /// Polygons that are lit smoothly, of all polygons of the models shown and all triangles of their refined meshes,
    /// whether they are painted or face away.
    int smooth_polygons = 0;
    int smooth_target = -1;   ///< smooth polygons that this frame was to have; negative: by a share
    int refine_splits = 0;    ///< of meshes that are refined in each frame
    int refine_collapses = 0; ///< of meshes that are refined in each frame
    double refine_ms = 0.0;   ///< of plan_ms: placing the aircraft and refining their meshes
    int aircraft_level = 0;   ///< level of detail of the first aircraft, 0 = the finest
    // Of motion from outside, since the frame before:
    int packets = 0; ///< that moved something
    /// As the senders' numbers of packets say; not finite where packets bear none.
    double packets_lost = std::numeric_limits<double>::quiet_NaN();
    int packets_late = 0;   ///< dropped
    int packets_wrong = 0;  ///< that were none of the protocol's
    int stale = 0;          ///< 1 when an aircraft stands for want of packets
    double jitter_ms = 0.0; ///< how much later than the quickest packets come, mean
    int host_frame = -1;    ///< of the CIGI host whose frame the picture shows; -1 = none
    /// To image generators: how many host frames the one that is the furthest behind is behind; -1
    /// = none.
    int skew_frames = -1;
    int missed = 0; ///< by the clock: 1 when the picture came later than the next one was due
    /// Over the states of all aircraft at every step up to this picture.
    std::optional<std::uint64_t> state_hash = {};
    std::optional<std::uint64_t> picture_hash = {}; ///< over this picture's pixels
    FrameCounters counters = {};                    ///< in counters.csv
};

} // namespace octant::ui::report
