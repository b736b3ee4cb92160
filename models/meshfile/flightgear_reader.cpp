// FlightGear's model files: a PropertyList that names a mesh, other models with their offsets, and
// animations, which are read as at rest: all properties 0, but for what turns in flight. Its axes
// are x back, y right, z up; AC3D files lie in them as (x, -z, y).
#include "models/meshfile/flightgear_animations.h"
#include "models/meshfile/flightgear_conditions.h"
#include "models/meshfile/flightgear_numbers.h"
#include "models/meshfile/flightgear_paths.h"
#include "models/meshfile/flightgear_tree.h"
#include "models/meshfile/mesh_file.h"
#include "models/meshfile/mesh_formats.h"
#include "models/meshfile/mesh_append.h"
#include "models/meshfile/mesh_parts.h"
#include "models/meshfile/affine_transform.h"
#include "models/meshfile/rotating_model.h"
#include "models/meshfile/word_scanner.h"
#include "models/meshfile/xml_tree.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace octant::models::meshfile {

namespace {

namespace fs = std::filesystem;

constexpr int max_model_depth = 8;
constexpr std::size_t max_models = 500;
constexpr std::size_t max_notes = 20;

/// Columns: where x, y and z of AC3D files point in a model.
const glm::dmat3 from_ac3d(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0));

glm::dmat3 turn_about(int axis, double angle_rad) {
    glm::dmat3 turn(1.0);
    const int next = (axis + 1) % 3;
    const int last = (axis + 2) % 3;
    turn[next][next] = turn[last][last] = std::cos(angle_rad);
    turn[next][last] = std::sin(angle_rad);
    turn[last][next] = -std::sin(angle_rad);
    return turn;
}

class FlightGearReading {
public:
    FlightGearReading(const fs::path& path, const ReadOptions& options)
        : path_(path)
        , options_(options) {}

    RotatingModel read() {
        take_model(model_file(), {}, nullptr, 0);
        if (model_.body.triangles.empty()) { // all of it turns: then none of it does
            for (RotatingPart& part : std::exchange(model_.parts, {})) {
                join_mesh(model_.body, std::move(part.mesh), {});
            }
        }
        if (model_.body.triangles.empty()) {
            join_mesh(model_.body, std::exchange(model_.clear, {}).mesh, {});
        }
        if (model_.body.triangles.empty()) {
            throw_error_in(path_, "expected a model with a mesh, got none");
        }
        if (const std::size_t all = model_.body.notes.size(); all > max_notes) {
            model_.body.notes.resize(max_notes);
            model_.body.notes.push_back(fmt::format(
                "{}: {} more notes on its sub-models", path_.string(), all - max_notes));
        }
        model_.body.name = path_.stem().string();
        if (!at_rest_.empty()) {
            std::string kinds;
            for (const auto& [kind, count] : at_rest_) {
                kinds += fmt::format("{}{} {}", kinds.empty() ? "" : ", ", count, printable(kind));
            }
            model_.body.notes.push_back(
                fmt::format("{}: animations are left at rest: {}", path_.string(), kinds));
        }
        return std::move(model_);
    }

private:
    /// An aircraft's own file, such as b25-set.xml, names its model among much else.
    fs::path model_file() const {
        if (!path_.filename().string().ends_with("-set.xml")) {
            return path_;
        }
        const XmlElement root = flightgear_tree(path_);
        for (const XmlElement& sim : root.children) {
            const XmlElement* model = sim.name == "sim" ? sim.find("model") : nullptr;
            const std::string name(model == nullptr ? "" : model->text_of("path"));
            if (name.empty()) {
                continue;
            }
            fs::path file = flightgear_file(path_, name);
            if (file.empty()) {
                throw_error_in(
                    path_,
                    "expected a file of its sim/model/path, got none called " + in_quotes(name));
            }
            return file;
        }
        throw_error_in(path_, "expected a model's path in sim/model, got none");
    }

