#pragma once

#include "models/texture.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace octant::models::meshfile {

/// The pictures on the surfaces of all models of a run, each decoded once, with bounded memory: a picture has at most
/// `largest_px` texels a side, and where all together take more than the budget, the largest ones are halved until they
/// fit. To be used by one thread while models are loaded; pictures do not change after that.
class TextureStore {
public:
    static constexpr std::size_t default_max_bytes = std::size_t{256} << 20U; ///< with all mip levels
    static constexpr int largest_px = 4096;
    static constexpr std::size_t max_pictures = 2'000;

    explicit TextureStore(std::size_t max_bytes = default_max_bytes) : max_bytes_(max_bytes) {}

    /// Reads a picture: PNG, JPEG, BMP, SGI, TGA, GIF, WebP, TIFF or DDS. `has_bottom_first`: a DDS file begins with
    /// its lowest row, as FlightGear's do. Throws Error "file: expected ..., got ..."; never returns null.
    std::shared_ptr<const TexturePicture> picture_in(const std::filesystem::path& file, bool has_bottom_first = false);

    /// The same of the bytes of a file; `name` is for messages.
    std::shared_ptr<const TexturePicture> picture_of(const std::string& name, std::string_view bytes);

    std::size_t count() const { return pictures_.size(); }

    /// The memory that the pictures take.
    std::size_t bytes() const { return bytes_; }

    /// The memory that they would take had none been reduced.
    std::size_t wanted_bytes() const { return wanted_bytes_; }

    /// What the user should know: at most one line.
    std::vector<std::string> notes() const;

private:
    template <typename Read>
    std::shared_ptr<const TexturePicture> kept(const std::string& key, const std::string& name, const Read& read);
    void fit();

    std::size_t max_bytes_;
    std::size_t bytes_ = 0;
    std::size_t wanted_bytes_ = 0;
    std::map<std::string, std::shared_ptr<TexturePicture>> pictures_; ///< by file, or by a hash of the bytes
    std::map<std::string, std::string> faults_;                       ///< likewise: why a picture cannot be read
};

} // namespace octant::models::meshfile
