#include "ui/sweep/sweep_file.h"

#include "flightpaths/toml_fields.h"
#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/random_generator.h"
#include "sim/base/text_file.h"
#include "ui/base/data_files.h"
#include "ui/settings/aircraft_entry.h"
#include "ui/settings/setting_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <set>
#include <string_view>

namespace octant::ui::sweep {

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// Settings that one value of something varied sets.
struct AxisValue {
    std::string label;
    std::vector<std::pair<std::string, Words>> settings;
};

/// Something varied: its name and values.
struct Axis {
    std::string name;
    int line = 1;
    std::vector<AxisValue> choices;
};

/// A sweep's file while it is read.
class SweepReader {
public:
    explicit SweepReader(const fs::path& file)
        : file_(file), root_(flightpaths::parse_toml(file, read_text_file(file))) {}

    Sweep sweep();

private:
    [[noreturn]] void refuse(const toml::node& node, const std::string& what) const {
        throw_error_at(file_, flightpaths::line_of(node), what);
    }

    const toml::table* table_in(const toml::table& table, std::string_view key) const;
    std::string word_of(const toml::node& node) const;
    Words words_of(const toml::node& node) const;
    std::vector<Words> range_of(const toml::table& table) const;
    Axis axis_of(std::string_view name, const toml::node& node) const;
    Axis named_groups(std::string_view name, const toml::table& table) const;
    std::vector<Axis> axes() const;
    void set(settings::RunSettings& settings, const std::string& name, const Words& words, int line);
    settings::RunSettings shared_settings();
    int repeats() const;
    std::string name() const;

