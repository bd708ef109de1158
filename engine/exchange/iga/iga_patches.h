#pragma once
#include <span>
#include <string>
#include <string_view>

#include "engine/core/length_unit.h"
#include "engine/nurbs/patch_field.h"

/// What the writers of isogeometric files have in common.
namespace spia {

/// The patches in the unit of the file; one division per number, so that what is shared stays the
/// same to the last bit.
/// @throws InputError if there is no patch, one is not a surface (require_exchangeable()), or they
/// are not watertight
MultiPatch patches_in(LengthUnit unit, const MultiPatch& patches_mm);

/// The field in the unit of the file if it is a length. @throws InputError as require_field()
PatchField field_in(LengthUnit unit, const MultiPatch& patches, const PatchField& field);

/// Whether the patch needs weights to be told.
bool is_rational(const NurbsSurface& patch);

/// Numbers in a row, with as many digits as it takes to read back the same bits (17 at most),
/// whatever the locale.
std::string row_of(std::span<const double> numbers);
std::string row_of(const Eigen::Ref<const Eigen::VectorXd>& numbers);

/// The lines that introduce a file, without the signs of a comment: program, name, what it is,
/// lengths. The name may be anything: controls, line ends and "--" (which ends a comment of XML)
/// are taken out of it.
std::string head_line(std::string_view name, std::string_view what, LengthUnit unit);

} // namespace spia
