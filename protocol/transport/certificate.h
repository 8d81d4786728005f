#pragma once

#include <string>
#include <string_view>

#include "protocol/base/error.h"

struct x509_st;  // OpenSSL's X509

namespace macula {

/// Makes an EC P-256 key and a certificate signed with it, good for ten years. Returns PEM text: key, then
/// certificate. Clients pin the certificate, so no authority and no host name is in it.
Expected<std::string> make_certificate();

/// Fingerprint of the certificate in `pem`, which must hold its private key too.
/// Errors: `input_file` if a part is missing, damaged, or they do not belong together.
Expected<std::string> check_certificate(const std::string& pem);

/// SHA-256 of the certificate's DER: 32 pairs of upper-case hex digits with colons.
std::string fingerprint_of(const x509_st& certificate);

/// Brings a fingerprint that a person typed into the form of fingerprint_of: letters of either case, colons or
/// none. Errors: `option`.
Expected<std::string> parse_fingerprint(std::string_view text);

/// 256 random bits in hex.
Expected<std::string> make_token();

/// Compares without telling through its run time where the two differ.
bool same_token(std::string_view a, std::string_view b);

}  // namespace macula
