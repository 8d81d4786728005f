#include "client/spec.h"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace macula {
namespace {

bool are_settings(std::string_view text) {
    return std::ranges::all_of(
        text, [](unsigned char c) { return std::isalnum(c) != 0 || c == '=' || c == '&' || c == '_'; });
}

}  // namespace

Expected<Spec> parse_spec(std::string_view text, std::string_view option) {
    Spec spec;
    const std::size_t colon = text.find(':');
    std::string_view rest = colon == std::string_view::npos ? std::string_view() : text.substr(colon + 1);
    spec.kind = text.substr(0, colon);
    if (spec.kind.empty())
        return fail(ErrorCode::option, std::string(option) + " begins with a kind, as in png:folder");
    const std::size_t mark = rest.rfind('?');
    if (mark != std::string_view::npos && are_settings(rest.substr(mark + 1))) {
        std::string_view settings = rest.substr(mark + 1);
        rest = rest.substr(0, mark);
        while (!settings.empty()) {
            const std::string_view setting = settings.substr(0, settings.find('&'));
            settings.remove_prefix(std::min(settings.size(), setting.size() + 1));
            const std::size_t equals = setting.find('=');
            spec.settings[std::string(setting.substr(0, equals))] =
                equals == std::string_view::npos ? std::string_view() : setting.substr(equals + 1);
        }
    }
    spec.target = rest;
    return spec;
}

Expected<int> positive_setting(const Spec& spec, const std::string& name, int fallback) {
    const auto found = spec.settings.find(name);
    if (found == spec.settings.end()) return fallback;
    const std::string& text = found->second;
    int value = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc{} || end != text.data() + text.size() || value <= 0) {
        return fail(ErrorCode::option, spec.kind + ": " + name + " is a whole number from 1, not '" + text + "'");
    }
    return value;
}

Expected<void> only_settings(const Spec& spec, std::initializer_list<std::string_view> known) {
    for (const auto& [name, value] : spec.settings) {
        if (std::ranges::find(known, name) == known.end()) {
            return fail(ErrorCode::option, spec.kind + " has no setting '" + name + "'");
        }
    }
    return {};
}

}  // namespace macula
