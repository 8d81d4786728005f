#pragma once

#include <random>
#include <span>
#include <string>

namespace macula::testing {

/// `text` with one to four random edits: a hostile piece inserted, a few characters erased, one replaced by any byte or
/// by a digit, or a stretch repeated.
inline std::string mutated(std::string text, std::span<const std::string> hostile_pieces, std::mt19937& random) {
    for (unsigned edits = 1 + random() % 4; edits > 0; --edits) {
        const std::size_t at = random() % (text.size() + 1);
        switch (random() % 5) {
            case 0:
                text.insert(at, hostile_pieces[random() % hostile_pieces.size()]);
                break;
            case 1:
                text.erase(at, random() % 12);
                break;
            case 2:
                if (at < text.size()) text[at] = static_cast<char>(random() & 0xFFU);
                break;
            case 3:
                if (at < text.size()) text[at] = static_cast<char>('0' + random() % 10);
                break;
            default:
                text.insert(at, text.substr(at, random() % 200));
                break;
        }
    }
    return text;
}

}  // namespace macula::testing
