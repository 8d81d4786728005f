macula_stability_test(stability_geometry_test
    SOURCES stability/geometry_test.cpp stability/geometry_scenes.cpp support/encoded_image.cpp
    LINK macula_pipeline macula_metrics macula_scenes macula_tracer PkgConfig::OIIO)
