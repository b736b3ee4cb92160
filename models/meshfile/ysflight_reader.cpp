// YSFlight's surfaces (.srf) and the models that they make (.dnm). Its axes are x right, y up, z forward, which is
// left-handed: x is turned over here, so that meshes have x left. Parts are read as in flight: each in the first of its
// states, gear up; propellers and rotors turn.
#include "models/meshfile/mesh_builder.h"
#include "models/meshfile/mesh_file.h"
#include "models/meshfile/mesh_formats.h"
#include "models/meshfile/mesh_join.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/text_scanner.h"
#include "sim/base/units.h"

#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

namespace octant::models::meshfile {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_ysflight_bytes = std::size_t{1} << 28U;
constexpr std::size_t max_ysflight_parts = 10'000;
constexpr std::size_t max_ysflight_corners = std::size_t{1} << 25U; ///< of all polygons, repeats counted
constexpr int max_ysflight_depth = 100;

struct SurfaceVertex {
    glm::dvec3 place_m{0.0};
    bool is_round = false; ///< shaded smoothly
};

struct SurfacePolygon {
    std::vector<std::uint32_t> corners;
    glm::vec3 colour{0.7F};
    glm::dvec3 normal{0.0}; ///< zero: both sides are seen
    float opacity = 1.0F;
    bool is_light = false;
};

/// A surface, x turned over.
struct Surface {
    std::vector<SurfaceVertex> vertices;
    std::vector<SurfacePolygon> polygons;
};

bool is_keyword(std::string_view word, std::string_view upper) {
    return std::ranges::equal(
        word, upper, [](char a, char b) { return std::toupper(static_cast<unsigned char>(a)) == b; });
}

class SurfaceReading {
public:
    explicit SurfaceReading(TextScanner& text) : text_(text) {}

    /// Reads the line that `text` stands on.
    void take_line() {
        const std::string_view word = text_.word_or_end();
        if (in_polygon_) {
            take_in_polygon(word);
        } else if (is_keyword(word, "V") || is_keyword(word, "VER")) {
            take_vertex();
        } else if (is_keyword(word, "F") || is_keyword(word, "FAC")) {
            in_polygon_ = true;
            surface_.polygons.emplace_back();
        } else if (is_keyword(word, "ZA")) {
            take_opacities();
        } else if (is_keyword(word, "ZL")) {
            while (const auto number = polygon_number()) { surface_.polygons[*number].is_light = true; }
        }
    }

    Surface surface() { return std::move(surface_); }

private:
    glm::dvec3 mirrored_triple() {
        const double x = text_.number("a number");
        const double y = text_.number("a number");
        return {-x, y, text_.number("a number")};
    }

    void take_vertex() {
        SurfaceVertex vertex{mirrored_triple()};
        vertex.is_round = is_keyword(text_.word_or_end(), "R");
        surface_.vertices.push_back(vertex);
    }

    void take_in_polygon(std::string_view word) {
        SurfacePolygon& polygon = surface_.polygons.back();
        if (is_keyword(word, "E") || is_keyword(word, "END")) {
            in_polygon_ = false;
        } else if (is_keyword(word, "V") || is_keyword(word, "VER")) {
            take_corners(polygon);
        } else if (is_keyword(word, "N") || is_keyword(word, "NOR")) {
            mirrored_triple(); // a point of the polygon
            polygon.normal = mirrored_triple();
        } else if (is_keyword(word, "C") || is_keyword(word, "COL")) {
            take_colour(polygon);
        }
    }

    void take_corners(SurfacePolygon& polygon) {
        const long last = static_cast<long>(surface_.vertices.size()) - 1;
        while (!text_.peek().empty()) {
            if (polygon.corners.size() == max_polygon_corners) {
                text_.refuse(fmt::format("at most {} corners", max_polygon_corners), "more");
            }
            if (last < 0) { text_.refuse("vertices before a polygon", "none"); }
            polygon.corners.push_back(static_cast<std::uint32_t>(text_.integer("the number of a vertex", 0, last)));
        }
    }

