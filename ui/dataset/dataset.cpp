#include "ui/dataset/dataset.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/thread_pool.h"
#include "ui/library/loaded_world.h"
#include "ui/settings/frame_part.h"
#include "ui/settings/setting_rows.h"
#include "ui/settings/settings_file.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fmt/format.h>
#include <mutex>
#include <nlohmann/json.hpp>
#include <octant/octant.h>
#include <optional>
#include <set>
#include <utility>

namespace octant::ui::dataset {

namespace {

/// A sample's settings, and the values that were drawn for them.
struct PlannedSample {
    std::uint64_t index = 0;
    int draw = 0; ///< from 0; greater where earlier draws made no world
    settings::RunSettings settings;
    std::vector<std::pair<std::string, std::string>> varied;
};

/// The key of a sample's draw. A further draw is as of another data set.
SampleKey key_of(const Dataset& dataset, std::uint64_t index, int draw) {
    constexpr std::uint64_t step = 0xd1342543de82ef95ULL;
    return {dataset.seed + step * static_cast<std::uint64_t>(draw), index};
}

PlannedSample planned(const Dataset& dataset, std::uint64_t index, int draw) {
    PlannedSample sample{.index = index, .draw = draw, .settings = {}, .varied = {}};
    const SampleKey key = key_of(dataset, index / dataset.per_world, draw);
    sample.settings = settings_of(dataset.settings, dataset.varied, key, &sample.varied);
    return sample;
}

/// Orders samples so that worlds that take long to change come one after the other: by what is loaded, then by the
/// other values.
std::pair<std::string, std::string> order_key(const PlannedSample& sample) {
    std::pair<std::string, std::string> key;
    const settings::RunSettings defaults;
    for (const auto& [name, value] : sample.varied) {
        bool is_loaded = false;
        settings::visit_settings(defaults, [&, &name = name](const settings::SettingInfo& info, const auto&) {
            is_loaded = is_loaded || (info.name == name && info.change >= settings::SettingsChange::World);
        });
        (is_loaded ? key.first : key.second) += name + '=' + value + ';';
    }
    return key;
}

/// Samples that one thread makes one after the other.
using Job = std::vector<std::uint64_t>;

std::vector<Job> jobs_of(const Dataset& dataset, std::span<const std::uint64_t> indices, int threads) {
    using Row = std::pair<std::pair<std::string, std::string>, std::uint64_t>;
    std::vector<Row> rows;
    for (const std::uint64_t index : indices) { rows.emplace_back(order_key(planned(dataset, index, 0)), index); }
    std::ranges::sort(rows);
    constexpr std::size_t most = 64;
    const std::size_t fair = indices.size() / (4 * static_cast<std::size_t>(threads)) + 1;
    std::vector<Job> jobs;
    const Row* before = nullptr;
    for (const Row& row : rows) {
        const bool same_loads = before != nullptr && before->first.first == row.first.first;
        if (!same_loads || jobs.back().size() >= std::min(most, fair)) { jobs.emplace_back(); }
        jobs.back().push_back(row.second);
        before = &row;
    }
    return jobs;
}

octant::State state_from(const sim::AircraftState& state) {
    octant::State made;
    made.position_m = {state.position_m.x, state.position_m.y, state.position_m.z};
    const glm::dquat& q = state.body_to_world;
    made.attitude = {q.w, q.x, q.y, q.z};
    made.is_present = state.is_present;
    made.time_s = state.time_s;
    made.velocity_mps = {state.velocity_mps.x, state.velocity_mps.y, state.velocity_mps.z};
    made.load_factor = state.load_factor;
    return made;
}

/// A world, and the flight of its aircraft.
class SampleWorld {
public:
    SampleWorld(const settings::RunSettings& settings, octant::World world)
        : settings_(settings), world_(std::move(world)), loaded_(library::loaded_world(world_)),
          formation_(world::formation_of(loaded_.scene, loaded_.flight)) {}

    const settings::RunSettings& settings() const { return settings_; }

    const octant::World& world() const { return world_; }

    /// The time of a sample: any of the path's, after the first interval.
    double time_s(const SampleKey& key) const {
        const sim::Trajectory& path = loaded_.flight.trajectory;
        const double first_s = path.start_s() + settings_.time.start_s + interval_s();
        double last_s = path.end_s();
        if (settings_.time.seconds) { last_s = std::min(last_s, first_s + *settings_.time.seconds); }
        return generator_of(key, "time").between(first_s, std::max(first_s, last_s));
    }

    /// From the previous picture to that of the sample.
    double interval_s() const { return 1.0 / settings_.time.rate_hz; }

    std::vector<sim::AircraftState> states_at(double time_s) const {
        std::vector<sim::AircraftState> states(loaded_.scene.aircraft.size());
        formation_states(loaded_.flight, formation_, loaded_.flight.trajectory.state_at(time_s), time_s, states);
        return states;
    }

