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
    EnumName{visuals::scene::View::Chase, "chase"},
    EnumName{visuals::scene::View::Cockpit, "cockpit"},
    EnumName{visuals::scene::View::Tower, "tower"},
    EnumName{visuals::scene::View::Orbit, "orbit"},
    EnumName{visuals::scene::View::Free, "free"}};

template <>
inline constexpr std::array enum_names<sim::HeightMode>{
    EnumName{sim::HeightMode::Clear, "clear"},
    EnumName{sim::HeightMode::Follow, "follow"},
    EnumName{sim::HeightMode::Datum, "datum"}};

template <>
inline constexpr std::array enum_names<RendererKind>{
    EnumName{RendererKind::Auto, "auto"},
    EnumName{RendererKind::Raster, "raster"},
    EnumName{RendererKind::Gl, "gl"}};

template <>
inline constexpr std::array enum_names<ContextKind>{
    EnumName{ContextKind::OsMesa, "osmesa"},
    EnumName{ContextKind::Egl, "egl"},
    EnumName{ContextKind::Window, "window"}};

template <>
inline constexpr std::array enum_names<visuals::scene::GroundMetric>{
    EnumName{visuals::scene::GroundMetric::Printed, "printed"},
    EnumName{visuals::scene::GroundMetric::Midpoint, "midpoint"},
    EnumName{visuals::scene::GroundMetric::ScreenError, "screen-error"}};

template <>
inline constexpr std::array enum_names<visuals::scene::Propagation>{
    EnumName{visuals::scene::Propagation::CrackFree, "crack-free"},
    EnumName{visuals::scene::Propagation::Printed, "printed"}};

template <>
inline constexpr std::array enum_names<visuals::scene::GroundFans>{
    EnumName{visuals::scene::GroundFans::Partial, "partial"},
    EnumName{visuals::scene::GroundFans::Full, "full"}};

template <>
inline constexpr std::array enum_names<visuals::scene::DetailControl>{
    EnumName{visuals::scene::DetailControl::Exact, "exact"},
    EnumName{visuals::scene::DetailControl::Damped, "damped"},
    EnumName{visuals::scene::DetailControl::Previous, "previous"},
    EnumName{visuals::scene::DetailControl::Printed, "literal"},
    EnumName{visuals::scene::DetailControl::Fixed, "fixed"}};

template <>
inline constexpr std::array enum_names<visuals::scene::MeshDisplay>{
    EnumName{visuals::scene::MeshDisplay::None, "none"},
    EnumName{visuals::scene::MeshDisplay::Edges, "edges"},
    EnumName{visuals::scene::MeshDisplay::Levels, "levels"}};

template <>
inline constexpr std::array enum_names<visuals::scene::ModelDisplay>{
    EnumName{visuals::scene::ModelDisplay::None, "none"},
    EnumName{visuals::scene::ModelDisplay::Shading, "shading"},
    EnumName{visuals::scene::ModelDisplay::Levels, "levels"}};

template <>
inline constexpr std::array enum_names<visuals::scene::Palette>{
    EnumName{visuals::scene::Palette::Temperate, "temperate"},
    EnumName{visuals::scene::Palette::Arid, "arid"}};

template <>
inline constexpr std::array enum_names<visuals::scene::GroundShading>{
    EnumName{visuals::scene::GroundShading::Auto, "auto"},
    EnumName{visuals::scene::GroundShading::Vertex, "vertex"},
    EnumName{visuals::scene::GroundShading::Texture, "texture"}};

template <>
inline constexpr std::array enum_names<visuals::scene::AircraftShading>{
    EnumName{visuals::scene::AircraftShading::Flat, "flat"},
    EnumName{visuals::scene::AircraftShading::Gouraud, "gouraud"},
    EnumName{visuals::scene::AircraftShading::Hybrid, "hybrid"},
    EnumName{visuals::scene::AircraftShading::Phong, "phong"}};

template <>
inline constexpr std::array enum_names<visuals::scene::HybridRule>{
    EnumName{visuals::scene::HybridRule::Error, "error"},
    EnumName{visuals::scene::HybridRule::Paper, "paper"}};

template <>
inline constexpr std::array enum_names<visuals::scene::HiddenSurface>{
    EnumName{visuals::scene::HiddenSurface::Octant, "octant"},
    EnumName{visuals::scene::HiddenSurface::DepthBuffer, "depth-buffer"},
    EnumName{visuals::scene::HiddenSurface::BackFace, "back-face"}};

template <>
inline constexpr std::array enum_names<visuals::draworder::OrderMethod>{
    EnumName{visuals::draworder::OrderMethod::Paper, "paper"},
    EnumName{visuals::draworder::OrderMethod::Cells, "cells"},
    EnumName{visuals::draworder::OrderMethod::Tree, "tree"},
    EnumName{visuals::draworder::OrderMethod::Bsp, "bsp"}};

template <>
inline constexpr std::array enum_names<visuals::draworder::OrderSource>{
    EnumName{visuals::draworder::OrderSource::Paper, "paper"},
    EnumName{visuals::draworder::OrderSource::Cells, "cells"},
    EnumName{visuals::draworder::OrderSource::Tree, "tree"},
    EnumName{visuals::draworder::OrderSource::Parts, "parts"},
    EnumName{visuals::draworder::OrderSource::Bsp, "bsp"},
    EnumName{visuals::draworder::OrderSource::TreeAndSplitPolygons, "tree-and-parts"}};

/// One thing that can follow the frame time, with the name that people write for it.
struct AdaptationName {
    bool visuals::scene::Adaptation::*member;
    std::string_view name;
};

inline constexpr std::array adaptations{
    AdaptationName{&visuals::scene::Adaptation::terrain, "terrain"},
    AdaptationName{&visuals::scene::Adaptation::shading, "shading"}};

} // namespace octant::ui::settings
