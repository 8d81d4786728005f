# Meshes that follow the gaze: what each pixel interpolates, and which sites get a ray.
macula_library(macula_mesh_sampler
    SOURCES edge_distance.cpp mesh_blocks.cpp mesh_sampler.cpp mesh_table.cpp
    LINK macula_mesh)
