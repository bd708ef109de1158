#pragma once
#include <filesystem>

#include "engine/core/length_unit.h"
#include "engine/exchange/lines/blank_outline.h"
#include "engine/forming/solver/skin_strain.h"
#include "engine/limits/limits.h"

namespace spia {

/// vertex,x,y,z,blank_x,blank_y,thickness,thinning,strain_major,strain_minor,strain_equivalent -
/// one row per vertex in the order of the input. Each number has the fewest digits that read back
/// as the same double. Columns of lengths in another unit than mm say so: x_inch, y_inch, z_inch,
/// blank_x_inch, blank_y_inch, thickness_inch.
/// @param number what each vertex is called in the first column; empty: 0, 1, 2, ...
/// @throws InputError if blank or fields do not match the part; ExchangeError if the file cannot be
/// written
void write_fields_csv(const std::filesystem::path& path, const TriMesh& part, const Blank& blank,
                      const SheetFields& node_fields, const std::vector<int>& number = {},
                      LengthUnit unit = LengthUnit::mm);

/// face,x,y,z,thickness,thinning,strain_major,strain_minor,strain_equivalent,zone,limit_distance -
/// one row per face; x, y, z is its middle on the part. Without zones the last two columns are left
/// out, without a forming limit curve the last one. With skins their six strains follow
/// (skin_fields()).
/// @param number what each face is called in the first column; empty: 0, 1, 2, ...
/// @throws InputError if fields or zones do not match the part; ExchangeError if the file cannot be
/// written
void write_faces_csv(const std::filesystem::path& path, const TriMesh& part, const SheetFields& face_fields,
                     const Zones* zones, const std::vector<int>& number = {}, LengthUnit unit = LengthUnit::mm,
                     const SkinStrains* skins = nullptr);

/// loop,index,x,y - one row per point; loop 0 is the outer one. Numbers as above.
/// @throws InputError if there is no outline; ExchangeError if the file cannot be written
void write_outline_csv(const std::filesystem::path& path, const std::vector<OutlineLoop>& loops,
                       LengthUnit unit = LengthUnit::mm);

} // namespace spia