    fs::path file_;
    toml::table root_;
    std::set<std::string> notes_; ///< of values under old names
};

const toml::table* SweepReader::table_in(const toml::table& table, std::string_view key) const {
    const toml::node* const node = table.get(key);
    if (node != nullptr && !node->is_table()) {
        refuse(*node, fmt::format("expected a table [{}], got something else", key));
    }
    return node == nullptr ? nullptr : node->as_table();
}

/// A value as a person would type it for the setting.
std::string SweepReader::word_of(const toml::node& node) const {
    if (const auto text = node.value_exact<std::string>()) { return *text; }
    if (const auto whole = node.value_exact<std::int64_t>()) { return fmt::format("{}", *whole); }
    if (const auto number = node.value_exact<double>()) { return fmt::format("{}", *number); }
    if (const auto truth = node.value_exact<bool>()) { return *truth ? "true" : "false"; }
    refuse(node, "expected a text, a number or a truth value, got something else");
}

Words SweepReader::words_of(const toml::node& node) const {
    const toml::array* const list = node.as_array();
    if (list == nullptr) { return {word_of(node)}; }
    Words words;
    for (const toml::node& each : *list) { words.push_back(word_of(each)); }
    return words;
}

/// { from, to, step }: from, from + step, ... up to `to`.
std::vector<Words> SweepReader::range_of(const toml::table& table) const {
    const auto number = [&](const char* key) {
        const auto value = table[key].value<double>();
        if (!value || !std::isfinite(*value)) {
            refuse(table, fmt::format("expected a range {{from, to, step}}, got one without {}", key));
        }
        return *value;
    };
    const double from = number("from");
    const double to = number("to");
    const double step = number("step");
    if (table.size() != 3 || step <= 0.0 || to < from || (to - from) / step > static_cast<double>(max_runs)) {
        refuse(table, fmt::format("expected from <= to, a step above 0 and at most {} values, got others", max_runs));
    }
    constexpr double rounding = 1e-9; // of a step, so that 0.1 to 0.3 by 0.1 has three values
    const bool whole = std::floor(from) == from && std::floor(step) == step;
    std::vector<Words> values;
    for (int i = 0; from + i * step <= to + rounding * step; ++i) {
        const double value = from + i * step;
        values.push_back({whole ? fmt::format("{:.0f}", value) : fmt::format("{:.6g}", value)});
    }
    return values;
}

std::string label_of(const Words& words) {
    std::string label;
    for (const std::string& word : words) {
        const fs::path file(word);
        const bool is_path = file.has_parent_path() && file.has_stem();
        const std::string name = is_path ? file.stem().string() : word;
        label += label.empty() ? "" : "+";
        label += name;
    }
    std::ranges::replace_if(
        label,
        [](char c) {
            const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' ||
                               c == '+' || c == '_';
            return !plain;
        },
        '-');
    constexpr std::size_t longest = 60;
    label.resize(std::min(label.size(), longest));
    return label.starts_with('.') ? "_" + label : label;
}

/// In the order in which they stand in the file: the first is the baseline of the report.
Axis SweepReader::named_groups(std::string_view name, const toml::table& table) const {
    Axis axis{std::string(name), flightpaths::line_of(table), {}};
    std::vector<std::pair<std::string_view, const toml::node*>> groups; // the table has them by the alphabet
    for (const auto& [label, group] : table) { groups.emplace_back(label.str(), &group); }
    std::ranges::stable_sort(groups, {}, [](const auto& group) {
        const toml::source_position& place = group.second->source().begin;
        return std::pair(place.line, place.column);
    });
    for (const auto& [label, node] : groups) {
        const toml::node& group = *node;
        const toml::table* const settings = group.as_table();
        if (settings == nullptr) {
            refuse(group, fmt::format("expected a table [vary.{}.{}] of settings, got something else", name, label));
        }
        AxisValue choice{label_of({std::string(label)}), {}};
        for (const auto& [key, value] : *settings) {
            choice.settings.emplace_back(std::string(key.str()), words_of(value));
        }
        axis.choices.push_back(std::move(choice));
    }
    return axis;
}

Axis SweepReader::axis_of(std::string_view name, const toml::node& node) const {
    std::vector<Words> values;
    if (const toml::array* const list = node.as_array()) {
        for (const toml::node& each : *list) { values.push_back(words_of(each)); }
    } else if (const toml::table* const table = node.as_table()) {
        if (!table->contains("from")) { return named_groups(name, *table); }
        values = range_of(*table);
    } else {
        refuse(node, fmt::format("{}: expected a list, a range or named groups, got one value", name));
    }
    Axis axis{std::string(name), flightpaths::line_of(node), {}};
    for (Words& words : values) { axis.choices.push_back({label_of(words), {{std::string(name), std::move(words)}}}); }
    return axis;
}

/// Throws Error for an aircraft or a path that is neither built in nor a file, as seen from the sweep's folder.
void check_names(const fs::path& sweep_file, settings::RunSettings settings) {
    settings::resolve_paths_from(fs::absolute(sweep_file).parent_path(), settings);
    for (const std::string& name : settings.path.aircraft) {
        const settings::AircraftEntry flown = settings::parse_aircraft_entry(name);
        base::aircraft_file(flown.shape);
        base::path_file(flown.path.value_or(settings.path.name), flown.shape);
    }
}

/// In the order in which they stand in the file.
std::vector<Axis> SweepReader::axes() const {
    std::vector<Axis> axes;
    if (const toml::table* const vary = table_in(root_, "vary")) {
        for (const auto& [key, node] : *vary) {
            axes.push_back(axis_of(key.str(), node));
            if (axes.back().choices.empty()) {
                refuse(node, fmt::format("{}: expected values, got none", axes.back().name));
            }
        }
    }
    std::ranges::stable_sort(axes, {}, &Axis::line);
    return axes;
}

void SweepReader::set(settings::RunSettings& settings, const std::string& name, const Words& words, int line) {
    try {
        const std::string note = settings::set_by_name(settings, name, words);
        if (!note.empty()) { notes_.insert(note); }
        if (name == "aircraft" || name == "path") { // looked at here, where the line is known
            check_names(file_, settings);
        }
    } catch (const Error& fault) { throw_error_at(file_, line, fault.what()); }
}

settings::RunSettings SweepReader::shared_settings() {
    settings::RunSettings settings;
    if (const toml::table* const shared = table_in(root_, "settings")) {
        for (const auto& [key, node] : *shared) {
            set(settings, std::string(key.str()), words_of(node), flightpaths::line_of(node));
        }
    }
    return settings;
}

int SweepReader::repeats() const {
    const toml::node* const node = root_.get("repeats");
    if (node == nullptr) { return 1; }
    const auto repeats = node->value_exact<std::int64_t>();
    if (!repeats || *repeats < 1 || *repeats > 1000) {
        refuse(*node, "repeats: expected a whole number from 1 to 1000, got another");
    }
    return static_cast<int>(*repeats);
}

std::string SweepReader::name() const {
    const toml::node* const node = root_.get("name");
    if (node == nullptr) { return file_.stem().string(); }
    const auto name = node->value_exact<std::string>();
    if (!name || name->empty()) { refuse(*node, "name: expected a text of one letter or more, got another value"); }
    return *name;
}

Sweep SweepReader::sweep() {
    constexpr std::array<std::string_view, 4> keys{"name", "repeats", "settings", "vary"};
    for (const auto& [key, node] : root_) {
        if (std::ranges::find(keys, key.str()) == keys.end()) {
            refuse(node, fmt::format("expected name, repeats, [settings] or [vary], got '{}'",
                             printable(std::string(key.str()))));
        }
    }
    Sweep sweep;
    sweep.name = label_of({name()});
    const std::vector<Axis> varied = axes();
    std::size_t count = static_cast<std::size_t>(repeats());
    for (const Axis& axis : varied) {
        count *= axis.choices.size();
        if (count > max_runs) {
            throw_error_at(file_, axis.line, fmt::format("expected at most {} flights, got more", max_runs));
        }
    }
    std::set<std::string> names;
    for (std::size_t i = 0; i < count; ++i) {
        SweepRun run;
        run.settings = shared_settings();
        std::size_t left = i;
        run.repeat = 1 + static_cast<int>(left % static_cast<std::size_t>(repeats()));
        left /= static_cast<std::size_t>(repeats());
        std::vector<const AxisValue*> chosen(varied.size());
        for (std::size_t a = varied.size(); a-- > 0;) {
            chosen[a] = &varied[a].choices[left % varied[a].choices.size()];
            left /= varied[a].choices.size();
        }
        for (std::size_t a = 0; a < varied.size(); ++a) {
            run.varied.emplace_back(varied[a].name, chosen[a]->label);
            run.name += (run.name.empty() ? "" : "-") + chosen[a]->label;
            for (const auto& [name, words] : chosen[a]->settings) { set(run.settings, name, words, varied[a].line); }
        }
        constexpr std::size_t longest_name = 200; // of a folder's 255 letters
        run.name.resize(std::min(run.name.size(), longest_name));
        run.name = run.name.empty() ? sweep.name : run.name;
        if (repeats() > 1) { run.name += fmt::format("-r{}", run.repeat); }
        while (!names.insert(run.name).second) {
            run.name += "x"; // two files of one name from different folders
        }
        settings::resolve_paths_from(fs::absolute(file_).parent_path(), run.settings);
        sweep.runs.push_back(std::move(run));
    }
    sweep.notes.assign(notes_.begin(), notes_.end());
    return sweep;
}

} // namespace

Sweep read_sweep(const fs::path& file) { return SweepReader(file).sweep(); }

std::vector<std::size_t> flying_order(const Sweep& sweep) {
    const auto repeat_of = [&](std::size_t run) { return sweep.runs[run].repeat; };
    std::vector<std::size_t> order(sweep.runs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, repeat_of);
    RandomGenerator random(checksum_of(sweep.name));
    for (auto begin = order.begin(); begin != order.end();) {
        const auto end =
            std::find_if(begin, order.end(), [&](auto run) { return repeat_of(run) != repeat_of(*begin); });
        for (auto left = end - begin; left > 1; --left) { // std::shuffle differs between libraries
            std::iter_swap(
                begin + left - 1, begin + static_cast<std::ptrdiff_t>(random.between(0.0, static_cast<double>(left))));
        }
        begin = end;
    }
    return order;
}

} // namespace octant::ui::sweep
