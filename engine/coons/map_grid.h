#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <utility>

#include "engine/coons/blank_search.h"
#include "engine/coons/boundary.h"
#include "engine/coons/grid.h"
#include "engine/coons/harmonic_map.h"
#include "engine/coons/place_border.h"
#include "engine/mesh/fill_holes.h"
#include "engine/mesh/locate.h"

namespace spia {

/// A map of the blank onto the unit square, and its inverse.
struct SquareMap {
    HarmonicMap map;
    PlanarLocator square;
    GridRoute route;

    SquareMap(HarmonicMap to_square, GridRoute way)
        : map(std::move(to_square)), square(map.square, map.triangle), route(way)
    {
    }
};

/// Everything the ways to a grid share: the blank as a search structure, and the harmonic map once
/// it is needed.
struct GridContext {
    std::shared_ptr<const FilledMesh> filled;
    BlankBoundary boundary;
    BlankSearch blank;
    std::optional<SquareMap> harmonic = {};
};

/// Where the lines of a grid lie in the unit square of a map.
struct MapLines {
    Eigen::VectorXd u, v; ///< rising from 0 to 1
};

MapLines even_lines(int columns, int rows);

/// Where the lines of the square meet the sides of the blank.
BorderParameters border_of_map(const HarmonicMap& map, const BlankBoundary& boundary, const MapLines& lines);

/// A grid whose inner nodes are at the origin and nowhere on the blank yet.
GridResult empty_grid(const GridContext& context, int columns, int rows, const BorderParameters& border);

/// A map onto the unit square, inverted where the lines cross. Each node keeps the triangle it was
/// found in.
GridResult grid_of_map(const SquareMap& map, const GridContext& context, const MapLines& lines,
                       const BorderParameters& border);

} // namespace spia
