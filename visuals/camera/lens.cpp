#include "visuals/camera/lens.h"

#include "sim/base/error.h"
#include "visuals/camera/trigonometry.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>

namespace octant::visuals::camera {

namespace {

constexpr int max_side_px = 8192;
/// The tangent of 60 degrees: of how far to the side one face sees at most.
constexpr double widest_tangent = 1.7320508075688772;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// The axes of a face, in those of the camera.
struct FaceAxes {
    glm::dvec3 right;
    glm::dvec3 down;
    glm::dvec3 ahead;

    /// Where a ray meets the plane at distance 1; NaN for rays that do not, or far to the side.
    glm::dvec2 plane(const glm::dvec3& ray) const {
        const double along = glm::dot(ray, ahead);
        const glm::dvec2 across(glm::dot(ray, right), glm::dot(ray, down));
        const bool is_far = !(along * 8.0 > std::max(std::abs(across.x), std::abs(across.y)));
        return is_far ? glm::dvec2(not_a_number) : across / along;
    }

    glm::dquat to_camera() const {
        const auto in_view = [](const glm::dvec3& v) { return glm::dvec3(v.x, -v.y, -v.z); };
        return glm::normalize(glm::quat_cast(glm::dmat3(in_view(right), in_view(-down), in_view(-ahead))));
    }
};

/// Ahead, right, left, down, up, back.
constexpr std::size_t cube_faces = 6;
const std::array<FaceAxes, cube_faces> cube_axes{
    {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}, {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}},
        {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}, {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}}}};

std::size_t cube_face_of(const glm::dvec3& ray) {
    std::size_t best = 0;
    for (std::size_t face = 1; face < cube_faces; ++face) {
        if (glm::dot(ray, cube_axes[face].ahead) > glm::dot(ray, cube_axes[best].ahead)) { best = face; }
    }
    return best;
}

/// Places along a side of a picture at which rays are found: the pixels' middles, and its edges before and behind them.
double place_on(int index, int size_px) {
    return index == 0 ? -0.5 : index == size_px + 1 ? size_px - 0.5 : static_cast<double>(index - 1);
}

[[noreturn]] void throw_fold(const LensModel& lens, double radius_px) {
    const glm::dvec2 first = glm::abs(glm::dvec2(-0.5) - lens.centre_px);
    const glm::dvec2 last = glm::abs(glm::dvec2(lens.size_px) - 0.5 - lens.centre_px);
    throw Error(fmt::format("camera: expected a distortion that is one to one over the picture, up to {:.1f} pixels "
                            "from its centre, got one that folds, or sees straight back, at {:.1f} pixels",
        glm::length(glm::max(first, last)), radius_px));
}

using RayRow = std::vector<glm::dvec3>;

/// Goes through the pixels of a picture with their rays and their neighbours'.
class PixelWalk {
public:
    explicit PixelWalk(const LensModel& lens) : lens_(lens), finder_(lens) {}

    /// Calls work(pixel, middle, {left, right, above, below}) with rays.
    template <class Work>
    void for_each(const Work& work) {
        fill(above_, 0);
        fill(here_, 1);
        for (int row = 0; row < lens_.size_px.y; ++row) {
            fill(below_, row + 2);
            for (int column = 0; column < lens_.size_px.x; ++column) {
                const auto at = static_cast<std::size_t>(column) + 1;
                work(glm::ivec2(column, row), here_[at],
                    std::array{here_[at - 1], here_[at + 1], above_[at], below_[at]});
            }
            std::swap(above_, here_);
            std::swap(here_, below_);
        }
    }

private:
    void fill(RayRow& row, int index) {
        row.resize(static_cast<std::size_t>(lens_.size_px.x) + 2);
        for (int column = 0; column < lens_.size_px.x + 2; ++column) {
            const glm::dvec2 at(place_on(column, lens_.size_px.x), place_on(index, lens_.size_px.y));
            const auto ray = finder_.ray(at);
            if (!ray) { throw_fold(lens_, glm::length(at - lens_.centre_px)); }
            row[static_cast<std::size_t>(column)] = *ray;
        }
    }

