#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "engine/core/length_unit.h"
#include "engine/exchange/sheet_field_list.h"
#include "engine/limits/limits.h"

namespace spia {

/// Writes the part as a VTK XML unstructured grid for ParaView, binary, every number in full. Point
/// data: the node fields, blank_x and blank_y, displacement_to_blank ("Warp By Vector" with factor
/// 1 shows the blank in the plane z = 0) and the extra lengths (e.g. the deviation of the surface).
/// Cell data: the face fields. Field data: length_unit, the name of the unit of points,
/// displacement, thickness and extra fields.
/// With zones the cell data have their numbers, `zone`, and limit_distance where there is a forming
/// limit curve; the field data zone_names say which is which.
/// With skins the cell data have their strains (skin_fields()).
/// @param extra one length per vertex each, mm
/// @param blank_from how the blank was made, as field data of that name; may be empty
/// @throws InputError if the fields do not match the part or are not finite; ExchangeError if the
/// file cannot be written
void write_vtu(const std::filesystem::path& path, const TriMesh& part, const Blank& blank,
               const SheetFields& face_fields, const SheetFields& node_fields, std::span<const NamedField> extra = {},
               LengthUnit unit = LengthUnit::mm, const Zones* zones = nullptr, const SkinStrains* skins = nullptr,
               std::string_view blank_from = {});

/// Writes a part while it is unfolded: the places of a state with the part's faces. Point data:
/// displacement_to_part ("Warp By Vector" with factor 1 shows the part). Cell data: the fields of
/// forming the state into the part, and the numbers.
/// @param state  3 by #V, mm
/// @param numbers by the names they have in the file, one per face each
/// @throws as write_vtu()
void write_state_vtu(const std::filesystem::path& path, const TriMesh& part, const Eigen::Matrix3Xd& state,
                     const SheetFields& face_fields,
                     std::span<const std::pair<std::string, const Eigen::VectorXi*>> numbers = {},
                     LengthUnit unit = LengthUnit::mm);

} // namespace spia
