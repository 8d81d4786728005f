#pragma once

#include <map>
#include <string>
#include <string_view>

#include "protocol/base/error.h"

namespace macula {

/// What options like `png:DIR?every=30` say: a kind, what it works on, and settings.
struct Spec {
    std::string kind;
    std::string target;                           ///< between the first ':' and the last '?'
    std::map<std::string, std::string> settings;  ///< "every" -> "30"; a setting without '=' has an empty value
};

/// Parses `kind[:target[?setting[=value][&...]]]`; `option` is the option's name, for messages. A '?' counts only
/// if nothing but letters, digits, '=', '&' and '_' follows it, so file names may contain it.
/// Errors: `option` for an empty kind.
Expected<Spec> parse_spec(std::string_view text, std::string_view option);

/// A positive integer setting, or `fallback` where it is not given. Errors: `option`.
Expected<int> positive_setting(const Spec& spec, const std::string& name, int fallback);

/// Checks that no setting but those named is given. Errors: `option`, naming the unknown one.
Expected<void> only_settings(const Spec& spec, std::initializer_list<std::string_view> known);

}  // namespace macula
