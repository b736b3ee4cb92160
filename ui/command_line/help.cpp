#include "ui/command_line/help.h"

#include "sim/base/text_file.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <sys/ioctl.h>
#include <unistd.h>
#include <vector>

namespace octant::ui::command_line {

namespace {

constexpr std::size_t name_column = 26; ///< where meanings begin

/// Characters in a line of help: at least 60, at most 120.
std::size_t help_width() {
    const char* const columns = std::getenv("COLUMNS"); // NOLINT(concurrency-mt-unsafe)
    long width = whole_number(columns == nullptr ? "" : columns).value_or(0);
    winsize size{};
    if (width <= 0 && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0) { width = size.ws_col; }
    return static_cast<std::size_t>(width <= 0 ? 80 : std::clamp(width, 60L, 120L));
}

/// Appends `text`, broken at blanks, to lines that begin at column `indent`. The first line is begun already.
void append_wrapped(std::string& out, std::string_view text, std::size_t indent, std::size_t width) {
    std::size_t column = indent;
    for (const std::string_view word : split_words(text)) {
        if (column > indent && column + 1 + word.size() > width) {
            out += "\n" + std::string(indent, ' ');
            column = indent;
        }
        if (column > indent) { out += ' '; }
        column += word.size() + (column > indent ? 1 : 0);
        out += word;
    }
    out += '\n';
}

/// Appends a name and what it means, in two columns. Each line of `meaning` begins anew.
void append_entry(std::string& out, const std::string& name, std::string_view meaning, std::size_t width) {
    out += "  " + name;
    const bool fits = name.size() + 4 <= name_column;
    out += fits ? std::string(name_column - name.size() - 2, ' ') : "\n" + std::string(name_column, ' ');
    bool is_first = true;
    for (const std::string_view line : split_lines(meaning)) {
        if (!is_first) { out += std::string(name_column, ' '); }
        append_wrapped(out, line, name_column + (is_first ? 0 : 2), width);
        is_first = false;
    }
    if (is_first) { out += '\n'; }
}

/// "--scenery,!--no-scenery" as "--[no-]scenery", "!--no-times" as "--no-times".
std::string shown_name(const Option& option) {
    const std::size_t comma = option.name.find(",!--no-");
    std::string name = comma == std::string::npos ? option.name : "--[no-]" + option.name.substr(2, comma - 2);
    if (name.starts_with('!')) { name.erase(0, 1); }
    return option.form.empty() ? name : fmt::format("{} {}", name, option.form);
}

std::string shown_meaning(const Option& option) {
    std::string meaning = option.meaning;
    if (option.required && option.name.starts_with('-')) { meaning += " (required)"; }
    if (!option.shown_default.empty() && option.shown_default != "false") {
        meaning += fmt::format(" [{}]", option.shown_default);
    }
    return meaning;
}

/// Footer lines that begin with a blank stay as they are; the others are wrapped.
void append_footer(std::string& out, const std::string& footer, std::size_t width) {
    if (footer.empty()) { return; }
    out += '\n';
    for (const std::string_view line : split_lines(footer)) {
        if (line.starts_with(' ')) {
            out += fmt::format("{}\n", line);
        } else {
            append_wrapped(out, line, 0, width);
        }
    }
}

void append_commands(std::string& out, const std::vector<Command>& commands, std::size_t width) {
    if (commands.empty()) { return; }
    out += "\nCommands:\n";
    for (const Command& command : commands) { append_entry(out, command.name, command.summary, width); }
}

std::string usage_of(const Command& command) {
    std::string usage = command.options.empty() ? "" : " [OPTIONS]";
    for (const Option& option : command.options) {
        if (option.name.starts_with('-') || option.name.starts_with('!')) { continue; }
        const std::string name = option.name + (option.arity == Arity::OneOrMore ? "..." : "");
        usage += option.required ? " " + name : fmt::format(" [{}]", name);
    }
    return usage + (command.commands.empty() ? "" : " COMMAND");
}

} // namespace

std::string program_help(const Program& program) {
    const std::size_t width = help_width();
    std::string text;
    append_wrapped(text, program.about, 0, width);
    text += fmt::format("Usage: {} COMMAND [OPTIONS], or --help, --help-all, --version\n", program.name);
    append_commands(text, program.commands, width);
    append_footer(text, program.footer, width);
    return text;
}

std::string command_help(const Command& command, const std::string& before, bool all) {
    const std::size_t width = help_width();
    std::string text;
    append_wrapped(text, command.summary, 0, width);
    text += fmt::format("Usage: {} {}{}\n", before, command.name, usage_of(command));
    std::vector<std::string> headings;
    bool has_more = false;
    for (const Option& option : command.options) {
        const bool is_shown = option.shown == Shown::InHelp || (all && option.shown == Shown::InHelpAll);
        has_more = has_more || option.shown == Shown::InHelpAll;
        if (is_shown && std::ranges::find(headings, option.heading) == headings.end()) {
            headings.push_back(option.heading);
        }
    }
    for (const std::string& heading : headings) {
        text += fmt::format("{}{}:\n", all || heading == headings.front() ? "\n" : "", heading);
        for (const Option& option : command.options) {
            const bool is_shown = option.shown == Shown::InHelp || (all && option.shown == Shown::InHelpAll);
            if (is_shown && option.heading == heading) {
                append_entry(text, shown_name(option), shown_meaning(option), width);
            }
        }
    }
    append_commands(text, command.commands, width);
    append_footer(text, command.footer, width);
    if (has_more && !all) { text += fmt::format("More options: {} {} --help-all\n", before, command.name); }
    return text;
}

} // namespace octant::ui::command_line
