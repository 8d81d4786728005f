#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "masks/mesh/sample_mesh.h"
#include "masks/tool/grey_picture.h"
#include "masks/tool/mask_figure.h"

namespace macula {

/// Two sites, indices into SampleMesh::site.
using MeshEdge = std::array<std::uint32_t, 2>;

/// The edges of the triangles that may be seen in a part of a mask, each once.
std::vector<MeshEdge> visible_edges(const SampleMesh& mesh, const MaskCrop& crop);

/// The edges as lines, `width` units wide, as SVG. Sites lie at the centres of their pixels.
std::string mesh_svg(const SampleMesh& mesh, const std::vector<MeshEdge>& edges, const MaskCrop& crop, double width);

/// The same as a picture, black on white.
GreyPicture mesh_picture(const SampleMesh& mesh, const std::vector<MeshEdge>& edges, const MaskCrop& crop,
                         int width_px);

}  // namespace macula
