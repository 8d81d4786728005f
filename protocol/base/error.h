#pragma once

#include <string>
#include <utility>

#include <tl/expected.hpp>

namespace macula {

/// Why an operation on outside input failed. The value is also the exit code of a program that ends
/// because of it; this list is the one place where exit codes are enumerated (0 is success).
enum class ErrorCode : int {
    internal = 1,    ///< a defect of ours, or a library that failed without a reason
    option = 2,      ///< a command-line option or configuration value
    input_file = 3,  ///< a scene, texture, recording or display file
    network = 4,     ///< a port in use, a host that does not answer, a connection that broke
    refused = 5,     ///< the peer said no: wrong token, wrong version, wrong key, server full
    protocol = 6,    ///< a malformed, oversized or unexpected message
    graphics = 7,    ///< no usable GL context, or a GL program that does not build
    output = 8,      ///< a picture, video or table that cannot be written
    timeout = 9,     ///< the peer is silent or too slow
};

/// What went wrong, where, and what to do about it, in one sentence for a person.
struct Error {
    ErrorCode code = ErrorCode::internal;
    std::string message;
};

/// Result of anything that depends on outside input. Nothing of ours throws for bad input.
template <class T>
using Expected = tl::expected<T, Error>;

/// Shorthand for returning an error from a function that returns Expected.
inline tl::unexpected<Error> fail(ErrorCode code, std::string message) {
    return tl::unexpected<Error>(Error{code, std::move(message)});
}

}  // namespace macula
