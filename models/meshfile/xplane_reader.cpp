// X-Plane's OBJ8 objects, by their published specification: vertices with normals and places on one picture, triangles
// by ranges of indices, and animations by datarefs: those of propellers, control surfaces, flaps and gear move parts in
// flight, all others are read as at rest, where datarefs are 0, seen from outside. An aircraft (.acf) names its
// objects.
#include "models/meshfile/mesh_builder.h"
#include "models/meshfile/mesh_formats.h"
#include "models/meshfile/mesh_join.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/text_scanner.h"
#include "sim/base/units.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::models::meshfile {

namespace {

constexpr std::size_t max_xplane_corners = std::size_t{1} << 26U; ///< of all triangles, repeats counted
constexpr std::size_t max_animation_depth = 100;
constexpr std::size_t largest_xplane_bytes = std::size_t{1} << 30U;

double dataref_at_rest(std::string_view dataref) { return dataref.ends_with("view_is_external") ? 1.0 : 0.0; }

/// X-Plane's surfaces count positive down, its rudder to the right. The first one that fits counts.
constexpr std::array controlled_datarefs{ControlledVariable{"lail", FlightControl::Roll, 20.0},
    ControlledVariable{"rail", FlightControl::Roll, -20.0},
    ControlledVariable{"aileron", FlightControl::Roll, 20.0, -20.0},
    ControlledVariable{"yoke_roll_ratio", FlightControl::Roll, 1.0},
    ControlledVariable{"elevator", FlightControl::Pitch, -20.0},
    ControlledVariable{"elv1def", FlightControl::Pitch, -20.0},
    ControlledVariable{"elv2def", FlightControl::Pitch, -20.0},
    ControlledVariable{"yoke_pitch_ratio", FlightControl::Pitch, 1.0},
    ControlledVariable{"rudder", FlightControl::Yaw, 20.0}, ControlledVariable{"ruddef", FlightControl::Yaw, 20.0},
    ControlledVariable{"yoke_heading_ratio", FlightControl::Yaw, 1.0},
    ControlledVariable{"flaprat", FlightControl::Flaps, 1.0},
    ControlledVariable{"flap_ratio", FlightControl::Flaps, 1.0},
    ControlledVariable{"flap_handle", FlightControl::Flaps, 1.0},
    ControlledVariable{"flap1_deploy_ratio", FlightControl::Flaps, 1.0},
    ControlledVariable{"flap2_deploy_ratio", FlightControl::Flaps, 1.0},
    ControlledVariable{"flap1_deg", FlightControl::Flaps, 30.0},
    ControlledVariable{"flap2_deg", FlightControl::Flaps, 30.0},
    ControlledVariable{"fla1_def", FlightControl::Flaps, 30.0},
    ControlledVariable{"fla2_def", FlightControl::Flaps, 30.0},
    ControlledVariable{"slatrat", FlightControl::Flaps, 1.0},
    ControlledVariable{"slat_ratio", FlightControl::Flaps, 1.0},
    ControlledVariable{"slat1_deploy_ratio", FlightControl::Flaps, 1.0},
    ControlledVariable{"slat2_deploy_ratio", FlightControl::Flaps, 1.0},
    ControlledVariable{"sbrkrat", FlightControl::SpeedBrake, 1.0},
    ControlledVariable{"speedbrake_ratio", FlightControl::SpeedBrake, 1.0},
    ControlledVariable{"speedbrake1_deg", FlightControl::SpeedBrake, 45.0},
    ControlledVariable{"speedbrake2_deg", FlightControl::SpeedBrake, 45.0},
    ControlledVariable{"speed_brake_ratio", FlightControl::SpeedBrake, 1.0},
    ControlledVariable{"spoiler_ratio", FlightControl::SpeedBrake, 1.0},
    ControlledVariable{"gear/deploy_ratio", FlightControl::Gear, 1.0},
    ControlledVariable{"acf_gear_deploy", FlightControl::Gear, 1.0},
    ControlledVariable{"gear_ratio", FlightControl::Gear, 1.0},
    ControlledVariable{"gear_deploy", FlightControl::Gear, 1.0},
    ControlledVariable{"gear_handle", FlightControl::Gear, 1.0}};

/// The number in brackets at the end of a dataref's name; 0 without one.
long element_of(std::string_view dataref) {
    const std::size_t open = dataref.rfind('[');
    if (open == dataref.npos || !dataref.ends_with(']')) { return 0; }
    return whole_number(dataref.substr(open + 1, dataref.size() - open - 2)).value_or(0);
}

/// A control and the dataref's value at the control's position 1.
struct Controlled {
    FlightControl control = FlightControl::Roll;
    double scale = 1.0;
};

std::optional<Controlled> controlled_by(std::string_view dataref) {
    // Trim wheels, levers and dials show what pilots set, not what stands outside.
    if (dataref.find("trim") != dataref.npos || dataref.find("indicators") != dataref.npos) { return std::nullopt; }
    const auto* const found = std::ranges::find_if(
        controlled_datarefs, [&](const ControlledVariable& one) { return dataref.find(one.name) != dataref.npos; });
    if (found == controlled_datarefs.end()) { return std::nullopt; }
    return Controlled{found->control, element_of(dataref) % 2 == 0 ? found->scale : found->right_scale};
}

/// Whether a dataref is the angle of a propeller, rotor or fan, in degrees.
bool is_engine_angle(std::string_view dataref) {
    return dataref.ends_with("rotation_angle_deg") || dataref.find("rotation_angle_deg[") != dataref.npos ||
           dataref.find("rotation_angle_deg_") != dataref.npos;
}

/// How many degrees something turns while its dataref grows by one, about an axis; its rate in flight is that of rotors
/// where the axis is upright, that of tail rotors where it lies across, else that of propellers.
RotationAxis rotation_about(const glm::dvec3& point_m, const glm::dvec3& direction, double factor) {
    const glm::dvec3 along = glm::abs(direction);
    const double per_minute = along.y > std::max(along.x, along.z) ? 390.0 : along.z > along.x ? 2400.0 : 2000.0;
    return {point_m, direction, std::copysign(per_minute / 60.0, factor)};
}

class XplaneReading {
public:
    /// `in_parts`: moving parts are kept apart; else all is as at rest.
    XplaneReading(const std::filesystem::path& path, std::string_view text, const ReadOptions& options, bool in_parts)
        : path_(path), text_(path, text, mesh_text), options_(options), in_parts_(in_parts) {
        parts_.push_back({{}, {}, MeshBuilder(path_, options_), {}});
    }

