#pragma once

#include "ui/dataset/dataset_folder.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::dataset {

/// How a data set is made. None of it changes a byte of its files.
struct MakingOptions {
    int threads = 1;
    /// Told once about each thing that is guessed, mended or left out; by one thread at a time.
    std::function<void(std::string_view)> on_note;
    /// Called when a sample is finished; by any thread.
    std::function<void()> on_sample;
    /// Asked between samples; true ends the work early.
    std::function<bool()> is_stopped;
};

/// What came of it.
struct Made {
    std::uint64_t samples = 0; ///< made now
    std::uint64_t worlds = 0;  ///< loaded or recoloured for them
    std::uint64_t drawn_again =
        0; ///< samples whose first values made no world, such as a place where the path has none
    /// Of pictures with boxes: how many there are, and how many show no pixel of any aircraft.
    std::uint64_t pictures = 0;
    std::uint64_t empty_pictures = 0;
    bool was_stopped = false;
};

/// Makes these samples in the folder, which is made when the first world has been loaded. Samples of the same world are
/// made one after the other. Throws Error for input of which no world can be made; samples that are finished then stay.
Made make_samples(const Dataset& dataset, const DatasetFolder& folder, std::span<const std::uint64_t> indices,
    const MakingOptions& options);

/// How often the values of a sample are drawn until a world can be made of them.
inline constexpr int max_draws = 20;

/// The samples of part K of N, "2/8", or those of a list, "17", "3,100-199", in ascending order. Throws Error
/// "--part: expected ...", "--only: expected ...".
std::vector<std::uint64_t> indices_of_part(const std::string& part, std::uint64_t count);
std::vector<std::uint64_t> indices_from(const std::string& list, std::uint64_t count);

} // namespace octant::ui::dataset
