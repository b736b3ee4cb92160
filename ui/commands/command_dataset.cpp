#include "sim/base/error.h"
#include "sim/base/thread_pool.h"
#include "ui/base/json_value.h"
#include "ui/base/progress.h"
#include "ui/base/stop_signals.h"
#include "ui/command_line/setting_option.h"
#include "ui/commands/commands.h"
#include "ui/dataset/dataset.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::commands {

using namespace command_line;

namespace {

/// What a data set is asked for.
struct DatasetOptions : base::OutputOptions {
    settings::RunSettings settings;
    std::vector<std::string> paths;
    std::optional<std::filesystem::path> cameras;
    std::string outputs = "rgb,depth,class,boxes";
    std::optional<std::string> vary;
    int count = 100;
    int seed = 1;
    int per_world = 1;
    std::string format = "coco";
    std::filesystem::path out;
    std::optional<std::string> part;
    std::optional<std::string> only;
    int threads = core_count();
};

/// Settings that have no option here: those of cameras and of one flight, and the path, which has another.
std::vector<std::string_view> settings_without_option() {
    const auto fixed = dataset::fixed_settings();
    std::vector<std::string_view> names(fixed.begin(), fixed.end());
    std::erase(names, "order-cache");
    names.emplace_back("path");
    return names;
}

/// Settings that no sample may vary: besides those, what cameras and times of samples are made of.
std::vector<std::string_view> settings_not_varied() {
    std::vector<std::string_view> names = settings_without_option();
    names.insert(names.end(), {"order-cache", "size", "fov", "samples", "rate", "start", "seconds"});
    return names;
}

dataset::Dataset dataset_of(const DatasetOptions& options) {
    dataset::Dataset set;
    set.settings = options.settings;
    set.format = dataset::format_from(options.format);
    set.outputs = dataset::outputs_from(options.outputs);
    set.count = static_cast<std::uint64_t>(options.count);
    set.seed = static_cast<std::uint64_t>(options.seed);
    set.per_world = static_cast<std::uint64_t>(options.per_world);
    const std::vector<std::string> paths = options.paths.empty() ? std::vector{set.settings.path.name} : options.paths;
    set.varied.push_back(dataset::varied_among("path", paths));
    if (options.vary) {
        const auto varied = dataset::parse_variation(*options.vary, settings_not_varied());
        set.varied.insert(set.varied.end(), varied.begin(), varied.end());
    }
    octant::Camera camera;
    const visuals::scene::ViewSettings& view = set.settings.view;
    camera.width = view.size_px.x;
    camera.height = view.size_px.y;
    camera.fov_deg = view.fov_deg.value_or(camera.fov_deg);
    camera.samples = view.samples.value_or(camera.samples);
    if (options.cameras) {
        set.cameras_file = *options.cameras;
        set.cameras = dataset::read_camera_rigs(*options.cameras, camera, &set.cameras_text);
    } else {
        set.cameras = {dataset::default_rig(camera)};
    }
    return set;
}

std::vector<std::uint64_t> indices_of(const DatasetOptions& options, std::uint64_t count) {
    if (options.part && options.only) { throw Error("--only: expected no --part beside it, got both"); }
    if (options.only) { return dataset::indices_from(*options.only, count); }
    return dataset::indices_of_part(options.part.value_or("1/1"), count);
}

void print_result(const DatasetOptions& options, const dataset::Made& made, std::uint64_t wanted, bool is_whole,
    double seconds, std::size_t cameras) {
    const double per_s = seconds > 0.0 ? static_cast<double>(made.samples) / seconds : 0.0;
    if (options.json) {
        base::print_value(
            {{"folder", base::json_from_file_name(options.out.string())}, {"format", options.format},
                {"samples", options.count}, {"pictures", options.count * static_cast<int>(cameras)},
                {"made", made.samples}, {"done_before", wanted}, {"worlds", made.worlds},
                {"drawn_again", made.drawn_again}, {"whole", is_whole}, {"seconds", seconds}, {"samples_per_s", per_s}},
            true);
        return;
    }
    std::string text = fmt::format(
        "{} samples made in {:.1f} s ({}/s), {} done before\n", made.samples, seconds, base::rate_text(per_s), wanted);
    text += is_whole ? fmt::format("all {} samples are done: {}\n", options.count, (options.out / "README.md").string())
                     : "the data set is not whole yet: the same command without --part and --only makes the rest\n";
    std::fputs(text.c_str(), stdout);
}

void make_dataset(const DatasetOptions& options) {
    const dataset::Dataset set = dataset_of(options);
    const std::vector<std::uint64_t> asked = indices_of(options, set.count);
    const dataset::DatasetFolder folder(options.out, set);
    folder.check();
    std::vector<std::uint64_t> indices;
    for (const std::uint64_t index : asked) {
        if (options.only || !folder.is_finished(index)) { indices.push_back(index); }
    }
    const std::uint64_t done_before = asked.size() - indices.size();
    const base::StopSignals stop_signals;
    base::Progress progress("dataset", static_cast<int>(indices.size()), options.quiet, "samples");
    const auto begin = std::chrono::steady_clock::now();
    const dataset::Made made = dataset::make_samples(set, folder, indices,
        {.threads = options.threads,
            .on_note = [&](std::string_view note) { base::print_note(options.quiet, "note: " + std::string(note)); },
            .on_sample = [&] { progress.tick(); },
            .is_stopped = [] { return base::StopSignals::received(); }});
    progress.finish();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (made.drawn_again > 0) {
        base::print_note(options.quiet, fmt::format("note: drawn again, because no world could be made of the first "
                                                    "values: {} samples",
                                            made.drawn_again));
    }
    if (2 * made.empty_pictures > made.pictures) {
        base::print_note(options.quiet, fmt::format("note: {} of {} pictures show no pixel of an aircraft: --cameras "
                                                    "FILE.toml says where cameras are",
                                            made.empty_pictures, made.pictures));
    }
    const bool is_whole = !made.was_stopped && folder.finish();
    print_result(options, made, done_before, is_whole, seconds, set.cameras.size());
}

std::vector<Option> options_of(DatasetOptions& options) {
    options.settings.view.size_px = {640, 360};
    std::vector<Option> table{
        required(text_option("--out", "DIR", "folder of the data set; one that is there goes on", options.out)),
        with_shown_default("straight",
            list_option("--path", "NAME|FILE", "path script or track; repeatable: each sample flies one of them",
                Arity::Repeatable, options.paths)),
        with_shown_default("one, around the first aircraft",
            text_option(
                "--cameras", "FILE.toml", "cameras, each of which takes a picture of each sample", options.cameras)),
        text_option(
            "--outputs", "NAME,...", "rgb, depth, class, object, normal, flow, coverage, boxes", options.outputs),
        text_option("--vary", "SETTING=VALUES,...",
            "what each sample draws: LOW:HIGH for numbers, A|B|C for anything, A+B for several aircraft", options.vary),
        value_option({"count", "N", "number of samples", 1, 100000000}, options.count),
        value_option({"seed", "N", "sample i depends on this number and i only", 0, 2147483647}, options.seed),
        value_option({"per-world", "N",
                         "samples in a row that share the values drawn by --vary and the path; their times and cameras "
                         "differ. Much quicker where the sun varies",
                         1, 1000000},
            options.per_world),
        choice_option("--format", "FORMAT", "how the data set lies on disk", {"coco", "kitti", "npz"}, options.format),
        text_option("--part", "K/N", "only part K of N of the samples, for several machines", options.part),
        text_option("--only", "I,J-K,...", "only these samples, also where they are there already", options.only),
        threads_option(options.threads)};
    const std::vector<std::string_view> without = settings_without_option();
    add_setting_options(table, options.settings, nullptr, without);
    return with_output_options(options, std::move(table));
}

} // namespace

Command dataset_command() {
    auto options = std::make_shared<DatasetOptions>();
    return {.name = "dataset",
        .summary = "Makes a data set of pictures with ground truth: COCO, KITTI or NPZ",
        .options = options_of(*options),
        .footer =
            "Examples:\n"
            "  octant dataset --path turn --aircraft f15-detailed --count 1000 --out data\n"
            "  octant dataset --vary 'sun-elevation=5:60,palette=temperate|arid' --format npz --out data\n"
            "  octant dataset --cameras ring.toml --outputs rgb,depth,flow --format kitti --out data\n"
            "  octant dataset --count 1000 --out data --only 17\n"
            "  octant dataset --count 1000 --out data --part 2/8\n"
            "Given again, a command makes what is missing; another --count makes a larger set of it. Several "
            "machines that see the folder make a part each, on Slurm by --part $SLURM_ARRAY_TASK_ID/8; the last "
            "one writes README.md, which tells how the data set was made and what its files are.\n"
            "Exit code 2: wrong input, or a folder with another data set. A command that a signal stopped ends by "
            "that signal.",
        .run = [options] { make_dataset(*options); }};
}

} // namespace octant::ui::commands
