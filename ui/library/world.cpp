#include "sim/base/earth_frame.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/random_generator.h"
#include "sim/base/thread_pool.h"
#include "ui/base/version.h"
#include "ui/library/boxes.h"
#include "ui/library/camera_pictures.h"
#include "ui/library/conversions.h"
#include "ui/library/drawing_lanes.h"
#include "ui/library/loaded_world.h"
#include "ui/settings/setting_rows.h"
#include "ui/world/scene_ground.h"
#include "visuals/scene/truth.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <fmt/format.h>
#include <functional>
#include <iostream>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <octant/octant.h>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace octant {

namespace library = ui::library;
namespace planning = visuals::planning;
namespace scene = visuals::scene;

std::string version() { return ui::base::program_version(); }

namespace ui::library {

/// What all copies of a world share.
struct Loaded {
    ui::settings::RunSettings settings;
    ui::world::World world;
    std::vector<Object> objects;
    std::optional<DrawingLanes> lanes;
    std::mutex frame_mutex; ///< EarthFrame is for one thread at a time.

    /// What draws a checked camera's pictures; null for one that is a pinhole and nothing else. Those of the last
    /// cameras are kept: they take milliseconds to make.
    std::shared_ptr<const CameraPictures> pictures_of(const Camera& camera);

private:
    static constexpr std::size_t most_cameras = 8;
    std::mutex cameras_mutex_;
    std::deque<std::pair<Camera, std::shared_ptr<const CameraPictures>>> cameras_;
};

std::shared_ptr<const CameraPictures> Loaded::pictures_of(const Camera& camera) {
    if (CameraPictures::is_plain(camera)) { return nullptr; }
    {
        const std::scoped_lock lock(cameras_mutex_);
        const auto known = std::ranges::find(cameras_, camera, [](const auto& entry) { return entry.first; });
        if (known != cameras_.end()) { return known->second; }
    }
    auto made = std::make_shared<const CameraPictures>(camera);
    const std::scoped_lock lock(cameras_mutex_);
    cameras_.emplace_back(camera, made);
    if (cameras_.size() > most_cameras) { cameras_.pop_front(); }
    return made;
}

} // namespace ui::library

