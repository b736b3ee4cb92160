#pragma once

#include "sim/base/thread_pool.h"
#include "ui/base/progress.h"
#include "ui/base/study_output.h"
#include "ui/flight/id_comparison.h"
#include "ui/settings/settings.h"
#include "ui/studies/draw_order/study_renderer.h"
#include "ui/world/world.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/model_buffers.h"
#include "visuals/scene/settings.h"

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace octant::ui::studies::draw_order {

/// An eye point on the ground from which ridges come before the aircraft and leave it again as often as can be found:
/// of places around the middle of the flight, the one from which it is hidden or seen anew most often. World axes,
/// metres.
glm::dvec3 ridge_tower(const world::World& world);

inline constexpr std::array compared_paths = {"straight", "jinking", "pop-up", "turn"};

struct StudiedView {
    visuals::scene::View kind;
    const char* name;
    bool behind_ridges = false; ///< From a tower that ridges hide the aircraft from now and then.
};

/// Flights of which pictures are compared: every path by each aircraft.
struct ComparisonFlights {
    settings::RunSettings settings; ///< All but path, aircraft and view.
    std::vector<std::string> aircraft;
    int every = 1; ///< Every Nth frame is compared.
    int jobs = 1;  ///< Views compared at once.
    bool quiet = false;
};

template <class Result>
struct NamedResult {
    std::vector<std::string> name; ///< Path, aircraft, view.
    Result result;
};

/// The name of a terrain or an aircraft in a table, of a file without its folder.
inline std::string short_name(const std::string& given) { return std::filesystem::path(given).stem().string(); }

/// How far a flight has come, told by whichever view has compared a picture.
class ComparisonProgress {
public:
    ComparisonProgress(const std::string& what, int pictures, bool quiet)
        : progress_(what, pictures, quiet, "pictures") {}

    void add(const char* view) {
        const std::scoped_lock lock(one_at_a_time_);
        progress_.show(++done_, view);
    }

private:
    std::mutex one_at_a_time_;
    base::Progress progress_;
    int done_ = 0;
};

/// Comparisons of all views of one flight, over worlds that are loaded once.
template <class Result, class Compare>
void compare_views(const ComparisonFlights& flights, const settings::RunSettings& flown,
    std::span<const StudiedView> studied_views, const Compare& compare, std::span<NamedResult<Result>> compared) {
    const flight::ComparisonWorlds worlds = flight::load_comparison_worlds(flown);
    const auto frames = static_cast<int>(world::picture_times_of(flown, worlds.painted.flight).times_s.size());
    const int pictures = (frames + flights.every - 1) / flights.every;
    ComparisonProgress told(fmt::format("{} {}", compared.front().name[0], compared.front().name[1]),
        pictures * static_cast<int>(studied_views.size()), flights.quiet);
    parallel_for(studied_views.size(), flights.jobs, [&](std::size_t i, std::size_t /*worker*/) {
        const StudiedView& view = studied_views[i];
        settings::RunSettings settings = flown;
        settings.view.kind = view.kind;
        if (view.behind_ridges) { settings.view.eye_m = ridge_tower(worlds.painted); }
        compared[i].result = compare(settings, worlds, flights.every, [&](int, int) { told.add(view.name); });
    });
}

/// A comparison of every path, aircraft and view: `compare` takes settings, worlds, every how many frames, and whom to
/// tell.
template <class Compare>
auto run_comparisons(
    const ComparisonFlights& flights, std::span<const StudiedView> studied_views, const Compare& compare) {
    using Result = decltype(compare(flights.settings, flight::ComparisonWorlds(), 1, [](int, int) {}));
    std::vector<NamedResult<Result>> compared;
    for (const char* path : compared_paths) {
        for (const std::string& aircraft : flights.aircraft) {
            settings::RunSettings flown = flights.settings;
            flown.path.name = path;
            flown.path.aircraft = {aircraft};
            const std::size_t first = compared.size();
            for (const StudiedView& view : studied_views) {
                compared.push_back({{path, short_name(aircraft), view.name}, {}});
            }
            compare_views<Result>(flights, flown, studied_views, compare, std::span(compared).subspan(first));
        }
    }
    return compared;
}

/// Finds what the pixels of a plan show by a ray through the middle of each: every triangle in double precision, no
/// rounding of corners and no painting order. For plans of polygon numbers (planning::IdPlan) whose surfaces are hidden
/// by depth, which hold all triangles that may be seen. Clips and overlays are left out.
class RayRenderer final : public StudyRenderer {
public:
    explicit RayRenderer(const glm::ivec2& size_px);

    const visuals::scene::RendererInfo& info() const override { return info_; }

    std::unique_ptr<visuals::scene::Renderer> sibling(const glm::ivec2& size_px, int samples) const override;
    void resize(const glm::ivec2& size_px, std::optional<int> samples) override;
    void load_models(std::span<const visuals::scene::ModelBuffers> models) override;

    void load_ground_texture(const visuals::scene::GroundTexture&) override {}

    void warm_up() override {}

    void draw(const visuals::scene::FramePlan& plan) override;

    void finish_and_read(visuals::scene::Picture& picture) override { picture = picture_; }

    /// A pixel that shows what no rounding of corners explains: no triangle of that number comes within reach of the
    /// pixel's middle, or all places within reach lie behind nearer ones.
    struct WrongPixel {
        glm::ivec2 at{0};
        std::uint32_t number = 0; ///< that it shows
        /// How much nearer what the ray finds is, as a share of the depth; nothing: what is shown is not within reach.
        std::optional<double> nearer;
    };

    struct Difference {
        long differing = 0; ///< pixels that show another number than their ray finds
        std::vector<WrongPixel> wrong;
    };

    /// Of another renderer's picture of the last plan, of the same size (asserted). A pixel's middle may lie `reach_px`
    /// from what it shows.
    Difference compare(const visuals::scene::Picture& picture, double reach_px) const;

    /// What a pixel shows.
    std::uint32_t number_of(const glm::ivec2& pixel) const;

    /// Of a plan painted in order: whether a pixel shows `number` only as each piece's corners are rounded for
    /// themselves, as where two polygons are cut by a plane that is seen edge-on. So it is if the pieces, painted
    /// without rounding, show `seen`, and sides of a piece of `number` and of all that are painted over it there are
    /// within reach of the pixel's middle.
    bool is_rounding(const glm::ivec2& pixel, std::uint32_t number, std::uint32_t seen, double reach_px) const;

private:
    /// A triangle as rays meet it. Values at a pixel (column, row, 1) are dot products.
    struct Target {
        std::array<glm::dvec3, 3> inwards; ///< how far inside each edge, pixels
        glm::dvec3 inverse_depth{0.0};     ///< one over the depth along the line of sight, 1/m
        double max_over_w = 0.0;           ///< within the triangle
        std::array<glm::dvec2, 3> corners_px{};
        bool is_placed = false; ///< all corners lie before the near plane: corners_px count
        glm::ivec2 least{0};    ///< pixels that it may cover, and one more on each side
        glm::ivec2 most{0};
        std::uint32_t number = 0;
        std::uint32_t piece = 0; ///< those of one polygon are the same, one after the other

        double inside_px(const glm::dvec3& at) const;
        double distance_px(const glm::dvec2& at) const;
    };

    void add(const std::array<glm::vec3, 3>& corners_m, std::uint32_t number, bool culls);
    static bool may_reach(const Target& target, const glm::ivec2& pixel, double reach_px);
    void add_ground(const visuals::scene::FramePlan& plan);
    void add_aircraft(const visuals::scene::FramePlan& plan, const visuals::scene::AircraftDraw& draw);
    void draw_target(const Target& target);
    std::optional<WrongPixel> wrong_pixel_at(const glm::ivec2& pixel, std::uint32_t number, double reach_px) const;

    visuals::scene::RendererInfo info_;
    glm::ivec2 size_px_;
    std::vector<visuals::scene::ModelBuffers> models_;
    glm::dmat4 world_to_clip_{1.0};
    double near_m_ = 0.0;
    std::vector<Target> targets_; ///< as the plan names them
    std::uint32_t pieces_ = 0;
    std::vector<double> inverse_depths_; ///< of what is seen in each pixel; 0: nothing
    visuals::scene::Picture picture_;
};

/// The renderers whose pictures are held against rays, in this order everywhere.
inline constexpr std::array compared_renderers = {settings::RendererKind::Raster, settings::RendererKind::Gl};

/// How far a pixel's middle may lie from what it shows, pixels. Corners are rounded to 1/256 pixel and what is painted
/// again is cut 1/100 pixel too wide where only that rounding could tell.
inline constexpr double rounding_reach_px = 1.0 / 256.0 + 0.01;

/// In place of a session's renderer: draws each plan, of polygon numbers painted in their order, by every renderer that
/// is held against rays, and compares the pictures with what rays have found of the same frame. The session's own
/// picture is that of the first one.
class RendererComparer final : public StudyRenderer {
public:
    /// `rays` must have drawn the frame, hidden by depth, before this draws it, and must outlive this. Throws Error.
    RendererComparer(const settings::RunSettings& settings, const RayRenderer& rays);

    using Differences = std::array<RayRenderer::Difference, compared_renderers.size()>;

    /// How the pictures of the last plan differ from the rays; wrong is what no rounding explains.
    const Differences& differences() const { return differences_; }

    const visuals::scene::RendererInfo& info() const override { return renderers_.front()->info(); }

    std::unique_ptr<visuals::scene::Renderer> sibling(const glm::ivec2& size_px, int samples) const override;
    void resize(const glm::ivec2& size_px, std::optional<int> samples) override;
    void load_models(std::span<const visuals::scene::ModelBuffers> models) override;
    void load_ground_texture(const visuals::scene::GroundTexture& texture) override;
    void warm_up() override;
    void draw(const visuals::scene::FramePlan& plan) override;

    void finish_and_read(visuals::scene::Picture& picture) override { picture = picture_; }

private:
    RayRenderer::Difference difference_to_rays(
        const visuals::scene::FramePlan& plan, const visuals::scene::Picture& picture);

    settings::RunSettings settings_;
    const RayRenderer& rays_;
    std::array<std::unique_ptr<visuals::scene::Renderer>, compared_renderers.size()> renderers_;
    /// The plan painted in its order, but without rounding.
    RayRenderer unrounded_;
    bool is_unrounded_drawn_ = false; ///< Of the plan at hand.
    visuals::scene::Picture picture_;
    Differences differences_;
};

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

struct HiddenSurfaceStudyOptions : base::StudyOutput {
    settings::RunSettings settings =
        settings::measurement_settings(); ///< terrain, triangles and context are taken from it
    bool race = true;                     ///< frames a second of the three ways
    bool pictures = true;                 ///< polygon numbers against the depth buffer
    bool rays = true;                     ///< polygon numbers against rays
    int race_frames = 200;
    int every = 10;       ///< every Nth frame is compared
    std::string aircraft; ///< compared in place of F-15 and 500MD, unless empty
    int jobs = 1;         ///< views of a flight compared at once; the race is one at a time
};

/// Three tables. Frames a second of octant order, depth buffer and removal of back faces, drawn in turn, for 1 to 1000
/// aircraft over the 60-polygon background and over terrain, 640x480 and 1280x720. And pictures of polygon numbers,
/// octant order against the depth buffer, for four paths, two aircraft and four views over terrain: chase, tower, a
/// tower that sees the aircraft go behind ridges, and orbit. And the same pictures, and those from the cockpit, by both
/// renderers against rays. Prints them and writes them to `out` as CSV and Markdown. True when no pixel was wrong.
/// Throws Error.
bool study_hidden_surface(const HiddenSurfaceStudyOptions& study);

} // namespace octant::ui::studies::draw_order
