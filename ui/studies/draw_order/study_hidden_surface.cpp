#include "ui/studies/draw_order/study_hidden_surface.h"

#include "sim/base/units.h"
#include "ui/base/progress.h"
#include "ui/flight/renderer_choice.h"
#include "ui/flight/session.h"
#include "ui/studies/draw_order/ray_renderer.h"
#include "ui/studies/draw_order/surface_race.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fmt/format.h>
#include <iterator>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace octant::ui::studies::draw_order {

namespace scene = visuals::scene;
using flight::PictureContent;
using flight::Session;

namespace {

constexpr double eye_height_m = 3.0;
constexpr std::array distances_m = {300.0, 600.0, 1000.0, 1600.0, 2500.0};
constexpr int directions = 24;
constexpr double step_m = 20.0;

bool is_hidden(const world::World& world, const glm::dvec3& eye_m, const glm::dvec3& target_m) {
    const double distance_m = glm::distance(eye_m, target_m);
    for (double at_m = step_m; at_m < distance_m; at_m += step_m) {
        const glm::dvec3 point_m = glm::mix(eye_m, target_m, at_m / distance_m);
        const auto ground_m = world.scene.ground->height_at(point_m.x, point_m.y);
        if (ground_m && *ground_m > point_m.z) { return true; }
    }
    return false;
}

int visibility_changes(const world::World& world, const glm::dvec3& eye_m, const std::vector<glm::dvec3>& flight_m) {
    int changes = 0;
    bool hidden = is_hidden(world, eye_m, flight_m.front());
    for (const glm::dvec3& place_m : flight_m) {
        const bool now = is_hidden(world, eye_m, place_m);
        changes += now == hidden ? 0 : 1;
        hidden = now;
    }
    return changes;
}

} // namespace

glm::dvec3 ridge_tower(const world::World& world) {
    constexpr std::size_t every = 5;
    std::vector<glm::dvec3> flight_m;
    glm::dvec3 middle_m(0.0);
    const auto samples = world.flight.trajectory.samples();
    for (std::size_t i = 0; i < samples.size(); i += every) {
        flight_m.push_back(samples[i].position_m);
        middle_m += samples[i].position_m;
    }
    middle_m /= static_cast<double>(flight_m.size());
    glm::dvec3 best_m = middle_m;
    int most = -1;
    for (const double distance_m : distances_m) {
        for (int i = 0; i < directions; ++i) {
            const double angle_rad = 2.0 * pi * i / directions;
            glm::dvec3 eye_m = middle_m + distance_m * glm::dvec3(std::sin(angle_rad), std::cos(angle_rad), 0.0);
            const auto ground_m = world.scene.ground->height_at(eye_m.x, eye_m.y);
            if (!ground_m) { continue; }
            eye_m.z = *ground_m + eye_height_m;
            const int changes = visibility_changes(world, eye_m, flight_m);
            if (changes > most) {
                most = changes;
                best_m = eye_m;
            }
        }
    }
    return best_m;
}

namespace {

/// How far a pixel's middle may lie from what it shows, pixels. Corners are rounded to 1/256 pixel and what is painted
/// again is cut 1/100 pixel too wide where only that rounding could tell.
constexpr double rounding_reach_px = 1.0 / 256.0 + 0.01;

/// In place of a session's renderer: draws each plan, of polygon numbers painted in their order, by every renderer that
/// is compared with rays, and compares the pictures with what rays have found of the same frame. The session's own
/// picture is that of the first one.
class RendererComparer final : public StudyRenderer {
public:
    /// `rays` must have drawn the frame, hidden by depth, before this draws it, and must outlive this. Throws Error.
    RendererComparer(const settings::RunSettings& settings, const RayRenderer& rays)
        : rays_(rays), unrounded_(settings.view.size_px) {
        for (const settings::RendererKind kind : compared_renderers) {
            settings::RunSettings own = settings;
            own.drawing.renderer = kind;
            renderers_.push_back(flight::make_renderer(own));
        }
        info_ = renderers_.front()->info();
    }

    /// How the pictures of the last plan differ from the rays; wrong is what no rounding explains.
    const std::array<RayRenderer::Difference, compared_renderers.size()>& differences() const { return differences_; }

    void load_models(std::span<const scene::ModelBuffers> models) override {
        StudyRenderer::load_models(models);
        unrounded_.load_models(models);
    }

