#include "ui/python/arrays.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <octant/flight.h>
#include <octant/octant.h>
#include <pybind11/stl.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::python {

namespace {

using NamedWords = std::vector<std::pair<std::string, std::string>>;

/// Loads a flight without Python's lock. Returns it with the notes for the user.
std::pair<std::unique_ptr<Flight>, std::vector<std::string>> load_flight(
    const NamedWords& settings, const std::string& record) {
    auto notes = std::make_shared<std::vector<std::string>>();
    const py::gil_scoped_release unlocked;
    auto flight = std::make_unique<Flight>(FlightSettings{.settings = settings,
        .record = record,
        .on_note = [notes](std::string_view note) { notes->emplace_back(note); }});
    return {std::move(flight), *notes};
}

py::array_t<std::uint8_t> picture_of(const Flight& flight) {
    py::array_t<std::uint8_t> picture({flight.height(), flight.width(), 3});
    std::ranges::copy(flight.rgb(), picture.mutable_data());
    return picture;
}

py::dict timing_of(const Flight& flight) {
    const FrameTiming& timing = flight.timing();
    py::dict values;
    values["frame_ms"] = timing.frame_ms;
    values["sim_ms"] = timing.sim_ms;
    values["plan_ms"] = timing.plan_ms;
    values["draw_ms"] = timing.draw_ms;
    values["read_ms"] = timing.read_ms;
    return values;
}

py::list known_setting_tuples() {
    py::list list;
    for (const SettingDescription& each : known_settings()) {
        list.append(py::make_tuple(each.name, each.form, each.meaning));
    }
    return list;
}

PilotedAircraft piloted(const std::string& aircraft, const py::object& start) {
    const std::vector<State> states = states_of(start);
    if (states.size() != 1) { refuse("start: expected one state, got " + std::to_string(states.size())); }
    return PilotedAircraft(aircraft, states.front());
}

void advance(PilotedAircraft& aircraft, const py::object& action, int steps) {
    const Rows rows(action, "action", 4);
    if (rows.count() != 1) { refuse("action: expected four numbers, got " + std::to_string(rows.count()) + " rows"); }
    if (steps < 0) { refuse("steps: expected a number not below 0, got " + std::to_string(steps)); }
    const double* asked = rows[0];
    aircraft.advance({.roll = asked[0], .pitch = asked[1], .throttle = asked[2], .yaw = asked[3]}, steps);
}

} // namespace

void bind_flight(py::module_& module) {
    py::class_<Flight>(module, "Flight", "What octant.fly is made of.")
        .def_property_readonly("frame_count", &Flight::frame_count, "Of the whole flight.")
        .def("next", &Flight::next, py::call_guard<py::gil_scoped_release>(), "Draws the next frame; false at the end.")
        .def("finish", &Flight::finish, py::call_guard<py::gil_scoped_release>(), "Ends the recording.")
        .def_property_readonly("frame", &Flight::frame, "Its number, from 0.")
        .def_property_readonly("time_s", &Flight::time_s, "Simulated time.")
        .def("rgb", &picture_of, "A new array.")
        .def(
            "states",
            [](const Flight& flight) {
                return arrays_of_states({flight.states().begin(), flight.states().end()});
            },
            "Arrays by name.")
        .def("timing", &timing_of, "Milliseconds by name.");
    module.def(
        "load_flight", &load_flight, py::arg("settings"), py::arg("record"), "A flight and the notes for its user.");
    module.def(
        "write_report",
        [](const std::vector<std::string>& recordings, const std::string& file) { write_report(recordings, file); },
        py::arg("recordings"), py::arg("file"), py::call_guard<py::gil_scoped_release>(), "Writes one page.");
    module.def("known_settings", &known_setting_tuples, "Name, form and meaning of each.");
    py::class_<PilotedAircraft>(module, "PilotedAircraft", "An aircraft that is flown by hand, in steps of 1/120 s.")
        .def(py::init(&piloted), py::arg("aircraft"), py::arg("start"))
        .def("advance", &advance, py::arg("action"), py::arg("steps") = 1,
            "Flies on with roll, pitch, throttle (0 to 1) and yaw.")
        .def(
            "state", [](const PilotedAircraft& aircraft) { return arrays_of_states({aircraft.state()}); },
            "Arrays by name.")
        .def_property_readonly("trim_throttle", &PilotedAircraft::trim_throttle, "Holds speed and height at the start.")
        .def_property_readonly("is_stalled", &PilotedAircraft::is_stalled, "Whether it lacks lift.")
        .def_property_readonly("is_at_limit", &PilotedAircraft::is_at_limit, "Whether a limit holds it back.");
    module.attr("steps_per_second") = steps_per_second;
}

} // namespace octant::python
