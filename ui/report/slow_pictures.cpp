#include "ui/report/slow_pictures.h"

#include "ui/report/contact_sheet.h"
#include "ui/report/frame_csv.h"

#include <algorithm>
#include <fmt/format.h>

namespace octant::ui::report {

std::string slow_picture_name(int frame) { return fmt::format("slow-{:05}.png", frame); }

/// Of frames that took as long as each other the first ones are kept, as SlowFrameList does.
void SlowPictures::add(const FrameRecord& record, const PixelView& picture) {
    constexpr int widest_px = 640;
    if (record.warm_up) { return; }
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
