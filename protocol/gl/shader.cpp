#include "protocol/gl/shader.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "kernel_text/kernel_prelude.h"

namespace macula {

namespace {

std::string_view line_of(std::string_view text, std::size_t number) {
    for (std::size_t line = 1; line < number; ++line) {
        const std::size_t end = text.find('\n');
        if (end == std::string_view::npos) return {};
        text.remove_prefix(end + 1);
    }
    return text.substr(0, text.find('\n'));
}

struct Place {
    std::size_t part;
    std::size_t line;
};

/// Where a line of a log points: "1:12(5): error" (Mesa), "1(12) : error" (NVIDIA), "ERROR: 1:12: " (others).
std::optional<Place> place_of(std::string_view log_line) {
    const std::size_t digit = log_line.find_first_of("0123456789");
    if (digit == std::string_view::npos) return std::nullopt;
    const char* const end = log_line.data() + log_line.size();
    Place place{};
    const auto part = std::from_chars(log_line.data() + digit, end, place.part);
    if (part.ec != std::errc{} || part.ptr == end || (*part.ptr != ':' && *part.ptr != '(')) return std::nullopt;
    if (std::from_chars(part.ptr + 1, end, place.line).ec != std::errc{}) return std::nullopt;
    return place;
}

/// The log, followed by the source lines that it points to.
std::string explain(const std::string& log, std::span<const KernelText> parts) {
    std::string explained = log;
    std::set<std::pair<std::size_t, std::size_t>> shown;
    for (std::size_t number = 1; number <= static_cast<std::size_t>(std::count(log.begin(), log.end(), '\n')) + 1;
         ++number) {
        const auto place = place_of(line_of(log, number));
        if (!place || place->part >= parts.size() || !shown.emplace(place->part, place->line).second) continue;
        const KernelText& part = parts[place->part];
        explained += std::string(part.name) + ":" + std::to_string(place->line) + ": " +
                     std::string(line_of(part.text, place->line)) + "\n";
    }
    return explained;
}

template <class GetParameter, class GetLog>
std::string log_of(unsigned id, GetParameter get_parameter, GetLog get_log) {
    GLint size = 0;
    get_parameter(id, GL_INFO_LOG_LENGTH, &size);
    std::string log(static_cast<std::size_t>(size), '\0');
    GLsizei written = 0;
    get_log(id, size, &written, log.data());
    log.resize(static_cast<std::size_t>(written));
    return log;
}

std::vector<KernelText> with_prelude(std::span<const KernelText> parts) {
    std::vector<KernelText> numbered = {kernel_prelude_text};
    numbered.insert(numbered.end(), parts.begin(), parts.end());
    return numbered;
}

/// The name of a shader that the caller deletes.
Expected<unsigned> compile(GlContext& context, const ShaderStage& stage) {
    const GlFunctions& gl = context.gl();
    const std::vector<KernelText> numbered = with_prelude(stage.parts);
    std::string source = "#version 430 core\n";
    for (std::size_t i = 0; i < numbered.size(); ++i)
        source += "#line 1 " + std::to_string(i) + "\n" + std::string(numbered[i].text) + "\n";

    const unsigned shader = gl.CreateShader(stage.kind);
    const char* text = source.c_str();
    gl.ShaderSource(shader, 1, &text, nullptr);
    gl.CompileShader(shader);
    GLint compiled = GL_FALSE;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled != GL_FALSE) return shader;
    const std::string log = log_of(shader, gl.GetShaderiv, gl.GetShaderInfoLog);
    gl.DeleteShader(shader);
    return fail(ErrorCode::graphics,
                "a GL program does not compile on " + context.renderer() + ":\n" + explain(log, numbered));
}

}  // namespace

Expected<unsigned> build_program(GlContext& context, std::span<const ShaderStage> stages) {
    const GlFunctions& gl = context.gl();
    const unsigned program = gl.CreateProgram();
    for (const ShaderStage& stage : stages) {
        const auto shader = compile(context, stage);
        if (!shader) {
            gl.DeleteProgram(program);
            return tl::unexpected(shader.error());
        }
        gl.AttachShader(program, *shader);
        gl.DeleteShader(*shader);  // stays alive with the program
    }
    gl.LinkProgram(program);
    GLint linked = GL_FALSE;
    gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked != GL_FALSE) return program;
    // The lines that a linker names cannot be told apart by stage: those of the first are shown.
    const std::string log =
        explain(log_of(program, gl.GetProgramiv, gl.GetProgramInfoLog), with_prelude(stages.front().parts));
    gl.DeleteProgram(program);
    return fail(ErrorCode::graphics, "a GL program does not link on " + context.renderer() + ":\n" + log);
}

}  // namespace macula
