#include <algorithm>
#include <limits>
#include <string>

#if MACULA_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <glm/gtc/quaternion.hpp>

#include "server/kernels/camera.h"
#include "server/render/packet_shading.h"
#include "server/render/tracer.h"

namespace macula {
namespace {

static_assert(RTC_INVALID_GEOMETRY_ID == 0xFFFFFFFFU);

/// Packets that one task of the thread pool traces in a row.
constexpr std::size_t kPacketsPerTask = 64;

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

// The calls that differ between Embree 3 and 4.
void intersect(const int* valid, RTCScene scene, RTCRayHit16& rays) {
#if MACULA_EMBREE_MAJOR >= 4
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcIntersect16(valid, scene, &rays, &arguments);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid, scene, &context, &rays);
#endif
}

void occluded(const int* valid, RTCScene scene, RTCRay16& rays) {
#if MACULA_EMBREE_MAJOR >= 4
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcOccluded16(valid, scene, &rays, &arguments);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcOccluded16(valid, scene, &context, &rays);
#endif
}

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

RTCFilterFunctionN filter_of(const Material& material) {
    if (material.alpha_mask) return material.double_sided ? cut_holes : cull_and_cut;
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
    if (const RTCFilterFunctionN filter = filter_of(*shading.material)) {
        rtcSetGeometryIntersectFilterFunction(geometry, filter);
        rtcSetGeometryOccludedFilterFunction(geometry, filter);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, index);
    rtcReleaseGeometry(geometry);
    return {};
}

class EmbreeTracer final : public Tracer {
public:
    explicit EmbreeTracer(std::shared_ptr<const Scene> scene) : shading_(std::move(scene)) {}

