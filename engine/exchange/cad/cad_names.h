#pragma once
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopoDS_Shape.hxx>
#include <XSControl_Reader.hxx>
#include <string>
#include <vector>

#include "engine/part/cad_tree.h"

namespace spia {

/// What a file calls its shapes. For .cpp files of engine/exchange that hold an OcctSession.
class CadNames {
public:
    CadNames() = default;                            ///< of a file that names nothing
    explicit CadNames(const XSControl_Reader& read); ///< of what was transferred

    std::string shape(const TopoDS_Shape& shape) const;  ///< wherever it is placed; empty: none
    std::string place(const TopoDS_Shape& placed) const; ///< of what stands at this place of an
                                                         ///< assembly; empty: none

private:
    std::vector<std::string> name_;
    TopTools_DataMapOfShapeInteger of_shape_, of_place_;
};

/// Assemblies and bodies of a shape, with the faces in the order of a TopExp_Explorer. Compounds
/// without a name, and with one body alone, are not told apart from what they hold.
CadTree tree_of(const TopoDS_Shape& shape, const CadNames& names);

} // namespace spia
