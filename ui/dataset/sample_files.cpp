#include "ui/dataset/sample_files.h"

#include "ui/report/png_file.h"
#include "ui/report/zip_file.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

namespace octant::ui::dataset {

using Json = nlohmann::ordered_json;

std::string sample_file_name(std::uint64_t index) { return fmt::format("samples/{:06}.json", index); }

namespace {

/// One kind of file of a picture: where it lies, and whether it is there.
struct FileKind {
    std::string_view key; ///< in the sample file
    std::string_view folder;
    std::string_view extension;
    bool is_wanted;
};

std::vector<FileKind> file_kinds(Format format, const Outputs& wanted) {
    switch (format) {
    case Format::Coco:
        return {{"image", "images", "png", wanted.rgb}, {"arrays", "arrays", "npz",
                                                            wanted.depth || wanted.class_id || wanted.object_id ||
                                                                wanted.normal || wanted.flow || wanted.coverage}};
    case Format::Kitti:
        return {{"image", "image_2", "png", wanted.rgb}, {"calibration", "calib", "txt", true},
            {"labels", "label_2", "txt", wanted.boxes}, {"depth", "depth", "png", wanted.depth},
            {"class", "semantic", "png", wanted.class_id}, {"object", "instance", "png", wanted.object_id},
            {"normal", "normal", "png", wanted.normal}, {"flow", "flow", "png", wanted.flow},
            {"coverage", "coverage", "png", wanted.coverage}};
    case Format::Npz:
        return {{"arrays", "npz", "npz", true}};
    }
    return {};
}

std::string file_name(const FileKind& kind, std::uint64_t number) {
    return fmt::format("{}/{:06}.{}", kind.folder, number, kind.extension);
}

template <class Value>
std::span<const std::byte> bytes_of(const std::vector<Value>& values) {
    return std::as_bytes(std::span(values));
}

template <class Value>
std::string png(const octant::Frames& frames, int channels, const std::vector<Value>& values) {
    return report::png_bytes({.width_px = frames.width,
        .height_px = frames.height,
        .channels = channels,
        .bytes = bytes_of(values),
        .bits = 8 * static_cast<int>(sizeof(Value))});
}

std::string rgb_png(const octant::Frames& frames) {
    return frames.rgb16.empty() ? png(frames, 3, frames.rgb) : png(frames, 3, frames.rgb16);
}

} // namespace

std::vector<std::string> picture_file_names(std::uint64_t number, Format format, const Outputs& wanted) {
    std::vector<std::string> names;
    for (const FileKind& kind : file_kinds(format, wanted)) {
        if (kind.is_wanted) { names.push_back(file_name(kind, number)); }
    }
    return names;
}

std::vector<std::string> folders_of(Format format, const Outputs& wanted) {
    std::vector<std::string> folders{"samples"};
    for (const FileKind& kind : file_kinds(format, wanted)) {
        if (kind.is_wanted) { folders.emplace_back(kind.folder); }
    }
    return folders;
}

std::vector<std::uint32_t> mask_runs(
    std::span<const std::uint32_t> object_ids, int width, int height, std::uint32_t id) {
    std::vector<std::uint32_t> runs;
    std::uint32_t run = 0;
    bool is_object = false;
    for (int x = 0; x < width; ++x) {
        for (int y = 0; y < height; ++y) {
            const std::size_t pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
            if ((object_ids[pixel] == id) != is_object) {
                runs.push_back(run);
                run = 0;
                is_object = !is_object;
            }
            ++run;
        }
    }
    runs.push_back(run);
    return runs;
}

std::string compressed_runs(std::span<const std::uint32_t> runs) {
    std::string text;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        // From the fourth on, the difference to the run of the same kind before it; five bits a letter, least first.
        std::int64_t left = runs[i];
        if (i > 2) { left -= runs[i - 2]; }
        for (bool more = true; more;) {
            std::int64_t letter = left & 0x1f;
            left >>= 5;
            more = (letter & 0x10) != 0 ? left != -1 : left != 0;
            letter += more ? 0x20 : 0;
            text += static_cast<char>(letter + 48);
        }
    }
    return text;
}

std::string npy_bytes(std::string_view type, std::span<const std::size_t> shape, std::span<const std::byte> bytes) {
    static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");
    std::string sizes;
    for (const std::size_t size : shape) { sizes += fmt::format("{}, ", size); }
    if (shape.size() > 1) { sizes.resize(sizes.size() - 2); }
    if (shape.size() == 1) { sizes.pop_back(); }
    std::string header = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, sizes);
    constexpr std::size_t prefix = 10;
    constexpr std::size_t alignment = 64;
    header.append(alignment - 1 - (prefix + header.size()) % alignment, ' ');
    header += '\n';
    std::string file("\x93NUMPY\x01\x00", 8);
    file += static_cast<char>(header.size() & 0xffU);
    file += static_cast<char>(header.size() >> 8U);
    file += header;
    file.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return file;
}

