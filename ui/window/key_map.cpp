#include "ui/window/key_map.h"

#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <fmt/format.h>
#include <span>

namespace octant::ui::window {

namespace {

constexpr std::array default_view_keys{
    ViewKey{ViewCommand::Cockpit, GLFW_KEY_1, "cockpit", "cockpit view, with head-up display"},
    ViewKey{ViewCommand::Chase, GLFW_KEY_2, "chase", "chase view"},
    ViewKey{ViewCommand::Tower, GLFW_KEY_3, "tower", "tower view"},
    ViewKey{ViewCommand::Orbit, GLFW_KEY_4, "orbit", "orbit view"},
    ViewKey{ViewCommand::Free, GLFW_KEY_5, "free", "free camera"},
    ViewKey{ViewCommand::NextInset, GLFW_KEY_I, "second view", "second view in a corner: next one, or none"},
    ViewKey{ViewCommand::ResetLook, GLFW_KEY_V, "look straight", "look straight again"},
    ViewKey{ViewCommand::PlayOrPause, GLFW_KEY_SPACE, "play", "play or pause"},
    ViewKey{ViewCommand::StepFrame, GLFW_KEY_PERIOD, "one frame", "one frame on", true},
    ViewKey{ViewCommand::Slower, GLFW_KEY_LEFT_BRACKET, "slower", "half as fast", true},
    ViewKey{ViewCommand::Faster, GLFW_KEY_RIGHT_BRACKET, "faster", "twice as fast", true},
    ViewKey{ViewCommand::Loop, GLFW_KEY_L, "loop", "begin again at the path's end, or stop there"},
    ViewKey{ViewCommand::ToBeginning, GLFW_KEY_HOME, "beginning", "back to the beginning"},
    ViewKey{ViewCommand::Back, GLFW_KEY_COMMA, "back", "two seconds back", true},
    ViewKey{ViewCommand::Forward, GLFW_KEY_SLASH, "forward", "two seconds on", true},
    ViewKey{ViewCommand::ManualFlight, GLFW_KEY_H, "by hand", "fly by hand from here, or back to the path"},
    ViewKey{ViewCommand::LevelOff, GLFW_KEY_T, "level off", "by hand: fly it level, until it is or the stick is moved"},
    ViewKey{ViewCommand::Record, GLFW_KEY_F9, "record", "start or stop a recording"},
    ViewKey{ViewCommand::Screenshot, GLFW_KEY_F12, "screenshot", "the picture as PNG, without panels"},
    ViewKey{ViewCommand::ShowMesh, GLFW_KEY_M, "mesh", "the ground's mesh: edges, levels, or none"},
    ViewKey{ViewCommand::FullScreen, GLFW_KEY_F11, "full screen", "full screen, or back"},
    ViewKey{ViewCommand::Panels, GLFW_KEY_TAB, "panels", "hide or show all panels"},
    ViewKey{ViewCommand::FlightPanel, GLFW_KEY_F2, "flight panel", "panel: path, time, recording"},
    ViewKey{ViewCommand::TimingPanel, GLFW_KEY_F3, "timing panel", "panel: frame times"},
    ViewKey{ViewCommand::TerrainPanel, GLFW_KEY_F4, "terrain panel", "panel: terrain"},
    ViewKey{ViewCommand::DrawOrderPanel, GLFW_KEY_F5, "draw order panel", "panel: draw order"},
    ViewKey{ViewCommand::AircraftPanel, GLFW_KEY_F6, "aircraft panel", "panel: aircraft"},
    ViewKey{ViewCommand::ScenePanel, GLFW_KEY_F7, "scene panel", "panel: scene, light, haze"},
    ViewKey{ViewCommand::SettingsPanel, GLFW_KEY_F8, "settings panel", "panel: every setting, save and load"},
    ViewKey{ViewCommand::Help, GLFW_KEY_F1, "keys panel", "this help"},
    ViewKey{ViewCommand::Leave, GLFW_KEY_ESCAPE, "leave", "close the help, or leave"}};

constexpr std::array while_held{HeldKey{HeldAction::Pull, GLFW_KEY_DOWN, "stick back", ""},
    HeldKey{HeldAction::Push, GLFW_KEY_UP, "stick forward", ""},
    HeldKey{HeldAction::RollLeft, GLFW_KEY_LEFT, "stick left", ""},
    HeldKey{HeldAction::RollRight, GLFW_KEY_RIGHT, "stick right", "by hand: stick back, forward, left, right"},
    HeldKey{HeldAction::ThrottleUp, GLFW_KEY_PAGE_UP, "throttle up", ""},
    HeldKey{HeldAction::ThrottleDown, GLFW_KEY_PAGE_DOWN, "throttle down", "by hand: throttle, collective"},
    HeldKey{HeldAction::YawLeft, GLFW_KEY_Z, "rudder left", ""},
    HeldKey{HeldAction::YawRight, GLFW_KEY_X, "rudder right", "by hand: rudder, pedals"},
    HeldKey{HeldAction::CameraAhead, GLFW_KEY_W, "camera ahead", ""},
    HeldKey{HeldAction::CameraBack, GLFW_KEY_S, "camera back", ""},
    HeldKey{HeldAction::CameraLeft, GLFW_KEY_A, "camera left", ""},
    HeldKey{HeldAction::CameraRight, GLFW_KEY_D, "camera right", ""},
    HeldKey{HeldAction::CameraDown, GLFW_KEY_Q, "camera down", ""},
    HeldKey{HeldAction::CameraUp, GLFW_KEY_E, "camera up", ""},
    HeldKey{HeldAction::CameraFast, GLFW_KEY_LEFT_SHIFT, "camera fast",
        "free camera: ahead, back, left, right, down, up; faster"}};

} // namespace

std::span<const ViewKey> view_keys() { return default_view_keys; }

std::span<const HeldKey> held_keys() { return while_held; }

namespace {

struct NamedCode {
    int number;
    std::string_view name;
};

constexpr std::array named_keys{NamedCode{GLFW_KEY_SPACE, "Space"}, NamedCode{GLFW_KEY_APOSTROPHE, "'"},
    NamedCode{GLFW_KEY_COMMA, ","}, NamedCode{GLFW_KEY_MINUS, "-"}, NamedCode{GLFW_KEY_PERIOD, "."},
    NamedCode{GLFW_KEY_SLASH, "/"}, NamedCode{GLFW_KEY_SEMICOLON, ";"}, NamedCode{GLFW_KEY_LEFT_BRACKET, "["},
    NamedCode{GLFW_KEY_BACKSLASH, "\\"}, NamedCode{GLFW_KEY_RIGHT_BRACKET, "]"}, NamedCode{GLFW_KEY_GRAVE_ACCENT, "`"},
    NamedCode{GLFW_KEY_ESCAPE, "Esc"}, NamedCode{GLFW_KEY_ENTER, "Enter"}, NamedCode{GLFW_KEY_TAB, "Tab"},
    NamedCode{GLFW_KEY_BACKSPACE, "Backspace"}, NamedCode{GLFW_KEY_INSERT, "Insert"},
    NamedCode{GLFW_KEY_DELETE, "Delete"}, NamedCode{GLFW_KEY_RIGHT, "Right"}, NamedCode{GLFW_KEY_LEFT, "Left"},
    NamedCode{GLFW_KEY_DOWN, "Down"}, NamedCode{GLFW_KEY_UP, "Up"}, NamedCode{GLFW_KEY_PAGE_UP, "Page Up"},
    NamedCode{GLFW_KEY_PAGE_DOWN, "Page Down"}, NamedCode{GLFW_KEY_HOME, "Home"}, NamedCode{GLFW_KEY_END, "End"},
    NamedCode{GLFW_KEY_PAUSE, "Pause"}, NamedCode{GLFW_KEY_LEFT_SHIFT, "Shift"},
    NamedCode{GLFW_KEY_RIGHT_SHIFT, "Right Shift"}, NamedCode{GLFW_KEY_LEFT_CONTROL, "Ctrl"},
    NamedCode{GLFW_KEY_RIGHT_CONTROL, "Right Ctrl"}, NamedCode{GLFW_KEY_LEFT_ALT, "Alt"},
    NamedCode{GLFW_KEY_RIGHT_ALT, "Right Alt"}, NamedCode{GLFW_KEY_KP_ADD, "Keypad +"},
    NamedCode{GLFW_KEY_KP_SUBTRACT, "Keypad -"}, NamedCode{GLFW_KEY_KP_ENTER, "Keypad Enter"}};

constexpr std::array buttons{NamedCode{GLFW_MOUSE_BUTTON_LEFT, "left"}, NamedCode{GLFW_MOUSE_BUTTON_RIGHT, "right"},
    NamedCode{GLFW_MOUSE_BUTTON_MIDDLE, "middle"}};

constexpr std::array pad_buttons{NamedCode{GLFW_GAMEPAD_BUTTON_A, "a"}, NamedCode{GLFW_GAMEPAD_BUTTON_B, "b"},
    NamedCode{GLFW_GAMEPAD_BUTTON_X, "x"}, NamedCode{GLFW_GAMEPAD_BUTTON_Y, "y"},
    NamedCode{GLFW_GAMEPAD_BUTTON_LEFT_BUMPER, "left bumper"},
    NamedCode{GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER, "right bumper"}, NamedCode{GLFW_GAMEPAD_BUTTON_BACK, "back"},
    NamedCode{GLFW_GAMEPAD_BUTTON_START, "start"}, NamedCode{GLFW_GAMEPAD_BUTTON_GUIDE, "guide"},
    NamedCode{GLFW_GAMEPAD_BUTTON_LEFT_THUMB, "left stick"}, NamedCode{GLFW_GAMEPAD_BUTTON_RIGHT_THUMB, "right stick"},
    NamedCode{GLFW_GAMEPAD_BUTTON_DPAD_UP, "up"}, NamedCode{GLFW_GAMEPAD_BUTTON_DPAD_RIGHT, "right"},
    NamedCode{GLFW_GAMEPAD_BUTTON_DPAD_DOWN, "down"}, NamedCode{GLFW_GAMEPAD_BUTTON_DPAD_LEFT, "left"}};

constexpr std::array axis_names{NamedCode{GLFW_GAMEPAD_AXIS_LEFT_X, "left x"},
    NamedCode{GLFW_GAMEPAD_AXIS_LEFT_Y, "left y"}, NamedCode{GLFW_GAMEPAD_AXIS_RIGHT_X, "right x"},
    NamedCode{GLFW_GAMEPAD_AXIS_RIGHT_Y, "right y"}, NamedCode{GLFW_GAMEPAD_AXIS_LEFT_TRIGGER, "left trigger"},
    NamedCode{GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER, "right trigger"}};

bool same_letters(std::string_view a, std::string_view b) {
    const auto small = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    return std::ranges::equal(a, b, {}, small, small);
}

std::string name_in(std::span<const NamedCode> table, int number) {
    const auto found = std::ranges::find(table, number, &NamedCode::number);
    return found == table.end() ? std::string() : std::string(found->name);
}

std::optional<int> number_in(std::span<const NamedCode> table, std::string_view name) {
    const auto found =
        std::ranges::find_if(table, [name](const NamedCode& each) { return same_letters(each.name, name); });
    return found == table.end() ? std::nullopt : std::optional(found->number);
}

constexpr bool is_letter_or_digit(int key) {
    return (key >= GLFW_KEY_A && key <= GLFW_KEY_Z) || (key >= GLFW_KEY_0 && key <= GLFW_KEY_9);
}

/// Returns the name that stands on a key; empty for a key that has none here.
std::string name_of_key(int key) {
    if (is_letter_or_digit(key)) {
        return std::string(1, static_cast<char>(key)); // GLFW numbers them as ASCII does
    }
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F25) { return "F" + std::to_string(key - GLFW_KEY_F1 + 1); }
    return name_in(named_keys, key);
}

} // namespace

