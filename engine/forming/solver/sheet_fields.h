#pragma once
#include <vector>

#include "engine/forming/blank.h"
#include "engine/forming/solver/membrane.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// A field of one number per entry.
struct SheetScalar {
    const char* name;
    Eigen::VectorXd SheetFields::*values;
};
/// All of them.
inline constexpr SheetScalar sheet_scalars[] = {{"thickness", &SheetFields::thickness},
                                                {"thinning", &SheetFields::thinning},
                                                {"strain_major", &SheetFields::strain_major},
                                                {"strain_minor", &SheetFields::strain_minor},
                                                {"stress_major", &SheetFields::stress_major},
                                                {"stress_minor", &SheetFields::stress_minor},
                                                {"strain_equivalent", &SheetFields::strain_equivalent},
                                                {"stress_equivalent", &SheetFields::stress_equivalent}};

/// Strains, thickness and stresses of forming a blank into the part, one entry per face.
SheetFields face_fields(const TriMesh& part, const std::vector<Element>& element, const Blank& blank,
                        const Sheet& sheet);

/// One entry per vertex: the area-weighted mean of the faces around it; of the directions d, the
/// major axis of the mean of d d^T. A vertex necks if a face around it does.
SheetFields node_fields(const TriMesh& part, const std::vector<Element>& element, const SheetFields& face);

/// Room for as many entries, not set.
SheetFields sized_fields(Eigen::Index entries);

/// Copies entry k to entry at[k].
void put_fields(const SheetFields& from, const std::vector<int>& at, SheetFields& to);

} // namespace spia
