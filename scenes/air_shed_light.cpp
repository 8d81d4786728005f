#include "scenes/air_shed_light.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/air_shed_lamps.h"
#include "scenes/air_shed_shell.h"
#include "scenes/noise.h"
#include "scenes/pattern_paint.h"
#include "scenes/shapes_surface.h"

namespace macula {
namespace {

using Size = AirShedSize;
constexpr float kTau = 2.0F * std::numbers::pi_v<float>;

constexpr glm::vec3 kSkyRadiance(1.35F, 1.55F, 1.75F);  // of the sky near the horizon, where windows look
constexpr glm::vec3 kGlazing(0.80F, 0.80F, 0.74F);      // what dirty panes leave of it
constexpr glm::vec3 kSkylightRadiance(1.55F, 1.52F, 1.28F);

/// Above this height, over its distance, the sky's picture ends. The sun stands higher, so that the picture, which is
/// opaque to shadow rays, does not hide it.
constexpr float kSkyTop = 1.05F;

/// Haze above the horizon, blue further up, two layers of cloud. `v` runs up from the horizon to kSkyTop.
glm::vec3 sky_color(const NoiseField& clouds, float u, float v) {
    const glm::vec3 haze(0.90F, 0.93F, 0.95F);
    const glm::vec3 blue(0.50F, 0.67F, 0.88F);
    const glm::vec3 clear = glm::mix(haze, blue, ramp(0.0F, 0.9F, v));
    const float far = 1.0F / (0.10F + v);  // clouds lie flat: further ones are closer together
    const float cover = 0.6F * clouds.at(u, 0.05F * far) + 0.4F * clouds.at(3.0F * u + 0.3F, 0.15F * far);
    const float cloud = ramp(0.46F, 0.72F, cover) * ramp(0.0F, 0.1F, v);
    const float shade = clouds.at(u + 0.01F, 0.05F * far + 0.02F);
    return glm::mix(clear, glm::mix(glm::vec3(1.0F), glm::vec3(0.74F, 0.77F, 0.82F), ramp(0.4F, 0.8F, shade)), cloud);
}

void build_sky(SceneBuilder& builder) {
    const NoiseField clouds(512, 8, 8, 6, 811);
    constexpr int kWidth = 1024;
    constexpr int kHeight = 256;
    TextureImage image = blank_image("sky", kWidth, kHeight, 3, true);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const glm::vec3 color = sky_color(clouds, (static_cast<float>(x) + 0.5F) / kWidth,
                                              1.0F - (static_cast<float>(y) + 0.5F) / kHeight);
            for (int c = 0; c < 3; ++c)
                image.texels[3 * static_cast<std::size_t>(y * kWidth + x) + static_cast<std::size_t>(c)] =
                    unit_byte(color[c]);
        }
    Material material;
    material.name = "sky";
    material.unlit = true;
    material.base_color = glm::vec4(1.75F, 1.8F, 1.85F, 1.0F);
    material.base_color_texture.image = builder.add_image(std::move(image));
    material.base_color_texture.wrap_v = TextureWrap::clamp_to_edge;
    constexpr float kFar = 850.0F;  // m
    Mesh dome = make_surface(96, 12, true, [](float u, float v) {
        const float a = kTau * u;
        return glm::vec3(kFar * std::cos(a), glm::mix(-10.0F, kSkyTop * kFar, v), kFar * std::sin(a));
    });
    builder.place_mesh("sky", builder.add_mesh(std::move(dome), builder.add_material(std::move(material))));
}

/// Radiance that comes from `direction` to a point in the middle of the shed: its walls at their distance, roughly.
glm::vec3 probe_radiance(const glm::vec3& direction) {
    const glm::vec3 from(0.0F, 2.5F, 0.0F);
    const glm::vec3 sheet(0.085F, 0.085F, 0.08F);
    const auto reach = [](float distance, float component) {
        return component > 1e-6F ? distance / component : std::numeric_limits<float>::infinity();
    };
    const float side = reach(Size::kHalfWidth, std::abs(direction.x));
    const float end = reach(Size::kHalfLength, std::abs(direction.z));
    const float floor = reach(from.y, -direction.y);
    // Roof: y = ridge - slope |x|.
    const float slope = (Size::kRidge - Size::kEaves) / Size::kHalfWidth;
    const float roof = reach(Size::kRidge - from.y, direction.y + slope * std::abs(direction.x));
    const float nearest = std::min(std::min(side, end), std::min(floor, roof));
    const glm::vec3 at = from + direction * nearest;
    if (nearest == floor) {
        const float patch = ramp(3.0F, 1.5F, std::abs(at.x + 12.5F));  // where the sun falls in
        return glm::mix(glm::vec3(0.105F, 0.10F, 0.092F), glm::vec3(0.42F, 0.38F, 0.31F), 0.5F * patch);
    }
    if (nearest == roof) {
        const bool light = std::abs(std::abs(at.x) - 9.0F) < 3.0F && cell(0.25F * (at.z + Size::kHalfLength)) < 0.25F;
        return light ? kSkylightRadiance : 0.7F * sheet;
    }
    if (nearest == end) {
        const bool open =
            at.z < 0.0F && at.y < Size::kDoorHeight && at.x > Size::kDoorGapLow && at.x < Size::kDoorGapHigh;
        const bool ground = at.y < 2.2F;
        return open ? (ground ? glm::vec3(0.62F, 0.60F, 0.50F) : kSkyRadiance) : sheet;
    }
    const bool high = at.y > Size::kClerestoryLow && at.y < Size::kClerestoryHigh;
    const bool low =
        at.y > 1.6F && at.y < 4.4F && cell(0.125F * (at.z + Size::kHalfLength) * (at.x < 0.0F ? -1.0F : 1.0F)) > 0.5F;
    return high || low ? kSkyRadiance * kGlazing * (low ? 0.7F : 0.85F) : sheet;
}

/// Lat-long picture of the probe, each texel the mean of 4 x 4 directions.
TextureImage make_probe() {
    constexpr int kWidth = 256;
    constexpr int kHeight = 128;
    constexpr int kGrid = 4;
    TextureImage image;
    image.name = "light in the shed";
    image.width_px = kWidth;
    image.height_px = kHeight;
    image.channels = 3;
    image.type = TexelType::f32;
    image.texels.resize(image.texel_count() * image.texel_bytes());
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            glm::vec3 sum(0.0F);
            for (int j = 0; j < kGrid; ++j)
                for (int i = 0; i < kGrid; ++i) {
                    // u = 0 lies at +Z, u = 1/4 at -X, v = 0 at +Y.
                    const float azimuth = kTau * (static_cast<float>(x * kGrid + i) + 0.5F) / (kWidth * kGrid);
                    const float polar = 0.5F * kTau * (static_cast<float>(y * kGrid + j) + 0.5F) / (kHeight * kGrid);
                    sum += probe_radiance(
                        {-std::sin(azimuth) * std::sin(polar), std::cos(polar), std::cos(azimuth) * std::sin(polar)});
                }
            sum /= static_cast<float>(kGrid * kGrid);
            std::memcpy(&image.texels[image.texel_bytes() * static_cast<std::size_t>(y * kWidth + x)], &sum,
                        sizeof(sum));
        }
    return image;
}

