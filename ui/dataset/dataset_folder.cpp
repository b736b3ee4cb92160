#include "ui/dataset/dataset_folder.h"

#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "ui/base/json_value.h"
#include "ui/base/version.h"
#include "ui/dataset/contact_sheet.h"
#include "ui/report/run_file.h"
#include "ui/settings/aircraft_entry.h"
#include "ui/settings/setting_rows.h"
#include "ui/settings/settings_file.h"
#include "ui/world/input_files.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

namespace octant::ui::dataset {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr int format_version = 1;
constexpr const char* json_name = "dataset.json";
constexpr const char* card_name = "README.md";
constexpr const char* annotations_name = "annotations.json";
constexpr const char* contact_sheet_name = "contact-sheet.png";

constexpr std::array<std::string_view, 3> format_names{"coco", "kitti", "npz"};

struct OutputName {
    std::string_view name;
    bool Outputs::*member;
    std::string_view meaning; ///< in the card
};

constexpr std::array output_names{OutputName{"rgb", &Outputs::rgb, "red, green, blue"},
    OutputName{"depth", &Outputs::depth, "distance along the optical axis in metres; infinite where the sky is"},
    OutputName{"class", &Outputs::class_id, "what the pixel shows, by the numbers below"},
    OutputName{"object", &Outputs::object_id, "0 = none, n = the n-th aircraft of the sample"},
    OutputName{"normal", &Outputs::normal, "unit normal of the polygon, east, north, up; 0, 0, 0 where the sky is"},
    OutputName{"flow", &Outputs::flow,
        "how far the surface point moved since the previous picture, 1 / rate s before; pixels right and down, NaN "
        "unknown"},
    OutputName{"coverage", &Outputs::coverage, "share of the pixel that its object fills"},
    OutputName{"boxes", &Outputs::boxes,
        "of each aircraft: box of its visible pixels and of the whole, 3D corners, "
        "visible share, truncation, distance"}};

constexpr std::array<std::string_view, 24> settings_of_cameras_and_runs{"view", "eye", "look", "azimuth", "elevation",
    "zoom", "inset", "head-up-display", "path-ribbon", "renderer", "raster-threads", "context", "frame-per-sample",
    "part", "frames", "warm-up", "realtime", "pictures", "adapt", "mesh-ahead", "order-cache", "order-seconds",
    "show-mesh", "show-model"};

} // namespace

std::span<const std::string_view> fixed_settings() { return settings_of_cameras_and_runs; }

std::string_view name_of(Format format) { return format_names.at(static_cast<std::size_t>(format)); }

std::vector<std::string> names_of(const Outputs& outputs) {
    std::vector<std::string> names;
    for (const OutputName& each : output_names) {
        if (outputs.*each.member) { names.emplace_back(each.name); }
    }
    return names;
}

Format format_from(const std::string& text) {
    const auto found = std::ranges::find(format_names, text);
    if (found == format_names.end()) {
        throw Error(fmt::format("--format: expected {}, got {}", fmt::join(format_names, ", "), in_quotes(text)));
    }
    return static_cast<Format>(found - format_names.begin());
}

Outputs outputs_from(const std::string& text) {
    Outputs outputs;
    for (const std::string_view word : split_fields(text, ',')) {
        const auto found = std::ranges::find(output_names, word, &OutputName::name);
        if (found == output_names.end()) {
            std::vector<std::string_view> names;
            for (const OutputName& each : output_names) { names.push_back(each.name); }
            throw Error(fmt::format("--outputs: expected {}, got {}", fmt::join(names, ", "), in_quotes(word)));
        }
        outputs.*found->member = true;
    }
    return outputs;
}

std::string label_of_kind(const std::string& kind) {
    std::string label = fs::path(kind).stem().string();
    std::ranges::replace_if(
        label, [](unsigned char letter) { return letter <= ' ' || letter == 0x7f; }, '_');
    return label.empty() ? "aircraft" : label;
}

