#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "client/device/source.h"
#include "client/options.h"
#include "client/present/compositor.h"
#include "client/present/picture_sink.h"
#include "client/stream/client_session.h"
#include "client/study/study.h"
#include "masks/display.h"
#include "protocol/transport/identity.h"

namespace macula {

// Makes the client's parts from its options.

/// --gaze. `warn` gets what was wrong with single rows of a recording. Errors: `option`, `input_file`.
Expected<std::unique_ptr<TrackSource>> make_source(const std::string& gaze,
                                                   const std::function<void(const std::string&)>& warn);

/// --display, one or more. Errors: `option`, `output`.
Expected<std::vector<std::unique_ptr<PictureSink>>> make_sinks(const std::vector<std::string>& displays);

/// --study and what belongs to it; null without. Errors: `option`, `output`.
Expected<std::unique_ptr<Study>> make_study(const ClientOptions& options);

/// First message of a session with this headset, from --sampling, or the study's reference, and --taa.
Hello make_hello(const Display& headset, const ClientOptions& options, const std::string& token);

/// --token and --fingerprint, or what the state folder of a server on this machine says. Errors: `option`,
/// `input_file`.
Expected<Credentials> find_credentials(const ClientOptions& options);

/// --taa, --taa-on and --context; `log` gets the choice. Errors: `option`, `graphics`.
Expected<std::unique_ptr<Compositor>> make_compositor(const ClientOptions& options, const Display& headset,
                                                      const std::function<void(const std::string&)>& log);

}  // namespace macula
