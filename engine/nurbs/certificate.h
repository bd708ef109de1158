#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/progress.h"
#include "engine/nurbs/multi_patch.h"

namespace spia {

/// A place of a patch.
struct PatchPlace {
    double u = 0, v = 0;
    Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< mm
};

/// Where a patch is not proved to be free of folds, and why.
struct Refusal {
    enum class Why {
        folded,    ///< the normals turn round within one span
        vanishes,  ///< S_u x S_v is zero or close to it: a collapsed side, or two directions that
                   ///< become one
        sharp_edge ///< the normals of two neighbouring spans, which meet with a kink, are 90
                   ///< degrees or more apart
    };
    Why why = Why::vanishes;
    PatchPlace place;
};

/// What analysis asks of one patch. Means and extremes are over 4 x 4 Gauss points per span and the
/// corners of the spans.
struct PatchCertificate {
    /// Nothing if S_u x S_v is nowhere zero, and within each piece of a span within 90 degrees of
    /// one normal: proved by the Bezier coefficients of its numerator, all of which are on the
    /// positive side of that normal, by more than rounding.
    std::optional<Refusal> refusal;
    int pieces = 0;               ///< that the proof took, spans included
    double proved_jacobian = 0;   ///< mm2, a lower bound of |S_u x S_v| over the whole patch; 0 if
                                  ///< it is refused
    double least_jacobian = 0;    ///< mm2, at the samples
    double greatest_jacobian = 0; ///< mm2
    double least_scaled = 1;      ///< |S_u x S_v| / (|S_u| |S_v|), the sine of the angle between
                                  ///< the parameter lines
    double mean_scaled = 1;       ///< mean over the samples
    PatchPlace least_scaled_at;
    double orthogonality = 0;  ///< mean of (S_u . S_v)^2 / (|S_u|^2 |S_v|^2): 0 is best
    double condition = 1;      ///< greatest (|S_u|^2 + |S_v|^2) / (2 |S_u x S_v|): 1 is best;
                               ///< infinite where S_u x S_v vanishes
    double aspect = 1;         ///< greatest ratio of the mean side lengths of a span, 1 or more
    double neighbour_area = 1; ///< greatest ratio of the areas of two spans that share a border, 1
                               ///< or more
};

/// How two patches meet.
struct InterfaceCertificate {
    PatchInterface joint;
    double greatest_angle = 0; ///< radians, between the normals of the two patches along the
                               ///< interface, at 4 places per span and its ends
    double mean_angle = 0;     ///< radians
};

/// What analysis asks of a surface.
struct Certificate {
    std::vector<PatchCertificate> patch;
    std::vector<InterfaceCertificate> interfaces;
    std::string leak; ///< why the control nets are not watertight (require_watertight()); empty:
                      ///< they are, to the last bit

    bool suited() const; ///< watertight, and no patch refused
    /// The patch with the least scaled Jacobian; there is one at least.
    const PatchCertificate& poorest() const;
};

/// Examines every patch. The numerator of S_u x S_v is w A_u x A_v + w_v A x A_u + w_u A_v x A for
/// S = A / w, of degree (3p - 1, 3q - 1), or A_u x A_v of degree (2p - 1, 2q - 1) for a polynomial
/// patch; its Bezier coefficients on a span enclose it, and come closer to it by halving. [Gravesen
/// et al. 2014, for plane maps; the measures are those of exchange of grids, Knupp 2001]
/// @param progress  a checkpoint every row of spans
/// @throws InputError if a patch has a degree beyond max_degree or counts that do not fit
Certificate certify(const MultiPatch& patches, const Progress& progress = {});

/// In words, e.g. "folds at u = 0.31, v = 0.5 (12.1, 40, 3.2 mm)".
std::string describe(const Refusal& refusal);

} // namespace spia