    /// Three numbers to 255, or one of 15 bits: green, red and blue from the highest.
    void take_colour(SurfacePolygon& polygon) {
        const long first = text_.integer("a colour", 0, 0x7fffffff);
        if (text_.peek().empty()) {
            const auto part = [&](unsigned shift) { return static_cast<float>(first >> shift & 31) / 31.0F; };
            polygon.colour = {part(5), part(10), part(0)};
            return;
        }
        const auto share = [](long part) { return static_cast<float>(std::min(part, 255L)) / 255.0F; };
        const long green = text_.integer("a colour", 0, 0x7fffffff);
        polygon.colour = {share(first), share(green), share(text_.integer("a colour", 0, 0x7fffffff))};
    }

    std::optional<std::size_t> polygon_number() {
        const auto number = text_.take_integer(0, static_cast<long>(surface_.polygons.size()) - 1);
        return number ? std::optional(static_cast<std::size_t>(*number)) : std::nullopt;
    }

    /// Pairs of a polygon's number and its transparency, 0 to 255.
    void take_opacities() {
        while (const auto number = polygon_number()) {
            const auto clear = text_.take_integer(0, 255);
            if (!clear) { return; }
            surface_.polygons[*number].opacity = 1.0F - static_cast<float>(*clear) / 255.0F;
        }
    }

    TextScanner& text_;
    Surface surface_;
    bool in_polygon_ = false;
};

Surface read_surface(const fs::path& path) {
    const std::string content = read_text_file(path, largest_ysflight_bytes);
    TextScanner text(path, content, mesh_text);
    text.next_line();
    if (const std::string_view magic = text.word_or_end(); !is_keyword(magic, "SURF")) {
        text.refuse("SURF", in_quotes(magic));
    }
    SurfaceReading reading(text);
    while (text.next_line()) { reading.take_line(); }
    return reading.surface();
}

/// Adds surfaces to a mesh.
class SurfaceMesh {
public:
    SurfaceMesh(const fs::path& path, const ReadOptions& options) : path_(path), mesh_(path, options) {}

    void add(const Surface& surface, const AffineTransform& placement) {
        const auto first = static_cast<std::uint32_t>(mesh_.vertex_count());
        for (const SurfaceVertex& vertex : surface.vertices) {
            const auto place_m = placement.point_m(vertex.place_m);
            if (!place_m) { throw_error_in(path_, "expected vertices within bounds, got one out of them"); }
            mesh_.add_vertex(*place_m);
        }
        const std::vector<glm::dvec3> round = round_normals(surface, placement);
        for (const SurfacePolygon& polygon : surface.polygons) {
            if (polygon.corners.size() < 3 || polygon.is_light) { continue; }
            corners_ += polygon.corners.size();
            if (corners_ > max_ysflight_corners) {
                throw_error_in(path_, fmt::format("expected at most {} corners, got more", max_ysflight_corners));
            }
            add(surface, polygon, first, round);
        }
    }

    MeshBuilder take() { return std::move(mesh_); }

    bool is_empty() const { return mesh_.is_empty(); }

private:
    /// By Newell's method, towards the side that the file's normal is on; twice the area long.
    static glm::dvec3 area_normal(const Surface& surface, const SurfacePolygon& polygon, bool& is_turned) {
        glm::dvec3 sum(0.0);
        for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
            const glm::dvec3& here = surface.vertices[polygon.corners[k]].place_m;
            const glm::dvec3& next = surface.vertices[polygon.corners[(k + 1) % polygon.corners.size()]].place_m;
            sum += glm::cross(here, next);
        }
        is_turned = glm::dot(sum, polygon.normal) < 0.0;
        return is_turned ? -sum : sum;
    }

    /// The normals of smooth vertices; zero for the others.
    static std::vector<glm::dvec3> round_normals(const Surface& surface, const AffineTransform& placement) {
        std::vector<glm::dvec3> sums(surface.vertices.size(), glm::dvec3(0.0));
        for (const SurfacePolygon& polygon : surface.polygons) {
            bool is_turned = false;
            const glm::dvec3 normal = area_normal(surface, polygon, is_turned);
            for (const std::uint32_t corner : polygon.corners) {
                if (surface.vertices[corner].is_round) { sums[corner] += placement.turn * normal; }
            }
        }
        return sums;
    }

