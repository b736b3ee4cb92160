#include "ui/command_line/command.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "ui/settings/settings_text.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
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
    option.shown = Shown::Never;
    return option;
}

Option old_name(Option option, std::string new_form) {
    const std::string name = option.name.substr(0, option.name.find(','));
    option.note = [name, new_form = std::move(new_form)](const Words&) {
        return fmt::format("{} is now {}; the old name works until version 1.1", name, new_form);
    };
    return hidden(std::move(option));
}

Option advanced(Option option) {
    option.shown = Shown::InHelpAll;
    return option;
}

namespace {

/// Reads one "KEY=VALUE", "KEY" or "no-KEY" of a family. Throws Error that begins with the family's name and the key.
void read_family_word(const std::string& family, const std::vector<FamilyKey>& keys, const std::string& word) {
    const std::size_t equals = word.find('=');
    std::string key = word.substr(0, equals);
    std::string value = equals == std::string::npos ? "" : word.substr(equals + 1);
    auto found = std::ranges::find(keys, key, &FamilyKey::key);
    if (found == keys.end() && key.starts_with("no-") && equals == std::string::npos) {
        key.erase(0, 3);
        value = "false";
        found = std::ranges::find(keys, key, &FamilyKey::key);
    } else if (found != keys.end() && found->option.arity == Arity::None && equals == std::string::npos) {
        value = "true";
    }
    const bool is_truth = value == "true" || value == "false";
    const bool is_known = found != keys.end() && (found->option.arity == Arity::None ? is_truth : !value.empty());
    if (!is_known) {
        std::vector<std::string> forms;
        for (const FamilyKey& each : keys) {
            forms.push_back(each.option.arity == Arity::None ? each.key : each.key + "=" + each.option.form);
        }
        throw Error(fmt::format("{}: expected {}, got '{}'", family, fmt::join(forms, ", "), printable(word)));
    }
    try {
        found->option.read({value});
    } catch (const Error& fault) {
        const std::string what = fault.what();
        const std::string name = found->option.name.substr(0, found->option.name.find(',')) + ":";
        throw Error(what.starts_with(name) ? fmt::format("{} {}:{}", family, key, what.substr(name.size())) : what);
    }
}

} // namespace

void add_family(std::vector<Option>& table, Option family, std::vector<FamilyKey> keys) {
    for (const FamilyKey& each : keys) {
        const bool is_flag = each.option.arity == Arity::None;
        const std::string form = is_flag ? each.key : each.key + "=" + each.option.form;
        const bool has_default = !each.option.shown_default.empty();
        family.meaning += fmt::format("\n{}: {}{}", form, each.option.meaning,
            has_default ? fmt::format(" [{}]", each.option.shown_default) : "");
        Option old = old_name(each.option, fmt::format("{} {}", family.name, form));
        if (is_flag) {
            old.note = [name = each.option.name, new_form = fmt::format("{} ", family.name), key = each.key](
                           const Words& words) {
                const bool on = words.front() == "true";
                return fmt::format("{}{} is now {}{}{}; the old name works until version 1.1", on ? "--" : "--no-",
                    name.substr(2, name.find(',') - 2), new_form, on ? "" : "no-", key);
            };
        }
        table.push_back(std::move(old));
    }
    family.arity = Arity::Repeatable;
    family.read = [name = family.name, keys = std::move(keys)](const Words& words) {
        for (const std::string& given : words) {
            for (const std::string_view word : split_fields(given, ',')) {
                read_family_word(name, keys, std::string(word));
            }
        }
    };
    table.push_back(std::move(family));
}

Option flag(std::string names, std::string meaning, bool& value) {
    return {.name = std::move(names),
        .meaning = std::move(meaning),
        .arity = Arity::None,
        .read = [&value](const Words& words) { value = words.front() == "true"; }};
}

std::vector<Option> with_output_options(base::OutputOptions& output, std::vector<Option> table) {
    table.push_back(flag("--json", "print the results as JSON", output.json));
    table.push_back(flag("--quiet", "print no progress and no notes", output.quiet));
    return table;
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
