#include "tests/metrics/npy.h"

#include <cstdint>
#include <cstring>
#include <fstream>

namespace macula::test {
namespace {

/// Magic, version, length and a Python dictionary, padded so that the data begin at a multiple of 64 bytes
/// (numpy.lib.format).
std::string header(std::size_t frames, int height_px, int width_px) {
    std::string fields = "{'descr': '|u1', 'fortran_order': False, 'shape': (" + std::to_string(frames) + ", " +
                         std::to_string(height_px) + ", " + std::to_string(width_px) + ", 3), }";
    constexpr std::size_t kBefore = 10;
    constexpr std::size_t kAlignment = 64;
    fields.append(kAlignment - 1 - (kBefore + fields.size()) % kAlignment, ' ');
    fields.push_back('\n');
    const std::size_t length = fields.size();
    std::string bytes("\x93NUMPY\x01\x00", 8);
    bytes.push_back(static_cast<char>(length & 255U));
    bytes.push_back(static_cast<char>(length >> 8U));
    return bytes + fields;
}

}  // namespace

Expected<void> write_npy(const std::string& path, const std::vector<ColorImage>& frames) {
    std::ofstream file(path, std::ios::binary);
    const int height_px = frames.empty() ? 0 : frames.front().height_px;
    const int width_px = frames.empty() ? 0 : frames.front().width_px;
    const std::string head = header(frames.size(), height_px, width_px);
    file.write(head.data(), static_cast<std::streamsize>(head.size()));
    std::string row;
    for (const ColorImage& frame : frames) {
        for (int y = 0; y < height_px; ++y) {
            row.clear();
            for (int x = 0; x < width_px; ++x) {
                for (int shift = 0; shift < 24; shift += 8) {
                    row.push_back(static_cast<char>(frame.at(x, y) >> shift & 255U));
                }
            }
            file.write(row.data(), static_cast<std::streamsize>(row.size()));
        }
    }
    file.close();
    if (!file) return fail(ErrorCode::output, path + ": cannot be written");
    return {};
}

}  // namespace macula::test