    const LensModel& lens_;
    RayFinder finder_;
    RayRow above_;
    RayRow here_;
    RayRow below_;
};

/// What a pixel shows of the plane of a face, at distance 1.
struct PlanePrint {
    glm::dvec2 at{0.0};
    glm::dvec2 right{0.0};
    glm::dvec2 down{0.0};

    /// Half the sides of the rectangle around it.
    glm::dvec2 half() const { return 0.5 * (glm::abs(right) + glm::abs(down)); }

    /// By how much it is narrower across its narrowest direction than a pixel of size 1.
    double narrowest() const {
        const double sum = glm::dot(right, right) + glm::dot(down, down);
        const double area = right.x * down.y - right.y * down.x;
        return std::sqrt(0.5 * std::max(sum - std::sqrt(std::max(sum * sum - 4.0 * area * area, 0.0)), 0.0));
    }
};

/// The difference for one pixel between places before and behind it, which are that many pixels away; where one is out
/// of the face's sight, between the middle and the other one.
glm::dvec2 difference(
    const glm::dvec2& before, double to_before, const glm::dvec2& middle, const glm::dvec2& behind, double to_behind) {
    if (std::isnan(before.x)) { return std::isnan(behind.x) ? glm::dvec2(0.0) : (behind - middle) / to_behind; }
    if (std::isnan(behind.x)) { return (middle - before) / to_before; }
    return (behind - before) / (to_before + to_behind);
}

PlanePrint plane_print(const LensModel& lens, const FaceAxes& axes, const glm::ivec2& pixel, const glm::dvec3& middle,
    const std::array<glm::dvec3, 4>& around) {
    const auto before = [](int at) { return at == 0 ? 0.5 : 1.0; };
    const auto behind = [](int at, int size) { return at == size - 1 ? 0.5 : 1.0; };
    PlanePrint print;
    print.at = axes.plane(middle);
    print.right = difference(
        axes.plane(around[0]), before(pixel.x), print.at, axes.plane(around[1]), behind(pixel.x, lens.size_px.x));
    print.down = difference(
        axes.plane(around[2]), before(pixel.y), print.at, axes.plane(around[3]), behind(pixel.y, lens.size_px.y));
    return print;
}

/// What the pixels of a face show of its plane.
struct PlanePart {
    std::size_t count = 0;
    glm::dvec2 min{std::numeric_limits<double>::max()};
    glm::dvec2 max{std::numeric_limits<double>::lowest()};
    double narrowest = std::numeric_limits<double>::max(); ///< pixel

    void add(const PlanePrint& print) {
        ++count;
        min = glm::min(min, print.at - print.half());
        max = glm::max(max, print.at + print.half());
        const double width = print.narrowest();
        if (width > 0.0) { narrowest = std::min(narrowest, width); }
    }
};

/// Pixels of a face beyond what the camera's pixels show, on each side, for the filter.
constexpr double margin_px = 2.0;

/// A face's picture: how its pixels lie in its plane.
struct Raster {
    glm::ivec2 size_px{0};
    glm::dvec2 first{0.0}; ///< the upper left corner
    double focal_px = 1.0;
};

Raster raster_of(const PlanePart& part, double scale, const glm::ivec2& camera_px) {
    constexpr double max_share = 16.0;
    constexpr double always_allowed_px = 64.0 * 64.0;
    const glm::dvec2 extent = glm::max(part.max - part.min, glm::dvec2(1e-6));
    double focal = scale / part.narrowest;
    const double room = max_side_px - 2.0 * margin_px - 1.0;
    focal = std::min({focal, room / extent.x, room / extent.y});
    const double most = std::max(max_share * camera_px.x * camera_px.y, always_allowed_px);
    focal = std::min(focal, std::sqrt(most / (extent.x * extent.y)));
    Raster raster;
    raster.focal_px = focal;
    raster.size_px = glm::ivec2(glm::ceil(extent * focal + 2.0 * margin_px));
    raster.first = 0.5 * (part.min + part.max) - glm::dvec2(raster.size_px) / (2.0 * focal);
    return raster;
}