namespace {

using library::Loaded;
using States = std::vector<sim::AircraftState>;

std::vector<Object> objects_of(const planning::Scene& scene, const ui::settings::RunSettings& settings) {
    std::vector<Object> objects;
    std::map<std::string, int> count;
    for (std::size_t i = 0; i < scene.aircraft.size(); ++i) {
        const planning::AircraftModel& model = scene.model_of(i);
        Object object;
        object.kind = i < settings.path.aircraft.size() ? ui::settings::aircraft_shape(settings.path.aircraft[i])
                                                        : model.polygons.name;
        const int number = ++count[object.kind];
        object.name = number == 1 ? object.kind : fmt::format("{}-{}", object.kind, number);
        object.size_m = library::vec3_from(model.hull.max_m - model.hull.min_m);
        object.box_centre_m = library::vec3_from(0.5 * (model.hull.max_m + model.hull.min_m));
        objects.push_back(std::move(object));
    }
    return objects;
}

States first_states(const ui::world::World& world) {
    States states(world.scene.aircraft.size());
    if (states.empty()) { return states; }
    const sim::AircraftState& leader = world.flight.trajectory.samples().front();
    ui::world::formation_states(
        world.flight, ui::world::formation_of(world.scene, world.flight), leader, leader.time_s, states);
    return states;
}

void tell(const std::function<void(std::string_view)>& on_note, std::string_view note) {
    if (on_note) {
        on_note(note);
    } else {
        std::clog << "octant: " << note << '\n';
    }
}

/// The settings of a run, with those of views and frames as they are by default.
ui::settings::RunSettings world_settings(ui::settings::RunSettings settings) {
    const bool has_ribbon = settings.view.path_ribbon;
    const double start_s = settings.time.start_s;
    settings.view = {};
    settings.view.path_ribbon = has_ribbon;
    settings.time = {};
    settings.time.start_s = start_s;
    settings.drawing = {};
    settings.drawing.renderer = ui::settings::RendererKind::Raster;
    settings.adapt = {};
    return settings;
}

/// Makes what is made when it is first asked for, on two threads, instead of in the first picture.
void finish_loading(const ui::settings::RunSettings& settings, const planning::Scene& scene) {
    constexpr bool on_two_threads = true;
    const auto roads = [&] {
        return settings.ground.roads && !scene.ground_texture ? scene.ground->road_network() : nullptr;
    };
    // The land has the colours of the ground, which need its shadows.
    const auto shadows_and_land = [&] {
        scene.ground->mean_colour();
        return settings.air.sky ? &scene.ground->backdrop() : nullptr;
    };
    run_both(on_two_threads, roads, shadows_and_land);
}

std::shared_ptr<Loaded> load(const ui::settings::RunSettings& settings, const Loaded* shared,
    const std::function<void(std::string_view)>& on_note) {
    if (settings.path.aircraft.empty() && settings.path.name != ui::settings::live_path) {
        throw Error(fmt::format(
            "path: expected aircraft, of which the first flies it, got none beside {}", printable(settings.path.name)));
    }
    auto loaded = std::make_shared<Loaded>();
    loaded->settings = world_settings(settings);
    loaded->world = ui::world::load_world(
        loaded->settings, ui::world::RenderDevice::Cpu, shared == nullptr ? nullptr : &shared->world);
    loaded->settings = ui::world::with_sun_at_time(loaded->settings, loaded->world.ground.place);
    for (const std::string& note : loaded->world.notes) { tell(on_note, note); }
    loaded->objects = objects_of(loaded->world.scene, loaded->settings);
    finish_loading(loaded->settings, loaded->world.scene);
    const planning::Scene& scene = loaded->world.scene;
    loaded->lanes.emplace(
        library::drawn_scenes(scene, loaded->settings), shared != nullptr && shared->lanes->renderers()->are_for(scene)
                                                            ? shared->lanes->renderers()
                                                            : std::make_shared<library::SharedRenderers>(scene));
    return loaded;
}

void check_count(std::size_t got, std::size_t aircraft, std::size_t pictures) {
    if (got == aircraft || got == aircraft * pictures) { return; }
    throw Error(aircraft == 0 ? fmt::format("states: expected none, as there are no aircraft, got {}", got)
                              : fmt::format("states: expected {}, one for each aircraft, or {} for {} pictures, got {}",
                                    aircraft, aircraft * pictures, pictures, got));
}

} // namespace

struct World::Impl {
    std::shared_ptr<Loaded> loaded;
    States states;
    States previous_states;
    std::vector<State> public_states;

    static std::shared_ptr<Impl> of(std::shared_ptr<Loaded> loaded) {
        auto impl = std::make_shared<Impl>();
        impl->loaded = std::move(loaded);
        impl->set_states(first_states(impl->loaded->world));
        impl->previous_states = impl->states;
        return impl;
    }

    void set_states(States wanted) {
        previous_states = std::exchange(states, std::move(wanted));
        public_states.clear();
        for (const sim::AircraftState& state : states) { public_states.push_back(library::state_from(state)); }
    }

    const planning::Scene& scene() const { return loaded->world.scene; }
};

namespace {

/// The states of each picture of a call, checked.
class PictureStates {
public:
    /// `given`: for all pictures, for each, or none: `own`, which must outlive it.
    PictureStates(std::span<const State> given, const States& own, std::size_t pictures) : own_(own) {
        if (given.empty()) { return; }
        check_count(given.size(), own.size(), pictures);
        for (const State& state : given) { made_.push_back(library::aircraft_state(state)); }
    }

