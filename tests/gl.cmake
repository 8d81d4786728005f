# Mesa's rasteriser threads are not instrumented, so that contexts stay out of the sanitizer runs ("fast").
macula_test(gl_context_test SOURCES unit/gl_context_test.cpp unit/gl_render_test.cpp LINK macula_gl LABELS gl)
