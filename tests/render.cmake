add_library(macula_test_pictures STATIC support/pictures.cpp)
target_link_libraries(macula_test_pictures PUBLIC macula_base PRIVATE PkgConfig::OIIO)
# Records rays with the tracer's own shading and times Embree alone on them.
macula_bench(trace_bench SOURCES bench/trace_bench.cpp
    LINK macula_tracer macula_kernels macula_masks macula_scenes embree TBB::tbb)
