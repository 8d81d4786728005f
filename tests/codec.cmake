macula_test(codec_test SOURCES unit/codec_test.cpp LINK macula_codec LABELS fast)
macula_test(depth_codec_test SOURCES property/depth_codec_test.cpp LINK macula_codec LABELS fast)
macula_test(video_fuzz_test SOURCES fuzz/video_fuzz.cpp fuzz/video_fuzz_test.cpp LINK macula_codec LABELS fast)
