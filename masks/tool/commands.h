#pragma once

#include "masks/tool/options.h"
#include "protocol/base/error.h"

namespace macula {

// The commands of macula-mask, whole: from options to files. What the files are is in masks/tool/README.md.
// Errors: `option`, `input_file`, `output`, naming the option or the file.

Expected<void> run(const MakeOptions& options);
Expected<void> run(const InspectOptions& options);
Expected<void> run(const CutoffPlotOptions& options);
Expected<void> run(const MaskPlotOptions& options);
Expected<void> run(const MeshPlotOptions& options);

}  // namespace macula