namespace {

std::array<double, 3> numbers(const octant::Vec3& v) { return {v.x, v.y, v.z}; }

std::array<double, 4> numbers(const octant::Quaternion& q) { return {q.w, q.x, q.y, q.z}; }

/// The arrays of one picture for an .npz file.
class ArrayFile {
public:
    explicit ArrayFile(const octant::Frames& frames)
        : height_(static_cast<std::size_t>(frames.height)), width_(static_cast<std::size_t>(frames.width)) {}

    template <class Value>
    void add_pixels(
        const std::string& name, std::string_view type, std::size_t channels, const std::vector<Value>& values) {
        assert(values.size() == height_ * width_ * channels);
        const std::array shape{height_, width_, channels};
        entries_.push_back(
            {name + ".npy", npy_bytes(type, std::span(shape).first(channels == 1 ? 2 : 3), bytes_of(values))});
    }

    template <class Value>
    void add(const std::string& name, std::string_view type, std::initializer_list<std::size_t> shape,
        const std::vector<Value>& values) {
        entries_.push_back({name + ".npy", npy_bytes(type, std::span(shape), bytes_of(values))});
    }

    std::string bytes() const { return report::zip_bytes(entries_); }

private:
    std::size_t height_;
    std::size_t width_;
    std::vector<report::ZipContent> entries_;
};

void add_truth(const octant::Frames& frames, const Outputs& wanted, ArrayFile& file) {
    if (wanted.depth) { file.add_pixels("depth_m", "<f4", 1, frames.depth_m); }
    if (wanted.class_id) { file.add_pixels("class_id", "|u1", 1, frames.class_id); }
    if (wanted.object_id) { file.add_pixels("object_id", "<u4", 1, frames.object_id); }
    if (wanted.normal) { file.add_pixels("normal", "<f4", 3, frames.normal); }
    if (wanted.flow) { file.add_pixels("flow_px", "<f4", 2, frames.flow_px); }
    if (wanted.coverage) { file.add_pixels("coverage", "<f4", 1, frames.coverage); }
}

template <class Numbers>
void append(std::vector<double>& to, const Numbers& numbers) {
    to.insert(to.end(), std::begin(numbers), std::end(numbers));
}

void add_camera(const SamplePicture& picture, ArrayFile& file) {
    const octant::Intrinsics k = picture.lens.matrix();
    file.add("matrix", "<f8", {3, 3}, std::vector<double>{k.fx, 0.0, k.cx, 0.0, k.fy, k.cy, 0.0, 0.0, 1.0});
    file.add("distortion", "<f8", {picture.lens.coefficients.size()}, picture.lens.coefficients);
    std::vector<double> eye;
    append(eye, numbers(picture.pose.eye_m));
    file.add("eye_m", "<f8", {3}, eye);
    std::vector<double> attitude;
    append(attitude, numbers(picture.pose.attitude));
    file.add("attitude", "<f8", {4}, attitude);
}

void add_boxes(const std::vector<SampleObject>& objects, ArrayFile& file) {
    std::vector<std::uint32_t> ids;
    std::vector<double> visible;
    std::vector<double> whole;
    std::vector<double> corners;
    std::vector<double> measures;
    for (const SampleObject& each : objects) {
        ids.push_back(each.box.object_id);
        append(visible, each.box.visible_px);
        append(whole, each.box.whole_px);
        for (const octant::Vec3& corner : each.box.corners_m) { append(corners, numbers(corner)); }
        append(measures, std::array{each.box.visible_share, each.box.truncation, each.box.distance_m,
                             static_cast<double>(each.box.pixels)});
    }
    const std::size_t count = objects.size();
    file.add("box_object_id", "<u4", {count}, ids);
    file.add("box_visible_px", "<f8", {count, 4}, visible);
    file.add("box_whole_px", "<f8", {count, 4}, whole);
    file.add("box_corners_m", "<f8", {count, 8, 3}, corners);
    file.add("box_measures", "<f8", {count, 4}, measures);
}

std::string npz_of(const SamplePicture& picture, const Outputs& wanted) {
    ArrayFile file(picture.frames);
    if (wanted.rgb && picture.frames.rgb16.empty()) { file.add_pixels("rgb", "|u1", 3, picture.frames.rgb); }
    if (wanted.rgb && !picture.frames.rgb16.empty()) { file.add_pixels("rgb", "<u2", 3, picture.frames.rgb16); }
    add_truth(picture.frames, wanted, file);
    add_camera(picture, file);
    if (wanted.boxes) { add_boxes(picture.objects, file); }
    return file.bytes();
}

std::string arrays_of(const SamplePicture& picture, const Outputs& wanted) {
    ArrayFile file(picture.frames);
    add_truth(picture.frames, wanted, file);
    return file.bytes();
}

// KITTI's codes.

std::uint16_t rounded16(double value) {
    return static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0, 65535.0)));
}

