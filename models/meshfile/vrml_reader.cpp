#include "models/meshfile/mesh_builder.h"
#include "models/meshfile/mesh_formats.h"
#include "models/meshfile/affine_transform.h"
#include "models/meshfile/vrml_fields.h"
#include "models/meshfile/vrml_nodes.h"
#include "models/meshfile/vrml_tokenizer.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <tuple>
#include <utility>

namespace octant::models::meshfile {

namespace {

constexpr std::size_t largest_vrml_bytes = std::size_t{1} << 28U;
constexpr int max_vrml_depth = 200;
constexpr std::size_t max_visits = 1'000'000; ///< of nodes that USE brings back again and again
constexpr std::size_t max_vrml_numbers = std::size_t{1}
                                          << 27U; ///< of corners and points, likewise

/// Grouping nodes, with the field that holds their children.
constexpr std::array<std::pair<std::string_view, std::string_view>, 6> groups{
    {{"Transform", "children"},
     {"Group", "children"},
     {"Anchor", "children"},
     {"Billboard", "children"},
     {"Collision", "children"},
     {"LOD", "level"}}};

/// The lists of an IndexedFaceSet; indices are empty where the file gives none.
struct FaceSet {
    std::vector<long> corners;
    std::vector<long> colour_indices;
    std::vector<long> normal_indices;
    std::vector<glm::dvec3> colours;
    std::size_t normals = 0;
    std::uint32_t first_normal = 0; ///< of the mesh's
    bool colour_per_vertex = true;
    bool normal_per_vertex = true;
    bool counter_clockwise = true;
    int line = 1;
};

class VrmlReading {
public:
    VrmlReading(const std::filesystem::path& path, std::string_view text)
        : path_(path)
        , file_(read_vrml_nodes(path_, text))
        , fields_(path_, file_)
        , mesh_(path)
        , used_materials_(file_.nodes.size(), invalid_index) {}

    TriangleMesh read() {
        for (const std::uint32_t root : file_.roots) {
            visit(root, {}, 0, 0);
        }
        if (file_.has_prototypes) {
            mesh_.add_note(fmt::format("{}: prototypes are not read", path_.string()));
        }
        if (has_textures_) {
            mesh_.add_note(fmt::format(
                "{}: texture coordinates and pictures are not read", path_.string()));
        }
        return mesh_.finish();
    }

private:
    [[noreturn]] void refuse(int line, std::string_view expected, std::string_view got) const {
        throw_error_at(path_, line, fmt::format("expected {}, got {}", expected, got));
    }

    /// `group` tells apart the places at which a node is met.
    void visit(std::uint32_t at, const AffineTransform& placement, std::size_t group, int depth) {
        const VrmlNode& node = file_.nodes[at];
        if (depth > max_vrml_depth || ++visits_ > max_visits) {
            refuse(
                node.line,
                fmt::format("at most {} nodes, {} deep", max_visits, max_vrml_depth),
                "more");
        }
        if (node.type == "Shape") {
            take_shape(node, placement, group);
            return;
        }
        if (node.type == "Switch") {
            take_switch(node, placement, depth);
            return;
        }
        const auto* const kind =
            std::ranges::find(groups, node.type, [](const auto& g) { return g.first; });
        const VrmlField* children = kind == groups.end() ? nullptr : node.field(kind->second);
        if (children == nullptr) {
            return;
        }
        const bool first_only = node.type == "LOD";
        const AffineTransform inner =
            node.type == "Transform" ? placement.of(fields_.placement(node)) : placement;
        const std::size_t inner_group = visits_;
        for (const std::uint32_t child : children->nodes) {
            visit(child, inner, inner_group, depth + 1);
            if (first_only) {
                return;
            }
        }
    }

    void take_switch(const VrmlNode& node, const AffineTransform& placement, int depth) {
        const VrmlField* which = node.field("whichChoice");
        const VrmlField* choices = node.field("choice");
        if (which == nullptr || choices == nullptr) {
            return;
        }
        const long chosen = VrmlTokenizer(path_, which->text, which->line).whole("a choice");
        if (chosen >= 0 && std::cmp_less(chosen, choices->nodes.size())) {
            visit(choices->nodes[static_cast<std::size_t>(chosen)], placement, visits_, depth + 1);
        }
    }

