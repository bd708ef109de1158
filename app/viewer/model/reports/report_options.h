#pragma once
#include <string>
#include <vector>

#include "app/viewer/model/document/state.h"

namespace spia::viewer {

/// Which tables a report has.
struct ReportTables {
    bool key_figures = true, worst_spots = true, assumptions = true, solver = true, repairs = true;

    friend bool operator==(const ReportTables&, const ReportTables&) = default;
};

/// What a report holds beside what it always has: who, when, the four great figures and what makes the result poorer.
struct ReportOptions {
    std::string title;                                                      ///< empty: the file of the part
    std::string remarks;                                                    ///< of the user, line by line; may be empty
    std::vector<View> pictures{std::begin(all_views), std::end(all_views)}; ///< what there is no result for is left out
    bool standard_look = true; ///< of the pictures; else the views as they are
    ReportTables tables;
    LengthUnit lengths = LengthUnit::mm; ///< mm or inch

    friend bool operator==(const ReportOptions&, const ReportOptions&) = default;
};

/// The same document as everybody sees it who has changed nothing: thinning, light, nothing selected, from the front right
/// above. The cameras look the right way; they are still to be fitted to what they show.
ViewerState standard_look(const ViewerState& state);

} // namespace spia::viewer