std::optional<int> key_of_name(std::string_view name) {
    for (int key = GLFW_KEY_0; key <= GLFW_KEY_F25; ++key) {
        const std::string each = name_of_key(key);
        if (!each.empty() && same_letters(each, name)) { return key; }
    }
    return number_in(named_keys, name);
}

std::string name_of_button(int button) { return name_in(buttons, button); }

std::string name_of_pad_button(int button) { return name_in(pad_buttons, button); }

namespace {

/// The tables must be in the order of their enumerations, by which KeyMap counts.
template <class Rows, class Value>
constexpr bool is_in_order(const Rows& rows, Value value) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (static_cast<std::size_t>(rows[i].*value) != i) { return false; }
    }
    return true;
}

static_assert(is_in_order(default_view_keys, &ViewKey::command) && is_in_order(while_held, &HeldKey::action));

constexpr std::size_t largest_file_bytes = std::size_t{64} << 10;
constexpr int max_joystick_axes = 16;
constexpr const char* joystick_form = "an axis of the joystick from 1 to 16, perhaps after -";
constexpr const char* pad_form = "left x, left y, right x, right y, left trigger or right trigger, perhaps after -";

std::string expected(std::string_view what, std::string_view got) {
    return fmt::format("expected {}, got '{}'", what, printable(std::string(got)));
}

