#pragma once
#include <Eigen/Core>
#include <array>

#include "engine/pipeline/session.h"

/// What panels say about results as a whole: made once per result, for looking at all vertices or faces takes time.
namespace spia {

struct PartFigures {
    Eigen::Vector3d size{0, 0, 0}; ///< mm, along the axes
    double diagonal = 0;           ///< mm
};
PartFigures part_figures(const PartFile& part);

/// Least and greatest values over the faces; what is noise() is 0.
struct SheetFigures {
    Eigen::Vector2d size{0, 0}; ///< mm, of the blank
    std::array<double, 2> thinning{}, strain_major{}, strain_minor{};
    double strain_equivalent = 0; ///< greatest
};
SheetFigures sheet_figures(const FlattenResult& flat);

struct GridFigures {
    std::array<double, 4> side{}; ///< mm, on the blank
    int worst_cell = -1;          ///< i + j * columns: the one with the least scaled Jacobian
    int column = 0, row = 0;      ///< of that cell, from 0
    double scaled_jacobian = 1;   ///< its value
};
GridFigures grid_figures(const GridStage& grid, const Blank& blank);

} // namespace spia
