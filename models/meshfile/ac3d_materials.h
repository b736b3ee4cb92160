#pragma once

#include "models/meshfile/mesh_builder.h"
#include "models/meshfile/word_scanner.h"
#include "models/invalid_index.h"
#include "models/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace octant::models::meshfile {

/// The materials of an AC3D file, which surfaces name by number.
class Ac3dMaterials {
public:
    /// Reads what follows `word`, which should be MATERIAL or MAT, from `words`. Throws Error.
    void take(std::string_view word, WordScanner& words);

    std::size_t count() const { return materials_.size(); }

    /// The mesh's number of a material, below count(), or of none (invalid_index), with a picture's file
    /// or without (empty). Materials come into the mesh in the order of their first polygon.
    std::uint32_t used(std::uint32_t number, const std::string& picture, MeshBuilder& mesh);

private:
    struct FileMaterial {
        Material material;
        float opacity = 1.0F;
        std::map<std::string, std::uint32_t> index_by_picture = {}; ///< by pictures
    };

    void take_line(WordScanner& words);
    void read_block(WordScanner& words);

    std::vector<FileMaterial> materials_;
};

/// Takes a name, in quotes or not, off the front of a line that `words` has just read.
std::string read_ac3d_name(std::string_view& line, const WordScanner& words);

} // namespace octant::models::meshfile
