macula_test(identity_test
    SOURCES unit/identity_test.cpp
    LINK macula_transport
    LABELS fast)
macula_test(transport_test
    SOURCES integration/transport_test.cpp
    LINK macula_transport OpenSSL::SSL
    LABELS fast threads)
macula_bench(transport_bench SOURCES bench/transport_bench.cpp LINK macula_transport)