    std::span<const sim::AircraftState> of(std::size_t picture) const {
        if (made_.empty()) { return own_; }
        return made_.size() == own_.size() ? std::span(made_)
                                           : std::span(made_).subspan(picture * own_.size(), own_.size());
    }

private:
    const States& own_;
    States made_;
};

/// The pictures of a call, checked.
class Pictures {
public:
    Pictures(const Camera& camera, std::span<const Pose> poses, const RenderOptions& options, const States& own,
        const States& own_previous)
        : size_px_(camera.width, camera.height), samples_(camera.samples), states_(options.states, own, poses.size()),
          previous_states_(options.previous_states.empty() ? options.states : options.previous_states,
              options.states.empty() ? own_previous : own, poses.size()) {
        cameras_.reserve(poses.size());
        previous_.reserve(poses.size());
        for (const Pose& pose : poses) {
            cameras_.push_back(library::pinhole_camera(camera, pose));
            previous_.push_back(library::previous_camera(camera, pose));
        }
    }

    /// Valid as long as this.
    library::PictureRequest request(std::size_t picture) const {
        library::PictureRequest request{cameras_[picture], size_px_, samples_, states_.of(picture)};
        if (previous_[picture]) {
            request.previous = planning::PreviousFrame{*previous_[picture], previous_states_.of(picture)};
        }
        return request;
    }

    library::CameraPicture of_camera(std::size_t picture, const Pose& pose, const RenderOptions& options) const {
        return {
            pose, states_.of(picture), previous_states_.of(picture), options.noise_seed, options.first_index + picture};
    }

private:
    glm::ivec2 size_px_;
    int samples_;
    std::vector<scene::Camera> cameras_;
    std::vector<std::optional<scene::Camera>> previous_;
    PictureStates states_;
    PictureStates previous_states_;
};

/// The arrays of one picture of a batch.
FrameArrays arrays_of(const FrameArrays& to, std::size_t picture, std::size_t pixels) {
    const auto from = [&](auto* array, std::size_t values) {
        return array == nullptr ? nullptr : array + picture * values * pixels;
    };
    return {.rgb = from(to.rgb, 3),
        .rgb16 = from(to.rgb16, 3),
        .depth_m = from(to.depth_m, 1),
        .class_id = from(to.class_id, 1),
        .object_id = from(to.object_id, 1),
        .normal = from(to.normal, 3),
        .flow_px = from(to.flow_px, 2),
        .coverage = from(to.coverage, 1)};
}

scene::TruthArrays truth_of(const FrameArrays& to) {
    return {.depth_m = to.depth_m,
        .class_id = to.class_id,
        .object_id = to.object_id,
        .normal = to.normal,
        .flow_px = to.flow_px,
        .previous_px = nullptr,
        .coverage = to.coverage};
}

bool has_truth(const FrameArrays& to) {
    return to.depth_m != nullptr || to.class_id != nullptr || to.object_id != nullptr || to.normal != nullptr ||
           to.flow_px != nullptr || to.coverage != nullptr;
}

int thread_count(int wanted) {
    constexpr int most = 1024;
    if (wanted < 0 || wanted > most) { throw Error(fmt::format("threads: expected 0 to {}, got {}", most, wanted)); }
    return wanted == 0 ? core_count() : wanted;
}

void write_rgb(const scene::Picture& picture, std::uint8_t* rgb) {
    const std::uint8_t* rgba = picture.rgba.data();
    const std::size_t pixels = picture.rgba.size() / 4;
    std::size_t i = 0;
    // Four bytes at a time, of which the last one is the next pixel's.
    for (; i + 1 < pixels; ++i) { std::memcpy(rgb + 3 * i, rgba + 4 * i, 4); }
    for (; i < pixels; ++i) {
        rgb[3 * i] = rgba[4 * i];
        rgb[3 * i + 1] = rgba[4 * i + 1];
        rgb[3 * i + 2] = rgba[4 * i + 2];
    }
}

} // namespace

