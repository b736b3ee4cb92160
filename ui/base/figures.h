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

/// What a command found, as it is printed for people and for programs: nothing, a truth value, a
/// number, text, a list, or named figures in the order in which they were set. The values of JSON,
/// in a type that costs a file next to nothing to include.
class Figures {
public:
    using List = std::vector<Figures>;
    using Named = std::vector<std::pair<std::string, Figures>>;
    using Value = std::variant<
        std::monostate,
        bool,
        std::int64_t,
        std::uint64_t,
        double,
        std::string,
        List,
        Named>;

    Figures() = default;

    Figures(std::initializer_list<std::pair<std::string, Figures>> named)
        : value_(Named(named)) {}

    template <class Number>

    requires std::is_arithmetic_v<Number> Figures(Number number)
        : value_(stored(number)) {}

    Figures(std::string text)
        : value_(std::move(text)) {}

    Figures(const char* text)
        : value_(std::string(text)) {}

    /// Nothing where there is none.
    template <class Known>
    Figures(const std::optional<Known>& known)
        : Figures(known ? Figures(*known) : Figures()) {}

    Figures(const std::vector<std::string>& lines)
        : value_(List(lines.begin(), lines.end())) {}

    /// A list, also an empty one.
    static Figures list(List members) {
        Figures figures;
        figures.value_ = std::move(members);
        return figures;
    }

    /// The figure of a name. A new name stands last and has nothing yet. Asserts that this is
    /// nothing or named figures.
    Figures& operator[](std::string_view name);

    /// One more member. Asserts that this is nothing or a list.
    void push_back(Figures member);

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

} // namespace octant::ui::base
