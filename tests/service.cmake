macula_test(service_parts_test
    SOURCES unit/prediction_test.cpp unit/pacing_test.cpp unit/session_statistics_test.cpp unit/handshake_test.cpp
            unit/scene_clock_test.cpp unit/motion_finder_test.cpp unit/frame_maker_test.cpp unit/method_choices_test.cpp
    LINK macula_service
    LABELS fast threads)
macula_test(session_test
    SOURCES unit/session_test.cpp
    LINK macula_service spdlog::spdlog
    LABELS fast threads)
macula_test(server_test
    SOURCES integration/server_test.cpp support/peer.cpp support/small_service.cpp
    LINK macula_service macula_tracer macula_reconstruct spdlog::spdlog OpenSSL::SSL TBB::tbb
    LABELS fast threads
    TIMEOUT 600)
macula_test(server_program_test
    SOURCES integration/server_program_test.cpp support/peer.cpp support/program.cpp
    LINK macula_transport)
target_compile_definitions(server_program_test PRIVATE MACULA_SERVER="$<TARGET_FILE:macula-server>")
add_dependencies(server_program_test macula-server)
macula_bench(server_bench
    SOURCES bench/server_bench.cpp support/peer.cpp support/small_service.cpp
    LINK macula_service macula_tracer macula_reconstruct spdlog::spdlog GTest::gtest)
macula_test(end_to_end_test
    SOURCES integration/end_to_end_test.cpp support/program.cpp
    LINK macula_base
    TIMEOUT 300)
target_compile_definitions(end_to_end_test PRIVATE
    MACULA_SERVER="$<TARGET_FILE:macula-server>" MACULA_CLIENT="$<TARGET_FILE:macula-client>")
add_dependencies(end_to_end_test macula-server macula-client)
macula_test(server_options_test
    SOURCES unit/server_options_test.cpp ${PROJECT_SOURCE_DIR}/server/options.cpp
    LINK macula_scene_options CLI11::CLI11
    LABELS fast)
target_compile_definitions(server_options_test PRIVATE MACULA_VERSION="${PROJECT_VERSION}")
