#include "tests/ui/window/headless_gui.h"
#include "ui/window/gui.h"

#include <catch2/catch.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace octant::tests {

namespace {

constexpr glm::ivec2 panels_px{120, 90};
constexpr std::uint8_t ground = 100; ///< of each byte below the panels

/// What drawing lists leave over a grey picture.
class GreyPicture {
public:
    explicit GreyPicture(const std::function<void(ImDrawList&)>& draw)
        : gui_(panels_px.x, panels_px.y), pixels_(4 * static_cast<std::size_t>(panels_px.x * panels_px.y), ground) {
        ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
        unsigned char* texels = nullptr;
        fonts.GetTexDataAsAlpha8(&texels, &atlas_px_.x, &atlas_px_.y);
        gui_.frame([&] {
            ImDrawList& list = *ImGui::GetForegroundDrawList();
            list.Flags = ImDrawListFlags_None;
            draw(list);
        });
        ui::window::PanelRasterizer(texels, atlas_px_).draw(*ImGui::GetDrawData(), pixels_.data(), panels_px);
    }

    /// Red, green and blue.
    glm::ivec3 at(int x, int y) const {
        const auto i = 4 * static_cast<std::size_t>(y * panels_px.x + x);
        return {pixels_[i + 2], pixels_[i + 1], pixels_[i]};
    }

    /// How many pixels differ from the grey.
    int changed() const {
        int count = 0;
        for (int y = 0; y < panels_px.y; ++y) {
            for (int x = 0; x < panels_px.x; ++x) { count += at(x, y) == glm::ivec3(ground) ? 0 : 1; }
        }
        return count;
    }

private:
    HeadlessGui gui_;
    glm::ivec2 atlas_px_{0};
    std::vector<std::uint8_t> pixels_;
};

} // namespace

TEST_CASE("a panel's rectangle is blended once where it lies, cut by what it is seen through") {
    const GreyPicture picture([](ImDrawList& list) {
        list.AddRectFilled({10.0F, 20.0F}, {40.0F, 31.0F}, IM_COL32(200, 0, 50, 128));
        list.PushClipRect({60.0F, 0.0F}, {70.0F, 5.0F});
        list.AddRectFilled({50.0F, -9.0F}, {90.0F, 30.0F}, IM_COL32(0, 255, 0, 255));
        list.PopClipRect();
    });
    for (const glm::ivec2 at : {glm::ivec2(10, 20), {39, 30}, {10, 30}, {39, 20}, {25, 25}}) {
        CAPTURE(at.x, at.y);
        CHECK(picture.at(at.x, at.y) == glm::ivec3(150, 50, 75));
    }
    CHECK(picture.at(60, 0) == glm::ivec3(0, 255, 0));
    CHECK(picture.at(69, 4) == glm::ivec3(0, 255, 0));
    CHECK(picture.changed() == 30 * 11 + 10 * 5);
}

TEST_CASE("a letter is its texels, texel by pixel") {
    const GreyPicture picture([](ImDrawList& list) {
        list.AddText({50.0F, 40.0F}, IM_COL32(255, 255, 255, 255), "W");
    });
    const ImFontGlyph& letter = *ImGui::GetFont()->FindGlyph('W');
    unsigned char* texels = nullptr;
    glm::ivec2 size{0};
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&texels, &size.x, &size.y);
    const auto texel_of = [](float share, int count) {
        return static_cast<int>(std::lround(share * static_cast<float>(count)));
    };
    const glm::ivec2 first(texel_of(letter.U0, size.x), texel_of(letter.V0, size.y));
    const glm::ivec2 end(texel_of(letter.U1, size.x), texel_of(letter.V1, size.y));
    int covered = 0;
    for (int y = first.y; y < end.y; ++y) {
        for (int x = first.x; x < end.x; ++x) {
            const int share = texels[y * size.x + x];
            covered += share > 0 ? 1 : 0;
            const int seen =
                picture
                    .at(50 + static_cast<int>(letter.X0) + x - first.x, 40 + static_cast<int>(letter.Y0) + y - first.y)
                    .x;
            CHECK(seen == (255 * share + ground * (255 - share) + 127) / 255);
        }
    }
    CHECK(covered > 20);
    CHECK(picture.changed() == covered);
}

} // namespace octant::tests
