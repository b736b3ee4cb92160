#pragma once

#include "ui/settings/enum_names.h"
#include "ui/settings/settings.h"
#include "visuals/draworder/ordered_model.h"

#include <array>
#include <string_view>

namespace octant::ui::settings {

// Names of the values of every enumeration that settings use, as people write them.

template <>
inline constexpr std::array enum_names<visuals::scene::View>{
    Named{visuals::scene::View::Chase, "chase"},
    Named{visuals::scene::View::Cockpit, "cockpit"},
    Named{visuals::scene::View::Tower, "tower"},
    Named{visuals::scene::View::Orbit, "orbit"},
    Named{visuals::scene::View::Free, "free"}};

template <>
inline constexpr std::array enum_names<sim::HeightMode>{
    Named{sim::HeightMode::Clear, "clear"},
    Named{sim::HeightMode::Follow, "follow"},
    Named{sim::HeightMode::Datum, "datum"}};

template <>
inline constexpr std::array enum_names<RendererKind>{
    Named{RendererKind::Auto, "auto"},
    Named{RendererKind::Raster, "raster"},
    Named{RendererKind::Gl, "gl"}};

template <>
inline constexpr std::array enum_names<ContextKind>{
    Named{ContextKind::OsMesa, "osmesa"},
    Named{ContextKind::Egl, "egl"},
    Named{ContextKind::Window, "window"}};

template <>
inline constexpr std::array enum_names<visuals::scene::GroundMetric>{
    Named{visuals::scene::GroundMetric::Printed, "printed"},
    Named{visuals::scene::GroundMetric::Midpoint, "midpoint"},
    Named{visuals::scene::GroundMetric::ScreenError, "screen-error"}};

template <>
inline constexpr std::array enum_names<visuals::scene::Propagation>{
    Named{visuals::scene::Propagation::CrackFree, "crack-free"},
    Named{visuals::scene::Propagation::Printed, "printed"}};

template <>
inline constexpr std::array enum_names<visuals::scene::GroundFans>{
    Named{visuals::scene::GroundFans::Partial, "partial"},
    Named{visuals::scene::GroundFans::Full, "full"}};

template <>
inline constexpr std::array enum_names<visuals::scene::DetailControl>{
    Named{visuals::scene::DetailControl::Exact, "exact"},
    Named{visuals::scene::DetailControl::Damped, "damped"},
    Named{visuals::scene::DetailControl::Previous, "previous"},
    Named{visuals::scene::DetailControl::Literal, "literal"},
    Named{visuals::scene::DetailControl::Fixed, "fixed"}};

template <>
inline constexpr std::array enum_names<visuals::scene::MeshLook>{
    Named{visuals::scene::MeshLook::None, "none"},
    Named{visuals::scene::MeshLook::Edges, "edges"},
    Named{visuals::scene::MeshLook::Levels, "levels"}};

template <>
inline constexpr std::array enum_names<visuals::scene::ModelLook>{
    Named{visuals::scene::ModelLook::None, "none"},
    Named{visuals::scene::ModelLook::Shading, "shading"},
    Named{visuals::scene::ModelLook::Levels, "levels"}};

template <>
inline constexpr std::array enum_names<visuals::scene::Palette>{
    Named{visuals::scene::Palette::Temperate, "temperate"},
    Named{visuals::scene::Palette::Arid, "arid"}};

template <>
inline constexpr std::array enum_names<visuals::scene::GroundShading>{
    Named{visuals::scene::GroundShading::Auto, "auto"},
    Named{visuals::scene::GroundShading::Vertex, "vertex"},
    Named{visuals::scene::GroundShading::Texture, "texture"}};

template <>
inline constexpr std::array enum_names<visuals::scene::AircraftShading>{
    Named{visuals::scene::AircraftShading::Flat, "flat"},
    Named{visuals::scene::AircraftShading::Gouraud, "gouraud"},
    Named{visuals::scene::AircraftShading::Hybrid, "hybrid"},
    Named{visuals::scene::AircraftShading::Phong, "phong"}};

template <>
inline constexpr std::array enum_names<visuals::scene::HybridRule>{
    Named{visuals::scene::HybridRule::Error, "error"},
    Named{visuals::scene::HybridRule::Paper, "paper"}};

template <>
inline constexpr std::array enum_names<visuals::scene::HiddenSurface>{
    Named{visuals::scene::HiddenSurface::Octant, "octant"},
    Named{visuals::scene::HiddenSurface::DepthBuffer, "depth-buffer"},
    Named{visuals::scene::HiddenSurface::BackFace, "back-face"}};

template <>
inline constexpr std::array enum_names<visuals::draworder::Method>{
    Named{visuals::draworder::Method::Paper, "paper"},
    Named{visuals::draworder::Method::Cells, "cells"},
    Named{visuals::draworder::Method::Tree, "tree"},
    Named{visuals::draworder::Method::Bsp, "bsp"}};

template <>
inline constexpr std::array enum_names<visuals::draworder::DrawnBy>{
    Named{visuals::draworder::DrawnBy::Paper, "paper"},
    Named{visuals::draworder::DrawnBy::Cells, "cells"},
    Named{visuals::draworder::DrawnBy::Tree, "tree"},
    Named{visuals::draworder::DrawnBy::Parts, "parts"},
    Named{visuals::draworder::DrawnBy::Bsp, "bsp"},
    Named{visuals::draworder::DrawnBy::TreeAndParts, "tree-and-parts"}};

/// One thing that can follow the frame time, with the name that people write for it.
struct NamedAdaptation {
    bool visuals::scene::Adaptation::*member;
    std::string_view name;
};

inline constexpr std::array adaptations{
    NamedAdaptation{&visuals::scene::Adaptation::terrain, "terrain"},
    NamedAdaptation{&visuals::scene::Adaptation::shading, "shading"}};

} // namespace octant::ui::settings
