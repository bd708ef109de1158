#pragma once
#include <string>
#include <vector>

#include "app/viewer/model/document/state.h"
#include "engine/report/html/report_options.h"

namespace spia::viewer {

/// What a report of the window holds, with the pictures that only a window can draw.
struct ViewerReportOptions {
    /// empty: the file of the part
    std::string title;
    /// of the user, line by line; may be empty
    std::string remarks;
    /// what there is no result for is left out
    std::vector<View> pictures{std::begin(all_views), std::end(all_views)};
    bool standard_look = true; ///< of the pictures; else the views as they are
    ReportTables tables;
    LengthUnit lengths = LengthUnit::mm; ///< mm or inch

    friend bool operator==(const ViewerReportOptions&, const ViewerReportOptions&) = default;
};

/// The same to the engine, which is told the words of the window.
ReportOptions report_options(const ViewerReportOptions& options);

/// The same document as everybody sees it who has changed nothing: thinning, light, nothing
/// selected, from the front right above. The cameras look the right way; they are still to be
/// fitted to what they show.
ViewerState standard_look(const ViewerState& state);

} // namespace spia::viewer
