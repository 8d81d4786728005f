#pragma once

// Embree, and the calls that differ between its versions 3 and 4.

#if MACULA_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace macula {

#if MACULA_EMBREE_MAJOR >= 4
using QueryContext = RTCRayQueryContext;
#else
using QueryContext = RTCIntersectContext;
#endif

/// What filters see of a query. A struct that begins with it may carry more.
inline void init_query(QueryContext& context) {
#if MACULA_EMBREE_MAJOR >= 4
    rtcInitRayQueryContext(&context);
#else
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
#endif
}

/// Nearest hits of the lanes whose `valid` is -1; rays that lie close together.
inline void intersect_coherent(const int* valid, RTCScene scene, RTCRayHit16& rays) {
    QueryContext context;
    init_query(context);
#if MACULA_EMBREE_MAJOR >= 4
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    arguments.context = &context;
    rtcIntersect16(valid, scene, &rays, &arguments);
#else
    rtcIntersect16(valid, scene, &context, &rays);
#endif
}

/// Sets tfar to minus infinity in valid lanes where anything is hit. `context` was begun by init_query.
inline void occluded_coherent(const int* valid, RTCScene scene, QueryContext& context, RTCRay16& rays) {
#if MACULA_EMBREE_MAJOR >= 4
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    arguments.context = &context;
    rtcOccluded16(valid, scene, &rays, &arguments);
#else
    rtcOccluded16(valid, scene, &context, &rays);
#endif
}

inline void occluded_coherent(const int* valid, RTCScene scene, RTCRay16& rays) {
    QueryContext context;
    init_query(context);
    occluded_coherent(valid, scene, context, rays);
}

}  // namespace macula
