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

/// One frame of a recording: a row of frames.csv, whose columns frame_csv.cpp defines. Times in milliseconds are wall
/// time; everything else is repeatable. Counts are of this frame alone.
struct FrameRecord {
    int frame = 0;
    bool warm_up = false;
    bool paused = false; ///< the program was stopped (SIGSTOP) during the frame
    double sim_time_s = 0.0;
    double wall_s = 0.0;
    double frame_ms = 0.0;
    double sim_ms = 0.0;
    double plan_ms = 0.0;
    double draw_ms = 0.0;
    double read_ms = 0.0;
    double mesh_wait_ms = 0.0;
    double draw_wait_ms = 0.0;
    double record_ms = 0.0;
    int terrain_triangles = 0;
    int terrain_fans = 0;
    int detail_triangles = 0; ///< "fine_triangles"
    int scenery_triangles = 0;
    int aircraft_polygons = 0;
    int draw_cell = 0;
    double resolution_c = 0.0;
    int triangle_change = 0;
    double stress = 0.0; ///< not finite while a ground that adapts warms up
    int overrun = 0;
    int draw_calls = 0;
    int shadow_triangles = 0;
    int transparent_triangles = 0; ///< "veil_triangles"
    int cuts = 0;
    int unordered = 0;
    glm::dvec3 eye_m{0.0};
    glm::dvec3 aircraft_m{0.0};
    double aircraft_agl_m = 0.0;
    int triangle_target = 0;
    double error_px = 0.0;
    double latency_ms = std::numeric_limits<double>::quiet_NaN();
    int smooth_polygons = 0;
    int smooth_target = -1;
    int refine_splits = 0;
    int refine_collapses = 0;
    double refine_ms = 0.0;
    int aircraft_level = 0;
    int packets = 0;
    double packets_lost = std::numeric_limits<double>::quiet_NaN();
    int packets_late = 0;
    int packets_wrong = 0;
    int stale = 0;
    double jitter_ms = 0.0;
    int host_frame = -1;
    int skew_frames = -1;
    int missed = 0;
    std::optional<std::uint64_t> state_hash = {};
    std::optional<std::uint64_t> picture_hash = {};
    FrameCounters counters = {}; ///< in counters.csv

    /// Whether its times count in figures.
    bool is_counted() const { return !warm_up && !paused; }
};

} // namespace octant::ui::report
