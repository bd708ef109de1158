#pragma once
#include <string>
#include <vector>

#include "engine/nurbs/multi_patch.h"

namespace spia {

/// A quantity on the surface, e.g. the thickness of the sheet: on each patch a function of the
/// patch's own basis, weights included, f = sum(N_k w_k f_k) / sum(N_k w_k).
struct PatchField {
    std::string name;                   ///< one word, e.g. "thickness"
    std::string unit;                   ///< "mm" for a length, which is then written in the unit of
                                        ///< the file; "1" for none
    std::vector<Eigen::VectorXd> value; ///< per patch one number per control point, in their order
};

/// The value at a place of the patch; (u, v) beyond the domain counts as the nearest place of the
/// domain.
/// @param value one per control point
double evaluate_field(const NurbsSurface& surface, const Eigen::VectorXd& value, double u, double v);

/// The mean over the area of the patch, by Gauss points: exact but for the square root in the area.
double field_mean(const NurbsSurface& surface, const Eigen::VectorXd& value);

/// Control values of a field that is known at the lines u[i], v[j] of a grid, such as the nodes of
/// a lifted grid with the parameters that interpolate() gave them. With as many control points as
/// values the field has the values there; with fewer it is the least squares field, in which the
/// values at the four corners are kept and each side depends on the values along it alone; with
/// more, what the values leave open is as smooth as can be (second differences of control values).
/// @param u, v  rising from 0 to 1
/// @param at_nodes  value i + j * u.size() at u[i], v[j]
/// @throws InputError if there are not as many values as nodes, or one is not finite
Eigen::VectorXd fit_field(const NurbsSurface& surface, const std::vector<double>& u, const std::vector<double>& v,
                          const Eigen::VectorXd& at_nodes);

/// Makes the control values of sides that meet the same doubles, those of the first patch; rounding
/// may have set them apart. @throws InputError if they differ by more than rounding, or a patch has
/// not one finite value per control point
void share_borders(const MultiPatch& patches, PatchField& field);

/// @throws InputError if a patch has not one finite value per control point, or the two sides of an
/// interface differ
void require_field(const MultiPatch& patches, const PatchField& field);

} // namespace spia
