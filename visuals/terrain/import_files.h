#pragma once

#include "models/heights/import_options.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace octant::visuals::terrain {

/// Tells the inputs (names, sizes, times) and options of one import from those of another.
std::uint64_t hash_of_inputs(
    const std::vector<std::filesystem::path>& inputs,
    const models::heights::ImportOptions& options);

/// Throws Error when writing `out` and, on the way, `part` would harm an input or what is no
/// regular file.
void check_out(
    const std::vector<std::filesystem::path>& inputs,
    const std::filesystem::path& out,
    const std::filesystem::path& part);

/// Throws Error when a file in the place of `part` is neither empty nor begins as grounds do.
void check_unfinished(const std::filesystem::path& part);

/// Gives the part the name `out`, on the disk when it returns. Throws Error.
void put_in_place(const std::filesystem::path& part, const std::filesystem::path& out);

} // namespace octant::visuals::terrain
