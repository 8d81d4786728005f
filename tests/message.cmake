macula_test(message_test SOURCES unit/message_test.cpp LINK macula_message LABELS fast)
macula_test(message_round_trip_test
    SOURCES property/message_test.cpp support/random_messages.cpp
    LINK macula_message
    LABELS fast)
macula_test(message_fuzz_test
    SOURCES fuzz/message_fuzz.cpp fuzz/message_fuzz_test.cpp support/random_messages.cpp support/allocation.cpp
    LINK macula_message
    LABELS fast)
macula_bench(message_bench SOURCES bench/message_bench.cpp LINK macula_message)
