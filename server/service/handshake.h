#pragma once

#include <string>

#include "masks/display.h"
#include "protocol/base/error.h"
#include "protocol/message/message.h"
#include "server/service/session.h"
#include "server/service/supplies.h"

namespace macula {

/// Whether the client speaks our version and knows the token, in that order: who does not is told nothing else.
/// The token is compared in a time that does not depend on where it differs.
/// Errors: `refused`, with what the client's user can do.
Expected<void> authenticate(const Hello& hello, const std::string& token);

/// Display geometry that a Hello describes.
Display display_of(const Hello& hello);

/// What a client that is let in is served with.
struct Admission {
    Welcome welcome;
    Session::Parts parts;
    std::string reconstructor;  ///< which one, for the log
};

/// Makes what an authenticated client asks for. Errors: `refused`, `protocol`, `option` or `graphics`: no codec in
/// common, a display out of range, an unknown sampling preset, an encoder or GL context that cannot be made.
Expected<Admission> admit(const Hello& hello, const Supplies& supplies);

}  // namespace macula
