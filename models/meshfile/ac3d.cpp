#include "models/meshfile/mesh_builder.h"
#include "models/meshfile/mesh_formats.h"
#include "models/meshfile/mesh_join.h"
#include "models/polygons/obj_reader.h"
#include "models/triangle_mesh.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/text_scanner.h"
#include "sim/base/units.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::models::meshfile {

namespace {

/// The crease angle of objects that give none, in FlightGear.
constexpr double default_crease_deg = 61.0;

/// The options of an AC3D object and its children.
struct Ac3dObject {
    bool is_excluded = false;
    bool is_placeholder = false; ///< left out because it is no surface (ReadOptions::placeholders)
    std::uint32_t group = invalid_index;
    AffineTransform moved; ///< applied to positions of the file
    std::string picture;   ///< in place of the one that it names; empty: that one
};

/// Whether an object's name says that it represents turning blades, a light cone or a shadow on the ground.
bool is_stand_in(const std::string& object_name) {
    const std::string name = lower_case(object_name);
    const auto has = [&](std::string_view part) { return name.find(part) != name.npos; };
    const bool of_blades = has("prop") || has("rotor") || has("blade") || has("pdis");
    const bool turns_fast = has("disc") || has("disk") || has("blur") || has("fast");
    const bool is_of_light = has("light") && (has("cone") || has("volume") || has("beam"));
    return (of_blades && turns_fast) || is_of_light || names_shadow(name);
}

/// Returns the options of an object with this name that is a child of `holder`.
Ac3dObject object_settings(const std::string& name, const Ac3dObject& holder, const ReadOptions& options) {
    Ac3dObject object = holder;
    object.is_placeholder = !holder.is_excluded && !options.placeholders && is_stand_in(name);
    object.is_excluded = holder.is_excluded || object.is_placeholder || options.excluded.contains(name);
    const auto group = std::ranges::find_if(options.groups, [&](const auto& names) { return names.contains(name); });
    if (holder.group == invalid_index && group != options.groups.end()) {
        object.group = static_cast<std::uint32_t>(group - options.groups.begin());
    }
    if (const auto move = options.moved.find(name); move != options.moved.end()) {
        object.moved = holder.moved.of(move->second);
    }
    if (const auto other = options.repainted.find(name); other != options.repainted.end()) {
        object.picture = other->second;
    }
    return object;
}

float colour_part(std::string_view word, const TextScanner& words) {
    const auto value = finite_number(word);
    if (!value || *value < 0.0 || *value > 1.0) { words.refuse("a part of a colour of 0 to 1", in_quotes(word)); }
    return static_cast<float>(*value);
}

/// Of a transparency as the file has it; words that are no numbers are opaque, and so is what hides nearly all: files
/// have such solid parts, as rotor blades, for FlightGear to draw them late or to fade them.
float opacity_of(std::string_view trans) {
    constexpr double solid_below = 0.05;
    const double given = std::clamp(finite_number(trans).value_or(0.0), 0.0, 1.0);
    return given < solid_below ? 1.0F : 1.0F - static_cast<float>(given);
}

/// Takes a name, in quotes or not, off the front of a line that `words` has just read.
std::string read_ac3d_name(std::string_view& line, const TextScanner& words) {
    const bool quoted = line.starts_with('"');
    const std::size_t end = line.find(quoted ? '"' : ' ', quoted ? 1 : 0);
    if (quoted && end == std::string_view::npos) { words.refuse("a name in quotes", in_quotes(line)); }
    const std::size_t last = std::min(end, line.size());
    std::string name(line.substr(quoted ? 1 : 0, last - (quoted ? 1 : 0)));
    line.remove_prefix(std::min(last + 1, line.size()));
    return name;
}

/// The materials of an AC3D file, which surfaces name by number.
class Ac3dMaterials {
public:
    /// Reads what follows `word`, which should be MATERIAL or MAT, from `words`. Throws Error.
    void take(std::string_view word, TextScanner& words) {
        if (word == "MATERIAL") {
            take_line(words);
        } else if (word == "MAT") {
            read_block(words);
        } else {
            words.refuse_last("MATERIAL or OBJECT");
        }
    }

