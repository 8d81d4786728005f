#include "server/render/embree_scene.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "server/render/ray_filters.h"

namespace macula {
namespace {

static_assert(RTC_INVALID_GEOMETRY_ID == 0xFFFFFFFFU);

/// Poses that are kept for calls to come: twice the sessions that a server holds by default.
constexpr std::size_t kKeptPoses = 8;

Error embree_error(RTCDevice device, const std::string& what) {
    return {ErrorCode::internal,
            what + ": Embree error " + std::to_string(static_cast<int>(rtcGetDeviceError(device)))};
}

bool count_bytes(void* counter, ssize_t bytes, bool /*post*/) {
    *static_cast<std::atomic<std::ptrdiff_t>*>(counter) += bytes;
    return true;
}

InstancePlace place_of(const glm::mat4& world_from_mesh) {
    InstancePlace place;
    place.world_from_mesh = glm::mat3(world_from_mesh);
    place.normal_matrix = glm::transpose(glm::inverse(place.world_from_mesh));
    const float determinant = glm::determinant(place.world_from_mesh);
    place.handedness = determinant < 0.0F ? -1.0F : 1.0F;
    place.size = std::abs(determinant);
    // The Frobenius norm bounds the largest singular value.
    const glm::mat3& m = place.world_from_mesh;
    place.stretch = std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
    return place;
}

/// Adds a tree under a transform; its own geometry ids stay what hits report.
void add_tree(RTCDevice device, RTCScene top, RTCScene tree, const glm::mat4& world_from_tree) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, tree);
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &world_from_tree[0][0]);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(top, geometry);
    rtcReleaseGeometry(geometry);
}

}  // namespace

Expected<Tree> EmbreeScene::new_tree(bool changes) const {
    Tree tree(rtcNewScene(device_.get()));
    if (!tree) return tl::unexpected(embree_error(device_.get(), "cannot begin the ray tracer's tree"));
    // Watertight at shared edges. Without it, tracing is some 15 % faster.
    rtcSetSceneFlags(tree.get(), RTC_SCENE_FLAG_ROBUST);
    if (changes) rtcSetSceneBuildQuality(tree.get(), RTC_BUILD_QUALITY_LOW);
    return tree;
}

Expected<void> EmbreeScene::add_geometry(RTCScene tree, std::size_t index) {
    const ShadingInstance& shading = shading_.instances()[index];
    const Instance& instance = shading_.scene().instances[index];
    const Mesh& mesh = shading_.scene().meshes[static_cast<std::size_t>(instance.mesh)];
    const glm::mat4 tree_from_mesh = shading.moves ? glm::mat4(1.0F) : instance.world_from_mesh;
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* position = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                 3 * sizeof(float), mesh.position_m.size()));
    if (position == nullptr) {
        rtcReleaseGeometry(geometry);
        return tl::unexpected(embree_error(device_.get(), "cannot store the vertices of mesh '" + mesh.name + "'"));
    }
    for (const glm::vec3& p : mesh.position_m) {
        const glm::vec3 placed(tree_from_mesh * glm::vec4(p, 1.0F));
        *position++ = placed.x;
        *position++ = placed.y;
        *position++ = placed.z;
    }
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, shading.triangle, 0,
                               sizeof(glm::uvec3), mesh.triangle.size());
    rtcSetGeometryUserData(geometry, const_cast<ShadingInstance*>(&shading));
    if (const RTCFilterFunctionN filter = sight_filter(shading))
        rtcSetGeometryIntersectFilterFunction(geometry, filter);
    if (const RTCFilterFunctionN filter = light_filter(shading)) rtcSetGeometryOccludedFilterFunction(geometry, filter);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(tree, geometry, static_cast<unsigned>(index));
    rtcReleaseGeometry(geometry);
    return {};
}

Expected<void> EmbreeScene::build() {
    device_.reset(rtcNewDevice(nullptr));
    if (!device_) return tl::unexpected(embree_error(nullptr, "cannot start the ray tracer"));
    rtcSetDeviceMemoryMonitorFunction(device_.get(), count_bytes, &bytes_);
    auto still = new_tree(false);
    if (!still) return tl::unexpected(still.error());
    still_ = std::move(*still);
    const std::size_t count = shading_.instances().size();
    moving_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        RTCScene tree = still_.get();
        if (shading_.instances()[i].moves) {
            auto own = new_tree(false);
            if (!own) return tl::unexpected(own.error());
            moving_[i] = std::move(*own);
            tree = moving_[i].get();
        }
        if (auto added = add_geometry(tree, i); !added) return added;
        if (moving_[i]) rtcCommitScene(tree);
    }
    rtcCommitScene(still_.get());
    if (const RTCError error = rtcGetDeviceError(device_.get()); error != RTC_ERROR_NONE)
        return fail(ErrorCode::internal,
                    "cannot build the ray tracer's tree: Embree error " + std::to_string(static_cast<int>(error)));
    auto rest = std::make_shared<ScenePose>();
    rest->tree = still_.get();
    rest->lights = shading_.lights();
    rest_ = std::move(rest);
    return {};
}

std::shared_ptr<const ScenePose> EmbreeScene::make_pose(double time_s) const {
    const Scene& scene = shading_.scene();
    auto top = new_tree(true);
    if (!top) return rest_;  // out of memory: what stands still is shown
    auto pose = std::make_shared<ScenePose>();
    pose->time_s = time_s;
    pose->owned = std::move(*top);
    pose->tree = pose->owned.get();
    pose->places.resize(scene.instances.size());
    std::vector<glm::mat4> world_from_node;
    pose_nodes(scene.animation, time_s, world_from_node);
    add_tree(device_.get(), pose->tree, still_.get(), glm::mat4(1.0F));
    for (std::size_t i = 0; i < moving_.size(); ++i) {
        if (!moving_[i]) continue;
        const glm::mat4& world_from_mesh = world_from_node[static_cast<std::size_t>(scene.instances[i].node)];
        pose->places[i] = place_of(world_from_mesh);
        add_tree(device_.get(), pose->tree, moving_[i].get(), world_from_mesh);
    }
    rtcCommitScene(pose->tree);
    pose->lights = shading_.lights_at(world_from_node);
    return pose;
}

std::shared_ptr<const ScenePose> EmbreeScene::at(double time_s) const {
    if ((needs_ & kNeedAnimation) == 0) return rest_;
    const auto find = [&]() -> std::shared_ptr<const ScenePose> {
        for (const auto& pose : poses_) {
            if (pose->time_s == time_s) return pose;
        }
        return nullptr;
    };
    {
        const std::scoped_lock lock(poses_mutex_);
        if (auto pose = find()) return pose;
    }
    // Not under the lock: other sessions trace on. Two that begin the same time at once both build it.
    auto made = make_pose(time_s);
    const std::scoped_lock lock(poses_mutex_);
    if (auto pose = find()) return pose;
    if (poses_.size() == kKeptPoses) poses_.erase(poses_.begin());
    poses_.push_back(made);
    return made;
}

}  // namespace macula