/// Depth in 1/256 m; 0 = unknown: the sky, and what is farther than 16 bits reach.
std::string depth_png(const octant::Frames& frames) {
    std::vector<std::uint16_t> coded;
    for (const float depth_m : frames.depth_m) {
        const double units = std::round(256.0 * static_cast<double>(depth_m));
        coded.push_back(units <= 65535.0 ? rounded16(std::max(units, 1.0)) : std::uint16_t{0});
    }
    return png(frames, 1, coded);
}

/// Flow in 1/64 px with 2^15 added, and whether it is known and in range.
std::string flow_png(const octant::Frames& frames) {
    std::vector<std::uint16_t> coded;
    for (std::size_t i = 0; i < frames.flow_px.size(); i += 2) {
        const double right = std::round(64.0 * static_cast<double>(frames.flow_px[i]) + 32768.0);
        const double down = std::round(64.0 * static_cast<double>(frames.flow_px[i + 1]) + 32768.0);
        const bool is_known = right >= 0.0 && right <= 65535.0 && down >= 0.0 && down <= 65535.0;
        coded.push_back(is_known ? rounded16(right) : std::uint16_t{0});
        coded.push_back(is_known ? rounded16(down) : std::uint16_t{0});
        coded.push_back(is_known ? 1 : 0);
    }
    return png(frames, 3, coded);
}

/// Each component -1 .. 1 as 0 .. 65535.
std::string normal_png(const octant::Frames& frames) {
    std::vector<std::uint16_t> coded;
    for (const float part : frames.normal) { coded.push_back(rounded16((static_cast<double>(part) + 1.0) * 32767.5)); }
    return png(frames, 3, coded);
}

std::string coverage_png(const octant::Frames& frames) {
    std::vector<std::uint16_t> coded;
    for (const float share : frames.coverage) { coded.push_back(rounded16(65535.0 * static_cast<double>(share))); }
    return png(frames, 1, coded);
}

std::string object_png(const octant::Frames& frames) {
    std::vector<std::uint16_t> coded;
    for (const std::uint32_t id : frames.object_id) {
        coded.push_back(static_cast<std::uint16_t>(std::min<std::uint32_t>(id, 65535)));
    }
    return png(frames, 1, coded);
}

std::string calibration(const octant::Camera& lens) {
    const octant::Intrinsics k = lens.matrix();
    std::string text;
    for (int i = 0; i < 4; ++i) {
        text += fmt::format("P{}: {:.12e} 0 {:.12e} 0 0 {:.12e} {:.12e} 0 0 0 1 0\n", i, k.fx, k.cx, k.fy, k.cy);
    }
    text += "R0_rect: 1 0 0 0 1 0 0 0 1\n";
    text += "Tr_velo_to_cam: 1 0 0 0 0 1 0 0 0 0 1 0\nTr_imu_to_velo: 1 0 0 0 0 1 0 0 0 0 1 0\n";
    return text;
}

glm::dvec3 vector(const octant::Vec3& v) { return {v.x, v.y, v.z}; }

glm::dquat rotation(const octant::Quaternion& q) { return glm::normalize(glm::dquat(q.w, q.x, q.y, q.z)); }

/// A world vector in the camera's axes: x right, y down, z ahead.
glm::dvec3 in_camera(const octant::Pose& pose, const glm::dvec3& world) {
    const glm::dvec3 body = glm::conjugate(rotation(pose.attitude)) * world;
    return {body.y, body.z, body.x};
}

