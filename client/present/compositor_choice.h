#pragma once

#include <functional>
#include <memory>
#include <string>

#include "client/present/compositor.h"
#include "client/present/taa_kernel.h"
#include "protocol/gl/context.h"

namespace macula {

/// Where temporal anti-aliasing and late reprojection run.
enum class TaaOn { automatic, gl, cpu };

/// `automatic`: GL if it is on a GPU; the faster of GL and C++, measured on made-up frames, if GL is on the CPU; C++ if
/// there is no GL. `log` gets what was found and measured. Errors: `graphics`, where GL was asked for.
Expected<std::unique_ptr<Compositor>> choose_compositor(TaaOn on, ContextKind context, const Display& display,
                                                        const kernels::TaaWeights& weights,
                                                        const std::function<void(const std::string&)>& log);

}  // namespace macula
