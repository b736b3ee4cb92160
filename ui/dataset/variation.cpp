#include "ui/dataset/variation.h"

#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/text_file.h"
#include "ui/base/data_files.h"
#include "ui/base/spelling.h"
#include "ui/settings/aircraft_entry.h"
#include "ui/settings/setting_rows.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <type_traits>

namespace octant::ui::dataset {

namespace {

/// What a range of a setting consists of.
enum class RangeKind {
    NoRange,
    Number,
    WholeNumber,
    /// Numbers separated by commas.
    Numbers
};

template <class Value>
constexpr RangeKind range_kind(std::string_view name, const Value&) {
    using std::is_same_v;
    if constexpr (is_same_v<Value, double> || is_same_v<Value, std::optional<double>>) { return RangeKind::Number; }
    if constexpr (is_same_v<Value, int> || is_same_v<Value, std::optional<int>>) { return RangeKind::WholeNumber; }
    return name == "place" ? RangeKind::Numbers : RangeKind::NoRange;
}

std::optional<RangeKind> range_kind_of(std::string_view setting) {
    std::optional<RangeKind> kind;
    const settings::RunSettings settings;
    settings::visit_settings(settings, [&](const settings::SettingInfo& info, const auto& value) {
        if (info.name == setting) { kind = range_kind(info.name, value); }
    });
    return kind;
}

[[noreturn]] void refuse(const std::string& expected, std::string_view got) {
    throw Error(fmt::format("--vary: expected {}, got {}", expected, in_quotes(got)));
}

/// The parts of a text between separators, which stay as they are.
std::vector<std::string> parts_of(std::string_view text, char separator) {
    std::vector<std::string> parts;
    for (;;) {
        const std::size_t end = text.find(separator);
        parts.emplace_back(text.substr(0, end));
        if (end == std::string_view::npos) { return parts; }
        text.remove_prefix(end + 1);
    }
}

/// The items "NAME=VALUES": one begins after each comma that a setting's name and = follow.
std::vector<std::string> items_of(std::string_view text) {
    std::vector<std::string> items;
    for (std::string& part : parts_of(text, ',')) {
        const std::size_t equals = part.find('=');
        const bool begins =
            items.empty() ||
            (equals != std::string::npos && part.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == equals);
        if (begins) {
            items.push_back(std::move(part));
        } else {
            items.back() += "," + part;
        }
    }
    return items;
}

std::optional<std::vector<double>> numbers_from(std::string_view text) {
    std::vector<double> numbers;
    for (const std::string& part : parts_of(text, ',')) {
        const std::optional<double> number = finite_number(part);
        if (!number) { return std::nullopt; }
        numbers.push_back(*number);
    }
    return numbers;
}

/// Reads a range into `varied`; false for other text.
bool read_range(std::string_view text, RangeKind kind, VariedSetting& varied) {
    const std::size_t colon = text.find(':');
    if (kind == RangeKind::NoRange || colon == std::string_view::npos) { return false; }
    const auto low = numbers_from(text.substr(0, colon));
    const auto high = numbers_from(text.substr(colon + 1));
    const bool are_whole = kind != RangeKind::WholeNumber || (low && high && std::floor(low->front()) == low->front() &&
                                                                 std::floor(high->front()) == high->front());
    if (!low || !high || low->size() != high->size() || (kind != RangeKind::Numbers && low->size() != 1) ||
        !are_whole) {
        refuse(fmt::format("{} as LOW:HIGH of {}", varied.name,
                   kind == RangeKind::WholeNumber ? "whole numbers"
                   : kind == RangeKind::Numbers   ? "X,Y"
                                                  : "numbers"),
            text);
    }
    for (std::size_t i = 0; i < low->size(); ++i) {
        if ((*low)[i] > (*high)[i]) {
            refuse(fmt::format("{} from a low end to a high one, {}:{}", varied.name, (*high)[i], (*low)[i]), text);
        }
    }
    varied.low = *low;
    varied.high = *high;
    varied.is_whole = kind == RangeKind::WholeNumber;
    return true;
}

std::vector<std::string> words_of_choice(std::string_view name, const std::string& choice) {
    return name == "aircraft" ? parts_of(choice, '+') : std::vector<std::string>{choice};
}

std::string text_of(std::span<const double> numbers, bool is_whole) {
    return is_whole ? fmt::format("{:.0f}", numbers.front()) : fmt::format("{}", fmt::join(numbers, ","));
}

/// Throws Error for words that the setting does not take.
void check_words(std::string_view name, const std::vector<std::string>& words) {
    settings::RunSettings settings;
    try {
        settings::set_by_name(settings, name, words);
        if (name == "aircraft") {
            for (const std::string& word : words) { base::aircraft_file(settings::aircraft_shape(word)); }
        }
    } catch (const Error& fault) { throw Error(fmt::format("--vary: {}", fault.what())); }
}

VariedSetting varied_from(std::string_view item, std::span<const std::string_view> fixed) {
    const std::size_t equals = item.find('=');
    if (equals == std::string_view::npos || equals == 0) { refuse("SETTING=LOW:HIGH or SETTING=VALUE|VALUE", item); }
    VariedSetting varied{.name = std::string(item.substr(0, equals)), .text = std::string(item.substr(equals + 1))};
    const std::optional<RangeKind> kind = range_kind_of(varied.name);
    if (!kind) {
        std::vector<std::string> names;
        settings::visit_rows([&names](const settings::SettingInfo& row) { names.emplace_back(row.name); });
        throw Error(fmt::format("--vary: expected a setting of octant fly, got {}{}", in_quotes(varied.name),
            base::did_you_mean(varied.name, names)));
    }
    if (std::ranges::find(fixed, varied.name) != fixed.end()) {
        refuse("a setting of the world, not of the camera or the run", varied.name);
    }
    if (varied.text.empty()) { refuse(fmt::format("{}=LOW:HIGH or VALUE|VALUE", varied.name), item); }
    if (read_range(varied.text, *kind, varied)) {
        check_words(varied.name, {text_of(varied.low, varied.is_whole)});
        check_words(varied.name, {text_of(varied.high, varied.is_whole)});
        return varied;
    }
    for (const std::string& choice : parts_of(varied.text, '|')) {
        varied.choices.push_back(words_of_choice(varied.name, choice));
        check_words(varied.name, varied.choices.back());
    }
    return varied;
}

/// Mixes the bits of a number: each bit of the result depends on all bits of `word`.
std::uint64_t mixed(std::uint64_t word) {
    word = (word ^ (word >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    word = (word ^ (word >> 27U)) * 0x94d049bb133111ebULL;
    return word ^ (word >> 31U);
}

} // namespace

RandomGenerator generator_of(const SampleKey& key, std::string_view name) {
    Hash hash;
    hash.add_word(mixed(key.seed + 0x9e3779b97f4a7c15ULL));
    hash.add_word(mixed(key.index + 0x9e3779b97f4a7c15ULL));
    hash.add_word(name.size());
    hash.add(std::as_bytes(std::span(name)));
    return RandomGenerator(mixed(hash.value()));
}

std::vector<VariedSetting> parse_variation(std::string_view text, std::span<const std::string_view> fixed) {
    std::vector<VariedSetting> all;
    for (const std::string& item : items_of(text)) {
        VariedSetting varied = varied_from(item, fixed);
        if (std::ranges::find(all, varied.name, &VariedSetting::name) != all.end()) {
            refuse("each setting once", varied.name);
        }
        all.push_back(std::move(varied));
    }
    return all;
}

VariedSetting varied_among(std::string_view name, const std::vector<std::string>& values) {
    VariedSetting varied{.name = std::string(name), .text = fmt::format("{}", fmt::join(values, "|"))};
    for (const std::string& value : values) { varied.choices.push_back(words_of_choice(name, value)); }
    return varied;
}

std::vector<std::string> words_of(const VariedSetting& varied, const SampleKey& key) {
    RandomGenerator random = generator_of(key, varied.name);
    if (!varied.choices.empty()) {
        const auto count = static_cast<double>(varied.choices.size());
        return varied.choices[static_cast<std::size_t>(random.next() * count)];
    }
    std::vector<double> numbers;
    for (std::size_t i = 0; i < varied.low.size(); ++i) {
        numbers.push_back(varied.is_whole ? std::floor(random.between(varied.low[i], varied.high[i] + 1.0))
                                          : random.between(varied.low[i], varied.high[i]));
    }
    return {text_of(numbers, varied.is_whole)};
}

settings::RunSettings settings_of(const settings::RunSettings& base, std::span<const VariedSetting> varied,
    const SampleKey& key, std::vector<std::pair<std::string, std::string>>* values) {
    settings::RunSettings settings = base;
    for (const VariedSetting& each : varied) {
        const std::vector<std::string> words = words_of(each, key);
        settings::set_by_name(settings, each.name, words);
        if (values != nullptr) { values->emplace_back(each.name, fmt::format("{}", fmt::join(words, "+"))); }
    }
    return settings;
}

} // namespace octant::ui::dataset