/// "-left y": the axis of a name, reversed.
template <class Number>
std::optional<AxisBinding> axis_from(std::string_view input, const Number& number_of) {
    AxisBinding choice;
    if (input.starts_with('-')) {
        choice.reversed = true;
        input.remove_prefix(1);
    }
    const std::optional<int> axis = number_of(input);
    if (!axis) { return std::nullopt; }
    choice.axis = *axis;
    return choice;
}

std::optional<int> joystick_axis(std::string_view name) {
    const auto number = whole_number(name);
    return number && *number >= 1 && *number <= max_joystick_axes ? std::optional(static_cast<int>(*number) - 1)
                                                                  : std::nullopt;
}

std::optional<int> gamepad_axis(std::string_view name) { return number_in(axis_names, name); }

/// An axis by its name in the file of keys.
template <class Axes>
struct NamedAxis {
    std::string_view name;
    AxisBinding Axes::*binding;
};

constexpr std::array gamepad_table{NamedAxis<GamepadAxes>{"roll", &GamepadAxes::roll},
    NamedAxis<GamepadAxes>{"pitch", &GamepadAxes::pitch}, NamedAxis<GamepadAxes>{"rudder", &GamepadAxes::rudder},
    NamedAxis<GamepadAxes>{"throttle up", &GamepadAxes::throttle_up},
    NamedAxis<GamepadAxes>{"throttle down", &GamepadAxes::throttle_down}};

