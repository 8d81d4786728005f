add_library(macula_test_pictures STATIC support/pictures.cpp)
target_link_libraries(macula_test_pictures PUBLIC macula_base PRIVATE PkgConfig::OIIO)

macula_test(kernels_test
    SOURCES unit/camera_kernel_test.cpp unit/color_kernel_test.cpp
            unit/light_kernel_test.cpp unit/texture_kernel_test.cpp
    LINK macula_kernels
    LABELS fast)

macula_test(reflectance_test
    SOURCES unit/area_light_kernel_test.cpp unit/brdf_kernel_test.cpp unit/fresnel_kernel_test.cpp
            unit/layers_kernel_test.cpp property/reflectance_test.cpp
    LINK macula_kernels)

macula_test(tracer_test
    SOURCES unit/tracer_motion_test.cpp unit/tracer_test.cpp differential/tracer_test.cpp
    LINK macula_tracer macula_scenes
    LABELS fast threads)

# Mesa's rasteriser threads are not instrumented, so that contexts stay out of the sanitizer runs ("fast").
macula_test(kernels_gl_test SOURCES differential/kernels_gl_test.cpp LINK macula_kernels macula_gl LABELS gl)
macula_kernel_text(kernels_gl_test
    server/kernels/area_light.h server/kernels/brdf.h server/kernels/camera.h server/kernels/color.h
    server/kernels/fresnel.h server/kernels/layers.h server/kernels/light.h server/kernels/microfacet.h
    server/kernels/powers.h server/kernels/shade.h server/kernels/sheen.h server/kernels/texture.h
    tests/differential/kernel_cases.h tests/differential/kernel_cases_main.glsl)

macula_test(tracer_golden_test
    SOURCES golden/furnace_test.cpp golden/geometry_test.cpp golden/light_test.cpp
            golden/material_test.cpp golden/shadow_test.cpp
    LINK macula_tracer macula_scenes
    LABELS fast)

macula_test(tracer_path_test
    SOURCES golden/glass_test.cpp golden/mirror_test.cpp
    LINK macula_tracer macula_scenes
    LABELS fast)

# Its constants come from another renderer, by golden/independent_renderer.py.
macula_test(independent_renderer_test
    SOURCES golden/independent_renderer_test.cpp
    LINK macula_tracer macula_scenes
    LABELS fast)

macula_test(tracer_reference_test
    SOURCES differential/direct_light_test.cpp differential/secondary_rays_test.cpp
    LINK macula_tracer macula_scenes
    LABELS fast)

macula_test(tracer_light_test
    SOURCES golden/area_light_test.cpp golden/environment_light_test.cpp golden/footprint_test.cpp
    LINK macula_tracer macula_scenes
    LABELS fast)

macula_test(tracer_threads_test
    SOURCES unit/tracer_threads_test.cpp
    LINK macula_tracer macula_scenes TBB::tbb
    LABELS fast)

macula_test(bunny_box_golden_test
    SOURCES golden/bunny_box_test.cpp
    LINK macula_tracer macula_scenes macula_test_pictures)

# Records rays with the tracer's own shading and times Embree alone on them.
macula_bench(trace_bench SOURCES bench/trace_bench.cpp
    LINK macula_tracer macula_kernels macula_masks macula_scenes embree TBB::tbb)
target_compile_definitions(trace_bench PRIVATE MACULA_EMBREE_MAJOR=${embree_VERSION_MAJOR})

macula_bench(lobes_bench SOURCES bench/lobes_bench.cpp LINK macula_kernels)
