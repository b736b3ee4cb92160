#pragma once

#include "ui/report/frame_record.h"

#include <imgui.h>

#include <cstddef>
#include <span>

namespace octant::ui::window {

/// A plot of the last frames over the panel's width, with the newest at its right edge. It shows values from `least` to
/// `most` and cuts off its lines there.
class FramePlot {
public:
    FramePlot(float height_px, double least, double most);

    using Record = report::FrameRecord;

    /// Draws a line with one point a frame.
    template <class Value>
    void line(std::span<const Record> records, Value value, ImU32 colour) const {
        ImDrawList& list = *ImGui::GetWindowDrawList();
        list.PathClear();
        for (std::size_t i = 0; i < records.size(); ++i) {
            list.PathLineTo({x_of(records.size() - i), y_of(value(records[i]))});
        }
        list.PathStroke(colour, ImDrawFlags_None, 1.0F);
    }

    /// Draws a tick at the upper edge for each frame that is to be marked.
    template <class IsMarked>
    void marks(std::span<const Record> records, IsMarked is_marked, ImU32 colour) const {
        for (std::size_t i = 0; i < records.size(); ++i) {
            if (is_marked(records[i])) { mark(records.size() - i, colour); }
        }
    }

    /// Draws a horizontal line at `value` with its name.
    void level(double value, const char* name, ImU32 colour) const;

    /// Returns the index in `records`, which are the last frames, of the frame under the pointer; `none` where the
    /// pointer is not over one.
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    std::size_t pointed_at(std::span<const Record> records) const;

private:
    float x_of(std::size_t frames_ago) const;
    float y_of(double value) const;
    void mark(std::size_t frames_ago, ImU32 colour) const;

    ImVec2 from_;
    ImVec2 to_;
    double least_;
    double most_;
};

/// One part of a stacked bar.
struct BarPart {
    const char* name;
    double value;
    ImU32 colour;
};

/// Draws the parts side by side over the panel's width, which stands for the larger of `whole` and their sum. A legend
/// below the bar lists their values in `unit`.
void stacked_bar(std::span<const BarPart> parts, double whole, const char* unit);

} // namespace octant::ui::window