/// One line of KITTI's label file: type truncated occluded alpha box dimensions location rotation_y.
std::string label(const SamplePicture& picture, const SampleObject& each) {
    const octant::Box& box = each.box;
    const glm::dvec3 origin = vector(box.corners_m[0]);
    const glm::dvec3 along = vector(box.corners_m[1]) - origin;
    const glm::dvec3 across = vector(box.corners_m[2]) - origin;
    const glm::dvec3 down = vector(box.corners_m[4]) - origin;
    // KITTI's location is the middle of the box's lower side.
    const glm::dvec3 bottom = origin + 0.5 * (along + across) + down;
    const glm::dvec3 location = in_camera(picture.pose, bottom - vector(picture.pose.eye_m));
    const glm::dvec3 ahead = in_camera(picture.pose, along);
    const double rotation_y = std::atan2(-ahead.z, ahead.x);
    double alpha = rotation_y - std::atan2(location.x, location.z);
    alpha = std::remainder(alpha, 2.0 * std::numbers::pi);
    const double seen_inside = box.truncation < 1.0 ? box.visible_share / (1.0 - box.truncation) : 0.0;
    const int occluded = seen_inside > 0.9 ? 0 : seen_inside > 0.5 ? 1 : 2;
    return fmt::format("{} {:.4f} {} {:.6f} {:.2f} {:.2f} {:.2f} {:.2f} {:.4f} {:.4f} {:.4f} {:.4f} {:.4f} {:.4f} "
                       "{:.6f}\n",
        each.object.kind, box.truncation, occluded, alpha, box.visible_px[0], box.visible_px[1],
        box.visible_px[2] - 1.0, box.visible_px[3] - 1.0, glm::length(down), glm::length(across), glm::length(along),
        location.x, location.y, location.z, rotation_y);
}

std::string labels(const SamplePicture& picture) {
    std::string text;
    for (const SampleObject& each : picture.objects) {
        if (each.box.pixels > 0) { text += label(picture, each); }
    }
    return text;
}

std::string bytes_of_file(const FileKind& kind, const SamplePicture& picture, Format format, const Outputs& wanted) {
    const octant::Frames& frames = picture.frames;
    if (kind.key == "image") { return rgb_png(frames); }
    if (kind.key == "arrays") { return format == Format::Npz ? npz_of(picture, wanted) : arrays_of(picture, wanted); }
    if (kind.key == "calibration") { return calibration(picture.lens); }
    if (kind.key == "labels") { return labels(picture); }
    if (kind.key == "depth") { return depth_png(frames); }
    if (kind.key == "class") { return png(frames, 1, frames.class_id); }
    if (kind.key == "object") { return object_png(frames); }
    if (kind.key == "normal") { return normal_png(frames); }
    if (kind.key == "flow") { return flow_png(frames); }
    assert(kind.key == "coverage");
    return coverage_png(frames);
}

// The sample file.

constexpr std::array<std::string_view, 3> distortion_names{"none", "brown-conrady", "fisheye"};

Json json_of(const octant::Camera& lens) {
    const octant::Intrinsics k = lens.matrix();
    return {{"width", lens.width}, {"height", lens.height}, {"matrix", {k.fx, k.fy, k.cx, k.cy}},
        {"distortion", distortion_names.at(static_cast<std::size_t>(lens.distortion))},
        {"coefficients", lens.coefficients}};
}

Json json_of(const SampleObject& each) {
    const octant::Box& box = each.box;
    Json corners = Json::array();
    for (const octant::Vec3& corner : box.corners_m) { corners.push_back(numbers(corner)); }
    return {{"object_id", box.object_id}, {"name", each.object.name}, {"kind", each.object.kind},
        {"visible_px", box.visible_px}, {"whole_px", box.whole_px}, {"corners_m", std::move(corners)},
        {"visible_share", box.visible_share}, {"truncation", box.truncation}, {"distance_m", box.distance_m},
        {"pixels", box.pixels}};
}

Json json_of(const SamplePicture& picture, Format format, const Outputs& wanted) {
    Json json{{"number", picture.number}, {"camera", picture.camera}, {"lens", json_of(picture.lens)},
        {"eye_m", numbers(picture.pose.eye_m)}, {"attitude", numbers(picture.pose.attitude)}};
    if (picture.pose.previous_eye_m && picture.pose.previous_attitude) {
        json["previous_eye_m"] = numbers(*picture.pose.previous_eye_m);
        json["previous_attitude"] = numbers(*picture.pose.previous_attitude);
    }
    Json files = Json::object();
    for (const FileKind& kind : file_kinds(format, wanted)) {
        if (kind.is_wanted) { files[std::string(kind.key)] = file_name(kind, picture.number); }
    }
    json["files"] = std::move(files);
    if (!wanted.boxes) { return json; }
    Json objects = Json::array();
    for (const SampleObject& each : picture.objects) {
        Json object = json_of(each);
        if (format == Format::Coco) {
            const octant::Frames& frames = picture.frames;
            object["mask"] =
                compressed_runs(mask_runs(frames.object_id, frames.width, frames.height, each.box.object_id));
        }
        objects.push_back(std::move(object));
    }
    json["objects"] = std::move(objects);
    return json;
}

