#include "scenes/bunny_box.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "scenes/mesh_edit.h"
#include "scenes/obj.h"
#include "scenes/pattern.h"
#include "scenes/scene_builder.h"
#include "scenes/shapes.h"

namespace macula {
namespace {

constexpr float kHalfRoom = 3.0F;  // m; the room is centred on the y axis
constexpr float kRoomHeight = 4.0F;
constexpr float kEyeHeight = 1.6F;
constexpr float kPedestalHeight = 1.05F;
constexpr glm::vec3 kPedestalPlace = glm::vec3(0.0F, 0.0F, -0.7F);
constexpr float kBunnyHeight = 0.95F;

/// Collects what the room consists of.
class RoomBuilder : public SceneBuilder {
public:
    /// White times the texture, repeated `repeat` times along u and v.
    int textured(TextureImage image, glm::vec2 repeat = glm::vec2(1.0F), float roughness = 0.8F) {
        const int index = plain(image.name, 0xFFFFFF, roughness);
        TextureUse& use = scene().materials.back().base_color_texture;
        use.uv_scale_rotation = glm::vec4(repeat.x, 0.0F, 0.0F, repeat.y);
        use.image = add_image(std::move(image));
        return index;
    }

    int glowing(const std::string& name, const glm::vec3& radiance) {
        const int index = plain(name, 0x000000);
        scene().materials.back().emissive = radiance;
        return index;
    }

