#include "ui/command_line/command_line.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "ui/base/data_files.h"
#include "ui/base/progress.h"
#include "ui/base/spelling.h"
#include "ui/base/stop_signals.h"
#include "ui/report/packed_recording.h"
#include "visuals/groundfile/ground_file.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <sys/ioctl.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace octant::ui::command_line {

namespace {

// Help, wrapped to the width of the terminal (COLUMNS, else that of standard output, else 80).

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

/// What the program does, its commands and its footer.
std::string program_help(const Program& program) {
    const std::size_t width = help_width();
    std::string text;
    append_wrapped(text, program.about, 0, width);
    text += fmt::format("Usage: {} COMMAND [OPTIONS], or --help, --help-all, --version\n", program.name);
    append_commands(text, program.commands, width);
    append_footer(text, program.footer, width);
    return text;
}

/// Usage, options under their headings and footer of a command. `before`: the words before its name. `all` adds the
/// options that only --help-all shows.
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

// The command line, read by CLI11.

constexpr int unlimited_words = CLI::detail::expected_max_vector_size;

void count_words(CLI::Option& option, const Option& row) {
    switch (row.arity) {
    case Arity::None:
    case Arity::One:
        break;
    case Arity::Optional:
        option.expected(0, 1);
        break;
    case Arity::Repeatable:
    case Arity::OneOrMore:
        option.type_size(row.words_per_use)->expected(unlimited_words)->allow_extra_args(row.arity == Arity::OneOrMore);
        break;
    }
}

CLI::Option* add_option(CLI::App& app, const Option& row) {
    if (row.arity == Arity::None) { return app.add_flag(row.name); }
    CLI::Option* const option = app.add_option(row.name, CLI::callback_t());
    option->required(row.required);
    count_words(*option, row);
    return option;
}

bool is_truth(std::string_view word) { return word == "true" || word == "false"; }

/// The words given for an option.
Words words_of(const CLI::Option& option, const Option& row) {
    if (row.arity == Arity::None) { return {option.as<bool>() ? "true" : "false"}; }
    return option.reduced_results();
}

/// The parser that the tables of a program make.
class Parser {
public:
    explicit Parser(const Program& program) : program_(program), app_(program.about) {
        app_.set_version_flag("--version", program.version);
        app_.set_help_all_flag("--help-all", ""); // before the commands, which inherit it
        add_commands(app_, program.commands, program.name);
    }

    /// Throws CLI::ParseError where the line is wrong or asks for help.
    void parse(int argument_count, const char* const* arguments) { app_.parse(argument_count, arguments); }

    /// The help of the command that the line names, or of the program. `all` adds rarely used options, and to the help
    /// of the program that of every command.
    std::string help(bool all) const {
        const Parsed* const parsed = named();
        if (parsed != nullptr) { return command_help(*parsed->command, parsed->before, all); }
        std::string text = program_help(program_);
        if (!all) { return text; }
        for (const Parsed& each : parsed_) {
            if (each.command->program.empty()) { text += "\n\n" + command_help(*each.command, each.before, true); }
        }
        return text;
    }

    /// What is wrong with the line, where parse() found `fault`.
    std::string parse_error_text(const CLI::ParseError& fault, const Words& line) const {
        const Parsed* const parsed = named();
        const std::vector<Command>& commands = parsed == nullptr ? program_.commands : parsed->command->commands;
        if (!commands.empty()) {
            const std::string name = parsed == nullptr ? "" : full_name(*parsed) + ": ";
            return name + expected_command_error(commands, first_extra(line));
        }
        if (is(fault, CLI::ExitCodes::ExtrasError)) {
            return fmt::format("{}: {}", full_name(*parsed), unexpected_word_error(*parsed, line));
        }
        if (is(fault, CLI::ExitCodes::RequiredError)) {
            for (std::size_t i = 0; i < parsed->options.size(); ++i) {
                if (parsed->options[i]->get_required() && parsed->options[i]->count() == 0) {
                    return missing_words_error(parsed->command->options[i], {});
                }
            }
        }
        const std::string text = fault.what();
        for (std::size_t i = 0; i < parsed->options.size(); ++i) {
            if (is_about(text, parsed->options[i]->get_name())) {
                return missing_words_error(parsed->command->options[i], parsed->options[i]->results());
            }
        }
        return text;
    }

    /// Options of the command that the line names, read; then what is to be done.
    std::function<void()> chosen_action(const Words& line) const {
        const Parsed& parsed = *named();
        check_flag_values(parsed, line);
        std::vector<std::pair<const Option*, Words>> readings;
        for (std::size_t i = 0; i < parsed.options.size(); ++i) {
            if (parsed.options[i]->count() > 0) {
                const Option& row = parsed.command->options[i];
                readings.emplace_back(&row, words_of(*parsed.options[i], row));
                check_no_empty_words(row, readings.back().second);
            }
        }
        for (const auto& [row, words] : readings) { row->read(words); }
        const bool is_quiet =
            std::ranges::any_of(readings, [](const auto& each) { return each.first->name == "--quiet"; });
        for (const auto& [row, words] : readings) {
            const std::string note = row->note ? row->note(words) : std::string();
            if (!note.empty()) { base::print_note(is_quiet, "note: " + note); }
        }
        return parsed.command->run;
    }

private:
    /// A command and what the library knows of it.
    struct Parsed {
        const Command* command = nullptr;
        CLI::App* app = nullptr;
        std::vector<CLI::Option*> options; ///< as in the command's table
        std::string before;                ///< the words before its name
    };

