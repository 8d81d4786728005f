#pragma once

#include <cstdint>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace macula {

/// What a channel moves.
enum class AnimationPath : std::uint8_t { translation, rotation, scale };
enum class Interpolation : std::uint8_t { step, linear, cubic_spline };

/// One animated property of a node (glTF 2.0, 3.11 and Appendix C).
struct AnimationChannel {
    int node = 0;  ///< into Animation::nodes; at most one channel per node and path
    AnimationPath path = AnimationPath::translation;
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> time_s;     ///< strictly increasing, not negative, at least one
    std::vector<glm::vec4> value;  ///< one per time, with cubic_spline in-tangent, value, out-tangent; rotations xyzw
    /// After which it begins again: where its animation's longest channel ends, so that channels of one animation stay
    /// together. 0: it holds its first value.
    float period_s = 0.0F;
};

/// A node's place relative to its parent: parent_from_place * translation * rotation * scale.
struct AnimationNode {
    int parent = -1;  ///< lies before it in Animation::nodes; -1: the world
    glm::vec3 translation_m = glm::vec3(0.0F);
    glm::quat rotation = glm::quat(1.0F, 0.0F, 0.0F, 0.0F);
    glm::vec3 scale = glm::vec3(1.0F);
    /// Between the parent and the translation; what never moves, as a file's matrices, is here.
    glm::mat4 parent_from_place = glm::mat4(1.0F);
};

/// Motion of a scene's nodes: all animations of a file at once, each repeated with its own period. A value.
struct Animation {
    std::vector<AnimationNode> nodes;
    std::vector<AnimationChannel> channels;
    float duration_s = 0.0F;  ///< longest period; 0 where nothing moves

    [[nodiscard]] bool present() const { return !channels.empty(); }
};

/// Smallest magnitude of an animated scale, sign kept: objects that shrink to nothing stay there, invisibly small, and
/// their transforms invertible.
inline constexpr float kSmallestAnimatedScale = 1e-4F;

/// Places of all nodes at a time, which may be any, also negative; one matrix per node, `world_from_node`, reused.
/// Before its first key and after its last a channel holds the value there. Rotations turn the shorter way.
/// Safe to call from several threads with different outputs.
void pose_nodes(const Animation& animation, double time_s, std::vector<glm::mat4>& world_from_node);

}  // namespace macula