Face face_of(const FaceAxes& axes, const Raster& raster) {
    Face face;
    face.to_camera = axes.to_camera();
    face.size_px = raster.size_px;
    face.half_height = raster.size_px.y / (2.0 * raster.focal_px);
    face.shape.vertical_fov_rad = 2.0 * angle_of(1.0, face.half_height);
    const glm::dvec2 middle = raster.first + glm::dvec2(raster.size_px) / (2.0 * raster.focal_px);
    face.shape.middle = {middle.x, -middle.y};
    return face;
}

std::int16_t fixed_point(double px) {
    constexpr double whole = 256.0;
    return static_cast<std::int16_t>(std::floor(std::clamp(px, -127.0, 127.0) * whole + 0.5));
}

FootPrint foot_print_of(const PlanePrint& print, const Raster& raster) {
    const glm::dvec2 right = print.right * raster.focal_px;
    const glm::dvec2 down = print.down * raster.focal_px;
    return {glm::vec2((print.at - raster.first) * raster.focal_px - 0.5), {fixed_point(right.x), fixed_point(right.y)},
        {fixed_point(down.x), fixed_point(down.y)}};
}

bool contains_centre(const LensModel& lens) {
    const glm::dvec2 at = lens.centre_px;
    return at.x >= 0.0 && at.y >= 0.0 && at.x <= lens.size_px.x - 1 && at.y <= lens.size_px.y - 1;
}

/// Three colours in a number, 21 bits each: of 8 bits they can be weighted and added together.
struct PackedColours {
    static constexpr unsigned lane_bits = 21;

    std::uint64_t packed = 0;

    friend PackedColours operator+(PackedColours a, PackedColours b) { return {a.packed + b.packed}; }

    friend PackedColours operator*(PackedColours a, std::uint32_t weight) { return {a.packed * weight}; }

    std::uint32_t operator[](unsigned colour) const {
        return static_cast<std::uint32_t>(packed >> (lane_bits * colour) & ((std::uint64_t{1} << lane_bits) - 1));
    }
};

/// Three colours of 16 bits, or weighted sums of them.
struct DeepSums {
    std::array<std::uint32_t, 3> of{};

    friend DeepSums operator+(const DeepSums& a, const DeepSums& b) {
        return {{a.of[0] + b.of[0], a.of[1] + b.of[1], a.of[2] + b.of[2]}};
    }

    friend DeepSums operator*(const DeepSums& a, std::uint32_t weight) {
        return {{a.of[0] * weight, a.of[1] * weight, a.of[2] * weight}};
    }

    std::uint32_t operator[](unsigned colour) const { return of[colour]; }
};

/// The pixels of a picture with 8 bits.
struct PicturePixels {
    using Colours = PackedColours;
    static constexpr std::uint32_t full_by = 257; ///< makes a colour one of 16 bits
    const std::uint8_t* first;

    PackedColours at(std::size_t pixel) const {
        const std::uint8_t* const rgba = first + 4 * pixel;
        return {rgba[0] | std::uint64_t{rgba[1]} << PackedColours::lane_bits |
                std::uint64_t{rgba[2]} << (2 * PackedColours::lane_bits)};
    }
};

/// The pixels of a picture with 16 bits.
struct DeepPixels {
    using Colours = DeepSums;
    static constexpr std::uint32_t full_by = 1;
    const std::uint16_t* first;

    DeepSums at(std::size_t pixel) const {
        const std::uint16_t* const rgb = first + 3 * pixel;
        return {{rgb[0], rgb[1], rgb[2]}};
    }
};

