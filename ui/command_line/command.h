#pragma once

#include "ui/base/output_options.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace octant::ui::command_line {

using Words = std::vector<std::string>;

/// How many words follow an option.
enum class Arity {
    None,       ///< a flag: reads "true"; its negation and `=false` read "false"
    One,        ///< one word; the option can be given once
    Optional,   ///< one word or none; none reads as an empty word
    Repeatable, ///< one word; the option can be given several times
    OneOrMore,  ///< one or more words, each time that the option is given
};

/// Which help shows an option. Manual page and completions show all but hidden ones.
enum class Shown {
    InHelp,    ///< --help and --help-all
    InHelpAll, ///< --help-all
    Never,     ///< an old name or an internal option
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
    std::string heading = "Options"; ///< above the option in help
    Shown shown = Shown::InHelp;
    /// Returns a note for the words that were given, for example that the option has a new name; empty = none. Notes
    /// are printed unless --quiet is given.
    std::function<std::string(const Words&)> note = {};
};

/// Exit code of a comparison that cannot tell.
inline constexpr int exit_cannot_tell = 3;

/// Thrown when a check fails after the command has printed its results: no message.
struct CheckFailed {
    int exit_code = 1;
};

/// One command of a program. `run` and the options share what the options read into.
struct Command {
    std::string name;
    std::string summary;
    std::vector<Option> options = {};
    std::string footer = {}; ///< below the options in help: remarks, then examples
    /// Does the work after all options are read. Throws Error for invalid input or environment.
    std::function<void()> run = {};
    std::vector<Command> commands = {}; ///< one of them must follow; then there are no options
    /// Not empty: the first words of the command line that does the work, such as {"octant-study", "bench"}. The words
    /// that follow the command's name are appended. The program is in the folder of this one or in PATH.
    Words program = {};
};

/// A whole program.
struct Program {
    std::string name; ///< "octant"
    std::string about;
    std::string version;
    std::string footer;
    std::vector<Command> commands; ///< in the order of help
};

/// The option with this default in help.
Option with_shown_default(std::string shown_default, Option option);

/// The option as a required one.
Option required(Option option);

/// The table with --json and --quiet at its end.
std::vector<Option> with_output_options(base::OutputOptions& output, std::vector<Option> table);

/// The option left out of help, manual page and completions.
Option hidden(Option option);

/// The option under an old name, which works until version 1.1: hidden, with a note that names the new form.
Option old_name(Option option, std::string new_form);

/// The option shown by --help-all only.
Option advanced(Option option);

/// One key of a family of options.
struct FamilyKey {
    std::string key;
    Option option; ///< as it was before it had a family
};

/// Adds one option `family.name` that reads "KEY=VALUE,..." for several rarely used options; flags are read as "KEY"
/// and "no-KEY". Help lists the keys below family.meaning. The options under their own names are added as old names.
void add_family(std::vector<Option>& table, Option family, std::vector<FamilyKey> keys);

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

} // namespace octant::ui::command_line