    void draw(const scene::FramePlan& plan) override {
        bool is_unrounded_drawn = false;
        for (std::size_t i = renderers_.size(); i-- > 0;) {
            renderers_[i]->draw(plan);
            renderers_[i]->finish_and_read(picture_);
            differences_[i] = rays_.compare(picture_, rounding_reach_px);
            std::vector<RayRenderer::WrongPixel>& wrong = differences_[i].wrong;
            if (!wrong.empty() && !std::exchange(is_unrounded_drawn, true)) { unrounded_.draw(plan); }
            std::erase_if(wrong, [&](const RayRenderer::WrongPixel& pixel) {
                return unrounded_.is_rounding(pixel.at, pixel.number, rays_.number_of(pixel.at), rounding_reach_px);
            });
        }
    }

    void finish_and_read(scene::Picture& picture) override { picture = picture_; }

private:
    const RayRenderer& rays_;
    RayRenderer unrounded_; ///< the plan painted in its order, but without rounding
    scene::Picture picture_;
    std::array<RayRenderer::Difference, compared_renderers.size()> differences_;
};

std::string text_of(const RayRenderer::WrongPixel& wrong, int frame) {
    return fmt::format("frame {} at {},{}: {}", frame, wrong.at.x, wrong.at.y,
        wrong.nearer ? fmt::format("the ray's is nearer by {:.1e} of the depth", *wrong.nearer)
                     : "what is shown is not there");
}

} // namespace

long RayComparison::wrong() const {
    long sum = 0;
    for (const OfRenderer& one : renderers) { sum += one.wrong; }
    return sum;
}

void RayComparison::add(const RayComparison& other) {
    frames += other.frames;
    pixels += other.pixels;
    for (std::size_t i = 0; i < renderers.size(); ++i) {
        renderers[i].differing += other.renderers[i].differing;
        renderers[i].wrong += other.renderers[i].wrong;
    }
}

RayComparison compare_with_rays(const settings::RunSettings& settings, const flight::ComparisonWorlds& worlds,
    int every, const std::function<void(int compared, int frames)>& on_frame) {
    const auto [painted, depth_buffered] = flight::comparison_settings(settings);
    auto renderer = std::make_unique<RayRenderer>(settings.view.size_px);
    auto renderers = std::make_unique<RendererComparer>(painted, *renderer);
    const RendererComparer& comparer = *renderers;
    Session reference(depth_buffered, PictureContent::PolygonIds, std::move(renderer), worlds.depth_buffered);
    Session painter(painted, PictureContent::PolygonIds, std::move(renderers), worlds.painted);
    RayComparison sum;
    const int frames = (reference.frames() + every - 1) / every;
    for (int frame = 0; frame < reference.frames(); frame += every) {
        reference.draw(frame);
        painter.draw(frame);
        for (std::size_t i = 0; i < sum.renderers.size(); ++i) {
            const RayRenderer::Difference& difference = comparer.differences()[i];
            RayComparison::OfRenderer& own = sum.renderers[i];
            if (own.wrong == 0 && !difference.wrong.empty()) {
                own.first_wrong = text_of(difference.wrong.front(), frame);
            }
            own.differing += difference.differing;
            own.wrong += static_cast<long>(difference.wrong.size());
        }
        sum.pixels += static_cast<long>(settings.view.size_px.x) * settings.view.size_px.y;
        on_frame(++sum.frames, frames);
    }
    return sum;
}