/// A picture that is read between its pixels.
template <class Pixels>
class PictureReader {
public:
    using Colours = typename Pixels::Colours;
    static constexpr std::uint32_t full_by = Pixels::full_by;
    static constexpr int fraction_bits = 5;
    static constexpr std::uint32_t whole = 1U << (2 * fraction_bits);

    PictureReader(const Pixels& pixels, const glm::ivec2& size_px)
        : pixels_(pixels), width_(static_cast<std::size_t>(size_px.x)), last_(size_px - 1) {}

    /// Between the four pixels around a place, 1/32 pixel; the sum of weights is `whole`.
    Colours between(int x, int y) const {
        constexpr int unit = 1 << fraction_bits;
        const auto right = static_cast<std::uint32_t>(x & (unit - 1));
        const auto below = static_cast<std::uint32_t>(y & (unit - 1));
        const std::size_t at =
            place(std::clamp(x >> fraction_bits, 0, last_.x - 1), std::clamp(y >> fraction_bits, 0, last_.y - 1));
        const Colours upper = pixels_.at(at) * (unit - right) + pixels_.at(at + 1) * right;
        const Colours lower = pixels_.at(at + width_) * (unit - right) + pixels_.at(at + width_ + 1) * right;
        return upper * (unit - below) + lower * below;
    }

    Colours nearest(const glm::vec2& at) const {
        return pixels_.at(place(std::clamp(static_cast<int>(std::floor(at.x + 0.5F)), 0, last_.x),
            std::clamp(static_cast<int>(std::floor(at.y + 0.5F)), 0, last_.y)));
    }

private:
    std::size_t place(int column, int row) const {
        return static_cast<std::size_t>(row) * width_ + static_cast<std::size_t>(column);
    }

    Pixels pixels_;
    std::size_t width_;
    glm::ivec2 last_;
};

/// Places to read along one side of a foot print, so that they are no farther apart than pixels.
int places_along(const glm::i16vec2& side) {
    constexpr int max_places = 8;
    constexpr int whole = 256;
    const int square = side.x * side.x + side.y * side.y;
    int places = 1;
    // A side may be longer by an eighth of a pixel.
    while (places < max_places && square > (places * whole + 32) * (places * whole + 32)) { ++places; }
    return places;
}

using ColourSums = std::array<std::uint32_t, 3>;

template <class Reader>
ColourSums mean_over(const FootPrint& print, const Reader& picture) {
    constexpr int shift = 8 - Reader::fraction_bits;
    const int columns = places_along(print.right);
    const int rows = places_along(print.down);
    const glm::ivec2 middle(glm::floor(print.at_px * 256.0F + 0.5F));
    const glm::ivec2 right(print.right);
    const glm::ivec2 down(print.down);
    ColourSums sums{};
    for (int j = 0; j < rows; ++j) {
        const glm::ivec2 start = middle + down * (2 * j + 1 - rows) / (2 * rows) + (1 << (shift - 1));
        typename Reader::Colours row_sum; // at most 8 times 255 * 1024: fits in 21 bits
        for (int i = 0; i < columns; ++i) {
            const glm::ivec2 at = start + right * (2 * i + 1 - columns) / (2 * columns);
            row_sum = row_sum + picture.between(at.x >> shift, at.y >> shift);
        }
        for (unsigned k = 0; k < 3; ++k) { sums[k] += row_sum[k]; } // at most 64 times 65535 * 1024: fits in 32 bits
    }
    const auto weight = static_cast<std::uint32_t>(columns * rows) * Reader::whole;
    for (std::uint32_t& sum : sums) {
        sum = static_cast<std::uint32_t>((std::uint64_t{sum} * Reader::full_by + weight / 2) / weight);
    }
    return sums;
}

