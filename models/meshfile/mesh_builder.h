#pragma once

#include "models/heights/image.h"
#include "models/meshfile/mesh_parts.h"
#include "models/meshfile/picture_path.h"
#include "models/meshfile/smooth_normals.h"
#include "models/meshfile/texture_store.h"
#include "models/triangle_mesh.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::models::meshfile {

/// Whether a name in lower case says that an object represents a shadow on the ground.
bool names_shadow(std::string_view lower_name);

/// The first part of a colour outside 0..1 (also NaN); nothing for a valid colour.
std::optional<double> colour_fault(const glm::dvec3& colour);

/// The picture of a polygon, and how the file says that it lies there.
struct PolygonPicture {
    /// The index of no picture.
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    std::uint32_t picture = none; ///< index into BakedPictures
    TextureWrap wrap_u = TextureWrap::Repeat;
    TextureWrap wrap_v = TextureWrap::Repeat;
    /// Nothing: the file does not say what alpha does. Then the picture decides.
    std::optional<TextureAlpha> alpha = {};
    float threshold = 0.5F;

    auto operator<=>(const PolygonPicture&) const = default;
};

/// The pixels of a picture, four bytes each, row after row from the top; they stay with their owner.
struct PictureView {
    int width = 0;
    int height = 0;
    std::span<const std::uint8_t> rgba;
    bool ignores_alpha = false; ///< all pixels count as opaque
};

/// The texture pictures of a mesh, and the vertex colours computed from them.
class BakedPictures {
public:
    /// The index of no picture.
    static constexpr std::uint32_t none = PolygonPicture::none;

    /// `options` say where pictures are looked for and what is kept of them.
    BakedPictures(std::filesystem::path mesh_file, const ReadOptions& options);

    /// Loads a picture by its name as picture_file finds it. Returns its index; `none` if it cannot be read.
    std::uint32_t picture(const std::string& name);

    /// Loads a picture from its encoded bytes. `name` is only used in notes.
    std::uint32_t picture(const std::string& name, std::string_view bytes);

    /// Adds the next triangle of the mesh: its picture or `none`, and the positions of its corners in the picture, 0..1
    /// from the upper left corner. The picture repeats outside 0..1.
    void add_triangle(const PolygonPicture& picture, const std::array<glm::vec2, 3>& places);

    /// The opacity of a picture over a triangle.
    struct Cover {
        float opacity = 1.0F;   ///< mean
        bool is_uniform = true; ///< nearly constant over the triangle
        bool is_graded = false; ///< mostly neither nearly 0 nor nearly 1, where alpha does not only cut holes
    };

    /// Returns one entry for each triangle added.
    std::vector<Cover> covers() const;

    /// Removes triangles; `gone` has one entry for each triangle added.
    void take_out(const std::vector<bool>& gone);

    bool is_empty() const { return pictures_.empty(); }

    /// Sets each vertex colour to the mean colour around the vertex: picture times material colour, or the material
    /// colour alone. Vertices at one position get one colour. The mesh's triangles must be those added.
    void bake(TriangleMesh& mesh) const;

    /// A material with this picture in place of its own: its file or bytes, and its texture.
    Material shown_on(Material material, const PolygonPicture& shown) const;

    /// One line for each picture that could not be used.
    const std::vector<std::string>& notes() const { return notes_; }

private:
    /// A decoded picture: as an image or, where textures are kept, as a texture. Copies share it.
    struct Picture {
        std::shared_ptr<const heights::Image> image;
        std::shared_ptr<const TexturePicture> texture;
        std::string name; ///< its file, or the name of one inside the mesh's file
        std::shared_ptr<const std::string> bytes;
        bool is_opaque = true;
    };

    struct TexturedTriangle {
        std::uint32_t picture = none;
        bool ignores_alpha = false;
        bool is_cut = false; ///< the file says that alpha only cuts holes
        std::array<glm::vec2, 3> places{};
    };

    template <typename Read>
    std::uint32_t kept(const std::string& name, Read&& read);
    PictureView view_of(const TexturedTriangle& triangle) const;

    std::filesystem::path mesh_file_;
    std::filesystem::path folder_;
    std::shared_ptr<TextureStore> store_; ///< null: textures are not kept
    std::vector<Picture> pictures_;
    std::map<std::string, std::uint32_t> known_;
    std::vector<TexturedTriangle> triangles_;
    std::vector<std::string> notes_;
};

/// One corner of a polygon as a file names it.
struct CornerIndices {
    std::uint32_t vertex = invalid_index;
    std::uint32_t normal = invalid_index;
    std::uint32_t texture = invalid_index; ///< result of add_texture_coordinates
};

/// Builds a mesh for all readers: cuts polygons into triangles, replaces faulty normals, adds missing materials.
/// Readers must check what they add: finite numbers, indices in range, 3 to max_polygon_corners corners.
class MeshBuilder {
public:
    /// The mesh gets the name of the file.
    explicit MeshBuilder(const std::filesystem::path& path, const ReadOptions& options = {});

