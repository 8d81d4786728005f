macula_test(recording_test SOURCES unit/recording_test.cpp LINK macula_device LABELS fast)
macula_test(recording_fuzz_test SOURCES fuzz/recording_fuzz_test.cpp fuzz/recording_fuzz.cpp LINK macula_device
    LABELS fast)
macula_test(simulation_test SOURCES property/simulation_test.cpp LINK macula_device LABELS fast)

macula_bench(compositor_bench SOURCES bench/compositor_bench.cpp LINK macula_present TBB::tbb)
macula_test(compositor_differential_test SOURCES differential/compositor_test.cpp LINK macula_present)
macula_test(client_session_test SOURCES unit/client_session_test.cpp LINK macula_stream LABELS fast threads)
macula_bench(taa_quality SOURCES bench/taa_quality.cpp LINK macula_present macula_device macula_reconstruct TBB::tbb)
macula_test(compositor_test SOURCES property/compositor_test.cpp LINK macula_present TBB::tbb LABELS fast threads)
macula_test(compositor_motion_test SOURCES property/compositor_motion_test.cpp
    LINK macula_present macula_reconstruct macula_service TBB::tbb)
macula_test(object_motion_test SOURCES property/object_motion_test.cpp LINK macula_present TBB::tbb LABELS fast)
macula_test(thin_wire_test SOURCES property/thin_wire_test.cpp LINK macula_present macula_reconstruct TBB::tbb)
macula_test(picture_sink_test SOURCES unit/picture_sink_test.cpp LINK macula_present PkgConfig::FFMPEG LABELS fast)
macula_test(client_options_test SOURCES unit/client_options_test.cpp LINK macula_client_parts LABELS fast)
macula_test(client_program_test
    SOURCES integration/client_program_test.cpp support/program.cpp
    LINK macula_base)
target_compile_definitions(client_program_test PRIVATE MACULA_CLIENT="$<TARGET_FILE:macula-client>")
add_dependencies(client_program_test macula-client)
macula_test(traced_reprojection_test SOURCES property/traced_reprojection_test.cpp
    LINK macula_present macula_reconstruct macula_service macula_tracer TBB::tbb)
