#pragma once
#include <Eigen/Core>
#include <TCollection_HAsciiString.hxx>
#include <gp_XYZ.hxx>
#include <string>

namespace spia {

inline Eigen::Vector3d vector(const gp_XYZ& p) { return {p.X(), p.Y(), p.Z()}; }

inline Handle(TCollection_HAsciiString) ascii(const std::string& text)
{
    return new TCollection_HAsciiString(text.c_str());
}

} // namespace spia
