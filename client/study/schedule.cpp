#include "client/study/schedule.h"

#include <algorithm>
#include <cmath>

namespace macula {
namespace {

class SplitMix64 {
public:
    explicit SplitMix64(std::uint64_t seed) : state_(seed) {}
    /// In [0, 1).
    double next() {
        state_ += 0x9e3779b97f4a7c15U;
        std::uint64_t z = state_;
        z = (z ^ z >> 30U) * 0xbf58476d1ce4e5b9U;
        z = (z ^ z >> 27U) * 0x94d049bb133111ebU;
        return std::ldexp(static_cast<double>((z ^ z >> 31U) >> 11U), -53);
    }

private:
    std::uint64_t state_;
};

}  // namespace

Expected<void> check_study(const StudySettings& settings) {
    const auto wrong = [](const std::string& what) { return fail(ErrorCode::option, "the study " + what); };
    if (settings.masks.empty()) return wrong("needs a mask");
    std::vector<std::string> sorted = settings.masks;
    std::ranges::sort(sorted);
    if (std::ranges::adjacent_find(sorted) != sorted.end()) return wrong("has a mask twice");
    if (settings.masks.size() == 1 && settings.masks.front() == settings.reference)
        return wrong("has no mask but the reference");
    for (const std::string& method : settings.masks)
        if (method.empty() || method.find(',') != std::string::npos)
            return wrong("takes names of methods without commas, not '" + method + "'");
    if (!(settings.begin_s > 0.0)) return wrong("shows its reference for a time above 0");
    if (!(settings.interval_s > 0.0)) return wrong("has intervals above 0");
    if (!(settings.spread_s >= 0.0 && settings.spread_s < settings.interval_s))
        return wrong("has a spread from 0 to less than the interval");
    if (!(settings.length_s > settings.begin_s)) return wrong("ends after its reference");
    return {};
}

std::vector<MaskChange> make_schedule(const StudySettings& settings) {
    SplitMix64 random(settings.seed);
    std::vector<MaskChange> schedule;
    const std::string* shown = &settings.reference;
    for (double at_s = settings.begin_s; at_s < settings.length_s;) {
        std::vector<std::size_t> others;
        for (std::size_t mask = 0; mask < settings.masks.size(); ++mask)
            if (settings.masks[mask] != *shown) others.push_back(mask);
        const double drawn = random.next();
        // A single mask, once shown, has nothing to change to.
        if (others.empty()) break;
        const auto which = static_cast<std::size_t>(drawn * static_cast<double>(others.size()));
        schedule.push_back({at_s, others[which]});
        shown = &settings.masks[others[which]];
        at_s += settings.interval_s + settings.spread_s * (2.0 * random.next() - 1.0);
    }
    return schedule;
}

}  // namespace macula