namespace {

std::string text_of(const Json& json) {
    return json.is_string() ? json.get<std::string>()
                            : json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

/// Where two data sets differ first: "seed 3, got 4"; nothing where they do not.
std::optional<std::string> difference(const Json& before, const Json& now, const std::string& name) {
    if (before == now) { return std::nullopt; }
    if (before.is_object() && now.is_object()) {
        for (const auto& [key, value] : now.items()) {
            const std::string inner = name.empty() ? key : name + "." + key;
            if (auto found = difference(before.contains(key) ? before.at(key) : Json(), value, inner)) { return found; }
        }
        for (const auto& [key, value] : before.items()) {
            if (!now.contains(key)) { return fmt::format("{} {}, got none", key, printable(text_of(value))); }
        }
    }
    return fmt::format("{} {}, got {}", name, printable(text_of(before)), printable(text_of(now)));
}

/// The settings of all samples without those that decide nothing.
Json settings_of(const Dataset& dataset) {
    Json settings = settings::settings_json(dataset.settings);
    for (const std::string_view name : fixed_settings()) { settings.erase(std::string(name)); }
    for (const VariedSetting& each : dataset.varied) { settings.erase(each.name); }
    return settings;
}

/// Names and hashes of all files that any sample may read.
Json input_hashes(const Dataset& dataset) {
    std::vector<settings::RunSettings> all;
    for (const VariedSetting& varied : dataset.varied) {
        for (const std::vector<std::string>& words : varied.choices) {
            settings::RunSettings settings = dataset.settings;
            for (const VariedSetting& other : dataset.varied) { // which the base settings may not have
                if (!other.choices.empty()) { settings::set_by_name(settings, other.name, other.choices.front()); }
            }
            settings::set_by_name(settings, varied.name, words);
            all.push_back(std::move(settings));
        }
    }
    if (all.empty()) { all.push_back(dataset.settings); }
    Json hashes = Json::object();
    for (const world::InputFile& input : world::input_files(all)) {
        hashes[base::json_from_file_name(input.name)] = world::hash_of_file(input.file);
    }
    return hashes;
}

Json lens_of(const CameraRig& rig) {
    return {{"name", rig.name}, {"size", fmt::format("{}x{}", rig.camera.width, rig.camera.height)}};
}

} // namespace

namespace {

/// write_file(), once more where it fails: another program that finishes the same data set removes temporary files.
void write_in_turn(const fs::path& file, std::string_view bytes) {
    try {
        write_file(file, bytes);
    } catch (const Error&) { write_file(file, bytes); }
}

} // namespace

DatasetFolder::DatasetFolder(fs::path folder, const Dataset& dataset) : folder_(std::move(folder)), dataset_(dataset) {}

std::string DatasetFolder::dataset_json() const {
    Json json{{"format_version", format_version}, {"version", base::program_version()},
        {"commit", base::program_commit()}, {"count", dataset_.count}, {"seed", dataset_.seed},
        {"per_world", dataset_.per_world}, {"format", name_of(dataset_.format)},
        {"outputs", names_of(dataset_.outputs)}};
    Json vary = Json::object();
    for (const VariedSetting& each : dataset_.varied) { vary[each.name] = each.text; }
    json["vary"] = std::move(vary);
    Json cameras = Json::array();
    for (const CameraRig& rig : dataset_.cameras) { cameras.push_back(lens_of(rig)); }
    json["cameras"] = std::move(cameras);
    json["cameras_file"] = dataset_.cameras_text;
    json["settings"] = settings_of(dataset_);
    json["inputs"] = input_hashes(dataset_);
    Json classes = Json::array();
    for (std::size_t i = 0; i < octant::surface_class_count; ++i) {
        classes.push_back(octant::name_of(static_cast<octant::SurfaceClass>(i)));
    }
    json["classes"] = std::move(classes);
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void DatasetFolder::check() const {
    if (!path_exists(folder_)) {
        fs::path above = absolute_path(folder_).parent_path();
        while (!path_exists(above) && above.has_relative_path()) { above = above.parent_path(); }
        if (!is_folder(above)) { throw_error_in(above, "expected a folder, got a file"); }
        check_can_write(above / json_name);
        return;
    }
    if (!is_folder(folder_)) { throw_error_in(folder_, "expected a folder, got a file"); }
    const fs::path file = folder_ / json_name;
    if (!path_exists(file)) {
        std::error_code fault;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder_, fault)) {
            if (!is_unfinished(entry.path())) {
                throw_error_in(folder_, "expected an empty folder or that of a data set, got another");
            }
        }
        check_can_write(file);
        return;
    }
    Json before = report::parsed_json(file, read_text_file(file));
    if (!before.is_object() || !before.contains("format_version") || !before.contains("vary")) {
        throw_error_at(file, 1, "expected a data set's description, got another file");
    }
    report::check_format_version(file, before);
    Json now = Json::parse(dataset_json());
    if (before.contains("count") && before.at("count").is_number_unsigned() &&
        before.at("count").get<std::uint64_t>() <= dataset_.count) {
        before["count"] = dataset_.count;
    }
    if (const auto differs = difference(before, now, "")) {
        throw_error_in(file, fmt::format("expected the data set that was begun here, with {}", *differs));
    }
    check_can_write(file);
}

