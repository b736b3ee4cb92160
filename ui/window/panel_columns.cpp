#include "ui/window/panel_columns.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace octant::ui::window {

namespace {

enum class Column { Left, Middle, Right };

struct KnownPanel {
    std::string_view title;
    bool OpenPanels::*open;
    Column column;
};

/// From top to bottom.
constexpr std::array known_panels{
    KnownPanel{"Flight", &OpenPanels::flight, Column::Left},
    KnownPanel{"Frame times", &OpenPanels::timing, Column::Left},
    KnownPanel{"Scene", &OpenPanels::scene, Column::Left},
    KnownPanel{"Terrain", &OpenPanels::terrain, Column::Right},
    KnownPanel{"Draw order", &OpenPanels::draw_order, Column::Right},
    KnownPanel{"Aircraft", &OpenPanels::aircraft, Column::Right},
    KnownPanel{"Settings", &OpenPanels::settings, Column::Right},
    KnownPanel{"Leave?", &OpenPanels::leave_question, Column::Middle},
    KnownPanel{"Keys", &OpenPanels::help, Column::Middle},
    KnownPanel{"First steps", &OpenPanels::first_steps, Column::Middle}};

constexpr float edge = 8.0F;
constexpr float gap_px = 6.0F;
constexpr float side_width = 330.0F;
/// A side column takes no more of the window than this.
constexpr float max_of_window = 0.35F;
constexpr float max_middle_width = 620.0F;
constexpr float first_height = 420.0F;
/// Room for a title and a line.
constexpr float min_height = 48.0F;
/// Closer than this is where it was put: places are rounded to whole units.
constexpr float nearly = 1.0F;

bool is_near(const PanelRect& a, const PanelRect& b) {
    const auto near = [](const glm::vec2& one, const glm::vec2& other) {
        return std::abs(one.x - other.x) <= nearly && std::abs(one.y - other.y) <= nearly;
    };
    return near(a.at, b.at) && near(a.size, b.size);
}

/// Brings a chosen place into the window, which may be smaller than when it was chosen.
glm::vec2 clamped(const glm::vec2& at, const PanelRoom& room) {
    constexpr float seen = 40.0F;
    const glm::vec2 most = glm::max(room.size - seen * room.scale, glm::vec2(0.0F));
    return glm::clamp(at, glm::min(glm::vec2(seen - side_width, 0.0F) * room.scale, most), most);
}

/// Shares `room` among panels: those that want less than an even share get what they want.
std::vector<float> fitted(std::vector<float> wanted, float room) {
    std::vector<std::size_t> by_size(wanted.size());
    std::iota(by_size.begin(), by_size.end(), std::size_t{0});
    std::ranges::sort(by_size, {}, [&](std::size_t i) { return wanted[i]; });
    float left = room;
    for (std::size_t rank = 0; rank < by_size.size(); ++rank) {
        float& height = wanted[by_size[rank]];
        const float share = left / static_cast<float>(by_size.size() - rank);
        height = std::floor(std::max(min_height, std::min(height, share)));
        left -= height;
    }
    return wanted;
}

/// A column of the window: its left edge, width, top and bottom.
struct Strip {
    float left = 0.0F;
    float width = 0.0F;
    float top = 0.0F;
    float bottom = 0.0F;
};

Strip strip_of(Column column, const PanelRoom& room, bool left_open, bool right_open) {
    const float border = edge * room.scale;
    const float side = std::floor(std::min(side_width * room.scale, max_of_window * room.size.x));
    Strip strip{border, side, border, room.size.y - border};
    if (column == Column::Right) {
        strip.left = room.size.x - border - side;
        strip.bottom -= room.inset.y;
    } else if (column == Column::Middle) {
        const float from = border + (left_open ? side + gap_px * room.scale : 0.0F);
        const float right = right_open ? side + gap_px * room.scale : 0.0F;
        const float to = room.size.x - border - std::max(right, room.inset.x);
        strip.width = std::floor(std::min(to - from, max_middle_width * room.scale));
        strip.left = std::floor(
            std::clamp(0.5F * (room.size.x - strip.width), from, std::max(from, to - strip.width)));
        strip.top += room.status_height;
    }
    return strip;
}

} // namespace

