#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <octant/octant.h>
#include <optional>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

namespace octant::python {

namespace py = pybind11;

/// Numbers in rows without gaps.
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Python's ValueError with this text.
[[noreturn]] inline void refuse(const std::string& what) { throw py::value_error(what); }

/// As "(100, 3)".
inline std::string shape_text(const py::array& array) { return py::str(array.attr("shape")).cast<std::string>(); }

/// An argument as numbers, copied only where they are of another type or have gaps. Throws ValueError "NAME: expected
/// numbers, got ..." for text, objects, complex and boolean values, and where a value is not finite.
inline Numbers finite_numbers(const py::handle& value, const std::string& name) {
    const py::array array = py::array::ensure(value);
    if (!array) {
        PyErr_Clear();
        refuse(name + ": expected an array of numbers, got " + py::str(py::type::of(value)).cast<std::string>());
    }
    const char kind = array.dtype().kind();
    if (kind != 'f' && kind != 'i' && kind != 'u') {
        refuse(
            name + ": expected an array of numbers, got values of type " + py::str(array.dtype()).cast<std::string>());
    }
    Numbers numbers = Numbers::ensure(array);
    if (!numbers) { throw py::error_already_set(); }
    const double* data = numbers.data();
    for (py::ssize_t i = 0; i < numbers.size(); ++i) {
        if (!std::isfinite(data[i])) {
            refuse(name + ": expected finite numbers, got " + (std::isnan(data[i]) ? "NaN" : "infinity") +
                   " at place " + std::to_string(i) + " of the array");
        }
    }
    return numbers;
}

/// Rows of `width` numbers.
class Rows {
public:
    /// An argument of shape (width,) or (n, width), where `is_flat` or not; NumPy's shapes otherwise. Throws
    /// ValueError.
    Rows(const py::handle& value, const std::string& name, py::ssize_t width)
        : numbers_(finite_numbers(value, name)), width_(static_cast<std::size_t>(width)) {
        const py::ssize_t dimensions = numbers_.ndim();
        if (dimensions < 1 || dimensions > 2 || numbers_.shape(dimensions - 1) != width) {
            const std::string text = std::to_string(width);
            refuse(name + ": expected an array of shape (" + text + ",) or (n, " + text + "), got " +
                   shape_text(numbers_));
        }
        count_ = dimensions == 1 ? 1 : static_cast<std::size_t>(numbers_.shape(0));
    }

    std::size_t count() const { return count_; }

    /// The row, or the only one. `row` < count() unless that is 1.
    const double* operator[](std::size_t row) const { return numbers_.data() + (count_ == 1 ? 0 : row) * width_; }

private:
    Numbers numbers_;
    std::size_t width_;
    std::size_t count_ = 0;
};

/// Throws ValueError unless there is one row or `count` of them.
inline void check_count(const Rows& rows, std::size_t count, const std::string& name) {
    if (rows.count() != 1 && rows.count() != count) {
        refuse(name + ": expected one row or " + std::to_string(count) + ", got " + std::to_string(rows.count()));
    }
}

inline Vec3 vector_of(const double* numbers) { return {numbers[0], numbers[1], numbers[2]}; }

inline Quaternion quaternion_of(const double* numbers) { return {numbers[0], numbers[1], numbers[2], numbers[3]}; }

inline void write(const Vec3& vector, double* to) {
    to[0] = vector.x;
    to[1] = vector.y;
    to[2] = vector.z;
}

inline void write(const Quaternion& turn, double* to) {
    to[0] = turn.w;
    to[1] = turn.x;
    to[2] = turn.y;
    to[3] = turn.z;
}

/// A new array of `count` rows.
inline py::array_t<double> new_rows(std::size_t count, std::size_t width) {
    return py::array_t<double>({static_cast<py::ssize_t>(count), static_cast<py::ssize_t>(width)});
}

inline py::array_t<double> array_of(const Vec3& vector) {
    py::array_t<double> array(3);
    write(vector, array.mutable_data());
    return array;
}

/// The states of Python's States as arrays of rows: positions, attitudes, velocities, times, load factors, presence.
std::vector<State> states_of(const py::handle& states);
/// The same from C++: a dictionary of arrays by the names of State's members.
py::dict arrays_of_states(const std::vector<State>& states);

/// What a call that runs without Python's lock asks between its pictures: whether Python's signal handlers raised an
/// exception, such as KeyboardInterrupt. Handlers run in Python's main thread only; they are looked for there, at most
/// every 20 ms.
class StopCheck {
public:
    StopCheck();
    ~StopCheck();
    StopCheck(const StopCheck&) = delete;
    StopCheck& operator=(const StopCheck&) = delete;
    StopCheck(StopCheck&&) = delete;
    StopCheck& operator=(StopCheck&&) = delete;

    /// For RenderOptions::is_stopped; must not outlive this.
    std::function<bool()> function();

private:
    struct Impl;
    Impl* impl_;
};

void bind_geometry(py::module_& module);
void bind_world(py::module_& module);
void bind_flight(py::module_& module);

} // namespace octant::python