void DatasetFolder::prepare() const {
    check();
    make_folder(folder_);
    write_in_turn(folder_ / json_name, dataset_json());
    for (const std::string& name : folders_of(dataset_.format, dataset_.outputs)) { make_folder(folder_ / name); }
}

bool DatasetFolder::is_finished(std::uint64_t sample) const {
    if (!path_exists(folder_ / sample_file_name(sample))) { return false; }
    const std::size_t cameras = dataset_.cameras.size();
    for (std::size_t i = 0; i < cameras; ++i) {
        for (const std::string& name : picture_file_names(sample * cameras + i, dataset_.format, dataset_.outputs)) {
            if (!path_exists(folder_ / name)) { return false; }
        }
    }
    return true;
}

void DatasetFolder::write(const Sample& sample) const {
    for (const auto& [name, bytes] : files_of(sample, dataset_.format, dataset_.outputs)) {
        write_in_turn(folder_ / name, bytes);
    }
}

bool DatasetFolder::finish() const {
    for (std::uint64_t i = 0; i < dataset_.count; ++i) {
        if (!is_finished(i)) { return false; }
    }
    std::uint64_t objects = 0;
    std::vector<std::string> kinds;
    const auto each_sample = [&](const auto& work) {
        for (std::uint64_t i = 0; i < dataset_.count; ++i) { work(read_text_file(folder_ / sample_file_name(i))); }
    };
    std::set<std::string> found;
    each_sample([&](const std::string& text) {
        const Json sample = Json::parse(text);
        for (const Json& picture : sample.at("pictures")) {
            if (!picture.contains("objects")) { continue; }
            for (const Json& object : picture.at("objects")) {
                found.insert(object.at("kind").get<std::string>());
                objects += object.at("pixels").get<int>() > 0 ? 1U : 0U;
            }
        }
    });
    kinds.assign(found.begin(), found.end());
    if (dataset_.format == Format::Coco) {
        std::vector<CocoParts> parts;
        std::uint64_t next_id = 1;
        each_sample([&](const std::string& text) { parts.push_back(coco_parts(text, kinds, next_id)); });
        write_in_turn(folder_ / annotations_name, coco_annotations(parts, kinds));
    }
    write_contact_sheet();
    write_in_turn(folder_ / card_name, card(dataset_.count * dataset_.cameras.size(), objects));
    std::vector<std::string> folders = folders_of(dataset_.format, dataset_.outputs);
    folders.emplace_back(".");
    for (const std::string& name : folders) {
        std::error_code fault;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / name, fault)) {
            if (is_unfinished(entry.path())) { fs::remove(entry.path(), fault); }
        }
    }
    return true;
}