Json json_of(const Sample& sample, Format format, const Outputs& wanted) {
    Json json{{"sample", sample.index}, {"time_s", sample.time_s}};
    Json varied = Json::object();
    for (const auto& [name, value] : sample.varied) { varied[name] = value; }
    json["varied"] = std::move(varied);
    Json states = Json::array();
    for (std::size_t i = 0; i < sample.states.size(); ++i) {
        const octant::State& state = sample.states[i];
        states.push_back(
            {{"name", sample.aircraft[i]}, {"is_present", state.is_present}, {"position_m", numbers(state.position_m)},
                {"attitude", numbers(state.attitude)}, {"velocity_mps", numbers(state.velocity_mps)}});
    }
    json["aircraft"] = std::move(states);
    Json pictures = Json::array();
    for (const SamplePicture& picture : sample.pictures) { pictures.push_back(json_of(picture, format, wanted)); }
    json["pictures"] = std::move(pictures);
    return json;
}

} // namespace

std::vector<NamedBytes> files_of(const Sample& sample, Format format, const Outputs& wanted) {
    std::vector<NamedBytes> files;
    for (const SamplePicture& picture : sample.pictures) {
        for (const FileKind& kind : file_kinds(format, wanted)) {
            if (!kind.is_wanted) { continue; }
            files.emplace_back(file_name(kind, picture.number), bytes_of_file(kind, picture, format, wanted));
        }
    }
    files.emplace_back(sample_file_name(sample.index), json_of(sample, format, wanted).dump(1) + "\n");
    return files;
}

CocoParts coco_parts(std::string_view sample_file, std::span<const std::string> kinds, std::uint64_t& first_id) {
    const Json sample = Json::parse(sample_file);
    CocoParts parts;
    const auto add = [](std::string& to, const Json& json) { to += (to.empty() ? "" : ",\n") + json.dump(); };
    for (const Json& picture : sample.at("pictures")) {
        const Json& lens = picture.at("lens");
        Json image{{"id", picture.at("number")}, {"file_name", picture.at("files").value("image", std::string())},
            {"width", lens.at("width")}, {"height", lens.at("height")}, {"sample", sample.at("sample")},
            {"camera", picture.at("camera")}, {"matrix", lens.at("matrix")}, {"distortion", lens.at("distortion")},
            {"coefficients", lens.at("coefficients")}, {"eye_m", picture.at("eye_m")},
            {"attitude", picture.at("attitude")}, {"varied", sample.at("varied")}};
        if (picture.at("files").contains("arrays")) { image["arrays"] = picture.at("files").at("arrays"); }
        add(parts.images, image);
        if (!picture.contains("objects")) { continue; }
        for (const Json& object : picture.at("objects")) {
            if (object.at("pixels").get<int>() == 0) { continue; }
            const auto box = object.at("visible_px").get<std::array<double, 4>>();
            const auto kind = std::ranges::find(kinds, object.at("kind").get<std::string>());
            add(parts.annotations,
                {{"id", first_id++}, {"image_id", picture.at("number")}, {"category_id", kind - kinds.begin() + 1},
                    {"bbox", {box[0], box[1], box[2] - box[0], box[3] - box[1]}}, {"area", object.at("pixels")},
                    {"iscrowd", 0},
                    {"segmentation", {{"size", {lens.at("height"), lens.at("width")}}, {"counts", object.at("mask")}}},
                    {"object_id", object.at("object_id")}, {"name", object.at("name")},
                    {"visible_share", object.at("visible_share")}, {"truncation", object.at("truncation")},
                    {"distance_m", object.at("distance_m")}, {"whole_px", object.at("whole_px")},
                    {"corners_m", object.at("corners_m")}});
        }
    }
    return parts;
}

std::string coco_annotations(std::span<const CocoParts> parts, std::span<const std::string> kinds) {
    std::string images;
    std::string annotations;
    for (const CocoParts& each : parts) {
        images += (images.empty() ? "" : ",\n") + each.images;
        if (!each.annotations.empty()) { annotations += (annotations.empty() ? "" : ",\n") + each.annotations; }
    }
    Json categories = Json::array();
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        categories.push_back({{"id", i + 1}, {"name", kinds[i]}, {"supercategory", "aircraft"}});
    }
    return fmt::format("{{\"info\": {{\"description\": \"made by octant dataset; README.md tells how\"}},\n"
                       "\"images\": [\n{}\n],\n\"annotations\": [\n{}\n],\n\"categories\": {}}}\n",
        images, annotations, categories.dump());
}

} // namespace octant::ui::dataset
