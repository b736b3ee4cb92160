#include "ui/studies/draw_order/study_hidden_surface.h"

#include "sim/base/output_file.h"
#include "sim/base/units.h"
#include "ui/base/progress.h"
#include "ui/flight/id_comparison.h"
#include "ui/flight/renderer_choice.h"
#include "ui/flight/session.h"
#include "ui/report/html_text.h"
#include "ui/studies/draw_order/surface_race.h"
#include "ui/world/world.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace octant::ui::studies::draw_order {

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

namespace scene = visuals::scene;

namespace {

constexpr std::uint32_t without_alpha = 0xffffffU;
constexpr double nearer_share = 1e-6; ///< by which one of two depths must be nearer to count

std::size_t index_of(const glm::ivec2& pixel, const glm::ivec2& size_px) {
    return static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(size_px.x) + static_cast<std::size_t>(pixel.x);
}

std::uint32_t number_radius(const scene::Picture& picture, std::size_t pixel) {
    std::uint32_t number = 0;
    std::memcpy(&number, picture.rgba.data() + 4 * pixel, sizeof number);
    return number & without_alpha;
}

double distance_to_segment(const glm::dvec2& at, const glm::dvec2& from, const glm::dvec2& to) {
    const glm::dvec2 mode = to - from;
    const double length2 = glm::dot(mode, mode);
    const double share = length2 > 0.0 ? std::clamp(glm::dot(at - from, mode) / length2, 0.0, 1.0) : 0.0;
    return glm::distance(at, from + share * mode);
}

/// Places within reach of a pixel's middle, itself among them: a square grid.
std::array<glm::dvec3, 25> places_around(const glm::ivec2& pixel, double reach_px) {
    std::array<glm::dvec3, 25> places;
    for (int i = 0; i < 25; ++i) {
        const glm::dvec2 steps(i % 5 - 2, i / 5 - 2);
        places[static_cast<std::size_t>(i)] = {glm::dvec2(pixel) + steps * (reach_px / 2.0), 1.0};
    }
    return places;
}

/// The box of what of a triangle lies before the near plane, from homogeneous places in pixels.
std::array<glm::dvec2, 2> box_of(const glm::dmat3& corners, double near_m) {
    std::array<glm::dvec2, 2> box{glm::dvec2(1e9), glm::dvec2(-1e9)};
    const auto add = [&](const glm::dvec3& at) {
        box[0] = glm::min(box[0], glm::dvec2(at) / at.z);
        box[1] = glm::max(box[1], glm::dvec2(at) / at.z);
    };
    for (glm::length_t i = 0; i < 3; ++i) {
        const glm::dvec3& here = corners[i];
        const glm::dvec3& next = corners[(i + 1) % 3];
        if (here.z >= near_m) { add(here); }
        if ((here.z >= near_m) != (next.z >= near_m)) {
            add(glm::mix(here, next, (near_m - here.z) / (next.z - here.z)));
        }
    }
    return box;
}

} // namespace

double RayRenderer::Target::inside_px(const glm::dvec3& at) const {
    return std::min({glm::dot(inwards[0], at), glm::dot(inwards[1], at), glm::dot(inwards[2], at)});
}

double RayRenderer::Target::distance_px(const glm::dvec2& at) const {
    const double inside = inside_px({at, 1.0});
    if (inside >= 0.0) { return 0.0; }
    return is_placed ? std::min({distance_to_segment(at, corners_px[0], corners_px[1]),
                           distance_to_segment(at, corners_px[1], corners_px[2]),
                           distance_to_segment(at, corners_px[2], corners_px[0])})
                     : -inside;
}

RayRenderer::RayRenderer(const glm::ivec2& size_px) : size_px_(size_px) {
    info_.description = "rays";
    info_.device = "processor";
    info_.is_software = true;
    resize(size_px, 1);
}

std::unique_ptr<scene::Renderer> RayRenderer::sibling(const glm::ivec2& size_px, int) const {
    return std::make_unique<RayRenderer>(size_px);
}

