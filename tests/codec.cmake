macula_test(codec_test SOURCES unit/codec_test.cpp LINK macula_codec LABELS fast)