namespace {

/// Whether a setting is about views, pictures or frames, which a world has not.
bool is_of_pictures(const ui::settings::SettingInfo& info) {
    using enum ui::settings::SettingGroup;
    return info.name != "path-ribbon" && info.name != "start" && (info.group == View || info.group == Time);
}

void check_world_setting(ui::settings::RunSettings& settings, std::string_view name) {
    ui::settings::visit_settings(settings, [&](const ui::settings::SettingInfo& info, const auto&) {
        if (info.name == name && is_of_pictures(info)) {
            throw Error(fmt::format("{}: expected a setting of a world, got one of views or frames", name));
        }
    });
}

/// The words of the settings by name, in the order of the names' first places.
std::vector<std::pair<std::string, std::vector<std::string>>> words_by_name(const WorldSettings& settings) {
    std::vector<std::pair<std::string, std::vector<std::string>>> words;
    const auto words_of = [&](const std::string& name) {
        return std::ranges::find(words, name, [](const auto& entry) { return entry.first; });
    };
    const auto add = [&](const std::string& name, std::vector<std::string> values) {
        if (!values.empty()) { words.emplace_back(name, std::move(values)); }
    };
    if (settings.terrain != WorldSettings{}.terrain) { add("terrain", {settings.terrain}); }
    add("aircraft", settings.aircraft);
    if (settings.sun_elevation_deg) { add("sun-elevation", {ui::settings::text_of(*settings.sun_elevation_deg)}); }
    if (settings.triangles) { add("triangles", {ui::settings::text_of(*settings.triangles)}); }
    const std::size_t members = words.size();
    for (const auto& [name, value] : settings.settings) {
        const auto known = words_of(name);
        if (known == words.end()) {
            words.push_back({name, {value}});
        } else if (static_cast<std::size_t>(known - words.begin()) < members) {
            throw Error(fmt::format("{}: expected it once, got it among the settings, too", name));
        } else {
            known->second.push_back(value);
        }
    }
    return words;
}

/// The settings of a run that these settings of a world name. Throws Error.
ui::settings::RunSettings run_settings(const WorldSettings& settings) {
    ui::settings::RunSettings run;
    run.path.name = ui::settings::live_path;
    run.path.aircraft.clear();
    for (const auto& [name, words] : words_by_name(settings)) {
        check_world_setting(run, name);
        const std::string note = ui::settings::set_by_name(run, name, words);
        if (!note.empty()) { tell(settings.on_note, note); }
    }
    return run;
}

/// Loads a world. What is said of settings names them as WorldSettings does.
std::shared_ptr<Loaded> load_by(const WorldSettings& settings, const Loaded* shared) {
    const auto in_members = [&settings](std::string_view message) {
        constexpr std::string_view prefix = "sun-elevation:";
        std::string text = ui::settings::with_setting_names(message);
        if (settings.sun_elevation_deg && text.starts_with(prefix)) {
            text.replace(0, prefix.size(), "sun_elevation_deg:");
        }
        return text;
    };
    WorldSettings telling = settings;
    telling.on_note = [&](std::string_view note) { tell(settings.on_note, in_members(note)); };
    try {
        return load(run_settings(telling), shared, telling.on_note);
    } catch (const Error& fault) { throw Error(in_members(fault.what())); }
}

} // namespace

World::World(const WorldSettings& settings) : impl_(Impl::of(load_by(settings, nullptr))) {}

World::World(const WorldSettings& settings, const World& shared)
    : impl_(Impl::of(load_by(settings, shared.impl_->loaded.get()))) {}

World::World(std::shared_ptr<Impl> impl, std::nullptr_t) : impl_(std::move(impl)) {}

World::World(const World&) = default;

World::World(World&& other) noexcept : impl_(other.impl_) {} // NOLINT: a moved-from world stays as it was

World& World::operator=(const World&) = default;

