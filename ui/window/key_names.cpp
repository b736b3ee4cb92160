#include "ui/window/key_names.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <span>

namespace octant::ui::window {

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

} // namespace

std::string name_of_key(int key) {
    if (is_letter_or_digit(key)) {
        return std::string(1, static_cast<char>(key)); // GLFW numbers them as ASCII does
    }
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F25) { return "F" + std::to_string(key - GLFW_KEY_F1 + 1); }
    return name_in(named_keys, key);
}

std::optional<int> key_of_name(std::string_view name) {
    for (int key = GLFW_KEY_0; key <= GLFW_KEY_F25; ++key) {
        const std::string each = name_of_key(key);
        if (!each.empty() && same_letters(each, name)) { return key; }
    }
    return number_in(named_keys, name);
}

std::string name_of_button(int button) { return name_in(buttons, button); }

std::optional<int> button_of_name(std::string_view name) { return number_in(buttons, name); }

std::string name_of_axis(int axis) { return name_in(axis_names, axis); }

std::optional<int> axis_of_name(std::string_view name) { return number_in(axis_names, name); }

std::string name_of_pad_button(int button) { return name_in(pad_buttons, button); }

std::optional<int> pad_button_of_name(std::string_view name) { return number_in(pad_buttons, name); }

} // namespace octant::ui::window
