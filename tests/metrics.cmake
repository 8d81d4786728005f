macula_library(macula_metrics SOURCES metrics/clip_meter.cpp metrics/npy.cpp metrics/ssim.cpp LINK macula_base)
macula_test(metrics_test SOURCES metrics/clip_meter_test.cpp metrics/npy_test.cpp metrics/ssim_test.cpp
    LINK macula_metrics
    LABELS fast)
macula_bench(metrics_bench SOURCES bench/metrics_bench.cpp LINK macula_metrics)
