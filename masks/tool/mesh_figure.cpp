#include "masks/tool/mesh_figure.h"

#include <algorithm>
#include <cmath>

#include "masks/tool/svg.h"

namespace macula {
namespace {

glm::ivec2 place(const SampleMesh& mesh, std::uint32_t site) {
    return {mesh.site[site].x_px, mesh.site[site].y_px};
}

/// Line widths in units of the picture: hairlines where triangles are small, so that dense parts do not turn black.
double line_width(double units_per_px) {
    return std::clamp(0.08 * units_per_px, 0.25, 1.0);
}

}  // namespace

std::vector<MeshEdge> visible_edges(const SampleMesh& mesh, const MaskCrop& crop) {
    const glm::ivec2 end_px = crop.begin_px + crop.size_px;
    std::vector<MeshEdge> edges;
    for (const SampleMesh::Triangle& triangle : mesh.triangle) {
        const glm::ivec2 a = place(mesh, triangle[0]);
        const glm::ivec2 b = place(mesh, triangle[1]);
        const glm::ivec2 c = place(mesh, triangle[2]);
        const glm::ivec2 low = glm::min(a, glm::min(b, c));
        const glm::ivec2 high = glm::max(a, glm::max(b, c));
        if (low.x >= end_px.x || low.y >= end_px.y || high.x < crop.begin_px.x || high.y < crop.begin_px.y) continue;
        for (int k = 0; k < 3; ++k) {
            const auto [first, second] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
            edges.push_back({first, second});
        }
    }
    std::ranges::sort(edges);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

std::string mesh_svg(const SampleMesh& mesh, const std::vector<MeshEdge>& edges, const MaskCrop& crop, double width) {
    const double scale = width / crop.size_px.x;
    const glm::dvec2 size(width, scale * crop.size_px.y);
    std::string data;
    for (const MeshEdge& edge : edges) {
        const glm::dvec2 from = scale * (glm::dvec2(place(mesh, edge[0]) - crop.begin_px) + 0.5);
        const glm::dvec2 to = scale * (glm::dvec2(place(mesh, edge[1]) - crop.begin_px) + 0.5);
        data.append("M").append(svg_number(from.x)).append(" ").append(svg_number(from.y));
        data.append("L").append(svg_number(to.x)).append(" ").append(svg_number(to.y));
    }
    SvgWriter svg(size.x, size.y, "Triangle mesh");
    svg.path(data, {.stroke = "#000000", .stroke_width = line_width(scale)});
    svg.rectangle({0.0, 0.0}, size, {.stroke = "#000000"});
    return svg.finish();
}

GreyPicture mesh_picture(const SampleMesh& mesh, const std::vector<MeshEdge>& edges, const MaskCrop& crop,
                         int width_px) {
    const double scale = static_cast<double>(width_px) / crop.size_px.x;
    GreyPicture picture(width_px, std::max(1, static_cast<int>(std::lround(scale * crop.size_px.y))), 255);
    for (const MeshEdge& edge : edges)
        draw_line(picture, scale * (glm::dvec2(place(mesh, edge[0]) - crop.begin_px) + 0.5),
                  scale * (glm::dvec2(place(mesh, edge[1]) - crop.begin_px) + 0.5), line_width(scale), 0);
    return picture;
}

}  // namespace macula
