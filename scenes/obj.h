#pragma once

#include <istream>
#include <string>

#include "protocol/base/error.h"
#include "scenes/scene.h"

namespace macula {

/// Reads the geometry of a Wavefront OBJ file: v, vn, vt and polygonal f (as fans), negative indices included; other
/// statements are skipped. Where the file has no normals, smooth ones are made (angle-weighted).
/// Errors: `input_file` with file, line and reason, also for a file without triangles or over 4 million lines.
Expected<Mesh> read_obj(const std::string& path);

/// The same from a stream; `path` names it in messages.
Expected<Mesh> parse_obj(std::istream& file, const std::string& path);

}  // namespace macula