    void read() {
        for (int line = 0; line < 3; ++line) { text_.next_line(); } // is_xplane_object has read them
        while (text_.next_line()) { take(text_.word_or_end()); }
        if (hidden_ > 0) {
            parts_.front().mesh.add_note(
                fmt::format("{}: {} triangles that animations hide at rest, or that are for far away, are not read",
                    path_.string(), hidden_));
        }
    }

    MeshBuilder mesh() { return std::move(parts_.front().mesh); }

    RotatingModel model() {
        RotatingModel model;
        const bool all_moves = parts_.front().mesh.is_empty();
        if (all_moves && parts_.size() == 1) { parts_.front().mesh.finish(); } // says what is missing
        for (Part& part : parts_) {
            if (part.mesh.is_empty()) { continue; }
            MeshParts finished = part.mesh.finish_parts();
            join_mesh(model.clear, std::move(finished.clear), {}); // such as propeller discs, which need not turn
            if (&part == &parts_.front()) {
                model.body = std::move(finished.body);
            } else if (!finished.body.triangles.empty()) {
                model.parts.push_back({std::move(finished.body), part.about, std::move(part.moves)});
            }
        }
        return model;
    }

private:
    /// What an animation has done to the triangles inside it.
    struct Animation {
        AffineTransform placement;
        bool is_shown = true;
        RotationAxis about; ///< 0 turns: it does not turn by time
        PartMoves moves;
    };

    /// What turns and moves in one way. The first one is the body.
    struct Part {
        RotationAxis about;
        PartMoves moves;
        MeshBuilder mesh;
        std::map<std::size_t, std::uint32_t> materials; ///< in the mesh, by their numbers in materials_
    };