/// What a place of a face's picture sees, in the camera's axes; 1 along the face's.
glm::dvec3 ray_at(const Face& face, const glm::vec2& at_px) {
    const glm::dvec2 pixel_side = glm::dvec2(face.shape.pixel_aspect, 1.0) * (2.0 * face.half_height / face.size_px.y);
    const glm::dvec2 from_middle = (glm::dvec2(at_px) + 0.5 - 0.5 * glm::dvec2(face.size_px)) * pixel_side;
    const glm::dvec3 in_view =
        face.to_camera * glm::dvec3(face.shape.middle.x + from_middle.x, face.shape.middle.y - from_middle.y, -1.0);
    return {in_view.x, -in_view.y, -in_view.z};
}

} // namespace

std::span<const FootPrint> Face::foot_prints_of(int first_row, int end_row) const {
    const std::size_t first = row_begin[static_cast<std::size_t>(first_row)];
    return std::span(foot_prints).subspan(first, row_begin[static_cast<std::size_t>(end_row)] - first);
}

std::span<const std::uint32_t> Face::pixels_of(int first_row, int end_row) const {
    const std::size_t first = row_begin[static_cast<std::size_t>(first_row)];
    return std::span(pixels).subspan(first, row_begin[static_cast<std::size_t>(end_row)] - first);
}

scene::Camera Face::at(const glm::dvec3& eye_m, const glm::dquat& view_to_world) const {
    scene::Camera camera = shape;
    camera.eye_m = eye_m;
    camera.view_to_world = view_to_world * to_camera;
    return camera;
}

Lens::Lens(const LensModel& model, int samples) : model_(model), has_one_sample_(samples == 1), projector_(model) {
    check_numbers(samples);
    if (model_.distortion == Distortion::None) {
        make_pinhole(samples);
    } else {
        check_folds();
        make_faces(samples);
    }
}

void Lens::check_numbers(int samples) const {
    const glm::ivec2 size = model_.size_px;
    const auto is_side = [](int px) { return px >= 1 && px <= max_side_px; };
    if (!is_side(size.x) || !is_side(size.y)) {
        throw Error(fmt::format(
            "camera: expected a size from 1 x 1 to {0} x {0} pixels, got {1} x {2}", max_side_px, size.x, size.y));
    }
    if (samples != 1 && samples != 4 && samples != 16) {
        throw Error(fmt::format("camera: expected 1, 4 or 16 samples a pixel, got {}", samples));
    }
    const glm::dvec2 focal = model_.focal_px;
    const auto is_focal = [](double px) { return px > 1e-3 && px < 1e7; };
    if (!is_focal(focal.x) || !is_focal(focal.y)) {
        throw Error(fmt::format(
            "camera: expected focal lengths fx, fy between 0.001 and 1e7 pixels, got {}, {}", focal.x, focal.y));
    }
    const auto is_centre = [](double px) { return std::abs(px) < 1e6; };
    if (!is_centre(model_.centre_px.x) || !is_centre(model_.centre_px.y)) {
        throw Error(fmt::format("camera: expected a centre cx, cy between -1e6 and 1e6 pixels, got {}, {}",
            model_.centre_px.x, model_.centre_px.y));
    }
    for (const double coefficient : model_.coefficients) {
        if (!(std::abs(coefficient) < 1e6)) {
            throw Error(fmt::format(
                "camera: expected coefficients of the distortion between -1e6 and 1e6, got {}", coefficient));
        }
    }
}

/// Walks along the edge of the picture: nothing folds inside it where nothing folds on the ways from the centre to its
/// edge.
void Lens::check_folds() const {
    const glm::dvec2 first(-0.5);
    const glm::dvec2 last = glm::dvec2(model_.size_px) - 0.5;
    const double right_px = std::clamp(model_.centre_px.x, first.x, last.x);
    const double down_px = std::clamp(model_.centre_px.y, first.y, last.y);
    std::optional<double> fold_px;
    const auto look_towards = [&](const glm::dvec2& edge_px) {
        const double reach = model_.reach_towards(edge_px);
        if (reach < 1.0) {
            const double radius_px = reach * glm::length(edge_px - model_.centre_px);
            fold_px = std::min(fold_px.value_or(radius_px), radius_px);
        }
    };
    constexpr int places = 256;
    for (int i = 0; i <= places; ++i) {
        const glm::dvec2 at = first + (last - first) * (static_cast<double>(i) / places);
        for (const glm::dvec2& edge : {glm::dvec2(at.x, first.y), glm::dvec2(at.x, last.y), glm::dvec2(first.x, at.y),
                 glm::dvec2(last.x, at.y)}) {
            look_towards(edge);
        }
    }
    for (const double x : {first.x, last.x}) { look_towards({x, down_px}); }
    for (const double y : {first.y, last.y}) { look_towards({right_px, y}); }
    if (fold_px) { throw_fold(model_, *fold_px); }
}

