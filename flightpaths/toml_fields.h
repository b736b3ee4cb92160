#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <toml++/toml.h>

namespace octant::flightpaths {

/// Smallest and largest number that a key may have.
struct NumberRange {
    double least = 0.0;
    double most = 0.0;
};

/// The keys of one TOML table, taken one by one; what is left over at the end is refused. The unit of a number is the
/// end of its key: speed_mps and speed_kt are two ways to say one thing. All numbers come back in SI units and radians.
/// Every fault throws Error with the file and the line.
class TomlFields {
public:
    TomlFields(const std::filesystem::path& file, const toml::table& table);

    int line() const { return line_; }

    /// `name` + "_" + one of the units that belong to `base_unit` ("m", "mps", "rad", "s", "g", "mps2", "radps"), or
    /// `name` alone when `base_unit` is empty. Bounds are in the base unit.
    std::optional<double> number(std::string_view name, std::string_view base_unit, NumberRange bounds);
    double required_number(std::string_view name, std::string_view base_unit, NumberRange bounds);
    int required_integer(std::string_view name, int least, int most);
    std::optional<std::string> text(std::string_view name);
    std::string required_text(std::string_view name);
    /// One of the words; their order is the order in which a message lists them.
    std::string required_word(std::string_view name, std::initializer_list<std::string_view> words);
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