    void add_commands(CLI::App& app, const std::vector<Command>& commands, const std::string& before) {
        app.require_subcommand(1);
        for (const Command& command : commands) {
            Parsed parsed{&command, app.add_subcommand(command.name), {}, before};
            for (const Option& row : command.options) { parsed.options.push_back(add_option(*parsed.app, row)); }
            parsed_.push_back(parsed);
            if (!command.commands.empty()) { add_commands(*parsed.app, command.commands, before + " " + command.name); }
        }
    }

    /// The innermost command that the line names; null where it names none.
    const Parsed* named() const {
        const CLI::App* app = &app_;
        while (!app->get_subcommands().empty()) { app = app->get_subcommands().front(); }
        const auto found = std::ranges::find(parsed_, app, &Parsed::app);
        return found == parsed_.end() ? nullptr : &*found;
    }

    /// As a person types it after the program's name.
    std::string full_name(const Parsed& parsed) const {
        const std::string before = parsed.before.substr(program_.name.size());
        return before.empty() ? parsed.command->name : fmt::format("{} {}", before.substr(1), parsed.command->name);
    }

    static bool is(const CLI::ParseError& fault, CLI::ExitCodes code) {
        return fault.get_exit_code() == static_cast<int>(code);
    }

    /// Whether a text of the library's is about the option of that name.
    static bool is_about(const std::string& text, const std::string& name) {
        return text.starts_with(name + ":") || text.find(": " + name + " =") != std::string::npos;
    }

    /// The first word of the line that no option or command took; empty where there is none.
    std::string first_extra(const Words& line) const {
        const Words extra = app_.remaining(true);
        const auto found = std::ranges::find_first_of(line, extra);
        return found == line.end() ? std::string() : *found;
    }

    static std::string expected_command_error(const std::vector<Command>& commands, const std::string& got) {
        Words names;
        for (const Command& command : commands) { names.push_back(command.name); }
        return fmt::format("expected a command ({}), got {}{}", fmt::join(names, ", "),
            got.empty() ? "none" : printable(got), base::did_you_mean(got, names));
    }

    std::string unexpected_word_error(const Parsed& parsed, const Words& line) const {
        const std::string got = first_extra(line);
        if (!got.starts_with('-')) { return fmt::format("expected no further argument, got '{}'", printable(got)); }
        Words names{"--help"};
        for (std::size_t i = 0; i < parsed.options.size(); ++i) {
            if (parsed.command->options[i].shown == Shown::Never) { continue; }
            for (const std::string& option : parsed.options[i]->get_lnames()) { names.push_back("--" + option); }
        }
        const std::string name = got.substr(0, got.find('='));
        return fmt::format("expected one of its options, got {}{}", printable(got), base::did_you_mean(name, names));
    }

    /// Throws Error for a flag with another value than true or false, and for a name that unsets a flag with any: what
    /// --no-near-detail=0 should mean nobody can say.
    static void check_flag_values(const Parsed& parsed, const Words& line) {
        for (const std::string& word : line) {
            const std::size_t equals = word.find('=');
            if (!word.starts_with("--") || equals == std::string::npos) { continue; }
            const std::string name = word.substr(0, equals);
            for (std::size_t i = 0; i < parsed.options.size(); ++i) {
                const Option& row = parsed.command->options[i];
                if (row.arity != Arity::None || !parsed.options[i]->check_name(name)) { continue; }
                const std::string value = word.substr(equals + 1);
                if (row.name.find("!" + name) != std::string::npos) {
                    throw Error(fmt::format("{}: expected nothing after it, got {}; {}=true or {}=false is taken", name,
                        printable(value), first_name(row), first_name(row)));
                }
                if (!is_truth(value)) { throw Error(missing_words_error(row, {value})); }
            }
        }
    }

    /// Throws Error for a word of no letters, as a shell gives for a variable that is not set.
    static void check_no_empty_words(const Option& row, const Words& words) {
        const bool may_be_empty = row.arity == Arity::None || row.arity == Arity::Optional;
        if (!may_be_empty && std::ranges::find(words, "") != words.end()) { throw Error(missing_words_error(row, {})); }
    }

    static std::string first_name(const Option& row) { return row.name.substr(0, row.name.find(',')); }

