// FlightGear's model files: a PropertyList that names a mesh, other models with their offsets, and
// animations, which are read as at rest: all properties 0. Its axes are x back, y right, z up; AC3D
// files lie in them as (x, -z, y).
#include "models/meshfile/flightgear_conditions.h"
#include "models/meshfile/flightgear_paths.h"
#include "models/meshfile/mesh_file.h"
#include "models/meshfile/mesh_formats.h"
#include "models/meshfile/mesh_join.h"
#include "models/meshfile/placement.h"
#include "models/meshfile/word_scanner.h"
#include "models/meshfile/xml_tree.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"

#include <glm/mat3x3.hpp>

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>
#include <string>

namespace octant::models::meshfile {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_file_bytes = std::size_t{64} << 20U;
constexpr int most_depth = 8;
constexpr std::size_t most_models = 500;

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

    TriangleMesh read() {
        take_model(path_, {}, 0);
        TriangleMesh mesh = std::move(joined_);
        mesh.name = path_.stem().string();
        if (mesh.triangles.empty()) {
            error_in(path_, "expected a model with a mesh, got none");
        }
        if (!at_rest_.empty()) {
            std::string kinds;
            for (const auto& [kind, count] : at_rest_) {
                kinds += fmt::format("{}{} {}", kinds.empty() ? "" : ", ", count, printable(kind));
            }
            mesh.notes.push_back(
                fmt::format("{}: animations are left at rest: {}", path_.string(), kinds));
        }
        return mesh;
    }

private:
    double number(const fs::path& file, const XmlElement& parent, std::string_view name) const {
        const XmlElement* found = parent.find(name);
        if (found == nullptr || found->text.empty()) {
            return 0.0;
        }
        const auto value = finite_number(found->text);
        if (!value || std::abs(*value) > most_coordinate) {
            error_at(file, found->line, "expected a number, got " + in_quotes(found->text));
        }
        return *value;
    }

    Placement offsets(const fs::path& file, const XmlElement& parent) const {
        const XmlElement* found = parent.find("offsets");
        if (found == nullptr) {
            return {};
        }
        const auto angle_rad = [&](std::string_view name) {
            return rad_from_deg(number(file, *found, name));
        };
        const glm::dmat3 turn = turn_about(2, angle_rad("heading-deg")) *
                                turn_about(1, angle_rad("pitch-deg")) *
                                turn_about(0, angle_rad("roll-deg"));
        return {
            turn,
            {number(file, *found, "x-m"),
             number(file, *found, "y-m"),
             number(file, *found, "z-m")}};
    }

    void take_model(const fs::path& file, const Placement& parent, int depth) {
        if (ending_of(file) != ".xml") {
            add_mesh(file, parent, {});
            return;
        }
        if (depth > most_depth || ++models_ > most_models) {
            error_in(file, fmt::format("expected models at most {} deep, got more", most_depth));
        }
        const std::string text = read_text_file(file, largest_file_bytes);
        const XmlElement root = xml_tree(file, text);
        const Placement own = parent.of(offsets(file, root));
        const std::set<std::string> hidden = hidden_objects(file, root);
        if (hidden.contains("") && depth > 0) {
            return;
        }
        if (const std::string name(root.text_of("path")); !name.empty()) {
            take_named(file, name, own, hidden, depth);
        }
        for (const XmlElement& child : root.children) {
            const std::string name(child.text_of("path"));
            const bool is_shown = holds_at_rest(child) && !is_hidden_model(child, hidden);
            if (child.name == "model" && !name.empty() && is_shown) {
                take_named(file, name, own.of(offsets(file, child)), {}, depth);
            }
        }
    }

    void take_named(
        const fs::path& from,
        const std::string& name,
        const Placement& placement,
        const std::set<std::string>& hidden,
        int depth) {
        const fs::path file = flightgear_file(from, name);
        if (file.empty() && depth == 0 && joined_.triangles.empty()) {
            error_in(from, "expected a file of its path, got none called " + in_quotes(name));
        }
        if (file.empty()) {
            note_once(fmt::format("{}: no file of path '{}'", from.string(), printable(name)));
        } else if (ending_of(file) == ".xml") {
            take_model(file, placement, depth + 1);
        } else if (is_mesh_file(file)) {
            add_mesh(file, placement, hidden);
        } else {
            note_once(file.string() + ": sub-models of this kind are left out");
        }
    }

    void add_mesh(
        const fs::path& file, const Placement& placement, const std::set<std::string>& hidden) {
        ReadOptions options = options_;
        options.left_out = hidden;
        options.is_part = true;
        TriangleMesh mesh;
        try {
            mesh = read_mesh(file, options);
        } catch (const Error& fault) {
            note_once(fmt::format("{}; this sub-model is left out", fault.what()));
            return;
        }
        const bool is_ac3d = ending_of(file) == ".ac";
        const glm::dmat3 from_ac3d(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0));
        join_mesh(joined_, std::move(mesh), placement.of({is_ac3d ? from_ac3d : glm::dmat3(1.0)}));
    }

    void note_once(const std::string& note) {
        if (told_.insert(note).second) {
            joined_.notes.push_back(note);
        }
    }

    static bool is_hidden_model(const XmlElement& model, const std::set<std::string>& hidden) {
        const std::string name(model.text_of("name"));
        return !name.empty() && hidden.contains(name);
    }

    /// Objects that a range shows only to eyes farther away, or that a select hides at rest; an
    /// empty name stands for all of the model. Other animations are counted.
    std::set<std::string> hidden_objects(const fs::path& file, const XmlElement& root) {
        std::set<std::string> objects;
        for (const XmlElement& child : root.children) {
            if (child.name != "animation") {
                continue;
            }
            const std::string kind(child.text_of("type"));
            const bool is_range = kind == "range";
            if (!is_range && kind != "select") {
                ++at_rest_[kind.empty() ? "without a type" : kind];
                continue;
            }
            if (is_range ? number(file, child, "min-m") <= 0.0 : holds_at_rest(child)) {
                continue;
            }
            if (child.find("object-name") == nullptr) {
                objects.insert("");
            }
            for (const XmlElement& named : child.children) {
                if (named.name == "object-name") {
                    objects.insert(named.text);
                }
            }
        }
        return objects;
    }

    fs::path path_;
    ReadOptions options_;
    TriangleMesh joined_;
    std::size_t models_ = 0;
    std::map<std::string, int> at_rest_; ///< animations, by their types
    std::set<std::string> told_;
};

} // namespace

TriangleMesh read_flightgear_model(const fs::path& path, const ReadOptions& options) {
    return FlightGearReading(path, options).read();
}

} // namespace octant::models::meshfile
