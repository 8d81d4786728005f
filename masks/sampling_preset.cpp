#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "masks/law.h"

namespace macula {
namespace {

/// A whole text as a finite number.
std::optional<double> number(std::string_view text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

/// Share of a percentage.
std::optional<double> share_of(std::string_view text) {
    const auto percent = number(text);
    if (!percent || *percent < 1.0 || *percent > 99.0) return std::nullopt;
    return *percent / 100.0;
}

/// Of presets that are percentages (law.h).
constexpr double kPercentageExponent = 1.5;

/// How a published mask differs from the law of the 54 % mask.
struct PaperMask {
    std::string_view name;
    double share;
    SamplingPreset::Free free;
    double fovea_scale;
};

constexpr std::array<PaperMask, 4> kPaperMasks = {{
    {"paper-54", 0.54, SamplingPreset::Free::stretch, 1.0},
    {"paper-41", 0.41, SamplingPreset::Free::exponent, 1.3},
    {"paper-27", 0.27, SamplingPreset::Free::stretch, 1.0},
    {"paper-18", 0.18, SamplingPreset::Free::exponent, 1.0},
}};

std::optional<SamplingPreset> parse_paper_mask(std::string_view text) {
    for (const PaperMask& mask : kPaperMasks) {
        if (text != mask.name) continue;
        SamplingPreset preset;
        preset.law.exponent = 1.0;
        preset.free = mask.free;
        preset.share = mask.share;
        preset.fovea_scale = mask.fovea_scale;
        return preset;
    }
    return std::nullopt;
}

/// "NAME" or "NAME-P".
std::optional<SamplingPreset> parse_named_law(std::string_view text) {
    for (const NamedLaw& law : named_laws()) {
        if (!text.starts_with(law.name)) continue;
        SamplingPreset preset;
        preset.law.model = law.model;
        std::string_view rest = text.substr(law.name.size());
        if (rest.empty()) {
            preset.free = SamplingPreset::Free::nothing;
            return preset;
        }
        if (rest.front() != '-') continue;
        const auto share = share_of(rest.substr(1));
        if (!share) continue;
        preset.share = *share;
        return preset;
    }
    return std::nullopt;
}

/// What follows "law:".
Expected<SamplingPreset> parse_constants(const std::string& text, std::string_view constants) {
    SamplingPreset preset;
    preset.free = SamplingPreset::Free::nothing;
    GeislerPerry model;
    for (std::size_t begin = 0; begin <= constants.size();) {
        const std::size_t end = std::min(constants.find(',', begin), constants.size());
        const std::string_view part = constants.substr(begin, end - begin);
        begin = end + 1;
        const std::size_t equals = std::min(part.find('='), part.size());
        const std::string_view name = part.substr(0, equals);
        const auto value = number(part.substr(std::min(equals + 1, part.size())));
        double* field = nullptr;
        if (name == "alpha") field = &model.alpha_deg;
        if (name == "e2") field = &model.e2_deg;
        if (name == "contrast") field = &model.contrast;
        if (name == "exponent") field = &preset.law.exponent;
        if (name == "full") field = &preset.law.full_acuity_deg;
        const bool in_range =
            value && (*value > 0.0 || (name == "full" && *value == 0.0)) && (name != "contrast" || *value < 1.0);
        if (field == nullptr || !in_range) {
            return fail(
                ErrorCode::option,
                "sampling '" + text + "': '" + std::string(part) +
                    "' is wrong: use alpha, e2, contrast (below 1), exponent and full, each NAME=VALUE above 0");
        }
        *field = *value;
    }
    preset.law.model = model;
    return preset;
}

/// The value between `low` and `high` at which `share_at`, which grows from `low` to `high`, is nearest to `share`.
double solve(double share, double low, double high, const std::function<double(double)>& share_at) {
    for (int i = 0; i < 48; ++i) {
        const double middle = std::sqrt(low * high);
        (share_at(middle) < share ? low : high) = middle;
    }
    return std::sqrt(low * high);
}

AcuityLaw with_stretch_for(double share, AcuityLaw law, const ShareOfLaw& planned_share) {
    law.stretch = solve(share, 1e-3, 1e3, [&](double stretch) {
        law.stretch = stretch;
        return planned_share(law);
    });
    return law;
}

AcuityLaw with_exponent_for(double share, AcuityLaw law, const ShareOfLaw& planned_share) {
    law.exponent = solve(share, 1e2, 1e-2, [&](double exponent) {
        law.exponent = exponent;
        return planned_share(law);
    });
    return law;
}

}  // namespace

Expected<SamplingPreset> parse_sampling(const std::string& text) {
    constexpr std::string_view kConstants = "law:";
    std::optional<SamplingPreset> preset;
    if (text == "full") {
        preset.emplace().full = true;
    } else if (text.starts_with(kConstants)) {
        auto constants = parse_constants(text, std::string_view(text).substr(kConstants.size()));
        if (!constants) return constants;
        preset = *std::move(constants);
    } else if (const auto share = share_of(text)) {
        preset.emplace().share = *share;
        preset->law.exponent = kPercentageExponent;
    } else if (const auto mask = parse_paper_mask(text)) {
        preset = mask;
    } else {
        preset = parse_named_law(text);
    }
    if (!preset) {
        std::string names;
        for (const NamedLaw& law : named_laws()) names += std::string(law.name) + ", ";
        return fail(ErrorCode::option,
                    "sampling '" + text +
                        "' is unknown: use full, the percentage of pixels to trace, 1 to 99, a published mask "
                        "(paper-54, paper-41, paper-27, paper-18), a law (" +
                        names + "each alone or with -PERCENTAGE) or law:NAME=VALUE,...");
    }
    preset->name = text;
    return *preset;
}

AcuityLaw solve_law(const SamplingPreset& preset, const ShareOfLaw& planned_share) {
    switch (preset.free) {
        case SamplingPreset::Free::nothing:
            break;
        case SamplingPreset::Free::stretch:
            return with_stretch_for(preset.share, preset.law, planned_share);
        case SamplingPreset::Free::exponent: {
            AcuityLaw law = with_stretch_for(preset.fovea_share, preset.law, planned_share);
            law.stretch *= preset.fovea_scale;
            return with_exponent_for(preset.share, law, planned_share);
        }
    }
    return preset.law;
}

}  // namespace macula
