#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <toml++/toml.h>

namespace octant::flightpaths {

/// Smallest and largest number that a key may have.
struct NumberRange {
    double min = 0.0;
    double max = 0.0;
};

/// The keys of one TOML table, read one by one; finish() refuses the keys that were not read. The unit of a number is
/// the end of its key, so that speed_mps and speed_kt are two keys of one value. All numbers are returned in SI units
/// and radians. Every fault throws Error with the file and the line.
class TomlFields {
public:
    TomlFields(const std::filesystem::path& file, const toml::table& table);

    int line() const { return line_; }

    /// `name` + "_" + one of the units that belong to `base_unit` ("m", "mps", "rad", "s", "g", "mps2", "radps"), or
    /// `name` alone when `base_unit` is empty. Bounds are in the base unit.
    std::optional<double> number(std::string_view name, std::string_view base_unit, NumberRange bounds);
    double required_number(std::string_view name, std::string_view base_unit, NumberRange bounds);
    int required_integer(std::string_view name, int min, int max);
    std::optional<std::string> text(std::string_view name);
    std::string required_text(std::string_view name);
    /// The index of one of the words; a message lists them in their order.
    std::size_t required_word(std::string_view name, std::span<const std::string_view> words);
    /// The table under `name`, which must be there.
    const toml::table& required_table(std::string_view name);
    /// The array of tables under `name`, which must be there with at least one table.
    const toml::array& required_tables(std::string_view name);
    /// Throws Error for a key that nothing has asked for.
    void finish() const;

    [[noreturn]] void refuse(int line, const std::string& what) const;

private:
    const toml::node* take(std::string_view key);
    double number_of(const toml::node& node, std::string_view key) const;
    [[noreturn]] void refuse_missing(std::string_view key) const;

    const std::filesystem::path& file_;
    const toml::table& table_;
    int line_ = 1;
    std::set<std::string, std::less<>> requested_keys_;
};

/// The root of a file's TOML `text`. Throws Error with the file and the line for a fault.
toml::table parse_toml(const std::filesystem::path& file, std::string_view text);

/// Line of a node in its file, from 1.
int line_of(const toml::node& node);

} // namespace octant::flightpaths
