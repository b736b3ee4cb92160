#include "tests/evidence/library/tiny_picture.h"

#include <cstddef>

#include "TinyRenderer.h"

struct TinyPicture::Buffers {
    TGAImage frame;
    b3AlignedObjectArray<float> depth;
    b3AlignedObjectArray<int> mask;
    TinyRenderObjectData object;

    Buffers(int width, int height) : frame(width, height, TGAImage::RGB), object(frame, depth, &mask, 1) {
        depth.resize(width * height);
        mask.resize(width * height);
    }
};

TinyPicture::TinyPicture(const std::vector<float>& corners, const std::vector<float>& normals, const TinyCamera& camera)
    : buffers_(std::make_shared<Buffers>(camera.width, camera.height)) {
    std::vector<float> vertices;
    std::vector<int> indices;
    for (std::size_t i = 0; i < corners.size() / 3; ++i) {
        indices.push_back(static_cast<int>(i));
        const float* const corner = &corners[3 * i];
        const float* const normal = &normals[i / 3 * 3];
        for (const float value : {corner[0], corner[1], corner[2], 1.0F, normal[0], normal[1], normal[2], 0.5F, 0.5F}) {
            vertices.push_back(value);
        }
    }
    const int count = static_cast<int>(indices.size());
    const float colour[4] = {1.0F, 1.0F, 1.0F, 1.0F};
    unsigned char texel[3] = {200, 180, 160};
    TinyRenderObjectData& object = buffers_->object;
    object.registerMeshShape(vertices.data(), count, indices.data(), count, colour, texel, 1, 1);
    object.m_viewMatrix = TinyRender::Matrix::identity();
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t column = 0; column < 3; ++column) {
            object.m_viewMatrix[row][column] = static_cast<float>(camera.axes[row][column]);
        }
    }
    const double near_m = 0.5;
    const double far_m = 100000.0;
    TinyRender::Matrix projection = TinyRender::Matrix::identity();
    projection[0][0] = static_cast<float>(2.0 * camera.focal_px / camera.width);
    projection[1][1] = static_cast<float>(2.0 * camera.focal_px / camera.height);
    projection[2][2] = static_cast<float>(-(far_m + near_m) / (far_m - near_m));
    projection[2][3] = static_cast<float>(-2.0 * far_m * near_m / (far_m - near_m));
    projection[3][2] = -1.0F;
    projection[3][3] = 0.0F;
    object.m_projectionMatrix = projection;
    object.m_lightDirWorld.setValue(0.3F, 0.4F, 0.8F);
    object.m_lightDistance = 10.0F;
}

void TinyPicture::draw() const {
    buffers_->frame.clear();
    for (int i = 0; i < buffers_->depth.size(); ++i) {
        buffers_->depth[i] = -1e30F;
        buffers_->mask[i] = -1;
    }
    TinyRenderer::renderObject(buffers_->object);
}

double TinyPicture::filled() const {
    double count = 0.0;
    for (int i = 0; i < buffers_->mask.size(); ++i) { count += buffers_->mask[i] >= 0 ? 1.0 : 0.0; }
    return count / buffers_->mask.size();
}
