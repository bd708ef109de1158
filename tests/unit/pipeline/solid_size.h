#pragma once
#include <gtest/gtest.h>
#include <numbers>

#include "engine/pipeline/session.h"
#include "tests/support/cad/bent_solid.h"
#include "tests/support/flat_area.h"

namespace spia {

/// mm, of sizes of a blank: STL files hold single precision, and their bends are chords.
inline double size_within(shapes::CadForm form) { return form == shapes::CadForm::stl ? 2e-3 : 1e-4; }

/// The blank is as long and wide as the solid unrolled along its middle, whichever way it lies.
inline void expect_developed_size(const Session& session, const shapes::BentSolid& solid, double within)
{
    const Eigen::Matrix2Xd& X = session.blank->blank.position;
    const Eigen::Vector2d size = X.rowwise().maxCoeff() - X.rowwise().minCoeff(),
                          made(solid.developed(0.5), solid.width);
    EXPECT_NEAR(size.minCoeff(), made.minCoeff(), within);
    EXPECT_NEAR(size.maxCoeff(), made.maxCoeff(), within);
}

/// mm2, of the solid unrolled along its middle, as if nothing were cut out.
inline double developed_area(const shapes::BentSolid& solid) { return solid.developed(0.5) * solid.width; }

/// mm2, of a round hole.
inline double round_area(double radius) { return std::numbers::pi * radius * radius; }

/// The blank has that area but for what is cut out.
/// @param cut, within  mm2
inline void expect_developed_area(const Session& session, const shapes::BentSolid& solid, double cut, double within)
{
    EXPECT_NEAR(shapes::flat_area(session.blank->blank.position, session.part->mesh.triangle),
                developed_area(solid) - cut, within);
}

} // namespace spia
