#pragma once

#include "protocol/base/error.h"
#include "protocol/message/message.h"

namespace macula {

/// Checks every field against limits.h and normalises directions and quaternions. A Hello of another protocol
/// version is checked only in what a refusal needs: its version and the client's name.
/// Errors: `protocol`, naming the field.
Expected<void> validate(Message& message);

}  // namespace macula
