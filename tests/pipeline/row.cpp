#include "tests/pipeline/row.h"

#include <charconv>
#include <sstream>
#include <string_view>
#include <vector>

#include "server/method.h"
#include "tests/pipeline/ablation.h"

namespace macula::test {

namespace {

template <class Number>
Expected<void> read_number(std::string_view key, std::string_view text, Number least, Number& value) {
    Number read{};
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), read);
    if (code != std::errc() || end != text.data() + text.size() || read < least || read > Number{100000}) {
        std::string message(key);
        return fail(ErrorCode::option,
                    message.append("=").append(text).append(": not a number of at least ") + std::to_string(least));
    }
    value = read;
    return {};
}

Expected<void> one_of(std::string_view key, std::string_view text, const std::vector<std::string>& known) {
    std::string message(key);
    message.append("=").append(text).append(": must be one of");
    for (const std::string& each : known) {
        if (each == text) return {};
        message.append(" ").append(each);
    }
    return fail(ErrorCode::option, message);
}

Expected<void> read_setting(std::string_view key, const std::string& text, Row& row) {
    if (key == "taa") {
        row.taa = text;
        return one_of(key, text, {"macula", "paper", "off"});
    }
    if (key == "codec") {
        row.codec = text;
        return one_of(key, text, {"h264", "none"});
    }
    if (key == "display") {
        row.display = text;
        return {};
    }
    if (key == "frames") return read_number(key, text, 1, row.frames);
    if (key == "warm") return read_number(key, text, 0, row.warm);
    if (key == "seed") return read_number(key, text, std::uint32_t{1}, row.seed);
    if (key == "latency") return read_number(key, text, 0, row.latency);
    if (key == "mbits") return read_number(key, text, 1, row.mbits);
    if (key == "without") {
        std::istringstream parts(text);
        for (std::string part; std::getline(parts, part, '+');) row.without.insert(part);
        return check_ablation(row.without);
    }
    std::string message = "no setting '";
    return fail(ErrorCode::option, message.append(key).append("'"));
}

}  // namespace

std::string Row::name() const {
    const Row usual;
    std::string text = scene;
    text.append(" ").append(scenario).append(" ").append(method);
    const auto add = [&text](const char* key, const std::string& value, const std::string& usual_value) {
        if (value != usual_value) text.append(" ").append(key).append("=").append(value);
    };
    add("taa", taa, usual.taa);
    add("codec", codec, usual.codec);
    add("display", display, usual.display);
    add("frames", std::to_string(frames), std::to_string(usual.frames));
    add("warm", std::to_string(warm), std::to_string(usual.warm));
    add("seed", std::to_string(seed), std::to_string(usual.seed));
    add("latency", std::to_string(latency), std::to_string(usual.latency));
    add("mbits", std::to_string(mbits), std::to_string(usual.mbits));
    std::string off;
    for (const std::string& part : without) off.append(off.empty() ? "" : "+").append(part);
    add("without", off, "");
    return text;
}

Expected<Row> parse_row(const std::string& text) {
    std::istringstream words(text);
    Row row;
    if (!(words >> row.scene >> row.scenario >> row.method))
        return fail(ErrorCode::option, "'" + text + "': a row is SCENE SCENARIO METHOD [setting=value]...");
    const auto method = parse_method(row.method);
    if (!method) return tl::unexpected(method.error());
    row.method = method->name;
    for (std::string word; words >> word;) {
        const std::size_t equals = word.find('=');
        if (equals == std::string::npos)
            return fail(ErrorCode::option, "'" + word + "' in '" + text + "' is not a setting=value");
        const std::string_view key = std::string_view(word).substr(0, equals);
        if (auto read = read_setting(key, word.substr(equals + 1), row); !read) return tl::unexpected(read.error());
    }
    return row;
}

}  // namespace macula::test
