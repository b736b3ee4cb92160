#pragma once

#include "models/meshfile/affine_transform.h"
#include "models/meshfile/vrml_nodes.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace octant::models::meshfile {

/// Values of the fields of VRML nodes; a field that a node has not gives what VRML says or what
/// the caller does. Faults throw Error "file:line: ...".
class VrmlFields {
public:
    /// Keeps references to both.
    VrmlFields(const std::filesystem::path& path, const VrmlFile& file)
        : path_(path)
        , file_(file) {}

    glm::dvec3
    vector(const VrmlNode& node, std::string_view name, const glm::dvec3& otherwise) const;

    /// The whole numbers of a field; none where the node has no such field.
    std::vector<long> indices(const VrmlNode& node, std::string_view name) const;

    /// Triples of the list `name` of the node in a field of another node; none without either.
    std::vector<glm::dvec3>
    triples(const VrmlNode& node, std::string_view field_name, std::string_view name) const;

    /// The value of a field; true where the node has no such field.
    bool flag(const VrmlNode& node, std::string_view name) const;

    /// The node, or the first one, in a field; null without.
    const VrmlNode* only_node(const VrmlNode& node, std::string_view name) const;

    /// How a Transform places the nodes that it holds.
    AffineTransform placement(const VrmlNode& transform) const;

    /// Place of a node in VrmlFile::nodes.
    std::uint32_t place_of(const VrmlNode& node) const;

private:
    std::vector<double>
    numbers(const VrmlNode& node, std::string_view name, std::vector<double> otherwise) const;
    glm::dmat3 turn(const VrmlNode& node, std::string_view name) const;

    const std::filesystem::path& path_;
    const VrmlFile& file_;
};

} // namespace octant::models::meshfile