    void object(const std::string& name, Mesh shape, int material, const glm::mat4& world_from_mesh = glm::mat4(1.0F)) {
        place_mesh(name, add_mesh(std::move(shape), material), world_from_mesh);
    }
};

void build_room(RoomBuilder& room) {
    constexpr float kW = 2.0F * kHalfRoom;
    const glm::vec3 x(kW, 0.0F, 0.0F);
    const glm::vec3 z(0.0F, 0.0F, kW);
    const glm::vec3 down(0.0F, -kRoomHeight, 0.0F);
    const auto corner = [](float sx, float y, float sz) { return glm::vec3(sx * kHalfRoom, y, sz * kHalfRoom); };

    const int floor = room.textured(make_checkerboard(512, 2, {srgb(0xD8D2C4), srgb(0x6E6A66)}), glm::vec2(6.0F), 0.5F);
    const int bricks = room.textured(make_bricks(1024, {srgb(0xB5765A), srgb(0xD6CFC4)}), glm::vec2(3.0F, 2.0F), 0.9F);
    room.object("floor", make_quad(corner(-1, 0, -1), x, z), floor);
    room.object("ceiling", make_quad(corner(-1, kRoomHeight, 1), x, -z), room.plain("ceiling paint", 0xF4F2EC, 0.9F));
    room.object("front wall", make_quad(corner(-1, kRoomHeight, -1), x, down),
                room.plain("wall paint", 0xE8E4DA, 0.9F));
    room.object("back wall", make_quad(corner(1, kRoomHeight, 1), -x, down), bricks);
    room.object("left wall", make_quad(corner(-1, kRoomHeight, 1), -z, down), room.plain("red paint", 0xC4564A, 0.9F));
    room.object("right wall", make_quad(corner(1, kRoomHeight, -1), z, down), room.plain("blue paint", 0x4F86A8, 0.9F));

    const int skirting = room.plain("skirting", 0xF0EEE8, 0.6F);
    const int along_x = room.add_mesh(make_box({kW, 0.12F, 0.03F}), skirting);
    const int along_z = room.add_mesh(make_box({0.03F, 0.12F, kW}), skirting);
    room.place_mesh("front skirting", along_x, place({0.0F, 0.0F, -kHalfRoom + 0.015F}));
    room.place_mesh("back skirting", along_x, place({0.0F, 0.0F, kHalfRoom - 0.015F}));
    room.place_mesh("left skirting", along_z, place({-kHalfRoom + 0.015F, 0.0F, 0.0F}));
    room.place_mesh("right skirting", along_z, place({kHalfRoom - 0.015F, 0.0F, 0.0F}));
}

/// A chart in a dark frame, its centre at `at`, facing +Z before the turn.
void hang(RoomBuilder& room, int frame, const TextureImage& chart, const glm::vec3& at, float yaw_deg, float size_m) {
    const float h = 0.5F * size_m;
    const glm::mat4 world_from_picture = place(at, yaw_deg);
    Mesh board = make_box({size_m + 0.08F, size_m + 0.08F, 0.04F});
    room.object("frame of the " + chart.name, std::move(board), frame,
                glm::translate(world_from_picture, glm::vec3(0.0F, -h - 0.04F, 0.02F)));
    room.object(chart.name, make_quad({-h, h, 0.045F}, {size_m, 0.0F, 0.0F}, {0.0F, -size_m, 0.0F}),
                room.textured(chart), world_from_picture);
}

void build_charts(RoomBuilder& room) {
    const int frame = room.plain("frame", 0x2B2622, 0.5F);
    hang(room, frame, make_zone_plate(1024, 0.12F), {-1.75F, 1.75F, -kHalfRoom}, 0.0F, 1.5F);
    hang(room, frame, make_sloan_chart(1024), {1.75F, 1.75F, -kHalfRoom}, 0.0F, 1.5F);
    hang(room, frame, make_text_page(1024), {-kHalfRoom, 1.7F, -0.9F}, 90.0F, 1.3F);
    hang(room, frame, make_siemens_star(1024, 48), {-kHalfRoom, 1.7F, 1.1F}, 90.0F, 1.3F);
    hang(room, frame, make_bar_chart(1024), {kHalfRoom, 1.7F, -0.9F}, -90.0F, 1.3F);
    const TextureImage stripes = make_stripes(512, 64, {srgb(0x1C2430), srgb(0xF2EFE6)});
    hang(room, frame, stripes, {kHalfRoom, 1.7F, 1.1F}, -90.0F, 1.3F);
}

/// A mirror between the charts of the front wall: it shows the bunny's back and the room behind the viewer.
void build_mirror(RoomBuilder& room) {
    constexpr glm::vec3 kCentre(0.0F, 2.15F, -kHalfRoom);
    constexpr glm::vec2 kSize(1.5F, 1.9F);
    constexpr float kFrame = 0.07F;
    const int silver = room.plain("mirror silver", 0xF3F5F4, 0.0F, 1.0F);
    const int wood = room.plain("mirror frame", 0x5B3A22, 0.45F);
    const glm::vec2 h = 0.5F * kSize;
    room.object("mirror", make_quad({-h.x, h.y, 0.03F}, {kSize.x, 0.0F, 0.0F}, {0.0F, -kSize.y, 0.0F}), silver,
                place(kCentre));
    const int rail = room.add_mesh(make_box({kSize.x + 2.0F * kFrame, kFrame, 0.06F}), wood);
    const int stile = room.add_mesh(make_box({kFrame, kSize.y, 0.06F}), wood);
    const glm::vec3 out(0.0F, 0.0F, 0.03F);
    room.place_mesh("mirror frame above", rail, place(kCentre + out + glm::vec3(0.0F, h.y, 0.0F)));
    room.place_mesh("mirror frame below", rail, place(kCentre + out - glm::vec3(0.0F, h.y + kFrame, 0.0F)));
    room.place_mesh("mirror frame left", stile, place(kCentre + out - glm::vec3(h.x + 0.5F * kFrame, h.y, 0.0F)));
    room.place_mesh("mirror frame right", stile, place(kCentre + out + glm::vec3(h.x + 0.5F * kFrame, -h.y, 0.0F)));
}

/// A solid ball of faintly green glass that lies in a brass ring on the marble cylinder.
void build_glass(RoomBuilder& room) {
    constexpr float kRadius = 0.2F;
    constexpr glm::vec3 kStand(0.95F, 0.45F, 0.0F);  // top of the cylinder
    Material glass;
    glass.name = "glass";
    glass.metallic = 0.0F;
    glass.roughness = 0.0F;
    glass.transmission = 1.0F;
    glass.ior = 1.5F;
    glass.thickness_m = 2.0F * kRadius;
    glass.attenuation_distance_m = 0.8F;
    glass.attenuation_color = glm::vec3(0.55F, 0.88F, 0.74F);
    // The ball touches the ring's tube all around: where it has the tube's distance to the ball's centre.
    constexpr float kRing = 0.11F;
    constexpr float kTube = 0.018F;
    const float lift = kTube + std::sqrt((kRadius + kTube) * (kRadius + kTube) - kRing * kRing);
    room.object("glass ball", make_sphere(kRadius), room.add_material(glass),
                place(kStand + glm::vec3(0.0F, lift, 0.0F)));
    room.object("ring under the glass ball", make_torus(kRing, kTube), room.plain("brass", 0xC9A25A, 0.35F, 1.0F),
                place(kStand + glm::vec3(0.0F, kTube, 0.0F)));
}

void build_objects(RoomBuilder& room) {
    const int wood = room.textured(make_wood(512, {srgb(0xC89B62), srgb(0x7A4E28)}), glm::vec2(1.0F), 0.5F);
    const int marble =
        room.textured(make_noise(512, 4, {srgb(0xF3EFE8), srgb(0x9AA0A8)}), glm::vec2(2.0F, 1.0F), 0.35F);
    const int globe =
        room.textured(make_checkerboard(256, 16, {srgb(0x20242A), srgb(0xEFEFEF)}), glm::vec2(2.0F, 1.0F));
    const int candy = room.textured(make_stripes(256, 16, {srgb(0xC62F3B), srgb(0xF6F1EA)}), glm::vec2(1.0F));
    const int red = room.plain("red gloss", 0xC8372D, 0.25F);
    const int gold = room.plain("gold", 0xE3B45A, 0.35F, 1.0F);
    const int green = room.plain("green", 0x4E8C57, 0.6F);
    const int white = room.plain("white", 0xEDEAE4, 0.7F);
    const int steel = room.plain("steel", 0xB8BCC2, 0.4F, 1.0F);

    room.object("wooden box", make_box({0.7F, 0.7F, 0.7F}), wood, place({-1.55F, 0.0F, -1.3F}, 25.0F));
    room.object("globe", make_sphere(0.32F), globe, place({-1.55F, 1.02F, -1.3F}, 40.0F));
    room.object("tall box", make_box({0.6F, 1.25F, 0.6F}), white, place({1.5F, 0.0F, -1.45F}, -20.0F));
    room.object("torus", make_torus(0.24F, 0.085F), gold,
                glm::rotate(place({1.5F, 1.575F, -1.45F}, -20.0F), glm::radians(90.0F), glm::vec3(1.0F, 0.0F, 0.0F)));
    room.object("striped column", make_cylinder(0.14F, 0.14F, 1.5F), candy, place({2.35F, 0.0F, -2.4F}));
    room.object("marble ball", make_sphere(0.2F), marble, place({2.35F, 1.7F, -2.4F}));
    room.object("cone", make_cylinder(0.35F, 0.0F, 0.9F), green, place({-2.4F, 0.0F, -2.4F}));
    room.object("red ball", make_sphere(0.22F), red, place({-0.75F, 0.22F, 0.15F}));
    room.object("marble cylinder", make_cylinder(0.2F, 0.2F, 0.45F), marble, place({0.95F, 0.0F, 0.0F}));

    // Thin rods: what sparse sampling and temporal filtering lose first. Their radius falls from 10 to 1.5 mm.
    constexpr int kRods = 9;
    const glm::mat4 rack = place({2.15F, 0.0F, -0.5F}, -45.0F);
    room.object("rod rack", make_box({0.85F, 0.06F, 0.14F}), wood, rack);
    for (int i = 0; i < kRods; ++i) {
        const float radius = 0.010F * std::pow(0.79F, static_cast<float>(i));
        const glm::vec3 foot(0.09F * (static_cast<float>(i) - 4.0F), 0.06F, 0.0F);
        room.object("rod " + std::to_string(i + 1), make_cylinder(radius, radius, 1.3F, 16), steel,
                    glm::translate(rack, foot));
    }

    for (int step = 0; step < 4; ++step) {
        const float height = 0.15F * static_cast<float>(step + 1);
        room.object("step " + std::to_string(step + 1), make_box({0.9F, height, 0.25F}), step % 2 == 0 ? white : wood,
                    place({-2.5F, 0.0F, 0.7F - 0.25F * static_cast<float>(step)}));
    }
}

/// The bunny, turned to look a little past the viewer, scaled to kBunnyHeight and put on the pedestal.
void build_bunny(RoomBuilder& room, const std::string& bunny_path, std::vector<std::string>& warnings) {
    const int stone = room.plain("pedestal stone", 0xBFB9AE, 0.7F);
    room.object("pedestal foot", make_box({0.75F, 0.1F, 0.75F}), stone, place(kPedestalPlace));
    room.object("pedestal", make_cylinder(0.3F, 0.26F, kPedestalHeight - 0.16F), stone,
                place(kPedestalPlace + glm::vec3(0.0F, 0.1F, 0.0F)));
    room.object("pedestal plate", make_box({0.7F, 0.06F, 0.7F}), stone,
                place(kPedestalPlace + glm::vec3(0.0F, kPedestalHeight - 0.06F, 0.0F)));

    const int fur = room.plain("bunny", 0xCFA07A, 0.55F);
    Expected<Mesh> bunny = read_obj(bunny_path);
    if (!bunny) {
        warnings.push_back("bunny-box: " + bunny.error().message +
                           "; a torus knot stands in for the Stanford bunny. Install the package glmark2-data.");
        bunny = make_torus_knot(2, 3, 0.3F, 0.075F);
    }
    glm::vec3 low = bunny->position_m.front();
    glm::vec3 high = low;
    for (const glm::vec3& p : bunny->position_m) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const float scale = std::min(kBunnyHeight / (high.y - low.y), 0.95F / (high.x - low.x));
    const glm::vec3 base(0.5F * (low.x + high.x), low.y, 0.5F * (low.z + high.z));
    const glm::mat4 on_pedestal = place(kPedestalPlace + glm::vec3(0.0F, kPedestalHeight, 0.0F), 0.0F, scale);
    room.object("bunny", std::move(*bunny), fur, glm::translate(on_pedestal, -base));
}

void build_lights(RoomBuilder& room) {
    const glm::vec3 lamp(0.4F, kRoomHeight - 0.3F, 0.8F);
    room.object("lamp", make_box({1.1F, 0.03F, 1.1F}), room.glowing("lamp glow", glm::vec3(1.6F, 1.55F, 1.45F)),
                place({lamp.x, kRoomHeight - 0.03F, lamp.z}));

    Light ceiling;
    ceiling.kind = LightKind::point;
    ceiling.position_m = lamp;
    ceiling.intensity = glm::vec3(26.0F, 24.8F, 22.5F);

    Light fill;
    fill.kind = LightKind::spot;
    fill.position_m = glm::vec3(-2.4F, 3.5F, 2.4F);
    fill.direction = glm::normalize(glm::vec3(0.2F, 1.1F, -0.9F) - fill.position_m);
    fill.intensity = glm::vec3(13.0F, 13.6F, 15.0F);
    fill.spot_cos_inner = std::cos(glm::radians(18.0F));
    fill.spot_cos_outer = std::cos(glm::radians(42.0F));
    room.scene().lights = {ceiling, fill};
    room.scene().ambient_radiance = glm::vec3(0.19F, 0.195F, 0.21F);
}

}  // namespace

LoadedScene make_bunny_box(const std::string& bunny_path) {
    RoomBuilder room;
    LoadedScene loaded;
    build_room(room);
    build_charts(room);
    build_mirror(room);
    build_objects(room);
    build_glass(room);
    build_bunny(room, bunny_path, loaded.warnings);
    build_lights(room);

    Scene& scene = room.scene();
    scene.name = "bunny-box";
    scene.exposure = 1.0F;
    scene.world_from_start.position_m = glm::vec3(0.0F, kEyeHeight, 1.6F);
    scene.near_m = 0.1F;
    loaded.scene = std::make_shared<const Scene>(std::move(scene));
    return loaded;
}

}  // namespace macula
