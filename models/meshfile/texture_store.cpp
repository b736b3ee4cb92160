#include "models/meshfile/texture_store.h"

#include "models/heights/image.h"
#include "models/meshfile/dds.h"
#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <fstream>
#include <span>
#include <utility>

namespace octant::models::meshfile {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_file_bytes = std::size_t{1} << 29U;

/// A picture at its first size, in bytes with all its levels, and its pixels in the size that is kept.
struct DecodedPicture {
    TextureLevel level;
    std::size_t wanted_bytes = 0;
};

std::size_t bytes_with_levels(std::size_t width, std::size_t height) { return 4 * width * height * 4 / 3; }

void turn_upside_down(TextureLevel& level) {
    const std::size_t row = std::size_t{4} * static_cast<std::size_t>(level.width);
    for (std::size_t top = 0, bottom = static_cast<std::size_t>(level.height) - 1; top < bottom; ++top, --bottom) {
        std::swap_ranges(level.rgba.begin() + static_cast<std::ptrdiff_t>(top * row),
            level.rgba.begin() + static_cast<std::ptrdiff_t>((top + 1) * row),
            level.rgba.begin() + static_cast<std::ptrdiff_t>(bottom * row));
    }
}

/// A DDS picture, which has levels of its own: halved by means until it is small enough.
DecodedPicture decoded_dds(const std::string& name, std::string_view bytes, bool has_bottom_first) {
    DecodedPicture made{dds_level(name, bytes), 0};
    made.wanted_bytes =
        bytes_with_levels(static_cast<std::size_t>(made.level.width), static_cast<std::size_t>(made.level.height));
    if (has_bottom_first) { turn_upside_down(made.level); }
    if (std::max(made.level.width, made.level.height) > TextureStore::largest_px) {
        TexturePicture chain = texture_picture(name, std::move(made.level));
        while (std::max(chain.levels.front().width, chain.levels.front().height) > TextureStore::largest_px) {
            halve(chain);
        }
        made.level = std::move(chain.levels.front());
    }
    return made;
}

DecodedPicture decoded(heights::Image image) {
    return {{image.width, image.height, std::move(image.rgba)},
        bytes_with_levels(static_cast<std::size_t>(image.file_width), static_cast<std::size_t>(image.file_height))};
}

bool is_dds_file(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string first(4, '\0');
    in.read(first.data(), 4);
    return in.gcount() == 4 && is_dds(first);
}

} // namespace

template <typename Read>
std::shared_ptr<const TexturePicture> TextureStore::kept(
    const std::string& key, const std::string& name, const Read& read) {
    if (const auto known = pictures_.find(key); known != pictures_.end()) { return known->second; }
    if (const auto fault = faults_.find(key); fault != faults_.end()) { throw Error(fault->second); }
    try {
        if (pictures_.size() >= max_pictures) {
            throw Error(fmt::format("{}: expected at most {} pictures, got more", name, max_pictures));
        }
        DecodedPicture made = read();
        auto picture = std::make_shared<TexturePicture>(texture_picture(name, std::move(made.level)));
        bytes_ += picture->bytes();
        const bool is_reduced = made.wanted_bytes > picture->bytes() + picture->bytes() / 100; // rounding apart
        wanted_bytes_ += is_reduced ? made.wanted_bytes : picture->bytes();
        pictures_.emplace(key, picture);
        fit();
        return picture;
    } catch (const Error& fault) {
        faults_.emplace(key, fault.what());
        throw;
    }
}

std::shared_ptr<const TexturePicture> TextureStore::picture_in(const fs::path& file, bool has_bottom_first) {
    const std::string key = fs::absolute(file).lexically_normal().string();
    return kept(key, file.string(), [&] {
        if (is_dds_file(file)) {
            return decoded_dds(file.string(), read_file(file, largest_file_bytes), has_bottom_first);
        }
        return decoded(heights::read_image(file, largest_px));
    });
}

std::shared_ptr<const TexturePicture> TextureStore::picture_of(const std::string& name, std::string_view bytes) {
    Hash hash;
    hash.add(std::as_bytes(std::span(bytes)));
    return kept(fmt::format("{:016x} {}", hash.value(), bytes.size()), name, [&] {
        return is_dds(bytes) ? decoded_dds(name, bytes, false)
                             : decoded(heights::image_from_bytes(name, bytes, largest_px));
    });
}

/// Halves the largest picture, of equal ones the first by its key, until all fit.
void TextureStore::fit() {
    while (bytes_ > max_bytes_) {
        TexturePicture* largest = nullptr;
        for (const auto& [key, picture] : pictures_) {
            if (picture->levels.size() > 1 && (largest == nullptr || picture->bytes() > largest->bytes())) {
                largest = picture.get();
            }
        }
        if (largest == nullptr) { return; }
        bytes_ -= largest->bytes();
        halve(*largest);
        bytes_ += largest->bytes();
    }
}

std::vector<std::string> TextureStore::notes() const {
    constexpr double mib = 1024.0 * 1024.0;
    if (pictures_.empty()) { return {}; }
    if (wanted_bytes_ <= bytes_) {
        return {fmt::format("pictures on the aircraft: {}, which take {:.1f} MiB", pictures_.size(),
            static_cast<double>(bytes_) / mib)};
    }
    return {
        fmt::format("the pictures on the aircraft take {:.0f} MiB; the largest were halved until {:.0f} MiB were left "
                    "(at most {:.0f} MiB, and {} texels a side)",
            static_cast<double>(wanted_bytes_) / mib, static_cast<double>(bytes_) / mib,
            static_cast<double>(max_bytes_) / mib, largest_px)};
}

} // namespace octant::models::meshfile
