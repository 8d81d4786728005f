# Where ray tracers fail for want of digits. Each test prints how many pixels are wrong.
macula_test(stability_test
    SOURCES golden/stability_large_triangles_test.cpp golden/stability_reflection_test.cpp
            golden/stability_scale_test.cpp golden/stability_shadow_test.cpp golden/stability_triangles_test.cpp
    LINK macula_tracer macula_scenes)
