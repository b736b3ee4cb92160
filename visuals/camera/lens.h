#pragma once

#include "visuals/camera/lens_model.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/picture.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::camera {

/// What a pixel of the camera's picture shows of a face's picture: the parallelogram around `at_px` with these sides.
struct FootPrint {
    glm::vec2 at_px{0.0F}; ///< column and row, whole numbers in the middle of pixels; exact, for the truth
    glm::i16vec2 right{0}; ///< one pixel to the right in the camera's picture, 1/256 pixel of the face
    glm::i16vec2 down{0};
};

/// A pinhole picture that is drawn in place of a part of a distorted one, or of all of it.
struct Face {
    glm::dquat to_camera{1.0, 0.0, 0.0, 0.0}; ///< from its view axes to the camera's
    scene::Camera shape;                      ///< its field of view; eye and attitude are left out
    double half_height = 1.0;                 ///< of its picture in the plane at distance 1
    glm::ivec2 size_px{0};
    int samples = 16;
    /// The pixels of the camera's picture that it shows, row * width + column, ascending, and what they show of it;
    /// both empty where its picture is the camera's, pixel by pixel.
    std::vector<std::uint32_t> pixels;
    std::vector<FootPrint> foot_prints;
    std::vector<std::size_t> row_begin; ///< of each row of the camera's picture the first of these, and their end

    /// The foot prints, and their pixels, of the rows from `first_row` up to, not including, `end_row`.
    std::span<const FootPrint> foot_prints_of(int first_row, int end_row) const;
    std::span<const std::uint32_t> pixels_of(int first_row, int end_row) const;

    /// The camera that draws it, for a camera with that eye and attitude.
    scene::Camera at(const glm::dvec3& eye_m, const glm::dquat& view_to_world) const;
};

/// Red, green, blue of each pixel, rows from the top: display values, 65535 = full.
using DeepColours = std::vector<std::uint16_t>;

/// A camera's distortion, ready for pictures. Made once for each camera: it takes about a microsecond and at most 24
/// bytes for each pixel. A camera without distortion has one face, which is its picture.
///
/// Faces have at least the resolution of the distorted picture, twice as much with 4 and 16 samples (which have a
/// quarter of the samples in each pixel of the faces, so that a pixel of the camera has as many as without distortion),
/// up to 8,192 pixels each way and 16 times the pixels of the camera's picture. A camera that sees no farther than 60
/// degrees to the side has one face, else those of a cube that its pixels show, cut to these.
class Lens {
public:
    /// Throws Error where the distortion folds inside the picture or beyond 180 degrees from straight ahead, where a
    /// pinhole picture would be too large, or where a number is out of range.
    Lens(const LensModel& model, int samples);

    const LensModel& model() const { return model_; }

    std::span<const Face> faces() const { return faces_; }

    /// Whether the only face is the camera's picture, pixel by pixel.
    bool is_pinhole() const { return faces_.front().foot_prints.empty(); }

    /// Writes the rows from `first_row` up to, not including, `end_row` of the camera's picture that `face` shows:
    /// means over the pixels' areas in `picture`, which shows that face. `colours` has the size of the camera's
    /// picture.
    void resample(const Face& face, const scene::Picture& picture, int first_row, int end_row,
        std::span<std::uint16_t> colours) const;
    /// The same from a picture of the face with 16 bits: red, green, blue of each pixel, 65535 = full.
    void resample(const Face& face, std::span<const std::uint16_t> picture, int first_row, int end_row,
        std::span<std::uint16_t> colours) const;

    /// The depth of a point that the face shows at a place, for one that is 1 along the face's axis: with it, the
    /// model's ray times the depth is the point. It is along the camera's axis, but the distance for rays of unit
    /// length.
    double depth_scale(const Face& face, const glm::vec2& at_px) const;

    /// How far a point moved in the camera's picture, right and down: to `pixel`, from where the previous picture of
    /// the face shows it. NaN where that place is NaN, and where the lens does not see it.
    glm::vec2 flow(const Face& face, std::uint32_t pixel, const glm::vec2& previous_px) const;

private:
    void check_numbers(int samples) const;
    void check_folds() const;
    void make_pinhole(int samples);
    void make_faces(int samples);
    template <class Reader>
    void resample_by(
        const Reader& reader, const Face& face, int first_row, int end_row, std::span<std::uint16_t> colours) const;

    LensModel model_;
    bool has_one_sample_ = false;
    PointProjector projector_;
    std::vector<Face> faces_;
};

/// The places of a face, a pixel apart, whose mean is a pixel's colour, appended.
void add_filter_places(const FootPrint& print, std::vector<glm::vec2>& places_px);

} // namespace octant::visuals::camera
