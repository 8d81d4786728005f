#include "scenes/gltf_mesh.h"

#include <cmath>
#include <numeric>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/gltf_accessor.h"
#include "scenes/material_textures.h"
#include "scenes/mesh_attributes.h"

namespace macula {
namespace {

constexpr float kMaxPosition = 1e9F;  // m
constexpr float kMaxUv = 1e6F;        // beyond this float has no fraction left

int attribute_accessor(const tinygltf::Primitive& primitive, const char* name) {
    const auto it = primitive.attributes.find(name);
    return it == primitive.attributes.end() ? -1 : it->second;
}

/// A vertex attribute, empty if the primitive does not have it. Errors: as read_accessor(), or another length than
/// the positions.
template <class Element>
Expected<std::vector<Element>> read_attribute(GltfContext& context, const tinygltf::Primitive& primitive,
                                              const std::string& element, const char* name, std::size_t vertices) {
    const int accessor = attribute_accessor(primitive, name);
    if (accessor == -1) return std::vector<Element>();
    Expected<std::vector<Element>> values = read_accessor<Element>(context, accessor);
    if (!values) values.error().message += " (" + element + ", " + name + ")";
    if (values && vertices != 0 && values->size() != vertices)
        return context.error(element, std::string(name) + " and POSITION differ in length");
    return values;
}

/// Triangles of a list, strip or fan of vertex indices (glTF 2.0, 3.7.2.1).
std::vector<glm::uvec3> assemble(int mode, const std::vector<std::uint32_t>& v) {
    std::vector<glm::uvec3> triangles;
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        for (std::size_t i = 0; i + 2 < v.size(); i += 3) triangles.emplace_back(v[i], v[i + 1], v[i + 2]);
        return triangles;
    }
    for (std::size_t i = 0; i + 2 < v.size(); ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
            triangles.emplace_back(v[i + 1], v[i + 2], v[0]);
        else
            triangles.emplace_back(v[i], v[i + 1 + i % 2], v[i + 2 - i % 2]);
    }
    // Strips are stitched together with triangles that have two equal corners.
    std::erase_if(triangles, [](const glm::uvec3& t) { return t.x == t.y || t.y == t.z || t.z == t.x; });
    return triangles;
}

Expected<void> read_triangles(GltfContext& context, const tinygltf::Primitive& primitive, const std::string& element,
                              Mesh& mesh) {
    const std::size_t vertices = mesh.position_m.size();
    std::vector<std::uint32_t> indices;
    if (primitive.indices != -1) {
        Expected<std::vector<std::uint32_t>> read = read_indices(context, primitive.indices);
        if (!read) {
            read.error().message += " (" + element + ", indices)";
            return tl::unexpected(read.error());
        }
        indices = std::move(*read);
    } else {
        indices.resize(vertices);
        std::iota(indices.begin(), indices.end(), 0U);
    }
    for (const std::uint32_t index : indices)
        if (index >= vertices)
            return context.error(element, "index " + std::to_string(index) + " is used, but there are " +
                                              std::to_string(vertices) + " vertices");
    if (primitive.mode == TINYGLTF_MODE_TRIANGLES && indices.size() % 3 != 0)
        context.warn(element, "the last triangle is incomplete and left out");
    mesh.triangle = assemble(primitive.mode, indices);
    if (const std::size_t dropped = drop_degenerate_triangles(mesh); dropped > 0)
        context.warn(element, std::to_string(dropped) + " triangle(s) without area are left out");
    return {};
}

Expected<void> read_normals(GltfContext& context, const tinygltf::Primitive& primitive, const std::string& element,
                            Mesh& mesh) {
    Expected<std::vector<glm::vec3>> normals =
        read_attribute<glm::vec3>(context, primitive, element, "NORMAL", mesh.position_m.size());
    if (!normals) return tl::unexpected(normals.error());
    std::size_t zeros = 0;
    for (glm::vec3& n : *normals) {
        const float length = glm::length(n);
        const bool usable = length > 0.0F && std::isfinite(length);
        if (!usable) ++zeros;
        n = usable ? n / length : glm::vec3(0.0F);
    }
    if (zeros > 0) {
        context.warn(element, std::to_string(zeros) + " normal(s) of length zero are replaced");
        add_smooth_normals(mesh);
        for (std::size_t i = 0; i < normals->size(); ++i)
            if ((*normals)[i] == glm::vec3(0.0F)) (*normals)[i] = mesh.normal[i];
    }
    mesh.normal = std::move(*normals);
    return {};
}

/// Coordinates of one set; zeros with a warning where the material uses a set that the primitive does not have.
Expected<std::vector<glm::vec2>> read_uv(GltfContext& context, const tinygltf::Primitive& primitive,
                                         const std::string& element, int set, std::size_t vertices) {
    const std::string name = "TEXCOORD_" + std::to_string(set);
    Expected<std::vector<glm::vec2>> uv =
        read_attribute<glm::vec2>(context, primitive, element, name.c_str(), vertices);
    if (!uv) return uv;
    for (const glm::vec2& p : *uv)
        if (std::abs(p.x) > kMaxUv || std::abs(p.y) > kMaxUv) return context.error(element, name + " goes beyond 1e6");
    if (uv->empty()) {
        context.warn(element, name + " is missing; the texture is sampled at (0, 0)");
        uv->assign(vertices, glm::vec2(0.0F));
    }
    return uv;
}

bool uses_uv_set(const Material& material, int set) {
    for (const TextureUse* use : texture_uses(material))
        if (use->present() && use->uv_set == set) return true;
    return false;
}

Expected<void> read_colors(GltfContext& context, const tinygltf::Primitive& primitive, const std::string& element,
                           Mesh& mesh) {
    const int accessor = attribute_accessor(primitive, "COLOR_0");
    if (accessor == -1) return {};
    const std::size_t vertices = mesh.position_m.size();
    if (accessor_components(context, accessor) == 3) {
        const Expected<std::vector<glm::vec3>> rgb =
            read_attribute<glm::vec3>(context, primitive, element, "COLOR_0", vertices);
        if (!rgb) return tl::unexpected(rgb.error());
        mesh.color.reserve(vertices);
        for (const glm::vec3& c : *rgb) mesh.color.emplace_back(c, 1.0F);
    } else {
        Expected<std::vector<glm::vec4>> rgba =
            read_attribute<glm::vec4>(context, primitive, element, "COLOR_0", vertices);
        if (!rgba) return tl::unexpected(rgba.error());
        mesh.color = std::move(*rgba);
    }
    for (glm::vec4& c : mesh.color) c = glm::max(c, 0.0F);
    return {};
}

/// The file's tangents as unit vectors, empty where it has none or one of them has no direction.
Expected<std::vector<glm::vec4>> read_tangents(GltfContext& context, const tinygltf::Primitive& primitive,
                                               const std::string& element, std::size_t vertices) {
    Expected<std::vector<glm::vec4>> tangents =
        read_attribute<glm::vec4>(context, primitive, element, "TANGENT", vertices);
    if (!tangents) return tangents;
    for (glm::vec4& t : *tangents) {
        const float length = glm::length(glm::vec3(t));
        if (!(length > 0.0F) || !std::isfinite(length)) return std::vector<glm::vec4>();
        t = glm::vec4(glm::vec3(t) / length, t.w < 0.0F ? -1.0F : 1.0F);
    }
    return tangents;
}

/// Tangents along u of the normal map as it lies on the mesh, its KHR_texture_transform included.
void make_tangents(const TextureUse& use, Mesh& mesh) {
    std::vector<glm::vec2> uv = use.uv_set == 0 ? mesh.uv0 : mesh.uv1;
    const glm::vec4& m = use.uv_scale_rotation;
    for (glm::vec2& p : uv) p = glm::vec2(m.x * p.x + m.z * p.y, m.y * p.x + m.w * p.y);
    add_tangents(mesh, uv);
}

}  // namespace