    void take(std::string_view keyword) {
        if (keyword == "VT") {
            take_vertex();
        } else if (keyword == "IDX" || keyword == "IDX10") {
            for (std::size_t left = keyword == "IDX" ? 1 : 10; left > 0; --left) { take_index(); }
        } else if (keyword == "TRIS") {
            take_triangles();
        } else if (keyword == "TEXTURE") {
            take_picture();
        } else if (keyword.starts_with("ANIM_")) {
            take_animation(keyword.substr(5));
        } else {
            take_attribute(keyword);
        }
    }

    void take_attribute(std::string_view keyword) {
        if (keyword == "ATTR_LOD") {
            is_near_ = text_.number("a distance") <= 0.0;
        } else if (keyword == "ATTR_draw_disable" || keyword == "ATTR_draw_enable") {
            is_drawn_ = keyword == "ATTR_draw_enable";
        } else if (keyword == "ATTR_no_cull" || keyword == "ATTR_cull") {
            is_two_sided_ = keyword == "ATTR_no_cull";
        } else if (keyword == "ATTR_shade_flat" || keyword == "ATTR_shade_smooth") {
            is_flat_ = keyword == "ATTR_shade_flat";
        } else if (keyword == "ATTR_diffuse_rgb") {
            const glm::dvec3 colour = glm::clamp(triple("a part of a colour"), 0.0, 1.0);
            materials_.push_back(material_of(glm::vec3(colour)));
        } else if (keyword == "TEXTURE_NORMAL" || keyword == "TEXTURE_LIT") {
            parts_.front().mesh.add_undrawn_picture(keyword == "TEXTURE_LIT" ? "glow" : "normals");
        } else if (keyword == "ELSE" || keyword == "ENDIF") {
            is_other_branch_ = keyword == "ELSE";
        }
    }

    glm::dvec3 triple(std::string_view what) {
        const double x = text_.number(what);
        const double y = text_.number(what);
        return {x, y, text_.number(what)};
    }

    struct Vertex {
        glm::dvec3 place_m{0.0};
        glm::dvec3 normal{0.0};
        glm::vec2 on_picture{0.0F};
    };

    void take_vertex() {
        Vertex vertex;
        vertex.place_m = triple("a coordinate");
        vertex.normal = triple("a part of a normal");
        const auto u = text_.take_number();
        const auto v = text_.take_number();
        vertex.on_picture = {static_cast<float>(u.value_or(0.0)), static_cast<float>(v.value_or(0.0))};
        vertices_.push_back(vertex);
    }

    void take_index() {
        const long last = static_cast<long>(vertices_.size()) - 1;
        if (last < 0) { text_.refuse("VT lines before IDX", "none"); }
        indices_.push_back(static_cast<std::uint32_t>(text_.integer("the number of a vertex", 0, last)));
    }

    void take_picture() {
        const std::string name(text_.rest_of_line());
        if (name.empty() || name == "none") { return; }
        picture_name_ = file_name_of_picture(name);
        materials_.push_back(material_of(glm::vec3(1.0F)));
    }

    /// X-Plane takes a .dds file in place of a .png file of the same name, and the other way round.
    std::string file_name_of_picture(const std::string& name) const {
        std::filesystem::path other(name);
        other.replace_extension(lower_case(other.extension().string()) == ".dds" ? ".png" : ".dds");
        std::error_code ignored;
        const auto is_there = [&](const std::string& one) {
            return std::filesystem::is_regular_file(picture_file(path_, one), ignored);
        };
        return !is_there(name) && is_there(other.string()) ? other.string() : name;
    }

    Material material_of(const glm::vec3& colour) const {
        Material made{.name = picture_name_.empty() ? "surface" : picture_name_, .colour = colour};
        if (!picture_name_.empty() && !options_.pictures) {
            made.picture = picture_file(path_, picture_name_).string();
        }
        return made;
    }

