// Rays of pixels, against the formulas of CONVENTIONS.md.

#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>

#include "server/kernels/camera.h"

namespace macula {
namespace {

const glm::vec4 kEdges(-1.397283F, 1.250510F, -1.477517F, 1.464221F);  // the Vive's left eye
const glm::vec2 kSize(1512.0F, 1680.0F);

TEST(CameraKernel, ImageCornersHaveTheTangentsOfTheEdges) {
    const glm::vec2 top_left = kernels::tangents_of_pixel(kEdges, kSize, glm::vec2(0.0F));
    EXPECT_FLOAT_EQ(top_left.x, kEdges.x);
    EXPECT_FLOAT_EQ(top_left.y, kEdges.w);
    const glm::vec2 bottom_right = kernels::tangents_of_pixel(kEdges, kSize, kSize);
    EXPECT_FLOAT_EQ(bottom_right.x, kEdges.y);
    EXPECT_FLOAT_EQ(bottom_right.y, kEdges.z);
}

TEST(CameraKernel, PixelCentresFollowTheConvention) {
    for (const int x : {0, 1, 700, 1511}) {
        for (const int y : {0, 3, 840, 1679}) {
            const glm::vec2 t = kernels::tangents_of_pixel(kEdges, kSize, glm::vec2(x, y) + 0.5F);
            EXPECT_NEAR(t.x, -1.397283 + (x + 0.5) / 1512.0 * (1.250510 + 1.397283), 1e-6);
            EXPECT_NEAR(t.y, 1.464221 - (y + 0.5) / 1680.0 * (1.464221 + 1.477517), 1e-6);
        }
    }
}

TEST(CameraKernel, DirectionHasLengthOneAlongTheEyesAxis) {
    const glm::quat orientation = glm::normalize(glm::quat(0.8F, 0.1F, -0.5F, 0.3F));
    const glm::mat3 world_from_eye = glm::mat3_cast(orientation);
    const glm::vec3 forward = orientation * glm::vec3(0.0F, 0.0F, -1.0F);
    const glm::vec3 right = orientation * glm::vec3(1.0F, 0.0F, 0.0F);
    const glm::vec3 up = orientation * glm::vec3(0.0F, 1.0F, 0.0F);
    const glm::vec2 position(100.5F, 1400.5F);
    const glm::vec2 tangents = kernels::tangents_of_pixel(kEdges, kSize, position);
    const glm::vec3 direction = kernels::eye_ray_direction(world_from_eye, kEdges, kSize, position);
    EXPECT_NEAR(glm::dot(direction, forward), 1.0F, 1e-6F);
    EXPECT_NEAR(glm::dot(direction, right), tangents.x, 1e-6F);
    EXPECT_NEAR(glm::dot(direction, up), tangents.y, 1e-6F);
}

}  // namespace
}  // namespace macula
