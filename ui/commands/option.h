#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace octant::ui::commands {

using Words = std::vector<std::string>;

/// How many words follow an option.
enum class Arity {
    None,       ///< a flag: it is read as "true", its negation and `=false` as "false"
    One,        ///< and the option stands once
    Optional,   ///< one word or none; none is read as an empty one
    Repeatable, ///< one word each time that the option stands
    OneOrMore,  ///< one or more words each time
};

/// One row of a command's table: an option, a flag or an argument without dashes.
struct Option {
    /// "--out", a flag's "--vsync,!--no-vsync", an argument's "terrain".
    std::string name = {};
    std::string form = {}; ///< shown in help for its words: "METRES"
    std::string meaning = {};
    Arity arity = Arity::One;
    /// Called once with all words of an option that stands in the command line; options are read in the order of the
    /// table. Throws Error.
    std::function<void(const Words&)> read = {};
    std::string shown_default = {}; ///< in help; empty = none
    bool required = false;
    int words_per_use = 1;           ///< so many words belong together and are given together
    std::string heading = "Options"; ///< above the option in help
};

/// The option with another default in help.
Option with_shown_default(std::string shown_default, Option option);

/// The option as one without which the command refuses to work.
Option required(Option option);

/// A flag that sets `value`; names that begin with ! unset it.
Option flag(std::string names, std::string meaning, bool& value);

/// An option whose word is kept as it is, in a std::string, a path or an optional one of them. A string that is not
/// empty is shown as the default.
template <class Text>
Option text_option(std::string name, std::string form, std::string meaning, Text& value) {
    Option option{.name = std::move(name),
        .form = std::move(form),
        .meaning = std::move(meaning),
        .read = [&value](const Words& words) { value = words.front(); }};
    if constexpr (std::is_same_v<Text, std::string>) { option.shown_default = value; }
    return option;
}

/// The same for several words, which replace what `values` held.
template <class Text>
Option list_option(std::string name, std::string form, std::string meaning, Arity arity, std::vector<Text>& values) {
    return {.name = std::move(name),
        .form = std::move(form),
        .meaning = std::move(meaning),
        .arity = arity,
        .read = [&values](const Words& words) { values.assign(words.begin(), words.end()); }};
}

/// One of several words; `value` is the default.
Option choice_option(
    std::string name, std::string form, std::string meaning, std::vector<std::string_view> choices, std::string& value);

} // namespace octant::ui::commands
