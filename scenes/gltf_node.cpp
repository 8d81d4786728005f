#include "scenes/gltf_node.h"

#include <cmath>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

namespace macula {
namespace {

/// Copies `from` if it has the right length; an absent (empty) member leaves the default.
template <class Vector>
bool copy_numbers(const std::vector<double>& from, Vector& to) {
    if (from.empty()) return true;
    if (from.size() != static_cast<std::size_t>(Vector::length())) return false;
    for (int i = 0; i < Vector::length(); ++i) to[i] = from[static_cast<std::size_t>(i)];
    return true;
}

/// The node's own transform, or what is wrong with it.
tl::expected<glm::dmat4, const char*> local_transform(const tinygltf::Node& node) {
    if (!node.matrix.empty()) {
        if (node.matrix.size() != 16) return tl::unexpected<const char*>("the matrix does not have 16 numbers");
        glm::dmat4 matrix;
        for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
        if (matrix[0].w != 0.0 || matrix[1].w != 0.0 || matrix[2].w != 0.0 || matrix[3].w != 1.0)
            return tl::unexpected<const char*>("the matrix is not affine: its last row is not 0 0 0 1");
        return matrix;
    }
    glm::dvec3 translation(0.0);
    glm::dvec4 xyzw(0.0, 0.0, 0.0, 1.0);
    glm::dvec3 scale(1.0);
    if (!copy_numbers(node.translation, translation) || !copy_numbers(node.rotation, xyzw) ||
        !copy_numbers(node.scale, scale))
        return tl::unexpected<const char*>("translation, rotation or scale has the wrong length");
    const double length = glm::length(xyzw);
    if (!(length > 0.0)) return tl::unexpected<const char*>("the rotation is a quaternion of length zero");
    xyzw /= length;
    const glm::dmat4 rotated =
        glm::translate(glm::dmat4(1.0), translation) * glm::mat4_cast(glm::dquat(xyzw.w, xyzw.x, xyzw.y, xyzw.z));
    return glm::scale(rotated, scale);
}

bool is_finite(const glm::mat4& m) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!std::isfinite(m[c][r])) return false;
    return true;
}

/// Compares the volume of the transformed unit cube with the box of its edges, so that the scale does not matter.
bool is_singular(const glm::mat4& m) {
    const glm::dmat3 d(m);
    const double box = glm::length(d[0]) * glm::length(d[1]) * glm::length(d[2]);
    return !(std::abs(glm::determinant(d)) > 1e-9 * box) || box < 1e-30;
}

std::vector<int> root_nodes(const tinygltf::Model& model) {
    std::vector<bool> is_child(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes)
        for (const int child : node.children)
            if (child >= 0 && static_cast<std::size_t>(child) < is_child.size())
                is_child[static_cast<std::size_t>(child)] = true;
    std::vector<int> roots;
    for (std::size_t i = 0; i < is_child.size(); ++i)
        if (!is_child[i]) roots.push_back(static_cast<int>(i));
    return roots;
}

struct PendingNode {
    int node;
    glm::dmat4 world_from_parent;
};

}  // namespace

Expected<std::vector<PlacedNode>> place_gltf_nodes(const GltfContext& context) {
    const tinygltf::Model& model = context.document.model;
    const std::size_t shown = model.defaultScene < 0 ? 0 : static_cast<std::size_t>(model.defaultScene);
    if (shown >= model.scenes.size() && model.defaultScene >= 0)
        return context.error(element_name("scene", shown), "does not exist");
    const std::vector<int> roots = model.scenes.empty() ? root_nodes(model) : model.scenes[shown].nodes;

    // A stack of our own: the depth of a file's hierarchy must not be the depth of our recursion.
    std::vector<PendingNode> pending;
    for (std::size_t i = roots.size(); i-- > 0;) pending.push_back({roots[i], glm::dmat4(1.0)});
    std::vector<bool> reached(model.nodes.size(), false);
    std::vector<PlacedNode> placed;
    while (!pending.empty()) {
        const PendingNode next = pending.back();
        pending.pop_back();
        if (next.node < 0 || static_cast<std::size_t>(next.node) >= model.nodes.size())
            return context.error("node " + std::to_string(next.node), "does not exist");
        const auto index = static_cast<std::size_t>(next.node);
        const tinygltf::Node& node = model.nodes[index];
        const std::string element = element_name("node", index, node.name);
        if (reached[index]) return context.error(element, "has two parents or is its own ancestor");
        reached[index] = true;

        const tl::expected<glm::dmat4, const char*> local = local_transform(node);
        if (!local) return context.error(element, local.error());
        const glm::dmat4 world_from_node = next.world_from_parent * *local;
        PlacedNode result{index, glm::mat4(world_from_node), false};
        if (!is_finite(result.world_from_node)) return context.error(element, "the transform is not finite");
        result.singular = is_singular(result.world_from_node);
        placed.push_back(result);
        for (std::size_t i = node.children.size(); i-- > 0;) pending.push_back({node.children[i], world_from_node});
    }
    return placed;
}

}  // namespace macula
