#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/length_unit.h"
#include "engine/nurbs/patch_field.h"
#include "engine/pipeline/session.h"

namespace spia {

/// Formats of isogeometric analysis, by the names the command line uses: gismo, mfem, geopdes,
/// iga-k (LS-DYNA).
const std::vector<std::string>& iga_formats();
bool is_iga_format(const std::string& format);

/// gismo NAME-gismo.xml with NAME-gismo-thickness.xml and -plastic_strain.xml; mfem NAME-mfem.mesh
/// with -thickness.gf and -plastic_strain.gf; geopdes NAME-geopdes.txt and iga-k NAME-iga.k, which
/// have no fields. @pre is_iga_format()
std::vector<std::string> iga_file_names(const std::string& format, const std::string& name);

/// Thickness after forming and plastic strain on the patches, from their values at the nodes of the
/// lifted grid. @pre session.surface
std::vector<PatchField> surface_fields(const Session& session);

/// Writes the files of one such format.
/// @returns the files, in the order of iga_file_names()
/// @throws InputError if the surface cannot be written; ExchangeError if a file cannot be written
std::vector<std::filesystem::path> write_iga_files(const std::filesystem::path& folder, const std::string& name,
                                                   const std::string& format, const Session& session,
                                                   LengthUnit unit = LengthUnit::mm);

} // namespace spia
