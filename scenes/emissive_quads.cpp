#include "scenes/emissive_quads.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "scenes/framing.h"
#include "scenes/texel.h"

namespace macula {
namespace {

constexpr float kLeastShare = 0.01F;       // of the greatest power
constexpr float kLeastIrradiance = 0.01F;  // at a quarter of the scene's radius
constexpr int kMeanSide = 32;              // places along each side of the quad at which its texture is read

float luminance(const glm::vec3& c) {
    return glm::dot(c, glm::vec3(0.2126F, 0.7152F, 0.0722F));
}

/// Corner of each triangle that the other does not have, and the two that they share; indices of vertices.
struct SharedEdge {
    unsigned own = 0;
    unsigned other = 0;
    unsigned first = 0;   ///< follows `own` in its triangle
    unsigned second = 0;  ///< and this one `first`
};

/// Compares places, not indices: corners may have vertices of their own.
std::optional<SharedEdge> shared_edge(const Mesh& mesh) {
    const glm::uvec3& a = mesh.triangle[0];
    const glm::uvec3& b = mesh.triangle[1];
    const auto same = [&mesh](unsigned v, unsigned w) { return mesh.position_m[v] == mesh.position_m[w]; };
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const unsigned first = a[(i + 1) % 3];
            const unsigned second = a[(i + 2) % 3];
            // Neighbours that agree about their front run along the edge in opposite directions.
            if (same(first, b[(j + 2) % 3]) && same(second, b[(j + 1) % 3]))
                return SharedEdge{a[i], b[j], first, second};
        }
    return std::nullopt;
}

std::optional<SharedEdge> parallelogram(const Mesh& mesh) {
    if (mesh.triangle.size() != 2) return std::nullopt;
    const std::optional<SharedEdge> edge = shared_edge(mesh);
    if (!edge) return std::nullopt;
    const auto at = [&mesh](unsigned v) { return mesh.position_m[v]; };
    const glm::vec3 diagonal = at(edge->second) - at(edge->first);
    const glm::vec3 error = at(edge->own) + at(edge->other) - at(edge->first) - at(edge->second);
    return glm::length(error) <= 1e-3F * glm::length(diagonal) ? edge : std::nullopt;
}

float srgb_to_linear(float c) {
    return c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F);
}

/// Index of the texel along one axis for a coordinate.
int wrapped_texel(float coordinate, int size, TextureWrap wrap) {
    float share = coordinate - std::floor(coordinate);
    if (wrap == TextureWrap::clamp_to_edge) share = glm::clamp(coordinate, 0.0F, 1.0F);
    if (wrap == TextureWrap::mirrored_repeat && (static_cast<long>(std::floor(coordinate)) & 1L) != 0)
        share = 1.0F - share;
    return std::clamp(static_cast<int>(share * static_cast<float>(size)), 0, size - 1);
}

glm::vec3 texture_color(const TextureImage& image, const TextureUse& use, const glm::vec2& uv) {
    const glm::vec4& m = use.uv_scale_rotation;
    const glm::vec2 p(m.x * uv.x + m.z * uv.y + use.uv_offset.x, m.y * uv.x + m.w * uv.y + use.uv_offset.y);
    const auto x = static_cast<std::size_t>(wrapped_texel(p.x, image.width_px, use.wrap_u));
    const auto y = static_cast<std::size_t>(wrapped_texel(p.y, image.height_px, use.wrap_v));
    const glm::vec3 stored(stored_texel(image, y * static_cast<std::size_t>(image.width_px) + x));
    if (!image.srgb) return stored;
    return {srgb_to_linear(stored.r), srgb_to_linear(stored.g), srgb_to_linear(stored.b)};
}

/// Mean emission over the quad.
glm::vec3 mean_radiance(const Scene& scene, const Mesh& mesh, const SharedEdge& edge) {
    const Material& material = scene.materials[static_cast<std::size_t>(mesh.material)];
    const TextureUse& use = material.emissive_texture;
    if (!use.present()) return material.emissive;
    const std::vector<glm::vec2>& uv = use.uv_set == 0 ? mesh.uv0 : mesh.uv1;
    const TextureImage& image = scene.images[static_cast<std::size_t>(use.image)];
    glm::vec3 sum(0.0F);
    for (int i = 0; i < kMeanSide; ++i)
        for (int j = 0; j < kMeanSide; ++j) {
            const float s = (static_cast<float>(i) + 0.5F) / static_cast<float>(kMeanSide);
            const float t = (static_cast<float>(j) + 0.5F) / static_cast<float>(kMeanSide);
            const glm::vec2 along_first = uv[edge.first] - uv[edge.own];
            const glm::vec2 along_second = uv[edge.second] - uv[edge.own];
            sum += texture_color(image, use, uv[edge.own] + s * along_first + t * along_second);
        }
    return material.emissive * sum / static_cast<float>(kMeanSide * kMeanSide);
}