    void take_shape(const VrmlNode& shape, const AffineTransform& placement, std::size_t group) {
        const VrmlNode* set = fields_.only_node(shape, "geometry");
        const VrmlNode* coord = set == nullptr ? nullptr : fields_.only_node(*set, "coord");
        if (coord == nullptr || set->type != "IndexedFaceSet") {
            return;
        }
        has_textures_ = has_textures_ || set->field("texCoord") != nullptr;
        FaceSet faces;
        faces.corners = fields_.indices(*set, "coordIndex");
        count_numbers(faces.corners.size(), set->line);
        faces.colour_indices = fields_.indices(*set, "colorIndex");
        faces.normal_indices = fields_.indices(*set, "normalIndex");
        faces.colours = fields_.triples(*set, "color", "color");
        faces.colour_per_vertex = fields_.flag(*set, "colorPerVertex");
        faces.normal_per_vertex = fields_.flag(*set, "normalPerVertex");
        faces.counter_clockwise = fields_.flag(*set, "ccw") != placement.mirrors();
        faces.line = set->line;
        std::ranges::for_each(
            faces.colours, [&](const glm::dvec3& colour) { check_colour(colour, set->line); });
        faces.first_normal = static_cast<std::uint32_t>(mesh_.normal_count());
        for (const glm::dvec3& normal : fields_.triples(*set, "normal", "vector")) {
            mesh_.add_normal(placement.normal(normal));
            ++faces.normals;
        }
        take_points(*set, *coord, placement, group);
        take_faces(faces, material_of(shape));
    }

    /// What a node holds counts each time that it is met.
    void count_numbers(std::size_t count, int line) {
        numbers_ += count;
        if (numbers_ > max_vrml_numbers) {
            refuse(line, fmt::format("at most {} corners and points", max_vrml_numbers), "more");
        }
    }

    /// Shapes of one group that have the same points share their vertices.
    void take_points(
        const VrmlNode& set, const VrmlNode& coord, const AffineTransform& placement, std::size_t group) {
        const auto key = std::pair(group, fields_.place_of(coord));
        const auto known = points_.find(key);
        if (known != points_.end()) {
            std::tie(first_point_, point_count_) = known->second;
            return;
        }
        first_point_ = mesh_.vertex_count();
        for (const glm::dvec3& own_m : fields_.triples(set, "coord", "point")) {
            const auto place_m = placement.point_m(own_m);
            if (!place_m) {
                refuse(coord.line, "points within bounds", "one that its node moves out of them");
            }
            mesh_.add_vertex(*place_m);
        }
        point_count_ = mesh_.vertex_count() - first_point_;
        count_numbers(point_count_, coord.line);
        coloured_.resize(mesh_.vertex_count());
        points_.emplace(key, std::pair(first_point_, point_count_));
    }

    void check_colour(const glm::dvec3& colour, int line) const {
        for (int part = 0; part < 3; ++part) {
            if (colour[part] < 0.0 || colour[part] > 1.0) {
                refuse(line, "colours of numbers 0..1", fmt::format("{}", colour[part]));
            }
        }
    }

    std::uint32_t material_of(const VrmlNode& shape) {
        const VrmlNode* appearance = fields_.only_node(shape, "appearance");
        const VrmlNode* node =
            appearance == nullptr ? nullptr : fields_.only_node(*appearance, "material");
        if (node == nullptr || node->type != "Material") {
            return invalid_index;
        }
        std::uint32_t& used = used_materials_[fields_.place_of(*node)];
        if (used == invalid_index) {
            const glm::dvec3 colour = fields_.vector(*node, "diffuseColor", glm::dvec3(0.8));
            check_colour(colour, node->line);
            const std::string name(node->name.empty() ? "material" : node->name);
            used = mesh_.add_material({name, glm::vec3(colour)});
        }
        return used;
    }

    void take_faces(const FaceSet& faces, std::uint32_t material) {
        std::size_t first = 0;
        for (std::size_t face = 0; first < faces.corners.size(); ++face) {
            const auto begin = faces.corners.begin() + static_cast<long>(first);
            const auto end = std::find(begin, faces.corners.end(), -1);
            const auto count = static_cast<std::size_t>(end - begin);
            if (count < 3 || count > max_polygon_corners) {
                refuse(
                    faces.line,
                    fmt::format("faces of 3 to {} corners", max_polygon_corners),
                    std::to_string(count));
            }
            take_face(faces, face, first, count, material);
            first += count + 1;
        }
    }

    std::size_t checked(long index, std::size_t count, const FaceSet& faces, const char* what) {
        if (index < 0 || std::cmp_greater_equal(index, count)) {
            refuse(faces.line, fmt::format("{} below {}", what, count), std::to_string(index));
        }
        return static_cast<std::size_t>(index);
    }