void RayRenderer::resize(const glm::ivec2& size_px, std::optional<int>) {
    size_px_ = size_px;
    picture_.width = size_px.x;
    picture_.height = size_px.y;
    const std::size_t pixels = static_cast<std::size_t>(size_px.x) * static_cast<std::size_t>(size_px.y);
    picture_.rgba.assign(4 * pixels, 0);
    inverse_depths_.assign(pixels, 0.0);
}

void RayRenderer::load_models(std::span<const scene::ModelBuffers> models) {
    models_.assign(models.begin(), models.end());
}

void RayRenderer::draw(const scene::FramePlan& plan) {
    world_to_clip_ = glm::dmat4(plan.view_to_clip) * glm::dmat4(plan.world_to_view);
    near_m_ = static_cast<double>(plan.view_to_clip[3][2]);
    targets_.clear();
    pieces_ = 0;
    add_ground(plan);
    for (const scene::PaintStep& step : plan.steps) {
        for (std::uint32_t i = step.first;
             step.content == scene::PaintStep::Content::Aircraft && i < step.first + step.count; ++i) {
            add_aircraft(plan, plan.aircraft[i]);
        }
    }
    std::ranges::fill(picture_.rgba, std::uint8_t{0});
    std::ranges::fill(inverse_depths_, 0.0);
    for (const Target& target : targets_) { draw_target(target); }
}

void RayRenderer::add_ground(const scene::FramePlan& plan) {
    const auto& indices = plan.ground.indices;
    const auto& vertices = plan.ground.vertices;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        ++pieces_;
        add({vertices[indices[i]].position_m, vertices[indices[i + 1]].position_m, vertices[indices[i + 2]].position_m},
            vertices[indices[i]].colour, false);
    }
}

void RayRenderer::add_aircraft(const scene::FramePlan& plan, const scene::AircraftDraw& draw) {
    const scene::ModelBuffers& model = models_[draw.model];
    const auto add_range = [&](std::size_t first, std::size_t count) {
        std::optional<std::uint32_t> polygon;
        for (std::size_t i = first; i + 2 < first + count; i += 3) {
            const std::uint32_t next = model.vertices[model.indices[i]].polygon;
            if (polygon != next) { ++pieces_; }
            polygon = next;
            std::array<glm::vec3, 3> corners_m;
            for (std::size_t k = 0; k < 3; ++k) {
                const scene::ModelVertex& vertex = model.vertices[model.indices[i + k]];
                const glm::dmat4 turn(plan.parts[draw.first_part + vertex.part]);
                corners_m[k] = glm::vec3(turn * glm::dvec4(glm::dvec3(vertex.position_m), 1.0));
            }
            add(corners_m, model.vertices[model.indices[i]].face_colour, true);
        }
    };
    if (draw.ranges.empty()) { add_range(draw.first_index, draw.index_count); }
    for (const scene::IndexRange& range : draw.ranges) { add_range(range.first_index, range.index_count); }
}

void RayRenderer::add(const std::array<glm::vec3, 3>& corners_m, std::uint32_t number, bool culls) {
    glm::dmat3 corners; // homogeneous places, pixels from the middle of the upper left one
    for (glm::length_t k = 0; k < 3; ++k) {
        const glm::dvec4 clip = world_to_clip_ * glm::dvec4(glm::dvec3(corners_m[static_cast<std::size_t>(k)]), 1.0);
        corners[k] = {(clip.x + clip.w) * 0.5 * size_px_.x - 0.5 * clip.w,
            (clip.w - clip.y) * 0.5 * size_px_.y - 0.5 * clip.w, clip.w};
    }
    const double doubled_area = glm::determinant(corners);
    if (doubled_area == 0.0 || (culls && doubled_area > 0.0)) { return; }
    const auto [least, most] = box_of(corners, near_m_);
    Target target;
    target.least = glm::max(glm::ivec2(glm::max(glm::floor(least) - 1.0, glm::dvec2(-1.0))), glm::ivec2(0));
    target.most = glm::min(glm::ivec2(glm::min(glm::ceil(most) + 1.0, glm::dvec2(size_px_))), size_px_ - 1);
    if (target.least.x > target.most.x || target.least.y > target.most.y) { return; }
    const glm::dmat3 rows = glm::transpose(glm::inverse(corners));
    for (glm::length_t k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        target.inwards[i] = rows[k] / std::max(glm::length(glm::dvec2(rows[k])), 1e-300);
        target.inverse_depth += rows[k];
        target.max_over_w = std::max(target.max_over_w, 1.0 / std::max(corners[k].z, near_m_));
        target.corners_px[i] = glm::dvec2(corners[k]) / corners[k].z;
    }
    target.is_placed = corners[0].z >= near_m_ && corners[1].z >= near_m_ && corners[2].z >= near_m_;
    target.number = number & without_alpha;
    target.piece = pieces_;
    targets_.push_back(target);
}