constexpr std::array joystick_table{NamedAxis<JoystickAxes>{"roll", &JoystickAxes::roll},
    NamedAxis<JoystickAxes>{"pitch", &JoystickAxes::pitch}, NamedAxis<JoystickAxes>{"rudder", &JoystickAxes::rudder},
    NamedAxis<JoystickAxes>{"throttle", &JoystickAxes::throttle}};

/// Binds the axis of this name to `choice`, which is nothing for a wrong input. Returns what was expected and what
/// came.
template <class Table, class Axes>
std::optional<std::string> bind_axis(const Table& table, Axes& axes, std::string_view name,
    const std::optional<AxisBinding>& choice, const std::string& expected_input) {
    const auto row = std::ranges::find(table, name, [](const auto& each) { return each.name; });
    if (row == table.end()) { return expected("something that keys, mouse or sticks do", name); }
    if (!choice) { return expected_input; }
    axes.*row->binding = *choice;
    return std::nullopt;
}

std::string text_of(const AxisBinding& choice, const std::string& name) { return (choice.reversed ? "-" : "") + name; }

/// The axis as it stands; 0 where the device has none such.
float value_of(const AxisBinding& choice, std::span<const float> axes) {
    const auto axis = static_cast<std::size_t>(choice.axis);
    const float value = axis < axes.size() ? axes[axis] : 0.0F;
    return choice.reversed ? -value : value;
}

} // namespace