World& World::operator=(World&& other) noexcept { // NOLINT: a moved-from world stays as it was
    impl_ = other.impl_;
    return *this;
}

World::~World() = default;

double World::height_m(double x_m, double y_m) const {
    if (!std::isfinite(x_m) || !std::isfinite(y_m)) { return std::numeric_limits<double>::quiet_NaN(); }
    return impl_->scene().ground->height_at(x_m, y_m).value_or(std::numeric_limits<double>::quiet_NaN());
}

std::pair<double, double> World::half_extent_m() const {
    const glm::dvec2 half_m = impl_->scene().ground->half_extent_m();
    return {half_m.x, half_m.y};
}

std::vector<Vec3> World::random_positions(
    std::size_t count, double min_above_m, double max_above_m, std::uint64_t seed) const {
    if (!std::isfinite(min_above_m) || !std::isfinite(max_above_m) || min_above_m > max_above_m) {
        throw Error(fmt::format("random_positions: expected a least and a greatest height above the ground, got {} "
                                "and {}",
            min_above_m, max_above_m));
    }
    constexpr std::size_t most = 100'000'000;
    if (count > most) { throw Error(fmt::format("random_positions: expected at most {}, got {}", most, count)); }
    constexpr double inner_share = 0.8;
    const auto [east_m, north_m] = half_extent_m();
    RandomGenerator random(seed * 0x9e3779b97f4a7c15ULL + 0xd1b54a32d192ed03ULL);
    random.next(); // neighbouring seeds begin near one another
    std::vector<Vec3> positions;
    positions.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        Vec3 at;
        at.x = random.between(-inner_share * east_m, inner_share * east_m);
        at.y = random.between(-inner_share * north_m, inner_share * north_m);
        const double ground_m = height_m(at.x, at.y);
        at.z = (std::isnan(ground_m) ? 0.0 : ground_m) + random.between(min_above_m, max_above_m);
        positions.push_back(at);
    }
    return positions;
}

namespace {

const EarthFrame& frame_of(const Loaded& loaded, std::string_view what) {
    if (!loaded.world.ground.frame) {
        throw Error(fmt::format("{}: expected a map that lies on the earth, got {}", what, loaded.world.ground.name));
    }
    return *loaded.world.ground.frame;
}

} // namespace

Vec3 World::local(double latitude_deg, double longitude_deg, double height_m) const {
    const EarthFrame& frame = frame_of(*impl_->loaded, "local");
    if (!(std::abs(latitude_deg) <= 90.0) || !std::isfinite(longitude_deg) || !std::isfinite(height_m)) {
        throw Error(
            fmt::format("local: expected a latitude of -90 to 90 degrees, a longitude and a height, got {}, {}, {}",
                latitude_deg, longitude_deg, height_m));
    }
    const std::scoped_lock lock(impl_->loaded->frame_mutex);
    const glm::dvec2 at_m = frame.local_from_geo({latitude_deg, longitude_deg});
    return {at_m.x, at_m.y, height_m};
}

Vec3 World::geodetic(const Vec3& position_m) const {
    const EarthFrame& frame = frame_of(*impl_->loaded, "geodetic");
    const glm::dvec3 at_m = library::checked_place("geodetic: position_m", position_m);
    const std::scoped_lock lock(impl_->loaded->frame_mutex);
    const GeoPosition place = frame.geo_from_local(glm::dvec2(at_m));
    return {place.latitude_deg, place.longitude_deg, at_m.z};
}

const std::vector<Object>& World::objects() const { return impl_->loaded->objects; }

void World::set_states(std::span<const State> states) {
    if (states.size() > objects().size()) {
        throw Error(
            fmt::format("states: expected at most {}, one for each aircraft, got {}", objects().size(), states.size()));
    }
    States wanted;
    for (const State& state : states) { wanted.push_back(library::aircraft_state(state)); }
    while (wanted.size() < objects().size()) {
        wanted.emplace_back();
        wanted.back().is_present = false;
    }
    auto changed = std::make_shared<Impl>(*impl_);
    changed->set_states(std::move(wanted));
    impl_ = std::move(changed);
}

