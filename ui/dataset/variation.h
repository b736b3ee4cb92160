#pragma once

#include "sim/base/random_generator.h"
#include "ui/settings/settings.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::dataset {

/// Which sample of which data set: all that is random in a sample depends on these two numbers and on the name of what
/// is drawn, so that any sample can be made alone.
struct SampleKey {
    std::uint64_t seed = 0;
    std::uint64_t index = 0;
};

/// The generator for one thing of a sample, such as "sun-elevation". Things of other names, samples and seeds have
/// independent numbers.
RandomGenerator generator_of(const SampleKey& key, std::string_view name);

/// A setting of `octant fly` that is drawn anew for each sample: one of several values, all equally likely, or numbers
/// spread evenly over a range.
struct VariedSetting {
    std::string name;
    /// As it was written, "5:60".
    std::string text;
    /// The words of each value; empty for a range.
    std::vector<std::vector<std::string>> choices = {};
    /// The ends of a range: one number, or one for each number of a setting that has several, as place has.
    std::vector<double> low = {};
    std::vector<double> high = {};
    /// A range of whole numbers, both ends among them.
    bool is_whole = false;
};

/// Reads "sun-elevation=5:60,palette=temperate|arid,place=-2000,-2000:2000,2000". Values separated by | are a list,
/// numbers separated by : a range. A + separates the aircraft of one value. Settings named in `fixed` are refused.
/// Throws Error "--vary: expected ..., got ..." for a setting that there is not, or twice, or that does not take one of
/// the values.
std::vector<VariedSetting> parse_variation(std::string_view text, std::span<const std::string_view> fixed);

/// The setting with one of these values each; the only one where there is one.
VariedSetting varied_among(std::string_view name, const std::vector<std::string>& values);

/// The words of the setting's value in a sample.
std::vector<std::string> words_of(const VariedSetting& varied, const SampleKey& key);

/// The settings of a sample, and the names and values of those that vary. Throws Error.
settings::RunSettings settings_of(const settings::RunSettings& base, std::span<const VariedSetting> varied,
    const SampleKey& key, std::vector<std::pair<std::string, std::string>>* values = nullptr);

} // namespace octant::ui::dataset
