#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "protocol/base/error.h"
#include "protocol/base/image.h"

namespace macula {

/// Takes what the user sees: both eyes side by side. One thread at a time.
class PictureSink {
public:
    PictureSink() = default;
    PictureSink(const PictureSink&) = delete;
    PictureSink& operator=(const PictureSink&) = delete;
    virtual ~PictureSink() = default;
    /// Shows a picture at a time of the client's clock; times rise. Errors: `output`.
    virtual Expected<void> show(const ColorImage& picture, std::int64_t displayed_ns) = 0;
    /// Finishes what was begun; nothing can be shown after it. Errors: `output`.
    virtual Expected<void> close() = 0;
    /// Where the pictures are, for the report.
    [[nodiscard]] virtual std::string where() const = 0;
};

/// A folder, made if need be, that gets every `every`-th picture as frame_000001.png and so on, numbered by
/// pictures shown. Errors: `output`.
Expected<std::unique_ptr<PictureSink>> make_png_sink(const std::string& folder, int every);

/// An H.264 video with the times at which the pictures were shown. The file is made at once, so that a path that
/// cannot be written is known before the session; its size is that of the first picture. Errors: `output`.
Expected<std::unique_ptr<PictureSink>> make_mp4_sink(const std::string& path);

/// Shows nothing.
std::unique_ptr<PictureSink> make_null_sink();

}  // namespace macula