    void add(const Surface& surface, const SurfacePolygon& polygon, std::uint32_t first,
        const std::vector<glm::dvec3>& round) {
        bool is_turned = false;
        area_normal(surface, polygon, is_turned);
        places_.clear();
        for (const std::uint32_t corner : polygon.corners) {
            CornerIndices place{.vertex = first + corner};
            if (surface.vertices[corner].is_round) { place.normal = mesh_.add_normal(round[corner]); }
            places_.push_back(place);
        }
        if (is_turned) { std::ranges::reverse(places_); }
        mesh_.set_two_sided(polygon.normal == glm::dvec3(0.0));
        mesh_.set_smoothing({Smoothing::flat});
        mesh_.add_polygon(places_, material_of(polygon));
    }

    std::uint32_t material_of(const SurfacePolygon& polygon) {
        const std::array<float, 4> key{polygon.colour.x, polygon.colour.y, polygon.colour.z, polygon.opacity};
        const auto [at, is_new] = materials_.try_emplace(key, invalid_index);
        if (is_new) {
            at->second = mesh_.add_material({.name = fmt::format("colour {}", materials_.size()),
                .colour = polygon.colour,
                .opacity = polygon.opacity});
        }
        return at->second;
    }

    fs::path path_;
    MeshBuilder mesh_;
    std::map<std::array<float, 4>, std::uint32_t> materials_;
    std::vector<CornerIndices> places_;
    std::size_t corners_ = 0;
};

/// A place and an attitude of a part.
struct YsflightState {
    AffineTransform placement;
    bool is_shown = true;
};

struct YsflightPart {
    std::string surface;
    long kind = 0;
    YsflightState place;
    std::vector<YsflightState> states; ///< the first one is that at rest
    glm::dvec3 centre_m{0.0};
    std::vector<std::string> children;
};

/// What the numbers of parts mean.
constexpr long afterburner_kind = 2;
constexpr long propeller_kind = 3;
constexpr long slow_propeller = 18;
constexpr long fast_propeller = 20;
constexpr long spinner = 24;
constexpr long first_light = 30;
constexpr long last_light = 34;

constexpr std::size_t most_states = 3;

/// Which control brings parts of a kind from their first state to another one, and how far: the shares of the way at
/// the positions of the control.
struct PartControl {
    long kind = 0;
    FlightControl control = FlightControl::Gear;
    std::size_t state = 1;
    std::array<glm::dvec2, 4> shares{};
};

/// Gear comes out while the second fifth to the fourth fifth of its time pass, its doors open before and partly shut
/// after it. Of surfaces the second state is nose up, roll to the left and nose to the left, the third one the
/// opposite.
constexpr std::array part_controls{
    PartControl{0, FlightControl::Gear, 1, {{{0.0, 0.0}, {0.2, 0.0}, {0.8, 1.0}, {1.0, 1.0}}}},
    PartControl{14, FlightControl::Gear, 1, {{{0.0, 0.0}, {0.2, 1.0}, {0.8, 1.0}, {1.0, 0.0}}}},
    PartControl{15, FlightControl::Gear, 1, {{{0.0, 0.0}, {0.6, 1.0}, {0.8, 1.0}, {1.0, 1.0}}}},
    PartControl{17, FlightControl::Gear, 1, {{{0.0, 0.0}, {0.2, 1.0}, {0.8, 1.0}, {1.0, 1.0}}}},
    PartControl{4, FlightControl::SpeedBrake, 1, {{{-1.0, 0.0}, {0.0, 0.0}, {1.0, 1.0}, {2.0, 1.0}}}},
    PartControl{5, FlightControl::Flaps, 1, {{{-1.0, 0.0}, {0.0, 0.0}, {1.0, 1.0}, {2.0, 1.0}}}},
    PartControl{6, FlightControl::Pitch, 1, {{{-1.0, 0.0}, {0.0, 0.0}, {1.0, 1.0}, {2.0, 1.0}}}},
    PartControl{6, FlightControl::Pitch, 2, {{{-2.0, 1.0}, {-1.0, 1.0}, {0.0, 0.0}, {1.0, 0.0}}}},
    PartControl{7, FlightControl::Roll, 1, {{{-2.0, 1.0}, {-1.0, 1.0}, {0.0, 0.0}, {1.0, 0.0}}}},
    PartControl{7, FlightControl::Roll, 2, {{{-1.0, 0.0}, {0.0, 0.0}, {1.0, 1.0}, {2.0, 1.0}}}},
    PartControl{8, FlightControl::Yaw, 1, {{{-2.0, 1.0}, {-1.0, 1.0}, {0.0, 0.0}, {1.0, 0.0}}}},
    PartControl{8, FlightControl::Yaw, 2, {{{-1.0, 0.0}, {0.0, 0.0}, {1.0, 1.0}, {2.0, 1.0}}}}};