KeyMap::KeyMap()
    : look_button(GLFW_MOUSE_BUTTON_LEFT),
      stick_button(GLFW_MOUSE_BUTTON_RIGHT), gamepad{{GLFW_GAMEPAD_AXIS_LEFT_X}, {GLFW_GAMEPAD_AXIS_LEFT_Y},
                                                 {GLFW_GAMEPAD_AXIS_RIGHT_X}, {GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER},
                                                 {GLFW_GAMEPAD_AXIS_LEFT_TRIGGER}} {
    pad_commands[GLFW_GAMEPAD_BUTTON_START] = ViewCommand::PlayOrPause;
    pad_commands[GLFW_GAMEPAD_BUTTON_BACK] = ViewCommand::ToBeginning;
    pad_commands[GLFW_GAMEPAD_BUTTON_X] = ViewCommand::ManualFlight;
    pad_commands[GLFW_GAMEPAD_BUTTON_Y] = ViewCommand::LevelOff;
    pad_commands[GLFW_GAMEPAD_BUTTON_DPAD_UP] = ViewCommand::Cockpit;
    pad_commands[GLFW_GAMEPAD_BUTTON_DPAD_DOWN] = ViewCommand::Chase;
    pad_commands[GLFW_GAMEPAD_BUTTON_DPAD_LEFT] = ViewCommand::Orbit;
    pad_commands[GLFW_GAMEPAD_BUTTON_DPAD_RIGHT] = ViewCommand::Tower;
    for (const ViewKey& each : view_keys()) { commands_.push_back(each.key); }
    for (const HeldKey& each : held_keys()) { held_.push_back(each.key); }
}

std::optional<ViewCommand> KeyMap::command_of(int key, bool repeats) const {
    for (std::size_t i = 0; i < commands_.size(); ++i) {
        if (commands_[i] == key && (view_keys()[i].repeats || !repeats)) { return view_keys()[i].command; }
    }
    return std::nullopt;
}

namespace {

std::string name_or_none(int key) { return key == GLFW_KEY_UNKNOWN ? "none" : name_of_key(key); }

} // namespace

std::string KeyMap::name_of(ViewCommand command) const {
    return name_or_none(commands_[static_cast<std::size_t>(command)]);
}

int KeyMap::key_of(HeldAction action) const { return held_[static_cast<std::size_t>(action)]; }

std::string KeyMap::name_of(HeldAction action) const { return name_or_none(key_of(action)); }

/// A key that did something else does that no more.
std::optional<std::string> KeyMap::bind_key(int& chosen, std::string_view input) {
    if (input == "none") {
        chosen = GLFW_KEY_UNKNOWN;
        return std::nullopt;
    }
    const auto key = key_of_name(input);
    if (!key) { return expected("the name of a key, or none", input); }
    std::ranges::replace(commands_, *key, GLFW_KEY_UNKNOWN);
    std::ranges::replace(held_, *key, GLFW_KEY_UNKNOWN);
    chosen = *key;
    return std::nullopt;
}

std::optional<std::string> KeyMap::bind_pad_button(int button, std::string_view input) {
    const auto command = std::ranges::find(view_keys(), input, &ViewKey::id);
    if (command == view_keys().end() && input != "none") {
        return expected("what a key does, such as play, or none", input);
    }
    pad_commands.at(static_cast<std::size_t>(button)) =
        input == "none" ? std::nullopt : std::optional(command->command);
    return std::nullopt;
}

std::optional<std::string> KeyMap::bind(std::string_view id, std::string_view input) {
    const auto command = std::ranges::find(view_keys(), id, &ViewKey::id);
    if (command != view_keys().end()) {
        return bind_key(commands_[static_cast<std::size_t>(command - view_keys().begin())], input);
    }
    const auto held_key = std::ranges::find(held_keys(), id, &HeldKey::id);
    if (held_key != held_keys().end()) {
        return bind_key(held_[static_cast<std::size_t>(held_key - held_keys().begin())], input);
    }
    if (id == "mouse look" || id == "mouse stick") {
        const auto button = number_in(buttons, input);
        if (!button) { return expected("left, right or middle", input); }
        (id == "mouse look" ? look_button : stick_button) = *button;
        return std::nullopt;
    }
    constexpr std::string_view pad = "gamepad ";
    constexpr std::string_view stick = "joystick ";
    if (id.starts_with(pad)) {
        const std::string_view name = id.substr(pad.size());
        if (const auto pressed = number_in(pad_buttons, name)) { return bind_pad_button(*pressed, input); }
        return bind_axis(gamepad_table, gamepad, name, axis_from(input, gamepad_axis), expected(pad_form, input));
    }
    if (id.starts_with(stick)) {
        JoystickAxes axes = joystick.value_or(JoystickAxes());
        auto fault = bind_axis(joystick_table, axes, id.substr(stick.size()), axis_from(input, joystick_axis),
            expected(joystick_form, input));
        if (!fault) { joystick = axes; }
        return fault;
    }
    return expected("something that keys, mouse or sticks do", id);
}

