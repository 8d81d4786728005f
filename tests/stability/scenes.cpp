#include "tests/stability/scenes.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "scenes/pattern.h"
#include "scenes/scene_builder.h"
#include "scenes/shapes.h"
#include "tests/support/bumps.h"

namespace macula::test {
namespace {

/// Of `vive`, at the centre.
constexpr float kPxPerTangent = 571.0F;

/// A scene in the making, for a display whose pixels are `px_width` times as wide as those of `vive`.
class Maker : public SceneBuilder {
public:
    explicit Maker(float px_width) : px_width_(px_width) {}

    /// Width of a pixel at a distance.
    [[nodiscard]] float px_m(float distance_m) const { return px_width_ * distance_m / kPxPerTangent; }

    void object(Mesh shape, int material, const glm::mat4& world_from_mesh = glm::mat4(1.0F)) {
        place_mesh("", add_mesh(std::move(shape), material), world_from_mesh);
    }
    void moving(Mesh shape, int material, int node) {
        object(std::move(shape), material);
        scene().instances.back().node = node;
    }

    /// White times the texture, repeated along u and v.
    int textured(TextureImage image, float repeats, float roughness = 0.9F) {
        const int material = plain(image.name, 0xFFFFFF, roughness);
        TextureUse& use = scene().materials.back().base_color_texture;
        use.uv_scale_rotation = glm::vec4(repeats, 0.0F, 0.0F, repeats);
        use.image = add_image(std::move(image));
        return material;
    }
    /// Checks with edges of about `edge_px` at `distance_m` on a square surface with edges of `size_m`.
    int checks(float size_m, float distance_m, float edge_px) {
        const float cells = size_m / (px_m(distance_m) * edge_px);
        return textured(make_checkerboard(256, 16, {}), std::max(1.0F, std::round(cells / 16.0F)));
    }
    /// Noise with features of 24 pixels at `distance_m` and of halves of it down to some, on such a surface.
    int mottled(float size_m, float distance_m, std::uint32_t dark, std::uint32_t light) {
        const float cells = size_m / (px_m(distance_m) * 24.0F);
        return textured(make_noise(512, 8, {srgb(dark), srgb(light)}), std::max(1.0F, std::round(cells / 8.0F)));
    }

