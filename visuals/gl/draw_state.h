#pragma once

#include "visuals/gl/object.h"
#include "visuals/scene/frame_plan.h"

#include <vector>

namespace octant::visuals::gl {

/// A program of two kinds: for draws that are cut by planes, and for all others, which then pay nothing for the planes.
struct ProgramPair {
    Object unclipped;
    Object clipped; ///< empty where nothing is ever cut
};

/// Links both kinds, the second with CUT defined, both with `defined`. Throws Error with `name`.
ProgramPair make_program_pair(
    const Functions& gl, const char* name, const ProgramText& text, const std::vector<const char*>& defined = {});

/// Where the first row of a picture lies.
enum class RowOrder {
    TopDown, ///< as pictures are read
    BottomUp ///< as windows show them
};

/// The state of the context that draws of one picture share, and their number.
class DrawState {
public:
    explicit DrawState(const Functions& gl) : gl_(gl) {}

    /// Sets what stays the same in the whole picture, and the number of draw calls to 0. Nothing about the context is
    /// taken for granted.
    void begin_picture(RowOrder row_order);

    /// DepthOnly as Nearest: whoever draws so keeps the colours himself.
    void use_depth(scene::DepthUse use);
    void cull_back_faces(bool cull);

    /// Whether what is drawn covers the picture by its alpha only; the picture's own alpha stays that of the whole.
    void blend(bool by_alpha);

    /// Whether what is drawn covers the picture by this share only, below 1, its depth tested but not written; the
    /// picture's own alpha stays. `by_alpha`: by the alpha of what is drawn, which the share is a part of.
    void blend_by(float opacity, bool by_alpha = false);

    /// Takes the program of the pair that fits; no clip = not cut.
    void use_program(const ProgramPair& programs, const scene::Clip* clip = nullptr);

    void count_draw_call() { ++draw_calls_; }

    int draw_calls() const { return draw_calls_; }

private:
    const Functions& gl_;
    int draw_calls_ = 0;
};

} // namespace octant::visuals::gl
