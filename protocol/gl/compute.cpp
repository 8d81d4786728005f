#include "protocol/gl/compute.h"

#include <cstddef>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "kernel_text/kernel_prelude.h"
#include "protocol/gl/functions.h"

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

/// The log, followed by the source lines that it names as "part:line" (Mesa) or "part(line)" (NVIDIA).
std::string explain(const std::string& log, std::span<const KernelText> parts) {
    std::string explained = log;
    const std::regex place(R"((?:^|\n)[^\n0-9]*(\d{1,4})[:(](\d{1,6}))");
    std::set<std::pair<std::size_t, std::size_t>> shown;
    for (std::sregex_iterator match(log.begin(), log.end(), place), end; match != end; ++match) {
        const std::size_t part = std::stoul((*match)[1]);
        const std::size_t line = std::stoul((*match)[2]);
        if (part >= parts.size() || !shown.emplace(part, line).second) continue;
        explained += std::string(parts[part].name) + ":" + std::to_string(line) + ": " +
                     std::string(line_of(parts[part].text, line)) + "\n";
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

}  // namespace

Expected<ComputeProgram> ComputeProgram::build(GlContext& context, std::span<const KernelText> parts) {
    const GlFunctions& gl = context.gl();
    std::vector<KernelText> numbered = {kernel_prelude_text};
    numbered.insert(numbered.end(), parts.begin(), parts.end());
    std::string source = "#version 430 core\n";
    for (std::size_t i = 0; i < numbered.size(); ++i)
        source += "#line 1 " + std::to_string(i) + "\n" + std::string(numbered[i].text) + "\n";

    const unsigned shader = gl.CreateShader(GL_COMPUTE_SHADER);
    const char* text = source.c_str();
    gl.ShaderSource(shader, 1, &text, nullptr);
    gl.CompileShader(shader);
    GLint compiled = GL_FALSE;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_FALSE) {
        const std::string log = log_of(shader, gl.GetShaderiv, gl.GetShaderInfoLog);
        gl.DeleteShader(shader);
        return fail(ErrorCode::graphics,
                    "a GL program does not compile on " + context.renderer() + ":\n" + explain(log, numbered));
    }

    ComputeProgram program(context, gl.CreateProgram());
    gl.AttachShader(program.id_, shader);
    gl.LinkProgram(program.id_);
    gl.DeleteShader(shader);  // stays alive with the program
    GLint linked = GL_FALSE;
    gl.GetProgramiv(program.id_, GL_LINK_STATUS, &linked);
    if (linked == GL_FALSE)
        return fail(ErrorCode::graphics,
                    "a GL program does not link on " + context.renderer() + ":\n" +
                        explain(log_of(program.id_, gl.GetProgramiv, gl.GetProgramInfoLog), numbered));
    return program;
}

ComputeProgram::ComputeProgram(ComputeProgram&& other) noexcept
    : context_(other.context_), id_(std::exchange(other.id_, 0U)) {}

ComputeProgram::~ComputeProgram() {
    if (id_ == 0) return;
    if (const auto current = CurrentContext::enter(*context_)) context_->gl().DeleteProgram(id_);
}

void ComputeProgram::dispatch(unsigned x, unsigned y, unsigned z) const {
    const GlFunctions& gl = context_->gl();
    gl.UseProgram(id_);
    gl.DispatchCompute(x, y, z);
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace macula
