#include "ui/dataset/contact_sheet.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "ui/report/png_file.h"
#include "ui/report/zip_file.h"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <optional>
#include <string_view>
#include <vector>

namespace octant::ui::dataset {

namespace {

namespace fs = std::filesystem;

constexpr int columns = 6;
constexpr int cell_width_px = 160;
constexpr int most_cell_height_px = 120;
constexpr int gap_px = 4;

std::size_t index(int x, int y, int width) {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * 3;
}

/// The number that follows `name` in a header of an .npy file.
std::optional<long> number_after(std::string_view header, std::string_view name) {
    const std::size_t at = header.find(name);
    if (at == std::string_view::npos) { return std::nullopt; }
    const std::string_view rest = header.substr(at + name.size());
    return whole_number(rest.substr(0, rest.find_first_not_of("0123456789")));
}

/// The array "rgb" of an .npz file of files_of().
report::Picture picture_from_npz(const fs::path& file) {
    constexpr std::size_t most = std::size_t{1} << 30;
    const std::string npy = report::zip_text(file, "rgb.npy", most);
    const std::size_t data = npy.find('\n') + 1;
    const std::string_view header = std::string_view(npy).substr(0, data);
    const auto height = number_after(header, "'shape': (");
    const auto width = height ? number_after(header, fmt::format("'shape': ({}, ", *height)) : std::nullopt;
    if (!height || !width) { throw_error_in(file, "expected an array rgb, got another file"); }
    report::Picture picture{static_cast<int>(*width), static_cast<int>(*height), 3, {}};
    const std::size_t values = index(0, picture.height_px, picture.width_px);
    const std::size_t bytes_each = header.find("<u2") != std::string_view::npos ? 2 : 1;
    if (npy.size() != data + values * bytes_each) { throw_error_in(file, "expected a whole array rgb, got a part"); }
    for (std::size_t i = 0; i < values; ++i) { // the upper byte of a number stands last
        picture.bytes.push_back(static_cast<std::byte>(npy[data + i * bytes_each + bytes_each - 1]));
    }
    return picture;
}

report::Picture read_picture(const fs::path& file) {
    return extension_of(file) == ".npz" ? picture_from_npz(file) : report::read_png(file);
}

int height_in_cell(const report::Picture& picture) {
    return std::max(1, std::min(most_cell_height_px, picture.height_px * cell_width_px / picture.width_px));
}

/// Draws a picture into a cell of that height, as large as it fits, each pixel the mean of those that it stands for.
void draw(const report::Picture& picture, int left, int top, int cell_height_px, report::Picture& sheet) {
    const int height = height_in_cell(picture);
    const int width = std::max(1, std::min(cell_width_px, picture.width_px * most_cell_height_px / picture.height_px));
    const auto channels = static_cast<std::size_t>(picture.channels);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const int x0 = x * picture.width_px / width;
            const int y0 = y * picture.height_px / height;
            const int x1 = std::max(x0 + 1, (x + 1) * picture.width_px / width);
            const int y1 = std::max(y0 + 1, (y + 1) * picture.height_px / height);
            for (std::size_t channel = 0; channel < 3; ++channel) {
                int sum = 0;
                for (int v = y0; v < y1; ++v) {
                    for (int u = x0; u < x1; ++u) {
                        sum +=
                            std::to_integer<int>(picture.bytes[index(u, v, picture.width_px) / 3 * channels + channel]);
                    }
                }
                const int pixels = (x1 - x0) * (y1 - y0);
                sheet.bytes[index(left + (cell_width_px - width) / 2 + x, top + (cell_height_px - height) / 2 + y,
                                sheet.width_px) +
                            channel] = static_cast<std::byte>((sum + pixels / 2) / pixels);
            }
        }
    }
}

} // namespace

std::string contact_sheet_png(std::span<const fs::path> files) {
    const int count = static_cast<int>(std::min(files.size(), contact_sheet_pictures));
    const int across = std::max(1, std::min(count, columns));
    const int down = std::max(1, (count + columns - 1) / columns);
    std::vector<report::Picture> pictures;
    int cell_height_px = 1;
    for (const fs::path& file : files.first(static_cast<std::size_t>(count))) {
        pictures.push_back(read_picture(file));
        cell_height_px = std::max(cell_height_px, height_in_cell(pictures.back()));
    }
    report::Picture sheet{across * (cell_width_px + gap_px) + gap_px, down * (cell_height_px + gap_px) + gap_px, 3, {}};
    sheet.bytes.resize(index(0, sheet.height_px, sheet.width_px), std::byte{255});
    for (int i = 0; i < count; ++i) {
        draw(pictures[static_cast<std::size_t>(i)], gap_px + i % columns * (cell_width_px + gap_px),
            gap_px + i / columns * (cell_height_px + gap_px), cell_height_px, sheet);
    }
    return report::png_bytes(sheet.view(), report::PngEffort::Small);
}

} // namespace octant::ui::dataset