    void daylight() {
        Light sun;
        sun.direction = glm::normalize(glm::vec3(0.4F, -1.0F, -0.7F));
        sun.intensity = glm::vec3(1.8F);
        scene().lights.push_back(sun);
        scene().ambient_radiance = glm::vec3(0.25F);
        scene().background_radiance = glm::vec3(0.35F, 0.55F, 0.8F);
    }

private:
    float px_width_;
};

/// Square of 2 `half_m` edges that faces +Z.
Mesh wall(const glm::vec3& centre, float half_m) {
    return make_quad(centre + glm::vec3(-half_m, half_m, 0.0F), {2.0F * half_m, 0.0F, 0.0F},
                     {0.0F, -2.0F * half_m, 0.0F});
}

/// Cylinder from `a` to `b`.
void add_wire(Maker& maker, int material, const glm::vec3& a, const glm::vec3& b, float radius_m) {
    const glm::vec3 up = glm::normalize(b - a);
    const glm::vec3 side = glm::normalize(glm::cross(up, glm::vec3(0.0F, 0.0F, 1.0F)));
    const glm::mat4 place(glm::vec4(side, 0.0F), glm::vec4(up, 0.0F), glm::vec4(glm::cross(side, up), 0.0F),
                          glm::vec4(a, 1.0F));
    maker.object(make_cylinder(radius_m, radius_m, glm::length(b - a), 8), material, place);
}

void make_wires(Maker& maker) {
    constexpr float kDistance_m = 2.0F;
    constexpr std::array<float, 5> kWidth_px = {0.3F, 0.45F, 0.6F, 0.8F, 1.0F};
    maker.scene().background_radiance = glm::vec3(0.45F, 0.6F, 0.8F);
    const int dark = maker.plain("wire", 0x101014);
    maker.scene().materials.back().unlit = true;
    const auto radius_m = [&](int i) {
        return 0.5F * kWidth_px.at(static_cast<std::size_t>(i) % kWidth_px.size()) * maker.px_m(kDistance_m);
    };
    for (int i = 0; i < 25; ++i) {
        const float x = -2.6F + 0.22F * static_cast<float>(i);
        const float lean = i % 3 == 0 ? 0.0F : 0.25F * static_cast<float>(i % 5 - 2);
        add_wire(maker, dark, {x - lean, -0.5F, -kDistance_m}, {x + lean, 3.0F, -kDistance_m}, radius_m(i));
    }
    for (int i = 0; i < 15; ++i) {
        const float y = -0.7F - 0.16F * static_cast<float>(i);
        const float fall = 0.08F * static_cast<float>(i % 4);
        add_wire(maker, dark, {-3.0F, y + fall, -kDistance_m}, {3.0F, y - fall, -kDistance_m}, radius_m(i));
    }
}

void make_patterns(Maker& maker) {
    constexpr float kDistance_m = 3.0F;
    constexpr float kHalf_m = 2.0F;
    maker.daylight();
    maker.object(wall({-2.0F, 1.0F, -kDistance_m}, kHalf_m), maker.checks(2.0F * kHalf_m, kDistance_m, 5.0F));
    // The finest rings, at the edges, have .4 cycles a pixel.
    const float edge_px = 2.0F * kHalf_m / maker.px_m(kDistance_m);
    maker.object(wall({2.0F, 1.0F, -kDistance_m}, kHalf_m),
                 maker.textured(make_zone_plate(1024, 0.4F * edge_px / 1024.0F), 1.0F));
    maker.object(make_quad({-12.0F, -1.0F, -24.0F}, {24.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 24.0F}),
                 maker.checks(24.0F, 3.0F, 16.0F));
}

void make_gloss(Maker& maker) {
    constexpr float kDistance_m = 3.0F;
    constexpr float kHalf_m = 4.5F;
    Material metal;
    metal.base_color = glm::vec4(0.9F, 0.75F, 0.55F, 1.0F);
    metal.roughness = 0.2F;
    metal.normal_texture.image = maker.add_image(bumps(256, 32, 4.0F));
    // A bump is some 6 pixels wide.
    const float cells = 2.0F * kHalf_m / (6.0F * maker.px_m(kDistance_m));
    const float repeats = std::max(1.0F, std::round(cells / 32.0F));
    metal.normal_texture.uv_scale_rotation = glm::vec4(repeats, 0.0F, 0.0F, repeats);
    const int material = maker.add_material(metal);
    maker.object(wall({0.0F, 0.0F, -kDistance_m}, kHalf_m), material);
    maker.object(make_sphere(0.5F), material, glm::translate(glm::mat4(1.0F), glm::vec3(0.6F, -0.2F, -1.6F)));
    for (const glm::vec3& at :
         {glm::vec3(-2.0F, 2.0F, -1.2F), glm::vec3(2.0F, 1.5F, -1.0F), glm::vec3(0.0F, -2.0F, -1.0F)}) {
        Light lamp;
        lamp.kind = LightKind::point;
        lamp.position_m = at;
        lamp.intensity = glm::vec3(5.0F);
        lamp.casts_shadow = false;
        maker.scene().lights.push_back(lamp);
    }
    maker.scene().ambient_radiance = glm::vec3(0.15F);
    maker.scene().background_radiance = glm::vec3(0.2F, 0.25F, 0.3F);
}

void make_mirror(Maker& maker) {
    constexpr float kDistance_m = 2.2F;
    maker.daylight();
    maker.scene().lights[0].casts_shadow = false;
    maker.object(wall({0.0F, 0.0F, -kDistance_m - 0.02F}, 4.0F), maker.plain("paint", 0xB8B4A8));
    maker.object(make_quad({-2.0F, 1.7F, -kDistance_m}, {4.0F, 0.0F, 0.0F}, {0.0F, -3.4F, 0.0F}),
                 maker.plain("silver", 0xF3F5F4, 0.0F, 1.0F));
    maker.scene().ambient_radiance = glm::vec3(0.8F);
    // Behind the viewer, so that it is seen by its image only, 7.4 m away.
    const glm::mat4 turned = glm::rotate(glm::mat4(1.0F), std::numbers::pi_v<float>, glm::vec3(0.0F, 1.0F, 0.0F));
    maker.object(wall({0.0F, 0.0F, -3.0F}, 8.0F), maker.mottled(16.0F, 7.4F, 0x403028, 0xF0E8D8), turned);
    const int red = maker.plain("red", 0xC04030);
    for (const float x : {-1.6F, -0.7F, 0.8F, 1.7F})
        maker.object(make_cylinder(0.06F, 0.06F, 4.0F, 24), red,
                     glm::translate(glm::mat4(1.0F), glm::vec3(x, -2.0F, 1.0F)));
}

void make_glass(Maker& maker) {
    maker.daylight();
    maker.scene().lights[0].casts_shadow = false;
    maker.object(wall({0.0F, 0.0F, -4.0F}, 5.0F), maker.mottled(10.0F, 4.0F, 0x305040, 0xF0F0E0));
    Material sheet;
    sheet.metallic = 0.0F;
    sheet.roughness = 0.0F;
    sheet.transmission = 1.0F;
    sheet.base_color = linear(0xC8E0C8);
    sheet.double_sided = true;
    maker.object(make_quad({-1.3F, 0.9F, -1.8F}, {1.2F, 0.0F, -0.3F}, {0.0F, -1.6F, 0.0F}), maker.add_material(sheet));
    Material block;
    block.metallic = 0.0F;
    block.roughness = 0.0F;
    block.transmission = 1.0F;
    block.thickness_m = 0.4F;
    block.attenuation_distance_m = 0.8F;
    block.attenuation_color = glm::vec3(0.6F, 0.85F, 0.95F);
    maker.object(
        make_box({0.7F, 1.1F, 0.4F}), maker.add_material(block),
        glm::rotate(glm::translate(glm::mat4(1.0F), glm::vec3(0.7F, -0.6F, -1.9F)), 0.5F, glm::vec3(0.0F, 1.0F, 0.0F)));
}

/// A channel that runs through its keys at even times and begins again.
AnimationChannel channel(int node, AnimationPath path, float period_s, std::vector<glm::vec4> values) {
    AnimationChannel made;
    made.node = node;
    made.path = path;
    made.period_s = period_s;
    for (std::size_t i = 0; i < values.size(); ++i)
        made.time_s.push_back(period_s * static_cast<float>(i) / static_cast<float>(values.size() - 1));
    made.value = std::move(values);
    return made;
}

void make_moving(Maker& maker) {
    maker.daylight();
    maker.scene().lights[0].casts_shadow = false;
    maker.object(wall({0.0F, 0.0F, -4.0F}, 6.0F), maker.mottled(12.0F, 4.0F, 0x404858, 0xE8E0D0));
    Animation& animation = maker.scene().animation;
    animation.nodes.resize(3);
    animation.duration_s = 4.0F;
    // A ball to and fro at a mean of 1 m/s, its speed that of a cosine.
    std::vector<glm::vec4> swing;
    for (int i = 0; i <= 64; ++i)
        swing.emplace_back(std::cos(static_cast<float>(i) / 32.0F * std::numbers::pi_v<float>), 0.5F, -2.5F, 0.0F);
    animation.channels.push_back(channel(0, AnimationPath::translation, 4.0F, std::move(swing)));
    maker.moving(make_sphere(0.4F), maker.checks(2.5F, 2.5F, 6.0F), 0);
    // A box that turns by 90 degrees a second.
    animation.nodes[1].translation_m = {-0.8F, -1.0F, -2.0F};
    std::vector<glm::vec4> turn;
    for (int i = 0; i <= 4; ++i) {
        const float half = static_cast<float>(i) * 0.25F * std::numbers::pi_v<float>;
        turn.emplace_back(0.0F, std::sin(half), 0.0F, std::cos(half));
    }
    animation.channels.push_back(channel(1, AnimationPath::rotation, 4.0F, std::move(turn)));
    maker.moving(make_box({0.6F, 0.6F, 0.6F}), maker.checks(0.6F, 2.0F, 8.0F), 1);
    // A bar that crosses the picture at 1.5 m/s.
    animation.channels.push_back(
        channel(2, AnimationPath::translation, 4.0F, {{-3.0F, -0.2F, -2.8F, 0.0F}, {3.0F, -0.2F, -2.8F, 0.0F}}));
    maker.moving(make_box({0.08F, 1.6F, 0.08F}), maker.plain("bar", 0xE0C030), 2);
}

void make_posts(Maker& maker) {
    maker.daylight();
    maker.scene().lights[0].casts_shadow = false;
    maker.object(wall({0.0F, 0.0F, -5.0F}, 7.5F), maker.mottled(15.0F, 5.0F, 0x503820, 0xF4ECD8));
    const int post = maker.mottled(1.0F, 0.9F, 0x203040, 0x8098B0);
    for (int i = 0; i < 7; ++i)
        maker.object(make_box({0.07F, 1.6F, 0.07F}), post,
                     glm::translate(glm::mat4(1.0F), glm::vec3(-0.9F + 0.3F * static_cast<float>(i), -0.8F, -0.9F)));
    maker.object(make_sphere(0.16F), maker.plain("ball", 0xC03828, 0.5F),
                 glm::translate(glm::mat4(1.0F), glm::vec3(0.1F, 0.15F, -0.7F)));
}

using Make = void (*)(Maker&);
const std::map<std::string, Make>& makes() {
    static const std::map<std::string, Make> all = {
        {"wires", make_wires}, {"patterns", make_patterns}, {"gloss", make_gloss}, {"mirror", make_mirror},
        {"glass", make_glass}, {"moving", make_moving},     {"posts", make_posts}};
    return all;
}

}  // namespace

std::shared_ptr<const Scene> test_scene(const std::string& name) {
    const std::size_t slash = name.find('/');
    const auto found = makes().find(name.substr(0, slash));
    if (found == makes().end()) return nullptr;
    float px_width = 1.0F;
    if (slash != std::string::npos) {
        const char* end = name.data() + name.size();
        const auto [stop, error] = std::from_chars(name.data() + slash + 1, end, px_width);
        if (error != std::errc{} || stop != end || !(px_width > 0.0F)) return nullptr;
    }
    Maker maker(px_width);
    maker.scene().name = name;
    found->second(maker);
    return std::make_shared<const Scene>(std::move(maker.scene()));
}

const std::vector<std::string>& test_scene_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const auto& [name, make] : makes()) all.push_back(name);
        return all;
    }();
    return names;
}

}  // namespace macula::test
