#include "masks/display_file.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <optional>

#include <nlohmann/json.hpp>

namespace macula {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxFile_bytes = std::size_t{1} << 20;

/// Reads fields of JSON objects and keeps the first fault. After a fault everything reads as zero.
class Reader {
public:
    [[nodiscard]] const std::optional<std::string>& fault() const { return fault_; }

    /// The member `key` of `object`, whose own path is `path`; null after a fault.
    const json& member(const json& object, const std::string& path, const std::string& key) {
        static const json kNothing;
        if (fault_) return kNothing;
        const auto found = object.find(key);
        if (found != object.end()) return *found;
        report(join(path, key), "is missing");
        return kNothing;
    }

    /// Reports members other than `known`, and values that are no object.
    void expect_object(const json& value, const std::string& path, std::initializer_list<const char*> known) {
        if (!value.is_object()) return report(path, "must be an object");
        for (const auto& [key, unused] : value.items()) {
            if (std::find(known.begin(), known.end(), key) == known.end()) report(join(path, key), "is unknown");
        }
    }

    float number(const json& value, const std::string& path) {
        if (!value.is_number()) report(path, "must be a number");
        return fault_ ? 0.0F : value.get<float>();
    }

    int whole_number(const json& value, const std::string& path) {
        const bool whole = value.is_number_integer() && std::abs(value.get<double>()) < 1e9;
        if (!whole) report(path, "must be a whole number");
        return fault_ ? 0 : value.get<int>();
    }

    std::string text(const json& value, const std::string& path) {
        if (!value.is_string()) report(path, "must be a string");
        return fault_ ? std::string() : value.get<std::string>();
    }

    /// An array of `count` numbers.
    std::vector<float> numbers(const json& value, const std::string& path, std::size_t count) {
        if (!value.is_array() || value.size() != count)
            report(path, "must be an array of " + std::to_string(count) + " numbers");
        std::vector<float> result(count);
        for (std::size_t i = 0; i < count && !fault_; ++i)
            result[i] = number(value[i], path + "[" + std::to_string(i) + "]");
        return result;
    }

    void report(const std::string& path, const std::string& what) {
        if (!fault_) fault_ = "field '" + path + "' " + what;
    }

    static std::string join(const std::string& path, const std::string& key) {
        return path.empty() ? key : path + "." + key;
    }

private:
    std::optional<std::string> fault_;
};

Tangents read_tangents(Reader& reader, const json& value, const std::string& path) {
    reader.expect_object(value, path, {"left", "right", "bottom", "top"});
    const auto edge = [&](const char* key) {
        return reader.number(reader.member(value, path, key), Reader::join(path, key));
    };
    return {edge("left"), edge("right"), edge("bottom"), edge("top")};
}

Pose read_pose(Reader& reader, const json& value, const std::string& path) {
    reader.expect_object(value, path, {"position_m", "orientation_xyzw"});
    Pose pose;
    const auto p = reader.numbers(reader.member(value, path, "position_m"), Reader::join(path, "position_m"), 3);
    pose.position_m = {p[0], p[1], p[2]};
    if (!reader.fault() && value.contains("orientation_xyzw")) {
        const auto q = reader.numbers(value["orientation_xyzw"], Reader::join(path, "orientation_xyzw"), 4);
        pose.orientation = glm::quat(q[3], q[0], q[1], q[2]);
    }
    return pose;
}

std::vector<glm::vec2> read_outline(Reader& reader, const json& value, const std::string& path) {
    if (!value.is_array()) reader.report(path, "must be an array of points");
    std::vector<glm::vec2> outline;
    for (std::size_t i = 0; i < value.size() && !reader.fault(); ++i) {
        const auto point = reader.numbers(value[i], path + "[" + std::to_string(i) + "]", 2);
        outline.emplace_back(point[0], point[1]);
    }
    return outline;
}

EyeDisplay read_eye(Reader& reader, const json& value, const std::string& path) {
    reader.expect_object(value, path, {"tangents", "head_from_eye", "visible_outline"});
    EyeDisplay eye;
    eye.tangents = read_tangents(reader, reader.member(value, path, "tangents"), Reader::join(path, "tangents"));
    eye.head_from_eye =
        read_pose(reader, reader.member(value, path, "head_from_eye"), Reader::join(path, "head_from_eye"));
    if (!reader.fault() && value.contains("visible_outline"))
        eye.visible_outline = read_outline(reader, value["visible_outline"], Reader::join(path, "visible_outline"));
    return eye;
}

}  // namespace

Expected<Display> parse_display(std::string_view text, const std::string& source) {
    const auto wrong = [&source](const std::string& what) {
        return fail(ErrorCode::input_file,
                    "display file " + source + ": " + what + " (masks/display.md has the format)");
    };
    const json root = json::parse(text, nullptr, /*allow_exceptions=*/false, /*ignore_comments=*/true);
    if (root.is_discarded()) return wrong("is not JSON");
    if (!root.is_object()) return wrong("must hold one object");

    Reader reader;
    reader.expect_object(root, "", {"name", "eye_width_px", "eye_height_px", "refresh_hz", "left", "right"});
    Display display;
    display.name = reader.text(reader.member(root, "", "name"), "name");
    display.eye_width_px = reader.whole_number(reader.member(root, "", "eye_width_px"), "eye_width_px");
    display.eye_height_px = reader.whole_number(reader.member(root, "", "eye_height_px"), "eye_height_px");
    display.refresh_hz = reader.number(reader.member(root, "", "refresh_hz"), "refresh_hz");
    display.eyes[kLeftEye] = read_eye(reader, reader.member(root, "", "left"), "left");
    display.eyes[kRightEye] = read_eye(reader, reader.member(root, "", "right"), "right");
    if (reader.fault()) return wrong(*reader.fault());
    if (const auto valid = validate_display(display); !valid) return wrong(valid.error().message);
    return display;
}

Expected<Display> read_display_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string text(kMaxFile_bytes + 1, '\0');
    if (file) file.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (!file.is_open() || file.bad() || (file.gcount() == 0 && !file.eof()))
        return fail(ErrorCode::input_file,
                    "display file " + path + " cannot be read: check the path and its permissions");
    text.resize(static_cast<std::size_t>(file.gcount()));
    if (text.size() > kMaxFile_bytes)
        return fail(ErrorCode::input_file, "display file " + path + " is larger than 1 MB: is it the right file?");
    return parse_display(text, path);
}

}  // namespace macula
