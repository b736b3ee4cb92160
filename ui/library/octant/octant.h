#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <octant/error.h>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#pragma GCC visibility push(default)

/// Octant as a library: pictures of flight over terrain with their ground truth, drawn by the processor.
///
/// Lengths are in metres, times in seconds; angles are in degrees where a name ends in _deg. World axes: x east, y
/// north, z up, the local tangent plane at the centre of the map. Body axes: x forward, y right, z down. An attitude is
/// a unit quaternion that turns body axes into world axes. A camera looks along body x with body z downwards.
///
/// The same arguments give the same bytes: for any number of threads, on any processor, however pictures are divided
/// into calls. Functions throw Error for wrong arguments and unreadable files, with a message of one line.
namespace octant {

/// The version of this interface. Programs built with one major number run with libraries of the same number.
inline constexpr int abi_version = 0;
/// The version of the library that is loaded, as "0.1.0".
std::string version();

struct Vec3 {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
};

/// Turns body axes into world axes. Need not be of unit length; zero is refused.
struct Quaternion {
    double w = 1.0;
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
};

/// Heading is clockwise from north, pitch is positive nose up, bank is positive to the right.
Quaternion attitude(double heading_deg, double pitch_deg = 0.0, double bank_deg = 0.0);
/// The attitude of a camera at `eye_m` that looks at `target_m` with level horizon; north is up where it looks straight
/// up or down.
Quaternion look_at(const Vec3& eye_m, const Vec3& target_m);
/// The same orientation for cameras with other axes, turning camera axes into world axes. OpenCV: x right, y down, z
/// forward. OpenGL: x right, y up, z backward.
Quaternion to_opencv(const Quaternion& attitude);
Quaternion to_opengl(const Quaternion& attitude);
Quaternion from_opencv(const Quaternion& camera_to_world);
Quaternion from_opengl(const Quaternion& camera_to_world);

/// What a pixel shows. The numbers are part of the interface.
enum class SurfaceClass : std::uint8_t {
    Sky = 0,
    Terrain = 1,
    Water = 2,
    Road = 3,
    Runway = 4,
    Building = 5,
    Tree = 6,
    Aircraft = 7,
    Cloud = 8
};
inline constexpr std::size_t surface_class_count = 9;
/// As "sky"; the lower-case name of a class.
std::string_view name_of(SurfaceClass surface);

/// The arrays that a picture can have, to be combined by |.
enum class Output : unsigned {
    Rgb = 1,      ///< red, green, blue; 8 bits, or 16 where the camera says so
    Depth = 2,    ///< distance along the optical axis, metres (Camera::ray()); infinite where the sky is
    ClassId = 4,  ///< SurfaceClass
    ObjectId = 8, ///< 0 = none; n = World::objects()[n - 1]
    Normal = 16,  ///< unit normal of the polygon, world axes, towards the eye; 0, 0, 0 where the sky is
    Flow = 32,    ///< how far the surface point moved since the previous picture, pixels right and down; NaN unknown
    Coverage = 64 ///< the share of the pixel, 0..1, that the object of ObjectId fills, in sixteenths
};
constexpr Output operator|(Output a, Output b) { return Output(unsigned(a) | unsigned(b)); }
constexpr bool has(Output outputs, Output one) { return (unsigned(outputs) & unsigned(one)) != 0; }

enum class Distortion {
    None,
    BrownConrady, ///< k1, k2, p1, p2, k3 as OpenCV's distCoeffs
    Fisheye       ///< k1, k2, k3, k4 of the equidistant model as OpenCV's fisheye module
};

/// The matrix of a pinhole camera, in pixels. The middle of the upper left pixel is at 0, 0, as in OpenCV.
struct Intrinsics {
    double fx = 0.0;
    double fy = 0.0;
    double cx = 0.0;
    double cy = 0.0;

