#pragma once

#include "models/meshfile/mesh_parts.h"
#include "models/meshfile/read_options.h"
#include "models/triangle_mesh.h"

#include <glm/vec3.hpp>

#include <filesystem>
#include <vector>

namespace octant::models::meshfile {

/// A straight line about which something turns in flight; file axes, metres.
struct RotationAxis {
    glm::dvec3 point_m{0.0};
    glm::dvec3 direction{1.0, 0.0, 0.0}; ///< unit; positive turns follow the right-hand rule
    double turns_per_s = 0.0;
};

/// A propeller or a rotor, as it stands at the time 0.
struct RotatingPart {
    TriangleMesh mesh;
    RotationAxis about;
};

/// A model with what turns in flight, and what is clear, apart from all else.
struct RotatingModel {
    TriangleMesh body; ///< never without a triangle
    std::vector<RotatingPart> parts;
    TransparentSurfaces clear;
};

/// As read_mesh, for the same files; only FlightGear's models have parts. Throws Error.
RotatingModel read_rotating_model(const std::filesystem::path& path, const ReadOptions& options);

} // namespace octant::models::meshfile
