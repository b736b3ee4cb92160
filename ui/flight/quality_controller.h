#pragma once

#include "visuals/scene/settings.h"
#include "visuals/shading/shading_controller.h"

#include <optional>
#include <utility>
#include <vector>

namespace octant::ui::flight {

/// Every number by which the ground's triangle budget follows the frame time. "Stress", the word of image generators,
/// is the share of its time that a frame uses: frame_ms / target_frame_ms.
struct StressSettings {
    /// A frame's time, above zero.
    double target_frame_ms = 1000.0 / 60.0;
    /// The fewest triangles; at least 1.
    int min_triangles = 1000;
    /// The most triangles; at least `min_triangles`.
    int max_triangles = 100000;
    /// The budget is left alone while the stress is between these.
    double min_stress = 0.75;
    double max_stress = 0.90;
    /// A longer frame counts as no more than this, so that one slow frame cannot push the filtered stress from the
    /// middle of the band over its edge; above `max_stress`.
    double max_counted_stress = 2.0;
    /// The time constant of the filter, in simulated time.
    double filter_s = 0.5;
    /// The filter spans no fewer frames than these; at least 1.
    double filter_frames = 20;
    /// A course ends this near to the middle of the band; below half the band's width.
    double settled_stress = 0.02;
    /// The share of the target that it may lose from frame to frame.
    double max_fall = 0.02;
    double max_rise = 0.005;
    /// The target rises only while at least this share of it is drawn: the cost of an unused budget is unknown.
    double used_share = 0.9;
};

/// What is carried from one frame to the next: a value, so that a run can be replayed.
struct StressState {
    enum class Trend { Held, Falling, Rising };

    /// The triangles of the next frame, within the settings' limits.
    double target = 0.0;
    Trend trend = Trend::Held;
    /// Filtered, with the last frame measured; nothing before the first.
    std::optional<double> stress;
    /// The control variable: filtered, too, but long frames count less, and a new target scales it. At rest the same as
    /// `stress`.
    double expected_stress = 0.0;

    /// The target as a whole number.
    int triangles() const;
};

/// What a frame made with StressState::triangles() took.
struct FrameCost {
    /// At least 0.
    double frame_ms = 0.0;
    /// The triangles of ground that were drawn.
    int triangles = 0;
};

/// The settings of a run: from an eighth of its triangle budget to four times as many.
StressSettings stress_settings(const visuals::scene::Settings& settings, double rate_hz);

/// State before the first frame, at rest in the middle of the band.
StressState initial_state(double triangles, const StressSettings& settings);

/// The state with another target (>= 1) for the next frame.
StressState with_target(const StressState& state, int triangles);

/// State after a frame. Settings are as their comments demand (asserted).
StressState next_state(const StressState& state, const StressSettings& settings, const FrameCost& cost);

/// What a frame took and drew, as far as the targets of the next frames depend on it.
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

/// Triangle and smooth-polygon targets of a frame.
struct QualityTargets {
    int triangle_target = 0;
    /// Polygons lit smoothly; nothing: by the settings' share.
    std::optional<int> smooth_target;
};

/// Chooses for each frame how many triangles of ground it aims at and how many polygons are smooth: as the settings
/// say, by the times of earlier frames where the settings ask for adaptation, or as a recording has them. Reads no
/// clock itself: equal measurements give equal targets.
class QualityController {
public:
    /// Forgets all measurements and follows these settings from now on; replayed targets stay. `rate_hz`: frames a
    /// second that there is time for.
    void begin(const visuals::scene::Settings& settings, double rate_hz);

    /// From now on frame i has target i, whatever frames take.
    void replay(std::vector<QualityTargets> quality_targets) { replayed_targets_ = std::move(quality_targets); }

    /// Triangles of ground that a frame aims at; below the number of replayed ones, if any (asserted).
    int triangle_target(int frame);

    /// Smooth polygons of a frame; nothing: by the settings' share. The same limit of `frame`.
    std::optional<int> smooth_target(int frame) const;

    /// Learns from a frame. Returns its stress, the share of its time that it used: of this frame alone, or filtered
    /// over several where the triangle target follows it. Not a number before the first frame that counts.
    double add_frame(const FrameMeasurement& measurement);

    /// What `--adapt shading` has found out; nothing before the first frame that counts.
    const std::optional<visuals::shading::ShadingState>& shading() const { return shading_; }

private:
    void add_shading_frame(const FrameMeasurement& measurement);

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
