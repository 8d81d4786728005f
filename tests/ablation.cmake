add_library(macula_ablation STATIC pipeline/ablation.cpp)
target_link_libraries(macula_ablation PUBLIC macula_masks macula_present macula_tracer)
macula_test(ablation_test SOURCES unit/ablation_test.cpp
    LINK macula_ablation macula_method macula_scenes LABELS fast)
