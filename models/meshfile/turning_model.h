#pragma once

#include "models/meshfile/mesh_parts.h"
#include "models/meshfile/read_options.h"
#include "models/triangle_mesh.h"

#include <glm/vec3.hpp>

#include <filesystem>
#include <vector>

namespace octant::models::meshfile {

/// A straight line about which something turns in flight; file axes, metres.
struct TurningAxis {
    glm::dvec3 point_m{0.0};
    glm::dvec3 direction{1.0, 0.0, 0.0}; ///< unit; positive turns follow the right-hand rule
    double turns_per_s = 0.0;
};

/// A propeller or a rotor, as it stands at the time 0.
struct TurningPart {
    TriangleMesh mesh;
    TurningAxis about;
};

/// A model with what turns in flight, and what is clear, apart from all else.
struct TurningModel {
    TriangleMesh body; ///< never without a triangle
    std::vector<TurningPart> parts;
    ClearSurfaces clear;
};

/// As read_mesh, for the same files; only FlightGear's models have parts. Throws Error.
TurningModel read_turning_model(const std::filesystem::path& path, const ReadOptions& options);

} // namespace octant::models::meshfile
