# Speed against accuracy (chart/README.md).
add_library(macula_measure STATIC chart/measure.cpp chart/table.cpp)
target_link_libraries(macula_measure PUBLIC macula_pipeline macula_metrics PRIVATE spdlog::spdlog)
add_executable(macula-chart chart/main.cpp)
target_link_libraries(macula-chart PRIVATE macula_measure CLI11::CLI11)
add_test(NAME chart_python_test
    COMMAND python3 -B -m unittest discover -s ${CMAKE_CURRENT_SOURCE_DIR}/chart -p "test_*.py")
set_tests_properties(chart_python_test PROPERTIES TIMEOUT 60)