void RayRenderer::draw_target(const Target& target) {
    for (int row = target.least.y; row <= target.most.y; ++row) {
        for (int column = target.least.x; column <= target.most.x; ++column) {
            const glm::dvec3 at(column, row, 1.0);
            if (target.inside_px(at) < 0.0) { continue; }
            const double inverse_depth = glm::dot(target.inverse_depth, at);
            const std::size_t pixel = index_of({column, row}, size_px_);
            if (inverse_depth > inverse_depths_[pixel] && inverse_depth * near_m_ <= 1.0) {
                inverse_depths_[pixel] = inverse_depth;
                std::memcpy(picture_.rgba.data() + 4 * pixel, &target.number, sizeof target.number);
            }
        }
    }
}

std::uint32_t RayRenderer::number_of(const glm::ivec2& pixel) const {
    return number_radius(picture_, index_of(pixel, size_px_));
}

RayRenderer::Difference RayRenderer::compare(const scene::Picture& picture, double reach_px) const {
    assert(picture.width == size_px_.x && picture.height == size_px_.y);
    Difference difference;
    for (int row = 0; row < size_px_.y; ++row) {
        for (int column = 0; column < size_px_.x; ++column) {
            const std::size_t pixel = index_of({column, row}, size_px_);
            const std::uint32_t number = number_radius(picture, pixel);
            if (number == number_radius(picture_, pixel)) { continue; }
            ++difference.differing;
            if (const auto fault = wrong_pixel_at({column, row}, number, reach_px)) {
                difference.wrong.push_back(*fault);
            }
        }
    }
    return difference;
}

bool RayRenderer::may_reach(const Target& target, const glm::ivec2& pixel, double reach_px) {
    return pixel.x >= target.least.x && pixel.x <= target.most.x && pixel.y >= target.least.y &&
           pixel.y <= target.most.y && target.inside_px({pixel, 1.0}) >= -reach_px;
}

std::optional<RayRenderer::WrongPixel> RayRenderer::wrong_pixel_at(
    const glm::ivec2& pixel, std::uint32_t number, double reach_px) const {
    const glm::dvec2 middle(pixel);
    const glm::dvec3 at(middle, 1.0);
    std::vector<const Target*> others;
    double shown_by_w = number == 0 ? 0.0 : -1.0; // 0: nothing, infinitely far
    for (const Target& target : targets_) {
        if (!may_reach(target, pixel, reach_px)) { continue; }
        if (target.number != number) {
            others.push_back(&target);
        } else if (target.distance_px(middle) <= reach_px) {
            const double inverse_depth =
                glm::dot(target.inverse_depth, at) + reach_px * glm::length(glm::dvec2(target.inverse_depth));
            shown_by_w = std::max(shown_by_w, std::min(inverse_depth, target.max_over_w));
        }
    }
    if (shown_by_w < 0.0) { return WrongPixel{pixel, number, std::nullopt}; }
    const auto hides = [&](const glm::dvec3& place) {
        return std::ranges::any_of(others, [&](const Target* other) {
            const double inverse_depth = glm::dot(other->inverse_depth, place);
            return other->inside_px(place) >= 0.0 && inverse_depth * near_m_ <= 1.0 &&
                   inverse_depth > shown_by_w * (1.0 + nearer_share);
        });
    };
    if (!std::ranges::all_of(places_around(pixel, reach_px), hides)) { return std::nullopt; }
    const double found_by_w = inverse_depths_[index_of(pixel, size_px_)];
    return WrongPixel{pixel, number, found_by_w / shown_by_w - 1.0};
}

