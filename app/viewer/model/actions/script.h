#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "app/viewer/model/actions/actions.h"
#include "engine/core/json_file.h"

/// Scripts: what a user could do, as a file.
///
///     {"schema": "spia-script/1", "actions": [
///       {"do": "open_part", "file": "door.stl", "unit": "mm"},
///       {"do": "run_to", "stage": "fit"},
///       {"do": "wait", "seconds": 60},
///       {"do": "set_display", "field": "thinning", "bands": 10}, // others stay as they are
///       {"do": "set_view", "camera": {"blank": {"height": 200}}, "dark": false},
///       {"do": "expect", "at": "/stages/fit", "equals": true},
///       {"do": "expect", "at": "/figures/result/thinning_max", "above": 0.05, "below": 0.5}
///     ]}
///
/// An action has the members of its struct in actions.h; set_grid, set_display, set_view and
/// add_probe those of the struct in it. What is not given keeps its default; in set_grid,
/// set_display, set_view, change_region and change_step its present value. Vectors are lists of
/// numbers, turns w, x, y, z; enumerations have the names of names.h. Comments are allowed. Paths
/// count from the folder in which the program was started.
namespace spia::viewer {

/// @param present  what members that are not given keep
/// @param place of the action, for messages
/// @throws InputError  names the place, the member and what is allowed there
Action action_from_json(const Json& json, const ViewerState& present, const std::string& place = "action");
/// In a new program.
Action action_from_json(const Json& json);

/// What it is called: its "do".
std::string_view name(const Action& action);

/// With all of its members; action_from_json() gives the same action back, whatever the state.
Json to_json(const Action& action);

/// "wait": until the running job has ended.
struct Wait {
    std::optional<double> seconds; ///< at most; then the script fails. Not given: as long as it
                                   ///< takes
};

/// "expect": something of the state report (state_report.h). All that is given must hold.
struct Expect {
    std::string at; ///< JSON pointer into the report, e.g. "/selection/first/0"
    std::optional<Json> equals;
    std::optional<double> above, below; ///< both excluded
    std::optional<double> near;         ///< with a tolerance
    std::optional<double> tolerance;    ///< allowed distance from `near`
    std::optional<Json> contains;       ///< a part of a text, an entry of a list, a member of an
                                        ///< object
    std::optional<bool> exists;         ///< whether there is anything at all
};

/// An action whose missing members are taken from the state when its turn comes.
struct Perform {
    Json action;
};

struct Step {
    std::variant<Perform, Wait, Expect> what;
    std::string place; ///< e.g. "check.json: /actions/3", for messages
};

/// Every step is checked: what it is called, its members and their types.
/// @throws InputError if the file cannot be read or is no script
std::vector<Step> parse_script(const std::filesystem::path& file);
std::vector<Step> parse_script(std::string_view text, const std::string& name);

/// The action of a step in this state. @throws InputError as action_from_json()
Action action(const Perform& perform, const ViewerState& state, const std::string& place);

/// What of it does not hold, and what was there instead; nothing if all is as expected.
std::optional<std::string> unmet(const Expect& expect, const Json& report);

} // namespace spia::viewer
