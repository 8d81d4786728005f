# Server and client without the network between, and the ways in which a person may move: what chart and stability
# suite run.
include(${CMAKE_CURRENT_LIST_DIR}/ablation.cmake OPTIONAL)
add_library(macula_pipeline STATIC pipeline/pipeline.cpp pipeline/row.cpp pipeline/scenario.cpp)
target_link_libraries(macula_pipeline PUBLIC macula_method macula_service macula_present macula_device macula_offline
    macula_reconstructor_factory macula_tracer macula_ablation PRIVATE macula_test_scenes)
target_compile_definitions(macula_pipeline PRIVATE MACULA_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
macula_test(pipeline_test SOURCES unit/pipeline_test.cpp LINK macula_pipeline)
