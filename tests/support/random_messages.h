#pragma once

#include <random>

#include "protocol/message/message.h"

namespace macula {

/// Kinds of messages, in the order of the variant.
inline constexpr std::size_t kMessageKinds = std::variant_size_v<Message>;

/// A message of the given kind that decode_message accepts, its fields anywhere in their ranges, ends included.
Message random_message(std::size_t kind, std::mt19937& random);

}  // namespace macula
