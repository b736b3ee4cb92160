#pragma once

#include <cstddef>
#include <cstdint>
#include <octant/octant.h>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::dataset {

/// How a data set lies on disk.
enum class Format {
    Coco,  ///< images/, arrays/ and annotations.json
    Kitti, ///< image_2/, label_2/, calib/, depth/, ...: PNG and text, as KITTI codes them
    Npz    ///< npz/: all arrays of a picture in one file
};

/// What each picture has.
struct Outputs {
    bool rgb = false;
    bool depth = false;
    bool class_id = false;
    bool object_id = false;
    bool normal = false;
    bool flow = false;
    bool coverage = false;
    bool boxes = false;
};

/// An object in a picture.
struct SampleObject {
    octant::Object object;
    octant::Box box;
};

/// A picture of a sample, with its truth.
struct SamplePicture {
    std::uint64_t number = 0; ///< in the data set: sample times cameras plus camera
    std::string camera;
    octant::Camera lens;
    octant::Pose pose;
    octant::Frames frames; ///< one picture; arrays that are not wanted may be there too
    std::vector<SampleObject> objects;
};

/// Everything that a sample shows, at one time.
struct Sample {
    std::uint64_t index = 0;
    /// Names and values of what varies.
    std::vector<std::pair<std::string, std::string>> varied;
    double time_s = 0.0;
    std::vector<std::string> aircraft; ///< the names of World::objects
    std::vector<octant::State> states; ///< of these
    std::vector<SamplePicture> pictures;
};

/// A file of a data set: its name in the data set's folder, and its bytes.
using NamedBytes = std::pair<std::string, std::string>;

/// The name of the file that says that a sample is finished: it is written after all others of its sample.
std::string sample_file_name(std::uint64_t index);

/// The names of all files of a picture, in the order of writing.
std::vector<std::string> picture_file_names(std::uint64_t number, Format format, const Outputs& wanted);

/// The folders in which these files lie.
std::vector<std::string> folders_of(Format format, const Outputs& wanted);

/// All files of a sample. The last one is that of sample_file_name(): JSON with the poses, lenses, objects and file
/// names of its pictures. Same sample, same bytes.
std::vector<NamedBytes> files_of(const Sample& sample, Format format, const Outputs& wanted);

/// COCO's run lengths of the pixels of one object: column by column, the count of other pixels first.
std::vector<std::uint32_t> mask_runs(
    std::span<const std::uint32_t> object_ids, int width, int height, std::uint32_t id);

/// Run lengths as COCO's text "counts".
std::string compressed_runs(std::span<const std::uint32_t> runs);

/// A numpy array as an .npy file. `type` is numpy's name: "<f4", "|u1". `bytes` are its values row by row.
std::string npy_bytes(std::string_view type, std::span<const std::size_t> shape, std::span<const std::byte> bytes);

/// What COCO's annotations.json has of a sample, from the text of its sample file. `first_id`: of its first annotation;
/// raised by their number. Categories are numbered from 1 in the order of `kinds`.
struct CocoParts {
    std::string images;      ///< objects, separated by ",\n"
    std::string annotations; ///< the same; may be empty
};

CocoParts coco_parts(std::string_view sample_file, std::span<const std::string> kinds, std::uint64_t& first_id);

/// The whole annotations.json: all samples' parts, and the categories.
std::string coco_annotations(std::span<const CocoParts> parts, std::span<const std::string> kinds);

} // namespace octant::ui::dataset
