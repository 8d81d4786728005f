// The GLSL side of kernel_language.h: the same macros.
#define KERNEL_BEGIN
#define KERNEL_END
#define KERNEL
#define KERNEL_IN(type) in type
#define KERNEL_OUT(type) out type
#define KERNEL_INOUT(type) inout type
#define KERNEL_PRECISE precise
