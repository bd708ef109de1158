#include "engine/sparse/sparse_version.h"

#include <SuiteSparse_config.h>
#include <fmt/core.h>

namespace spia {

std::string suitesparse_version()
{
    int version[3] = {};
    SuiteSparse_version(version);
    return fmt::format("{}.{}.{}", version[0], version[1], version[2]);
}

} // namespace spia
