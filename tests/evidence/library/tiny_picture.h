#pragma once

#include <memory>
#include <vector>

// In the C++ of TinyRenderer's headers, which are not C++20.

struct TinyCamera {
    int width;
    int height;
    double focal_px;
    double axes[3][3]; ///< right, up, back; world axes
};

/// A picture of TinyRenderer: colour, depth and mask of one object that has all triangles, without shadows.
class TinyPicture {
public:
    /// 9 numbers of corners and 3 of a normal for each triangle; the eye is at 0, 0, 0.
    TinyPicture(const std::vector<float>& corners, const std::vector<float>& normals, const TinyCamera& camera);

    void draw() const;

    /// The share of pixels that show something.
    double filled() const;

private:
    struct Buffers;
    std::shared_ptr<Buffers> buffers_;
};
