#include "ui/commands/command_line.h"

#include "sim/base/error.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string>
#include <utility>
#include <vector>

namespace octant::ui::commands {

namespace {

constexpr int column_width = 34;
constexpr int no_end = CLI::detail::expected_max_vector_size;

void count_words(CLI::Option& option, const Option& row) {
    switch (row.takes) {
    case Takes::Nothing:
    case Takes::OneWord:
        break;
    case Takes::PerhapsOneWord:
        option.expected(0, 1);
        break;
    case Takes::OneWordAgain:
    case Takes::SomeWords:
        option.type_size(row.together)
            ->expected(no_end)
            ->allow_extra_args(row.takes == Takes::SomeWords);
        break;
    }
}

CLI::Option* add_option(CLI::App& app, const Option& row) {
    CLI::Option* option = nullptr;
    if (row.takes == Takes::Nothing) {
        option = app.add_flag(row.name, row.meaning);
    } else {
        option = app.add_option(row.name, CLI::callback_t(), row.meaning);
        option->type_name(row.form)->required(row.required);
        count_words(*option, row);
    }
    return option->default_str(row.shown_default)->group(row.heading);
}

/// The words given for an option.
Words words_of(const CLI::Option& option, const Option& row) {
    if (row.takes == Takes::Nothing) {
        return {option.as<bool>() ? "true" : "false"};
    }
    return option.reduced_results();
}

/// The parser that the tables of a program make.
class Parser {
public:
    explicit Parser(const Program& program)
        : app_(program.about) {
        app_.set_version_flag("--version", program.version);
        app_.get_formatter()->column_width(column_width);
        app_.footer(program.footer);
        add_commands(app_, program.commands, "octant");
        app_.set_help_all_flag("--help-all", "Print the help of all commands and exit");
    }

    /// Throws CLI::ParseError where the line is wrong or asks for help.
    void parse(int argument_count, const char* const* arguments) {
        app_.parse(argument_count, arguments);
    }

    std::string help() const { return with_single_gaps(app_.help()); }

    std::string help_of_all() const {
        std::string text = app_.help();
        for (const Parsed& parsed : parsed_) {
            text += fmt::format("\n\n{}", parsed.app->help(parsed.before));
        }
        return with_single_gaps(text);
    }

    bool names_a_command() const { return !app_.get_subcommands().empty(); }

    /// Options of the command that the line names, read; then what is to be done.
    std::function<void()> action() const {
        const Parsed& parsed = named();
        std::vector<std::pair<const Option*, Words>> readings;
        for (std::size_t i = 0; i < parsed.options.size(); ++i) {
            if (parsed.options[i]->count() > 0) {
                const Option& row = parsed.command->options[i];
                readings.emplace_back(&row, words_of(*parsed.options[i], row));
            }
        }
        for (const auto& [row, words] : readings) {
            row->read(words);
        }
        return parsed.command->run;
    }

private:
    /// The library leaves two lines empty between headings.
    static std::string with_single_gaps(std::string help) {
        return CLI::detail::find_and_replace(std::move(help), "\n\n\n", "\n\n");
    }

    /// A command and what the library knows of it.
    struct Parsed {
        const Command* command = nullptr;
        CLI::App* app = nullptr;
        std::vector<CLI::Option*> options; ///< as in the command's table
        std::string before;                ///< the words before its name
    };

    void
    add_commands(CLI::App& app, const std::vector<Command>& commands, const std::string& before) {
        app.require_subcommand(1);
        for (const Command& command : commands) {
            Parsed parsed{&command, app.add_subcommand(command.name, command.summary), {}, before};
            parsed.app->footer(command.footer);
            for (const Option& row : command.options) {
                parsed.options.push_back(add_option(*parsed.app, row));
            }
            parsed_.push_back(parsed);
            if (!command.commands.empty()) {
                add_commands(*parsed.app, command.commands, before + " " + command.name);
            }
        }
    }

    /// The innermost command that the line names.
    const Parsed& named() const {
        const CLI::App* app = &app_;
        while (!app->get_subcommands().empty()) {
            app = app->get_subcommands().front();
        }
        return *std::ranges::find(parsed_, app, &Parsed::app);
    }

    CLI::App app_;
    std::vector<Parsed> parsed_; ///< all commands, each before those below it
};

std::function<void()> printing(std::string text) {
    return [text = std::move(text)] { std::fputs(text.c_str(), stdout); };
}

} // namespace

std::function<void()>
action_of(const Program& program, int argument_count, const char* const* arguments) {
    Parser parser(program);
    try {
        parser.parse(argument_count, arguments);
        return parser.action();
    } catch (const CLI::CallForHelp&) {
        return printing(parser.help());
    } catch (const CLI::CallForAllHelp&) {
        return printing(parser.help_of_all());
    } catch (const CLI::CallForVersion& version) {
        return printing(fmt::format("{}\n", version.what()));
    } catch (const CLI::ParseError& fault) {
        if (parser.names_a_command()) {
            throw Error(fault.what());
        }
        std::vector<std::string> names;
        for (const Command& command : program.commands) {
            names.push_back(command.name);
        }
        throw Error(fmt::format(
            "expected a command ({}), got {}",
            fmt::join(names, ", "),
            argument_count > 1 ? arguments[1] : "none"));
    }
}

} // namespace octant::ui::commands