    Expected<void> build() {
        device_.reset(rtcNewDevice(nullptr));
        if (!device_) return tl::unexpected(embree_error(nullptr, "cannot start the ray tracer"));
        scene_.reset(rtcNewScene(device_.get()));
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

    void trace(std::span<const TraceTask> tasks) const noexcept override;

    [[nodiscard]] std::string name() const override {
        return std::string("Embree ") + RTC_VERSION_STRING + ", packets of " + std::to_string(kLaneCount);
    }

private:
    void trace_packet(const TraceTask& task, const glm::mat3& world_from_eye, std::size_t first) const;

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

std::size_t packet_count(const TraceTask& task) {
    return (task.plan->trace_order.size() + kLaneCount - 1) / kLaneCount;
}

void EmbreeTracer::trace(std::span<const TraceTask> tasks) const noexcept {
    std::size_t total = 0;
    for (const TraceTask& task : tasks) {
        prepare(task);
        total += packet_count(task);
    }
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, total, kPacketsPerTask), [&](const auto& range) {
        std::size_t begin = range.begin();
        std::size_t end = range.end();
        for (const TraceTask& task : tasks) {
            const std::size_t count = packet_count(task);
            const glm::mat3 world_from_eye = glm::mat3_cast(task.view->world_from_eye.orientation);
            for (; begin < std::min(end, count); ++begin) trace_packet(task, world_from_eye, begin * kLaneCount);
            if (end <= count) return;
            begin -= count;
            end -= count;
        }
    });
}

void EmbreeTracer::trace_packet(const TraceTask& task, const glm::mat3& world_from_eye, std::size_t first) const {
    const EyeView& view = *task.view;
    const SamplePlan& plan = *task.plan;
    const auto count = static_cast<int>(std::min<std::size_t>(kLaneCount, plan.trace_order.size() - first));
    const std::uint32_t* address = plan.trace_order.data() + first;

    Lanes<float> x{};
    Lanes<float> y{};
    Lanes<int> valid{};
    for (int i = 0; i < count; ++i) {
        const SamplePosition p = plan.position[address[i]];
        x[i] = static_cast<float>(p.x_px) + 0.5F;
        y[i] = static_cast<float>(p.y_px) + 0.5F;
        valid[i] = -1;
    }
    const glm::vec4 edges(view.tangents.left, view.tangents.right, view.tangents.bottom, view.tangents.top);
    const glm::vec2 size_px(view.width_px, view.height_px);
    const glm::vec3 origin = view.world_from_eye.position_m;

    RTCRayHit16 rays;
    HitPacket hits;
    hits.origin = origin;
    MACULA_LANE_LOOP
    for (int i = 0; i < kLaneCount; ++i) {
        const glm::vec3 direction = kernels::eye_ray_direction(world_from_eye, edges, size_px, glm::vec2(x[i], y[i]));
        hits.direction.set(i, direction);
        rays.ray.org_x[i] = origin.x;
        rays.ray.org_y[i] = origin.y;
        rays.ray.org_z[i] = origin.z;
        rays.ray.dir_x[i] = direction.x;
        rays.ray.dir_y[i] = direction.y;
        rays.ray.dir_z[i] = direction.z;
        rays.ray.tnear[i] = 0.0F;
        rays.ray.tfar[i] = std::numeric_limits<float>::infinity();
        rays.ray.time[i] = 0.0F;
        rays.ray.mask[i] = 0xFFFFFFFFU;
        rays.ray.flags[i] = 0;
        rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    intersect(valid.value, scene_.get(), rays);

    for (int i = 0; i < kLaneCount; ++i) {
        hits.hit |= static_cast<LaneMask>(rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) << i;
        hits.distance[i] = rays.ray.tfar[i];
        hits.geometric_normal.x[i] = rays.hit.Ng_x[i];
        hits.geometric_normal.y[i] = rays.hit.Ng_y[i];
        hits.geometric_normal.z[i] = rays.hit.Ng_z[i];
        hits.u[i] = rays.hit.u[i];
        hits.v[i] = rays.hit.v[i];
        hits.instance[i] = rays.hit.geomID[i];
        hits.triangle[i] = rays.hit.primID[i];
    }
    SurfacePacket surfaces;
    find_surfaces(shading_, hits, surfaces);

    for (const ShadingLight& light : shading_.lights()) {
        LightPacket lighting;
        shine(light.light, surfaces, lighting);
        LaneMask reached = lighting.lanes;
        if (light.casts_shadow && reached != 0) {
            const bool local = light.light.position.w > 0.0F;
            RTCRay16 shadow;
            for (int i = 0; i < kLaneCount; ++i) {
                shadow.org_x[i] = surfaces.position.x[i];
                shadow.org_y[i] = surfaces.position.y[i];
                shadow.org_z[i] = surfaces.position.z[i];
                shadow.dir_x[i] = lighting.to_light.x[i];
                shadow.dir_y[i] = lighting.to_light.y[i];
                shadow.dir_z[i] = lighting.to_light.z[i];
                shadow.tnear[i] = 0.0F;
                shadow.tfar[i] = local ? 1.0F : std::numeric_limits<float>::infinity();
                shadow.time[i] = 0.0F;
                shadow.mask[i] = 0xFFFFFFFFU;
                shadow.flags[i] = 0;
                valid[i] = ((reached >> i) & 1U) != 0 ? -1 : 0;
            }
            occluded(valid.value, scene_.get(), shadow);
            // Embree sets tfar of occluded rays to minus infinity.
            for (int i = 0; i < kLaneCount; ++i) reached &= ~(static_cast<LaneMask>(shadow.tfar[i] < 0.0F) << i);
        }
        add_light(lighting, reached, surfaces);
    }

    Lanes<std::uint32_t> color;
    encode(surfaces, shading_.scene().exposure, color);
    Samples& samples = *task.samples;
    for (int i = 0; i < count; ++i) {
        const std::uint32_t a = address[i];
        const bool hit = ((hits.hit >> i) & 1U) != 0;
        samples.color[a] = color[i];
        samples.inverse_depth_per_m[a] = hit ? 1.0F / hits.distance[i] : 0.0F;
        samples.object_id[a] = hit ? hits.instance[i] + 1 : 0;
        if (samples.keep_radiance) samples.radiance[a] = surfaces.radiance[i];
    }
}

}  // namespace

Expected<std::unique_ptr<Tracer>> make_embree_tracer(std::shared_ptr<const Scene> scene) {
    auto tracer = std::make_unique<EmbreeTracer>(std::move(scene));
    auto built = tracer->build();
    if (!built) return tl::unexpected(built.error());
    return tracer;
}

}  // namespace macula
