#include <array>

#include "protocol/gl/egl_context.h"

namespace macula {

namespace {

std::string device_name(const char* extensions, EGLDeviceEXT device, PFNEGLQUERYDEVICESTRINGEXTPROC query) {
    for (const auto& [extension, name] : {std::pair{"EGL_EXT_device_drm_render_node", EGL_DRM_RENDER_NODE_FILE_EXT},
                                          std::pair{"EGL_EXT_device_drm", EGL_DRM_DEVICE_FILE_EXT}})
        if (has_egl_extension(extensions, extension))
            if (const char* text = query(device, name)) return text;
    return "device without a file";
}

}  // namespace

Expected<std::unique_ptr<GlContext>> make_egl_device_context(DeviceChoice choice) {
    const char* client_extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    for (const char* needed : {"EGL_EXT_device_enumeration", "EGL_EXT_device_query", "EGL_EXT_platform_device"})
        if (!has_egl_extension(client_extensions, needed))
            return fail(ErrorCode::graphics, std::string("libEGL lacks ") + needed);
    const auto query_devices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
    const auto query_string =
        reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(eglGetProcAddress("eglQueryDeviceStringEXT"));

    std::array<EGLDeviceEXT, 32> devices{};
    EGLint count = 0;
    if (query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_FALSE) count = 0;
    std::string reasons;
    int tried = 0;
    for (EGLint i = 0; i < count; ++i) {
        const char* extensions = query_string(devices[i], EGL_EXTENSIONS);
        const bool marked_software = has_egl_extension(extensions, "EGL_MESA_device_software");
        if (marked_software != (choice == DeviceChoice::software)) continue;
        ++tried;
        auto context =
            make_egl_context(eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr), "EGL device");
        // A driver may answer for a device node and still rasterise on the CPU.
        if (context && (choice == DeviceChoice::software || !(*context)->software())) return context;
        reasons += (reasons.empty() ? "" : ", ") + device_name(extensions, devices[i], query_string) + ": " +
                   (context ? (*context)->renderer() + " runs on the CPU" : context.error().message);
    }
    if (tried > 0) return fail(ErrorCode::graphics, reasons);
    return fail(ErrorCode::graphics, "none of EGL's " + std::to_string(count) + " device(s) is " +
                                         (choice == DeviceChoice::hardware ? "hardware" : "software"));
}

}  // namespace macula
