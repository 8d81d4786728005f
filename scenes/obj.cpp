#include "scenes/obj.h"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "scenes/mesh_attributes.h"

namespace macula {
namespace {

constexpr std::size_t kMaxLines = 4'000'000;
constexpr std::size_t kMaxCornersPerFace = 1024;

/// Takes the next word off the front of `line`; empty at its end.
std::string_view next_word(std::string_view& line) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return line = {};
    line.remove_prefix(begin);
    const std::string_view word = line.substr(0, line.find_first_of(" \t\r"));
    line.remove_prefix(word.size());
    return word;
}

template <class Number>
std::optional<Number> parse(std::string_view word) {
    Number value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return value;
}

/// The first `count` numbers of `line`, all finite.
template <class Vector>
bool parse_vector(std::string_view line, int count, Vector& out) {
    for (int i = 0; i < count; ++i) {
        const std::optional<float> value = parse<float>(next_word(line));
        if (!value || !std::isfinite(*value)) return false;
        out[i] = *value;
    }
    return true;
}

/// A face's corner: indices of v, vt and vn from 0, -1 where absent.
using Corner = std::array<int, 3>;

class ObjReader {
public:
    /// Returns what is wrong with the line, or nothing.
    const char* read_line(std::string_view line) {
        const std::string_view keyword = next_word(line);
        if (keyword == "v") return read_vector(line, 3, position_m_, "a vertex needs three finite numbers");
        if (keyword == "vn") return read_vector(line, 3, normal_, "a normal needs three finite numbers");
        if (keyword == "vt") return read_vector(line, 2, uv_, "a texture coordinate needs two finite numbers");
        if (keyword == "f") return read_face(line);
        return nullptr;
    }

    /// The mesh with the optional attributes that every corner has.
    Mesh take() {
        if (!every_corner_has_normal_) mesh_.normal.clear();
        if (!every_corner_has_uv_) mesh_.uv0.clear();
        drop_degenerate_triangles(mesh_);
        if (mesh_.normal.empty()) add_smooth_normals(mesh_);
        return std::move(mesh_);
    }

private:
    template <class Vector>
    static const char* read_vector(std::string_view line, int count, std::vector<Vector>& to, const char* complaint) {
        Vector value(0.0F);
        if (!parse_vector(line, count, value)) return complaint;
        to.push_back(value);
        return nullptr;
    }

    /// "7", "7/2", "7//3" or "7/2/3", counted from 1, or backwards from the last one read.
    std::optional<Corner> parse_corner(std::string_view word) const {
        const std::array<std::size_t, 3> sizes = {position_m_.size(), uv_.size(), normal_.size()};
        Corner corner = {-1, -1, -1};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t slash = word.find('/');
            const std::string_view field = word.substr(0, slash);
            if (!field.empty()) {
                const std::optional<int> index = parse<int>(field);
                if (!index || *index == 0) return std::nullopt;
                const long long from_zero = *index > 0 ? *index - 1LL : static_cast<long long>(sizes[i]) + *index;
                if (from_zero < 0 || from_zero >= static_cast<long long>(sizes[i])) return std::nullopt;
                corner[i] = static_cast<int>(from_zero);
            }
            if (slash == std::string_view::npos) break;
            word.remove_prefix(slash + 1);
        }
        if (corner[0] < 0) return std::nullopt;
        return corner;
    }

    unsigned vertex_of(const Corner& corner) {
        const auto [it, added] = vertex_.try_emplace(corner, static_cast<unsigned>(mesh_.position_m.size()));
        if (!added) return it->second;
        glm::vec3 normal = corner[2] >= 0 ? normal_[static_cast<std::size_t>(corner[2])] : glm::vec3(0.0F);
        const float length = glm::length(normal);
        if (length > 0.0F) normal /= length;
        every_corner_has_normal_ = every_corner_has_normal_ && length > 0.0F && std::isfinite(length);
        every_corner_has_uv_ = every_corner_has_uv_ && corner[1] >= 0;
        mesh_.position_m.push_back(position_m_[static_cast<std::size_t>(corner[0])]);
        mesh_.uv0.push_back(corner[1] >= 0 ? uv_[static_cast<std::size_t>(corner[1])] : glm::vec2(0.0F));
        mesh_.normal.push_back(normal);
        return it->second;
    }

    const char* read_face(std::string_view line) {
        std::vector<unsigned> polygon;
        for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
            const std::optional<Corner> corner = parse_corner(word);
            if (!corner) return "a face names a vertex that does not exist";
            polygon.push_back(vertex_of(*corner));
            if (polygon.size() > kMaxCornersPerFace) return "a face has more than 1024 corners";
        }
        if (polygon.size() < 3) return "a face needs three corners";
        for (std::size_t i = 2; i < polygon.size(); ++i)
            mesh_.triangle.emplace_back(polygon[0], polygon[i - 1], polygon[i]);
        return nullptr;
    }

    std::vector<glm::vec3> position_m_;
    std::vector<glm::vec2> uv_;
    std::vector<glm::vec3> normal_;
    std::map<Corner, unsigned> vertex_;
    bool every_corner_has_uv_ = true;
    bool every_corner_has_normal_ = true;
    Mesh mesh_;
};

}  // namespace

Expected<Mesh> read_obj(const std::string& path) {
    std::ifstream file(path);
    if (!file) return fail(ErrorCode::input_file, "cannot open " + path);
    return parse_obj(file, path);
}

Expected<Mesh> parse_obj(std::istream& file, const std::string& path) {
    ObjReader reader;
    std::string line;
    for (std::size_t number = 1; std::getline(file, line); ++number) {
        if (number > kMaxLines) return fail(ErrorCode::input_file, path + " has more than 4 million lines");
        if (const char* complaint = reader.read_line(line))
            return fail(ErrorCode::input_file, path + ", line " + std::to_string(number) + ": " + complaint);
    }
    if (file.bad()) return fail(ErrorCode::input_file, "cannot read " + path);
    Mesh mesh = reader.take();
    if (mesh.triangle.empty()) return fail(ErrorCode::input_file, path + " contains no triangles");
    mesh.name = path;
    return mesh;
}

}  // namespace macula