void Lens::make_pinhole(int samples) {
    const glm::dvec2 size(model_.size_px);
    const glm::dvec2 middle = ((size - 1.0) * 0.5 - model_.centre_px) / model_.focal_px;
    Face& face = faces_.emplace_back();
    face.size_px = model_.size_px;
    face.samples = samples;
    face.half_height = size.y / (2.0 * model_.focal_px.y);
    face.shape.vertical_fov_rad = 2.0 * angle_of(1.0, face.half_height);
    face.shape.middle = {middle.x, -middle.y};
    face.shape.pixel_aspect = model_.focal_px.y / model_.focal_px.x;
}

void Lens::make_faces(int samples) {
    // The rays of the edge are the farthest from straight ahead, and those of the undistorted picture.
    bool fits_one = true;
    double safe_radius = std::numeric_limits<double>::max();
    RayFinder finder(model_);
    const auto look = [&](double x, double y) {
        const glm::dvec3 ray = finder.ray({x, y}).value_or(glm::dvec3(0.0, 0.0, -1.0));
        const glm::dvec2 plane = glm::dvec2(ray.x, ray.y) / ray.z;
        fits_one = fits_one && ray.z > 0.0 && std::max(std::abs(plane.x), std::abs(plane.y)) <= widest_tangent;
        if (ray.z > 0.0) { safe_radius = std::min(safe_radius, glm::length(plane)); }
    };
    const glm::ivec2 size = model_.size_px;
    for (int i = 0; i < size.x + 2; ++i) { look(place_on(i, size.x), -0.5); }
    for (int i = 0; i < size.y + 2; ++i) { look(size.x - 0.5, place_on(i, size.y)); }
    for (int i = size.x + 1; i >= 0; --i) { look(place_on(i, size.x), size.y - 0.5); }
    for (int i = size.y + 1; i >= 0; --i) { look(-0.5, place_on(i, size.y)); }

    projector_ = PointProjector(model_, contains_centre(model_) ? safe_radius : 0.0);

    std::array<PlanePart, cube_faces> parts;
    const auto face_index = [&](const glm::dvec3& ray) { return fits_one ? 0 : cube_face_of(ray); };
    PixelWalk(model_).for_each([&](const glm::ivec2& pixel, const glm::dvec3& middle, const auto& around) {
        const std::size_t index = face_index(middle);
        parts[index].add(plane_print(model_, cube_axes[index], pixel, middle, around));
    });
    std::array<Raster, cube_faces> rasters;
    std::array<std::size_t, cube_faces> place{};
    for (std::size_t index = 0; index < cube_faces; ++index) {
        if (parts[index].count == 0) { continue; }
        rasters[index] = raster_of(parts[index], samples == 1 ? 1.0 : 2.0, size);
        place[index] = faces_.size();
        Face& face = faces_.emplace_back(face_of(cube_axes[index], rasters[index]));
        face.samples = std::max(samples / 4, 1);
        face.pixels.reserve(parts[index].count);
        face.foot_prints.reserve(parts[index].count);
    }
    PixelWalk(model_).for_each([&](const glm::ivec2& pixel, const glm::dvec3& middle, const auto& around) {
        const std::size_t index = face_index(middle);
        if (pixel.x == 0) {
            for (Face& face : faces_) { face.row_begin.push_back(face.pixels.size()); }
        }
        Face& face = faces_[place[index]];
        face.pixels.push_back(static_cast<std::uint32_t>(pixel.y * size.x + pixel.x));
        const PlanePrint print = plane_print(model_, cube_axes[index], pixel, middle, around);
        face.foot_prints.push_back(foot_print_of(print, rasters[index]));
    });
    for (Face& face : faces_) { face.row_begin.push_back(face.pixels.size()); }
}