    RigGround ground() const {
        return {[this](double x_m, double y_m) { return loaded_.scene.ground->height_at(x_m, y_m); },
            loaded_.scene.ground->half_extent_m()};
    }

private:
    settings::RunSettings settings_;
    octant::World world_;
    const world::World& loaded_;
    world::Formation formation_;
};

octant::Output drawn_outputs(const Dataset& dataset) {
    const Outputs& wanted = dataset.outputs;
    octant::Output outputs{};
    const auto add = [&](bool is_wanted, octant::Output one) { outputs = is_wanted ? outputs | one : outputs; };
    add(wanted.rgb, octant::Output::Rgb);
    add(wanted.depth, octant::Output::Depth);
    add(wanted.class_id, octant::Output::ClassId);
    add(wanted.object_id || (wanted.boxes && dataset.format == Format::Coco), octant::Output::ObjectId);
    add(wanted.normal, octant::Output::Normal);
    add(wanted.flow, octant::Output::Flow);
    add(wanted.coverage, octant::Output::Coverage);
    return outputs;
}

/// Makes samples, one after the other, in a world that it changes as they ask for.
class SampleMaker {
public:
    SampleMaker(const Dataset& dataset, int threads, std::function<void(std::string_view)> on_note)
        : dataset_(dataset), threads_(threads), on_note_(std::move(on_note)) {}

    /// Begins with what another one has loaded.
    void share(const SampleMaker& other) { world_ = other.world_; }

    Sample make(std::uint64_t index) {
        for (int draw = 0;; ++draw) {
            const PlannedSample sample = planned(dataset_, index, draw);
            try {
                set_world(sample);
            } catch (const Error& fault) {
                if (dataset_.varied.empty() || draw + 1 == max_draws) {
                    throw Error(fmt::format("sample {}: {}", index, fault.what()));
                }
                drawn_again_ += draw == 0 ? 1U : 0U;
                continue;
            }
            return made(sample);
        }
    }

    std::uint64_t worlds() const { return worlds_; }

    std::uint64_t drawn_again() const { return drawn_again_; }

private:
    void set_world(const PlannedSample& sample) {
        if (world_ && world_->settings() == sample.settings) { return; }
        world_ = std::make_shared<const SampleWorld>(
            sample.settings, library::make_world(sample.settings, world_ ? &world_->world() : nullptr, on_note_));
        ++worlds_;
    }

    Sample made(const PlannedSample& planned) const {
        const SampleKey key = key_of(dataset_, planned.index, planned.draw);
        Sample sample;
        sample.index = planned.index;
        sample.varied = planned.varied;
        sample.time_s = world_->time_s(key);
        const double interval_s = world_->interval_s();
        const std::vector<sim::AircraftState> now = world_->states_at(sample.time_s);
        const std::vector<sim::AircraftState> before = world_->states_at(sample.time_s - interval_s);
        std::vector<octant::State> states_before;
        for (std::size_t i = 0; i < now.size(); ++i) {
            sample.aircraft.push_back(world_->world().objects().at(i).name);
            sample.states.push_back(state_from(now[i]));
            states_before.push_back(state_from(before[i]));
        }
        octant::RenderOptions options;
        options.threads = threads_;
        options.states = sample.states;
        options.previous_states = states_before;
        options.noise_seed = dataset_.seed;
        for (std::size_t i = 0; i < dataset_.cameras.size(); ++i) {
            const CameraRig& rig = dataset_.cameras[i];
            if (static_cast<std::size_t>(rig.aircraft) > now.size()) {
                throw Error(fmt::format("{}: camera {}: aircraft: expected at most {}, as many as there are, got {}",
                    dataset_.cameras_file.string(), rig.name, now.size(), rig.aircraft));
            }
            SamplePicture picture;
            picture.number = planned.index * dataset_.cameras.size() + i;
            picture.camera = rig.name;
            picture.lens = rig.camera;
            picture.pose = pose_of(rig, key, now, before, interval_s, world_->ground());
            options.first_index = picture.number;
            draw(options, picture);
            sample.pictures.push_back(std::move(picture));
        }
        return sample;
    }

    void draw(const octant::RenderOptions& options, SamplePicture& picture) const {
        const std::span poses(&picture.pose, 1);
        const octant::World& world = world_->world();
        if (const octant::Output outputs = drawn_outputs(dataset_); outputs != octant::Output{}) {
            picture.frames = world.render(picture.lens, poses, outputs, options);
        }
        picture.frames.width = picture.lens.width;
        picture.frames.height = picture.lens.height;
        if (!dataset_.outputs.boxes) { return; }
        const std::vector<std::vector<octant::Box>> boxes = world.boxes(picture.lens, poses, options);
        for (const octant::Box& box : boxes.front()) {
            octant::Object object = world.objects().at(box.object_id - 1);
            object.kind = label_of_kind(object.kind);
            picture.objects.push_back({std::move(object), box});
        }
    }

