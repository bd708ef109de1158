#pragma once
#include <filesystem>
#include <vector>

#include "engine/nurbs/multi_patch.h"

/// Readers of isogeometric files as the programs that take them read them, without a line of the
/// writers.
namespace spia::iga {

struct Content {
    MultiPatch patches; ///< without control points if the file is a field
    std::vector<Eigen::Matrix4Xd>
        points; ///< per patch as in the file: x, y, z (multiplied by the weight or not) and weight
    std::vector<Eigen::VectorXd> values; ///< of a field
    std::vector<PatchSide> outer;
    std::vector<double> thickness; ///< LS-DYNA: per patch
};

/// All throw std::runtime_error with a word if the file is not of the form.
Content read_gismo(const std::filesystem::path& file);
Content read_geopdes(const std::filesystem::path& file);
Content read_mfem(const std::filesystem::path& file);
Content read_dyna(const std::filesystem::path& file);
/// @param patches of the mesh
std::vector<Eigen::VectorXd> read_mfem_field(const std::filesystem::path& file, const MultiPatch& patches);

} // namespace spia::iga