void DatasetFolder::write_contact_sheet() const {
    if (!dataset_.outputs.rgb) { return; }
    std::vector<fs::path> files;
    const std::uint64_t pictures = dataset_.count * dataset_.cameras.size();
    for (std::uint64_t i = 0; i < std::min<std::uint64_t>(pictures, contact_sheet_pictures); ++i) {
        files.push_back(folder_ / picture_file_names(i, dataset_.format, dataset_.outputs).front());
    }
    write_in_turn(folder_ / contact_sheet_name, contact_sheet_png(files));
}

namespace {

/// The command that makes a data set, without its folder and machines.
std::string command_of(const Dataset& dataset) {
    std::string command = "octant dataset";
    const auto add = [&](std::string_view option, std::string_view value) {
        const bool is_plain = value.find_first_of(" '\"|$&;<>()*?[]{}\\`#~!") == std::string_view::npos;
        command += fmt::format(
            " --{} {}", option, is_plain && !value.empty() ? std::string(value) : fmt::format("'{}'", value));
    };
    std::string vary;
    for (const VariedSetting& each : dataset.varied) {
        if (each.name == "path") {
            for (const std::vector<std::string>& path : each.choices) { add("path", path.front()); }
        } else {
            vary += fmt::format("{}{}={}", vary.empty() ? "" : ",", each.name, each.text);
        }
    }
    const settings::RunSettings defaults;
    const Json plain = settings::settings_json(defaults);
    const Json given = settings_of(dataset);
    for (const auto& [name, value] : given.items()) {
        if (value == plain.at(name) || value.is_null()) { continue; }
        if (value.is_array()) {
            for (const Json& each : value) { add(name, text_of(each)); }
        } else if (value.is_boolean()) {
            command += fmt::format(" --{}{}", value.get<bool>() ? "" : "no-", name);
        } else {
            add(name, text_of(value));
        }
    }
    if (!dataset.cameras_text.empty()) { add("cameras", dataset.cameras_file.string()); }
    add("outputs", fmt::format("{}", fmt::join(names_of(dataset.outputs), ",")));
    if (!vary.empty()) { add("vary", vary); }
    if (dataset.per_world > 1) { command += fmt::format(" --per-world {}", dataset.per_world); }
    return command +
           fmt::format(" --count {} --seed {} --format {}", dataset.count, dataset.seed, name_of(dataset.format));
}

constexpr std::string_view coco_files =
    "- `annotations.json`: images, annotations and categories as COCO has them; `segmentation` is COCO's compressed "
    "run "
    "lengths of the visible pixels, `bbox` left, top, width, height. Further fields of images: `sample`, `camera`, "
    "`matrix` (fx, fy, cx, cy), `eye_m`, `attitude`; of annotations: `visible_share`, `truncation`, `distance_m`, "
    "`whole_px`, `corners_m`. Objects without a visible pixel have no annotation.\n"
    "- `images/N.png`: the pictures. `arrays/N.npz`: the other outputs as numpy arrays.\n";
constexpr std::string_view kitti_files =
    "- `image_2/N.png`; `calib/N.txt` (P2 is the camera's matrix, the other rows are those of a camera alone); "
    "`label_2/N.txt`: type, truncated, occluded (0: more than 0.9 of what is inside the picture is visible, 1: more "
    "than half, 2: less), alpha, box, height, width, length, middle of the lower side in camera axes, rotation_y. "
    "Banked "
    "and pitched aircraft need the corners of the sample files instead of rotation_y.\n"
    "- `depth/N.png`: 16 bits, 1/256 m; 0 = unknown: the sky, and all beyond 255.99 m. `flow/N.png`: 16 bits, "
    "(value - 32768) / 64 px; third channel 1 = known. `normal/N.png`: 16 bits, value / 32767.5 - 1. `coverage/N.png`: "
    "16 bits, value / 65535. `semantic/N.png`: class, 8 bits. `instance/N.png`: object, 16 bits.\n";
constexpr std::string_view npz_files =
    "- `npz/N.npz`: all arrays of a picture by their names (`rgb`, `depth_m`, `class_id`, `object_id`, `normal`, "
    "`flow_px`, `coverage`), the camera (`matrix`, `distortion`, `eye_m`, `attitude`), and boxes, one row an object: "
    "`box_object_id`, `box_visible_px`, `box_whole_px`, `box_corners_m`, `box_measures` (visible share, truncation, "
    "distance in metres, visible pixels).\n";

} // namespace

