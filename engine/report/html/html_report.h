#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/pipeline/session.h"
#include "engine/report/html/report_options.h"

namespace spia {

struct ReportPicture {
    std::string title;
    std::string png; ///< bytes of the file
};

/// Writes one HTML file that needs no other, for the screen and for A4 paper: what makes the result
/// poorer, key figures, places of the greatest thinning, assumptions, how the solver got there,
/// pictures. Lengths in mm or inch.
/// @param pictures  drawn by the caller
/// @param doubts  what makes the result poorer, in words, see find_doubts(); none: what the engine
/// says of it
/// @throws InputError  if the part is not solved, or a picture is no PNG
/// @throws ExchangeError  if the file cannot be written
void write_html_report(const std::filesystem::path& file, const Session& session,
                       const std::vector<ReportPicture>& pictures, const ReportOptions& options = {},
                       const std::vector<std::string>& doubts = {});

} // namespace spia
