# What goes wrong between server and client: frames that are lost, late, repeated or out of order, clocks that are set,
# encoders without bits, displays that change, peers that pause.
macula_stability_test(stability_stream_test
    SOURCES stability/machinery_loss.cpp stability/machinery_shots.cpp stability/machinery_size.cpp
            stability/machinery_starved.cpp
    LINK macula_service macula_stream macula_present macula_tracer macula_reconstruct macula_scenes TBB::tbb)
macula_stability_test(stability_clock_test
    SOURCES stability/machinery_clock.cpp
    LINK macula_service macula_stream macula_client_parts)
macula_stability_test(stability_link_test
    SOURCES stability/machinery_live.cpp support/peer.cpp support/small_service.cpp
    LINK macula_service macula_stream macula_tracer macula_reconstruct spdlog::spdlog TBB::tbb)
