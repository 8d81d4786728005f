macula_library(macula_tracer
    SOURCES direct_light.cpp embree_scene.cpp embree_tracer.cpp environment.cpp packet_shading.cpp ray_batch.cpp ray_filters.cpp
            secondary_rays.cpp shading_scene.cpp surface_fetch.cpp texel_read.cpp texture_levels.cpp texture_lookup.cpp
    LINK macula_base macula_masks macula_scenes
    PRIVATE_LINK macula_kernels embree macula_parallel)
target_compile_definitions(macula_tracer PRIVATE MACULA_EMBREE_MAJOR=${embree_VERSION_MAJOR})
