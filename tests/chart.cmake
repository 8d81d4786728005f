# Speed against accuracy (chart/README.md).
add_library(macula_measure STATIC chart/measure.cpp chart/table.cpp)
target_link_libraries(macula_measure PUBLIC macula_pipeline macula_metrics PRIVATE spdlog::spdlog)
add_executable(macula-chart chart/main.cpp)
target_link_libraries(macula-chart PRIVATE macula_measure CLI11::CLI11)