KeyMapFile read_key_map(const std::filesystem::path& file) {
    KeyMapFile read;
    if (!path_exists(file)) { return read; }
    std::string text;
    try {
        text = read_text_file(file, largest_file_bytes);
    } catch (const Error& fault) {
        read.errors.emplace_back(fault.what());
        return read;
    }
    int number = 0;
    for (const std::string_view line : split_lines(text)) {
        ++number;
        if (line.empty() || line.front() == '#') { continue; }
        const std::size_t sign = line.find('=');
        const auto trimmed = [](std::string_view part) { return split_fields(part, '\n').front(); };
        const std::optional<std::string> fault =
            sign == std::string_view::npos
                ? expected("a line \"what = key\"", line)
                : read.keys.bind(trimmed(line.substr(0, sign)), trimmed(line.substr(sign + 1)));
        if (fault) { read.errors.push_back(fmt::format("{}:{}: {}", file.string(), number, *fault)); }
    }
    return read;
}

std::array<float, 6> gamepad_axes(const KeyMap& keys, std::span<const float, 6> axes) {
    return {value_of(keys.gamepad.roll, axes), value_of(keys.gamepad.pitch, axes), value_of(keys.gamepad.rudder, axes),
        0.0F, value_of(keys.gamepad.throttle_down, axes), value_of(keys.gamepad.throttle_up, axes)};
}

std::vector<ViewCommand> pad_commands(const KeyMap& keys, const GamepadButtons& before, const GamepadButtons& now) {
    std::vector<ViewCommand> commands;
    for (std::size_t i = 0; i < now.size(); ++i) {
        if (now[i] != 0 && before[i] == 0 && keys.pad_commands[i]) { commands.push_back(*keys.pad_commands[i]); }
    }
    return commands;
}

GamepadButtons flying_buttons(const KeyMap& keys, GamepadButtons buttons) {
    for (std::size_t i = 0; i < buttons.size(); ++i) { buttons[i] = keys.pad_commands[i] ? 0 : buttons[i]; }
    return buttons;
}

JoystickState mapped_joystick(const KeyMap& keys, std::span<const float> axes) {
    JoystickState joystick;
    if (keys.joystick) {
        joystick.axes = {value_of(keys.joystick->roll, axes), value_of(keys.joystick->pitch, axes),
            value_of(keys.joystick->rudder, axes), value_of(keys.joystick->throttle, axes)};
        joystick.axis_count = 4;
        return joystick;
    }
    joystick.axis_count = static_cast<int>(std::min(axes.size(), joystick.axes.size()));
    std::copy_n(axes.begin(), joystick.axis_count, joystick.axes.begin());
    return joystick;
}

std::string text_of_key_map(const KeyMap& keys) {
    std::string text = "# Keys, mouse and sticks of octant view. What is left out is as usual.\n"
                       "# A key that is given twice does what its last line says; none is no key.\n";
    for (const ViewKey& each : view_keys()) { text += fmt::format("{} = {}\n", each.id, keys.name_of(each.command)); }
    for (const HeldKey& each : held_keys()) { text += fmt::format("{} = {}\n", each.id, keys.name_of(each.action)); }
    text += fmt::format(
        "mouse look = {}\nmouse stick = {}\n", name_of_button(keys.look_button), name_of_button(keys.stick_button));
    for (const auto& [name, binding] : gamepad_table) {
        const AxisBinding& choice = keys.gamepad.*binding;
        text += fmt::format("gamepad {} = {}\n", name, text_of(choice, name_in(axis_names, choice.axis)));
    }
    for (std::size_t i = 0; i < keys.pad_commands.size(); ++i) {
        const auto& command = keys.pad_commands[i];
        text += fmt::format("gamepad {} = {}\n", name_of_pad_button(static_cast<int>(i)),
            command ? view_keys()[static_cast<std::size_t>(*command)].id : "none");
    }
    for (const auto& [name, binding] : joystick_table) {
        const AxisBinding choice = keys.joystick.value_or(JoystickAxes()).*binding;
        text += fmt::format(
            "{}joystick {} = {}\n", keys.joystick ? "" : "# ", name, text_of(choice, std::to_string(choice.axis + 1)));
    }
    return text;
}

} // namespace octant::ui::window
