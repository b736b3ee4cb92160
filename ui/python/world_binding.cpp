#include "ui/python/arrays.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <octant/flight.h>
#include <octant/octant.h>
#include <optional>
#include <pybind11/stl.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::python {

namespace {

/// A world that may be closed while other threads draw with it. Its states are changed in a copy, so that a call that
/// runs in another thread goes on with those that it began with. Members are read and written under Python's lock.
class OpenWorld {
public:
    explicit OpenWorld(std::shared_ptr<const World> world) : world_(std::move(world)) {}

    /// Throws ValueError once it is closed.
    std::shared_ptr<const World> get() const {
        if (!world_) { refuse("world: expected an open world, got a closed one"); }
        return world_;
    }

    bool is_closed() const { return world_ == nullptr; }

    void close() { world_.reset(); }

    void set_states(const std::vector<State>& states) {
        World changed = *get();
        changed.set_states(states);
        world_ = std::make_shared<const World>(std::move(changed));
    }

private:
    std::shared_ptr<const World> world_;
};

/// Loads a world without Python's lock. `shared`: with which it shares what both have in common; null = none. Returns
/// it with the notes for the user.
std::pair<std::unique_ptr<OpenWorld>, std::vector<std::string>> load(const std::string& terrain,
    const std::vector<std::string>& aircraft, const std::vector<std::pair<std::string, std::string>>& settings,
    const OpenWorld* shared) {
    std::vector<std::string> notes;
    const std::shared_ptr<const World> other = shared == nullptr ? nullptr : shared->get();
    const py::gil_scoped_release unlocked;
    const WorldSettings wanted{
        .terrain = terrain, .aircraft = aircraft, .settings = settings, .on_note = [&notes](std::string_view note) {
            notes.emplace_back(note);
        }};
    auto world = other ? std::make_shared<const World>(wanted, *other) : std::make_shared<const World>(wanted);
    return {std::make_unique<OpenWorld>(std::move(world)), std::move(notes)};
}

/// How render() and boxes() are to be called, as Python has it: keywords that are all optional.
struct RenderCall {
    std::vector<Pose> poses;
    std::vector<State> states;
    std::vector<State> previous_states;
    RenderOptions options;
};

std::optional<Rows> optional_rows(const py::kwargs& given, const char* name, py::ssize_t width) {
    if (!given.contains(name) || given[name].is_none()) { return std::nullopt; }
    return Rows(given[name], name, width);
}

std::vector<Pose> poses_of(const py::object& eye, const py::object& look, const py::kwargs& given) {
    const Rows eyes(eye, "eye", 3);
    const Rows looks(look, "look", 4);
    const std::size_t count = std::max(eyes.count(), looks.count());
    check_count(eyes, count, "eye");
    check_count(looks, count, "look");
    const std::optional<Rows> previous_eyes = optional_rows(given, "previous_eye", 3);
    const std::optional<Rows> previous_looks = optional_rows(given, "previous_look", 4);
    const std::optional<Rows> velocities = optional_rows(given, "velocity_mps", 3);
    const std::optional<Rows> turn_rates = optional_rows(given, "turn_rate_degps", 3);
    if (previous_eyes) { check_count(*previous_eyes, count, "previous_eye"); }
    if (previous_looks) { check_count(*previous_looks, count, "previous_look"); }
    if (velocities) { check_count(*velocities, count, "velocity_mps"); }
    if (turn_rates) { check_count(*turn_rates, count, "turn_rate_degps"); }
    std::vector<Pose> poses(count);
    for (std::size_t i = 0; i < count; ++i) {
        Pose& pose = poses[i];
        pose.eye_m = vector_of(eyes[i]);
        pose.attitude = quaternion_of(looks[i]);
        if (previous_eyes || previous_looks) {
            pose.previous_eye_m = previous_eyes ? vector_of((*previous_eyes)[i]) : pose.eye_m;
            pose.previous_attitude = previous_looks ? quaternion_of((*previous_looks)[i]) : pose.attitude;
        }
        if (velocities) { pose.velocity_mps = vector_of((*velocities)[i]); }
        if (turn_rates) { pose.turn_rate_degps = vector_of((*turn_rates)[i]); }
    }
    return poses;
}

RenderCall call_of(const py::object& eye, const py::object& look, const py::kwargs& given) {
    RenderCall call;
    call.poses = poses_of(eye, look, given);
    const auto has = [&given](const char* name) { return given.contains(name) && !given[name].is_none(); };
    if (has("states")) { call.states = states_of(given["states"]); }
    if (has("previous_states")) { call.previous_states = states_of(given["previous_states"]); }
    if (has("threads")) { call.options.threads = given["threads"].cast<int>(); }
    if (has("seed")) { call.options.noise_seed = given["seed"].cast<std::uint64_t>(); }
    if (has("first_index")) { call.options.first_index = given["first_index"].cast<std::uint64_t>(); }
    return call;
}

/// The memory of an array of exactly this type and shape, which is written to. Throws ValueError.
template <class Value>
Value* memory_of(const py::handle& value, const std::string& name, const std::vector<py::ssize_t>& shape) {
    if (!py::isinstance<py::array>(value)) {
        refuse(name + ": expected a NumPy array, got " + py::str(py::type::of(value)).cast<std::string>());
    }
    const auto array = py::reinterpret_borrow<py::array>(value);
    const bool has_shape = std::vector<py::ssize_t>(array.shape(), array.shape() + array.ndim()) == shape;
    if (!has_shape) {
        refuse(name + ": expected an array of shape " + py::str(py::tuple(py::cast(shape))).cast<std::string>() +
               ", got " + shape_text(array));
    }
    if (!py::isinstance<py::array_t<Value>>(value)) {
        refuse(name + ": expected values of type " + py::str(py::dtype::of<Value>()).cast<std::string>() + ", got " +
               py::str(array.dtype()).cast<std::string>());
    }
    if (!array.writeable()) { refuse(name + ": expected an array that can be written to, got a read-only one"); }
    if ((array.flags() & py::array::c_style) == 0) {
        refuse(name + ": expected an array without gaps (C-contiguous), got one with strides of " +
               py::str(array.attr("strides")).cast<std::string>() + " bytes");
    }
    if (reinterpret_cast<std::uintptr_t>(array.data()) % alignof(Value) != 0) {
        refuse(name + ": expected an aligned array, got one that begins between two values of its type");
    }
    return static_cast<Value*>(py::reinterpret_borrow<py::array>(value).mutable_data());
}

FrameArrays arrays_of(const py::dict& given, std::size_t count, const Camera& camera) {
    const std::vector<py::ssize_t> pixels{static_cast<py::ssize_t>(count), camera.height, camera.width};
    const auto shape = [&pixels](py::ssize_t values) {
        std::vector<py::ssize_t> all = pixels;
        all.push_back(values);
        return all;
    };
    FrameArrays to;
    for (const auto& [key, value] : given) {
        const auto name = key.cast<std::string>();
        if (name == "rgb" && camera.bits == 16) {
            to.rgb16 = memory_of<std::uint16_t>(value, name, shape(3));
        } else if (name == "rgb") {
            to.rgb = memory_of<std::uint8_t>(value, name, shape(3));
        } else if (name == "depth_m") {
            to.depth_m = memory_of<float>(value, name, pixels);
        } else if (name == "class_id") {
            to.class_id = memory_of<std::uint8_t>(value, name, pixels);
        } else if (name == "object_id") {
            to.object_id = memory_of<std::uint32_t>(value, name, pixels);
        } else if (name == "normal") {
            to.normal = memory_of<float>(value, name, shape(3));
        } else if (name == "flow_px") {
            to.flow_px = memory_of<float>(value, name, shape(2));
        } else if (name == "coverage") {
            to.coverage = memory_of<float>(value, name, pixels);
        } else {
            refuse(
                "outputs: expected rgb, depth_m, class_id, object_id, normal, flow_px or coverage, got '" + name + "'");
        }
    }
    return to;
}

void render(const OpenWorld& open, const Camera& camera, const py::object& eye, const py::object& look,
    const py::dict& arrays, const py::kwargs& given) {
    const std::shared_ptr<const World> world = open.get();
    RenderCall call = call_of(eye, look, given);
    const FrameArrays to = arrays_of(arrays, call.poses.size(), camera);
    StopCheck check;
    call.options.states = call.states;
    call.options.previous_states = call.previous_states;
    call.options.is_stopped = check.function();
    const py::gil_scoped_release unlocked;
    world->render(camera, call.poses, to, call.options);
}

std::vector<std::vector<Box>> boxes(const OpenWorld& open, const Camera& camera, const py::object& eye,
    const py::object& look, const py::kwargs& given) {
    const std::shared_ptr<const World> world = open.get();
    RenderCall call = call_of(eye, look, given);
    StopCheck check;
    call.options.states = call.states;
    call.options.previous_states = call.previous_states;
    call.options.is_stopped = check.function();
    const py::gil_scoped_release unlocked;
    return world->boxes(camera, call.poses, call.options);
}

py::array_t<double> heights(const OpenWorld& open, const py::object& x_m, const py::object& y_m) {
    const std::shared_ptr<const World> world = open.get();
    const Numbers x = finite_numbers(x_m, "x_m");
    const Numbers y = finite_numbers(y_m, "y_m");
    if (x.size() != y.size()) {
        refuse(
            "y_m: expected " + std::to_string(x.size()) + " values, as many as x_m, got " + std::to_string(y.size()));
    }
    py::array_t<double> result(x.size());
    for (py::ssize_t i = 0; i < x.size(); ++i) { result.mutable_data()[i] = world->height_m(x.data()[i], y.data()[i]); }
    return result;
}

py::array_t<double> random_positions(
    const OpenWorld& open, std::size_t count, double least_m, double most_m, std::uint64_t seed) {
    const std::vector<Vec3> positions = open.get()->random_positions(count, least_m, most_m, seed);
    py::array_t<double> result = new_rows(positions.size(), 3);
    for (std::size_t i = 0; i < positions.size(); ++i) { write(positions[i], result.mutable_data() + 3 * i); }
    return result;
}

/// Calls `change` with three numbers of each row and returns its results.
template <class Change>
py::array_t<double> changed(const py::object& value, const char* name, const Change& change) {
    const Rows rows(value, name, 3);
    py::array_t<double> result = new_rows(rows.count(), 3);
    for (std::size_t i = 0; i < rows.count(); ++i) { write(change(rows[i]), result.mutable_data() + 3 * i); }
    return result;
}

py::tuple corner_tuple(const double* px) { return py::make_tuple(px[0], px[1], px[2], px[3]); }

py::array_t<double> corners_of(const Box& box) {
    py::array_t<double> corners = new_rows(8, 3);
    for (std::size_t i = 0; i < 8; ++i) { write(box.corners_m[i], corners.mutable_data() + 3 * i); }
    return corners;
}

void bind_boxes(py::module_& module) {
    py::class_<Box>(module, "Box", "What a picture shows of an object.")
        .def_readonly("object_id", &Box::object_id, "World.objects[object_id - 1] is the object.")
        .def_property_readonly(
            "visible_px", [](const Box& box) { return corner_tuple(box.visible_px); },
            "Left, top, right, bottom of its visible pixels; right and bottom exclusive.")
        .def_property_readonly(
            "whole_px", [](const Box& box) { return corner_tuple(box.whole_px); },
            "Left, top, right, bottom of its projected corners, also outside the picture.")
        .def_property_readonly("corners_m", &corners_of,
            "(8, 3) float64, world axes; bits 0, 1, 2 of a corner's number are x, y, z of body axes.")
        .def_readonly("visible_share", &Box::visible_share,
            "Visible pixels over those that it would have alone, outside the picture too.")
        .def_readonly("truncation", &Box::truncation, "The share of these that lies outside the picture.")
        .def_readonly("distance_m", &Box::distance_m, "Of its middle, metres.")
        .def_readonly("pixels", &Box::pixels, "Visible ones.")
        .def("__repr__", [](const Box& box) {
            return "<octant.Box of object " + std::to_string(box.object_id) + ", " + std::to_string(box.pixels) +
                   " pixels>";
        });
    py::class_<Object>(module, "Object", "A thing that object ids name.")
        .def_readonly("name", &Object::name, "Unique in the world.")
        .def_readonly("kind", &Object::kind, "Its entry of World(aircraft=...), as \"f15\".")
        .def_property_readonly(
            "class_id", [](const Object& object) { return static_cast<int>(object.surface); },
            "Number of its class in octant.classes.")
        .def_property_readonly(
            "size_m", [](const Object& object) { return array_of(object.size_m); },
            "(3,) float64, of its box in body axes, metres.")
        .def_property_readonly(
            "box_centre_m", [](const Object& object) { return array_of(object.box_centre_m); },
            "(3,) float64, body axes, metres.")
        .def("__repr__", [](const Object& object) { return "<octant.Object " + object.name + ">"; });
}

} // namespace