    const Dataset& dataset_;
    int threads_;
    std::function<void(std::string_view)> on_note_;
    std::shared_ptr<const SampleWorld> world_;
    std::uint64_t worlds_ = 0;
    std::uint64_t drawn_again_ = 0;
};

/// Tells each note once, whichever thread has it.
class Notes {
public:
    explicit Notes(std::function<void(std::string_view)> on_note) : on_note_(std::move(on_note)) {}

    void tell(std::string_view note) {
        const std::scoped_lock lock(mutex_);
        if (told_.emplace(note).second && on_note_) { on_note_(note); }
    }

private:
    std::function<void(std::string_view)> on_note_;
    std::mutex mutex_;
    std::set<std::string, std::less<>> told_;
};

} // namespace

Made make_samples(const Dataset& dataset, const DatasetFolder& folder, std::span<const std::uint64_t> indices,
    const MakingOptions& options) {
    if (indices.empty()) {
        folder.prepare();
        return {};
    }
    const std::vector<Job> jobs = jobs_of(dataset, indices, options.threads);
    const int workers = static_cast<int>(std::min(jobs.size(), static_cast<std::size_t>(options.threads)));
    Notes notes(options.on_note);
    const auto maker = [&] {
        return SampleMaker(
            dataset, std::max(1, options.threads / workers), [&notes](std::string_view note) { notes.tell(note); });
    };
    const auto is_stopped = [&] { return options.is_stopped && options.is_stopped(); };
    // Wrong input shows in the first sample, before there is a folder; the others share what it has loaded.
    SampleMaker first = maker();
    const std::uint64_t first_index = jobs.front().front();
    const Sample first_sample = first.make(first_index);
    folder.prepare();
    std::atomic<std::uint64_t> made = 0;
    std::atomic<std::uint64_t> pictures = 0;
    std::atomic<std::uint64_t> empty_pictures = 0;
    const auto keep = [&](const Sample& sample) {
        folder.write(sample);
        ++made;
        for (const SamplePicture& picture : sample.pictures) {
            const auto is_seen = [](const SampleObject& each) { return each.box.pixels > 0; };
            pictures += dataset.outputs.boxes && !sample.states.empty() ? 1 : 0;
            empty_pictures += std::ranges::none_of(picture.objects, is_seen) ? 1 : 0;
        }
        if (options.on_sample) { options.on_sample(); }
    };
    keep(first_sample);
    std::vector<SampleMaker> makers(static_cast<std::size_t>(workers), maker());
    for (SampleMaker& each : makers) { each.share(first); }
    parallel_for(jobs.size(), workers, [&](std::size_t job, std::size_t thread) {
        for (const std::uint64_t index : jobs[job]) {
            if (is_stopped()) { return; }
            if (index != first_index) { keep(makers[thread].make(index)); }
        }
    });
    Made result;
    result.samples = made;
    result.pictures = pictures;
    result.empty_pictures = std::min<std::uint64_t>(empty_pictures, pictures);
    result.worlds = first.worlds();
    result.drawn_again = first.drawn_again();
    for (const SampleMaker& each : makers) {
        result.worlds += each.worlds();
        result.drawn_again += each.drawn_again();
    }
    result.was_stopped = made < indices.size();
    return result;
}

std::vector<std::uint64_t> indices_of_part(const std::string& text, std::uint64_t count) {
    const std::optional<settings::FlightPart> part = settings::part_from_text(text);
    if (!part) { throw Error(fmt::format("--part: expected K/N, 1/1 to 10000/10000, got {}", in_quotes(text))); }
    const auto share = [&](int parts) {
        return count * static_cast<std::uint64_t>(parts) / static_cast<std::uint64_t>(part->of);
    };
    std::vector<std::uint64_t> indices;
    for (std::uint64_t i = share(part->number - 1); i < share(part->number); ++i) { indices.push_back(i); }
    return indices;
}

std::vector<std::uint64_t> indices_from(const std::string& list, std::uint64_t count) {
    std::set<std::uint64_t> indices;
    for (const std::string_view item : split_fields(list, ',')) {
        const std::size_t dash = item.find('-');
        const auto first = whole_number(item.substr(0, dash));
        const auto last = dash == std::string_view::npos ? first : whole_number(item.substr(dash + 1));
        if (!first || !last || *first < 0 || *last < *first || static_cast<std::uint64_t>(*last) >= count) {
            throw Error(fmt::format("--only: expected numbers of samples from 0 to {}, as 17 or 3,100-199, got {}",
                count - 1, in_quotes(item)));
        }
        for (long i = *first; i <= *last; ++i) { indices.insert(static_cast<std::uint64_t>(i)); }
    }
    return {indices.begin(), indices.end()};
}

} // namespace octant::ui::dataset
