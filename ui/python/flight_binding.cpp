#include "ui/python/arrays.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
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

/// A flight that refuses a second thread while it draws without Python's lock.
class LockedFlight {
public:
    explicit LockedFlight(const FlightSettings& settings) : flight_(settings) {}

    /// The result of call(flight). Throws ValueError.
    template <class Call>
    auto with(const Call& call) {
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (!lock) { refuse("flight: expected one thread at a time, got a second one"); }
        return call(flight_);
    }

private:
    Flight flight_;
    std::mutex mutex_;
};

/// The same for a method that may take long.
template <class Call>
auto unlocked_with(LockedFlight& flight, const Call& call) {
    return flight.with([&call](Flight& one) {
        const py::gil_scoped_release unlocked;
        return call(one);
    });
}

/// Loads a flight without Python's lock. Returns it with the notes for the user.
std::pair<std::unique_ptr<LockedFlight>, std::vector<std::string>> load_flight(
    const NamedWords& settings, const std::string& record) {
    auto notes = std::make_shared<std::vector<std::string>>();
    const py::gil_scoped_release unlocked;
    auto flight = std::make_unique<LockedFlight>(FlightSettings{.settings = settings,
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
    const auto by = [](const auto& call) { return [call](LockedFlight& flight) { return flight.with(call); }; };
    py::class_<LockedFlight>(module, "Flight", "What octant.fly is made of.")
        .def_property_readonly(
            "frame_count", by([](const Flight& flight) { return flight.frame_count(); }), "Of the whole flight.")
        .def(
            "next", [](LockedFlight& flight) { return unlocked_with(flight, [](Flight& one) { return one.next(); }); },
            "Draws the next frame; false at the end.")
        .def(
            "finish", [](LockedFlight& flight) { unlocked_with(flight, [](Flight& one) { one.finish(); }); },
            "Ends the recording.")
        .def_property_readonly("frame", by([](const Flight& flight) { return flight.frame(); }), "Its number, from 0.")
        .def_property_readonly("time_s", by([](const Flight& flight) { return flight.time_s(); }), "Simulated time.")
        .def("rgb", by(&picture_of), "A new array.")
        .def("states", by([](const Flight& flight) {
            return arrays_of_states({flight.states().begin(), flight.states().end()});
        }),
            "Arrays by name.")
        .def("timing", by(&timing_of), "Milliseconds by name.");
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
