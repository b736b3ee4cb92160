// FlightGear's model files: a PropertyList that names a mesh, other models with their offsets, and animations, which
// are read as at rest (RestingProperties), but for what turns in flight. Its axes are x back, y right, z up; AC3D files
// lie in them as (x, -z, y).
#include "models/meshfile/flightgear_animations.h"
#include "models/meshfile/flightgear_xml.h"
#include "models/meshfile/mesh_builder.h"
#include "models/meshfile/mesh_file.h"
#include "models/meshfile/mesh_formats.h"
#include "models/meshfile/mesh_join.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"

#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::models::meshfile {

namespace {

namespace fs = std::filesystem;

constexpr int max_include_depth = 8;
constexpr int max_files = 500;

XmlElement with_includes(const fs::path& file, int depth, int& files);

void include_into(XmlElement& element, int depth, int& files) {
    const fs::path included = element.include.empty() ? fs::path() : flightgear_file(*element.file, element.include);
    if (included.empty()) { return; }
    if (depth == max_include_depth) { element.refuse(fmt::format("includes at most {} deep", depth), "more"); }
    if (++files > max_files) { element.refuse(fmt::format("at most {} includes", max_files), "more"); }
    XmlElement other = with_includes(included, depth + 1, files);
    element.children.insert(element.children.end(), std::make_move_iterator(other.children.begin()),
        std::make_move_iterator(other.children.end()));
}

XmlElement with_includes(const fs::path& file, int depth, int& files) {
    XmlElement root = read_xml(file);
    for (XmlElement& child : root.children) { include_into(child, depth, files); }
    include_into(root, depth, files);
    return root;
}

/// Reads a FlightGear file. Elements that the outermost element or one of its children includes from another file are
/// appended to its own; an included file that does not exist is skipped. Throws Error for files that cannot be read,
/// and for includes more than 8 deep or 500 in all.
XmlElement flightgear_tree(const fs::path& file) {
    int files = 0;
    return with_includes(file, 0, files);
}

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
    FlightGearReading(const fs::path& path, const ReadOptions& options) : path_(path), options_(options) {}

    RotatingModel read() {
        take_model(model_file(), {}, 0);
        join_turning();
        if (model_.body.triangles.empty()) { // all of it moves: then none of it does
            const std::vector<RotatingPart> parts = std::exchange(model_.parts, {});
            const TriangleMesh clear = std::exchange(model_.clear, {});
            model_.body = mesh_at_rest({std::move(model_.body), parts, clear});
        }
        if (model_.body.triangles.empty()) { throw_error_in(path_, "expected a model with a mesh, got none"); }
        if (const std::size_t all = model_.body.notes.size(); all > max_notes) {
            model_.body.notes.resize(max_notes);
            model_.body.notes.push_back(
                fmt::format("{}: {} more notes on its sub-models", path_.string(), all - max_notes));
        }
        model_.body.name = path_.stem().string();
        if (!at_rest_.empty()) {
            std::string kinds;
            for (const auto& [kind, count] : at_rest_) {
                kinds += fmt::format("{}{} {}", kinds.empty() ? "" : ", ", count, printable(kind));
            }
            model_.body.notes.push_back(fmt::format("{}: animations are left at rest: {}", path_.string(), kinds));
        }
        return std::move(model_);
    }

private:
    /// An aircraft's own file, such as b25-set.xml, names its model among much else.
    fs::path model_file() {
        if (!path_.filename().string().ends_with("-set.xml")) { return path_; }
        const XmlElement root = flightgear_tree(path_);
        properties_.take(root, "");
        for (const XmlElement& sim : root.children) {
            const XmlElement* model = sim.name == "sim" ? sim.find("model") : nullptr;
            const XmlElement* named = model == nullptr ? nullptr : model->find("path");
            if (named == nullptr || named->text.empty()) { continue; }
            fs::path file = flightgear_file(path_, named->text);
            if (file.empty()) {
                named->refuse("a file of its sim/model/path", "none called " + in_quotes(named->text));
            }
            return file;
        }
        throw_error_in(path_, "expected a model's path in sim/model, got none");
    }

