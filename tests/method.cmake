macula_test(method_test SOURCES unit/method_test.cpp LINK macula_method LABELS fast)
macula_test(methods_test SOURCES integration/methods_test.cpp
    LINK macula_method macula_reconstructor_factory macula_tracer macula_scenes LABELS gl TIMEOUT 300)
