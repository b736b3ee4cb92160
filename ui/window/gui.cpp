#include "ui/window/gui.h"

#include "ui/window/panel_widgets.h"
#include "visuals/gl/window_context.h"

#include <backends/imgui_impl_glfw.h>
#include <glm/common.hpp>
#include <imgui.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace octant::ui::window {

namespace gl = visuals::gl;

namespace {

static_assert(sizeof(ImDrawVert) == sizeof(gl::PanelVertex));
static_assert(offsetof(ImDrawVert, uv) == offsetof(gl::PanelVertex, atlas_at));
static_assert(offsetof(ImDrawVert, col) == offsetof(gl::PanelVertex, colour));
static_assert(sizeof(ImDrawIdx) == sizeof(std::uint16_t));

float content_scale(GLFWwindow* window) {
    float x = 1.0F;
    float y = 1.0F;
    glfwGetWindowContentScale(window, &x, &y);
    return x;
}

void set_style(float scale) {
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    // Without round corners and smooth edges a rectangle is two triangles, which keeps panels cheap where a processor
    // draws them.
    style.WindowRounding = 0.0F;
    style.FrameRounding = 0.0F;
    style.AntiAliasedLines = false;
    style.AntiAliasedFill = false;
    style.WindowBorderSize = 0.0F;
    style.Colors[ImGuiCol_WindowBg].w = background_alpha;
    // Values are written over the grabs of their sliders.
    constexpr float grab_alpha = 0.45F;
    style.Colors[ImGuiCol_SliderGrab].w = grab_alpha;
    style.Colors[ImGuiCol_SliderGrabActive].w = grab_alpha;
    style.ScaleAllSizes(scale);
    ImFontConfig font;
    font.SizePixels = std::floor(13.0F * scale);
    ImGui::GetIO().Fonts->AddFontDefault(&font);
}

} // namespace

Gui::Gui(gl::WindowContext& window) {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr; // its reader trusts the file; PanelColumns has ours
    io.ConfigFlags |= ImGuiConfigFlags_NoMouseCursorChange;
    set_style(content_scale(window.window()));
    ImGui_ImplGlfw_InitForOther(window.window(), true);
    unsigned char* texels = nullptr;
    glm::ivec2 size{0};
    io.Fonts->GetTexDataAsAlpha8(&texels, &size.x, &size.y);
    painter_.emplace(
        window, std::span(texels, static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y)), size);
    pixels_.emplace(texels, size);
}

