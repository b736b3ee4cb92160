#include "ui/window/gui.h"

#include "ui/window/panel_widgets.h"
#include "visuals/gl/window_context.h"

#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

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
    io.IniFilename = nullptr; // its reader trusts the file; panel_layout reads and writes ours
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

} // namespace octant::ui::window