bool RayRenderer::is_rounding(
    const glm::ivec2& pixel, std::uint32_t number, std::uint32_t seen, double reach_px) const {
    const glm::dvec2 middle(pixel);
    const auto places = places_around(pixel, reach_px);
    std::uint32_t last = 0; // painted without rounding
    bool may_be_shown = false;
    for (auto first = targets_.begin(); first != targets_.end();) {
        const auto end =
            std::find_if(first, targets_.end(), [&](const Target& one) { return one.piece != first->piece; });
        const std::span piece(first, end);
        first = end;
        if (std::ranges::none_of(piece, [&](const Target& one) {
                return may_reach(one, pixel, reach_px) && one.distance_px(middle) <= reach_px;
            })) {
            continue;
        }
        const auto covers = [&](const glm::dvec3& place) {
            return std::ranges::any_of(piece, [&](const Target& one) { return one.inside_px(place) >= 0.0; });
        };
        const bool is_certain = std::ranges::all_of(places, covers);
        last = covers({middle, 1.0}) ? piece.front().number : last;
        may_be_shown = !is_certain && (may_be_shown || piece.front().number == number);
    }
    return may_be_shown && last == seen;
}

namespace scene = visuals::scene;

RendererComparer::RendererComparer(const settings::RunSettings& settings, const RayRenderer& rays)
    : settings_(settings), rays_(rays), unrounded_(settings.view.size_px) {
    for (std::size_t i = 0; i < renderers_.size(); ++i) {
        settings::RunSettings own = settings;
        own.drawing.renderer = compared_renderers[i];
        renderers_[i] = flight::make_renderer(own);
    }
}

std::unique_ptr<scene::Renderer> RendererComparer::sibling(const glm::ivec2& size_px, int) const {
    settings::RunSettings own = settings_;
    own.view.size_px = size_px;
    return std::make_unique<RendererComparer>(own, rays_);
}

void RendererComparer::resize(const glm::ivec2& size_px, std::optional<int> samples) {
    settings_.view.size_px = size_px;
    for (const auto& renderer : renderers_) { renderer->resize(size_px, samples); }
    unrounded_.resize(size_px, samples);
}

void RendererComparer::load_models(std::span<const scene::ModelBuffers> models) {
    for (const auto& renderer : renderers_) { renderer->load_models(models); }
    unrounded_.load_models(models);
}

void RendererComparer::load_ground_texture(const scene::GroundTexture& texture) {
    for (const auto& renderer : renderers_) { renderer->load_ground_texture(texture); }
}

void RendererComparer::warm_up() {
    for (const auto& renderer : renderers_) { renderer->warm_up(); }
}

void RendererComparer::draw(const scene::FramePlan& plan) {
    is_unrounded_drawn_ = false;
    for (std::size_t i = renderers_.size(); i-- > 0;) {
        renderers_[i]->draw(plan);
        renderers_[i]->finish_and_read(picture_);
        differences_[i] = difference_to_rays(plan, picture_);
    }
}

RayRenderer::Difference RendererComparer::difference_to_rays(
    const scene::FramePlan& plan, const scene::Picture& picture) {
    RayRenderer::Difference difference = rays_.compare(picture, rounding_reach_px);
    if (!difference.wrong.empty() && !std::exchange(is_unrounded_drawn_, true)) { unrounded_.draw(plan); }
    std::erase_if(difference.wrong, [&](const RayRenderer::WrongPixel& pixel) {
        return unrounded_.is_rounding(pixel.at, pixel.number, rays_.number_of(pixel.at), rounding_reach_px);
    });
    return difference;
}

namespace scene = visuals::scene;
using flight::PictureContent;
using flight::Session;

