// Replays the corpus and mutations of it and of random messages, the same in every run.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include <gtest/gtest.h>

#include "tests/support/allocation.h"
#include "tests/support/random_messages.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace macula {
namespace {

constexpr std::uint32_t kSeed = 1;

void run(const Bytes& body) {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(body.data()), body.size());
}

/// Nothing is copied more than twice, and level maps have their own bound.
void expect_bounded_memory(const Bytes& body) {
    const std::size_t before = allocated_bytes();
    static_cast<void>(decode_message(body));
    const std::size_t used = allocated_bytes() - before;
    ASSERT_LE(used, 2 * body.size() + (std::size_t{256} << 10));
}

std::vector<Bytes> corpus() {
    std::vector<Bytes> bodies;
    for (const auto& entry : std::filesystem::directory_iterator(MACULA_SOURCE_DIR "/tests/fuzz/corpus/message")) {
        std::ifstream file(entry.path(), std::ios::binary);
        const std::string content{std::istreambuf_iterator<char>(file), {}};
        const auto* begin = reinterpret_cast<const std::byte*>(content.data());
        bodies.emplace_back(begin, begin + content.size());
    }
    return bodies;
}

Bytes mutated(Bytes body, std::mt19937& random) {
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % std::max<std::size_t>(n, 1)); };
    const std::size_t edits = 1 + below(4);
    for (std::size_t edit = 0; edit < edits && body.size() >= 8; ++edit) {
        // Offsets and layouts are few bytes at both ends and decide most.
        const std::size_t end = std::min<std::size_t>(body.size(), 64);
        const std::size_t at = random() % 3 == 0   ? below(body.size())
                               : random() % 2 == 0 ? below(end)
                                                   : body.size() - 1 - below(end);
        switch (random() % 6) {
            case 0:
                body[at] ^= std::byte(1U << random() % 8);
                break;
            case 1:
                body[at] = std::byte(random());
                break;
            case 2: {  // a number with all bits or only the sign, where four bytes may be a number or an offset
                const std::size_t word = std::min(at, body.size() - 4) & ~std::size_t{3};
                std::fill_n(body.begin() + static_cast<std::ptrdiff_t>(word), 4, std::byte(random() % 2 ? 0xff : 0));
                body[word + 3] = std::byte(random() % 2 ? 0x7f : 0x80);
                break;
            }
            case 3: {  // one part over another: offsets that point to the wrong thing
                const std::size_t from = below(body.size() - 4);
                const std::size_t to = below(body.size() - 4);
                std::copy_n(Bytes(body).begin() + static_cast<std::ptrdiff_t>(from), 4,
                            body.begin() + static_cast<std::ptrdiff_t>(to));
                break;
            }
            case 4:
                body.resize(at);
                break;
            default:
                body.insert(body.begin() + static_cast<std::ptrdiff_t>(at), below(16), std::byte(random()));
        }
    }
    return body;
}

TEST(MessageFuzz, CorpusHoldsEveryKindAndIsAccepted) {
    std::set<std::size_t> kinds;
    for (const Bytes& body : corpus()) {
        run(body);
        if (const Expected<Message> message = decode_message(body)) kinds.insert(message->index());
    }
    EXPECT_EQ(kinds.size(), kMessageKinds);
}

TEST(MessageFuzz, MutationsOfTheCorpus) {
    std::mt19937 random(kSeed);
    const std::vector<Bytes> bodies = corpus();
    for (int i = 0; i < 20'000; ++i) {
        const Bytes body = mutated(bodies[random() % bodies.size()], random);
        run(body);
        expect_bounded_memory(body);
    }
}

TEST(MessageFuzz, MutationsOfRandomMessages) {
    std::mt19937 random(kSeed);
    for (int i = 0; i < 200; ++i) {
        const Bytes body = encode_message(random_message(random() % kMessageKinds, random));
        for (int j = 0; j < 10; ++j) {
            const Bytes changed = mutated(body, random);
            run(changed);
            expect_bounded_memory(changed);
        }
    }
}

TEST(MessageFuzz, Noise) {
    std::mt19937 random(kSeed);
    for (int i = 0; i < 2'000; ++i) {
        Bytes body(random() % 300);
        for (std::byte& byte : body) byte = std::byte(random());
        run(body);
    }
}

/// Many entries that point to one long text: a small body that would become a large message.
TEST(MessageFuzz, SharedTextsAreNotMultiplied) {
    Hello hello;
    hello.eye_width_px = 64;
    hello.eye_height_px = 64;
    hello.codecs.assign(10'000, "");
    hello.codecs[0].assign(20'000, 'x');
    Bytes body = encode_message(hello);
    // All entries of the vector are made to point to where the first one points.
    const auto read_u32 = [&](std::size_t at) {
        std::uint32_t value = 0;
        for (unsigned i = 0; i < 4; ++i) value |= std::to_integer<std::uint32_t>(body[at + i]) << 8 * i;
        return value;
    };
    const auto write_u32 = [&](std::size_t at, std::uint32_t value) {
        for (unsigned i = 0; i < 4; ++i) body[at + i] = std::byte(value >> 8 * i & 0xffU);
    };
    std::size_t vector = 0;
    while (vector + 4 < body.size() && read_u32(vector) != 10'000) vector += 4;
    ASSERT_LT(vector + 40'000, body.size());
    const std::uint32_t target = static_cast<std::uint32_t>(vector + 4) + read_u32(vector + 4);
    ASSERT_EQ(read_u32(target), 20'000U);
    for (std::uint32_t i = 0; i < 10'000; ++i) {
        const std::size_t at = vector + 4 + 4 * i;
        write_u32(at, target - static_cast<std::uint32_t>(at));
    }
    const Expected<Message> decoded = decode_message(body);
    ASSERT_FALSE(decoded);
    EXPECT_NE(decoded.error().message.find("Hello.codecs"), std::string::npos) << decoded.error().message;
    expect_bounded_memory(body);
}

}  // namespace
}  // namespace macula