    /// `kind`: what follows ANIM_.
    void take_animation(std::string_view kind) {
        if (kind == "begin") {
            if (stack_.size() >= max_animation_depth) {
                text_.refuse(fmt::format("animations at most {} deep", max_animation_depth), "a deeper one");
            }
            stack_.push_back(now_);
        } else if (kind == "end") {
            if (stack_.empty()) { text_.refuse("ANIM_begin before ANIM_end", "none"); }
            now_ = stack_.back();
            stack_.pop_back();
        } else if (kind == "hide" || kind == "show") {
            const double first = text_.number("a value");
            const double last = text_.number("a value");
            show(kind == "show", std::min(first, last), std::max(first, last));
        } else if (kind == "trans") {
            take_shift();
        } else if (kind == "rotate") {
            take_rotation();
        } else if (kind.ends_with("_begin")) {
            axis_ = kind == "rotate_begin" ? triple("a part of an axis") : glm::dvec3(0.0);
            dataref_ = std::string(text_.rest_of_line());
            keys_.clear();
        } else if (kind.ends_with("_key")) {
            const double value = text_.number("a value");
            const bool turns = kind == "rotate_key";
            keys_.push_back({value, turns ? glm::dvec3(text_.number("an angle"), 0.0, 0.0) : triple("a coordinate")});
        } else if (kind.ends_with("_end")) {
            std::ranges::stable_sort(keys_, {}, &Key::value);
            kind == "rotate_end" ? turn(axis_) : move();
        }
    }

    /// Shows or hides what follows where the dataref at the end of the line is in a range.
    void show(bool shows, double least, double most) {
        const std::string dataref(text_.rest_of_line());
        const auto is_in = [&](double value) { return value >= least && value <= most; };
        const auto controlled = in_parts_ ? controlled_by(dataref) : std::nullopt;
        if (!controlled) {
            if (is_in(dataref_at_rest(dataref))) { now_.is_shown = shows; }
            return;
        }
        const bool otherwise = now_.is_shown;
        bool at_rest = otherwise;
        bool changes = false;
        auto shown = sampled_move(PartMove::Kind::Show, controlled->control, [&](double position) {
            const bool there = is_in(controlled->scale * position) ? shows : otherwise;
            if (position == 0.0) { at_rest = there; }
            changes = changes || there != otherwise;
            return there ? 1.0 : 0.0;
        });
        if (!changes) { return; }
        now_.is_shown = true;
        if (shown) { now_.moves.push_back(std::move(*shown)); }
    }

    /// Two values of the dataref at the end of the line and what belongs to them, as two keys; one key where a move has
    /// one end.
    void take_ends(const glm::dvec3& from, const std::optional<glm::dvec3>& to) {
        keys_ = {{0.0, from}};
        const auto first = to ? text_.take_number() : std::nullopt;
        const auto last = to ? text_.take_number() : std::nullopt;
        dataref_ = std::string(text_.rest_of_line());
        if (!first || !last || *first == *last) { return; }
        keys_ = {{*first, from}, {*last, *to}};
        std::ranges::stable_sort(keys_, {}, &Key::value);
    }

    void take_shift() {
        const glm::dvec3 from_m = triple("a coordinate");
        const bool is_static = text_.words().size() < 3;
        take_ends(from_m, is_static ? std::nullopt : std::optional(triple("a coordinate")));
        move();
    }

    void take_rotation() {
        const glm::dvec3 axis = triple("a part of an axis");
        const double from_deg = text_.number("an angle");
        const auto to_deg = text_.take_number();
        take_ends({from_deg, 0.0, 0.0}, to_deg ? std::optional(glm::dvec3(*to_deg, 0.0, 0.0)) : std::nullopt);
        turn(axis);
    }

    struct Key {
        double value = 0.0;
        glm::dvec3 result{0.0};
    };

    /// What belongs to a value of the dataref; straight lines between keys, which are sorted.
    glm::dvec3 at_key(double value) const {
        if (keys_.empty()) { return glm::dvec3(0.0); }
        const auto next = std::ranges::upper_bound(keys_, value, {}, &Key::value);
        if (next == keys_.begin()) { return keys_.front().result; }
        const Key& before = *std::prev(next);
        if (next == keys_.end() || next->value == before.value) { return before.result; }
        return before.result + (next->result - before.result) * ((value - before.value) / (next->value - before.value));
    }

