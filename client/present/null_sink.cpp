#include "client/present/picture_sink.h"

namespace macula {
namespace {

class NullSink final : public PictureSink {
public:
    Expected<void> show(const ColorImage& /*picture*/, std::int64_t /*displayed_ns*/) override { return {}; }
    Expected<void> close() override { return {}; }
    [[nodiscard]] std::string where() const override { return "nowhere"; }
};

}  // namespace

std::unique_ptr<PictureSink> make_null_sink() {
    return std::make_unique<NullSink>();
}

}  // namespace macula
