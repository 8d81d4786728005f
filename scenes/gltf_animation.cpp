#include "scenes/gltf_animation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "scenes/gltf_channel.h"

namespace macula {
namespace {

constexpr double kMaxReach = 1e9;  // m; also of scales

std::optional<AnimationPath> path_of(const std::string& name) {
    if (name == "translation") return AnimationPath::translation;
    if (name == "rotation") return AnimationPath::rotation;
    if (name == "scale") return AnimationPath::scale;
    return std::nullopt;
}

/// Bound of how much the matrix stretches any vector: Gershgorin's of its Gram matrix, exact for turned scales.
double largest_stretch(const glm::dmat3& m) {
    const glm::dmat3 gram = glm::transpose(m) * m;
    double largest = 0.0;
    for (int c = 0; c < 3; ++c)
        largest = std::max(largest, std::abs(gram[c].x) + std::abs(gram[c].y) + std::abs(gram[c].z));
    return std::sqrt(largest);
}

bool shows_something(const tinygltf::Node& node) {
    return node.mesh >= 0 || node.extensions.count("KHR_lights_punctual") > 0;
}

class GltfAnimationReader {
public:
    GltfAnimationReader(GltfContext& context, std::vector<PlacedNode>& nodes)
        : context_(context),
          nodes_(nodes),
          placed_of_(context.document.model.nodes.size(), -1),
          channels_(nodes.size()),
          shows_(nodes.size(), false) {
        for (std::size_t i = 0; i < nodes_.size(); ++i) placed_of_[nodes_[i].node] = static_cast<int>(i);
        for (std::size_t i = nodes_.size(); i-- > 0;) {  // children before parents
            shows_[i] = shows_[i] || shows_something(context.document.model.nodes[nodes_[i].node]);
            if (shows_[i] && nodes_[i].parent >= 0) shows_[static_cast<std::size_t>(nodes_[i].parent)] = true;
        }
    }

    Expected<Animation> read() {
        const auto& animations = context_.document.model.animations;
        for (std::size_t i = 0; i < animations.size(); ++i)
            if (Expected<void> done = read_animation(animations[i], element_name("animation", i, animations[i].name));
                !done)
                return tl::unexpected(done.error());
        settle();
        build();
        if (Expected<void> checked = check_reach(); !checked) return tl::unexpected(checked.error());
        return std::move(animation_);
    }

private:
    Expected<void> read_animation(const tinygltf::Animation& from, const std::string& animation) {
        float period_s = 0.0F;
        std::vector<std::pair<std::size_t, std::size_t>> read;  // placed node, channel of it
        for (std::size_t i = 0; i < from.channels.size(); ++i) {
            const tinygltf::AnimationChannel& target = from.channels[i];
            const std::string element = animation + ", channel " + std::to_string(i);
            const Expected<std::optional<std::size_t>> placed = target_of(target, element);
            if (!placed) return tl::unexpected(placed.error());
            if (!*placed) continue;
            if (target.sampler < 0 || static_cast<std::size_t>(target.sampler) >= from.samplers.size())
                return context_.error(element, "sampler " + std::to_string(target.sampler) + " does not exist");
            Expected<AnimationChannel> channel =
                read_gltf_channel(context_, from.samplers[static_cast<std::size_t>(target.sampler)],
                                  *path_of(target.target_path), element);
            if (!channel) return tl::unexpected(channel.error());
            period_s = std::max(period_s, channel->time_s.back());
            read.emplace_back(**placed, channels_[**placed].size());
            channels_[**placed].push_back(std::move(*channel));
        }
        for (const auto& [node, channel] : read) channels_[node][channel].period_s = period_s;
        return {};
    }

    /// The placed node that a channel moves; none where there is nothing to do.
    Expected<std::optional<std::size_t>> target_of(const tinygltf::AnimationChannel& target,
                                                   const std::string& element) {
        if (target.target_path == "weights") {
            context_.warn(element, "morph weights are ignored");
            return std::nullopt;
        }
        const std::optional<AnimationPath> path = path_of(target.target_path);
        if (!path) return context_.error(element, "the path \"" + target.target_path + "\" is not glTF");
        if (target.target_node < 0 || static_cast<std::size_t>(target.target_node) >= placed_of_.size())
            return context_.error(element, "node " + std::to_string(target.target_node) + " does not exist");
        const int placed = placed_of_[static_cast<std::size_t>(target.target_node)];
        if (placed < 0) return std::nullopt;
        const auto index = static_cast<std::size_t>(placed);
        if (nodes_[index].place.matrix) {
            context_.warn(element, node_name(context_, nodes_[index]) + " has a matrix and is not moved");
            return std::nullopt;
        }
        const auto& others = channels_[index];
        if (std::any_of(others.begin(), others.end(), [&](const AnimationChannel& c) { return c.path == *path; })) {
            context_.warn(element, node_name(context_, nodes_[index]) + " is moved by an earlier channel already");
            return std::nullopt;
        }
        return index;
    }

