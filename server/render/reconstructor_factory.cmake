# Which reconstruction a session uses, and where it runs.
macula_library(macula_reconstructor_factory
    SOURCES reconstructor_choice.cpp reconstructor_factory.cpp
    LINK macula_reconstruct
    PRIVATE_LINK macula_mesh_reconstruct macula_scattered_reconstruct macula_grid_reconstruct macula_gl)
