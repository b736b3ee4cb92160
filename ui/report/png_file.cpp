#include "ui/report/png_file.h"

#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"

#include <array>
#include <bit>
#include <cassert>
#include <csetjmp>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <png.h>
#include <utility>
#include <zlib.h>

namespace octant::ui::report {

namespace {

/// What libpng's call-backs reach.
struct Encoder {
    std::string out;
    std::array<char, 120> error_line{};
};

void keep_error(png_structp png, png_const_charp message) {
    auto* encoder = static_cast<Encoder*>(png_get_error_ptr(png));
    std::snprintf(encoder->error_line.data(), encoder->error_line.size(), "%s", message);
    png_longjmp(png, 1);
}

void ignore_warning(png_structp /*png*/, png_const_charp /*message*/) {}

void append_bytes(png_structp png, png_bytep data, png_size_t size) {
    // An exception must not cross libpng's C frames.
    bool kept = false;
    try {
        static_cast<Encoder*>(png_get_io_ptr(png))->out.append(reinterpret_cast<const char*>(data), size);
        kept = true;
    } catch (const std::exception&) { kept = false; }
    if (!kept) { png_error(png, "out of memory"); }
}

void flush_nothing(png_structp /*png*/) {}

struct WriteHandles {
    png_structp png = nullptr;
    png_infop info = nullptr;

    WriteHandles() = default;

    ~WriteHandles() { png_destroy_write_struct(&png, &info); }

    WriteHandles(const WriteHandles&) = delete;
    WriteHandles& operator=(const WriteHandles&) = delete;
    WriteHandles(WriteHandles&&) = delete;
    WriteHandles& operator=(WriteHandles&&) = delete;
};

void set_effort(png_structp png, PngEffort effort) {
    if (effort == PngEffort::Fast) {
        png_set_compression_level(png, 1);
        png_set_compression_strategy(png, Z_RLE);
        png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
        return;
    }
    png_set_compression_level(png, 5);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_ALL_FILTERS);
}

/// The only function that a longjmp comes back to: nothing in it or below it up to libpng has a destructor. False when
/// libpng complained.
bool encode(png_structp png, png_infop info, const PixelView& picture, PngEffort effort) {
    if (setjmp(png_jmpbuf(png)) != 0) { // NOLINT(cert-err52-cpp): libpng's only way out
        return false;
    }
    png_set_IHDR(png, info, static_cast<png_uint_32>(picture.width_px), static_cast<png_uint_32>(picture.height_px),
        picture.bits, picture.channels == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
        PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    set_effort(png, effort);
    png_write_info(png, info);
    if (picture.channels == 4) { png_set_filler(png, 0, PNG_FILLER_AFTER); }
    if (picture.bits == 16 && std::endian::native == std::endian::little) { png_set_swap(png); }
    for (int y = 0; y < picture.height_px; ++y) {
        png_write_row(png, reinterpret_cast<png_const_bytep>(picture.row(y).data()));
    }
    png_write_end(png, nullptr);
    return true;
}

} // namespace

std::string png_bytes(const PixelView& picture, PngEffort effort) {
    assert(picture.is_whole());
    Encoder encoder;
    WriteHandles handles;
    handles.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &encoder, keep_error, ignore_warning);
    handles.info = handles.png != nullptr ? png_create_info_struct(handles.png) : nullptr;
    if (handles.info == nullptr) { throw Error("libpng cannot be started"); }
    png_set_write_fn(handles.png, &encoder, append_bytes, flush_nothing);
    if (!encode(handles.png, handles.info, picture, effort)) {
        throw Error(fmt::format("a picture of {} x {} pixels cannot be made a PNG: {}", picture.width_px,
            picture.height_px, encoder.error_line.data()));
    }
    return std::move(encoder.out);
}

void write_png(const std::filesystem::path& path, const PixelView& picture) { write_file(path, png_bytes(picture)); }

Picture picture_from_png(const std::filesystem::path& path, std::string_view bytes) {
    constexpr std::size_t max_pixels = 100'000'000;
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    const std::unique_ptr<png_image, decltype(&png_image_free)> freed(&image, png_image_free);
    if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) {
        throw_error_in(path, fmt::format("expected a PNG picture: {}", image.message));
    }
    if (std::size_t{image.width} * image.height > max_pixels) {
        throw_error_in(
            path, fmt::format("expected at most {} pixels, got {} x {}", max_pixels, image.width, image.height));
    }
    const bool alpha = (image.format & PNG_FORMAT_FLAG_ALPHA) != 0;
    image.format = alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
    Picture picture{static_cast<int>(image.width), static_cast<int>(image.height), alpha ? 4 : 3, {}};
    picture.bytes.resize(std::size_t{image.width} * image.height * static_cast<std::size_t>(picture.channels));
    if (png_image_finish_read(&image, nullptr, picture.bytes.data(), 0, nullptr) == 0) {
        throw_error_in(path, fmt::format("expected a whole PNG picture: {}", image.message));
    }
    return picture;
}

Picture read_png(const std::filesystem::path& path) { return picture_from_png(path, read_file(path)); }

} // namespace octant::ui::report
