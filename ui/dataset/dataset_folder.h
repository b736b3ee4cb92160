#pragma once

#include "ui/dataset/camera_rigs.h"
#include "ui/dataset/sample_files.h"
#include "ui/dataset/variation.h"
#include "ui/settings/settings.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace octant::ui::dataset {

/// What a data set consists of. All of it decides the bytes of its files.
struct Dataset {
    settings::RunSettings settings;     ///< of all samples, but for what varies
    std::vector<VariedSetting> varied;  ///< the path among it
    std::vector<CameraRig> cameras;     ///< at least one; each takes a picture of each sample
    std::string cameras_text;           ///< the file that they were read from; empty without one
    std::filesystem::path cameras_file; ///< its name
    Outputs outputs;
    Format format = Format::Coco;
    std::uint64_t count = 0; ///< samples
    std::uint64_t seed = 0;
    /// Samples in a row with the same values of what varies; their times and cameras differ.
    std::uint64_t per_world = 1;
};

/// The settings that one can vary in no data set, because they are those of a camera or of one flight.
std::span<const std::string_view> fixed_settings();

/// The name of a format, of an output.
std::string_view name_of(Format format);
std::vector<std::string> names_of(const Outputs& outputs);

/// Reads "coco"; reads "rgb,depth,class,boxes". Both throw Error "--format: expected ...".
Format format_from(const std::string& text);
Outputs outputs_from(const std::string& text);

/// A word for a kind of aircraft, for labels and categories: "f15", of a file its name without folder and extension.
std::string label_of_kind(const std::string& kind);

/// The folder of a data set on disk:
///   dataset.json      what it consists of, and which program made it
///   samples/N.json    a sample that is finished: poses, lenses, objects, file names
///   images/ ...       the pictures' files (sample_files.h)
///   annotations.json, contact-sheet.png, README.md   written when all samples are finished
/// Several programs may write different samples, or the same, at once.
class DatasetFolder {
public:
    DatasetFolder(std::filesystem::path folder, const Dataset& dataset);

    const std::filesystem::path& path() const { return folder_; }

    /// Throws Error, and writes nothing, if the folder cannot be written, has anything else in it than a data set, or
    /// one that consists of something else; the message names the first difference. A data set may grow: `count` may be
    /// greater than before.
    void check() const;

    /// check(), then makes the folders and dataset.json.
    void prepare() const;

    bool is_finished(std::uint64_t sample) const;

    /// Writes a sample's files, the one that finishes it last. Throws Error.
    void write(const Sample& sample) const;

    /// If all samples are finished: writes the files that need all of them, removes temporary files that killed
    /// programs left, and returns true.
    bool finish() const;

private:
    std::string dataset_json() const;
    std::string card(std::uint64_t pictures, std::uint64_t objects) const;
    void write_contact_sheet() const;

    std::filesystem::path folder_;
    const Dataset& dataset_;
};

} // namespace octant::ui::dataset