    /// How a control moves what follows, along or about an axis of what stands there now; `part` of a key's result is
    /// the amount.
    void add_move(PartMove::Kind kind, const glm::dvec3& axis, int part) {
        const auto controlled = in_parts_ ? controlled_by(dataref_) : std::nullopt;
        if (!controlled) { return; }
        auto move = sampled_move(kind, controlled->control, [&](double position) {
            const double amount = at_key(controlled->scale * position)[part];
            return kind == PartMove::Kind::Turn ? rad_from_deg(amount) : amount;
        });
        if (!move) { return; }
        move->point_m = now_.placement.shift_m;
        move->direction = glm::normalize(now_.placement.turn * axis);
        now_.moves.push_back(std::move(*move));
    }

    void move() {
        for (int k = 0; k < 3; ++k) {
            glm::dvec3 axis(0.0);
            axis[k] = 1.0;
            add_move(PartMove::Kind::Shift, axis, k);
        }
        now_.placement = now_.placement.of({glm::dmat3(1.0), at_key(dataref_at_rest(dataref_))});
    }

    void turn(const glm::dvec3& axis) {
        const double length = glm::length(axis);
        if (!(length > 0.0)) { return; }
        add_move(PartMove::Kind::Turn, axis / length, 0);
        const bool turns = keys_.size() > 1 && keys_.back().result.x != keys_.front().result.x;
        if (in_parts_ && turns && is_engine_angle(dataref_) && now_.about.turns_per_s == 0.0 &&
            dataref_.find("tire") == dataref_.npos) {
            now_.about = rotation_about(now_.placement.shift_m, glm::normalize(now_.placement.turn * axis),
                keys_.back().result.x - keys_.front().result.x);
        }
        const double angle_rad = rad_from_deg(std::fmod(at_key(dataref_at_rest(dataref_)).x, 360.0));
        if (angle_rad == 0.0) { return; }
        now_.placement = now_.placement.of({glm::dmat3(glm::rotate(glm::dmat4(1.0), angle_rad, axis / length))});
    }

    Part& part() {
        if (!in_parts_) { return parts_.front(); }
        const auto found = std::ranges::find_if(parts_, [&](const Part& one) {
            return one.about.turns_per_s == now_.about.turns_per_s && one.about.point_m == now_.about.point_m &&
                   one.about.direction == now_.about.direction && one.moves == now_.moves;
        });
        if (found != parts_.end()) { return *found; }
        return parts_.emplace_back(Part{now_.about, now_.moves, MeshBuilder(path_, options_), {}});
    }

    /// The number in a part's mesh of the material that holds now.
    std::uint32_t material_in(Part& part) const {
        if (materials_.empty()) { return invalid_index; }
        const auto [known, is_new] = part.materials.try_emplace(materials_.size() - 1, 0);
        if (is_new) { known->second = part.mesh.add_material(materials_.back()); }
        return known->second;
    }

    void take_triangles() {
        const long first = text_.integer("the first index", 0, static_cast<long>(indices_.size()));
        const long count = text_.integer("a number of indices", 0, static_cast<long>(indices_.size()) - first);
        corners_ += static_cast<std::size_t>(count);
        if (count % 3 != 0) { text_.refuse("indices of whole triangles", std::to_string(count)); }
        if (corners_ > max_xplane_corners) {
            text_.refuse(fmt::format("at most {} corners", max_xplane_corners), "more");
        }
        if (!is_near_ || !is_drawn_ || is_other_branch_ || !now_.is_shown) {
            hidden_ += static_cast<std::size_t>(count) / 3;
            return;
        }
        Part& to = part();
        MeshBuilder& mesh = to.mesh;
        mesh.set_two_sided(is_two_sided_);
        mesh.set_smoothing({is_flat_ ? Smoothing::flat : Smoothing::unknown});
        const std::uint32_t material = material_in(to);
        const std::uint32_t picture = mesh.uses_pictures() && !picture_name_.empty()
                                          ? mesh.pictures().picture(picture_name_)
                                          : BakedPictures::none;
        for (long i = first; i < first + count; i += 3) {
            const auto at = static_cast<std::size_t>(i);
            // Clockwise seen from the front.
            const std::array triangle{
                corner(indices_[at], mesh), corner(indices_[at + 2], mesh), corner(indices_[at + 1], mesh)};
            mesh.add_polygon(triangle, material, {.picture = picture});
        }
    }

