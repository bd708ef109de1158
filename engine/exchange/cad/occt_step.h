#pragma once
#include <STEPControl_Writer.hxx>
#include <StepData_StepModel.hxx>
#include <TopoDS_Shape.hxx>
#include <functional>
#include <string>

#include "engine/core/length_unit.h"

namespace spia {

constexpr double step_resolution = 1e-6; ///< mm; the uncertainty in STEP files, and how close
                                         ///< borders must be to be one

/// The text of a STEP file (AP242) of one product, with a header that names this program. For .cpp
/// files of engine/exchange.
/// @param shape makes it, in mm, while an OcctSession is held
/// @param check sees what it became: what OpenCASCADE leaves out it leaves out without a word; may
/// name entities
/// @throws ExchangeError if OpenCASCADE refuses
std::string step_text(const std::function<TopoDS_Shape()>& shape, STEPControl_StepModelType type,
                      const std::function<void(const StepData_StepModel&)>& check, const std::string& file_name,
                      const std::string& part_name, LengthUnit unit);

} // namespace spia
