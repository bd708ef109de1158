#pragma once
#include <XSControl_Reader.hxx>
#include <string>
#include <vector>

namespace spia {

/// What OpenCASCADE's check of a file finds wrong with single entities.
struct CadDamage {
    std::string fatal;              ///< the first fault of something that shapes or their size
                                    ///< need; empty: there is none
    std::vector<std::string> aside; ///< labels of faulty entities that no shape needs, e.g. "#671"
};

/// For .cpp files of engine/exchange that hold an OcctSession. Files of some programs have faults
/// that hurt no shape, say in a colour or, as Creo writes it, in the dimensions of the degree. An
/// entity of a STEP file is needed if a face, shell, solid, placement or representation of shapes
/// refers to it, also through others, but not through the context of a representation, which holds
/// units and uncertainties. Of these the unit of lengths is needed, and where there are cones or
/// trimmed curves that of angles, if it does not say how many radians it has. All entities of an
/// IGES file are.
/// @param read  its file is read, nothing need be transferred
CadDamage damage_in(const XSControl_Reader& read);

} // namespace spia
