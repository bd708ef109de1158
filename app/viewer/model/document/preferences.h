#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/viewer/model/document/scene.h"
#include "app/viewer/model/picking/mouse_style.h"
#include "engine/core/length_unit.h"

namespace spia::viewer {

/// What a user wants of every part and project; kept in config_folder()/preferences.json.
struct Preferences {
    bool dark = true;
    int interface_percent = 100;         ///< letters, fields and panels, of their size for the
                                         ///< screen
    LengthUnit lengths = LengthUnit::mm; ///< on the screen and in reports: mm or inch
    std::string material;                ///< grade of parts whose file gives none, see grades.h;
                                         ///< empty: none is chosen
    std::optional<double> thickness_mm;  ///< likewise; null: none is chosen
    std::optional<ColourMap> map;        ///< of fields; null: diverging where zero matters, else
                                         ///< viridis
    bool one_patch = false;              ///< what the surface is made of; else the program chooses
    std::optional<double> tolerance_mm;  ///< of the surface from the part; null: 1/1000 of the
                                         ///< diagonal, of one patch through the nodes of the grid
    MouseStyle mouse = MouseStyle::spia; ///< how it moves the camera

    friend bool operator==(const Preferences&, const Preferences&) = default;
};
inline constexpr int least_interface_percent = 75, most_interface_percent = 200;

struct KeptPreferences {
    Preferences preferences;
    std::vector<std::string> left_out; ///< sentences: what of the file could not be taken, and why
};

/// Those that were kept, member by member: what is not there, unknown or at fault keeps its
/// standard value. No file: the standard ones.
KeptPreferences read_preferences();

/// @throws ExchangeError if they cannot be written
void keep_preferences(const Preferences& preferences);

} // namespace spia::viewer
