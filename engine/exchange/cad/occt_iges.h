#pragma once
#include <IGESData_IGESEntity.hxx>
#include <TCollection_HAsciiString.hxx>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/length_unit.h"

namespace spia {

/// The text of an IGES file of some entities, with a header that names this program. For .cpp files
/// of engine/exchange.
/// @param entities makes them, their numbers in the unit of the file: OpenCASCADE scales shapes,
/// not entities; called while an
///                 OcctSession is held
/// @param largest_mm coordinate
/// @throws ExchangeError if OpenCASCADE refuses
std::string iges_text(const std::function<std::vector<Handle(IGESData_IGESEntity)>()>& entities, double largest_mm,
                      const std::string& file_name, const std::string& part_name, LengthUnit unit);

/// IGES text is printable ASCII in lines of fixed length; anything else becomes a question mark.
Handle(TCollection_HAsciiString) iges_string(std::string value);

} // namespace spia