void Lens::resample(const Face& face, const scene::Picture& picture, int first_row, int end_row,
    std::span<std::uint16_t> colours) const {
    assert(glm::ivec2(picture.width, picture.height) == face.size_px);
    if (is_pinhole()) {
        const auto width = static_cast<std::size_t>(picture.width);
        for (std::size_t i = static_cast<std::size_t>(first_row) * width; i < static_cast<std::size_t>(end_row) * width;
             ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                colours[3 * i + k] = static_cast<std::uint16_t>(picture.rgba[4 * i + k] * 257);
            }
        }
        return;
    }
    resample_by(PictureReader(PicturePixels{picture.rgba.data()}, face.size_px), face, first_row, end_row, colours);
}

void Lens::resample(const Face& face, std::span<const std::uint16_t> picture, int first_row, int end_row,
    std::span<std::uint16_t> colours) const {
    assert(picture.size() == 3 * static_cast<std::size_t>(face.size_px.x) * static_cast<std::size_t>(face.size_px.y));
    if (is_pinhole()) {
        const auto row_values = 3 * static_cast<std::ptrdiff_t>(face.size_px.x);
        std::copy(picture.begin() + row_values * first_row, picture.begin() + row_values * end_row,
            colours.begin() + row_values * first_row);
        return;
    }
    resample_by(PictureReader(DeepPixels{picture.data()}, face.size_px), face, first_row, end_row, colours);
}

template <class Reader>
void Lens::resample_by(
    const Reader& reader, const Face& face, int first_row, int end_row, std::span<std::uint16_t> colours) const {
    const std::span<const FootPrint> prints = face.foot_prints_of(first_row, end_row);
    const std::span<const std::uint32_t> pixels = face.pixels_of(first_row, end_row);
    for (std::size_t i = 0; i < prints.size(); ++i) {
        ColourSums sums{};
        if (has_one_sample_) {
            const auto nearest = reader.nearest(prints[i].at_px);
            for (unsigned k = 0; k < 3; ++k) { sums[k] = nearest[k] * Reader::full_by; }
        } else {
            sums = mean_over(prints[i], reader);
        }
        for (std::size_t k = 0; k < 3; ++k) {
            colours[3 * std::size_t{pixels[i]} + k] = static_cast<std::uint16_t>(sums[k]);
        }
    }
}

double Lens::depth_scale(const Face& face, const glm::vec2& at_px) const {
    const glm::dvec3 ray = ray_at(face, at_px);
    const double length = glm::length(ray);
    return ray.z > LensModel::unit_length_cos * length ? ray.z : length;
}

glm::vec2 Lens::flow(const Face& face, std::uint32_t pixel, const glm::vec2& previous_px) const {
    const auto before = projector_.project(ray_at(face, previous_px));
    if (!before) { return glm::vec2(std::numeric_limits<float>::quiet_NaN()); }
    const auto width = static_cast<std::uint32_t>(model_.size_px.x);
    return glm::vec2(glm::dvec2(pixel % width, pixel / width) - *before);
}

void add_filter_places(const FootPrint& print, std::vector<glm::vec2>& places_px) {
    const int columns = places_along(print.right);
    const int rows = places_along(print.down);
    const auto offset = [](const glm::i16vec2& side, int index, int count) {
        return glm::vec2(side) * (static_cast<float>(2 * index + 1 - count) / static_cast<float>(512 * count));
    };
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            places_px.push_back(print.at_px + offset(print.right, i, columns) + offset(print.down, j, rows));
        }
    }
}

} // namespace octant::visuals::camera