/// What a mesh emits as a quad.
struct Emitter {
    MeshQuad quad;
    glm::vec3 radiance = glm::vec3(0.0F);
};

std::optional<Emitter> emitter_of(const Scene& scene, const Mesh& mesh) {
    const Material& material = scene.materials[static_cast<std::size_t>(mesh.material)];
    if (material.emissive == glm::vec3(0.0F) || material.unlit || material.alpha_mode != AlphaMode::opaque)
        return std::nullopt;
    const std::optional<SharedEdge> edge = parallelogram(mesh);
    if (!edge) return std::nullopt;
    return Emitter{*mesh_quad(mesh), mean_radiance(scene, mesh, *edge)};
}

/// The rectangle that an instance of a quad is in the world.
Light rectangle_of(const Instance& instance, int index, const Emitter& emitter) {
    const glm::mat3 turn(instance.world_from_mesh);
    Light light;
    light.kind = LightKind::rectangle;
    light.position_m = glm::vec3(instance.world_from_mesh * glm::vec4(emitter.quad.center, 1.0F));
    light.half_u_m = turn * emitter.quad.half_u;
    light.half_v_m = turn * emitter.quad.half_v;
    // A mirroring placement turns cross products around, but not the front.
    if (glm::determinant(turn) < 0.0F) std::swap(light.half_u_m, light.half_v_m);
    light.direction = glm::vec3(glm::normalize(glm::cross(glm::dvec3(light.half_u_m), glm::dvec3(light.half_v_m))));
    light.intensity = emitter.radiance;
    light.instance = index;
    light.node = instance.node;
    return light;
}

float area(const Light& light) {
    return 4.0F * glm::length(glm::cross(light.half_u_m, light.half_v_m));
}

Light other_side(Light light) {
    std::swap(light.half_u_m, light.half_v_m);
    light.direction = -light.direction;
    return light;
}

struct Candidate {
    Light light;
    float radiance_area = 0.0F;  ///< luminance of the radiance times area; times pi it is one side's power
    bool double_sided = false;
};

std::vector<Candidate> find_candidates(const Scene& scene) {
    std::vector<std::optional<Emitter>> emitters;  // by mesh
    emitters.reserve(scene.meshes.size());
    for (const Mesh& mesh : scene.meshes) emitters.push_back(emitter_of(scene, mesh));
    std::vector<Candidate> found;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const auto mesh = static_cast<std::size_t>(scene.instances[i].mesh);
        if (!emitters[mesh]) continue;
        Candidate candidate;
        candidate.light = rectangle_of(scene.instances[i], static_cast<int>(i), *emitters[mesh]);
        candidate.radiance_area = luminance(emitters[mesh]->radiance) * area(candidate.light);
        candidate.double_sided = scene.materials[static_cast<std::size_t>(scene.meshes[mesh].material)].double_sided;
        if (candidate.radiance_area > 0.0F && std::isfinite(candidate.radiance_area)) found.push_back(candidate);
    }
    return found;
}

}  // namespace

std::optional<MeshQuad> mesh_quad(const Mesh& mesh) {
    const std::optional<SharedEdge> edge = parallelogram(mesh);
    if (!edge) return std::nullopt;
    const glm::vec3& own = mesh.position_m[edge->own];
    const glm::vec3& first = mesh.position_m[edge->first];
    const glm::vec3& second = mesh.position_m[edge->second];
    return MeshQuad{0.5F * (first + second), 0.5F * (first - own), 0.5F * (second - own)};
}

void add_emissive_quads(Scene& scene) {
    std::vector<Candidate> candidates = find_candidates(scene);
    if (candidates.empty()) return;
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.radiance_area > b.radiance_area; });
    // Straight ahead of a small quad the irradiance is radiance * area / distance^2.
    const float distance = std::max(0.25F * world_bounds(scene).radius(), 1e-6F);
    const float least =
        std::max(kLeastShare * candidates.front().radiance_area, kLeastIrradiance * distance * distance);
    std::size_t added = 0;
    for (const Candidate& candidate : candidates) {
        added += candidate.double_sided ? 2U : 1U;
        if (candidate.radiance_area < least || added > kMostEmissiveRectangles) return;
        scene.lights.push_back(candidate.light);
        if (candidate.double_sided) scene.lights.push_back(other_side(candidate.light));
    }
}

}  // namespace macula
