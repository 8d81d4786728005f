# The stability suite: tests/stability/README.md. Programs that it consists of are declared by
# macula_stability_test(NAME SOURCES... LINK targets...); run.sh finds them by their label.
add_library(macula_stability_case STATIC stability/case.cpp)
target_link_libraries(macula_stability_case PUBLIC macula_base PRIVATE macula_test_pictures GTest::gtest)
target_compile_definitions(macula_stability_case PRIVATE
    MACULA_STABILITY_PICTURES="${CMAKE_CURRENT_BINARY_DIR}/stability")

add_library(macula_test_scenes STATIC stability/scenes.cpp)
target_link_libraries(macula_test_scenes PUBLIC macula_scenes)

add_library(macula_stability_trial STATIC stability/ghost.cpp stability/trial.cpp)
target_link_libraries(macula_stability_trial PUBLIC macula_stability_case macula_test_scenes macula_pipeline macula_metrics)

add_custom_target(stability_suite)
function(macula_stability_test name)
    macula_test(${name} ${ARGN} LABELS stability TIMEOUT 1800)
    target_link_libraries(${name} PRIVATE macula_stability_case)
    add_dependencies(stability_suite ${name})
endfunction()

macula_stability_test(stability_signal_test SOURCES stability/signal_test.cpp LINK macula_stability_trial)
macula_stability_test(stability_scene_test SOURCES stability/scene_test.cpp LINK macula_stability_trial)
foreach(part machinery geometry)
    include(stability/${part}.cmake OPTIONAL)
endforeach()
