#include "sim/base/output_file.h"
#include "tests/scratch.h"
#include "ui/window/key_map.h"

#include <catch2/catch.hpp>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>
#include <string>
#include <vector>

using namespace octant;
using namespace octant::ui::window;

namespace {

KeyMapFile read(const std::string& text) {
    const auto file = tests::scratch_folder() / "keys";
    write_file(file, text);
    return read_key_map(file);
}

} // namespace

TEST_CASE("without a file keys are as the help has them, and every key has a name and a place") {
    const KeyMapFile none = read_key_map(tests::scratch_folder() / "no keys");
    CHECK(none.errors.empty());
    for (const ViewKey& each : view_keys()) {
        CAPTURE(each.id);
        CHECK(none.keys.command_of(each.key, false) == each.command);
        CHECK(none.keys.command_of(each.key, true).has_value() == each.repeats);
        CHECK(key_of_name(none.keys.name_of(each.command)) == each.key);
    }
    for (const HeldKey& each : held_keys()) {
        CHECK(none.keys.key_of(each.action) == each.key);
        CHECK(key_of_name(none.keys.name_of(each.action)) == each.key);
    }
}

TEST_CASE("a file of keys changes what it names, takes keys away where they are and leaves the rest") {
    const KeyMapFile changed = read("# mine\n\nplay = P\r\nstick back=keypad -\n  loop = space \nrecord = none\n"
                                    "mouse look = middle\ngamepad pitch = -right y\njoystick throttle = -2\n");
    CHECK(changed.errors.empty());
    const KeyMap& keys = changed.keys;
    CHECK(keys.command_of(GLFW_KEY_P, false) == ViewCommand::PlayOrPause);
    CHECK(keys.command_of(GLFW_KEY_SPACE, false) == ViewCommand::Loop);
    CHECK_FALSE(keys.command_of(GLFW_KEY_L, false));
    CHECK_FALSE(keys.command_of(GLFW_KEY_F9, false));
    CHECK(keys.name_of(ViewCommand::Record) == "none");
    CHECK(keys.key_of(HeldAction::Pull) == GLFW_KEY_KP_SUBTRACT);
    CHECK(keys.key_of(HeldAction::Push) == GLFW_KEY_UP);
    CHECK(keys.look_button == GLFW_MOUSE_BUTTON_MIDDLE);
    const std::array<float, 6> pad{0.1F, 0.2F, 0.3F, 0.4F, -1.0F, 0.6F};
    CHECK(gamepad_axes(keys, pad) == std::array<float, 6>{0.1F, -0.4F, 0.3F, 0.0F, -1.0F, 0.6F});
    const JoystickState stick = mapped_joystick(keys, std::array{0.1F, 0.2F});
    CHECK(stick.axes == std::array<float, 4>{0.1F, 0.2F, 0.0F, -0.2F});
    CHECK(mapped_joystick(KeyMap(), std::array{0.1F, 0.2F}).axis_count == 2);

    const KeyMapFile repeat_option = read(text_of_key_map(keys));
    CHECK(repeat_option.errors.empty());
    CHECK(text_of_key_map(repeat_option.keys) == text_of_key_map(keys));
}

TEST_CASE("a button of a gamepad gives its command once, and then no longer moves the rudder") {
    const KeyMapFile changed = read("gamepad left bumper = record\ngamepad start = none\ngamepad a = none\n");
    REQUIRE(changed.errors.empty());
    GamepadButtons pressed{};
    CHECK(pad_commands(changed.keys, pressed, pressed).empty());
    pressed[GLFW_GAMEPAD_BUTTON_LEFT_BUMPER] = 1;
    pressed[GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER] = 1;
    pressed[GLFW_GAMEPAD_BUTTON_START] = 1;
    CHECK(pad_commands(changed.keys, {}, pressed) == std::vector{ViewCommand::Record});
    CHECK(pad_commands(changed.keys, pressed, pressed).empty());
    CHECK(pad_commands(KeyMap(), {}, pressed) == std::vector{ViewCommand::PlayOrPause});
    const GamepadButtons flying = flying_buttons(changed.keys, pressed);
    CHECK(flying[GLFW_GAMEPAD_BUTTON_LEFT_BUMPER] == 0);
    CHECK(flying[GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER] == 1);

    const KeyMapFile repeat_option = read(text_of_key_map(changed.keys));
    CHECK(repeat_option.errors.empty());
    CHECK(repeat_option.keys.pad_commands == changed.keys.pad_commands);
    CHECK_THAT(read("gamepad b = dance\n").errors.at(0), Catch::Contains("keys:1: expected what a key does"));
}

TEST_CASE("lines that are wrong are told with their numbers, and count for nothing") {
    const KeyMapFile wrong =
        read("play\nfly = F\nplay = Any\nmouse look = wheel\ngamepad pitch = up\njoystick roll = 17\n"
             "gamepad nose = left x\nloop = O\n\x1b[31m = A\n");
    REQUIRE(wrong.errors.size() == 8);
    CHECK_THAT(wrong.errors[0], Catch::Contains("keys:1: expected a line \"what = key\""));
    CHECK_THAT(wrong.errors[1], Catch::Contains("keys:2: expected something that keys"));
    CHECK_THAT(wrong.errors[2], Catch::Contains("keys:3: expected the name of a key"));
    CHECK_THAT(wrong.errors[3], Catch::Contains("keys:4: expected left, right or middle"));
    CHECK_THAT(wrong.errors[4], Catch::Contains("keys:5: expected left x"));
    CHECK_THAT(wrong.errors[5], Catch::Contains("keys:6: expected an axis of the joystick"));
    CHECK_THAT(wrong.errors[6], Catch::Contains("keys:7: expected something that keys"));
    CHECK(wrong.errors[7].find('\x1b') == std::string::npos);
    CHECK(wrong.keys.command_of(GLFW_KEY_O, false) == ViewCommand::Loop);
    CHECK(wrong.keys.command_of(GLFW_KEY_SPACE, false) == ViewCommand::PlayOrPause);
}