    std::size_t count() const { return materials_.size(); }

    /// The mesh's number of a material, below count(), or of none (invalid_index), with a picture's file or without
    /// (empty). Materials come into the mesh in the order of their first polygon.
    std::uint32_t used(std::uint32_t number, const std::string& picture, MeshBuilder& mesh) {
        if (number == invalid_index) { return invalid_index; }
        FileMaterial& material = materials_[number];
        const auto [at, is_new] = material.index_by_picture.try_emplace(picture, invalid_index);
        if (is_new) {
            material.material.picture = picture;
            at->second = mesh.add_material(material.material);
        }
        return at->second;
    }

private:
    struct FileMaterial {
        Material material;
        std::map<std::string, std::uint32_t> index_by_picture = {}; ///< by pictures
    };

    /// Reads the rest of a line MATERIAL "name" rgb R G B ...
    void take_line(TextScanner& words) {
        std::string_view rest = words.rest_of_line();
        Material material{.name = read_ac3d_name(rest, words)};
        const auto parts = split_words(rest);
        if (parts.size() < 4 || parts[0] != "rgb") { words.refuse("rgb and three numbers", in_quotes(rest)); }
        for (int part = 0; part < 3; ++part) {
            material.colour[part] = colour_part(parts[static_cast<std::size_t>(part) + 1], words);
        }
        const auto trans = std::ranges::find(parts, "trans");
        const bool has_trans = trans != parts.end() && trans + 1 != parts.end();
        if (has_trans) { material.opacity = opacity_of(*(trans + 1)); }
        materials_.push_back({std::move(material)});
    }

    /// Reads MAT "name", lines such as rgb R G B, ENDMAT, which version c of the format has.
    void read_block(TextScanner& words) {
        std::string_view rest = words.rest_of_line();
        Material material{.name = read_ac3d_name(rest, words)};
        for (std::string_view word; (word = words.word("ENDMAT")) != "ENDMAT";) {
            for (int part = 0; word == "rgb" && part < 3; ++part) {
                material.colour[part] = colour_part(words.word("a part of a colour"), words);
            }
            const auto rest_words = split_words(words.rest_of_line());
            if (word == "trans" && !rest_words.empty()) { material.opacity = opacity_of(rest_words[0]); }
        }
        materials_.push_back({std::move(material)});
    }

    std::vector<FileMaterial> materials_;
};

constexpr std::size_t largest_ac3d_bytes = std::size_t{1} << 30U;
constexpr int max_ac3d_depth = 100;
constexpr long max_count = 0x7fffffff;
constexpr std::size_t min_vertex_bytes = 6; ///< "0 0 0" and what parts it from the next

/// Keywords of an object that say nothing about its shape.
constexpr std::array<std::string_view, 6> ignored_keywords{"subdiv", "url", "hidden", "locked", "folded", "showname"};

class Ac3dReading {
public:
    Ac3dReading(const std::filesystem::path& path, std::string_view text, const ReadOptions& options)
        : path_(path), options_(options), words_(path, text, mesh_text), mesh_(path, options) {}