Light rectangle(const glm::vec3& centre, const glm::vec3& half_u, const glm::vec3& half_v, const glm::vec3& radiance) {
    Light light;
    light.kind = LightKind::rectangle;
    light.position_m = centre;
    light.half_u_m = half_u;
    light.half_v_m = half_v;
    light.direction = glm::normalize(glm::cross(half_u, half_v));
    light.intensity = radiance;
    return light;
}

}  // namespace

void build_light(SceneBuilder& builder) {
    build_sky(builder);
    Scene& scene = builder.scene();

    Light sun;
    sun.direction = glm::normalize(glm::vec3(0.62F, -0.92F, 0.42F));
    sun.intensity = glm::vec3(15.0F, 13.0F, 10.0F);
    scene.lights.push_back(sun);
    // Daylight: the openings shine inwards.
    const float gap = 0.5F * (Size::kDoorGapHigh - Size::kDoorGapLow);
    scene.lights.push_back(rectangle({Size::kDoorGapLow + gap, 0.5F * Size::kDoorHeight, -Size::kHalfLength + 0.1F},
                                     {gap, 0.0F, 0.0F}, {0.0F, 0.5F * Size::kDoorHeight, 0.0F}, 0.85F * kSkyRadiance));
    for (const glm::vec3& hook : AirShedLamps::kHighBays) {
        Light lamp;
        lamp.kind = LightKind::spot;
        lamp.position_m = hook - glm::vec3(0.0F, AirShedLamps::kHighBayDrop + 0.1F, 0.0F);
        lamp.direction = glm::vec3(0.0F, -1.0F, 0.0F);
        lamp.intensity = glm::vec3(11.0F, 7.6F, 4.2F);
        lamp.range_m = 16.0F;
        lamp.spot_cos_inner = 0.80F;
        lamp.spot_cos_outer = 0.25F;
        lamp.casts_shadow = hook.x > 0.0F && hook.z > 0.0F && hook.z < 16.0F;
        scene.lights.push_back(lamp);
    }
    scene.environment.intensity = 1.5F;  // the walls' further reflections
    scene.environment.image = builder.add_image(make_probe());
}

}  // namespace macula