namespace {

struct StudiedView {
    scene::View kind;
    const char* name;
    bool behind_ridges = false; ///< from a tower placed so that ridges hide the aircraft at times
};

/// Rays are compared in all of them, the depth buffer in all but the last.
constexpr std::array views = {StudiedView{scene::View::Chase, "chase"}, StudiedView{scene::View::Tower, "tower"},
    StudiedView{scene::View::Tower, "behind ridges", true}, StudiedView{scene::View::Orbit, "orbit"},
    StudiedView{scene::View::Cockpit, "cockpit"}};

/// The name of a terrain or an aircraft in a table: of a file without its folder.
std::string short_name(const std::string& given) { return std::filesystem::path(given).stem().string(); }

/// A comparison of one flight in one view.
template <class Result>
struct Compared {
    std::vector<report::Cell> name; ///< path, aircraft, view
    Result result;
};

/// Compares every path by each aircraft in every view, over worlds that are loaded once for each flight. `compare`
/// takes settings, worlds, every how many frames, and a function that it calls after each picture.
template <class Result, class Compare>
std::vector<Compared<Result>> run_comparisons(
    const HiddenSurfaceStudyOptions& options, std::span<const StudiedView> studied_views, const Compare& compare) {
    std::vector<Compared<Result>> compared;
    const std::vector<std::string> all_aircraft =
        options.aircraft.empty() ? std::vector<std::string>{"f15", "500md"} : std::vector{options.aircraft};
    for (const char* path : {"straight", "jinking", "pop-up", "turn"}) {
        for (const std::string& aircraft : all_aircraft) {
            settings::RunSettings flown = options.settings;
            flown.path.name = path;
            flown.path.aircraft = {aircraft};
            const flight::ComparisonWorlds worlds = flight::load_comparison_worlds(flown);
            const auto frames = static_cast<int>(world::picture_times_of(flown, worlds.painted.flight).times_s.size());
            const int pictures = (frames + options.every - 1) / options.every * static_cast<int>(studied_views.size());
            base::Progress progress(
                fmt::format("{} {}", path, short_name(aircraft)), pictures, options.quiet, "pictures");
            const auto of_view = [&](const StudiedView& view, bool /*quiet*/) {
                settings::RunSettings settings = flown;
                settings.view.kind = view.kind;
                if (view.behind_ridges) { settings.view.eye_m = ridge_tower(worlds.painted); }
                const auto tick = [&](int, int) { progress.tick(view.name); };
                return Compared<Result>{{{"path", path}, {"aircraft", short_name(aircraft)}, {"view", view.name}},
                    compare(settings, worlds, options.every, tick)};
            };
            std::ranges::move(run_cases(studied_views, options, of_view), std::back_inserter(compared));
        }
    }
    return compared;
}

const std::vector<report::Cell> sum_name = {{"path", "all"}, {"aircraft", ""}, {"view", ""}};

std::vector<NamedFlight> run_races(const HiddenSurfaceStudyOptions& options) {
    std::vector<NamedFlight> races;
    for (const glm::ivec2 size_px : {glm::ivec2(640, 480), glm::ivec2(1280, 720)}) {
        for (const std::string& terrain : {std::string("background60"), options.settings.path.terrain}) {
            for (const std::size_t aircraft : {1U, 16U, 100U, 1000U}) {
                settings::RunSettings settings = options.settings;
                settings.path.name = "straight";
                settings.path.terrain = terrain;
                settings.path.aircraft.assign(aircraft, "f15");
                settings.view.size_px = size_px;
                races.push_back(
                    {{{"scene", short_name(terrain)}, {"aircraft", aircraft}, {"size", "{}x{}", size_px.x, size_px.y}},
                        race(settings, options.race_frames, options.quiet)});
            }
        }
    }
    return races;
}

report::ResultTable race_table(std::span<const NamedFlight> races) {
    report::ResultTable table{"Frames a second by OpenGL: octant order, removal of back faces only, depth buffer"};
    constexpr std::array names = {"octant", "back faces", "depth buffer"}; // of the first of timed_modes
    for (const auto& [name, flight] : races) {
        std::vector<report::Cell> row = name;
        for (std::size_t mode = 0; mode < names.size(); ++mode) {
            row.push_back({fmt::format("{}, frames/s", names[mode]), "{:.0f}", 1000.0 / flight.median(mode)});
        }
        row.push_back({"octant / back faces", "{:.2f}", over_octant(flight, gl_back_faces)});
        row.push_back({"octant / depth buffer", "{:.2f}", over_octant(flight, gl_depth_buffer)});
        for (std::size_t mode = 0; mode < names.size(); ++mode) {
            const auto times_ms = flight.values(mode, &report::FrameRecord::frame_ms);
            row.push_back(
                {fmt::format("p99 ms {}", names[mode]), "{:.2f}", report::statistics_of_times(times_ms).p99_ms});
        }
        for (std::size_t mode = 0; mode < names.size(); ++mode) {
            row.push_back({fmt::format("draw calls {}", names[mode]), "{:.0f}",
                flight.median(mode, &report::FrameRecord::draw_calls)});
        }
        table.add(std::move(row));
    }
    table.note = "Whole frames from simulation to pixels read, medians; the three ways draw every frame in turn. Same "
                 "culling, vertex format and shaders.";
    return table;
}

report::ResultTable picture_table(
    std::vector<Compared<flight::IdComparison>> compared, const HiddenSurfaceStudyOptions& options) {
    report::ResultTable table{"Polygon numbers: octant order against the depth buffer"};
    flight::IdComparison sum;
    for (const auto& [name, result] : compared) {
        sum.frames += result.frames;
        sum.frames_with_cuts += result.frames_with_cuts;
        sum.cuts += result.cuts;
        sum.unordered += result.unordered;
        sum.pixels += result.pixels;
        sum.differing += result.differing;
        sum.unmatched += result.unmatched;
        sum.wrong += result.wrong;
    }
    compared.push_back({sum_name, sum});
    for (auto& [row, result] : compared) {
        row.insert(
            row.end(), {{"frames", result.frames}, {"frames with cuts", result.frames_with_cuts}, {"cuts", result.cuts},
                           {"unordered", result.unordered}, {"pixels", result.pixels}, {"differing", result.differing},
                           {"apart", result.unmatched}, {"wrong", result.wrong}});
        table.add(std::move(row));
    }
    table.note =
        fmt::format("Every frame number {} of each flight over {}, {}x{}. Apart: the pixel's polygon does not "
                    "occur in the 3 x 3 pixels around it in the picture by depth buffer. Wrong: nor in the same "
                    "place of one three times as large, which shows what the rounding of corners to 1/256 pixel "
                    "lost in the first. Cuts: ground triangles and aircraft polygons painted once more in "
                    "front of an aircraft, cut to its outline.",
            options.every, short_name(options.settings.path.terrain), options.settings.view.size_px.x,
            options.settings.view.size_px.y);
    return table;
}

report::ResultTable ray_table(std::vector<Compared<RayComparison>> compared, const HiddenSurfaceStudyOptions& options) {
    report::ResultTable table{"Polygon numbers: octant order against a ray through each pixel's middle"};
    constexpr std::array names = {"raster", "OpenGL"}; // of compared_renderers
    RayComparison sum;
    for (const auto& each : compared) { sum.add(each.result); }
    compared.push_back({sum_name, sum});
    for (auto& [row, result] : compared) {
        row.emplace_back("pictures", result.frames);
        row.emplace_back("pixels of a renderer", result.pixels);
        std::string first_wrong;
        for (std::size_t i = 0; i < names.size(); ++i) {
            const RayComparison::OfRenderer& one = result.renderers[i];
            row.emplace_back(fmt::format("{}: differing", names[i]), one.differing);
            row.emplace_back(fmt::format("{}: wrong", names[i]), one.wrong);
            first_wrong = first_wrong.empty() ? one.first_wrong : first_wrong;
        }
        row.emplace_back("first wrong", first_wrong);
        table.add(std::move(row));
    }
    table.note =
        fmt::format("Every frame number {} of each flight over {}, {}x{}, one sample a pixel. Rays meet all "
                    "triangles in double precision, without order. Wrong: no rounding explains what is shown: "
                    "nothing of that number comes within {:.3f} pixel of the pixel's middle, or all of that "
                    "neighbourhood lies behind nearer triangles. Rounding is also what it is where the pieces, "
                    "painted in their order without it, show what the ray finds, and sides of the piece shown "
                    "and of all painted over it there pass within that distance.",
            options.every, short_name(options.settings.path.terrain), options.settings.view.size_px.x,
            options.settings.view.size_px.y, rounding_reach_px);
    return table;
}

} // namespace

