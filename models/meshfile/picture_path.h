#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace octant::models::meshfile {

/// Returns the path of a texture picture that a mesh names. Backslashes count as slashes, and names are found in
/// another case, too. Searches for the whole name, then for its last component, in `folder` (empty: not searched) and
/// in the mesh's folder; then for the last component in the folders inside the mesh's folder, beside it, and inside
/// those called "textures" beside it. Returns a path in the mesh's folder if no file exists.
std::filesystem::path picture_file(
    const std::filesystem::path& mesh_file, const std::string& name, const std::filesystem::path& folder = {});

/// %20 and the like as the bytes they stand for; nothing when there is no such byte.
std::optional<std::string> without_percents(std::string_view text);

/// The text with ASCII letters in lower case.
std::string lower_case(std::string text);

} // namespace octant::models::meshfile
