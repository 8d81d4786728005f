#include <algorithm>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include <glm/gtc/quaternion.hpp>

#include "server/kernels/camera.h"
#include "server/render/embree_calls.h"
#include "server/render/packet_shading.h"
#include "server/render/parallel_ranges.h"
#include "server/render/tracer.h"

namespace macula {
namespace {

static_assert(RTC_INVALID_GEOMETRY_ID == 0xFFFFFFFFU);

/// Packets that one task of the thread pool traces in a row.
constexpr int kPacketsPerTask = 64;

struct DeviceDelete {
    using pointer = RTCDevice;
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneDelete {
    using pointer = RTCScene;
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDevice, DeviceDelete>;
using EmbreeScene = std::unique_ptr<RTCScene, SceneDelete>;

/// Rejects hits on the back of single-sided surfaces.
void cull_back_faces(const RTCFilterFunctionNArguments* args) {
    for (unsigned i = 0; i < args->N; ++i) {
        const float facing = RTCRayN_dir_x(args->ray, args->N, i) * RTCHitN_Ng_x(args->hit, args->N, i) +
                             RTCRayN_dir_y(args->ray, args->N, i) * RTCHitN_Ng_y(args->hit, args->N, i) +
                             RTCRayN_dir_z(args->ray, args->N, i) * RTCHitN_Ng_z(args->hit, args->N, i);
        args->valid[i] = facing > 0.0F ? 0 : args->valid[i];
    }
}

/// Rejects hits in holes of alpha-masked surfaces.
void cut_holes(const RTCFilterFunctionNArguments* args) {
    const auto& instance = *static_cast<const ShadingInstance*>(args->geometryUserPtr);
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] == 0) continue;
        const glm::vec4 color = base_color_at(instance, RTCHitN_primID(args->hit, args->N, i),
                                              RTCHitN_u(args->hit, args->N, i), RTCHitN_v(args->hit, args->N, i));
        if (color.w < instance.material->alpha_cutoff) args->valid[i] = 0;
    }
}

void cull_and_cut(const RTCFilterFunctionNArguments* args) {
    cull_back_faces(args);
    cut_holes(args);
}

/// For rays that look. To shadow rays both sides of any surface are opaque, and only holes matter.
RTCFilterFunctionN filter_of(const Material& material) {
    if (material.alpha_mode == AlphaMode::mask) return material.double_sided ? cut_holes : cull_and_cut;
    return material.double_sided ? nullptr : cull_back_faces;
}

Error embree_error(RTCDevice device, const std::string& what) {
    return {ErrorCode::internal,
            what + ": Embree error " + std::to_string(static_cast<int>(rtcGetDeviceError(device)))};
}

/// Adds an instance in world space. Its geometry id is its index.
Expected<void> add_geometry(RTCDevice device, RTCScene scene, const Instance& instance, const Mesh& mesh,
                            const ShadingInstance& shading, unsigned index) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* position = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                 3 * sizeof(float), mesh.position_m.size()));
    if (position == nullptr) {
        rtcReleaseGeometry(geometry);
        return tl::unexpected(embree_error(device, "cannot store the vertices of mesh '" + mesh.name + "'"));
    }
    for (const glm::vec3& p : mesh.position_m) {
        const glm::vec3 world(instance.world_from_mesh * glm::vec4(p, 1.0F));
        *position++ = world.x;
        *position++ = world.y;
        *position++ = world.z;
    }
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, shading.triangle, 0,
                               sizeof(glm::uvec3), mesh.triangle.size());
    rtcSetGeometryUserData(geometry, const_cast<ShadingInstance*>(&shading));
    const Material& material = *shading.material;
    if (const RTCFilterFunctionN filter = filter_of(material)) rtcSetGeometryIntersectFilterFunction(geometry, filter);
    if (material.alpha_mode == AlphaMode::mask) rtcSetGeometryOccludedFilterFunction(geometry, cut_holes);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, index);
    rtcReleaseGeometry(geometry);
    return {};
}

/// An eye as its rays need it.
struct Camera {
    explicit Camera(const EyeView& view)
        : world_from_eye(glm::mat3_cast(view.world_from_eye.orientation)),
          origin(view.world_from_eye.position_m),
          edges(view.tangents.left, view.tangents.right, view.tangents.bottom, view.tangents.top),
          size_px(view.width_px, view.height_px) {}

    glm::mat3 world_from_eye;
    glm::vec3 origin;
    glm::vec4 edges;
    glm::vec2 size_px;
};

/// Embree's way to say which lanes take part.
Lanes<int> valid_lanes(LaneMask lanes) {
    Lanes<int> valid;
    MACULA_LANE_LOOP
    for (int i = 0; i < kLaneCount; ++i) valid[i] = -static_cast<int>((lanes >> i) & 1U);
    return valid;
}