std::span<const State> World::states() const { return impl_->public_states; }

Frames World::render(
    const Camera& camera, std::span<const Pose> poses, Output outputs, const RenderOptions& options) const {
    library::check_camera(camera);
    constexpr auto all = 2U * static_cast<unsigned>(Output::Coverage) - 1U;
    if (outputs == Output{} || (static_cast<unsigned>(outputs) & ~all) != 0) {
        throw Error(fmt::format("outputs: expected some of those of Output, got {}", static_cast<unsigned>(outputs)));
    }
    Frames frames;
    frames.count = poses.size();
    frames.width = camera.width;
    frames.height = camera.height;
    const std::size_t pixels =
        poses.size() * static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
    FrameArrays to;
    const auto make = [&](Output one, auto& array, std::size_t values, auto*& at) {
        if (!has(outputs, one)) { return; }
        array.resize(values * pixels);
        at = array.data();
    };
    if (camera.bits == 16) {
        make(Output::Rgb, frames.rgb16, 3, to.rgb16);
    } else {
        make(Output::Rgb, frames.rgb, 3, to.rgb);
    }
    make(Output::Depth, frames.depth_m, 1, to.depth_m);
    make(Output::ClassId, frames.class_id, 1, to.class_id);
    make(Output::ObjectId, frames.object_id, 1, to.object_id);
    make(Output::Normal, frames.normal, 3, to.normal);
    make(Output::Flow, frames.flow_px, 2, to.flow_px);
    make(Output::Coverage, frames.coverage, 1, to.coverage);
    render(camera, poses, to, options);
    return frames;
}

void World::render(
    const Camera& camera, std::span<const Pose> poses, const FrameArrays& to, const RenderOptions& options) const {
    const std::shared_ptr<Impl> impl = impl_; // the world may be closed while it draws
    library::check_camera(camera);
    const int threads = thread_count(options.threads);
    const Pictures pictures(camera, poses, options, impl->states, impl->previous_states);
    const std::size_t pixels = static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
    const bool wants_truth = has_truth(to);
    const std::shared_ptr<const library::CameraPictures> special = impl->loaded->pictures_of(camera);
    if (special) { std::ranges::for_each(poses, library::CameraPictures::check_motion); }
    const auto draw = [&](std::size_t picture, library::DrawingLane& lane) {
        const FrameArrays arrays = arrays_of(to, picture, pixels);
        if (special) {
            special->draw(lane, pictures.of_camera(picture, poses[picture], options), arrays);
            return;
        }
        lane.plan(pictures.request(picture));
        if (to.rgb != nullptr) {
            write_rgb(lane.draw(), arrays.rgb);
        } else if (wants_truth) {
            lane.prepare_truth();
        }
        if (wants_truth) { lane.draw_truth(truth_of(arrays)); }
    };
    if (!impl->loaded->lanes->for_each(poses.size(), threads, options.is_stopped, draw)) {
        throw Interrupted("render: stopped by the caller");
    }
}

std::vector<std::vector<Box>> World::boxes(
    const Camera& camera, std::span<const Pose> poses, const RenderOptions& options) const {
    const std::shared_ptr<Impl> impl = impl_;
    library::check_camera(camera);
    const int threads = thread_count(options.threads);
    const Pictures pictures(camera, poses, options, impl->states, impl->previous_states);
    std::vector<planning::AxisAlignedBox> bounds;
    for (std::size_t i = 0; i < impl->scene().aircraft.size(); ++i) {
        bounds.push_back(impl->scene().model_of(i).hull);
    }
    const std::shared_ptr<const library::CameraPictures> special = impl->loaded->pictures_of(camera);
    if (special) { std::ranges::for_each(poses, library::CameraPictures::check_motion); }
    std::vector<std::vector<Box>> boxes(poses.size());
    const auto find = [&](std::size_t picture, library::DrawingLane& lane) {
        library::PictureRequest request = pictures.request(picture);
        request.previous.reset();
        const library::CameraPicture whole = pictures.of_camera(picture, poses[picture], options);
        boxes[picture] = library::BoxFinder(camera, bounds, special.get()).boxes_in(whole, request, lane);
    };
    if (!impl->loaded->lanes->for_each(poses.size(), threads, options.is_stopped, find)) {
        throw Interrupted("boxes: stopped by the caller");
    }
    return boxes;
}