    AffineTransform offsets(const XmlElement& parent) const {
        const XmlElement* found = parent.find("offsets");
        if (found == nullptr) { return {}; }
        const auto angle_rad = [&](std::string_view name) { return rad_from_deg(number_in(*found, name)); };
        const glm::dmat3 turn = turn_about(2, angle_rad("heading-deg")) * turn_about(1, angle_rad("pitch-deg")) *
                                turn_about(0, angle_rad("roll-deg"));
        return {turn, {number_in(*found, "x-m"), number_in(*found, "y-m"), number_in(*found, "z-m")}};
    }

    /// Animations of a model that holds others, without those that it inherits, and where that model stands.
    struct OuterAnimations {
        const FlightGearAnimations* own = nullptr;
        AffineTransform placement;
    };

    /// What a model inherits from those that hold it.
    struct Inherited {
        AffineTransform placement;
        const FlightGearRotation* about = nullptr; ///< what turns all of it; null for what does not turn as a whole
        PartMoves moves;                           ///< axes of the whole
        /// The animations of the models that hold it, the innermost last.
        std::vector<OuterAnimations> outer = {};
    };

    void take_model(const fs::path& file, const Inherited& parent, int depth) {
        if (extension_of(file) != ".xml") {
            add_mesh(file, parent, {});
            return;
        }
        if (depth > max_model_depth || ++models_ > max_models) {
            throw_error_in(file, fmt::format("expected models at most {} deep, got more", max_model_depth));
        }
        const XmlElement root = flightgear_tree(file);
        Inherited own = parent;
        own.placement = parent.placement.of(offsets(root));
        const FlightGearAnimations own_animations = animations_of(root, own);
        const std::string mesh(root.text_of("path"));
        FlightGearAnimations animated = own_animations;
        if (!own.outer.empty()) {
            ObjectNames names = object_names_in(flightgear_file(file, mesh));
            for (const XmlElement& child : root.children) {
                if (child.name == "model") { names.emplace(child.text_of("name")); }
            }
            names.erase("");
            add_outer(own, names, animated);
        }
        if (animated.hidden.contains("") && depth > 0) { return; }
        if (own.about == nullptr) { own.about = animated.turn_of(""); }
        options_.pictures_in = flightgear_pictures(file, std::string(root.text_of("texture-path")));
        if (!mesh.empty()) {
            if (depth == 0 && flightgear_file(file, mesh).empty()) {
                root.find("path")->refuse("a file of its path", "none called " + in_quotes(mesh));
            }
            for (const auto& [object, picture] : animated.pictures) {
                const fs::path found = picture_file(file, picture, file.parent_path());
                if (std::error_code ignored; fs::is_regular_file(found, ignored)) {
                    options_.repainted[object] = fs::absolute(found).string();
                }
            }
            Inherited of_mesh = own;
            of_mesh.outer.clear(); // `animated` has them
            take_named(file, mesh, of_mesh, animated, depth);
        }
        options_.repainted.clear();
        options_.pictures_in.clear();
        for (const XmlElement& child : root.children) {
            const std::string path(child.text_of("path"));
            const std::string name(child.text_of("name"));
            const bool is_hidden = !name.empty() && animated.hidden.contains(name);
            if (child.name == "model" && !path.empty() && !is_hidden && is_there(child)) {
                Inherited moved = own;
                moved.outer.push_back({&own_animations, own.placement});
                if (!name.empty()) {
                    if (own.about == nullptr) { moved.about = animated.turn_of(name); }
                    add_moves(placed_moves(animated.moves_of(name), own.placement), moved.moves);
                    moved.placement = own.placement.of(animated.place_of(name));
                }
                moved.placement = moved.placement.of(offsets(child));
                take_named(file, path, moved, {}, depth);
            }
        }
    }

    /// Whether a sub-model is there at rest; one with a faulty condition is.
    bool is_there(const XmlElement& model) {
        try {
            return holds_at_rest(model, properties_);
        } catch (const Error& fault) {
            note_once(fmt::format("{}; this sub-model is always shown", fault.what()));
            return true;
        }
    }

    static void add_moves(PartMoves inner, PartMoves& moves) {
        moves.insert(moves.end(), std::make_move_iterator(inner.begin()), std::make_move_iterator(inner.end()));
    }

    /// The names of the objects in an AC3D file; none of other files, whose objects are not told apart, and of faulty
    /// ones, whose fault add_mesh() tells.
    static ObjectNames object_names_in(const fs::path& file) {
        if (extension_of(file) != ".ac") { return {}; }
        try {
            return ac3d_object_names(file);
        } catch (const Error&) { return {}; }
    }

