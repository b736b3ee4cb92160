#include "ui/python/arrays.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <octant/octant.h>
#include <optional>
#include <pybind11/stl.h>
#include <string>
#include <utility>
#include <vector>

namespace octant::python {

namespace {

constexpr const char* distortion_names[] = {"none", "brown-conrady", "fisheye"};

Distortion distortion_of(const std::string& name) {
    for (std::size_t i = 0; i < std::size(distortion_names); ++i) {
        if (name == distortion_names[i]) { return static_cast<Distortion>(i); }
    }
    refuse("distortion: expected none, brown-conrady or fisheye, got '" + name + "'");
}

Intrinsics intrinsics_of(const py::object& matrix) {
    const Numbers numbers = finite_numbers(matrix, "K");
    if (numbers.ndim() != 2 || numbers.shape(0) != 3 || numbers.shape(1) != 3) {
        refuse("K: expected an array of shape (3, 3), got " + shape_text(numbers));
    }
    const double* k = numbers.data();
    const bool is_pinhole = k[1] == 0.0 && k[3] == 0.0 && k[6] == 0.0 && k[7] == 0.0 && k[8] == 1.0;
    if (!is_pinhole || !(k[0] > 0.0) || !(k[4] > 0.0)) {
        refuse("K: expected [[fx, 0, cx], [0, fy, cy], [0, 0, 1]] with fx and fy above 0, got " +
               py::str(numbers.attr("tolist")()).cast<std::string>());
    }
    return {k[0], k[4], k[2], k[5]};
}

/// An argument as a whole number. Throws ValueError.
int whole_number(const py::handle& value, const char* name) {
    const py::object number = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
    int overflow = 0;
    const long long whole = number ? PyLong_AsLongLongAndOverflow(number.ptr(), &overflow) : 0;
    PyErr_Clear();
    if (!number || overflow != 0 || !std::in_range<int>(whole)) {
        refuse(name + std::string(": expected a whole number of at most nine digits, got ") +
               py::repr(value).cast<std::string>());
    }
    return static_cast<int>(whole);
}

/// An argument as a number; texts are none. Throws ValueError.
double number(const py::handle& value, const char* name) {
    const double number = PyFloat_AsDouble(value.ptr());
    if (PyErr_Occurred() != nullptr) {
        PyErr_Clear();
        refuse(name + std::string(": expected a number, got ") + py::repr(value).cast<std::string>());
    }
    return number;
}

std::vector<double> coefficients_of(const py::handle& value) {
    const Numbers numbers = finite_numbers(value, "coefficients");
    if (numbers.ndim() != 1) { refuse("coefficients: expected an array of shape (n,), got " + shape_text(numbers)); }
    return {numbers.data(), numbers.data() + numbers.size()};
}

/// The arguments of Camera in their order.
Camera make_camera(const py::object& width, const py::object& height, const py::object& fov_deg,
    const py::object& matrix, const py::object& distortion, const py::object& coefficients, const py::object& samples,
    const py::object& bits, const py::object& exposure, const py::object& noise, const py::object& shutter_s,
    const py::object& blur_frames, const py::object& row_time_s) {
    Camera camera;
    camera.width = whole_number(width, "width");
    camera.height = whole_number(height, "height");
    camera.fov_deg = number(fov_deg, "fov_deg");
    if (!matrix.is_none()) { camera.intrinsics = intrinsics_of(matrix); }
    camera.distortion = distortion_of(py::str(distortion).cast<std::string>());
    camera.coefficients = coefficients_of(coefficients);
    camera.samples = whole_number(samples, "samples");
    camera.bits = whole_number(bits, "bits");
    camera.exposure = number(exposure, "exposure");
    camera.noise = number(noise, "noise");
    camera.shutter_s = number(shutter_s, "shutter_s");
    camera.blur_frames = whole_number(blur_frames, "blur_frames");
    camera.row_time_s = number(row_time_s, "row_time_s");
    camera.check();
    return camera;
}

py::array_t<double> matrix_of(const Camera& camera) {
    const Intrinsics k = camera.matrix();
    const double numbers[9] = {k.fx, 0.0, k.cx, 0.0, k.fy, k.cy, 0.0, 0.0, 1.0};
    py::array_t<double> matrix({3, 3});
    std::copy_n(numbers, 9, matrix.mutable_data());
    return matrix;
}

/// Its arguments, from which it can be made again.
py::tuple arguments_of(const Camera& camera) {
    return py::make_tuple(camera.width, camera.height, camera.fov_deg,
        camera.intrinsics ? py::object(matrix_of(camera)) : py::object(py::none()),
        distortion_names[static_cast<std::size_t>(camera.distortion)], camera.coefficients, camera.samples, camera.bits,
        camera.exposure, camera.noise, camera.shutter_s, camera.blur_frames, camera.row_time_s);
}

/// Calls `change` with each quaternion and returns its results.
template <class Change>
py::array_t<double> changed(const py::object& attitudes, const char* name, const Change& change) {
    const Rows rows(attitudes, name, 4);
    py::array_t<double> result = new_rows(rows.count(), 4);
    for (std::size_t i = 0; i < rows.count(); ++i) {
        write(change(quaternion_of(rows[i])), result.mutable_data() + 4 * i);
    }
    return result;
}

} // namespace

void bind_geometry(py::module_& module) {
    py::class_<Camera>(module, "Camera", R"(Camera(width=128, height=128, fov_deg=60.0, *, K=None, ...)

How pictures are taken: size in pixels, vertical field of view in degrees, or the matrix K of a pinhole camera in
pixels with the middle of the upper left pixel at 0, 0, as OpenCV has it (fov_deg is ignored then). A camera cannot be
changed.

width, height: 1 to 8192 pixels.
distortion, coefficients: "none"; "brown-conrady" with k1, k2, p1, p2, k3; "fisheye" with k1 to k4, as OpenCV.
samples: of each pixel, 1, 4 or 16.
bits: of each colour, 8 or 16: rgb arrays are uint8 or uint16.
exposure: factor of linear light. noise: standard deviation, share of full scale.
shutter_s, blur_frames: motion blur over this time, from so many pictures. row_time_s: rolling shutter, the time from
one row to the next one below; negative: from below.
Raises octant.Error, a ValueError, for values out of range.

>>> import octant
>>> camera = octant.Camera(width=640, height=360, fov_deg=60)
>>> camera.width, camera.height, float(camera.K[0, 2])
(640, 360, 319.5)
)")
        .def(py::init(&make_camera), py::arg("width") = 128, py::arg("height") = 128, py::arg("fov_deg") = 60.0,
            py::kw_only(), py::arg("K") = py::none(), py::arg("distortion") = "none",
            py::arg("coefficients") = py::tuple(), py::arg("samples") = 16, py::arg("bits") = 8,
            py::arg("exposure") = 1.0, py::arg("noise") = 0.0, py::arg("shutter_s") = 0.0, py::arg("blur_frames") = 1,
            py::arg("row_time_s") = 0.0)
        // Tried last: no other signature takes such arguments.
        .def(py::init([](const py::args& values, const py::kwargs& named) -> Camera {
            throw py::type_error(
                "Camera: expected width, height, fov_deg and, by name, K, distortion, coefficients, samples, bits, "
                "exposure, noise, shutter_s, blur_frames, row_time_s; got " +
                std::string(py::repr(values)) + " and " + std::string(py::repr(named)));
        }))
        .def_readonly("width", &Camera::width, "Pixels.")
        .def_readonly("height", &Camera::height, "Pixels.")
        .def_readonly("fov_deg", &Camera::fov_deg, "Vertical field of view, degrees; of no meaning with K.")
        .def_property_readonly("K", &matrix_of, "The matrix, (3, 3) float64, pixels.")
        .def_property_readonly(
            "distortion",
            [](const Camera& camera) { return distortion_names[static_cast<std::size_t>(camera.distortion)]; },
            "\"none\", \"brown-conrady\" or \"fisheye\".")
        .def_readonly("coefficients", &Camera::coefficients, "Of the distortion.")
        .def_readonly("samples", &Camera::samples, "Of each pixel.")
        .def_readonly("bits", &Camera::bits, "Of each colour.")
        .def_readonly("exposure", &Camera::exposure, "Factor of linear light.")
        .def_readonly("noise", &Camera::noise, "Standard deviation, share of full scale.")
        .def_readonly("shutter_s", &Camera::shutter_s, "Time that the shutter is open, seconds.")
        .def_readonly("blur_frames", &Camera::blur_frames, "Pictures of a blurred one.")
        .def_readonly("row_time_s", &Camera::row_time_s, "Time from one row to the next, seconds.")
        .def(
            "project",
            [](const Camera& camera, const py::object& point_m) {
                const Rows points(point_m, "point_m", 3);
                py::array_t<double> pixels = new_rows(points.count(), 2);
                for (std::size_t i = 0; i < points.count(); ++i) {
                    const auto pixel = camera.project(vector_of(points[i]));
                    constexpr double none = std::numeric_limits<double>::quiet_NaN();
                    pixels.mutable_data()[2 * i] = pixel ? pixel->first : none;
                    pixels.mutable_data()[2 * i + 1] = pixel ? pixel->second : none;
                }
                return pixels;
            },
            py::arg("point_m"), R"(Pixels of points.

point_m: (n, 3) or (3,), metres, camera axes of OpenCV: x right, y down, z forward. Returns (n, 2) float64: column,
row; NaN for points behind the camera.

>>> import octant
>>> octant.Camera(101, 101).project([0, 0, 10])
array([[50., 50.]])
)")
        .def(
            "ray",
            [](const Camera& camera, const py::object& pixel) {
                const Rows pixels(pixel, "pixel", 2);
                py::array_t<double> rays = new_rows(pixels.count(), 3);
                for (std::size_t i = 0; i < pixels.count(); ++i) {
                    write(camera.ray(pixels[i][0], pixels[i][1]), rays.mutable_data() + 3 * i);
                }
                return rays;
            },
            py::arg("pixel"), R"(Directions that pixels see.

pixel: (n, 2) or (2,): column, row. Returns (n, 3) float64, camera axes of OpenCV, z = 1 (unit length beyond 90 degrees).

>>> import octant
>>> octant.Camera(101, 101).ray([50, 50])
array([[0., 0., 1.]])
)")
        .def("__eq__",
            [](const Camera& camera, const py::object& other) {
                return py::isinstance<Camera>(other) && camera == other.cast<const Camera&>();
            })
        .def("__hash__",
            [](const Camera& camera) { return py::hash(py::make_tuple(camera.width, camera.height, camera.fov_deg)); })
        .def("__repr__",
            [](const Camera& camera) {
                return "octant.Camera(" + std::to_string(camera.width) + ", " + std::to_string(camera.height) +
                       (camera.intrinsics
                               ? ", K=...)"
                               : ", fov_deg=" + py::repr(py::float_(camera.fov_deg)).cast<std::string>() + ")");
            })
        .def(py::pickle(&arguments_of, [](const py::tuple& from) {
            if (from.size() != 13) { refuse("camera: expected 13 values, got " + std::to_string(from.size())); }
            return make_camera(from[0], from[1], from[2], from[3], from[4], from[5], from[6], from[7], from[8], from[9],
                from[10], from[11], from[12]);
        }));

    module.def(
        "attitudes",
        [](const py::object& angles_deg) {
            const Rows rows(angles_deg, "angles_deg", 3);
            py::array_t<double> result = new_rows(rows.count(), 4);
            for (std::size_t i = 0; i < rows.count(); ++i) {
                write(attitude(rows[i][0], rows[i][1], rows[i][2]), result.mutable_data() + 4 * i);
            }
            return result;
        },
        py::arg("angles_deg"), "Of rows of heading, pitch and bank.");
    module.def(
        "look_at",
        [](const py::object& eye_m, const py::object& target_m) {
            const Rows eyes(eye_m, "eye_m", 3);
            const Rows targets(target_m, "target_m", 3);
            const std::size_t count = std::max(eyes.count(), targets.count());
            check_count(eyes, count, "eye_m");
            check_count(targets, count, "target_m");
            py::array_t<double> result = new_rows(count, 4);
            for (std::size_t i = 0; i < count; ++i) {
                write(look_at(vector_of(eyes[i]), vector_of(targets[i])), result.mutable_data() + 4 * i);
            }
            return result;
        },
        py::arg("eye_m"), py::arg("target_m"), "Of rows of eye points and targets.");
    module.def(
        "to_opencv", [](const py::object& value) { return changed(value, "attitude", &to_opencv); },
        py::arg("attitude"), "Of rows of attitudes.");
    module.def(
        "to_opengl", [](const py::object& value) { return changed(value, "attitude", &to_opengl); },
        py::arg("attitude"), "Of rows of attitudes.");
    module.def(
        "from_opencv", [](const py::object& value) { return changed(value, "camera_to_world", &from_opencv); },
        py::arg("camera_to_world"), "Of rows of quaternions.");
    module.def(
        "from_opengl", [](const py::object& value) { return changed(value, "camera_to_world", &from_opengl); },
        py::arg("camera_to_world"), "Of rows of quaternions.");
    py::list names;
    for (std::size_t i = 0; i < surface_class_count; ++i) {
        names.append(py::str(std::string(name_of(static_cast<SurfaceClass>(i)))));
    }
    module.attr("classes") = py::tuple(names);
}

} // namespace octant::python