PartMove move_along(const PartControl& by, PartMove::Kind kind, double amount) {
    PartMove move;
    move.kind = kind;
    move.control = by.control;
    for (const glm::dvec2& share : by.shares) { move.amounts.emplace_back(share.x, share.y * amount); }
    return move;
}

/// What brings a part, which lies in `holder`, from its first state to another one.
void add_state_moves(const PartControl& by, const YsflightPart& part, const AffineTransform& holder, PartMoves& moves) {
    const YsflightState& rest = part.states[0];
    const YsflightState& other = part.states[by.state];
    if (rest.is_shown != other.is_shown) {
        PartMove show;
        show.kind = PartMove::Kind::Show;
        show.control = by.control;
        for (const glm::dvec2& share : by.shares) {
            const bool is_at_rest = share.y == 0.0;
            show.amounts.emplace_back(share.x, (is_at_rest ? rest : other).is_shown ? 1.0 : 0.0);
        }
        moves.push_back(std::move(show));
    }
    const glm::dvec3 shift_m = holder.turn * (other.placement.shift_m - rest.placement.shift_m);
    if (const double far_m = glm::length(shift_m); far_m > 0.0) {
        moves.push_back(move_along(by, PartMove::Kind::Shift, far_m));
        moves.back().direction = shift_m / far_m;
    }
    const glm::dquat turn = glm::quat_cast(other.placement.turn * glm::transpose(rest.placement.turn));
    const glm::dvec3 half(turn.x, turn.y, turn.z);
    if (const double sine = glm::length(half); sine > 1e-9) {
        moves.push_back(move_along(by, PartMove::Kind::Turn, 2.0 * std::atan2(sine, turn.w)));
        moves.back().direction = glm::normalize(holder.turn * (half / sine));
        moves.back().point_m = holder.turn * rest.placement.shift_m + holder.shift_m;
    }
}

/// What moves a part, which lies in `holder`: what moves its holder, and its own control.
PartMoves moved(const YsflightPart& part, const AffineTransform& holder, const PartMoves& of_holder) {
    PartMoves moves = of_holder;
    for (const PartControl& by : part_controls) {
        if (by.kind == part.kind && by.state < part.states.size()) { add_state_moves(by, part, holder, moves); }
    }
    return moves;
}

bool turns_in_flight(const YsflightPart& part) {
    return part.kind == propeller_kind || part.kind == slow_propeller || part.kind == spinner;
}

class DynamicModelReading {
public:
    DynamicModelReading(const fs::path& path, const ReadOptions& options) : path_(path), options_(options) {}

    void read() {
        const std::string content = read_text_file(path_, largest_ysflight_bytes);
        TextScanner text(path_, content, mesh_text);
        text.next_line();
        if (const std::string_view magic = text.word_or_end(); !is_keyword(magic, "DYNAMODEL")) {
            text.refuse("DYNAMODEL", in_quotes(magic));
        }
        while (text.next_line()) {
            const std::string_view word = text.word_or_end();
            if (is_keyword(word, "PCK")) {
                take_surface(text);
            } else if (is_keyword(word, "SRF")) {
                take_part(text);
            }
        }
        if (parts_.empty()) { text.refuse("a part (SRF)", "none"); }
    }

    /// All of it in one mesh.
    MeshBuilder mesh() {
        SurfaceMesh all(path_, options_);
        for_each_part(
            [&](const YsflightPart&, const Surface& surface, const AffineTransform& placement, const PartMoves& moves) {
                if (is_shown_at_rest(moves)) { all.add(surface, placement); }
            });
        return noted(all.take());
    }