PanelColumns::Place& PanelColumns::place_of(std::string_view title) {
    const auto found = places_.find(title);
    if (found != places_.end()) {
        return found->second;
    }
    Place place;
    place.rect = {glm::vec2(edge), {side_width, first_height}};
    place.wanted_height = first_height;
    return places_.emplace(std::string(title), place).first->second;
}

void PanelColumns::lay_out(const OpenPanels& open, const PanelRoom& room) {
    std::array<std::vector<Place*>, 3> columns;
    for (const KnownPanel& panel : known_panels) {
        Place& place = place_of(panel.title);
        const bool asks = panel.open == &OpenPanels::leave_question;
        if (!(open.*panel.open) || !(open.shown || asks)) {
            place.is_new = true;
        } else if (place.chosen) {
            const glm::vec2 at = clamped(place.rect.at, room);
            place.is_new = place.is_new || at != place.rect.at;
            place.rect.at = at;
        } else {
            columns[static_cast<std::size_t>(panel.column)].push_back(&place);
        }
    }
    for (const Column column : {Column::Left, Column::Middle, Column::Right}) {
        const auto& places = columns[static_cast<std::size_t>(column)];
        const Strip strip =
            strip_of(column, room, !columns.front().empty(), !columns.back().empty());
        if (column == Column::Middle) {
            middle_ = {strip.left, strip.width};
        }
        std::vector<float> heights;
        for (const Place* const place : places) {
            heights.push_back(place->wanted_height);
        }
        const float between = gap_px * room.scale;
        const float gaps =
            between * static_cast<float>(std::max<std::size_t>(places.size(), 1) - 1);
        heights = fitted(std::move(heights), strip.bottom - strip.top - gaps);
        // What the middle shows stands at its bottom, below the aircraft.
        float y = strip.top;
        const float all = std::accumulate(heights.begin(), heights.end(), gaps);
        if (column == Column::Middle) {
            y = std::max(y, strip.bottom - all);
        }
        for (std::size_t i = 0; i < places.size(); ++i) {
            const PanelRect rect{{strip.left, std::floor(y)}, {strip.width, heights[i]}};
            places[i]->is_new = places[i]->is_new || !is_near(rect, places[i]->rect);
            places[i]->rect = rect;
            y += heights[i] + between;
        }
    }
}

std::optional<PanelRect> PanelColumns::put(std::string_view title) {
    Place& place = place_of(title);
    return place.is_new ? std::optional(place.rect) : std::nullopt;
}

void PanelColumns::lies(std::string_view title, const PanelRect& rect) {
    Place& place = place_of(title);
    if (!place.is_new && !is_near(rect, place.rect)) {
        place.chosen = true;
    }
    if (place.chosen) {
        place.rect = rect;
    }
    place.is_new = false;
}

void PanelColumns::wants(std::string_view title, float height) {
    place_of(title).wanted_height = std::ceil(height);
}

void PanelColumns::put_back() {
    for (auto& [title, place] : places_) {
        place.is_new = place.is_new || place.chosen;
        place.chosen = false;
    }
}

std::map<std::string, PanelRect, std::less<>> PanelColumns::chosen() const {
    std::map<std::string, PanelRect, std::less<>> places;
    for (const auto& [title, place] : places_) {
        if (place.chosen) {
            places.emplace(title, place.rect);
        }
    }
    return places;
}

void PanelColumns::choose(const std::map<std::string, PanelRect, std::less<>>& places) {
    for (const KnownPanel& panel : known_panels) {
        const auto found = places.find(panel.title);
        if (found != places.end()) {
            Place& place = place_of(panel.title);
            place.rect = found->second;
            place.chosen = true;
            place.is_new = true;
        }
    }
}

} // namespace octant::ui::window