    bool operator==(const Intrinsics&) const = default;
};

/// A picture is made in this order: the lens, the shutter, then exposure, noise and rounding. By default it is that of
/// a pinhole, at one time, with the colours as drawn. Truth is what the middle of each pixel shows at the middle of its
/// exposure; noise, exposure and motion blur do not touch it.
///
/// Lens: a distorted picture is resampled from pinhole pictures of at least its resolution: one where it sees at most
/// 60 degrees to each side, else those faces of a cube that it shows, each with triangles of its own. A distortion that
/// folds inside the picture is refused: OpenCV would show two points in one place.
///
/// Shutter: the pose is that of the row in the middle of the picture at the middle of its exposure; row r of h is seen
/// (r - (h - 1) / 2) row_time_s later. Cameras move by Pose::velocity_mps and turn_rate_degps, aircraft by
/// State::velocity_mps; the previous picture, for the flow, moves alike. Rows are drawn in bands, each at one time, so
/// that no row is off by more than half a pixel of motion (at most 128 bands). Motion blur is the mean, in linear
/// light, of blur_frames pictures evenly spaced in shutter_s.
///
/// Light is linear by the transfer function of sRGB. Noise is normally distributed in light, its variance is
/// s^2 (15/16 L / L_grey + 1/16) for light L: photons and reading; s is such that a pixel at half the full display
/// value has the standard deviation `noise` there. It depends on RenderOptions::noise_seed, the picture's index and the
/// pixel.
struct Camera {
    int width = 128;       ///< pixels, 1 to 8192
    int height = 128;      ///< pixels, 1 to 8192
    double fov_deg = 60.0; ///< vertical field of view; ignored with `intrinsics`
    std::optional<Intrinsics> intrinsics = {};
    Distortion distortion = Distortion::None;
    std::vector<double> coefficients = {}; ///< of the distortion; missing ones are 0
    int samples = 16;                      ///< samples a pixel: 1, 4 or 16
    int bits = 8;                          ///< of each colour: 8 or 16
    double exposure = 1.0;                 ///< factor of linear light, 0 to 1e6; what is over full is clipped
    double noise = 0.0;                    ///< standard deviation of the noise of a grey pixel, share of full scale
    double shutter_s = 0.0;                ///< time that the shutter is open, 0 to 60
    int blur_frames = 1;                   ///< pictures in that time, 1 to 256; 1 = sharp
    double row_time_s = 0.0;               ///< rolling shutter: from one row to the next one below, -1 to 1

    bool operator==(const Camera&) const = default;

    /// Throws Error for a member that is out of range, as all functions do that take a camera.
    void check() const;
    Intrinsics matrix() const; ///< `intrinsics`, or those of fov_deg
    /// The pixel of a point in camera axes of OpenCV. Nothing where no pixel can show it: behind a camera (a fisheye
    /// sees there), and beyond the radius at which the distortion folds.
    std::optional<std::pair<double, double>> project(const Vec3& point_m) const;
    /// The direction, in camera axes of OpenCV, that a pixel sees, also outside the picture: with z = 1, or of unit
    /// length from 89.9 degrees on. Times the pixel's depth it is the point that the pixel shows. Error beyond the
    /// radius at which the distortion folds.
    Vec3 ray(double column, double row) const;
};

/// Where a camera is. With a previous pose, the flow is that between the two; with a velocity, a shutter time or a row
/// time moves the camera.
struct Pose {
    Vec3 eye_m = {};
    Quaternion attitude = {};
    std::optional<Vec3> previous_eye_m = {};
    std::optional<Quaternion> previous_attitude = {};
    Vec3 velocity_mps = {};
    Vec3 turn_rate_degps = {}; ///< about body axes
};

/// Where an aircraft is.
struct State {
    Vec3 position_m = {};
    Quaternion attitude = {};
    bool is_present = true; ///< an absent aircraft is not drawn
    double time_s = 0.0;    ///< turns rotors
    Vec3 velocity_mps = {};
    double load_factor = 1.0;
};

/// A thing that object ids name.
struct Object {
    std::string name; ///< unique in the world
    std::string kind; ///< the aircraft's entry of WorldSettings, as "f15"
    SurfaceClass surface = SurfaceClass::Aircraft;
    Vec3 size_m;       ///< of its box in body axes
    Vec3 box_centre_m; ///< in body axes
};

/// The settings of a world. `settings` are those of `octant fly` that are not about views, pictures and frames: the
/// name is that of the option without dashes before it or the key of --show, --haze and others like it, the value is
/// text, as {"near-detail", "false"} or {"haze-height", "1500"}. A name that takes several values may stand several
/// times. With {"path", "turn"} the world is loaded with its path, as `octant fly turn`; without, with none. The other
/// members are the settings most used, with names of their own: Error for one that is given twice.
struct WorldSettings {
    std::string terrain = "hills";
    std::vector<std::string> aircraft = {};
    std::optional<double> sun_elevation_deg = {};
    std::optional<int> triangles = {}; ///< of the ground in each picture
    std::vector<std::pair<std::string, std::string>> settings = {};
    /// Told about what is guessed or mended while loading; null = std::clog.
    std::function<void(std::string_view)> on_note = {};
};

/// Memory for the arrays of a batch, picture after picture, row after row from the top; null = not wanted.
struct FrameArrays {
    std::uint8_t* rgb = nullptr;    ///< 3 values a pixel
    std::uint16_t* rgb16 = nullptr; ///< 3 values a pixel, in place of rgb
    float* depth_m = nullptr;
    std::uint8_t* class_id = nullptr;
    std::uint32_t* object_id = nullptr;
    float* normal = nullptr;  ///< 3 values a pixel
    float* flow_px = nullptr; ///< 2 values a pixel
    float* coverage = nullptr;
};

/// The same as owned arrays; those that were not asked for are empty.
struct Frames {
    std::size_t count = 0;
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;
    std::vector<std::uint16_t> rgb16;
    std::vector<float> depth_m;
    std::vector<std::uint8_t> class_id;
    std::vector<std::uint32_t> object_id;
    std::vector<float> normal;
    std::vector<float> flow_px;
    std::vector<float> coverage;
};

/// What a picture shows of an object. Pixels are counted from the upper left corner of the picture, right and down:
/// the first pixel reaches from 0 to 1, its middle is at 0.5.
struct Box {
    std::uint32_t object_id = 0;
    /// Left, top, right, bottom of its visible pixels, whole numbers; 0 where there are none.
    double visible_px[4] = {};
    /// The same of its box, also outside the picture; what the lens cannot show is cut off.
    double whole_px[4] = {};
    /// Of its box as it is drawn, world axes: over a round earth it is sunk as the ground is. Corner i has the greater
    /// x, y and z of the body axes where bits 0, 1 and 2 of i are set.
    Vec3 corners_m[8] = {};
    /// Visible pixels over those it would have alone, outside the picture, too: as far as two pictures beyond it, and
    /// as far as the lens reaches. Of distorted pictures those outside are an area, right to about 2 %.
    double visible_share = 0.0;
    double truncation = 0.0; ///< the share of these that is outside the picture
    double distance_m = 0.0; ///< of its middle from the eye
    int pixels = 0;          ///< visible
};

struct RenderOptions {
    int threads = 0; ///< 0 = one for each processor
    /// The states of the aircraft: for all pictures, or one set after the other for each picture; empty = those of
    /// World::set_states().
    std::span<const State> states = {};
    /// As `states`, in the previous picture, for the flow; empty = those of `states` where these are given, else those
    /// before the last World::set_states().
    std::span<const State> previous_states = {};
    std::uint64_t noise_seed = 0;
    std::uint64_t first_index = 0; ///< of the first picture: its noise is that of noise_seed and this number
    /// Asked between pictures, by the thread that made the call; true ends the call early with Interrupted.
    std::function<bool()> is_stopped = {};
};

/// A call that is_stopped ended.
class Interrupted : public Error {
    using Error::Error;
};

/// Terrain, things on it, aircraft and light. May be used by several threads at once, except set_states(). Copies are
/// cheap and share everything but the states and those before them. A moved-from world stays as it was. After fork()
/// the child may go on using its worlds, if no other thread was in a call of theirs.
class World {
public:
    explicit World(const WorldSettings& settings = {});
    /// The same, but what another world has loaded from the same inputs is shared and not loaded again: aircraft, and
    /// the ground where it is the same map. For other light, weather, colours or aircraft over one map.
    World(const WorldSettings& settings, const World& shared);
    World(const World&);
    World(World&&) noexcept;
    World& operator=(const World&);
    World& operator=(World&&) noexcept;
    ~World();

