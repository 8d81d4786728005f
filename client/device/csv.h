#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace macula {

/// Splits at commas and trims blanks; the views point into `line`. Quoting is not part of these formats.
void split_fields(std::string_view line, std::vector<std::string_view>& fields);

/// Decimal number; NaN and infinities are numbers here. Nothing if the text is anything else.
std::optional<double> parse_number(std::string_view text);
std::optional<std::int64_t> parse_integer(std::string_view text);

/// Columns by the names of a header line.
class Columns {
public:
    explicit Columns(std::string_view header);
    [[nodiscard]] std::optional<std::size_t> find(std::string_view name) const;
    [[nodiscard]] std::size_t count() const { return names_.size(); }

private:
    std::vector<std::string_view> names_;
};

}  // namespace macula