std::string DatasetFolder::card(std::uint64_t pictures, std::uint64_t objects) const {
    std::string text = fmt::format("# A data set of {} pictures\n", pictures);
    text +=
        fmt::format("Made by Octant {} ({}): {} samples, each seen by {} camera{}, drawn by the processor with their "
                    "ground truth. Sample i depends only on the seed and i.\n```\n{}\n```\n",
            base::program_version(), base::program_commit(), dataset_.count, dataset_.cameras.size(),
            dataset_.cameras.size() == 1 ? "" : "s", command_of(dataset_));
    if (dataset_.outputs.rgb) { text += fmt::format("![the first pictures]({})\n", contact_sheet_name); }
    if (dataset_.outputs.boxes) {
        text += fmt::format("\nObjects with visible pixels, in all pictures: {}.\n", objects);
    }
    text += "\n## What varies\n| setting | values |\n|---|---|\n";
    for (const VariedSetting& each : dataset_.varied) {
        std::string values = each.text;
        for (std::size_t at = 0; (at = values.find('|', at)) != std::string::npos; at += 2) {
            values.replace(at, 1, "\\|");
        }
        text += fmt::format("| {} | {} |\n", each.name, values);
    }
    text += "| time on the path | all, evenly |\n\n## Cameras\n";
    for (const CameraRig& rig : dataset_.cameras) {
        text += fmt::format("- {}: {} x {} pixels\n", rig.name, rig.camera.width, rig.camera.height);
    }
    if (!dataset_.cameras_text.empty()) { text += fmt::format("```toml\n{}```\n", dataset_.cameras_text); }
    text += fmt::format("\n## Files\nPicture number N = sample x {} + camera, from 0.\n", dataset_.cameras.size());
    text += dataset_.format == Format::Coco ? coco_files : dataset_.format == Format::Kitti ? kitti_files : npz_files;
    text += "- `samples/I.json`: of sample I the values drawn, the aircraft's states, and of each picture lens, pose, "
            "objects and files. `dataset.json`: all settings, and hashes of the files that were read.\n\n## Outputs\n";
    for (const OutputName& each : output_names) {
        if (dataset_.outputs.*each.member) { text += fmt::format("- {}: {}\n", each.name, each.meaning); }
    }
    text +=
        "\nDiscs of fast rotors are in the pictures but not in boxes, masks and areas; `--no-effects` draws blades, "
        "which are.\n\nClasses:";
    for (std::size_t i = 0; i < octant::surface_class_count; ++i) {
        text += fmt::format("{} {} = {}", i == 0 ? "" : ",", i, octant::name_of(static_cast<octant::SurfaceClass>(i)));
    }
    text +=
        ".\n\nAxes: world x east, y north, z up, metres from the middle of the map; aircraft and cameras x forward, y "
        "right, z down. `attitude` is a quaternion w, x, y, z that turns body axes into world axes; a camera looks "
        "along its x axis. Corner i of a box has bit 0 = x, bit 1 = y, bit 2 = z of body axes. For a matrix "
        "the middle of the upper left pixel is at 0, 0; boxes count from its corner, their right and lower ends are "
        "exclusive, but in KITTI's labels.\n";
    return text;
}

} // namespace octant::ui::dataset
