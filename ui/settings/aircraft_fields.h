#pragma once

#include "ui/settings/settings_text.h"

namespace octant::ui::settings {

// As ui/settings_fields.h, which includes it: settings of how aircraft are drawn.

/// Fields that say how hidden surfaces are removed.
template <class SomeSettings, class Visit>
void visit_surface_settings(SomeSettings& s, Visit& visit) {
    using Info = FieldInfo;
    visit(
        Info{
            "hidden-surface",
            "METHOD",
            "octant: painted in order, no depth buffer; depth-buffer; back-face: aircraft in file "
            "order"},
        s.surface.hidden_surface);
    visit(
        Info{
            "order-method",
            "METHOD",
            "painting order of octant: tree (exact for every eye), cells (octants divided further) "
            "or paper (8 octants as printed)"},
        s.surface.order_method);
    visit(Info{"shadows", "", "shadows of aircraft on the ground"}, s.surface.shadows);
    visit(
        Info{
            "aircraft-error-px",
            "PIXELS",
            "meshes: refined, or the coarsest level of a .chain, to be wrong by no more",
            0.01,
            100.0},
        s.surface.aircraft_error_px);
}

/// Fields that say how aircraft are shaded.
template <class SomeSettings, class Visit>
void visit_shading_settings(SomeSettings& s, Visit& visit) {
    using Info = FieldInfo;
    visit(
        Info{
            "shading",
            "KIND",
            "aircraft: flat, gouraud, or hybrid (the polygons that gain most are smooth)"},
        s.shading.kind);
    visit(
        Info{
            "shading-rule",
            "RULE",
            "hybrid: error (area times squared error of flat shading) or paper (distance, "
            "intensities, perimeter)"},
        s.shading.rule);
    visit(
        Info{"smooth-share", "SHARE", "hybrid: share of the polygons that are smooth", 0.0, 1.0},
        s.shading.smooth_share);
    visit(
        Info{
            "device-ratio",
            "RATIO",
            "hybrid: the same as the paper's speed of a device, 1 = all smooth [smooth-share]",
            0.0,
            1.0},
        s.shading.device_ratio);
    visit(
        Info{"shading-near", "METRES", "paper's rule: all smooth to this distance", 0.0, 1e7},
        s.shading.near_m);
    visit(
        Info{"shading-far", "METRES", "paper's rule: all flat from this distance", 0.0, 1e7},
        s.shading.far_m);
    visit(
        Info{
            "show-model",
            "WHAT",
            "colours on aircraft: none, shading (smooth polygons blue, flat ones orange) or levels "
            "(a colour for each halving of what a mesh is wrong by, white where it is not)"},
        s.shading.show_model);
}

} // namespace octant::ui::settings