    /// Index of a colour or a normal: of its own list, of the corner's point or of the face.
    std::size_t attribute(
        const FaceSet& faces,
        const std::vector<long>& own,
        bool per_vertex,
        std::size_t face,
        std::size_t corner,
        std::size_t count,
        const char* what) {
        const std::size_t at = per_vertex ? corner : face;
        if (!own.empty()) {
            return checked(at < own.size() ? own[at] : -1, count, faces, what);
        }
        return checked(
            per_vertex ? faces.corners[corner] : static_cast<long>(face), count, faces, what);
    }

    void take_face(
        const FaceSet& faces,
        std::size_t face,
        std::size_t first,
        std::size_t count,
        std::uint32_t material) {
        polygon_.clear();
        for (std::size_t corner = first; corner < first + count; ++corner) {
            const std::size_t point =
                checked(faces.corners[corner], point_count_, faces, "a point");
            CornerIndices made{static_cast<std::uint32_t>(first_point_ + point)};
            if (!faces.colours.empty() && faces.colour_per_vertex) {
                made.vertex = coloured(
                    made.vertex,
                    glm::vec3(faces.colours[attribute(
                        faces,
                        faces.colour_indices,
                        true,
                        face,
                        corner,
                        faces.colours.size(),
                        "a colour")]));
            }
            if (faces.normals > 0) {
                made.normal = faces.first_normal + static_cast<std::uint32_t>(attribute(
                                                       faces,
                                                       faces.normal_indices,
                                                       faces.normal_per_vertex,
                                                       face,
                                                       corner,
                                                       faces.normals,
                                                       "a normal"));
            }
            polygon_.push_back(made);
        }
        if (!faces.counter_clockwise) {
            std::ranges::reverse(polygon_);
        }
        if (!faces.colours.empty() && !faces.colour_per_vertex) {
            material = face_material(faces.colours[attribute(
                faces,
                faces.colour_indices,
                false,
                face,
                first,
                faces.colours.size(),
                "a colour")]);
        }
        mesh_.add_polygon(polygon_, material);
    }

    /// The vertex itself, or for each further colour a copy of it.
    std::uint32_t coloured(std::uint32_t vertex, const glm::vec3& colour) {
        if (!coloured_[vertex]) {
            coloured_[vertex] = true;
            mesh_.set_colour(vertex, colour);
            copies_[{vertex, colour.x, colour.y, colour.z}] = vertex;
            return vertex;
        }
        const auto [at, is_new] =
            copies_.try_emplace({vertex, colour.x, colour.y, colour.z}, invalid_index);
        if (is_new) {
            at->second = mesh_.add_vertex(mesh_.vertex_m(vertex));
            mesh_.set_colour(at->second, colour);
            coloured_.resize(mesh_.vertex_count(), true);
        }
        return at->second;
    }

    /// The material that stands for a colour of whole faces.
    std::uint32_t face_material(const glm::dvec3& colour) {
        const auto [at, is_new] =
            face_materials_.try_emplace({colour.x, colour.y, colour.z}, invalid_index);
        if (is_new) {
            at->second = mesh_.add_material(
                {fmt::format("face colour {}", face_materials_.size()), glm::vec3(colour)});
        }
        return at->second;
    }

    std::filesystem::path path_;
    VrmlFile file_;
    VrmlFields fields_;
    MeshBuilder mesh_;
    std::vector<std::uint32_t> used_materials_; ///< of each node
    std::map<std::pair<std::size_t, std::uint32_t>, std::pair<std::size_t, std::size_t>> points_;
    std::size_t first_point_ = 0; ///< of the face set at hand
    std::size_t point_count_ = 0;
    std::vector<bool> coloured_; ///< vertices that have a colour
    std::map<std::tuple<std::uint32_t, float, float, float>, std::uint32_t> copies_;
    std::map<std::tuple<double, double, double>, std::uint32_t> face_materials_;
    std::vector<CornerIndices> polygon_;
    std::size_t visits_ = 0;
    std::size_t numbers_ = 0; ///< met so far
    bool has_textures_ = false;
};

} // namespace

TriangleMesh read_vrml_mesh(const std::filesystem::path& path) {
    const std::string text = read_text_file(path, largest_vrml_bytes);
    return VrmlReading(path, text).read();
}

} // namespace octant::models::meshfile
