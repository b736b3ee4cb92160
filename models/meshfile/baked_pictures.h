#pragma once

#include "models/heights/image.h"
#include "models/triangle_mesh.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::models::meshfile {

/// The file of a picture that a mesh names: as it is named, else by its last name, in `folder` (empty: none) or beside
/// the mesh; beside the mesh where there is no such file.
std::filesystem::path picture_file(
    const std::filesystem::path& mesh_file, const std::string& name, const std::filesystem::path& folder = {});

/// The pictures on the surfaces of a mesh, and the colours that they leave at its vertices.
class BakedPictures {
public:
    /// Stands for no picture.
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    /// `folder`: where pictures are looked for before the mesh's own one; empty: there alone.
    explicit BakedPictures(std::filesystem::path mesh_file, std::filesystem::path folder = {})
        : mesh_file_(std::move(mesh_file)), folder_(std::move(folder)) {}

    /// The number of a picture in one of the folders: as it is named, else by its last name. None where there is no
    /// such file, or none that can be read.
    std::uint32_t picture(const std::string& name);

    /// The number of a picture that stands in a file; `name` is only told.
    std::uint32_t picture(const std::string& name, std::string_view bytes);

    /// The next triangle of the mesh: its picture or none, and where its corners lie on it, in shares of width and
    /// height from the upper left corner; beyond 0..1 the picture repeats.
    void add_triangle(std::uint32_t picture, const std::array<glm::vec2, 3>& places);

    /// How a picture hides what lies behind a triangle.
    struct Cover {
        float opacity = 1.0F;   ///< mean
        bool is_uniform = true; ///< about the same all over it
    };

    /// One for each triangle added.
    std::vector<Cover> covers() const;

    /// Takes out triangles that were added; `gone` has one entry for each.
    void take_out(const std::vector<bool>& gone);

    bool is_empty() const { return pictures_.empty(); }

    /// Gives the vertices of a mesh the mean colour around them: of the pictures, times the colour of the material, or
    /// that alone. Vertices at one place get one colour. Its triangles are those added.
    void bake(TriangleMesh& mesh) const;

    /// One line a picture that could not be used.
    const std::vector<std::string>& notes() const { return notes_; }

private:
    struct TexturedTriangle {
        std::uint32_t picture = none;
        std::array<glm::vec2, 3> places{};
    };

    template <typename Read>
    std::uint32_t kept(const std::string& name, Read&& read);

    std::filesystem::path mesh_file_;
    std::filesystem::path folder_;
    std::vector<std::shared_ptr<const heights::Image>> pictures_; ///< copies share them
    std::vector<bool> is_opaque_;                                 ///< one a picture: nothing is seen through it
    std::map<std::string, std::uint32_t> known_;
    std::vector<TexturedTriangle> triangles_;
    std::vector<std::string> notes_;
};

} // namespace octant::models::meshfile
