#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace octant::ui::base {

/// What a command found, as it is printed for people and for programs: nothing, a truth value, a number, text, a list,
/// or named values in the order in which they were set. The values of JSON, in a type that costs a file next to
/// nothing to include.
class JsonValue {
public:
    using List = std::vector<JsonValue>;
    using JsonMembers = std::vector<std::pair<std::string, JsonValue>>;
    using Value =
        std::variant<std::monostate, bool, std::int64_t, std::uint64_t, double, std::string, List, JsonMembers>;

    JsonValue() = default;

    JsonValue(std::initializer_list<std::pair<std::string, JsonValue>> named) : value_(JsonMembers(named)) {}

    template <class Number>

    requires std::is_arithmetic_v<Number> JsonValue(Number number) : value_(stored(number)) {}

    JsonValue(std::string text) : value_(std::move(text)) {}

    JsonValue(const char* text) : value_(std::string(text)) {}

    /// Nothing where there is none.
    template <class Known>
    JsonValue(const std::optional<Known>& known) : JsonValue(known ? JsonValue(*known) : JsonValue()) {}

    JsonValue(const std::vector<std::string>& lines) : value_(List(lines.begin(), lines.end())) {}

    /// A list, also an empty one.
    static JsonValue list(List members) {
        JsonValue list;
        list.value_ = std::move(members);
        return list;
    }

    /// The value of a name. A new name comes last and has no value yet. Asserts that this is nothing or named values.
    JsonValue& operator[](std::string_view name);

    /// One more member. Asserts that this is nothing or a list.
    void push_back(JsonValue member);

    const Value& value() const { return value_; }

private:
    template <class Number>
    static Value stored(Number number) {
        if constexpr (std::is_same_v<Number, bool>) {
            return number;
        } else if constexpr (std::is_floating_point_v<Number>) {
            return static_cast<double>(number);
        } else if constexpr (std::is_signed_v<Number>) {
            return static_cast<std::int64_t>(number);
        } else {
            return static_cast<std::uint64_t>(number);
        }
    }

    Value value_;
};

/// A value as text in a line; fractions with six digits.
std::string text_of_value(const JsonValue& value);

/// One value a line, names in a column; members of lists on lines of their own.
std::string text_of_results(const JsonValue& results);

/// As JSON with a line end; bytes of file names that are no UTF-8 are replaced.
std::string json_of_results(const JsonValue& results);

/// Writes the values to standard output, as JSON or as text.
void print_value(const JsonValue& results, bool as_json);

/// Encodes a file name for JSON. A name that is not UTF-8, or that begins with "bytes:", becomes "bytes:" followed by
/// the name with its other bytes as %E9. All other names are unchanged.
std::string json_from_file_name(const std::string& name);

/// Decodes json_from_file_name(): the original name, byte for byte.
std::string file_name_from_json(const std::string& text);

} // namespace octant::ui::base
