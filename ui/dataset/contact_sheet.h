#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace octant::ui::dataset {

/// The number of pictures that a contact sheet shows.
inline constexpr std::size_t contact_sheet_pictures = 24;

/// A picture of small pictures side by side, as PNG: those of the files, PNG or .npz with an array "rgb", at most
/// contact_sheet_pictures. Same files, same bytes. Throws Error.
std::string contact_sheet_png(std::span<const std::filesystem::path> files);

} // namespace octant::ui::dataset
