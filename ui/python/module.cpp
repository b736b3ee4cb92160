#include "ui/python/arrays.h"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <octant/error.h>
#include <octant/octant.h>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace octant::python {

struct StopCheck::Impl {
    std::thread::id caller = std::this_thread::get_id();
    std::chrono::steady_clock::time_point last = std::chrono::steady_clock::now();
    std::atomic<bool> is_stopped = false;
};

StopCheck::StopCheck() : impl_(new Impl) {}

StopCheck::~StopCheck() { delete impl_; }

std::function<bool()> StopCheck::function() {
    return [impl = impl_] {
        if (impl->is_stopped || std::this_thread::get_id() != impl->caller) { return impl->is_stopped.load(); }
        const auto now = std::chrono::steady_clock::now();
        if (now - impl->last < std::chrono::milliseconds(20)) { return false; }
        impl->last = now;
        const py::gil_scoped_acquire locked;
        impl->is_stopped = PyErr_CheckSignals() != 0;
        return impl->is_stopped.load();
    };
}

std::vector<State> states_of(const py::handle& states) {
    const auto rows = [&states](const char* name, py::ssize_t width) {
        return Rows(states.attr("_flat")(name), name, width);
    };
    const Rows positions = rows("position_m", 3);
    const Rows attitudes = rows("attitude", 4);
    const Rows velocities = rows("velocity_mps", 3);
    const Rows times = rows("time_s", 1);
    const Rows load_factors = rows("load_factor", 1);
    const Rows presence = rows("is_present", 1);
    const std::size_t count = positions.count();
    for (const Rows* each : {&attitudes, &velocities, &times, &load_factors, &presence}) {
        check_count(*each, count, "states");
    }
    std::vector<State> list(count);
    for (std::size_t i = 0; i < count; ++i) {
        list[i] = {.position_m = vector_of(positions[i]),
            .attitude = quaternion_of(attitudes[i]),
            .is_present = presence[i][0] != 0.0,
            .time_s = times[i][0],
            .velocity_mps = vector_of(velocities[i]),
            .load_factor = load_factors[i][0]};
    }
    return list;
}

py::dict arrays_of_states(const std::vector<State>& states) {
    py::array_t<double> positions = new_rows(states.size(), 3);
    py::array_t<double> attitudes = new_rows(states.size(), 4);
    py::array_t<double> velocities = new_rows(states.size(), 3);
    const auto count = static_cast<py::ssize_t>(states.size());
    py::array_t<double> times(count);
    py::array_t<double> load_factors(count);
    py::array_t<bool> presence(count);
    for (std::size_t i = 0; i < states.size(); ++i) {
        write(states[i].position_m, positions.mutable_data() + 3 * i);
        write(states[i].attitude, attitudes.mutable_data() + 4 * i);
        write(states[i].velocity_mps, velocities.mutable_data() + 3 * i);
        times.mutable_data()[i] = states[i].time_s;
        load_factors.mutable_data()[i] = states[i].load_factor;
        presence.mutable_data()[i] = states[i].is_present;
    }
    py::dict arrays;
    arrays["position_m"] = positions;
    arrays["attitude"] = attitudes;
    arrays["velocity_mps"] = velocities;
    arrays["time_s"] = times;
    arrays["load_factor"] = load_factors;
    arrays["is_present"] = presence;
    return arrays;
}

} // namespace octant::python

PYBIND11_MODULE(_octant, module) {
    namespace py = pybind11;
    module.doc() = "The functions of liboctant, for the package octant.";
    // As io.UnsupportedOperation: what is wrong with an argument or a file is said in one text.
    const py::object bases = py::make_tuple(
        py::reinterpret_borrow<py::object>(PyExc_ValueError), py::reinterpret_borrow<py::object>(PyExc_OSError));
    static PyObject* error = PyErr_NewExceptionWithDoc("octant.Error",
        "A setting or a file that cannot be used, as 'file:line: expected ..., got ...'. Both a ValueError and an "
        "OSError.",
        bases.ptr(), nullptr);
    module.attr("Error") = py::reinterpret_borrow<py::object>(error);
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) { std::rethrow_exception(std::move(thrown)); }
        } catch (const octant::Interrupted& stopped) {
            // The signal handler's exception is set already.
            if (PyErr_Occurred() == nullptr) { PyErr_SetString(PyExc_KeyboardInterrupt, stopped.what()); }
        } catch (const octant::Error& fault) { PyErr_SetString(error, fault.what()); }
    });
    module.attr("version") = octant::version();
    octant::python::bind_geometry(module);
    octant::python::bind_world(module);
    octant::python::bind_flight(module);
}
