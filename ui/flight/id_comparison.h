#pragma once

#include "ui/flight/session.h"
#include "ui/settings/settings.h"
#include "visuals/scene/picture.h"

#include <glm/vec2.hpp>

#include <functional>
#include <span>
#include <vector>

namespace octant::ui::flight {

/// How a picture of polygon numbers differs from a reference.
struct IdDifference {
    long pixels = 0;
    /// Pixels that show another number than the reference's.
    long differing = 0;
    /// Pixels whose number is in none of the reference's 3 x 3 pixels around them.
    std::vector<glm::ivec2> unmatched;
};

/// Compares two pictures of the same size (asserted).
IdDifference difference_of(const visuals::scene::Picture& picture, const visuals::scene::Picture& reference);

/// How many of the pixels have a number that is in none of the 3 x 3 pixels around them in a reference that was drawn
/// `scale` times as large.
long count_wrong_ids(std::span<const glm::ivec2> pixels, const visuals::scene::Picture& picture,
    const visuals::scene::Picture& large_reference, int scale);

/// Sums over the frames of a run.
struct IdComparison {
    long pixels = 0;
    long differing = 0;
    /// Pixels whose number is in none of the reference's 3 x 3 pixels around them.
    long unmatched = 0;
    /// Of the pixels apart, those whose number a reference of three times the size does not have there either.
    long wrong = 0;
    int frames = 0;
    /// Frames in which something stood in front of an aircraft.
    int frames_with_cuts = 0;
    long cuts = 0;
    long unordered = 0;
};

/// The settings of a run that is compared pixel by pixel, as it is painted and by a depth buffer: one sample a pixel
/// and no shadows, which have no numbers.
struct ComparisonSettings {
    settings::RunSettings painted;
    settings::RunSettings depth_buffered;
};

ComparisonSettings comparison_settings(const settings::RunSettings& settings);

/// What both ways of drawing show, loaded. It serves all views of the same flight.
struct ComparisonWorlds {
    world::World painted;
    world::World depth_buffered;
};

/// Throws Error.
ComparisonWorlds load_comparison_worlds(const settings::RunSettings& settings);

/// Draws every `every`th frame of a run as polygon numbers, with the settings' way of removing hidden surfaces and with
/// the depth buffer, and compares. Renderers round corners to 1/256 pixel, so that along an edge either of two polygons
/// may be seen, and a tip be lost: where a number is missing, the reference is drawn again three times as large.
/// Shadows are left out. `worlds` are those of the settings, the view apart. `on_frame` is called after each frame with
/// the numbers of frames that were compared and that there are. Throws Error.
IdComparison compare_with_depth_buffer(const settings::RunSettings& settings, const ComparisonWorlds& worlds, int every,
    const std::function<void(int compared, int frames)>& on_frame);

/// What the last picture of a session's window got wrong against a depth buffer.
struct PixelCheck {
    long pixels = 0;
    /// Pixels that show another polygon.
    long differing = 0;
    /// Of these, those where a picture three times as large does not show it nearby.
    long wrong = 0;
};

/// Draws the session's last frame by painting order and by depth with renderers of its own, and compares the polygons
/// of their pixels. Throws Error if the driver fails.
PixelCheck check_pixels(Session& session);

} // namespace octant::ui::flight