namespace {

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

namespace scene = visuals::scene;

namespace {

constexpr std::array views = {StudiedView{scene::View::Chase, "chase"}, StudiedView{scene::View::Tower, "tower"},
    StudiedView{scene::View::Tower, "behind ridges", true}, StudiedView{scene::View::Orbit, "orbit"}};
constexpr StudiedView cockpit{scene::View::Cockpit, "cockpit"};

ComparisonFlights aircraft_shown_by(const HiddenSurfaceStudyOptions& study) {
    return {study.settings,
        study.aircraft.empty() ? std::vector<std::string>{"f15", "500md"} : std::vector<std::string>{study.aircraft},
        study.every, study.jobs, study.quiet};
}

std::vector<Race> run_races(const HiddenSurfaceStudyOptions& study) {
    std::vector<Race> races;
    for (const glm::ivec2 size_px : {glm::ivec2(640, 480), glm::ivec2(1280, 720)}) {
        for (const std::string& terrain : {std::string("background60"), study.settings.path.terrain}) {
            for (const std::size_t aircraft : {1U, 16U, 100U, 1000U}) {
                settings::RunSettings settings = study.settings;
                settings.path.name = "straight";
                settings.path.terrain = terrain;
                settings.path.aircraft.assign(aircraft, "f15");
                settings.view.size_px = size_px;
                races.push_back(race(settings, study.race_frames, study.quiet));
            }
        }
    }
    return races;
}

report::HtmlTable race_table(const std::vector<Race>& races) {
    report::HtmlTable table;
    table.title = "Frames a second by OpenGL: octant order, removal of back faces only, depth buffer";
    table.header = {"scene", "aircraft", "size", "octant, frames/s", "back faces, frames/s", "depth buffer, frames/s",
        "octant / back faces", "octant / depth buffer", "p99 ms octant", "p99 ms back faces", "p99 ms depth buffer",
        "draw calls octant", "draw calls back faces", "draw calls depth buffer"};
    for (const Race& r : races) {
        std::vector<std::string> cells =
            report::cells("{}\t{}\t{}x{}", short_name(r.scene), r.aircraft, r.width_px, r.height_px);
        for (const RaceTimes& mode : r.gl_times) { cells.push_back(fmt::format("{:.0f}", 1000.0 / mode.median_ms)); }
        report::append_cells(cells, "{:.2f}\t{:.2f}", r.against(1), r.against(2));
        for (const RaceTimes& mode : r.gl_times) { cells.push_back(fmt::format("{:.2f}", mode.p99_ms)); }
        for (const RaceTimes& mode : r.gl_times) { cells.push_back(fmt::format("{}", mode.draw_calls)); }
        table.rows.push_back(std::move(cells));
    }
    table.note = "Whole frames from simulation to pixels read, medians; the three ways draw every "
                 "frame in turn. Same culling, vertex format and shaders.";
    return table;
}

report::HtmlTable raster_times(const std::vector<Race>& races) {
    std::vector<std::vector<std::string>> names;
    std::vector<RasterTimes> times;
    for (const Race& r : races) {
        names.push_back(
            {short_name(r.scene), fmt::format("{}", r.aircraft), fmt::format("{}x{}", r.width_px, r.height_px)});
        times.push_back(r.raster);
    }
    return raster_table({"scene", "aircraft", "size"}, names, times);
}

std::vector<std::string> cells_of(std::vector<std::string> name, const flight::IdComparison& result) {
    report::append_cells(name, "{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}", result.frames, result.frames_with_cuts, result.cuts,
        result.unordered, result.pixels, result.differing, result.unmatched, result.wrong);
    return name;
}

report::HtmlTable picture_table(
    const std::vector<NamedResult<flight::IdComparison>>& compared, const HiddenSurfaceStudyOptions& study) {
    report::HtmlTable table;
    table.title = "Polygon numbers: octant order against the depth buffer";
    table.header = {"path", "aircraft", "view", "frames", "frames with cuts", "cuts", "unordered", "pixels",
        "differing", "apart", "wrong"};
    flight::IdComparison sum;
    for (const NamedResult<flight::IdComparison>& run : compared) {
        table.rows.push_back(cells_of(run.name, run.result));
        sum.frames += run.result.frames;
        sum.frames_with_cuts += run.result.frames_with_cuts;
        sum.cuts += run.result.cuts;
        sum.unordered += run.result.unordered;
        sum.pixels += run.result.pixels;
        sum.differing += run.result.differing;
        sum.unmatched += run.result.unmatched;
        sum.wrong += run.result.wrong;
    }
    table.rows.push_back(cells_of({"all", "", ""}, sum));
    table.note = fmt::format("Every frame number {} of each flight over {}, {}x{}. Apart: the pixel's polygon does not "
                             "occur in the 3 x 3 pixels around it in the picture by depth buffer. Wrong: nor in the "
                             "same "
                             "place of one three times as large, which shows what the rounding of corners to 1/256 "
                             "pixel "
                             "lost in the first. Cuts: ground triangles and aircraft polygons painted once more in "
                             "front of an aircraft, cut to its outline.",
        study.every, short_name(study.settings.path.terrain), study.settings.view.size_px.x,
        study.settings.view.size_px.y);
    return table;
}

std::vector<NamedResult<RayComparison>> run_ray_comparisons(const HiddenSurfaceStudyOptions& study) {
    std::vector<StudiedView> all(views.begin(), views.end());
    all.push_back(cockpit);
    return run_comparisons(aircraft_shown_by(study), all,
        [&](const settings::RunSettings& settings, const flight::ComparisonWorlds& worlds, int every,
            const auto& on_frame) {
            RayComparison result = compare_with_rays(settings, worlds, every, on_frame);
            for (const RayComparison::OfRenderer& one : result.renderers) {
                if (one.wrong > 0) {
                    base::print_note(
                        study.quiet, fmt::format("{} wrong pixels, the first: {}", one.wrong, one.first_wrong));
                }
            }
            return result;
        });
}

report::HtmlTable ray_table(
    const std::vector<NamedResult<RayComparison>>& compared, const HiddenSurfaceStudyOptions& study) {
    report::HtmlTable table;
    table.title = "Polygon numbers: octant order against a ray through each pixel's middle";
    table.header = {"path", "aircraft", "view", "pictures", "pixels of a renderer", "raster: differing",
        "raster: wrong", "OpenGL: differing", "OpenGL: wrong", "first wrong"};
    const auto add_row = [&](std::vector<std::string> cells, const RayComparison& result) {
        report::append_cells(cells, "{}\t{}", result.frames, result.pixels);
        std::string first_wrong;
        for (const RayComparison::OfRenderer& one : result.renderers) {
            report::append_cells(cells, "{}\t{}", one.differing, one.wrong);
            first_wrong = first_wrong.empty() ? one.first_wrong : first_wrong;
        }
        cells.push_back(first_wrong);
        table.rows.push_back(std::move(cells));
    };
    RayComparison sum;
    for (const NamedResult<RayComparison>& run : compared) {
        add_row(run.name, run.result);
        sum.add(run.result);
    }
    add_row({"all", "", ""}, sum);
    table.note =
        fmt::format("Every frame number {} of each flight over {}, {}x{}, one sample a pixel. Rays meet all "
                    "triangles in double precision, without order. Wrong: no rounding explains what is shown: "
                    "nothing of that number comes within {:.3f} pixel of the pixel's middle, or all of that "
                    "neighbourhood lies behind nearer triangles. Rounding is also what it is where the pieces, "
                    "painted in their order without it, show what the ray finds, and sides of the piece shown "
                    "and of all painted over it there pass within that distance.",
            study.every, short_name(study.settings.path.terrain), study.settings.view.size_px.x,
            study.settings.view.size_px.y, rounding_reach_px);
    return table;
}

} // namespace

bool study_hidden_surface(const HiddenSurfaceStudyOptions& study) {
    world::load_world(study.settings); // reports wrong settings before a folder is made
    report::StudyTables tables(study);
    bool is_right = true;
    if (study.race) {
        const std::vector<Race> races = run_races(study);
        tables.add("frames-per-second", race_table(races));
        tables.add("raster", raster_times(races));
    }
    if (study.pictures) {
        const auto compared = run_comparisons(aircraft_shown_by(study), views, flight::compare_with_depth_buffer);
        for (const auto& run : compared) { is_right = is_right && run.result.wrong == 0; }
        tables.add("pictures", picture_table(compared, study));
    }
    if (study.rays) {
        const auto compared = run_ray_comparisons(study);
        for (const auto& run : compared) { is_right = is_right && run.result.wrong() == 0; }
        tables.add("rays", ray_table(compared, study));
    }
    tables.finish("hidden-surface", tables.markdown());
    base::print_note(study.quiet, fmt::format("tables: {}/hidden-surface.md", study.out.string()));
    return is_right;
}

} // namespace octant::ui::studies::draw_order