    RotatingModel rotating() {
        SurfaceMesh body(path_, options_);
        RotatingModel model;
        for_each_part([&](const YsflightPart& part, const Surface& surface, const AffineTransform& placement,
                          const PartMoves& moves) {
            const bool turns = turns_in_flight(part) && !surface.polygons.empty();
            if (!turns && moves.empty()) {
                body.add(surface, placement);
                return;
            }
            SurfaceMesh moving(path_, options_);
            moving.add(surface, placement);
            if (moving.is_empty()) { return; }
            model.parts.push_back(
                {moving.take().finish(), turns ? rotation_of(surface, placement) : RotationAxis(), moves});
        });
        if (body.is_empty()) { return {mesh().finish(), {}, {}}; }
        MeshParts parts = noted(body.take()).finish_parts();
        if (parts.body.triangles.empty()) { return {mesh().finish(), {}, {}}; }
        model.body = std::move(parts.body);
        model.clear = std::move(parts.clear);
        return model;
    }

private:
    static std::string name_in(std::string_view rest) {
        const bool quoted = rest.starts_with('"');
        const std::size_t end = std::min(rest.find(quoted ? '"' : ' ', 1), rest.size());
        return std::string(rest.substr(quoted ? 1 : 0, end - (quoted ? 1 : 0)));
    }

    /// PCK NAME LINES, then as many lines of a surface.
    void take_surface(TextScanner& text) {
        const std::string rest(text.rest_of_line());
        const auto words = split_words(rest);
        const auto lines = words.empty() ? std::nullopt : whole_number(words.back());
        if (!lines || *lines < 0) { text.refuse("PCK, a name and a number of lines", in_quotes(rest)); }
        SurfaceReading reading(text);
        for (long line = 0; line < *lines && text.next_line(); ++line) { reading.take_line(); }
        surfaces_.insert_or_assign(name_in(rest), reading.surface());
    }

    void take_part(TextScanner& text) {
        const std::string name = name_in(text.rest_of_line());
        if (parts_.size() == max_ysflight_parts) {
            text.refuse(fmt::format("at most {} parts", max_ysflight_parts), "more");
        }
        YsflightPart part;
        while (text.next_line()) {
            const std::string_view word = text.word_or_end();
            if (is_keyword(word, "END")) { break; }
            if (is_keyword(word, "FIL")) {
                part.surface = name_in(text.rest_of_line());
            } else if (is_keyword(word, "CLA")) {
                part.kind = text.integer("a kind of part");
            } else if (is_keyword(word, "POS")) {
                part.place = state(text);
            } else if (is_keyword(word, "STA") && part.states.size() < most_states) {
                part.states.push_back(state(text));
            } else if (is_keyword(word, "CNT")) {
                part.centre_m = mirrored_triple(text);
            } else if (is_keyword(word, "CLD")) {
                part.children.push_back(name_in(text.rest_of_line()));
            }
        }
        if (parts_.try_emplace(name, std::move(part)).second) { order_.push_back(name); }
    }

    static glm::dvec3 mirrored_triple(TextScanner& text) {
        const double x = text.number("a number");
        const double y = text.number("a number");
        return {-x, y, text.number("a number")};
    }