Gui::~Gui() {
    painter_.reset();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void Gui::begin_frame() {
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void Gui::end_frame() { ImGui::Render(); }

void Gui::draw(const glm::ivec2& size_px) {
    const ImDrawData* const data = ImGui::GetDrawData();
    if (vertices() == 0) { return; }
    painter_->begin({0, size_px, {data->DisplaySize.x, data->DisplaySize.y}});
    for (int i = 0; i < data->CmdListsCount; ++i) {
        const ImDrawList& list = *data->CmdLists[i];
        draws_.clear();
        for (const ImDrawCmd& command : list.CmdBuffer) {
            draws_.push_back({command.IdxOffset, command.ElemCount, command.VtxOffset,
                {command.ClipRect.x, command.ClipRect.y}, {command.ClipRect.z, command.ClipRect.w}});
        }
        painter_->draw({reinterpret_cast<const gl::PanelVertex*>(list.VtxBuffer.Data),
                           static_cast<std::size_t>(list.VtxBuffer.Size)},
            {list.IdxBuffer.Data, static_cast<std::size_t>(list.IdxBuffer.Size)}, draws_);
    }
    painter_->end();
}

void Gui::draw_into(std::uint8_t* pixels, const glm::ivec2& size_px) const {
    if (vertices() > 0) { pixels_->draw(*ImGui::GetDrawData(), pixels, size_px); }
}

int Gui::vertices() const {
    const ImDrawData* const data = ImGui::GetDrawData();
    return data == nullptr ? 0 : data->TotalVtxCount;
}

bool Gui::wants_pointer() const { return ImGui::GetIO().WantCaptureMouse; }

bool Gui::wants_keys() const { return ImGui::GetIO().WantTextInput; }

namespace {

/// A value over the picture.
struct Plane {
    float base = 0.0F;
    float per_x = 0.0F;
    float per_y = 0.0F;

    float at(float x, float y) const { return base + per_x * x + per_y * y; }
};

struct Vertex {
    glm::vec2 at_px;
    glm::vec2 texel;
    std::uint32_t colour = 0; ///< red in the lowest byte, then green, blue and alpha
};

using TriangleVertices = std::array<Vertex, 3>;

/// What triangles are drawn into: pixels from `least` to below `most`.
struct Surface {
    std::uint8_t* pixels;
    int width;
    glm::ivec2 least;
    glm::ivec2 most;
};

float byte_of(std::uint32_t colour, unsigned which) { return static_cast<float>(colour >> (8 * which) & 0xffU); }

/// `of`: a corner's value.
template <class Of>
Plane plane_of(const TriangleVertices& corners, float signed_area2, const Of& of) {
    const auto& [a, b, c] = corners;
    const glm::vec2 ab = b.at_px - a.at_px;
    const glm::vec2 ac = c.at_px - a.at_px;
    const float to_b = of(b) - of(a);
    const float to_c = of(c) - of(a);
    Plane plane;
    plane.per_x = (to_b * ac.y - to_c * ab.y) / signed_area2;
    plane.per_y = (to_c * ab.x - to_b * ac.x) / signed_area2;
    plane.base = of(a) - plane.per_x * a.at_px.x - plane.per_y * a.at_px.y;
    return plane;
}

/// Where the line from the upper to the lower corner crosses a row: the same whichever of two triangles asks.
float crossing(const Vertex& a, const Vertex& b, float y) {
    const auto& [upper, lower] = a.at_px.y < b.at_px.y ? std::pair(a, b) : std::pair(b, a);
    const glm::vec2 down = lower.at_px - upper.at_px;
    return upper.at_px.x + down.x * (y - upper.at_px.y) / down.y;
}

/// The first pixel whose middle is not before a place.
int first_from(float at_px) { return static_cast<int>(std::ceil(at_px - 0.5F)); }

void blend(std::uint32_t colour, unsigned share, std::uint8_t* pixel) {
    const std::array<unsigned, 3> over{colour >> 16U & 0xffU, colour >> 8U & 0xffU, colour & 0xffU};
    for (std::size_t k = 0; k < over.size(); ++k) {
        pixel[k] = static_cast<std::uint8_t>((over[k] * share + pixel[k] * (255U - share) + 127U) / 255U);
    }
}

/// How much of a pixel a triangle covers and in which colour.
class TrianglePainter {
public:
    TrianglePainter(const TriangleVertices& corners, float signed_area2, const std::vector<std::uint8_t>& atlas,
        const glm::ivec2& atlas_size)
        : atlas_(atlas), atlas_size_(atlas_size), colour_(corners[0].colour),
          is_plain_(corners[1].colour == colour_ && corners[2].colour == colour_ &&
                    corners[1].texel == corners[0].texel && corners[2].texel == corners[0].texel),
          has_one_colour_(corners[1].colour == colour_ && corners[2].colour == colour_),
          u_(plane_of(corners, signed_area2, [](const Vertex& c) { return c.texel.x; })),
          v_(plane_of(corners, signed_area2, [](const Vertex& c) { return c.texel.y; })) {
        if (!has_one_colour_) {
            for (unsigned k = 0; k < bytes_.size(); ++k) {
                bytes_[k] = plane_of(corners, signed_area2, [&](const Vertex& c) { return byte_of(c.colour, k); });
            }
        }
    }

    void row(int y, int first, int end, std::uint8_t* line) const {
        if (is_plain_) {
            const unsigned share = share_at(glm::vec2(u_.base, v_.base), colour_);
            for (int x = first; x < end; ++x) { blend(colour_, share, line + 4 * x); }
            return;
        }
        const float middle_y = static_cast<float>(y) + 0.5F;
        for (int x = first; x < end; ++x) {
            const float middle_x = static_cast<float>(x) + 0.5F;
            const std::uint32_t colour = has_one_colour_ ? colour_ : colour_at(middle_x, middle_y);
            const unsigned share = share_at(glm::vec2(u_.at(middle_x, middle_y), v_.at(middle_x, middle_y)), colour);
            if (share > 0) { blend(colour, share, line + 4 * x); }
        }
    }

private:
    unsigned share_at(const glm::vec2& texel, std::uint32_t colour) const {
        const glm::ivec2 at = glm::clamp(glm::ivec2(glm::floor(texel)), glm::ivec2(0), atlas_size_ - 1);
        const auto number =
            static_cast<std::size_t>(at.y) * static_cast<std::size_t>(atlas_size_.x) + static_cast<std::size_t>(at.x);
        return ((colour >> 24U) * atlas_[number] + 127U) / 255U;
    }

    std::uint32_t colour_at(float x, float y) const {
        std::uint32_t colour = 0;
        for (unsigned k = 0; k < bytes_.size(); ++k) {
            const float level = std::clamp(bytes_[k].at(x, y), 0.0F, 255.0F);
            colour |= static_cast<std::uint32_t>(level + 0.5F) << (8 * k);
        }
        return colour;
    }

    const std::vector<std::uint8_t>& atlas_;
    glm::ivec2 atlas_size_;
    std::uint32_t colour_;
    bool is_plain_; ///< the same all over
    bool has_one_colour_;
    Plane u_; ///< texels
    Plane v_;
    std::array<Plane, 4> bytes_{}; ///< of the colour, unless there is one
};

/// Fills what lies between the edges of each row, half open.
void fill(TriangleVertices corners, const TrianglePainter& paint, const Surface& to) {
    std::ranges::sort(corners, {}, [](const Vertex& corner) { return corner.at_px.y; });
    const auto& [top, middle, bottom] = corners;
    const int first_row = std::max(first_from(top.at_px.y), to.least.y);
    const int end_row = std::min(first_from(bottom.at_px.y), to.most.y);
    for (int row = first_row; row < end_row; ++row) {
        const float y = static_cast<float>(row) + 0.5F;
        const float whole = crossing(top, bottom, y);
        const float bent = y < middle.at_px.y ? crossing(top, middle, y) : crossing(middle, bottom, y);
        const int first = std::max(first_from(std::min(whole, bent)), to.least.x);
        const int end = std::min(first_from(std::max(whole, bent)), to.most.x);
        std::uint8_t* const line = to.pixels + 4 * static_cast<std::size_t>(row) * static_cast<std::size_t>(to.width);
        paint.row(row, first, end, line);
    }
}

} // namespace

PanelRasterizer::PanelRasterizer(const std::uint8_t* atlas, const glm::ivec2& size)
    : atlas_(atlas, atlas + static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y)), atlas_size_(size) {}

void PanelRasterizer::draw(const ImDrawData& panels, std::uint8_t* pixels, const glm::ivec2& size_px) const {
    const glm::vec2 px_per_unit = glm::vec2(size_px) / glm::vec2(panels.DisplaySize.x, panels.DisplaySize.y);
    const glm::vec2 texels(atlas_size_);
    const auto corner_of = [&](const ImDrawVert& vertex) {
        return Vertex{glm::vec2(vertex.pos.x, vertex.pos.y) * px_per_unit, glm::vec2(vertex.uv.x, vertex.uv.y) * texels,
            vertex.col};
    };
    for (int i = 0; i < panels.CmdListsCount; ++i) {
        const ImDrawList& list = *panels.CmdLists[i];
        for (const ImDrawCmd& command : list.CmdBuffer) {
            const ImVec4& clip = command.ClipRect;
            const Surface to{pixels, size_px.x,
                glm::max(glm::ivec2(glm::floor(glm::vec2(clip.x, clip.y) * px_per_unit)), glm::ivec2(0)),
                glm::min(glm::ivec2(glm::ceil(glm::vec2(clip.z, clip.w) * px_per_unit)), size_px)};
            const ImDrawIdx* const indices = list.IdxBuffer.Data + command.IdxOffset;
            const ImDrawVert* const vertices = list.VtxBuffer.Data + command.VtxOffset;
            for (unsigned first = 0; first < command.ElemCount; first += 3) {
                const TriangleVertices corners{corner_of(vertices[indices[first]]),
                    corner_of(vertices[indices[first + 1]]), corner_of(vertices[indices[first + 2]])};
                const glm::vec2 ab = corners[1].at_px - corners[0].at_px;
                const glm::vec2 ac = corners[2].at_px - corners[0].at_px;
                const float signed_area2 = ab.x * ac.y - ab.y * ac.x;
                if (signed_area2 != 0.0F) {
                    fill(corners, TrianglePainter(corners, signed_area2, atlas_, atlas_size_), to);
                }
            }
        }
    }
}

} // namespace octant::ui::window
