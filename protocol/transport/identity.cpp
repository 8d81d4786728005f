#include "protocol/transport/identity.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <optional>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "protocol/message/limits.h"

namespace macula {
namespace {

constexpr const char* kPemName = "identity.pem";
constexpr const char* kTokenName = "token";
constexpr const char* kFingerprintName = "fingerprint";
constexpr mode_t kPrivate = 0600;
constexpr mode_t kPublic = 0644;

class File {
public:
    explicit File(int descriptor) : descriptor_(descriptor) {}
    ~File() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    [[nodiscard]] int get() const { return descriptor_; }

private:
    int descriptor_;
};

tl::unexpected<Error> file_failure(ErrorCode code, const char* task, const std::filesystem::path& path) {
    return fail(code, std::string("cannot ") + task + " " + path.string() + ": " + std::strerror(errno));
}

/// Content of a file; empty optional if there is none.
Expected<std::optional<std::string>> read_file(const std::filesystem::path& path) {
    const File file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.get() < 0 && errno == ENOENT) return std::nullopt;
    if (file.get() < 0) return file_failure(ErrorCode::input_file, "read", path);
    std::string content(std::size_t{64} << 10, '\0');  // none of ours is near that
    const ssize_t size = ::read(file.get(), content.data(), content.size());
    if (size < 0) return file_failure(ErrorCode::input_file, "read", path);
    content.resize(static_cast<std::size_t>(size));
    return content;
}

/// Writes under another name and renames, so that nobody ever reads half a file.
Expected<void> write_file(const std::filesystem::path& path, const std::string& content, mode_t mode) {
    std::string temporary = path.string() + ".XXXXXX";
    const File file(::mkostemp(temporary.data(), O_CLOEXEC));
    if (file.get() < 0) return file_failure(ErrorCode::output, "write", path);
    const bool written = ::fchmod(file.get(), mode) == 0 &&
                         ::write(file.get(), content.data(), content.size()) == static_cast<ssize_t>(content.size()) &&
                         ::fsync(file.get()) == 0 && ::rename(temporary.c_str(), path.c_str()) == 0;
    if (written) return {};
    const auto failure = file_failure(ErrorCode::output, "write", path);
    ::unlink(temporary.c_str());
    return failure;
}

/// One line of text, without its end.
std::string trimmed(const std::string& text) {
    const std::size_t end = text.find_last_not_of(" \t\r\n");
    return end == std::string::npos ? std::string() : text.substr(0, end + 1);
}

/// Token and fingerprint files are read by both sides.
Expected<std::string> check_token(const std::string& content, const std::filesystem::path& path) {
    constexpr std::size_t kMinToken_bytes = 16;
    const std::string token = trimmed(content);
    const auto printable = [](char c) { return c > ' ' && c < 0x7f; };
    if (token.size() >= kMinToken_bytes && token.size() <= kMaxToken_bytes &&
        std::all_of(token.begin(), token.end(), printable)) {
        return token;
    }
    return fail(ErrorCode::input_file, path.string() + " is damaged: it must hold one word of " +
                                           std::to_string(kMinToken_bytes) + " to " + std::to_string(kMaxToken_bytes) +
                                           " characters; delete it and start the server, which makes a new one");
}

/// Content of a state file, made by `make` and written first if it is missing.
template <class Make>
Expected<std::string> read_or_create(const std::filesystem::path& path, mode_t mode, const Make& make) {
    Expected<std::optional<std::string>> existing = read_file(path);
    if (!existing) return tl::unexpected(existing.error());
    if (*existing) return std::move(**existing);
    Expected<std::string> content = make();
    if (!content) return content;
    if (const Expected<void> written = write_file(path, *content, mode); !written) {
        return tl::unexpected(written.error());
    }
    return content;
}

Expected<std::string> read_existing(const std::filesystem::path& path) {
    Expected<std::optional<std::string>> content = read_file(path);
    if (!content) return tl::unexpected(content.error());
    if (*content) return std::move(**content);
    return fail(ErrorCode::input_file, "there is no " + path.string() +
                                           ": start the server on this machine first, or give the fingerprint and "
                                           "the token that it printed");
}

}  // namespace

Expected<std::filesystem::path> default_state_folder() {
    const auto variable = [](const char* name) -> std::filesystem::path {
        const char* value = std::getenv(name);
        return value == nullptr ? "" : value;
    };
    // The XDG base directory specification: a relative path is to be ignored.
    if (const auto state = variable("XDG_STATE_HOME"); state.is_absolute()) return state / "macula";
    if (const auto home = variable("HOME"); home.is_absolute()) return home / ".local/state/macula";
    return fail(ErrorCode::option, "neither XDG_STATE_HOME nor HOME is set: name the state folder");
}

Expected<Identity> load_or_create_identity(const std::filesystem::path& folder) {
    std::error_code error;
    if (std::filesystem::create_directories(folder, error)) {
        std::filesystem::permissions(folder, std::filesystem::perms::owner_all, error);
    }
    if (error) return fail(ErrorCode::output, "cannot make folder " + folder.string() + ": " + error.message());
    // Servers that start at once take turns; closing the descriptor ends the lock.
    const File lock(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (lock.get() < 0 || ::flock(lock.get(), LOCK_EX) != 0) return file_failure(ErrorCode::input_file, "lock", folder);

    Identity identity;
    const std::filesystem::path pem_path = folder / kPemName;
    const Expected<std::string> pem = read_or_create(pem_path, kPrivate, make_certificate);
    if (!pem) return tl::unexpected(pem.error());
    const Expected<std::string> fingerprint = check_certificate(*pem);
    if (!fingerprint) {
        return fail(ErrorCode::input_file, pem_path.string() + " " + fingerprint.error().message +
                                               ": restore it, or delete it and start the server, which makes a new "
                                               "one that clients must be told of");
    }
    identity.pem = *pem;
    identity.credentials.fingerprint = *fingerprint;

    const std::filesystem::path token_path = folder / kTokenName;
    const auto token_line = [] { return make_token().map([](const std::string& token) { return token + "\n"; }); };
    const Expected<std::string> token =
        read_or_create(token_path, kPrivate, token_line).and_then([&](const std::string& text) {
            return check_token(text, token_path);
        });
    if (!token) return tl::unexpected(token.error());
    identity.credentials.token = *token;

    const std::filesystem::path fingerprint_path = folder / kFingerprintName;
    const Expected<std::optional<std::string>> known = read_file(fingerprint_path);
    if (!known || !*known || trimmed(**known) != *fingerprint) {
        const Expected<void> written = write_file(fingerprint_path, *fingerprint + "\n", kPublic);
        if (!written) return tl::unexpected(written.error());
    }
    return identity;
}

Expected<Credentials> load_credentials(const std::filesystem::path& folder) {
    const std::filesystem::path fingerprint_path = folder / kFingerprintName;
    const std::filesystem::path token_path = folder / kTokenName;
    const Expected<std::string> fingerprint_text = read_existing(fingerprint_path);
    if (!fingerprint_text) return tl::unexpected(fingerprint_text.error());
    const Expected<std::string> fingerprint = parse_fingerprint(trimmed(*fingerprint_text));
    if (!fingerprint) {
        return fail(ErrorCode::input_file,
                    fingerprint_path.string() + " is damaged: start the server, which writes it anew");
    }
    const Expected<std::string> token =
        read_existing(token_path).and_then([&](const std::string& text) { return check_token(text, token_path); });
    if (!token) return tl::unexpected(token.error());
    return Credentials{*fingerprint, *token};
}

}  // namespace macula
