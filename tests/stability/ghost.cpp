#include "tests/stability/ghost.h"

#include <vector>

namespace macula::test {
namespace {

std::vector<std::uint8_t> uncovered(const Trial& trial, int frame, int later, std::uint32_t background) {
    const auto before = trial.objects(frame - later - 1);
    const auto then = trial.objects(frame - later);
    const auto now = trial.objects(frame);
    std::vector<std::uint8_t> found(now.size());
    for (std::size_t i = 0; i < now.size(); ++i) {
        const bool gone = before[i] != background && then[i] == background && now[i] == background;
        found[i] = gone && trial.hidden()[i] == 0 ? 1 : 0;
    }
    return found;
}

}  // namespace

double ghost(const Trial& trial, const Take& with_history, const Take& without_history, std::uint32_t background,
             int later) {
    double product = 0.0;
    double square = 0.0;
    for (int frame = trial.first_judged() + later; frame < trial.frames(); ++frame) {
        const std::vector<std::uint8_t> wanted = uncovered(trial, frame, later, background);
        const ColorImage& shown = with_history.shown[static_cast<std::size_t>(frame)];
        const ColorImage& plain = without_history.shown[static_cast<std::size_t>(frame)];
        const ColorImage& before = trial.reference(frame - later - 1);
        const ColorImage& now = trial.reference(frame);
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            if (wanted[i] == 0) continue;
            for (unsigned shift = 0; shift < 24; shift += 8) {
                const auto value = [&](const ColorImage& image) { return double(image.texels[i] >> shift & 255U); };
                const double past = value(before) - value(now);
                product += (value(shown) - value(plain)) * past;
                square += past * past;
            }
        }
    }
    return product / square;
}

}  // namespace macula::test