    /// What the file holds, to be finished.
    MeshBuilder read() {
        const std::string_view magic = words_.word("AC3D");
        if (!magic.starts_with("AC3D")) { words_.refuse("AC3D", in_quotes(magic)); }
        words_.rest_of_line();
        while (true) {
            const std::string_view word = words_.word("MATERIAL or OBJECT");
            if (word == "OBJECT") { break; }
            materials_.take(word, words_);
        }
        take_object({}, 0);
        add_notes();
        return std::move(mesh_);
    }

private:
    /// Reads what follows OBJECT, its kids included.
    void take_object(const AffineTransform& parent, int depth) {
        if (depth > max_ac3d_depth) {
            words_.refuse(fmt::format("objects at most {} deep", max_ac3d_depth), "a deeper one");
        }
        words_.word("a kind of object");
        AffineTransform own;
        ObjectPicture picture;
        crease_rad_ = rad_from_deg(default_crease_deg);
        ++smoothing_group_; // objects do not share vertices
        const Ac3dObject holder = object_;
        const std::size_t first_vertex = mesh_.vertex_count();
        while (true) {
            const std::string_view word = words_.word("kids");
            if (word == "kids") { break; }
            if (word == "loc") {
                own.shift_m = vector();
            } else if (word == "rot") {
                take_turn(own.turn);
            } else if (word == "numvert") {
                take_vertices(object_.moved.of(parent.of(own)));
            } else if (word == "numsurf") {
                take_surfaces(first_vertex, parent.of(own).mirrors(), picture);
            } else if (word == "name") {
                std::string_view rest = words_.rest_of_line();
                const std::string name = read_ac3d_name(rest, words_);
                object_ = object_settings(name, holder, options_);
                stand_ins_ += static_cast<std::size_t>(object_.is_placeholder);
            } else if (word == "crease") {
                crease_rad_ = rad_from_deg(std::clamp(words_.number("an angle"), 0.0, 180.0));
            } else if (word == "texture") {
                take_picture(picture);
            } else if (word == "texrep" || word == "texoff") {
                take_pair(word == "texrep" ? picture.repeat : picture.shift);
            } else if (word == "data") {
                const long bytes = words_.integer("a number of bytes", 0, max_count);
                words_.rest_of_line();
                words_.skip_bytes(static_cast<std::size_t>(bytes) + 1, "data");
            } else if (word == "MATERIAL" || word == "MAT") {
                materials_.take(word, words_);
            } else if (std::ranges::find(ignored_keywords, word) != ignored_keywords.end()) {
                words_.rest_of_line();
            } else {
                words_.refuse_last("a line of an object");
            }
        }
        const long kids = words_.integer("a number of kids", 0, max_count);
        for (long kid = 0; kid < kids; ++kid) {
            const std::string_view word = words_.word_or_end();
            if (word.empty() && mesh_.vertex_count() > 0) {
                missing_kids_ += kids - kid;
                break;
            }
            if (word != "OBJECT") { words_.refuse("OBJECT", word.empty() ? "the end of the file" : in_quotes(word)); }
            take_object(parent.of(own), depth + 1);
        }
        object_ = holder;
    }

    /// How an object's picture lies on its surfaces.
    struct ObjectPicture {
        PolygonPicture shown = {};
        std::string file = {}; ///< named by materials; empty where pictures are baked
        bool is_named = false;
        glm::vec2 repeat{1.0F};
        glm::vec2 shift{0.0F};
    };

    /// The picture that stands in for the one of the object at hand; empty for none.
    const std::string& repainted() const {
        const auto all = options_.repainted.find("");
        return !object_.picture.empty() || all == options_.repainted.end() ? object_.picture : all->second;
    }

    void take_picture(ObjectPicture& picture) {
        std::string_view rest = words_.rest_of_line();
        const std::string own = read_ac3d_name(rest, words_);
        picture.is_named = !own.empty() && own != "empty_texture_no_mapping";
        const std::string& name = repainted().empty() ? own : repainted();
        if (picture.is_named && !mesh_.uses_pictures()) {
            picture.file = picture_file(path_, name);
        } else if (picture.is_named) {
            picture.shown = {.picture = mesh_.pictures().picture(name)};
        }
    }

    void take_pair(glm::vec2& pair) {
        pair.x = static_cast<float>(words_.number("a number"));
        pair.y = static_cast<float>(words_.number("a number"));
    }

    /// What follows a corner's vertex: where it lies on the picture, from the lower left corner. No index where the
    /// object has no picture.
    std::uint32_t taken_place(const ObjectPicture& picture) {
        const auto words = split_words(words_.rest_of_line());
        if (!picture.is_named || words.size() < 2) { return invalid_index; }
        const glm::vec2 place(static_cast<float>(finite_number(words[0]).value_or(0.0)),
            static_cast<float>(finite_number(words[1]).value_or(0.0)));
        return mesh_.add_texture_coordinates(place * picture.repeat + picture.shift);
    }

