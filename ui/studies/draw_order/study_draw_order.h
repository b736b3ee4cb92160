#pragma once

#include "ui/studies/study.h"

namespace octant::ui::studies::draw_order {

/// Repeats tables 1 and 4 of the 1989 paper (frame rates; the eight orders of its example object) next to our results.
/// Then compares the ordering methods for F-15, 500MD and the example: number of cells, lists and splits, share of
/// wrong pixels by distance, and the cost of a BSP tree for the same models. Prints the tables and writes them to `out`
/// as CSV and as one Markdown page. Throws Error.
void study_draw_order(const base::StudyOutput& output);

/// Repeats tables 5 and 6 of the 1989 paper: aircraft alone (100 frames of an orbit), and the four paths over the
/// 60-polygon background with one frame per path sample, for octant order, depth buffer and back-face removal by OpenGL
/// and for all methods of the raster renderer. The methods draw each frame in turn, so that load from other programs
/// affects all of them. Prints the tables next to the paper's values and writes them to `out` as CSV, Markdown and
/// plot, with the recordings of the octant flights and a report. Size, samples and context are those of the settings.
/// Throws Error.
void study_flights(const StudyOptions& options);

struct PictureStudyOptions : StudyOptions {
    int frames = 4; ///< of each scene
};

/// Compares the pictures of both renderers with 1, 4 and 16 samples per pixel with references of 8 x 8 samples, over
/// frames spread along the paths of six scenes: peak signal to noise ratio, largest error, and the number of pixels
/// that change wrongly when the picture moves by half a pixel. Prints the tables and writes them to `out` as CSV and
/// Markdown, with the last picture of each scene in every mode and its tile masks as PNG. Size, triangles and context
/// are those of the settings. The same options give the same bytes. Throws Error.
void study_pictures(const PictureStudyOptions& options);

} // namespace octant::ui::studies::draw_order
