#pragma once

#include "ui/settings/settings.h"
#include "ui/settings/settings_text.h"

#include <fmt/format.h>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace octant::ui::commands {

using Words = std::vector<std::string>;

/// How many words follow an option.
enum class Arity {
    None,       ///< a flag: reads "true"; its negation and `=false` read "false"
    One,        ///< one word; the option can be given once
    Optional,   ///< one word or none; none reads as an empty word
    Repeatable, ///< one word; the option can be given several times
    OneOrMore,  ///< one or more words, each time that the option is given
};

/// One row of a command's table: an option, a flag or an argument without dashes.
struct Option {
    /// "--out", a flag's "--vsync,!--no-vsync", an argument's "terrain".
    std::string name = {};
    std::string form = {}; ///< placeholder of the words in help: "METRES"
    std::string meaning = {};
    Arity arity = Arity::One;
    /// Called once with all words of the option, if it is given; options are read in the order of the table. Throws
    /// Error.
    std::function<void(const Words&)> read = {};
    std::string shown_default = {}; ///< in help; empty = none
    bool required = false;
    int words_per_use = 1;           ///< number of words that must be given together
    std::string heading = "Options"; ///< above the option in help; empty = the option is not shown
};

/// The option with this default in help.
Option with_shown_default(std::string shown_default, Option option);

/// The option as a required one.
Option required(Option option);

/// The option left out of help, manual page and completions.
Option hidden(Option option);

/// A flag that sets `value` to true; names that begin with ! set it to false.
Option flag(std::string names, std::string meaning, bool& value);

/// An option that assigns its word to a std::string, a path or an optional of these. A string that is not empty is
/// shown as the default.
template <class Text>
Option text_option(std::string name, std::string form, std::string meaning, Text& value) {
    Option option{.name = std::move(name),
        .form = std::move(form),
        .meaning = std::move(meaning),
        .read = [&value](const Words& words) { value = words.front(); }};
    if constexpr (std::is_same_v<Text, std::string>) { option.shown_default = value; }
    return option;
}

/// An option that assigns its words to `values`; given options replace the defaults.
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

template <class Value>
std::string default_text(const Value& value) {
    return settings::text_of(value);
}

template <class Value>
std::string default_text(const std::optional<Value>& value) {
    return value ? settings::text_of(*value) : "";
}

/// An option that reads its word as a setting of this type, within the bounds of `info`. Its name is that of `info`
/// after `dashes`. Help shows the default unless `info.meaning` ends with one in brackets.
template <class Value>
Option value_option(const settings::FieldInfo& info, Value& value, std::string_view dashes = "--") {
    const std::string name = fmt::format("{}{}", dashes, info.name);
    return {.name = name,
        .form = std::string(info.form),
        .meaning = std::string(info.meaning),
        .read =
            [name, info, &value](const Words& words) {
                settings::FieldInfo named = info;
                named.name = name; // in errors
                settings::read_setting(named, words.front(), value);
            },
        .shown_default = info.meaning.ends_with(']') ? "" : default_text(value)};
}

/// Adds --settings FILE and then one option for every setting, each under the heading of its group. The file is read
/// first, so that the others override it. The path is the argument without dashes. The names of given options are
/// appended to `given` unless it is null.
void add_setting_options(
    std::vector<Option>& options, settings::RunSettings& settings, std::vector<std::string>* given = nullptr);

} // namespace octant::ui::commands
