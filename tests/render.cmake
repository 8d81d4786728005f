add_library(macula_test_pictures STATIC support/pictures.cpp)
target_link_libraries(macula_test_pictures PUBLIC macula_base PRIVATE PkgConfig::OIIO)
