#pragma once

#include <filesystem>
#include <vector>

namespace octant::ui::world {

/// The files that a model's file names, directly or through others, and that are there; absolute, each once, in the
/// order in which they are met: materials and pictures of .obj files, pictures of .ac files, buffers and pictures of
/// .gltf files, and all that FlightGear's .xml files name. What cannot be read or understood is passed over: whoever
/// loads the model says so.
std::vector<std::filesystem::path> referenced_files(const std::filesystem::path& model);

} // namespace octant::ui::world
