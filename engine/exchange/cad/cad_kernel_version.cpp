#include "engine/exchange/cad/cad_kernel_version.h"

#include <Standard_Version.hxx>

namespace spia {

std::string cad_kernel_version() { return OCC_VERSION_COMPLETE; }

} // namespace spia