    /// Takes what does not change, and what nobody sees, into the places.
    void settle() {
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            std::vector<AnimationChannel>& channels = channels_[i];
            if (channels.empty()) continue;
            if (!shows_[i] || std::all_of(channels.begin(), channels.end(), is_constant)) {
                nodes_[i].place.matrix = at_time_0(nodes_[i].place, channels);
                channels.clear();
            }
        }
    }

    static AnimationNode node_at(const GltfPlace& place) {
        AnimationNode node;
        node.translation_m = glm::vec3(place.translation_m);
        node.rotation = glm::quat(place.rotation);
        node.scale = glm::vec3(place.scale);
        return node;
    }

    static glm::dmat4 at_time_0(const GltfPlace& place, const std::vector<AnimationChannel>& channels) {
        Animation alone;
        alone.nodes = {node_at(place)};
        alone.channels = channels;
        std::vector<glm::mat4> parent_from_node;
        pose_nodes(alone, 0.0, parent_from_node);
        return glm::dmat4(parent_from_node[0]);
    }

    void build() {
        struct Anchor {
            int node = -1;  ///< nearest of the animation at or above
            glm::dmat4 anchor_from_node = glm::dmat4(1.0);
        };
        std::vector<Anchor> anchors(nodes_.size());
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            PlacedNode& placed = nodes_[i];
            const Anchor above = placed.parent < 0 ? Anchor() : anchors[static_cast<std::size_t>(placed.parent)];
            if (!channels_[i].empty()) {
                AnimationNode node = node_at(placed.place);
                node.parent = above.node;
                node.parent_from_place = glm::mat4(above.anchor_from_node);
                placed.moved_by = add(node);
                anchors[i].node = placed.moved_by;
                for (AnimationChannel& channel : channels_[i]) add(std::move(channel), placed.moved_by);
                continue;
            }
            anchors[i] = {above.node, above.anchor_from_node * placed.place.parent_from_node()};
            if (above.node < 0 || !shows_something(context_.document.model.nodes[placed.node])) continue;
            AnimationNode node;
            node.parent = above.node;
            node.parent_from_place = glm::mat4(anchors[i].anchor_from_node);
            placed.moved_by = add(node);
        }
    }

    int add(const AnimationNode& node) {
        animation_.nodes.push_back(node);
        return static_cast<int>(animation_.nodes.size()) - 1;
    }

    void add(AnimationChannel channel, int node) {
        channel.node = node;
        animation_.duration_s = std::max(animation_.duration_s, channel.period_s);
        animation_.channels.push_back(std::move(channel));
    }

    /// No time may bring a node beyond what a float can hold.
    Expected<void> check_reach() {
        struct Reach {
            double translation = 0.0;  ///< of the node alone, then of its origin in the world
            double scale = 0.0;
        };
        std::vector<Reach> reach;
        for (const AnimationNode& node : animation_.nodes)
            reach.push_back({glm::length(glm::dvec3(node.translation_m)),
                             std::max({std::abs(node.scale.x), std::abs(node.scale.y), std::abs(node.scale.z)})});
        for (const AnimationChannel& channel : animation_.channels) {
            Reach& own = reach[static_cast<std::size_t>(channel.node)];
            const double largest = largest_value(channel);
            if (channel.path == AnimationPath::translation) own.translation = largest;
            if (channel.path == AnimationPath::scale) own.scale = largest;
            if (channel.path == AnimationPath::rotation && !(largest <= kMaxReach)) own.scale = largest;
        }
        for (std::size_t i = 0; i < reach.size(); ++i) {
            const AnimationNode& node = animation_.nodes[i];
            const Reach parent = node.parent < 0 ? Reach{0.0, 1.0} : reach[static_cast<std::size_t>(node.parent)];
            const double stretch = largest_stretch(glm::dmat3(node.parent_from_place));
            const double offset = glm::length(glm::dvec3(node.parent_from_place[3]));
            reach[i].translation = parent.translation + parent.scale * (offset + stretch * reach[i].translation);
            reach[i].scale *= parent.scale * stretch;
            if (!(reach[i].translation <= kMaxReach) || !(reach[i].scale <= kMaxReach))
                return context_.error("animations", "move nodes beyond 1e9 m or grow them beyond 1e9 times");
        }
        return {};
    }

    GltfContext& context_;
    std::vector<PlacedNode>& nodes_;
    std::vector<int> placed_of_;                           ///< by the file's node; -1: not shown
    std::vector<std::vector<AnimationChannel>> channels_;  ///< by placed node
    std::vector<bool> shows_;                              ///< by placed node: it or something below it is shown
    Animation animation_;
};

}  // namespace

Expected<Animation> read_gltf_animation(GltfContext& context, std::vector<PlacedNode>& nodes) {
    return GltfAnimationReader(context, nodes).read();
}

void pose_gltf_nodes(const Animation& animation, std::vector<PlacedNode>& nodes) {
    std::vector<glm::mat4> world_from_node;
    pose_nodes(animation, 0.0, world_from_node);
    for (PlacedNode& node : nodes) {
        if (node.moved_by < 0) continue;
        node.world_from_node = world_from_node[static_cast<std::size_t>(node.moved_by)];
        node.singular = is_singular(node.world_from_node);
    }
}

}  // namespace macula
