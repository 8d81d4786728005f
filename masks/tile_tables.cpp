#include "masks/tile_tables.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <tuple>

#include <boost/polygon/voronoi.hpp>

namespace macula {
namespace {

/// Pixel of the plane that the rank tile is repeated over, or a site: a sampled pixel.
struct Site {
    int x = 0;
    int y = 0;
};

using Triangle = std::array<Site, 3>;

constexpr int kEdge = RankTile::kEdge_px;
/// Repeated sites around the tile: more than the diameter of the largest circle that no site of the sparsest
/// level lies in, so that the triangles over the tile are those of the infinite plane. The tile begins here.
constexpr int kMargin_px = 32;

int wrap(int coordinate) {
    return (coordinate - kMargin_px) & (kEdge - 1);
}

/// Twice the signed area.
int area2(const Site& a, const Site& b, const Site& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Delaunay triangles, counter-clockwise, of the first `count` ranks repeated over the plane, wherever they can
/// touch the tile. Sites are integers, for which Boost's builder is exact.
std::vector<Triangle> triangulate(const RankTile& tile, int count) {
    std::vector<Site> sites;
    std::vector<boost::polygon::point_data<int>> points;
    for (int y = 0; y < kEdge + 2 * kMargin_px; ++y) {
        for (int x = 0; x < kEdge + 2 * kMargin_px; ++x) {
            if (tile.at(wrap(x), wrap(y)) >= count) continue;
            sites.push_back({x, y});
            points.emplace_back(x, y);
        }
    }
    boost::polygon::voronoi_diagram<double> diagram;
    boost::polygon::construct_voronoi(points.begin(), points.end(), &diagram);

    // A Voronoi vertex stands for the circle through the sites of its cells: three, or more on pixel grids. Their
    // polygon is cut from the corner that comes first in an irregular order that is the same in every copy.
    const auto key = [&tile](const Site& s) { return std::tuple(tile.at(wrap(s.x), wrap(s.y)), wrap(s.y), wrap(s.x)); };
    std::vector<Triangle> triangles;
    std::vector<Site> polygon;
    for (const auto& vertex : diagram.vertices()) {
        polygon.clear();
        const auto* edge = vertex.incident_edge();
        do {
            polygon.push_back(sites[edge->cell()->source_index()]);
            edge = edge->rot_next();
        } while (edge != vertex.incident_edge());
        std::rotate(polygon.begin(),
                    std::min_element(polygon.begin(), polygon.end(),
                                     [&key](const Site& a, const Site& b) { return key(a) < key(b); }),
                    polygon.end());
        for (std::size_t i = 2; i < polygon.size(); ++i) triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
    }
    return triangles;
}

/// Three corners of a pixel's triangle, heaviest first, and their weights in 1/256; they add up to 256.
struct Interpolation {
    Triangle corner{};
    std::array<int, 3> weight{};
};

/// Exact barycentric weights of `pixel`, rounded; corners that weigh nothing repeat the heaviest.
Interpolation interpolate(const Triangle& t, const Site& pixel) {
    std::array<std::pair<int, Site>, 3> part = {
        {{area2(t[1], t[2], pixel), t[0]}, {area2(t[2], t[0], pixel), t[1]}, {area2(t[0], t[1], pixel), t[2]}}};
    std::stable_sort(part.begin(), part.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    const int whole = area2(t[0], t[1], t[2]);
    Interpolation result;
    for (int i = 0; i < 3; ++i) {
        result.weight[i] = (512 * part[i].first + whole) / (2 * whole);
        result.corner[i] = result.weight[i] > 0 ? part[i].second : part[0].second;
    }
    // Rounding both lesser weights up must not make the second the largest.
    if (result.weight[1] > 256 - result.weight[1] - result.weight[2]) --result.weight[1];
    result.weight[0] = 256 - result.weight[1] - result.weight[2];
    return result;
}

/// The interpolation of every pixel of the 64x64 tile at one level.
std::vector<Interpolation> interpolate_all(const RankTile& tile, int count) {
    std::vector<Interpolation> all(std::size_t{kEdge} * kEdge);
    for (const Triangle& t : triangulate(tile, count)) {
        const auto [left, right] = std::minmax({t[0].x, t[1].x, t[2].x});
        const auto [top, bottom] = std::minmax({t[0].y, t[1].y, t[2].y});
        for (int y = std::max(top, kMargin_px); y <= std::min(bottom, kMargin_px + kEdge - 1); ++y) {
            for (int x = std::max(left, kMargin_px); x <= std::min(right, kMargin_px + kEdge - 1); ++x) {
                const Site pixel{x, y};
                const bool inside =
                    area2(t[0], t[1], pixel) >= 0 && area2(t[1], t[2], pixel) >= 0 && area2(t[2], t[0], pixel) >= 0;
                if (inside) all[wrap(y) * kEdge + wrap(x)] = interpolate(t, pixel);
            }
        }
    }
    return all;
}

/// Collects the samples that the pixels of one tile refer to.
class PaletteBuilder {
public:
    PaletteBuilder(const RankTile& tile, int count, Site tile_origin) : tile_(tile), origin_(tile_origin) {
        index_.fill(-1);
        palette_.resize(static_cast<std::size_t>(count));
        for (int pixel = 0; pixel < kTileArea_px; ++pixel) {
            const PaletteEntry own = entry({origin_.x + pixel % kTileEdge_px, origin_.y + pixel / kTileEdge_px});
            if (own.rank >= count) continue;
            palette_[own.rank] = own;
            index_[own.neighbour * kTileArea_px + pixel] = own.rank;
        }
    }

    std::uint8_t index_of(const Site& site) {
        const PaletteEntry wanted = entry(site);
        std::int16_t& index = index_[wanted.neighbour * kTileArea_px + wanted.pixel];
        if (index < 0) {
            if (palette_.size() == kTileArea_px)
                throw std::invalid_argument("rank tile: a tile interpolates more than 256 samples");
            index = static_cast<std::int16_t>(palette_.size());
            palette_.push_back(wanted);
        }
        return static_cast<std::uint8_t>(index);
    }

    [[nodiscard]] const std::vector<PaletteEntry>& palette() const { return palette_; }

private:
    [[nodiscard]] PaletteEntry entry(const Site& site) const {
        // The summand makes the division round down.
        const int dx = (site.x - origin_.x + 16 * kTileEdge_px) / kTileEdge_px - 16;
        const int dy = (site.y - origin_.y + 16 * kTileEdge_px) / kTileEdge_px - 16;
        if (std::abs(dx) > 1 || std::abs(dy) > 1)
            throw std::invalid_argument("rank tile: a pixel interpolates a sample beyond the neighbour tiles");
        const int x = site.x - origin_.x - dx * kTileEdge_px;
        const int y = site.y - origin_.y - dy * kTileEdge_px;
        return {static_cast<std::uint8_t>(3 * (dy + 1) + dx + 1), tile_.at(wrap(site.x), wrap(site.y)),
                static_cast<std::uint8_t>(kTileEdge_px * y + x)};
    }

    const RankTile& tile_;
    Site origin_;
    std::array<std::int16_t, std::size_t{9} * kTileArea_px> index_;  ///< by neighbour and pixel; -1: not yet met
    std::vector<PaletteEntry> palette_;
};

CellTable make_cell(const RankTile& tile, int count, const std::vector<Interpolation>& all, int cell_x, int cell_y) {
    const Site origin{kMargin_px + cell_x * kTileEdge_px, kMargin_px + cell_y * kTileEdge_px};
    PaletteBuilder palette(tile, count, origin);
    CellTable cell;
    for (int pixel = 0; pixel < kTileArea_px; ++pixel) {
        const int x = cell_x * kTileEdge_px + pixel % kTileEdge_px;
        const int y = cell_y * kTileEdge_px + pixel / kTileEdge_px;
        const Interpolation& from = all[y * kEdge + x];
        cell.a[pixel] = palette.index_of(from.corner[0]);
        cell.b[pixel] = palette.index_of(from.corner[1]);
        cell.c[pixel] = palette.index_of(from.corner[2]);
        cell.weight_b[pixel] = static_cast<std::uint8_t>(from.weight[1]);
        cell.weight_c[pixel] = static_cast<std::uint8_t>(from.weight[2]);
    }
    cell.palette = palette.palette();
    return cell;
}

}  // namespace

TileTables::TileTables(const RankTile& rank_tile)
    : rank_tile_(rank_tile), cells_(std::size_t{kFullLevel} * RankTile::kCells * RankTile::kCells) {
    for (int level = 1; level < kFullLevel; ++level) {
        const int count = kLevelCounts[level];
        const std::vector<Interpolation> all = interpolate_all(rank_tile_, count);
        for (int cell_y = 0; cell_y < RankTile::kCells; ++cell_y) {
            for (int cell_x = 0; cell_x < RankTile::kCells; ++cell_x) {
                cells_[(level * RankTile::kCells + cell_y) * RankTile::kCells + cell_x] =
                    make_cell(rank_tile_, count, all, cell_x, cell_y);
            }
        }
    }
}

}  // namespace macula
