#include "ui/command_line/option.h"

#include "ui/settings/settings_text.h"

#include <string>
#include <utility>

namespace octant::ui::command_line {

Option with_shown_default(std::string shown_default, Option option) {
    option.shown_default = std::move(shown_default);
    return option;
}

Option required(Option option) {
    option.required = true;
    return option;
}

Option hidden(Option option) {
    option.heading.clear();
    return option;
}

Option flag(std::string names, std::string meaning, bool& value) {
    return {.name = std::move(names),
        .meaning = std::move(meaning),
        .arity = Arity::None,
        .read = [&value](const Words& words) { value = words.front() == "true"; }};
}

Option choice_option(std::string name, std::string form, std::string meaning, std::vector<std::string_view> choices,
    std::string& value) {
    Option option{
        .name = name, .form = std::move(form), .meaning = std::move(meaning), .read = {}, .shown_default = value};
    option.read = [name = std::move(name), choices = std::move(choices), &value](const Words& words) {
        value = choices[settings::read_choice({name, "", ""}, words.front(), choices)];
    };
    return option;
}

} // namespace octant::ui::command_line
