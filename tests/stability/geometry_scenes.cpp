#include "tests/stability/geometry_scenes.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/image_file.h"
#include "tests/support/encoded_image.h"
#include "tests/support/slow_trace.h"

namespace macula::test {
namespace {

using glm::dvec3;
using glm::vec3;

/// sRGB code of a radiance of one half.
constexpr int kHalf = 188;

const dvec3 kFarAway(10000.0, -300.0, 4000.0);

/// Begins the session with the left eye at a place, the head upright and turned about +Y.
void look_from(Scene& scene, const Display& display, const vec3& eye_m, float yaw_rad = 0.0F) {
    const Pose world_from_eye{glm::angleAxis(yaw_rad, vec3(0.0F, 1.0F, 0.0F)), eye_m};
    scene.world_from_start = world_from_eye * display.eyes[kLeftEye].head_from_eye.inverse();
}

Material two_sided_matte() {
    Material material = matte();
    material.double_sided = true;
    return material;
}

glm::mat4 tilted(const vec3& at, float angle_rad) {
    return glm::rotate(glm::translate(glm::mat4(1.0F), at), angle_rad, glm::normalize(vec3(0.6F, 0.64F, 0.48F)));
}

/// A closed box of `half` edges around `place`, with suns and lamps outside.
Scene dark_room(float half, const vec3& place, const Display& display) {
    Scene scene;
    for (const vec3 direction : {vec3(0.3F, -1.0F, -0.2F), vec3(-1.0F, 0.02F, 0.01F), vec3(0.6F, 0.5F, 0.6F)}) {
        const vec3 along = glm::normalize(direction);
        Light lamp{.kind = LightKind::point, .position_m = place - along * (1.75F * half)};
        lamp.intensity = vec3(half * half * 3.0F);
        scene.lights.push_back({.direction = along});
        scene.lights.push_back(lamp);
    }
    add(scene, make_box(vec3(2.0F * half)), two_sided_matte(),
        tilted(place, 0.4F) * glm::translate(glm::mat4(1.0F), vec3(0.0F, -half, 0.0F)));
    look_from(scene, display, place + vec3(0.1F, 0.3F, -0.2F) * half);
    return scene;
}

/// The same light from everywhere, half as bright as the display can be.
Scene even_light() {
    Scene scene;
    scene.ambient_radiance = scene.background_radiance = vec3(1.0F);
    scene.exposure = 0.5F;
    return scene;
}

/// A white ball of which nothing can be seen.
Scene white_ball(float radius, const vec3& place, int segments, const Display& display) {
    Scene scene = even_light();
    add(scene, make_sphere(radius, segments), two_sided_matte(), glm::translate(glm::mat4(1.0F), place));
    look_from(scene, display, place + vec3(0.0F, 0.0F, 1.6F * radius));
    return scene;
}

/// Mirrors: what meets itself sees no sky, and is black.
Scene mirror_world(Mesh mesh, const glm::mat4& place, const vec3& eye_m, const Display& display) {
    Scene scene = even_light();
    scene.ambient_radiance = vec3(0.0F);
    Material mirror;
    mirror.roughness = 0.0F;
    add(scene, std::move(mesh), mirror, place);
    look_from(scene, display, eye_m);
    return scene;
}

/// A plane under a sun that makes it as bright as the sky behind it.
Scene lit_plane(float half, float tilt_rad, float elevation_deg, float height_m, const Display& display) {
    Scene scene = even_light();
    scene.ambient_radiance = vec3(0.0F);
    const glm::mat4 tilt = tilted(vec3(0.0F), tilt_rad);
    const float elevation = elevation_deg * std::numbers::pi_v<float> / 180.0F;
    Light sun;
    sun.direction = glm::mat3(tilt) * vec3(std::cos(elevation), -std::sin(elevation), 0.0F);
    sun.intensity = vec3(std::numbers::pi_v<float> / std::sin(elevation));
    scene.lights.push_back(sun);
    add(scene, make_quad({-half, 0.0F, -half}, {2.0F * half, 0.0F, 0.0F}, {0.0F, 0.0F, 2.0F * half}), matte(), tilt);
    look_from(scene, display, glm::mat3(tilt) * vec3(0.0F, height_m, 0.0F));
    return scene;
}

/// Moves a mesh's corners. Each is rounded to floats once.
Mesh placed(Mesh mesh, const glm::dmat4& turn, double scale, const dvec3& place) {
    for (vec3& p : mesh.position_m) p = vec3(place + scale * dvec3(turn * glm::dvec4(dvec3(p), 1.0)));
    for (vec3& n : mesh.normal) n = vec3(glm::dmat3(turn) * dvec3(n));
    return mesh;
}

glm::dmat4 turned(const dvec3& at, double angle_rad, const dvec3& axis) {
    return glm::rotate(glm::translate(glm::dmat4(1.0), at), angle_rad, glm::normalize(axis));
}

/// Blocks on a floor between walls, all within a cube of edge `scale` around `place`, under a sun and a lamp of
/// `power` times the light that suits the exposure 1.
Scene blocks(double scale, const dvec3& place, const Display& display, float power = 1.0F) {
    Scene scene;
    scene.exposure = 1.0F / power;
    scene.background_radiance = vec3(0.2F * power);
    Light sun{.direction = glm::normalize(vec3(0.45F, -0.8F, -0.4F)), .intensity = vec3(2.0F * power)};
    Light lamp{.kind = LightKind::point, .position_m = vec3(place + dvec3(-0.1, 0.35, 0.3) * scale)};
    lamp.intensity = vec3(static_cast<float>(0.4 * scale * scale) * power);
    scene.lights = {sun, lamp};
    const auto add_part = [&](const Mesh& mesh, const glm::dmat4& turn) {
        add(scene, placed(mesh, turn, scale, place), two_sided_matte());
    };
    const glm::dmat4 still(1.0);
    add_part(make_quad({-0.49F, -0.3F, -0.49F}, {0.98F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.98F}), still);
    add_part(make_quad({-0.49F, 0.45F, -0.48F}, {0.98F, 0.0F, 0.0F}, {0.0F, -0.7F, -0.01F}), still);
    add_part(make_box({0.2F, 0.3F, 0.2F}), turned({-0.2, -0.3, 0.0}, 0.6, {0, 1, 0}));
    add_part(make_box({0.15F, 0.15F, 0.15F}), turned({0.2, -0.2, 0.1}, 0.9, {0.4, 0.3, 0.8}));
    add_part(make_box({0.1F, 0.5F, 0.02F}), turned({0.1, -0.25, -0.25}, -0.4, {0.1, 0.9, 0.3}));
    look_from(scene, display, vec3(place + dvec3(0.0, 0.1, 0.45) * scale));
    return scene;
}

Mesh needles(unsigned count, double width_m) {
    const dvec3 along(std::cos(0.3), std::sin(0.3), 0.0);
    const dvec3 across(-along.y, along.x, 0.0);
    Mesh mesh;
    for (unsigned i = 0; i <= count; ++i)
        for (const double end : {-4.0, 4.0})
            mesh.position_m.emplace_back(along * end + across * (width_m * (i - 0.5 * count)));
    mesh.normal.assign(mesh.position_m.size(), vec3(0.0F, 0.0F, 1.0F));
    for (unsigned i = 0; i < count; ++i) {
        mesh.triangle.emplace_back(2 * i, 2 * i + 1, 2 * i + 2);
        mesh.triangle.emplace_back(2 * i + 1, 2 * i + 3, 2 * i + 2);
    }
    return mesh;
}

/// The same place as needles() make up.
Mesh whole_wall(unsigned count, double width_m) {
    return needles(1, width_m * count);
}

/// A wall, a ball before it that casts a shadow, a sun.
Scene before_wall(std::vector<Mesh> walls, const Display& display) {
    Scene scene;
    scene.background_radiance = vec3(0.1F);
    scene.ambient_radiance = vec3(0.05F);
    scene.lights.push_back({.direction = glm::normalize(vec3(0.3F, -0.5F, -0.8F)), .intensity = vec3(2.5F)});
    for (Mesh& wall : walls) add(scene, std::move(wall), two_sided_matte(), tilted({0.0F, 0.0F, -2.0F}, 0.4F));
    add(scene, make_sphere(0.3F), matte(), glm::translate(glm::mat4(1.0F), vec3(-0.2F, 0.2F, -1.2F)));
    look_from(scene, display, vec3(0.0F));
    return scene;
}

/// Points, lines there and back, and lines with a corner within, all over the view.
Mesh without_area() {
    Mesh mesh;
    for (int i = 0; i < 200; ++i) {
        const vec3 a(std::sin(1.7F * static_cast<float>(i)), std::cos(2.3F * static_cast<float>(i)), 0.5F);
        const vec3 b = a + vec3(0.4F, 0.3F, 0.1F);
        for (const auto& corners : {std::array{a, a, a}, std::array{a, b, a}, std::array{a, b, a + (b - a) * 0.5F}}) {
            const auto first = static_cast<unsigned>(mesh.position_m.size());
            mesh.position_m.insert(mesh.position_m.end(), corners.begin(), corners.end());
            mesh.triangle.emplace_back(first, first + 1, first + 2);
        }
    }
    mesh.normal.assign(mesh.position_m.size(), vec3(0.0F, 0.0F, 1.0F));
    return mesh;
}

/// Two mirrors 2 m apart with a ball and blocks between them.
Scene mirror_corridor(const Display& display) {
    Scene scene = before_wall({make_quad({-4.0F, 4.0F, 0.0F}, {8.0F, 0.0F, 0.0F}, {0.0F, -8.0F, 0.0F})}, display);
    Material mirror;
    mirror.roughness = 0.0F;
    mirror.double_sided = true;
    for (const float x : {-1.0F, 1.0F})
        add(scene, make_quad({x, 2.0F, -3.0F}, {0.0F, 0.0F, 6.0F}, {0.0F, -4.0F, 0.0F}), mirror);
    add(scene, make_box({0.3F, 0.5F, 0.3F}), matte(), glm::translate(glm::mat4(1.0F), vec3(0.4F, -0.8F, -1.5F)));
    return scene;
}

/// Balls of glass within each other, the inner ones denser, before a wall.
Scene glass_in_glass(const Display& display) {
    Scene scene = before_wall({whole_wall(1, 4.0)}, display);
    float ior = 1.3F;
    for (const float radius : {0.5F, 0.35F, 0.2F}) {
        Material glass = white();
        glass.roughness = 0.0F;
        glass.transmission = 1.0F;
        glass.thickness_m = radius;
        glass.ior = ior;
        ior += 0.3F;
        add(scene, make_sphere(radius), glass, glm::translate(glm::mat4(1.0F), vec3(0.3F, -0.1F, -1.1F)));
    }
    return scene;
}

/// A lamp of 2 mm, a million times as bright as the display can be, over balls of glossy metal.
Scene lamp_over_gloss(const Display& display) {
    Scene scene;
    scene.background_radiance = vec3(0.1F);
    Light lamp{.kind = LightKind::rectangle, .position_m = {0.0F, 0.4F, -1.5F}, .direction = {0.0F, -1.0F, 0.0F}};
    lamp.intensity = vec3(1e6F);
    lamp.half_u_m = {1e-3F, 0.0F, 0.0F};
    lamp.half_v_m = {0.0F, 0.0F, 1e-3F};
    scene.lights.push_back(lamp);
    Material gloss = white();
    gloss.metallic = 1.0F;
    gloss.roughness = 0.1F;
    for (int i = 0; i < 24; ++i)
        add(scene, make_sphere(0.15F, 32), gloss,
            glm::translate(glm::mat4(1.0F), vec3(static_cast<float>(i % 6) * 0.35F - 0.9F, -0.6F,
                                                 static_cast<float>(i / 6) * -0.4F - 0.8F)));
    look_from(scene, display, vec3(0.0F));
    return scene;
}

/// Balls under a grey sky read from a file that holds NaN, infinities and negative light beside it.
Scene sky_with_no_numbers(const Display& display) {
    constexpr int kWidth_px = 64;
    constexpr int kHeight_px = 32;
    std::vector<float> sky(std::size_t{3} * kWidth_px * kHeight_px, 0.5F);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const std::array<float, 5> odd = {std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity, -3.0F, 1e30F};
    for (std::size_t i = 0; i < odd.size(); ++i) sky[3 * (std::size_t{kWidth_px} * (8 + 3 * i) + 11 * i + 4)] = odd[i];
    Scene scene;
    scene.images.push_back(
        decode_environment(encode_radiance("openexr", kWidth_px, kHeight_px, 3, sky, false), 64, 4096).value());
    scene.environment.image = 0;
    Material mirror;
    mirror.roughness = 0.0F;
    Material rough = white();
    rough.roughness = 0.4F;
    add(scene, make_sphere(0.4F), mirror, glm::translate(glm::mat4(1.0F), vec3(-0.5F, 0.0F, -1.0F)));
    add(scene, make_sphere(0.4F), rough, glm::translate(glm::mat4(1.0F), vec3(0.5F, 0.0F, -1.0F)));
    add(scene, make_quad({-4.0F, -0.5F, -4.0F}, {8.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 8.0F}), matte());
    look_from(scene, display, vec3(0.0F));
    return scene;
}

}  // namespace

std::vector<PlainCase> plain_cases(const Display& display) {
    std::vector<PlainCase> cases;
    cases.push_back({"dark-room/1mm", dark_room(5e-4F, vec3(0.0F), display), 0});
    cases.push_back({"dark-room/4m", dark_room(2.0F, vec3(0.0F), display), 0});
    cases.push_back({"dark-room/100km", dark_room(5e4F, vec3(0.0F), display), 0});
    cases.push_back({"dark-room/10km-away", dark_room(2.0F, vec3(kFarAway), display), 0, true});
    cases.push_back({"white-ball/2mm", white_ball(1e-3F, vec3(0.0F), 32, display), kHalf});
    cases.push_back({"white-ball/20km", white_ball(1e4F, vec3(0.0F), 8, display), kHalf});
    cases.push_back({"white-ball/10km-away", white_ball(1.0F, vec3(kFarAway), 128, display), kHalf});
    const vec3 before(0.0F, 0.0F, 1.8F);
    cases.push_back(
        {"mirror-ball/2mm", mirror_world(make_sphere(1e-3F, 64), glm::mat4(1.0F), before * 1e-3F, display), kHalf});
    cases.push_back(
        {"mirror-ball/20km", mirror_world(make_sphere(1e4F, 16), glm::mat4(1.0F), before * 1e4F, display), kHalf});
    const vec3 place(kFarAway);
    const Mesh plane = make_quad({-20.0F, 0.0F, -20.0F}, {40.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 40.0F});
    cases.push_back({"mirror-plane/10km-away",
                     mirror_world(plane, tilted(place, 0.4F), place + vec3(0.0F, 1.0F, 0.0F), display), kHalf});
    cases.push_back({"plane/100km-tilted", lit_plane(5e4F, 0.3F, 50.0F, 1.7F, display), kHalf});
    cases.push_back({"plane/sun-at-1-degree", lit_plane(1e3F, 0.0F, 1.0F, 1.7F, display), kHalf});
    cases.push_back({"plane/sun-at-a-tenth-of-a-degree", lit_plane(1e3F, 0.02F, 0.1F, 1.7F, display), kHalf});
    return cases;
}

std::vector<HardCase> hard_cases(const Display& display) {
    std::vector<HardCase> cases;
    const Scene metre = blocks(1.0, dvec3(0.0), display);
    cases.push_back({"blocks/1mm", blocks(1e-3, dvec3(0.0), display), metre});
    cases.push_back({"blocks/100km", blocks(1e5, dvec3(0.0), display), metre});
    cases.push_back({"blocks/10km-away", blocks(1.0, kFarAway, display), metre, true});
    cases.push_back({"blocks/light-times-1e15", blocks(1.0, dvec3(0.0), display, 1e15F), metre});
    cases.push_back({"blocks/light-times-1e-15", blocks(1.0, dvec3(0.0), display, 1e-15F), metre});
    constexpr unsigned kNeedles = 4000;
    constexpr double kNeedle_m = 1e-3;
    const Mesh wall = whole_wall(kNeedles, kNeedle_m);
    const Scene plain = before_wall({wall}, display);
    cases.push_back({"wall/needles", before_wall({needles(kNeedles, kNeedle_m)}, display), plain});
    cases.push_back({"wall/no-area", before_wall({wall, without_area()}, display), plain});
    Mesh other_diagonal = wall;
    other_diagonal.triangle = {{0, 1, 3}, {0, 3, 2}};
    cases.push_back({"wall/coplanar", before_wall({wall, wall, other_diagonal}, display), plain});
    cases.push_back({"mirrors-face-to-face", mirror_corridor(display), std::nullopt});
    cases.push_back({"glass-in-glass", glass_in_glass(display), std::nullopt});
    cases.push_back({"tiny-lamp-over-gloss", lamp_over_gloss(display), std::nullopt});
    cases.push_back({"sky-with-no-numbers", sky_with_no_numbers(display), std::nullopt});
    return cases;
}

}  // namespace macula::test