    /// Adds what the models that hold one do to what has these names in it.
    static void add_outer(const Inherited& own, const ObjectNames& names, FlightGearAnimations& animated) {
        for (auto outer = own.outer.rbegin(); outer != own.outer.rend(); ++outer) {
            const glm::dmat3 back = glm::inverse(outer->placement.turn);
            const AffineTransform from_whole{back, -(back * outer->placement.shift_m)};
            animated.add_outer(*outer->own, from_whole.of(own.placement), names);
        }
    }

    /// Also moves `own`, the model, to where it stands at rest, and adds what moves all of it.
    FlightGearAnimations animations_of(const XmlElement& root, Inherited& own) {
        FlightGearAnimations animated = flightgear_animations(root, properties_);
        add_moves(placed_moves(animated.moves_of(""), own.placement), own.moves);
        own.placement = own.placement.of(animated.place_of(""));
        for (FlightGearRotation& turn : animated.turns) {
            turn.about.point_m = own.placement.turn * turn.about.point_m + own.placement.shift_m;
            turn.about.direction = own.placement.turn * turn.about.direction;
        }
        for (const auto& [kind, count] : animated.at_rest) { at_rest_[kind] += count; }
        std::ranges::for_each(animated.notes, [&](const std::string& note) { note_once(note); });
        return animated;
    }

    void take_named(const fs::path& from, const std::string& name, const Inherited& inherited,
        FlightGearAnimations animated, int depth) {
        const fs::path file = flightgear_file(from, name);
        if (file.empty()) {
            note_once(fmt::format("{}: no file of path '{}'", from.string(), printable(name)));
        } else if (extension_of(file) == ".xml") {
            take_sub_model(file, inherited, depth + 1);
        } else if (is_mesh_file(file)) {
            if (!inherited.outer.empty()) { add_outer(inherited, object_names_in(file), animated); }
            add_mesh(file, inherited, animated);
        } else {
            note_once(file.string() + ": sub-models of this kind are left out");
        }
    }

    /// A faulty file below the first one costs itself alone.
    void take_sub_model(const fs::path& file, const Inherited& inherited, int depth) {
        try {
            take_model(file, inherited, depth);
        } catch (const Error& fault) { note_once(fmt::format("{}; what else is in there is left out", fault.what())); }
    }

    /// Objects that the same moves move, in axes of the whole.
    struct MovedObjects {
        ObjectNames objects;
        PartMoves moves;
    };

    static std::vector<MovedObjects> moved_objects(const FlightGearAnimations& animated, const Inherited& inherited) {
        std::vector<MovedObjects> moved;
        ObjectNames named;
        for (const FlightGearRestPlacement& move : animated.moves) {
            if (move.move) { named.insert(move.objects.begin(), move.objects.end()); }
        }
        named.erase("");
        for (const std::string& object : named) {
            PartMoves moves = inherited.moves;
            add_moves(placed_moves(animated.moves_of(object), inherited.placement), moves);
            if (moves.size() == inherited.moves.size()) { continue; }
            const auto known = std::ranges::find(moved, moves, &MovedObjects::moves);
            MovedObjects& group = known != moved.end() ? *known : moved.emplace_back(MovedObjects{{}, moves});
            group.objects.insert(object);
        }
        return moved;
    }

    void add_mesh(const fs::path& file, const Inherited& inherited, const FlightGearAnimations& animated) {
        const FlightGearRotation* about = inherited.about;
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
        std::vector<MovedObjects> moved;
        if (about == nullptr) {
            for (const FlightGearRotation& turn : animated.turns) { options.groups.push_back(turn.objects); }
            moved = moved_objects(animated, inherited);
            for (const MovedObjects& group : moved) { options.groups.push_back(group.objects); }
        }
        try {
            MeshParts parts = read_parts(file, options);
            const AffineTransform placed = in_model(file, inherited.placement);
            const bool moves = about != nullptr || !inherited.moves.empty();
            join_mesh(moves ? moving_mesh(about, inherited.moves) : model_.body, std::move(parts.body), placed);
            for (std::size_t i = 0; i < parts.groups.size(); ++i) {
                if (parts.groups[i].triangles.empty()) { continue; }
                const bool turns = i < animated.turns.size();
                join_mesh(turns ? moving_mesh(&animated.turns[i], inherited.moves)
                                : moving_mesh(nullptr, moved[i - animated.turns.size()].moves),
                    std::move(parts.groups[i]), placed);
            }
            join_mesh(model_.clear, std::move(parts.clear), placed);
        } catch (const Error& fault) { note_once(fmt::format("{}; this sub-model is left out", fault.what())); }
    }