    CornerIndices corner(std::uint32_t index, MeshBuilder& mesh) {
        const Vertex& vertex = vertices_[index];
        const auto place_m = now_.placement.point_m(vertex.place_m);
        if (!place_m) { text_.refuse("vertices within bounds", "one that animations move out of them"); }
        CornerIndices made{.vertex = mesh.add_vertex(*place_m)};
        if (!is_flat_) { made.normal = mesh.add_normal(now_.placement.turn * vertex.normal); }
        if (!picture_name_.empty()) { made.texture = mesh.add_texture_coordinates(vertex.on_picture); }
        return made;
    }

    std::filesystem::path path_;
    TextScanner text_;
    ReadOptions options_;
    bool in_parts_ = false;
    std::deque<Part> parts_;
    std::vector<Vertex> vertices_;
    std::vector<std::uint32_t> indices_;
    std::vector<Animation> stack_;
    Animation now_;
    glm::dvec3 axis_{0.0};
    std::string dataref_;
    std::vector<Key> keys_;
    std::string picture_name_;
    std::vector<Material> materials_; ///< the last one holds
    std::size_t corners_ = 0;
    std::size_t hidden_ = 0; ///< triangles
    bool is_near_ = true;
    bool is_drawn_ = true;
    bool is_flat_ = false;
    bool is_two_sided_ = false;
    bool is_other_branch_ = false;
};

} // namespace

bool is_xplane_text(std::string_view text) {
    std::array<std::string_view, 3> lines;
    for (std::string_view& line : lines) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const auto words = split_words(text.substr(0, end));
        line = words.empty() ? std::string_view() : words[0];
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    const auto version = whole_number(lines[1]);
    return (lines[0] == "I" || lines[0] == "A") && version && *version >= 700 && lines[2] == "OBJ";
}

MeshBuilder read_xplane(const std::filesystem::path& path, std::string_view text, const ReadOptions& options) {
    XplaneReading reading(path, text, options, false);
    reading.read();
    return reading.mesh();
}

RotatingModel read_rotating_xplane(const std::filesystem::path& path, const ReadOptions& options) {
    const std::string text = read_text_file(path, largest_xplane_bytes);
    XplaneReading reading(path, text, options, true);
    reading.read();
    RotatingModel model = reading.model();
    if (model.body.triangles.empty()) { // all of it moves: then none of it does
        model.body = mesh_at_rest(std::exchange(model, {}));
    }
    if (model.body.triangles.empty()) { throw_error_in(path, "expected at least one triangle, got none"); }
    return model;
}

namespace {

constexpr std::size_t largest_aircraft_bytes = std::size_t{256} << 20U;
constexpr long max_objects = 1000;

/// An object of an aircraft, as its file (P _obja/NUMBER/...) attaches it.
struct AttachedObject {
    std::string file;
    glm::dvec3 shift_ft{0.0};
    glm::dvec3 angles_deg{0.0}; ///< heading, pitch, roll
    long flags = 0;
};

class XplaneAircraftReading {
public:
    XplaneAircraftReading(const std::filesystem::path& path, const ReadOptions& options)
        : path_(path), options_(options) {}

    RotatingModel read() {
        take_objects();
        for (const auto& [number, object] : objects_) {
            constexpr long place_bits = 3;
            constexpr long interior = 1;
            if (object.file.empty()) { continue; }
            if ((object.flags & place_bits) == interior) {
                ++interior_;
            } else {
                add(object);
            }
        }
        if (model_.body.triangles.empty()) {
            throw_error_in(path_, "expected objects with surfaces in P _obja lines, got none");
        }
        if (interior_ > 0) {
            model_.body.notes.push_back(
                fmt::format("{}: {} objects of its interior are not read", path_.string(), interior_));
        }
        model_.body.name = path_.stem().string();
        return std::move(model_);
    }

private:
    void take_objects() {
        const std::string text = read_file(path_, largest_aircraft_bytes);
        const bool is_text = text.find('\0') == text.npos; // older ones are binary
        TextScanner lines(path_, is_text ? std::string_view(text) : std::string_view(), mesh_text);
        lines.next_line();
        lines.next_line();
        if (!is_text || whole_number(lines.word_or_end()).value_or(0) < 1000) {
            throw_error_in(
                path_, "expected an aircraft of X-Plane 10 or later, got one that Plane-Maker has to save anew");
        }
        while (lines.next_line()) {
            constexpr std::string_view attached = "_obja/";
            if (lines.word_or_end() != "P") { continue; }
            std::string_view name = lines.word_or_end();
            if (name == "acf/_cgY") { centre_ft_.y = lines.take_number().value_or(0.0); }
            if (name == "acf/_cgZ") { centre_ft_.z = lines.take_number().value_or(0.0); }
            if (!name.starts_with(attached)) { continue; }
            name.remove_prefix(attached.size());
            const std::size_t slash = std::min(name.find('/'), name.size());
            const auto number = whole_number(name.substr(0, slash));
            if (!number || *number < 0 || *number >= max_objects) { continue; }
            take_property(name.substr(std::min(slash + 1, name.size())), lines, objects_[*number]);
        }
    }

