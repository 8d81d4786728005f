#pragma once

// The rays of a tracer, recorded, and Embree alone on the very same rays: what tracing is measured against.

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "scenes/scene.h"
#include "server/render/embree_calls.h"
#include "server/render/lanes.h"
#include "server/render/tracer.h"

namespace macula::test {

/// The scene's triangles in Embree, without filters.
inline RTCScene bare_scene(RTCDevice device, const Scene& scene) {
    RTCScene result = rtcNewScene(device);
    rtcSetSceneFlags(result, RTC_SCENE_FLAG_ROBUST);
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* position = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.position_m.size()));
        for (const glm::vec3& p : mesh.position_m) *position++ = instance.world_from_mesh * glm::vec4(p, 1.0F);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangle.data(), 0,
                                   sizeof(glm::uvec3), mesh.triangle.size());
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(result, geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(result);
    return result;
}

/// Sixteen rays as a RayTap was told.
struct RecordedPacket {
    RayTap::Kind kind;
    Lanes<int> valid;
    Lanes3 origin;
    Lanes3 direction;
    Lanes<float> far;
};

/// Keeps every packet, in the order in which a thread traced them.
class Recorder final : public RayTap {
public:
    void packet(Kind kind, const int* valid, const float* origin, const float* direction, const float* far) override {
        if (!recording.load(std::memory_order_relaxed)) return;
        RecordedPacket& packet = packets_.local().emplace_back();
        packet.kind = kind;
        std::copy_n(valid, kLaneCount, packet.valid.value);
        const auto copy = [](const float* from, Lanes3& to) {
            std::copy_n(from, kLaneCount, to.x.value);
            std::copy_n(from + kLaneCount, kLaneCount, to.y.value);
            std::copy_n(from + 2 * static_cast<std::ptrdiff_t>(kLaneCount), kLaneCount, to.z.value);
        };
        copy(origin, packet.origin);
        copy(direction, packet.direction);
        std::copy_n(far, kLaneCount, packet.far.value);
    }
    [[nodiscard]] std::vector<RecordedPacket> take() {
        std::vector<RecordedPacket> all;
        for (auto& packets : packets_) {
            all.insert(all.end(), packets.begin(), packets.end());
            packets = {};
        }
        return all;
    }

    std::atomic<bool> recording = false;

private:
    tbb::enumerable_thread_specific<std::vector<RecordedPacket>> packets_;
};

/// Traces recorded packets with nothing but Embree.
class BareEmbree {
public:
    BareEmbree(const Scene& scene, std::vector<RecordedPacket> packets)
        : device_(rtcNewDevice(nullptr)), scene_(bare_scene(device_, scene)), packets_(std::move(packets)) {}
    BareEmbree(const BareEmbree&) = delete;
    BareEmbree& operator=(const BareEmbree&) = delete;
    ~BareEmbree() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }

    /// Returns the sum of hits, so that nothing can be left out.
    [[nodiscard]] std::uint64_t trace() const {
        std::atomic<std::uint64_t> total = 0;
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, packets_.size(), 192), [&](const auto& range) {
            std::uint64_t sum = 0;
            for (std::size_t k = range.begin(); k < range.end(); ++k) sum += trace(packets_[k]);
            total += sum;
        });
        return total;
    }

private:
    static void fill(RTCRay16& ray, const RecordedPacket& packet) {
        for (int i = 0; i < kLaneCount; ++i) {
            ray.org_x[i] = packet.origin.x[i];
            ray.org_y[i] = packet.origin.y[i];
            ray.org_z[i] = packet.origin.z[i];
            ray.dir_x[i] = packet.direction.x[i];
            ray.dir_y[i] = packet.direction.y[i];
            ray.dir_z[i] = packet.direction.z[i];
            ray.tnear[i] = 0.0F;
            ray.tfar[i] = packet.far[i];
            ray.time[i] = 0.0F;
            ray.mask[i] = 0xFFFFFFFFU;
            ray.flags[i] = 0;
        }
    }
    [[nodiscard]] std::uint64_t trace(const RecordedPacket& packet) const {
        std::uint64_t sum = 0;
        if (packet.kind == RayTap::Kind::shadow) {
            RTCRay16 ray;
            fill(ray, packet);
            occluded_coherent(packet.valid.value, scene_, ray);
            for (int i = 0; i < kLaneCount; ++i) sum += ray.tfar[i] < 0.0F ? 1U : 0U;
        } else {
            RTCRayHit16 rays;
            fill(rays.ray, packet);
            for (int i = 0; i < kLaneCount; ++i) rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
            intersect_coherent(packet.valid.value, scene_, rays);
            for (int i = 0; i < kLaneCount; ++i) sum += rays.hit.primID[i];
        }
        return sum;
    }

    RTCDevice device_;
    RTCScene scene_;
    std::vector<RecordedPacket> packets_;
};

}  // namespace macula::test
