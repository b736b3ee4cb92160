#pragma once

#include "ui/report/plots.h"
#include "ui/report/png_file.h"

#include <string>

namespace octant::ui::report {

/// Size of a figure on paper: by default the width of one column of a page of two.
struct FigureSize {
    double width_mm = 88.0;
    double height_mm = 58.0; ///< grows where the names of curves and marks need more
};

/// A plot as an SVG file, with white ground and without its title, which a reader program is told. Texts are outlines,
/// so that no font is needed. Named curves differ in dashes and marks too, so that they can be told apart without
/// colour; an area without a name is the pale band of a curve of the same colour. The same plot gives the same bytes
/// wherever the same fonts are installed; ids within the file differ between figures, so that one page can hold
/// several. Throws Error if cairo is missing or fails.
std::string figure_svg(const Plot& plot, FigureSize size = {});

/// The same as a PDF file of one page, its fonts embedded, without a date.
std::string figure_pdf(const Plot& plot, FigureSize size = {});

/// The same as a picture of RGB pixels.
Picture figure_picture(const Plot& plot, FigureSize size, double px_per_mm);

/// Width over height of what the axes of such a figure enclose.
double shape_of_axes(const Plot& plot, FigureSize size);

} // namespace octant::ui::report