    glm::dvec3 vector() {
        const double x = words_.number("a coordinate");
        const double y = words_.number("a coordinate");
        const double z = words_.number("a coordinate");
        return {x, y, z};
    }

    /// Reads a rotation matrix, row after row.
    void take_turn(glm::dmat3& turn) {
        for (int row = 0; row < 3; ++row) {
            const glm::dvec3 numbers = vector();
            for (int column = 0; column < 3; ++column) { turn[column][row] = numbers[column]; }
        }
    }

    void take_vertices(const AffineTransform& placement) {
        const long count = words_.integer("a number of vertices", 0, max_count);
        const auto most = static_cast<long>(words_.bytes_left() / min_vertex_bytes);
        if (count > most) {
            words_.refuse(fmt::format("at most {} vertices in a file of this size", most), std::to_string(count));
        }
        for (long i = 0; i < count; ++i) {
            const auto place_m = placement.point_m(vector());
            if (!place_m) { words_.refuse("a vertex within bounds", "one that its object moves out of them"); }
            mesh_.add_vertex(*place_m);
        }
    }

    void take_surfaces(std::size_t first_vertex, bool mirrored, const ObjectPicture& picture) {
        const long count = words_.integer("a number of surfaces", 0, max_count);
        for (long i = 0; i < count; ++i) {
            const std::string_view word = words_.word("SURF");
            if (word != "SURF") { words_.refuse_last("SURF"); }
            take_surface(first_vertex, mirrored, picture);
        }
    }

    unsigned flags() {
        const std::string_view word = words_.word("flags of a surface");
        std::string_view digits = word;
        const bool hex = digits.starts_with("0x") || digits.starts_with("0X");
        digits.remove_prefix(hex ? 2 : 0);
        unsigned value = 0;
        const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value, hex ? 16 : 10);
        if (code != std::errc() || end != digits.data() + digits.size()) { words_.refuse_last("flags of a surface"); }
        return value;
    }

    void take_surface(std::size_t first_vertex, bool mirrored, const ObjectPicture& picture) {
        const unsigned kind = flags();
        std::uint32_t material = invalid_index;
        std::string_view word = words_.word("mat or refs");
        if (word == "mat") {
            const auto last = static_cast<long>(materials_.count()) - 1;
            material = static_cast<std::uint32_t>(words_.integer("a material", 0, last));
            word = words_.word("refs");
        }
        if (word != "refs") { words_.refuse_last("refs"); }
        const bool is_polygon = (kind & 0xfU) == 0;
        const long most = is_polygon ? static_cast<long>(max_polygon_corners) : max_count;
        const long count = words_.integer("a number of corners", 0, most);
        const long last = static_cast<long>(mesh_.vertex_count() - first_vertex) - 1;
        corners_.clear();
        for (long i = 0; i < count; ++i) {
            const long vertex = words_.integer("a vertex", 0, last);
            const std::uint32_t texture = taken_place(picture);
            if (is_polygon) {
                corners_.push_back(
                    {.vertex = static_cast<std::uint32_t>(first_vertex + static_cast<std::size_t>(vertex)),
                        .normal = invalid_index,
                        .texture = texture});
            }
        }
        if (!is_polygon || count < 3) {
            ++skipped_;
            return;
        }
        if (object_.is_excluded) { return; }
        const bool is_two_sided = (kind & 0x20U) != 0;
        two_sided_ += static_cast<std::size_t>(is_two_sided && !mesh_.adds_back_faces());
        mesh_.set_two_sided(is_two_sided);
        const bool is_smooth = (kind & 0x10U) != 0;
        mesh_.set_smoothing({is_smooth ? smoothing_group_ : Smoothing::flat, static_cast<float>(crease_rad_)});
        mesh_.set_group(object_.group);
        if (mirrored) { std::ranges::reverse(corners_); }
        mesh_.add_polygon(corners_, materials_.used(material, picture.file, mesh_), picture.shown);
    }