Expected<std::optional<Mesh>> read_gltf_primitive(GltfContext& context, const tinygltf::Primitive& primitive,
                                                  const std::string& element, const Material& material,
                                                  int material_index) {
    if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
        return context.error(element, "mode " + std::to_string(primitive.mode) + " is not glTF");
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
        context.warn(element, "points and lines are left out");
        return std::nullopt;
    }
    if (attribute_accessor(primitive, "POSITION") == -1) {
        context.warn(element, "has no POSITION and is left out");
        return std::nullopt;
    }
    Mesh mesh;
    mesh.name = element;
    mesh.material = material_index;
    Expected<std::vector<glm::vec3>> positions = read_attribute<glm::vec3>(context, primitive, element, "POSITION", 0);
    if (!positions) return tl::unexpected(positions.error());
    mesh.position_m = std::move(*positions);
    for (const glm::vec3& p : mesh.position_m)
        if (glm::any(glm::greaterThan(glm::abs(p), glm::vec3(kMaxPosition))))
            return context.error(element, "POSITION goes beyond 1e9 m");

    const std::size_t vertices = mesh.position_m.size();
    Expected<void> read = read_triangles(context, primitive, element, mesh)
                              .and_then([&] { return read_normals(context, primitive, element, mesh); })
                              .and_then([&] { return read_colors(context, primitive, element, mesh); });
    if (!read) return tl::unexpected(read.error());
    for (int set = 0; set < 2; ++set) {
        if (!uses_uv_set(material, set)) continue;
        Expected<std::vector<glm::vec2>> uv = read_uv(context, primitive, element, set, vertices);
        if (!uv) return tl::unexpected(uv.error());
        (set == 0 ? mesh.uv0 : mesh.uv1) = std::move(*uv);
    }
    const bool flat = mesh.normal.empty();
    if (flat) add_flat_normals(mesh);
    const TextureUse& normal_map =
        material.normal_texture.present() ? material.normal_texture : material.clearcoat_normal_texture;
    if (normal_map.present()) {
        // glTF 2.0, 3.7.2.1: without normals the file's tangents do not count.
        Expected<std::vector<glm::vec4>> tangents = std::vector<glm::vec4>();
        if (!flat) tangents = read_tangents(context, primitive, element, vertices);
        if (!tangents) return tl::unexpected(tangents.error());
        mesh.tangent = std::move(*tangents);
        if (mesh.tangent.empty()) make_tangents(normal_map, mesh);
    }
    if (mesh.triangle.empty()) return std::nullopt;
    return mesh;
}

}  // namespace macula
