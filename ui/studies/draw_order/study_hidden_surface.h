#pragma once

#include "ui/flight/id_comparison.h"
#include "ui/settings/settings.h"
#include "ui/studies/study.h"
#include "ui/world/world.h"

#include <glm/vec3.hpp>

#include <array>
#include <functional>
#include <string>

namespace octant::ui::studies::draw_order {

/// An eye point on the ground from which ridges come before the aircraft and leave it again as often as can be found:
/// of places around the middle of the flight, the one from which it is hidden or seen anew most often. World axes,
/// metres.
glm::dvec3 ridge_tower(const world::World& world);

/// The renderers whose pictures are held against rays, in this order everywhere.
inline constexpr std::array compared_renderers = {settings::RendererKind::Raster, settings::RendererKind::Gl};

/// Sums over the frames of a run.
struct RayComparison {
    struct OfRenderer {
        long differing = 0;
        long wrong = 0;          ///< that no rounding explains
        std::string first_wrong; ///< frame and pixel; empty: none
    };

    int frames = 0;
    long pixels = 0; ///< of one renderer
    std::array<OfRenderer, compared_renderers.size()> renderers;

    long wrong() const;
    void add(const RayComparison& other);
};

/// Draws every `every`th frame of a run as polygon numbers, painted as the settings say with one sample a pixel by each
/// renderer, and compares each pixel with what a ray through its middle finds. Shadows are left out. `worlds` are those
/// of the settings, but for the view's. `on_frame` is told of each frame that was compared and of how many there are.
/// Throws Error.
RayComparison compare_with_rays(const settings::RunSettings& settings, const flight::ComparisonWorlds& worlds,
    int every, const std::function<void(int compared, int frames)>& on_frame);

/// Terrain, triangles and context are those of the settings. `jobs`: views of a flight compared at once; the race is
/// one at a time.
struct HiddenSurfaceStudyOptions : StudyOptions {
    bool race = true;     ///< frames a second of the three ways
    bool pictures = true; ///< polygon numbers against the depth buffer
    bool rays = true;     ///< polygon numbers against rays
    int race_frames = 200;
    int every = 10;       ///< every Nth frame is compared
    std::string aircraft; ///< compared in place of F-15 and 500MD, unless empty
};

/// Three tables. Frames a second of octant order, depth buffer and removal of back faces, drawn in turn, for 1 to 1000
/// aircraft over the 60-polygon background and over terrain, 640x480 and 1280x720. And pictures of polygon numbers,
/// octant order against the depth buffer, for four paths, two aircraft and four views over terrain: chase, tower, a
/// tower that sees the aircraft go behind ridges, and orbit. And the same pictures, and those from the cockpit, by both
/// renderers against rays. Prints them and writes them to `out` as CSV and Markdown. True when no pixel was wrong.
/// Throws Error.
bool study_hidden_surface(const HiddenSurfaceStudyOptions& study);

} // namespace octant::ui::studies::draw_order