    AffineTransform offsets(const fs::path& file, const XmlElement& parent) const {
        const XmlElement* found = parent.find("offsets");
        if (found == nullptr) {
            return {};
        }
        const auto angle_rad = [&](std::string_view name) {
            return rad_from_deg(number_in(file, *found, name));
        };
        const glm::dmat3 turn = turn_about(2, angle_rad("heading-deg")) *
                                turn_about(1, angle_rad("pitch-deg")) *
                                turn_about(0, angle_rad("roll-deg"));
        return {
            turn,
            {number_in(file, *found, "x-m"),
             number_in(file, *found, "y-m"),
             number_in(file, *found, "z-m")}};
    }

    /// `about`: what turns all of it; null for what does not turn as a whole.
    void
    take_model(const fs::path& file, const AffineTransform& parent, const RotationAxis* about, int depth) {
        if (extension_of(file) != ".xml") {
            add_mesh(file, parent, {}, about);
            return;
        }
        if (depth > max_model_depth || ++models_ > max_models) {
            throw_error_in(
                file, fmt::format("expected models at most {} deep, got more", max_model_depth));
        }
        const XmlElement root = flightgear_tree(file);
        AffineTransform own = parent.of(offsets(file, root));
        const FlightGearAnimations animated = animations_of(file, root, own);
        if (animated.hidden.contains("") && depth > 0) {
            return;
        }
        about = about == nullptr ? animated.axis_of("") : about;
        options_.pictures_in = flightgear_pictures(file, std::string(root.text_of("texture-path")));
        if (const std::string name(root.text_of("path")); !name.empty()) {
            if (depth == 0 && flightgear_file(file, name).empty()) {
                throw_error_in(file, "expected a file of its path, got none called " + in_quotes(name));
            }
            take_named(file, name, own, animated, about, depth);
        }
        options_.pictures_in.clear();
        for (const XmlElement& child : root.children) {
            const std::string path(child.text_of("path"));
            const std::string name(child.text_of("name"));
            const bool is_hidden = !name.empty() && animated.hidden.contains(name);
            if (child.name == "model" && !path.empty() && !is_hidden && holds_at_rest(child)) {
                const RotationAxis* turned =
                    about == nullptr && !name.empty() ? animated.axis_of(name) : about;
                const AffineTransform moved = name.empty() ? own : own.of(animated.place_of(name));
                take_named(file, path, moved.of(offsets(file, child)), {}, turned, depth);
            }
        }
    }

    /// Also moves `own`, the model, to where it stands at rest.
    FlightGearAnimations
    animations_of(const fs::path& file, const XmlElement& root, AffineTransform& own) {
        FlightGearAnimations animated = flightgear_animations(file, root);
        own = own.of(animated.place_of(""));
        for (FlightGearRotation& turn : animated.turns) {
            turn.about.point_m = own.turn * turn.about.point_m + own.shift_m;
            turn.about.direction = own.turn * turn.about.direction;
        }
        for (const auto& [kind, count] : animated.at_rest) {
            at_rest_[kind] += count;
        }
        std::ranges::for_each(animated.notes, [&](const std::string& note) { note_once(note); });
        return animated;
    }

    void take_named(
        const fs::path& from,
        const std::string& name,
        const AffineTransform& placement,
        const FlightGearAnimations& animated,
        const RotationAxis* about,
        int depth) {
        const fs::path file = flightgear_file(from, name);
        if (file.empty()) {
            note_once(fmt::format("{}: no file of path '{}'", from.string(), printable(name)));
        } else if (extension_of(file) == ".xml") {
            take_sub_model(file, placement, about, depth + 1);
        } else if (is_mesh_file(file)) {
            add_mesh(file, placement, animated, about);
        } else {
            note_once(file.string() + ": sub-models of this kind are left out");
        }
    }

    /// A faulty file below the first one costs itself alone.
    void take_sub_model(
        const fs::path& file, const AffineTransform& placement, const RotationAxis* about, int depth) {
        try {
            take_model(file, placement, about, depth);
        } catch (const Error& fault) {
            note_once(fmt::format("{}; what else is in there is left out", fault.what()));
        }
    }