    /// x, y, z, heading, pitch, bank (of 65536 a turn) and whether it is shown.
    static YsflightState state(TextScanner& text) {
        YsflightState read;
        read.placement.shift_m = mirrored_triple(text);
        std::array<double, 3> angles_rad{};
        for (double& angle_rad : angles_rad) {
            angle_rad = rad_from_deg(360.0) * std::fmod(text.number("an angle") / 65536.0, 1.0);
        }
        glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), angles_rad[0], glm::dvec3(0, 1, 0));
        turn = glm::rotate(turn, -angles_rad[1], glm::dvec3(1, 0, 0));
        read.placement.turn = glm::dmat3(glm::rotate(turn, -angles_rad[2], glm::dvec3(0, 0, 1)));
        read.is_shown = text.take_integer().value_or(1) != 0;
        return read;
    }

    /// Calls `visit(part, surface, placement, moves)` for the parts that are seen in flight, also for those that only
    /// their moves show.
    template <typename Visit>
    void for_each_part(const Visit& visit) {
        std::set<std::string> children;
        for (const auto& [name, part] : parts_) { children.insert(part.children.begin(), part.children.end()); }
        met_.clear();
        for (const std::string& name : order_) {
            if (!children.contains(name)) { visit_part(name, {}, {}, 0, visit); }
        }
    }

    template <typename Visit>
    void visit_part(const std::string& name, const AffineTransform& parent, const PartMoves& parent_moves, int depth,
        const Visit& visit) {
        const auto found = parts_.find(name);
        if (found == parts_.end() || !met_.insert(name).second) { return; }
        if (depth > max_ysflight_depth) {
            throw_error_in(path_, fmt::format("expected parts at most {} deep, got more", max_ysflight_depth));
        }
        const YsflightPart& part = found->second;
        AffineTransform placement = parent.of(part.place.placement);
        const PartMoves moves = moved(part, placement, parent_moves);
        if (!part.states.empty()) { placement = placement.of(part.states[0].placement); }
        placement = placement.of({glm::dmat3(1.0), -part.centre_m});
        const bool shown_later =
            std::ranges::any_of(moves, [](const PartMove& move) { return move.kind == PartMove::Kind::Show; });
        if (is_shown(part) || shown_later) {
            if (const Surface* surface = surface_of(part)) { visit(part, *surface, placement, moves); }
        }
        for (const std::string& child : part.children) { visit_part(child, placement, moves, depth + 1, visit); }
    }

    /// Lights, flames and discs of fast propellers are not.
    bool is_shown(const YsflightPart& part) const {
        const bool has_slow =
            std::ranges::any_of(parts_, [](const auto& other) { return other.second.kind == slow_propeller; });
        if (part.kind == afterburner_kind || (part.kind >= first_light && part.kind <= last_light) ||
            (part.kind == fast_propeller && has_slow)) {
            return false;
        }
        return part.states.empty() || part.states[0].is_shown;
    }

    const Surface* surface_of(const YsflightPart& part) {
        const auto known = surfaces_.find(part.surface);
        if (known != surfaces_.end()) { return &known->second; }
        const fs::path file = path_.parent_path() / fs::path(part.surface).filename();
        std::error_code ignored;
        if (part.surface.empty() || !fs::is_regular_file(file, ignored)) {
            missing_.insert(part.surface);
            return nullptr;
        }
        return &surfaces_.emplace(part.surface, read_surface(file)).first->second;
    }

    /// A propeller's axis is along, a rotor's upright: the surface is thin along it.
    static RotationAxis rotation_of(const Surface& surface, const AffineTransform& placement) {
        glm::dvec3 least(std::numeric_limits<double>::max());
        glm::dvec3 most(std::numeric_limits<double>::lowest());
        for (const SurfaceVertex& vertex : surface.vertices) {
            least = glm::min(least, vertex.place_m);
            most = glm::max(most, vertex.place_m);
        }
        const glm::dvec3 extent_m = most - least;
        const bool is_upright = extent_m.z > 0.5 * std::max(extent_m.x, extent_m.y);
        constexpr double rotor_per_s = 390.0 / 60.0;
        constexpr double propeller_per_s = 2400.0 / 60.0;
        RotationAxis about;
        about.turns_per_s = is_upright ? rotor_per_s : propeller_per_s;
        about.direction = glm::normalize(placement.turn * (is_upright ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1)));
        about.point_m = placement.turn * (0.5 * (least + most)) + placement.shift_m;
        return about;
    }

    MeshBuilder noted(MeshBuilder mesh) const {
        if (!missing_.empty()) {
            mesh.add_note(fmt::format("{}: {} surfaces of its parts are missing, such as '{}'", path_.string(),
                missing_.size(), printable(*missing_.begin())));
        }
        return mesh;
    }

    fs::path path_;
    ReadOptions options_;
    std::map<std::string, Surface> surfaces_;
    std::map<std::string, YsflightPart> parts_;
    std::vector<std::string> order_; ///< names of parts as the file has them
    std::set<std::string> met_;
    std::set<std::string> missing_;
};

} // namespace

MeshBuilder read_srf(const fs::path& path, const ReadOptions& options) {
    SurfaceMesh mesh(path, options);
    mesh.add(read_surface(path), {});
    return mesh.take();
}

MeshBuilder read_dnm(const fs::path& path, const ReadOptions& options) {
    DynamicModelReading reading(path, options);
    reading.read();
    return reading.mesh();
}

RotatingModel read_rotating_dnm(const fs::path& path, const ReadOptions& options) {
    DynamicModelReading reading(path, options);
    reading.read();
    return reading.rotating();
}

} // namespace octant::models::meshfile
