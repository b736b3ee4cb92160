#include "sim/base/error.h"
#include "ui/commands/commands.h"
#include "ui/commands/manual.h"

#include <cstdio>
#include <memory>
#include <string>
#include <utility>

namespace octant::ui::commands {

Command manual_command(std::shared_ptr<const Program> program) {
    auto form = std::make_shared<std::string>("man");
    Option what =
        choice_option("form", "FORM", "man, a manual page; bash or zsh, completion", {"man", "bash", "zsh"}, *form);
    return {.name = "manual",
        .summary = "Prints the manual page, or what completes command lines in a shell",
        .options = {std::move(what)},
        .footer = "Examples:\n"
                  "  octant manual man\n"
                  "  octant manual bash",
        .run = [form, program = std::move(program)] {
            const std::string text = *form == "man"    ? man_page(*program)
                                     : *form == "bash" ? bash_completion(*program)
                                                       : zsh_completion(*program);
            std::fputs(text.c_str(), stdout);
        }};
}

} // namespace octant::ui::commands
