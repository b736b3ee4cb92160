#pragma once

#include "ui/flight/quality_targets.h"
#include "ui/flight/stress_controller.h"
#include "visuals/scene/settings.h"
#include "visuals/shading/shading_controller.h"

#include <optional>
#include <utility>
#include <vector>

namespace octant::ui::flight {

/// What a frame took and drew, as far as the next ones' decisions go by it.
struct FrameMeasurement {
    double frame_ms = 0.0;
    int terrain_triangles = 0;
    /// Polygons of aircraft, at least 0.
    int smoothable_polygons = 0;
    /// How many of these were lit smoothly.
    int smooth_polygons = 0;
    /// Whether it is a warm-up frame, from which nothing is learned.
    bool warm_up = false;
};

/// Decides for each frame how many triangles of ground it aims at and how many polygons are smooth:
/// as the settings say, by what earlier frames took where the settings let that follow the clock,
/// or as a recording has it. Reads no clock itself, so that same outcomes give same decisions.
class QualityController {
public:
    /// Forgets all outcomes and decides by these settings from now on; what is replayed stays.
    /// `rate_hz`: frames a second that there is time for.
    void begin(const visuals::scene::Settings& settings, double rate_hz);

    /// From now on each frame is decided as it stands here, by its number, whatever the clock says.
    void replay(std::vector<QualityTargets> quality_targets) { replayed_targets_ = std::move(quality_targets); }

    /// Triangles of ground that a frame aims at; below the number of replayed ones, if any
    /// (asserted).
    int triangle_target(int frame);

    /// Smooth polygons of a frame; nothing: as the settings' share says. Likewise.
    std::optional<int> smooth_target(int frame) const;

    /// Learns from a frame. Returns its stress, the share of its time that it used: of this frame
    /// alone, or filtered over several where the triangle target follows it. Not a number before
    /// the first frame that counts.
    double add_frame(const FrameMeasurement& outcome);

    /// What `--adapt shading` has found out; nothing before the first frame that counts.
    const std::optional<visuals::shading::ShadingState>& shading() const { return shading_; }

private:
    void add_shading_frame(const FrameMeasurement& outcome);

    visuals::scene::Adaptation adapt_;
    double rate_hz_ = 60.0;
    /// What the settings ask for.
    int configured_triangles_ = 0;
    StressSettings stress_settings_;
    StressState stress_;
    std::optional<visuals::shading::ShadingState> shading_;
    /// By frame; empty = nothing is replayed.
    std::vector<QualityTargets> replayed_targets_;
};

} // namespace octant::ui::flight