    /// The option's words are too few or too many.
    static std::string missing_words_error(const Option& row, const Words& got) {
        std::string name = first_name(row);
        if (!name.starts_with('-')) {
            std::ranges::transform(
                name, name.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
        }
        const std::string form = row.arity == Arity::None               ? "nothing, =true or =false after it"
                                 : row.form.empty() || row.form == name ? "a word"
                                                                        : row.form;
        return fmt::format("{}: expected {}{}, got {}", name, form,
            row.arity == Arity::One && got.size() > 1 ? " once" : "",
            got.empty() ? "none" : printable(fmt::format("{}", fmt::join(got, " "))));
    }

    const Program& program_;
    CLI::App app_;
    std::vector<Parsed> parsed_; ///< all commands, each before those below it
};

std::function<void()> printing(std::string text) {
    return [text = std::move(text)] { std::fputs(text.c_str(), stdout); };
}

/// The program of that name in the folder of this program, else in PATH; empty if there is none.
std::filesystem::path find_program(const std::string& name) {
    std::error_code ignored;
    std::vector<std::filesystem::path> folders{std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path()};
    const char* const path = std::getenv("PATH"); // NOLINT(concurrency-mt-unsafe)
    for (const std::string_view folder : split_fields(path == nullptr ? "" : path, ':')) {
        folders.emplace_back(folder);
    }
    for (const std::filesystem::path& folder : folders) {
        const std::filesystem::path file = folder / name;
        if (std::filesystem::is_regular_file(file, ignored) && access(file.c_str(), X_OK) == 0) { return file; }
    }
    return {};
}

/// The command line of another program that does the work of this one; nothing where this program does it: of a command
/// with a program, or of any NAME that is no command if there is a program octant-NAME.
std::optional<Words> other_command_line(const Program& program, const Words& line) {
    if (line.empty() || line[0].starts_with('-')) { return std::nullopt; }
    const auto command = std::ranges::find(program.commands, line[0], &Command::name);
    Words words;
    if (command != program.commands.end()) {
        words = command->program;
    } else if (line[0].find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == std::string::npos) {
        const std::string name = fmt::format("{}-{}", program.name, line[0]);
        if (!find_program(name).empty()) { words = {name}; }
    }
    if (words.empty()) { return std::nullopt; }
    words.insert(words.end(), line.begin() + 1, line.end());
    return words;
}

} // namespace

void replace_by_program(Words words) {
    const std::filesystem::path file = find_program(words.front());
    if (file.empty()) {
        throw Error(
            fmt::format("expected the program {} in the folder of this one or in PATH, got none", words.front()));
    }
    words.front() = file.string();
    std::vector<char*> arguments;
    for (std::string& word : words) { arguments.push_back(word.data()); }
    arguments.push_back(nullptr);
    execv(file.c_str(), arguments.data());
    throw Error(fmt::format("{}: cannot be started: {}", file.string(), std::strerror(errno)));
}

std::function<void()> parse_command_line(const Program& program, int argument_count, const char* const* arguments) {
    const Words line(arguments + 1, arguments + argument_count);
    if (auto words = other_command_line(program, line)) {
        return [words = std::move(*words)] { replace_by_program(words); };
    }
    Parser parser(program);
    try {
        parser.parse(argument_count, arguments);
        return parser.chosen_action(line);
    } catch (const CLI::CallForHelp&) { return printing(parser.help(false)); } catch (const CLI::CallForAllHelp&) {
        return printing(parser.help(true));
    } catch (const CLI::CallForVersion& version) {
        return printing(fmt::format("{}\n", version.what()));
    } catch (const CLI::ParseError& fault) { throw Error(parser.parse_error_text(fault, line)); }
}

namespace {

constexpr int exit_check_failed = 1;
constexpr int exit_invalid_input = 2;

int print_error(const std::string& program, const std::string& line) {
    std::fputs(fmt::format("{}: {}\n", program, one_line(line)).c_str(), stderr);
    return exit_invalid_input;
}

/// Does what the command line asks for; the exit code.
int run_command(const Program& program, int argument_count, const char* const* arguments) {
    int code = 0;
    try {
        // Errors are named inside, because aliases of unpacked recordings end with their owners.
        base::with_named_errors([&] { parse_command_line(program, argument_count, arguments)(); });
    } catch (const CheckFailed& check) { code = check.exit_code; } catch (const base::StoppedBySignal&) {
        return code; // exit_by_received_signal() ends the program by the signal
    }
    // Damaged tiles of ground files were drawn without detail: the pictures are not those that were asked for.
    for (const std::string& line : visuals::groundfile::tile_damage_messages()) {
        std::fputs(fmt::format("{}: {}\n", program.name, line).c_str(), stderr);
        code = exit_check_failed;
    }
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
        throw Error(fmt::format("results cannot be written to standard output: {}", std::strerror(errno)));
    }
    return code;
}

} // namespace

int run_program(const char* name, Program (*make_program)(), int argument_count, const char* const* arguments) {
    std::signal(SIGXFSZ, SIG_IGN); // a file that grows too large is a write error, told in one line
    std::signal(SIGCHLD, SIG_DFL); // child programs are waited for
    try {
        const int code = run_command(make_program(), argument_count, arguments);
        base::exit_by_received_signal();
        return code;
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "%s: expected enough memory for this input, got none\n", name); // allocates nothing
        return exit_invalid_input;
    } catch (const std::filesystem::filesystem_error& fault) {
        return print_error(name, fmt::format("{}: {}", fault.path1().string(), fault.code().message()));
    } catch (const std::exception& fault) { return print_error(name, fault.what()); }
}

} // namespace octant::ui::command_line