    bool uses_pictures() const { return options_.pictures; }

    const ReadOptions& options() const { return options_; }

    bool adds_back_faces() const { return options_.backs; }

    /// Sets whether the polygons added next are two-sided.
    void set_two_sided(bool two_sided) { is_two_sided_ = two_sided; }

    BakedPictures& pictures() { return pictures_; }

    bool is_empty() const { return mesh_.triangles.empty(); }

    std::size_t vertex_count() const { return mesh_.vertices_m.size(); }

    const glm::dvec3& vertex_m(std::uint32_t vertex) const { return mesh_.vertices_m[vertex]; }

    std::size_t normal_count() const { return mesh_.normals.size(); }

    std::uint32_t add_vertex(const glm::dvec3& position_m);

    /// Vertices without a colour are white if any vertex has one.
    void set_colour(std::uint32_t vertex, const glm::vec3& colour);

    /// Normalizes the vector unless it is a unit vector already. A zero vector is replaced at each corner by the
    /// triangle's own normal.
    std::uint32_t add_normal(const glm::dvec3& normal);

    /// Coordinates count from the picture's lower left corner. A triangle gets none if one of its corners has none or
    /// has coordinates that are not finite.
    std::uint32_t add_texture_coordinates(const glm::vec2& coordinates);

    std::size_t texture_coordinates_count() const { return mesh_.texture_coordinates.size(); }

    std::uint32_t add_material(Material material);

    const Material& material(std::uint32_t number) const { return mesh_.materials[number]; }

    /// The material of all faces to which the file gives this colour; added when it is first used.
    std::uint32_t face_colour_material(const glm::vec3& colour);

    /// Sets how the polygons added next are shaded, for their corners without a normal.
    void set_smoothing(const Smoothing& smoothing) { smoothing_ = smoothing; }

    /// Sets the group (index into ReadOptions::groups) of the polygons added next; invalid_index: none.
    void set_group(std::uint32_t group) { group_ = group; }

    /// Cuts a polygon into triangles (polygons::triangulate_polygon) and adds them.
    void add_polygon(std::span<const CornerIndices> corners, std::uint32_t material = invalid_index,
        const PolygonPicture& picture = {});

    /// Counts a picture that is not drawn, by what it is for, such as "normals"; the mesh gets a note on them.
    void add_undrawn_picture(const std::string& kind) { ++undrawn_[kind]; }

    void add_note(std::string note) { mesh_.notes.push_back(std::move(note)); }

    /// Returns the finished mesh. Throws Error if it has no triangle.
    TriangleMesh finish();

    /// Returns the finished mesh as separate parts. Throws Error if it has no triangle.
    MeshParts finish_parts();

private:
    void note_undrawn();
    bool is_transparent(std::size_t triangle) const;
    float opacity_of(std::size_t triangle) const;
    void drop_invisible();
    void find_opacities();
    template <typename Kept>
    TriangleMesh part_of(const Kept& is_kept, std::vector<std::string>& notes, bool is_clear = false) const;
    void give_materials_opacity();
    void finish_part();
    void take_out(const std::vector<bool>& gone);
    void add_triangle(const std::array<CornerIndices, 3>& corners, std::uint32_t material);
    std::uint32_t shown_material(std::uint32_t material, const PolygonPicture& picture);
    void blend_textures();
    void leave_out_transparent();
    void bake_pictures();
    void finish_backs();
    void finish_normals();
    void finish_texture_coordinates();
    glm::vec2 on_picture(const CornerIndices& corner) const;
    void finish_materials();

    std::filesystem::path path_;
    ReadOptions options_;
    BakedPictures pictures_;
    TriangleMesh mesh_;
    std::vector<bool> faulty_normals_;
    std::map<std::array<float, 3>, std::uint32_t> face_colours_;
    /// Materials with pictures, by the material that the file names and the picture on it.
    std::map<std::pair<std::uint32_t, PolygonPicture>, std::uint32_t> shown_materials_;
    std::vector<glm::dvec3> places_m_;         ///< corners of the polygon being added
    std::vector<bool> two_sided_;              ///< one for each triangle
    std::map<std::string, int> undrawn_;       ///< pictures, by what they are for
    std::vector<std::uint32_t> groups_;        ///< one for each triangle
    std::vector<BakedPictures::Cover> covers_; ///< one for each triangle, once computed
    std::vector<Smoothing> smoothings_;        ///< one for each triangle
    Smoothing smoothing_;
    std::uint32_t group_ = invalid_index;
    bool is_two_sided_ = false;
    bool is_part_ = false;  ///< this builds a part of a larger mesh
    bool is_clear_ = false; ///< that of its transparent surfaces
    bool has_normals_ = false;
    bool has_texture_coordinates_ = false;
    bool has_materials_ = false;
};

} // namespace octant::models::meshfile