void bind_world(py::module_& module) {
    bind_boxes(module);
    py::class_<OpenWorld>(module, "World", "What octant.World is made of.")
        .def_property_readonly("is_closed", &OpenWorld::is_closed, "Whether close() was called.")
        .def("close", &OpenWorld::close, "Gives it up.")
        .def(
            "copy", [](const OpenWorld& open) { return OpenWorld(std::make_shared<const World>(*open.get())); },
            "Shares everything but the states.")
        .def("height_m", &heights, py::arg("x_m"), py::arg("y_m"), "Of flat arrays.")
        .def(
            "half_extent_m", [](const OpenWorld& open) { return open.get()->half_extent_m(); }, "East and north.")
        .def("random_positions", &random_positions, py::arg("count"), py::arg("least_m"), py::arg("most_m"),
            py::arg("seed"), "Rows of positions.")
        .def(
            "local",
            [](const OpenWorld& open, const py::object& place) {
                const auto world = open.get();
                return changed(place, "place", [&](const double* at) { return world->local(at[0], at[1], at[2]); });
            },
            py::arg("place"), "Of rows of latitude, longitude and height.")
        .def(
            "geodetic",
            [](const OpenWorld& open, const py::object& position_m) {
                const auto world = open.get();
                return changed(
                    position_m, "position_m", [&](const double* at) { return world->geodetic(vector_of(at)); });
            },
            py::arg("position_m"), "Of rows of positions.")
        .def(
            "objects", [](const OpenWorld& open) { return open.get()->objects(); }, "In the order of their ids.")
        .def(
            "set_states", [](OpenWorld& open, const py::object& states) { open.set_states(states_of(states)); },
            py::arg("states"), "One for each aircraft.")
        .def(
            "states",
            [](const OpenWorld& open) {
                const auto world = open.get();
                return arrays_of_states({world->states().begin(), world->states().end()});
            },
            "Arrays by name.")
        .def(
            "path_states",
            [](const OpenWorld& open, double rate_hz) { return arrays_of_states(path_states(*open.get(), rate_hz)); },
            py::arg("rate_hz"), "Arrays by name.")
        .def("render", &render, py::arg("camera"), py::arg("eye"), py::arg("look"), py::arg("arrays"),
            "Writes into the arrays.")
        .def("boxes", &boxes, py::arg("camera"), py::arg("eye"), py::arg("look"), "A list for each picture.")
        .def(
            "export_scene",
            [](const OpenWorld& open, const std::string& path, const Camera& camera, const py::object& eye,
                const py::object& look) {
                const auto world = open.get();
                const std::vector<Pose> poses = poses_of(eye, look, {});
                if (poses.size() != 1) { refuse("eye: expected one eye point, got " + std::to_string(poses.size())); }
                const py::gil_scoped_release unlocked;
                world->export_scene(path, camera, poses.front());
            },
            py::arg("path"), py::arg("camera"), py::arg("eye"), py::arg("look"), "As OBJ.");
    module.def("load", &load, py::arg("terrain"), py::arg("aircraft"), py::arg("settings"), py::arg("shared"),
        "A world and the notes for its user.");
}

} // namespace octant::python