    /// Heights of the ground above datum; NaN outside the map.
    double height_m(double x_m, double y_m) const;
    /// Half the extent of the map, east and north.
    std::pair<double, double> half_extent_m() const;
    /// `count` positions above the map, evenly distributed over its inner 80 %, at heights above the ground between
    /// these; the same for the same seed, and the first of many as of few. At most 100 million.
    std::vector<Vec3> random_positions(
        std::size_t count, double min_above_m, double max_above_m, std::uint64_t seed) const;
    /// Between latitude, longitude, height above datum and the local frame. Throws Error for a world that lies nowhere.
    Vec3 local(double latitude_deg, double longitude_deg, double height_m) const;
    Vec3 geodetic(const Vec3& position_m) const; ///< latitude, longitude (degrees), height above datum

    const std::vector<Object>& objects() const;

    /// One for each aircraft of the settings, in their order; fewer leave the others absent. Before the first call they
    /// fly in formation, at the beginning of the path where there is one, else 300 m above the middle of the map.
    void set_states(std::span<const State> states);
    std::span<const State> states() const; ///< valid until the next set_states()

    Frames render(const Camera& camera, std::span<const Pose> poses, Output outputs = Output::Rgb,
        const RenderOptions& options = {}) const;
    /// The same into the caller's memory.
    void render(const Camera& camera, std::span<const Pose> poses, const FrameArrays& to,
        const RenderOptions& options = {}) const;
    /// Boxes of the objects of each picture, by ascending id: of those that are in it, seen or hidden by others. What
    /// is visible is what the picture's object ids show: each row at its own time, sharp at the middle of its exposure.
    /// The whole box, its corners and its distance are those of the pose.
    std::vector<std::vector<Box>> boxes(
        const Camera& camera, std::span<const Pose> poses, const RenderOptions& options = {}) const;

    /// Writes the triangles of a picture's scene as OBJ, as they are drawn from this pose: over a round earth they are
    /// sunk. World axes, metres; counter-clockwise seen from outside. A group for each class ("terrain") and for each
    /// object ("aircraft-2": that of object id 2). Sky and clouds are left out.
    void export_scene(const std::string& path, const Camera& camera, const Pose& pose) const;

private:
    struct [[gnu::visibility("hidden")]] Impl;
    friend struct WorldAccess; ///< of the library itself
    [[gnu::visibility("hidden")]] World(std::shared_ptr<Impl> impl, std::nullptr_t);

    std::shared_ptr<Impl> impl_; ///< never null
};

} // namespace octant

#pragma GCC visibility pop
