#include "ui/report/slow_pictures.h"

#include "sim/base/binary_file.h"
#include "sim/base/error.h"
#include "ui/report/frame_csv.h"
#include "ui/report/html_text.h"

#include <algorithm>
#include <cassert>
#include <fmt/format.h>

namespace octant::ui::report {

std::vector<std::size_t> evenly_spaced(std::size_t count, std::size_t max_count) {
    assert(max_count >= 1);
    std::vector<std::size_t> chosen;
    if (count <= max_count) {
        for (std::size_t i = 0; i < count; ++i) { chosen.push_back(i); }
        return chosen;
    }
    for (std::size_t i = 0; i < max_count; ++i) {
        chosen.push_back(max_count == 1 ? 0 : i * (count - 1) / (max_count - 1));
    }
    return chosen;
}

Picture downscaled(const PixelView& picture, int widest) {
    assert(picture.is_whole() && widest >= 1);
    const int side = std::min((picture.width_px + widest - 1) / widest, std::max(1, picture.height_px));
    Picture small{picture.width_px / side, picture.height_px / side, 3, {}};
    small.bytes.reserve(small.view().row_bytes() * static_cast<std::size_t>(small.height_px));
    const auto count = static_cast<unsigned>(side * side);
    const auto channels = static_cast<std::size_t>(picture.channels);
    std::vector<unsigned> sums; // of the bytes of `side` rows
    for (int y = 0; y < small.height_px; ++y) {
        sums.assign(picture.row_bytes(), 0);
        for (int row = y * side; row < (y + 1) * side; ++row) {
            const std::byte* const bytes = picture.row(row).data();
            for (std::size_t i = 0; i < sums.size(); ++i) { sums[i] += std::to_integer<unsigned>(bytes[i]); }
        }
        for (std::size_t x = 0; x < static_cast<std::size_t>(small.width_px); ++x) {
            for (std::size_t channel = 0; channel < 3; ++channel) {
                unsigned sum = count / 2;
                for (std::size_t column = 0; column < static_cast<std::size_t>(side); ++column) {
                    sum += sums[(x * static_cast<std::size_t>(side) + column) * channels + channel];
                }
                small.bytes.push_back(static_cast<std::byte>(sum / count));
            }
        }
    }
    return small;
}

std::string picture_html(const std::filesystem::path& picture, int widest, const std::string& caption) {
    try {
        const Picture small = downscaled(read_png(picture).view(), widest);
        return fmt::format("<figure><img alt=\"{0}\" width=\"{1}\" height=\"{2}\" "
                           "src=\"data:image/png;base64,{3}\"><figcaption>{0}</figcaption></figure>\n",
            escaped(caption), small.width_px, small.height_px, base64_of(png_bytes(small.view(), PngEffort::Small)));
    } catch (const Error& error) {
        return fmt::format("<figure class=\"missing\"><figcaption>{}</figcaption></figure>\n", escaped(error.what()));
    }
}

std::string slow_picture_name(int frame) { return fmt::format("slow-{:05}.png", frame); }

/// Of frames that took as long as each other the first ones are kept, as SlowFrameList does.
void SlowPictures::add(const FrameRecord& record, const PixelView& picture) {
    constexpr int widest_px = 640;
    if (!record.is_counted()) { return; }
    const FrameRecord written = rounded_as_csv(record);
    const auto place = std::ranges::find_if(
        kept_, [&](const SlowPicture& slow_picture) { return slow_picture.record.frame_ms < written.frame_ms; });
    if (place == kept_.end() && kept_.size() == max_kept) { return; }
    kept_.insert(place, {written, downscaled(picture, widest_px)});
    kept_.resize(std::min(kept_.size(), max_kept));
}

void SlowPictures::write(const std::filesystem::path& folder) const {
    for (const SlowPicture& slow_picture : kept_) {
        write_png(folder / slow_picture_name(slow_picture.record.frame), slow_picture.picture.view());
    }
}

} // namespace octant::ui::report
