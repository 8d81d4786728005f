#pragma once

#include <filesystem>
#include <string>

#include "protocol/base/error.h"
#include "protocol/transport/certificate.h"

namespace macula {

/// What a client needs to know about a server: how to recognise it, and how to be let in.
struct Credentials {
    std::string fingerprint;  ///< of the server's certificate (certificate.h)
    std::string token;        ///< secret that Hello carries
};

/// What a server is known by; lives in its state folder, in three files:
/// `identity.pem` (key and certificate, mode 0600), `token` (0600), `fingerprint`.
struct Identity {
    std::string pem;  ///< private key and certificate
    Credentials credentials;
};

/// $XDG_STATE_HOME/macula, or ~/.local/state/macula. Errors: `option` if neither variable is set.
Expected<std::filesystem::path> default_state_folder();

/// Reads a server's identity; makes what is missing, the folder included. Safe against several servers that
/// start at once, and against a crash halfway: files appear whole or not at all.
/// Errors: `input_file` for files that are unreadable or damaged, `output` for a folder that cannot be written;
/// both name the path.
Expected<Identity> load_or_create_identity(const std::filesystem::path& folder);

/// Reads what a client on the server's machine needs from the server's folder.
/// Errors: `input_file`, naming the path and what to do.
Expected<Credentials> load_credentials(const std::filesystem::path& folder);

}  // namespace macula