    /// A move within a model, within an AC3D file.
    static AffineTransform in_ac3d(const AffineTransform& in_model) {
        return {glm::transpose(from_ac3d) * in_model.turn * from_ac3d, glm::transpose(from_ac3d) * in_model.shift_m};
    }

    static AffineTransform in_model(const fs::path& file, const AffineTransform& placement) {
        return placement.of({extension_of(file) == ".ac" ? from_ac3d : glm::dmat3(1.0)});
    }

    /// What turns and moves in one way, as it stands in its file and at rest.
    struct TurningMesh {
        FlightGearRotation turn;
        PartMoves moves;
        TriangleMesh mesh;
    };

    /// `about`: null for what does not turn by time.
    TriangleMesh& moving_mesh(const FlightGearRotation* about, const PartMoves& moves) {
        const FlightGearRotation turn = about == nullptr ? FlightGearRotation{} : *about;
        const auto known = std::ranges::find_if(turning_, [&](const TurningMesh& one) {
            return one.turn.about.point_m == turn.about.point_m && one.turn.about.direction == turn.about.direction &&
                   one.turn.about.turns_per_s == turn.about.turns_per_s && one.turn.blade == turn.blade &&
                   one.turn.rotor == turn.rotor && one.turn.first_angle_rad == turn.first_angle_rad &&
                   one.moves == moves;
        });
        return known != turning_.end() ? known->mesh : turning_.emplace_back(TurningMesh{turn, moves, {}}).mesh;
    }

    /// Turns blades to where they stand at time 0, evenly around their rotor's axis.
    void join_turning() {
        std::map<std::string, int> blades;
        for (const TurningMesh& one : turning_) {
            int& count = blades[one.turn.rotor];
            count = std::max(count, one.turn.blade.value_or(0) + 1);
        }
        for (TurningMesh& one : turning_) {
            const bool is_backward = one.turn.rotor.ends_with('-');
            const double share = static_cast<double>(one.turn.blade.value_or(0)) / blades[one.turn.rotor];
            const double angle_rad =
                one.turn.first_angle_rad + (is_backward ? -1.0 : 1.0) * share * rad_from_deg(360.0);
            const AffineTransform turned =
                angle_rad == 0.0 ? AffineTransform() : turned_about(one.turn.about, angle_rad);
            if (!one.mesh.triangles.empty()) {
                join_mesh(part_about(one.turn.about, one.moves), std::move(one.mesh), turned);
            }
        }
        turning_.clear();
    }

    /// The mesh of what turns about an axis: of several blades it is the same.
    TriangleMesh& part_about(const RotationAxis& about, const PartMoves& moves) {
        constexpr double near_m = 0.01;
        for (RotatingPart& part : model_.parts) {
            const glm::dvec3 across_m = glm::cross(part.about.direction, about.point_m - part.about.point_m);
            if (glm::dot(part.about.direction, about.direction) > 1.0 - 1e-6 && glm::length(across_m) < near_m &&
                std::abs(part.about.turns_per_s - about.turns_per_s) < 1e-9 && part.moves == moves) {
                return part.mesh;
            }
        }
        return model_.parts.emplace_back(RotatingPart{{}, about, moves}).mesh;
    }

    void note_once(const std::string& note) {
        if (told_.insert(note).second) { model_.body.notes.push_back(note); }
    }

    fs::path path_;
    ReadOptions options_;
    RotatingModel model_;
    RestingProperties properties_;
    std::vector<TurningMesh> turning_;
    std::size_t models_ = 0;
    std::map<std::string, int> at_rest_; ///< animations, by their types
    std::set<std::string> told_;
};

} // namespace

RotatingModel read_flightgear_model(const fs::path& path, const ReadOptions& options) {
    return FlightGearReading(path, options).read();
}

} // namespace octant::models::meshfile
