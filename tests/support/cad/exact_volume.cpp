#include "tests/support/cad/exact_volume.h"

#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>
#include <STEPControl_Reader.hxx>
#include <stdexcept>

#include "engine/exchange/cad/occt_session.h"

namespace spia::shapes {

double exact_volume(const std::filesystem::path& step)
{
    const OcctSession session;
    STEPControl_Reader reader;
    if (reader.ReadFile(step.c_str()) != IFSelect_RetDone || reader.TransferRoots() < 1)
        throw std::runtime_error("not read: " + step.string());
    GProp_GProps properties;
    constexpr double relative = 1e-7;
    BRepGProp::VolumeProperties(reader.OneShape(), properties, relative, true);
    return properties.Mass();
}

} // namespace spia::shapes
