#pragma once

// Embree, and the calls that differ between its versions 3 and 4. For embree_tracer.cpp and its benchmark only.

#if MACULA_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace macula {

/// Nearest hits of the lanes whose `valid` is -1; rays that lie close together.
inline void intersect_coherent(const int* valid, RTCScene scene, RTCRayHit16& rays) {
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

/// Sets tfar to minus infinity in valid lanes where anything is hit.
inline void occluded_coherent(const int* valid, RTCScene scene, RTCRay16& rays) {
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

}  // namespace macula
