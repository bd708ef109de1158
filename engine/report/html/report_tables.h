#pragma once
#include <string>

#include "engine/pipeline/session.h"
#include "engine/report/figures/figures.h"
#include "engine/report/html/report_options.h"

/// The tables of a report on a part that is unfolded at least, as HTML; empty if there is nothing
/// to say. `lengths`: mm or inch.
namespace spia {

/// The four great figures. @param figures  result_figures() of the session
std::string tiles(const Session& session, const ResultFigures& figures, LengthUnit lengths = LengthUnit::mm);
std::string key_figures(const Session& session, const ResultFigures& figures, LengthUnit lengths = LengthUnit::mm);
/// Where the sheet thins most: the first five of worst_spots().
std::string thinnest_places(const Session& session, LengthUnit lengths = LengthUnit::mm);
/// What the lengths of the blank are lengths of, and all bends.
std::string bend_table(const Session& session, const ReportReader& reader = {});
/// What was taken for granted, asked for and given up: material, sheet, direction, friction,
/// method, equations, repairs.
std::string assumptions(const Session& session, LengthUnit lengths = LengthUnit::mm);
/// How the solver got there, with its residuals and the hardening curve.
std::string solving(const Session& session, LengthUnit lengths = LengthUnit::mm);
/// The part as it was read.
std::string repairs(const PartFile& part, const ReportReader& reader = {});

} // namespace spia
