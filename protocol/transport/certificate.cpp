#include "protocol/transport/certificate.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include <openssl/bio.h>
#include <openssl/crypto.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509.h>

namespace macula {
namespace {

template <auto free_function>
struct Deleter {
    template <class T>
    void operator()(T* object) const {
        free_function(object);
    }
};
using KeyPtr = std::unique_ptr<EVP_PKEY, Deleter<EVP_PKEY_free>>;
using X509Ptr = std::unique_ptr<X509, Deleter<X509_free>>;
using BioPtr = std::unique_ptr<BIO, Deleter<BIO_free_all>>;

tl::unexpected<Error> openssl_failure(const char* task) {
    std::array<char, 256> reason{};
    ERR_error_string_n(ERR_get_error(), reason.data(), reason.size());
    return fail(ErrorCode::internal, std::string("OpenSSL cannot ") + task + ": " + reason.data());
}

std::string hex(std::span<const unsigned char> bytes, const char* digits, bool colons) {
    std::string text;
    for (const unsigned char byte : bytes) {
        if (colons && !text.empty()) text += ':';
        text += digits[byte >> 4U];
        text += digits[byte & 15U];
    }
    return text;
}

constexpr const char* kUpperDigits = "0123456789ABCDEF";
constexpr std::size_t kDigest_bytes = 32;

}  // namespace

Expected<std::string> make_certificate() {
    const KeyPtr key(EVP_EC_gen("P-256"));
    const X509Ptr certificate(X509_new());
    const BioPtr pem(BIO_new(BIO_s_mem()));
    if (!key || !certificate || !pem) return openssl_failure("make a key");

    constexpr long kDay_s = 24L * 60 * 60;
    constexpr long kValid_s = 3653 * kDay_s;
    std::uint64_t serial = 0;
    X509_NAME* name = X509_get_subject_name(certificate.get());
    constexpr std::array<unsigned char, 7> kName = {'m', 'a', 'c', 'u', 'l', 'a', '\0'};
    constexpr int kToItsEnd = -1;
    const bool made = RAND_bytes(reinterpret_cast<unsigned char*>(&serial), sizeof serial) == 1 &&
                      X509_set_version(certificate.get(), X509_VERSION_3) == 1 &&
                      ASN1_INTEGER_set_uint64(X509_get_serialNumber(certificate.get()), 1 + serial / 2) == 1 &&
                      // A day early, for machines whose clocks disagree.
                      X509_gmtime_adj(X509_getm_notBefore(certificate.get()), -kDay_s) != nullptr &&
                      X509_gmtime_adj(X509_getm_notAfter(certificate.get()), kValid_s) != nullptr &&
                      X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC, kName.data(), kToItsEnd, -1, 0) == 1 &&
                      X509_set_issuer_name(certificate.get(), name) == 1 &&
                      X509_set_pubkey(certificate.get(), key.get()) == 1 &&
                      X509_sign(certificate.get(), key.get(), EVP_sha256()) > 0 &&
                      PEM_write_bio_PrivateKey(pem.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr) == 1 &&
                      PEM_write_bio_X509(pem.get(), certificate.get()) == 1;
    if (!made) return openssl_failure("make a certificate");

    char* text = nullptr;
    const long size = BIO_get_mem_data(pem.get(), &text);
    return std::string(text, static_cast<std::size_t>(size));
}

Expected<std::string> check_certificate(const std::string& pem) {
    const auto source = [&pem] { return BioPtr(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size()))); };
    const KeyPtr key(PEM_read_bio_PrivateKey(source().get(), nullptr, nullptr, nullptr));
    const X509Ptr certificate(PEM_read_bio_X509(source().get(), nullptr, nullptr, nullptr));
    const bool belong = key && certificate && X509_check_private_key(certificate.get(), key.get()) == 1;
    ERR_clear_error();
    if (!key) return fail(ErrorCode::input_file, "holds no private key in PEM form");
    if (!certificate) return fail(ErrorCode::input_file, "holds no certificate in PEM form");
    if (!belong) return fail(ErrorCode::input_file, "holds a key and a certificate that do not belong together");
    return fingerprint_of(*certificate);
}

std::string fingerprint_of(const x509_st& certificate) {
    std::array<unsigned char, kDigest_bytes> digest{};
    // Cannot fail for a parsed certificate and a digest that is always built in; zeros match no pin.
    X509_digest(&certificate, EVP_sha256(), digest.data(), nullptr);
    return hex(digest, kUpperDigits, true);
}

Expected<std::string> parse_fingerprint(std::string_view text) {
    std::array<unsigned char, kDigest_bytes> digest{};
    std::size_t digits = 0;
    for (const char c : text) {
        if (c == ':') continue;
        const int value = OPENSSL_hexchar2int(static_cast<unsigned char>(c));
        if (value < 0 || digits == 2 * kDigest_bytes) {
            digits = 0;
            break;
        }
        unsigned char& byte = digest[digits / 2];
        byte = static_cast<unsigned char>(byte << 4U | static_cast<unsigned>(value));
        ++digits;
    }
    if (digits != 2 * kDigest_bytes) {
        return fail(ErrorCode::option, "fingerprint '" + std::string(text) +
                                           "' is not 32 pairs of hex digits: copy it from the server's first lines");
    }
    return hex(digest, kUpperDigits, true);
}

Expected<std::string> make_token() {
    std::array<unsigned char, 32> random{};
    if (RAND_bytes(random.data(), random.size()) != 1) return openssl_failure("make random numbers");
    return hex(random, "0123456789abcdef", false);
}

bool same_token(std::string_view a, std::string_view b) {
    return a.size() == b.size() && CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

}  // namespace macula