    void add_notes() {
        if (missing_kids_ > 0) {
            mesh_.add_note(
                fmt::format("{}: the file ends {} objects before what it announces", path_.string(), missing_kids_));
        }
        if (stand_ins_ > 0) {
            mesh_.add_note(fmt::format("{}: {} objects are left out that stand for turning blades, light or shadows",
                path_.string(), stand_ins_));
        }
        if (skipped_ > 0) {
            mesh_.add_note(
                fmt::format("{}: {} lines and other surfaces without an area are not read", path_.string(), skipped_));
        }
        if (two_sided_ > 0) {
            mesh_.add_note(
                fmt::format("{}: {} two-sided surfaces are read with their front only", path_.string(), two_sided_));
        }
    }

    std::filesystem::path path_;
    ReadOptions options_;
    TextScanner words_;
    MeshBuilder mesh_;
    Ac3dMaterials materials_;
    std::vector<CornerIndices> corners_;
    std::size_t stand_ins_ = 0; ///< objects left out
    std::size_t skipped_ = 0;
    std::size_t two_sided_ = 0;
    double crease_rad_ = 0.0; ///< of the object at hand
    std::uint32_t smoothing_group_ = Smoothing::flat;
    long missing_kids_ = 0; ///< that are announced and not there
    Ac3dObject object_;     ///< at hand
};

} // namespace

MeshBuilder read_ac3d(const std::filesystem::path& path, const ReadOptions& options) {
    const std::string text = read_text_file(path, largest_ac3d_bytes);
    MeshBuilder mesh = Ac3dReading(path, text, options).read();
    if (!mesh.is_empty() || options.placeholders) { return mesh; }
    ReadOptions all = options;
    all.placeholders = true;
    return Ac3dReading(path, text, all).read();
}

std::set<std::string> ac3d_object_names(const std::filesystem::path& path) {
    const std::string text = read_text_file(path, largest_ac3d_bytes);
    TextScanner words(path, text, mesh_text);
    std::set<std::string> names;
    for (std::string_view word; !(word = words.word_or_end()).empty();) {
        std::string_view rest = words.rest_of_line();
        if (word == "name") { names.insert(read_ac3d_name(rest, words)); }
    }
    return names;
}

std::string single_picture(const TriangleMesh& mesh) {
    std::string found;
    for (const Material& material : mesh.materials) {
        if (!found.empty() && !material.picture.empty() && material.picture != found) { return {}; }
        found = material.picture.empty() ? found : material.picture;
    }
    return found;
}

std::string ac3d_text(const TriangleMesh& mesh) {
    std::string text = "AC3Db\n";
    const std::vector<std::string> names = unique_material_names(mesh.materials);
    for (std::size_t m = 0; m < names.size(); ++m) {
        const glm::vec3& colour = mesh.materials[m].colour;
        text += fmt::format("MATERIAL \"{}\" rgb {} {} {} amb 0.2 0.2 0.2 emis 0 0 0 spec 0 0 0 shi 10 trans {}\n",
            names[m], colour.x, colour.y, colour.z, 1.0F - mesh.materials[m].opacity);
    }
    text += "OBJECT world\nkids 1\nOBJECT poly\nname \"mesh\"\n";
    if (const std::string picture = single_picture(mesh); !picture.empty()) {
        text += fmt::format("texture \"{}\"\n", picture);
    }
    text += fmt::format("numvert {}\n", mesh.vertices_m.size());
    for (const glm::dvec3& place_m : mesh.vertices_m) {
        text += fmt::format("{} {} {}\n", place_m.x, place_m.y, place_m.z);
    }
    text += fmt::format("numsurf {}\n", mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        text += "SURF 0x10\n";
        if (!mesh.triangle_materials.empty()) { text += fmt::format("mat {}\n", mesh.triangle_materials[t]); }
        text += "refs 3\n";
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t texture =
                mesh.corner_texture_coordinates.empty() ? invalid_index : mesh.corner_texture_coordinates[t][k];
            const glm::vec2 place = texture == invalid_index ? glm::vec2(0.0F) : mesh.texture_coordinates[texture];
            text += fmt::format("{} {} {}\n", mesh.triangles[t][k], place.x, place.y);
        }
    }
    text += "kids 0\n";
    return text;
}

} // namespace octant::models::meshfile
