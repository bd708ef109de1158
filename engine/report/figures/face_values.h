#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "engine/report/figures/field.h"

/// The one truth about a field in numbers.
namespace spia {

/// What is said of a field in numbers, wherever it is said: labels, worst spots, histogram, ends of
/// a legend, status line, tables, reports.
///
/// It is the value of a face. The solver has one strain, one thickness and one stress for each
/// face, and forming limits sort the faces into zones (engine/limits/limits.h); so a number that is
/// held against a limit is that of a face, not a mean of several, which would be smaller than the
/// greatest of them. Means at the vertices only colour a smooth contour, and a view that shows one
/// says so. The peak of a single face counts as any other: what warns too early can be looked at,
/// what warns too late is not seen. The distance of the surface is measured at places, not on
/// faces: a face has the greatest one of its corners, and the face at which the greatest of all
/// samples lies has that one (Deviation::max()).
struct FaceValues {
    Eigen::VectorXd value;         ///< one per face, in the unit of the field; noise is 0. Empty:
                                   ///< no field
    Eigen::VectorXd order = {};    ///< of the faces where a field of yes and no says yes, the
                                   ///< greatest is the worst; empty: it has numbers of its own
    int least = -1, greatest = -1; ///< faces; -1: no value is a number
    std::array<double, 2> extremes() const
    {
        return least < 0 ? std::array{0., 1.} : std::array{value[least], value[greatest]};
    }
};

/// @throws InputError if the field is not available
FaceValues face_values(const Session& session, Field field);
/// Of a state of unfolding step by step. @throws InputError if it does not have the field
FaceValues face_values(const TriMesh& part, const SheetFields& of_face, Field field);

/// Values of a field that are smaller are nothing but noise: they are shown as 0, and differences
/// as none. In the unit of the field.
/// @param size of the part, mm
double noise(Field field, double size);

/// What a face has left up to the forming limit curve, engineering major strain, below 0 beyond it;
/// nothing where there is no curve.
std::optional<double> margin_of(const LimitsResult& limits, int face);

/// The faces that are to be looked at, the worst first; none where all that the field says is
/// noise, or where it is bad nowhere.
std::vector<int> worst_faces(const TriMesh& part, const FaceValues& values, Field field, int most);

} // namespace spia