void set_ray(RTCRay16& rays, int lane, const glm::vec3& origin, const glm::vec3& direction, float far) {
    rays.org_x[lane] = origin.x;
    rays.org_y[lane] = origin.y;
    rays.org_z[lane] = origin.z;
    rays.dir_x[lane] = direction.x;
    rays.dir_y[lane] = direction.y;
    rays.dir_z[lane] = direction.z;
    rays.tnear[lane] = 0.0F;
    rays.tfar[lane] = far;
    rays.time[lane] = 0.0F;
    rays.mask[lane] = 0xFFFFFFFFU;
    rays.flags[lane] = 0;
}

/// Rays through the pixels of up to 16 addresses. Lanes without an address get rays too, which are not traced.
void aim(const Camera& camera, const SamplePlan& plan, std::span<const std::uint32_t> addresses, RTCRayHit16& rays,
         HitPacket& hits) {
    Lanes<float> x{};
    Lanes<float> y{};
    for (int i = 0; i < static_cast<int>(addresses.size()); ++i) {
        const SamplePosition p = plan.position[addresses[static_cast<std::size_t>(i)]];
        x[i] = static_cast<float>(p.x_px) + 0.5F;
        y[i] = static_cast<float>(p.y_px) + 0.5F;
    }
    hits.origin = camera.origin;
    MACULA_LANE_LOOP
    for (int i = 0; i < kLaneCount; ++i) {
        const glm::vec3 direction =
            kernels::eye_ray_direction(camera.world_from_eye, camera.edges, camera.size_px, glm::vec2(x[i], y[i]));
        hits.direction.set(i, direction);
        set_ray(rays.ray, i, camera.origin, direction, std::numeric_limits<float>::infinity());
        rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
}

void read_hits(const RTCRayHit16& rays, HitPacket& hits) {
    for (int i = 0; i < kLaneCount; ++i)
        hits.hit |= static_cast<LaneMask>(rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) << i;
    MACULA_LANE_LOOP
    for (int i = 0; i < kLaneCount; ++i) {
        hits.distance[i] = rays.ray.tfar[i];
        hits.geometric_normal.x[i] = rays.hit.Ng_x[i];
        hits.geometric_normal.y[i] = rays.hit.Ng_y[i];
        hits.geometric_normal.z[i] = rays.hit.Ng_z[i];
        hits.u[i] = rays.hit.u[i];
        hits.v[i] = rays.hit.v[i];
        hits.instance[i] = rays.hit.geomID[i];
        hits.triangle[i] = rays.hit.primID[i];
    }
}

void store(const HitPacket& hits, const SurfacePacket& surfaces, float exposure,
           std::span<const std::uint32_t> addresses, Samples& samples) {
    Lanes<std::uint32_t> color;
    Lanes<std::uint32_t> object_id;
    Lanes<float> inverse_depth_per_m;
    encode(surfaces, exposure, color);
    MACULA_LANE_LOOP
    for (int i = 0; i < kLaneCount; ++i) {
        const bool hit = ((hits.hit >> i) & 1U) != 0;
        inverse_depth_per_m[i] = hit ? 1.0F / hits.distance[i] : 0.0F;
        object_id[i] = hit ? hits.instance[i] + 1U : 0U;
    }
    for (int i = 0; i < static_cast<int>(addresses.size()); ++i) {
        const std::uint32_t address = addresses[static_cast<std::size_t>(i)];
        samples.color[address] = color[i];
        samples.inverse_depth_per_m[address] = inverse_depth_per_m[i];
        samples.object_id[address] = object_id[i];
    }
    if (!samples.keep_radiance) return;
    for (int i = 0; i < static_cast<int>(addresses.size()); ++i)
        samples.radiance[addresses[static_cast<std::size_t>(i)]] = surfaces.radiance[i];
}

class EmbreeTracer final : public Tracer {
public:
    explicit EmbreeTracer(std::shared_ptr<const Scene> scene) : shading_(std::move(scene)) {}

    Expected<void> build() {
        device_.reset(rtcNewDevice(nullptr));
        if (!device_) return tl::unexpected(embree_error(nullptr, "cannot start the ray tracer"));
        scene_.reset(rtcNewScene(device_.get()));
        // Watertight at shared edges. Without it, tracing is some 15 % faster.
        rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
        const Scene& scene = shading_.scene();
        for (std::size_t i = 0; i < scene.instances.size(); ++i) {
            const Instance& instance = scene.instances[i];
            const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
            auto added = add_geometry(device_.get(), scene_.get(), instance, mesh, shading_.instances()[i],
                                      static_cast<unsigned>(i));
            if (!added) return added;
        }
        rtcCommitScene(scene_.get());
        if (const RTCError error = rtcGetDeviceError(device_.get()); error != RTC_ERROR_NONE)
            return fail(ErrorCode::internal,
                        "cannot build the ray tracer's tree: Embree error " + std::to_string(static_cast<int>(error)));
        return {};
    }

    TraceCounts trace(std::span<const TraceTask> tasks, double time_s) const noexcept override;

    [[nodiscard]] std::string name() const override {
        return std::string("Embree ") + RTC_VERSION_STRING + ", packets of " + std::to_string(kLaneCount);
    }
    [[nodiscard]] std::size_t memory_bytes() const override { return shading_.memory_bytes(); }

private:
    /// Traces and shades the packet that begins at entry `first` of the plan's order.
    void trace_packet(const TraceTask& task, const Camera& camera, std::size_t first) const;
    /// Lanes of `light` in whose way nothing stands.
    [[nodiscard]] LaneMask unshadowed(const SurfacePacket& surfaces, const LightPacket& light, bool local) const;

    ShadingScene shading_;
    Device device_;
    EmbreeScene scene_;
};

void prepare(const TraceTask& task) {
    const std::size_t count = task.plan->address_count();
    Samples& samples = *task.samples;
    samples.color.resize(count);
    samples.inverse_depth_per_m.resize(count);
    samples.object_id.resize(count);
    if (samples.keep_radiance) samples.radiance.resize(count);
    for (const std::uint32_t address : task.plan->untraced) {
        samples.color[address] = 0xFF000000U;
        samples.inverse_depth_per_m[address] = -1.0F;
        samples.object_id[address] = 0;
        if (samples.keep_radiance) samples.radiance[address] = glm::vec3(0.0F);
    }
}

int packet_count(const TraceTask& task) {
    return static_cast<int>((task.plan->trace_order.size() + kLaneCount - 1) / kLaneCount);
}

TraceCounts EmbreeTracer::trace(std::span<const TraceTask> tasks, double /*time_s*/) const noexcept {
    int total = 0;
    for (const TraceTask& task : tasks) {
        prepare(task);
        total += packet_count(task);
    }
    parallel_ranges(0, total, kPacketsPerTask, [&](int begin, int end) {
        for (const TraceTask& task : tasks) {
            const int count = packet_count(task);
            const Camera camera(*task.view);
            for (; begin < std::min(end, count); ++begin)
                trace_packet(task, camera, static_cast<std::size_t>(begin) * kLaneCount);
            if (end <= count) return;
            begin -= count;
            end -= count;
        }
    });
    return {};
}

void EmbreeTracer::trace_packet(const TraceTask& task, const Camera& camera, std::size_t first) const {
    const SamplePlan& plan = *task.plan;
    const std::span<const std::uint32_t> addresses =
        std::span(plan.trace_order).subspan(first, std::min<std::size_t>(kLaneCount, plan.trace_order.size() - first));
    RTCRayHit16 rays;
    HitPacket hits;
    aim(camera, plan, addresses, rays, hits);
    intersect_coherent(valid_lanes((1U << addresses.size()) - 1U).value, scene_.get(), rays);
    read_hits(rays, hits);

    SurfacePacket surfaces;
    find_surfaces(shading_, hits, surfaces);
    for (const ShadingLight& light : shading_.lights()) {
        LightPacket lighting;
        shine(light.light, surfaces, lighting);
        if (lighting.lanes == 0) continue;
        const bool local = light.light.position.w > 0.0F;
        add_light(lighting, light.casts_shadow ? unshadowed(surfaces, lighting, local) : lighting.lanes, surfaces);
    }
    store(hits, surfaces, shading_.scene().exposure, addresses, *task.samples);
}

LaneMask EmbreeTracer::unshadowed(const SurfacePacket& surfaces, const LightPacket& light, bool local) const {
    RTCRay16 rays;
    const float far = local ? 1.0F : std::numeric_limits<float>::infinity();
    MACULA_LANE_LOOP
    for (int i = 0; i < kLaneCount; ++i) set_ray(rays, i, surfaces.position[i], light.to_light[i], far);
    occluded_coherent(valid_lanes(light.lanes).value, scene_.get(), rays);
    LaneMask free = 0;
    for (int i = 0; i < kLaneCount; ++i) free |= static_cast<LaneMask>(rays.tfar[i] >= 0.0F) << i;
    return free & light.lanes;  // Embree sets tfar of occluded rays to minus infinity
}

}  // namespace

Expected<std::unique_ptr<Tracer>> make_embree_tracer(std::shared_ptr<const Scene> scene,
                                                     const TracerOptions& /*options*/, RayTap* /*tap*/) {
    auto tracer = std::make_unique<EmbreeTracer>(std::move(scene));
    auto built = tracer->build();
    if (!built) return tl::unexpected(built.error());
    return tracer;
}

}  // namespace macula
