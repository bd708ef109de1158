#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/forming/material/membrane_law.h"

namespace spia {

/// The flat sheet, face by face: a tailor-welded blank has more than one grade and gauge.
struct Sheet {
    std::vector<MembraneLaw> law; ///< one per grade
    Eigen::VectorXi grade;        ///< #F, into law; empty: all of the first
    Eigen::VectorXd thickness;    ///< #F, mm, before forming

    const MembraneLaw& law_of(int face) const { return law[grade.size() ? size_t(grade[face]) : 0]; }
};

/// One grade and one gauge all over.
Sheet uniform_sheet(const MembraneLaw& law, double thickness, int faces);

} // namespace spia
