#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <glm/gtc/quaternion.hpp>

#include "protocol/message/byte_map.h"
#include "server/service/motion_finder.h"
#include "tests/support/moving_scene.h"

namespace macula::test {

/// A textured square with an edge of 1 m, in closed form, that an animation moves before a textured wall 4 m ahead.
class AnimatedSquare {
public:
    explicit AnimatedSquare(Animation animation) {
        Scene scene;
        scene.instances.resize(1);
        scene.instances[0].node = 0;
        scene.animation = std::move(animation);
        scene_ = std::make_shared<const Scene>(std::move(scene));
    }

    [[nodiscard]] const std::shared_ptr<const Scene>& scene() const { return scene_; }

    /// The scene as it stands at a time.
    [[nodiscard]] SceneRay at(double time_s) const {
        std::vector<glm::mat4> world_from_node;
        pose_nodes(scene_->animation, time_s, world_from_node);
        return [node_from_world = glm::inverse(world_from_node[0])](const glm::vec3& from, const glm::vec3& along) {
            const glm::vec3 origin(node_from_world * glm::vec4(from, 1.0F));
            const glm::vec3 direction(node_from_world * glm::vec4(along, 0.0F));
            const float inverse = -direction.z / origin.z;
            const glm::vec3 p = origin + direction / inverse;
            if (inverse > 0.0F && std::max(std::abs(p.x), std::abs(p.y)) < 0.5F) {
                return Seen{glm::vec3(1.0F, 0.8F, 0.5F) * (0.55F + 0.4F * std::cos(70.0F * (p.x * p.x + p.y * p.y))) *
                                (p.x > 0.0F && p.y > 0.0F ? 0.5F : 1.0F),
                            inverse, 1};
            }
            const float wall = -along.z / (from.z + 4.0F);
            const glm::vec3 q = from + along / wall;
            const int check = (static_cast<int>(std::floor(4.0F * q.x)) + static_cast<int>(std::floor(4.0F * q.y))) % 2;
            return Seen{glm::vec3(0.3F, 0.5F, 0.7F) * (check == 0 ? 0.4F : 1.0F) *
                            (0.8F + 0.2F * std::sin(25.0F * q.x) * std::sin(31.0F * q.y)),
                        wall, 0};
        };
    }

private:
    std::shared_ptr<const Scene> scene_;
};

/// Its frames as a server would make them, with what they say about motion.
class AnimatedView {
public:
    AnimatedView(const Display& display, std::optional<double> share, const AnimatedSquare& square)
        : square_(square), view_(display, share), finder_(square.scene()) {}

    /// Frame number `index` at a time, whose map and list are valid until the next call.
    NewFrame frame(int index, const Pose& world_from_eye, double time_s) {
        view_.scene = square_.at(time_s);
        NewFrame made = view_.frame(index, world_from_eye);
        finder_.find(time_s, {view_.plan, view_.plan}, {view_.samples, view_.samples}, view_.full_depth, message_);
        made.display_time_ns = static_cast<std::int64_t>(1e9 * time_s);
        made.moving = message_.moving;
        map_ = Image<std::uint8_t>(view_.depth.width_px, view_.depth.height_px);
        if (!message_.moving.empty()) map_.texels = unpack_map(message_.moving_map, map_.texels.size()).value();
        made.moving_map = &map_;
        return made;
    }
    /// What should be seen: 16 rays a pixel.
    [[nodiscard]] ColorImage truth(const Pose& world_from_eye, double time_s) const {
        return reference_picture(view_.view(world_from_eye), square_.at(time_s));
    }
    /// Bytes that motion adds to the last frame.
    [[nodiscard]] std::size_t motion_bytes() const { return message_.moving.size() * 100 + message_.moving_map.size(); }
    /// Whether a pixel shows the square at a time.
    [[nodiscard]] bool covered(const Pose& world_from_eye, double time_s, int x, int y) const {
        return see(square_.at(time_s), view_.view(world_from_eye), static_cast<float>(x) + 0.5F,
                   static_cast<float>(y) + 0.5F)
                   .object != 0;
    }

private:
    AnimatedSquare square_;
    FoveatedView view_;
    MotionFinder finder_;
    Frame message_;
    Image<std::uint8_t> map_;
};

}  // namespace macula::test
