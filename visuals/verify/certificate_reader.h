#pragma once

#include "visuals/verify/certificate.h"

#include <filesystem>
#include <string_view>

namespace octant::visuals::verify {

/// Reads a certificate; README.md has its format. Throws Error "file:line: expected ..., got ..." for whatever is not a
/// certificate at all: no header, unknown keywords, numbers that are missing, too many, not finite or out of range,
/// nodes and lists that are no tree, claims about what is not there.
Certificate read_certificate(const std::filesystem::path& path);

/// The same of the text of a file; `name` is what errors call it.
Certificate certificate_of(std::string_view text, const std::filesystem::path& name);

} // namespace octant::visuals::verify