namespace {

/// The triangles of a plan of that scene as OBJ in world axes.
std::string obj_of(const scene::FramePlan& plan, const planning::Scene& drawn, const glm::dvec3& eye_m) {
    std::vector<scene::ModelBuffers> models;
    for (const auto& model : drawn.models) { models.push_back(model->buffers); }
    // By class and object, each group's triangles in the plan's order.
    std::map<std::pair<int, std::uint32_t>, std::vector<scene::SurfaceTriangle>> groups;
    scene::for_each_surface_triangle(plan, models, [&](const scene::SurfaceTriangle& triangle) {
        groups[{static_cast<int>(triangle.surface), triangle.object}].push_back(triangle);
    });
    std::string obj = fmt::format(
        "# Octant, as drawn from {:.6f} {:.6f} {:.6f}; x east, y north, z up, metres\n", eye_m.x, eye_m.y, eye_m.z);
    std::size_t vertices = 0;
    for (const auto& [key, triangles] : groups) {
        const std::string_view surface = name_of(static_cast<SurfaceClass>(key.first));
        fmt::format_to(std::back_inserter(obj), "g {}\n",
            key.second == 0 ? std::string(surface) : fmt::format("{}-{}", surface, key.second));
        for (const scene::SurfaceTriangle& triangle : triangles) {
            for (const glm::dvec3& corner_m : triangle.corners_m) {
                const glm::dvec3 at_m = eye_m + corner_m;
                fmt::format_to(std::back_inserter(obj), "v {:.7f} {:.7f} {:.7f}\n", at_m.x, at_m.y, at_m.z);
            }
            vertices += 3;
            fmt::format_to(std::back_inserter(obj), "f {} {} {}\n", vertices - 2, vertices - 1, vertices);
        }
    }
    return obj;
}

} // namespace

void World::export_scene(const std::string& path, const Camera& camera, const Pose& pose) const {
    const std::shared_ptr<Impl> impl = impl_;
    library::check_camera(camera);
    check_can_write(path);
    const Pictures pictures(camera, std::span(&pose, 1), {}, impl->states, impl->previous_states);
    std::string obj;
    impl->loaded->lanes->for_each(1, 1, {}, [&](std::size_t picture, library::DrawingLane& lane) {
        const library::PictureRequest request = pictures.request(picture);
        obj = obj_of(lane.plan(request), impl->scene(), request.camera.eye_m);
    });
    write_file(path, obj);
}

#pragma GCC visibility push(hidden)

struct WorldAccess {
    static const Loaded& loaded(const World& world) { return *world.impl_->loaded; }

    static World make(std::shared_ptr<Loaded> loaded) { return {World::Impl::of(std::move(loaded)), nullptr}; }
};

#pragma GCC visibility pop

} // namespace octant

namespace octant::ui::library {

const world::World& loaded_world(const World& world) { return WorldAccess::loaded(world).world; }

const settings::RunSettings& settings_of(const World& world) { return WorldAccess::loaded(world).settings; }

World make_world(
    const settings::RunSettings& settings, const World* shared, const std::function<void(std::string_view)>& on_note) {
    return WorldAccess::make(load(settings, shared == nullptr ? nullptr : &WorldAccess::loaded(*shared), on_note));
}

} // namespace octant::ui::library
