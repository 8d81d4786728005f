macula_test(include_arrows_test SOURCES unit/include_arrows_test.cpp LINK macula_options LABELS fast)
