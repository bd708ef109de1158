#pragma once
#include <string>
#include <vector>

#include "app/viewer/model/jobs/viewer_model.h"

namespace spia::viewer {

/// The preferences of the user: begins with those in their file, and keeps there at once what is
/// changed of them, in their dialog or by a key.
class PreferenceKeeper {
public:
    /// @param scripted  a script runs: it begins with the standard ones, so that it does the same
    /// everywhere, and keeps none
    /// @param light     this time, whatever is preferred
    PreferenceKeeper(ViewerModel& model, bool scripted, bool light);
    void follow(ViewerModel& model); ///< once a frame

private:
    bool scripted_, forced_light_ = false; ///< by the command line, not by the user's choice
    Preferences kept_;                     ///< in their file
    std::vector<std::string> left_out_;    ///< of the file, still to be said
};

} // namespace spia::viewer
