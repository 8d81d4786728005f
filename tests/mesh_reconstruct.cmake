macula_test(mesh_reconstruct_test SOURCES differential/mesh_reconstruct_test.cpp
    LINK macula_mesh_reconstruct macula_test_pictures LABELS fast threads)
macula_test(mesh_reconstruct_gl_test SOURCES differential/mesh_reconstruct_gl_test.cpp
    LINK macula_mesh_reconstruct macula_gl macula_test_pictures LABELS gl)
