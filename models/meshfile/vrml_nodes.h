#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string_view>
#include <vector>

namespace octant::models::meshfile {

/// A field of a VRML node: nodes, or the text of its other values as it stands in the file.
struct VrmlField {
    std::vector<std::uint32_t> nodes; ///< places in VrmlFile::nodes
    std::string_view text;            ///< without the brackets of a list
    int line = 1;                     ///< where the text begins
};

struct VrmlNode {
    std::string_view type;
    std::string_view name; ///< of its DEF; often empty
    int line = 1;
    std::map<std::string_view, VrmlField> fields; ///< the last one of each name

    /// The field of a name; null where the node has none.
    const VrmlField* field(std::string_view field_name) const;
};

struct VrmlFile {
    std::vector<VrmlNode> nodes;      ///< a node stands behind those in its fields
    std::vector<std::uint32_t> roots; ///< in file order
    bool has_prototypes = false;      ///< passed over, and so are the nodes made of them
};

/// The nodes of a VRML 2.0 (97) file, views into `text`. USE gives the node of the DEF before it,
/// so that no node lies in itself. Throws Error "file:line: ...".
VrmlFile read_vrml_nodes(const std::filesystem::path& path, std::string_view text);

} // namespace octant::models::meshfile
