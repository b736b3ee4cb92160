#include "ui/command_line/manual.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace octant::ui::command_line {

namespace {

/// Text of a line fit for man's macros.
std::string in_roff(std::string_view text) {
    std::string safe;
    for (const char letter : text) {
        switch (letter) {
        case '\\':
            safe += "\\e";
            break;
        case '-':
            safe += "\\-";
            break;
        default:
            safe += letter;
        }
    }
    const bool looks_like_request = safe.starts_with('.') || safe.starts_with('\'');
    return looks_like_request ? "\\&" + safe : safe;
}

void add_options(const Command& command, std::string& page) {
    std::string heading;
    for (const Option& option : command.options) {
        if (option.shown == Shown::Never) { continue; }
        if (option.heading != heading) {
            heading = option.heading;
            page += fmt::format(".PP\n.I {}\n", in_roff(heading));
        }
        page += fmt::format(".TP\n.B {}", in_roff(option.name));
        page += option.form.empty() ? "\n" : fmt::format(" {}\n", in_roff(option.form));
        std::string_view separator;
        for (const std::string_view line : split_lines(option.meaning)) {
            page += fmt::format("{}{}", std::exchange(separator, "\n.br\n"), in_roff(line));
        }
        page += option.shown_default.empty() ? "\n" : fmt::format(" [{}]\n", in_roff(option.shown_default));
    }
}

/// Lines that stay as they are.
void add_lines(std::string_view text, std::string& page) {
    if (text.empty()) { return; }
    page += ".PP\n.nf\n";
    for (const std::string_view line : split_lines(text)) { page += in_roff(line) + "\n"; }
    page += ".fi\n";
}

void add_command(const Command& command, const std::string& before, std::string& page) {
    const std::string name = before + " " + command.name;
    page += fmt::format(".SS \"{}\"\n{}.\n", in_roff(name), in_roff(command.summary));
    add_options(command, page);
    add_lines(command.footer, page);
    for (const Command& each : command.commands) { add_command(each, name, page); }
}

/// "--vsync,!--no-vsync" as words.
std::string option_words(const Option& option) {
    std::string words;
    for (std::string_view name : split_fields(option.name, ',')) {
        name.remove_prefix(name.starts_with('!') ? 1 : 0);
        if (name.starts_with('-')) { words += " " + std::string(name); }
    }
    return words;
}

/// A case of the script for each command: its options and the commands below it.
void add_case(const Command& command, const std::string& before, std::string& text) {
    const std::string name = before.empty() ? command.name : before + " " + command.name;
    std::string words = "--help";
    for (const Option& option : command.options) { words += option.shown == Shown::Never ? "" : option_words(option); }
    for (const Command& each : command.commands) { words += " " + each.name; }
    text += fmt::format("    '{}') words=\"{}\" ;;\n", name, words);
    for (const Command& each : command.commands) { add_case(each, name, text); }
}

/// The program's manual as a page of section 1 in man's macros: every command with its options, their units and
/// defaults, and its examples.
std::string man_page(const Program& program) {
    std::string title = program.name;
    std::ranges::transform(title, title.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    const std::string name = in_roff(program.name);
    std::string page = fmt::format(".TH {} 1 \"\" \"{}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n"
                                   ".SH SYNOPSIS\n.B {}\n.I COMMAND\n[options]\n",
        title, in_roff(program.version.substr(0, program.version.find('\n'))), name, in_roff(program.about), name);
    add_lines(program.footer, page);
    page += ".SH COMMANDS\n";
    for (const Command& command : program.commands) { add_command(command, program.name, page); }
    page += ".SH EXIT STATUS\n0: success. 1: a check failed. 2: invalid input or environment; the error is one "
            "line.\nA flight ended by a signal completes its report, then the program ends with that signal.\n";
    page += ".SH ENVIRONMENT\n.TP\n.B OCTANT_DATA\nfolder of the program's models and paths\n";
    return page;
}

/// What completes command lines in bash, zsh too (by its bashcompinit): commands and options; files for everything
/// else.
std::string bash_completion(const Program& program) {
    std::string function = "_" + program.name;
    std::ranges::replace(function, '-', '_');
    std::string cases;
    std::string names = "--help --help-all --version";
    std::string with_commands;
    std::string by_others;
    for (const Command& command : program.commands) {
        names += " " + command.name;
        if (!command.commands.empty()) {
            with_commands += fmt::format("{}'{} '*", with_commands.empty() ? "" : "|", command.name);
        }
        if (command.program.empty()) {
            add_case(command, "", cases);
        } else {
            by_others += fmt::format(
                "      {}) {}_other {} ; return ;;\n", command.name, function, fmt::join(command.program, " "));
        }
    }
    return fmt::format(
        R"(# Completes the command lines of {3}. Made by: {3} manual bash
{4}_other() {{ # another program completes its own command line
  local word_count=$# script="${{BASH_SOURCE[0]%/*}}/$1" complete="_${{1//-/_}}"
  COMPREPLY=()
  declare -F "$complete" >/dev/null || [[ -r $script ]] && . "$script"
  declare -F "$complete" >/dev/null || return
  local COMP_WORDS=("$@" "${{COMP_WORDS[@]:2}}") COMP_CWORD=$((COMP_CWORD - 2 + word_count))
  "$complete"
}}
{4}() {{
  if [[ $COMP_CWORD -gt 1 ]]; then
    case ${{COMP_WORDS[1]}} in
{5}      *) ;;
    esac
  fi
  local word=${{COMP_WORDS[COMP_CWORD]}} command="" words i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    [[ ${{COMP_WORDS[i]}} == -* ]] && break
    case "$command ${{COMP_WORDS[i]}}" in
      ' '*) command=${{COMP_WORDS[i]}} ;;
      {2}) [[ $command == *' '* ]] || command="$command ${{COMP_WORDS[i]}}" ;;
    esac
  done
  case "$command" in
    '') words="{0}" ;;
{1}    *) words="" ;;
  esac
  COMPREPLY=()
  while IFS= read -r i; do COMPREPLY+=("$i"); done < <(compgen -W "$words" -- "$word")
  if [[ $word != -* && -n $command ]]; then
    while IFS= read -r i; do COMPREPLY+=("$i"); done < <(compgen -f -- "$word")
  fi
}}
complete -o filenames -F {4} {3}
)",
        names, cases, with_commands.empty() ? "'-'" : with_commands, program.name, function, by_others);
}

std::string zsh_completion(const Program& program) {
    return fmt::format("#compdef {}\nautoload -U +X bashcompinit && bashcompinit\n", program.name) +
           bash_completion(program);
}

} // namespace

Command manual_command(const Program& program) {
    auto form = std::make_shared<std::string>("man");
    Option what = choice_option(
        "form", "FORM", "man (manual page), bash or zsh (shell completion)", {"man", "bash", "zsh"}, *form);
    return {.name = "manual",
        .summary = "Prints the manual page or a shell completion script",
        .options = {std::move(what)},
        .footer = fmt::format("Examples:\n  {0} manual man\n  {0} manual bash", program.name),
        .run = [form, program] {
            const std::string text = *form == "man"    ? man_page(program)
                                     : *form == "bash" ? bash_completion(program)
                                                       : zsh_completion(program);
            std::fputs(text.c_str(), stdout);
        }};
}

} // namespace octant::ui::command_line
