#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

#include "protocol/base/error.h"
#include "server/render/embree_calls.h"
#include "server/render/shading_scene.h"

namespace macula {

struct DeviceDelete {
    using pointer = RTCDevice;
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct TreeDelete {
    using pointer = RTCScene;
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDevice, DeviceDelete>;
using Tree = std::unique_ptr<RTCScene, TreeDelete>;

/// Where a moving instance is. Of one that stands still, nothing is kept: its normals are in world space.
struct InstancePlace {
    glm::mat3 world_from_mesh = glm::mat3(1.0F);  ///< of directions
    glm::mat3 normal_matrix = glm::mat3(1.0F);
    float handedness = 1.0F;  ///< -1: the placement mirrors

    /// Normal of a front in world space, as long as the cross product of the placed triangle's edges.
    [[nodiscard]] glm::vec3 front_normal(const glm::vec3& in_mesh) const { return normal_matrix * in_mesh * size; }
    float size = 1.0F;     ///< by which volumes grow
    float stretch = 1.0F;  ///< by which lengths grow at most
};

/// A scene at one time. Constant.
struct ScenePose {
    double time_s = 0.0;
    RTCScene tree = nullptr;            ///< geometry ids are instance indices
    Tree owned;                         ///< `tree`, where it is of this time alone
    std::vector<InstancePlace> places;  ///< by instance index; empty where nothing moves
    std::vector<ShadingLight> lights;   ///< those of the shading scene, in its order
};

/// Embree's trees of a scene. What stands still is one tree in world space. Where something moves, each moving instance
/// has a tree in mesh space, and for each time a small tree over the trees is built.
class EmbreeScene {
public:
    /// `needs` as in Need: with kNeedAnimation the trees are those of a scene in which something moves.
    EmbreeScene(const ShadingScene& shading, std::uint32_t needs) : shading_(shading), needs_(needs) {}
    /// Errors: `internal` with Embree's code.
    Expected<void> build();
    /// The scene at a time. Several threads at once, with different times; both eyes and sessions that share a time
    /// share a pose.
    [[nodiscard]] std::shared_ptr<const ScenePose> at(double time_s) const;
    /// Bytes that Embree holds.
    [[nodiscard]] std::size_t memory_bytes() const { return static_cast<std::size_t>(bytes_.load()); }

private:
    Expected<void> add_geometry(RTCScene tree, std::size_t index);
    Expected<Tree> new_tree(bool changes) const;
    [[nodiscard]] std::shared_ptr<const ScenePose> make_pose(double time_s) const;

    const ShadingScene& shading_;
    std::uint32_t needs_;
    std::atomic<std::ptrdiff_t> bytes_ = 0;  // outlives the device, which reports to it
    Device device_;
    Tree still_;
    std::vector<Tree> moving_;  ///< by instance index; null for those that stand still
    std::shared_ptr<const ScenePose> rest_;
    /// The last few poses, the newest at the end: sessions display at slightly different times.
    mutable std::mutex poses_mutex_;
    mutable std::vector<std::shared_ptr<const ScenePose>> poses_;
};

}  // namespace macula
