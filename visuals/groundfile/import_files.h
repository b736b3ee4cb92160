#pragma once

#include "models/heights/import_options.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace octant::visuals::groundfile {

/// A hash of the inputs (names, sizes, times) and options of an import, which tells one import from
/// another.
std::uint64_t hash_of_inputs(
    const std::vector<std::filesystem::path>& inputs,
    const models::heights::ImportOptions& options);

/// Throws Error when writing `out`, and `part` on the way, would overwrite an input or something
/// that is no regular file.
void check_output(
    const std::vector<std::filesystem::path>& inputs,
    const std::filesystem::path& out,
    const std::filesystem::path& part);

/// Throws Error when there is a file at `part` that is neither empty nor begins as ground files do.
void check_partial_file(const std::filesystem::path& part);

/// Renames the part to `out`; the new name is on the disk when it returns. Throws Error.
void rename_into_place(const std::filesystem::path& part, const std::filesystem::path& out);

} // namespace octant::visuals::groundfile