    static void take_property(std::string_view name, TextScanner& lines, AttachedObject& object) {
        if (name == "_v10_att_file_stl") {
            object.file = std::string(lines.rest_of_line());
        } else if (name == "_obj_flags") {
            object.flags = lines.take_integer().value_or(0);
        } else if (name.starts_with("_v10_att_") && name.ends_with("_acf_prt_ref")) {
            const char axis = name[std::string_view("_v10_att_").size()];
            if (axis >= 'x' && axis <= 'z') { object.shift_ft[axis - 'x'] = lines.take_number().value_or(0.0); }
        } else if (name == "_v10_att_psi_ref" || name == "_v10_att_the_ref" || name == "_v10_att_phi_ref") {
            const int angle = name == "_v10_att_psi_ref" ? 0 : name == "_v10_att_the_ref" ? 1 : 2;
            object.angles_deg[angle] = lines.take_number().value_or(0.0);
        }
    }

    /// Objects lie in the folder `objects`; a faulty or missing one costs itself alone.
    void add(const AttachedObject& object) {
        std::string name = object.file;
        std::ranges::replace(name, '\\', '/');
        const std::filesystem::path file = (path_.parent_path() / "objects" / name).lexically_normal();
        try {
            place(read_rotating_xplane(file, options_), placement_of(object));
        } catch (const Error& fault) {
            model_.body.notes.push_back(fmt::format("{}; this object is left out", fault.what()));
        }
    }

    /// From the centre of gravity, at which X-Plane flies an aircraft.
    AffineTransform placement_of(const AttachedObject& object) const {
        constexpr double m_per_ft = 0.3048;
        glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), -rad_from_deg(object.angles_deg[0]), glm::dvec3(0, 1, 0));
        turn = glm::rotate(turn, rad_from_deg(object.angles_deg[1]), glm::dvec3(1, 0, 0));
        turn = glm::rotate(turn, -rad_from_deg(object.angles_deg[2]), glm::dvec3(0, 0, 1));
        return {glm::dmat3(turn), m_per_ft * (object.shift_ft - centre_ft_)};
    }

    void place(RotatingModel object, const AffineTransform& placement) {
        join_mesh(model_.body, std::move(object.body), placement);
        join_mesh(model_.clear, std::move(object.clear), placement);
        for (RotatingPart& part : object.parts) {
            RotatingPart& placed = model_.parts.emplace_back();
            join_mesh(placed.mesh, std::move(part.mesh), placement);
            placed.about = part.about;
            placed.about.point_m = placement.turn * part.about.point_m + placement.shift_m;
            placed.about.direction = placement.turn * part.about.direction;
            placed.moves = std::move(part.moves);
            for (PartMove& move : placed.moves) {
                move.point_m = placement.turn * move.point_m + placement.shift_m;
                move.direction = placement.turn * move.direction;
            }
        }
    }

    std::filesystem::path path_;
    ReadOptions options_;
    std::map<long, AttachedObject> objects_;
    glm::dvec3 centre_ft_{0.0};
    RotatingModel model_;
    int interior_ = 0;
};

} // namespace

RotatingModel read_xplane_aircraft(const std::filesystem::path& path, const ReadOptions& options) {
    return XplaneAircraftReading(path, options).read();
}

} // namespace octant::models::meshfile