bool study_hidden_surface(const HiddenSurfaceStudyOptions& options) {
    world::load_world(options.settings); // reports wrong settings before a folder is made
    Study study(options);
    bool is_right = true;
    if (options.race) {
        const std::vector<NamedFlight> races = run_races(options);
        study.add("frames-per-second", race_table(races));
        study.add("raster", raster_table(races));
    }
    if (options.pictures) {
        const auto compared = run_comparisons<flight::IdComparison>(
            options, std::span(views).first(views.size() - 1), flight::compare_with_depth_buffer);
        for (const auto& run : compared) { is_right = is_right && run.result.wrong == 0; }
        study.add("pictures", picture_table(compared, options));
    }
    if (options.rays) {
        const auto compared = run_comparisons<RayComparison>(options, views, compare_with_rays);
        for (const auto& run : compared) {
            is_right = is_right && run.result.wrong() == 0;
            for (const RayComparison::OfRenderer& one : run.result.renderers) {
                base::print_note(options.quiet || one.wrong == 0,
                    fmt::format("{} wrong pixels, the first: {}", one.wrong, one.first_wrong));
            }
        }
        study.add("rays", ray_table(compared, options));
    }
    study.finish("hidden-surface");
    return is_right;
}

} // namespace octant::ui::studies::draw_order
