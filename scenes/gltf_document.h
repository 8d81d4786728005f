#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tiny_gltf.h>

#include "protocol/base/error.h"
#include "scenes/gltf.h"

namespace macula {

/// A parsed file whose buffers are in memory; indices, sizes and offsets in `model` are not checked yet.
struct GltfDocument {
    std::string name;
    tinygltf::Model model;
    /// Encoded bytes of images given by uri, by image index; empty where the uri could not be read.
    std::vector<std::vector<std::uint8_t>> image_bytes;
};

/// State of reading one document.
struct GltfContext {
    GltfContext(const GltfDocument& doc, const GltfLimits& lim)
        : document(doc), limits(lim), elements_left(lim.elements), texels_left(lim.texels) {}

    const GltfDocument& document;
    const GltfLimits& limits;
    std::size_t elements_left;
    std::size_t texels_left;
    std::vector<std::string> warnings;

    /// `element` as in "mesh 3 (\"wheel\")".
    [[nodiscard]] tl::unexpected<Error> error(const std::string& element, const std::string& what) const {
        return fail(ErrorCode::input_file, document.name + ": " + element + ": " + what);
    }
    void warn(const std::string& element, const std::string& what) {
        warnings.push_back(document.name + ": " + element + ": " + what);
    }
};

/// "mesh 3 (\"wheel\")", or "mesh 3" where it has no name.
std::string element_name(const char* kind, std::size_t index, const std::string& name = {});

/// Parses the container and the JSON and reads buffers and images; refuses required extensions that are unknown.
/// `folder` is where relative uris lead; empty refuses them. Errors: `input_file`.
Expected<GltfDocument> read_gltf_document(std::span<const std::uint8_t> bytes, const std::string& name,
                                          const std::string& folder, const GltfLimits& limits);

/// Whether the loader knows the extension.
bool is_supported_extension(const std::string& name);

/// A whole file. Errors: `input_file` if it cannot be read or is larger than `max_bytes`.
Expected<std::vector<std::uint8_t>> read_file(const std::string& path, std::size_t max_bytes);

}  // namespace macula
