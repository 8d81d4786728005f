#include "scenes/gltf_node.h"

#include <cmath>

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
tl::expected<GltfPlace, const char*> read_place(const tinygltf::Node& node) {
    GltfPlace place;
    if (!node.matrix.empty()) {
        if (node.matrix.size() != 16) return tl::unexpected<const char*>("the matrix does not have 16 numbers");
        glm::dmat4 matrix;
        for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
        if (matrix[0].w != 0.0 || matrix[1].w != 0.0 || matrix[2].w != 0.0 || matrix[3].w != 1.0)
            return tl::unexpected<const char*>("the matrix is not affine: its last row is not 0 0 0 1");
        place.matrix = matrix;
        return place;
    }
    glm::dvec4 xyzw(0.0, 0.0, 0.0, 1.0);
    if (!copy_numbers(node.translation, place.translation_m) || !copy_numbers(node.rotation, xyzw) ||
        !copy_numbers(node.scale, place.scale))
        return tl::unexpected<const char*>("translation, rotation or scale has the wrong length");
    const double length = glm::length(xyzw);
    if (!(length > 0.0)) return tl::unexpected<const char*>("the rotation is a quaternion of length zero");
    xyzw /= length;
    place.rotation = glm::dquat(xyzw.w, xyzw.x, xyzw.y, xyzw.z);
    return place;
}

bool is_finite(const glm::mat4& m) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!std::isfinite(m[c][r])) return false;
    return true;
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
    int parent;  ///< into the list
};

}  // namespace

glm::dmat4 GltfPlace::parent_from_node() const {
    if (matrix) return *matrix;
    return glm::scale(glm::translate(glm::dmat4(1.0), translation_m) * glm::mat4_cast(rotation), scale);
}

bool is_singular(const glm::mat4& m) {
    // Compares the volume of the transformed unit cube with the box of its edges.
    const glm::dmat3 d(m);
    const double box = glm::length(d[0]) * glm::length(d[1]) * glm::length(d[2]);
    return !(std::abs(glm::determinant(d)) > 1e-9 * box) || box < 1e-30;
}

std::string node_name(const GltfContext& context, const PlacedNode& node) {
    return element_name("node", node.node, context.document.model.nodes[node.node].name);
}

Expected<std::vector<PlacedNode>> list_gltf_nodes(const GltfContext& context) {
    const tinygltf::Model& model = context.document.model;
    const std::size_t shown = model.defaultScene < 0 ? 0 : static_cast<std::size_t>(model.defaultScene);
    if (shown >= model.scenes.size() && model.defaultScene >= 0)
        return context.error(element_name("scene", shown), "does not exist");
    const std::vector<int> roots = model.scenes.empty() ? root_nodes(model) : model.scenes[shown].nodes;

    // A stack of our own: the depth of a file's hierarchy must not be the depth of our recursion.
    std::vector<PendingNode> pending;
    for (std::size_t i = roots.size(); i-- > 0;) pending.push_back({roots[i], -1});
    std::vector<bool> reached(model.nodes.size(), false);
    std::vector<PlacedNode> nodes;
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

        tl::expected<GltfPlace, const char*> place = read_place(node);
        if (!place) return context.error(element, place.error());
        const auto parent = static_cast<int>(nodes.size());
        PlacedNode listed;
        listed.node = index;
        listed.parent = next.parent;
        listed.place = *place;
        nodes.push_back(listed);
        for (std::size_t i = node.children.size(); i-- > 0;) pending.push_back({node.children[i], parent});
    }
    return nodes;
}

Expected<void> place_gltf_nodes(const GltfContext& context, std::vector<PlacedNode>& nodes) {
    std::vector<glm::dmat4> world_from_node;
    world_from_node.reserve(nodes.size());
    for (PlacedNode& node : nodes) {
        const glm::dmat4 parent_from_node = node.place.parent_from_node();
        world_from_node.push_back(node.parent < 0
                                      ? parent_from_node
                                      : world_from_node[static_cast<std::size_t>(node.parent)] * parent_from_node);
        node.world_from_node = glm::mat4(world_from_node.back());
        if (!is_finite(node.world_from_node))
            return context.error(node_name(context, node), "the transform is not finite");
        node.singular = is_singular(node.world_from_node);
    }
    return {};
}

}  // namespace macula
