# The mesh itself: Delaunay triangulation, file, measures.
macula_library(macula_mesh
    SOURCES delaunay_flip.cpp mesh_file_read.cpp mesh_file_write.cpp mesh_quality.cpp sample_mesh.cpp triangulate.cpp
    LINK macula_masks
    PRIVATE_LINK TinyGLTF::TinyGLTF)
