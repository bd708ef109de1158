#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/forming/blank.h"
#include "engine/forming/solver/skin_strain.h"
#include "engine/limits/limits.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// A scalar by the name it has in files, e.g. "thinning". Borrows the values.
struct NamedField {
    std::string name;
    const Eigen::VectorXd* value;
};

/// thickness, thinning, strain_major, strain_minor, strain_equivalent: the fields every format
/// offers, in this order.
std::vector<NamedField> forming_fields(const SheetFields& fields);

/// stress_major, stress_minor, stress_equivalent.
std::vector<NamedField> stress_fields(const SheetFields& fields);

/// outer_strain_major, ..., inner_strain_equivalent, one value per face.
std::vector<NamedField> skin_fields(const SkinStrains& skins);

/// @throws InputError unless the blank has one finite point for each finite vertex of the part, and
/// faces name vertices
void require_blank_of(const TriMesh& part, const Blank& blank);

/// @throws InputError unless every field has count finite values; @param per what they belong to,
/// e.g. "vertex"
void require_fields(const SheetFields& fields, int count, const char* per);

/// @throws InputError if there are zones, but not one per face of the part
void require_zones(const Zones* zones, const TriMesh& part);

/// @throws InputError naming the field and the first value that is not finite
void require_finite(const NamedField& field, int count, const char* per);

} // namespace spia