    void add_mesh(
        const fs::path& file,
        const AffineTransform& placement,
        const FlightGearAnimations& animated,
        const RotationAxis* about) {
        if (!animated.turns.empty() && extension_of(file) != ".ac") {
            note_once(file.string() + ": its objects are not told apart, so none of them turns");
        }
        ReadOptions options = options_;
        options.excluded = animated.hidden;
        for (const FlightGearRestPlacement& move : animated.moves) {
            for (const std::string& object : move.objects) {
                options.moved[object] = in_ac3d(animated.place_of(object));
            }
        }
        for (const FlightGearRotation& turn : animated.turns) {
            if (about == nullptr) {
                options.groups.push_back(turn.objects);
            }
        }
        try {
            MeshParts parts = read_parts(file, options);
            const AffineTransform placed = in_model(file, placement);
            join_mesh(
                about == nullptr ? model_.body : part_about(*about), std::move(parts.body), placed);
            for (std::size_t i = 0; i < parts.groups.size(); ++i) {
                if (!parts.groups[i].triangles.empty()) {
                    join_mesh(
                        part_about(animated.turns[i].about), std::move(parts.groups[i]), placed);
                }
            }
            join_clear(std::move(parts.clear), placed);
        } catch (const Error& fault) {
            note_once(fmt::format("{}; this sub-model is left out", fault.what()));
        }
    }

    void join_clear(TransparentSurfaces more, const AffineTransform& placed) {
        const std::size_t count = more.mesh.triangles.size();
        if (count == 0) {
            return;
        }
        TransparentSurfaces& all = model_.clear;
        join_mesh(all.mesh, std::move(more.mesh), placed);
        const float share =
            static_cast<float>(count) / static_cast<float>(all.mesh.triangles.size());
        all.opacity = all.mesh.triangles.size() == count
                          ? more.opacity
                          : all.opacity + (more.opacity - all.opacity) * share;
    }

    /// A move within a model, within an AC3D file.
    static AffineTransform in_ac3d(const AffineTransform& in_model) {
        return {
            glm::transpose(from_ac3d) * in_model.turn * from_ac3d,
            glm::transpose(from_ac3d) * in_model.shift_m};
    }

    static AffineTransform in_model(const fs::path& file, const AffineTransform& placement) {
        return placement.of({extension_of(file) == ".ac" ? from_ac3d : glm::dmat3(1.0)});
    }

    /// The mesh of what turns about an axis: of several blades it is the same.
    TriangleMesh& part_about(const RotationAxis& about) {
        constexpr double near_m = 0.01;
        for (RotatingPart& part : model_.parts) {
            const glm::dvec3 across_m =
                glm::cross(part.about.direction, about.point_m - part.about.point_m);
            if (glm::dot(part.about.direction, about.direction) > 1.0 - 1e-6 &&
                glm::length(across_m) < near_m &&
                std::abs(part.about.turns_per_s - about.turns_per_s) < 1e-9) {
                return part.mesh;
            }
        }
        return model_.parts.emplace_back(RotatingPart{{}, about}).mesh;
    }

    void note_once(const std::string& note) {
        if (told_.insert(note).second) {
            model_.body.notes.push_back(note);
        }
    }

    fs::path path_;
    ReadOptions options_;
    RotatingModel model_;
    std::size_t models_ = 0;
    std::map<std::string, int> at_rest_; ///< animations, by their types
    std::set<std::string> told_;
};

} // namespace

RotatingModel read_rotating_model(const fs::path& path, const ReadOptions& options) {
    if (extension_of(path) == ".xml") {
        return FlightGearReading(path, options).read();
    }
    ReadOptions alone = options;
    alone.placeholders = false;
    MeshParts parts = read_parts(path, alone);
    if (parts.body.triangles.empty()) { // then nothing is to be seen through the rest
        return {read_mesh(path, options), {}, {}};
    }
    return {std::move(parts.body), {}, std::move(parts.clear)};
}

TriangleMesh read_flightgear_model(const fs::path& path, const ReadOptions& options) {
    RotatingModel model = read_rotating_model(path, options);
    for (RotatingPart& part : model.parts) {
        join_mesh(model.body, std::move(part.mesh), {});
    }
    join_mesh(model.body, std::move(model.clear.mesh), {});
    return std::move(model.body);
}

} // namespace octant::models::meshfile
