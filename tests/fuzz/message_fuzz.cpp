#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "protocol/message/message.h"

/// Any bytes: decode_message answers with a message within the limits, which therefore can be sent on, or with an
/// error that says what is wrong.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto message = macula::decode_message({reinterpret_cast<const std::byte*>(data), size});
    if (!message) {
        if (message.error().code != macula::ErrorCode::protocol || message.error().message.empty()) std::abort();
        return 0;
    }
    if (!macula::decode_message(macula::encode_message(*message))) std::abort();
    return 0;
}
