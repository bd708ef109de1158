#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/viewer/model/document/state.h"
#include "app/viewer/model/document/stored_picks.h"

/// Project files (*.spia): JSON of the schema "spia-project/1". They keep what the user made and
/// chose, not the results: opening runs the chain again. A file of a newer version is refused, and
/// so is a member that is not known: a new one does without another version.
///
/// - `part.path`: `file`: relative to the project's folder; `was_at`: where it was when saved,
///   tried second
/// - `part.unit`, `part.weld`, `part.weld_gap_mm`: of the file; null: as its format has it
/// - `part.keep_largest`, `part.parts`, `part.skin`, `part.sewing_mm`, `part.deflection_mm`,
///   `part.leave_out_bad_faces`, `part.keep_triangles`, `part.seam`, `part.remesh`: as in the
///   script actions set_reading, set_seam and set_remeshing
/// - `material`, `material_file`: a built-in grade; or null or a file, given like that of the part
/// - `thickness`, `skins`, `direction`, `grid`, `natural_ends`, `parameters`: the other options of
///   the chain; mm
/// - `k_factor`, `k_table`: as in the script action set_k_factor; a table given like the file of
///   the part
/// - `k_table_rows`: what the table held, for when its file has gone: R/t and K
/// - `fit`: as in the script action set_fit; without it `natural_ends` says the ends
/// - `ran`: the last stage that had been run, or null
/// - `steps_ran`: whether steps of unfolding had been run
/// - `blank_of_steps_polished`: null where the blank is that of one step; else it is that of the
///   steps, polished or not
/// - `edge_restraint`, `rolling`: as in the script action set_process
/// - `limits`, `limits_table`: as in the script action set_limits; the table given like the file of
///   the part
/// - `display`, `view`: as in the script actions set_display and set_view
/// - `picks`: StoredPicks: numbers of the part's file and geometry; matrices column by column
/// - `recovers`: only in an autosave: the project that it stands for
namespace spia::viewer {

inline constexpr std::string_view project_ending = ".spia";

/// What a project file holds. The part is not read yet, and the picks wait for it:
///
///     Project project = open_project(file, materials);
///     project.document.session = run_stage(Stage::read, project.document.session);
///     const auto lost = restore_picks(project.document, project.picks);
///     // run the stages up to project.ran
struct Project {
    Document document; ///< file and options of the session, material, display; no results, no picks
    ViewSettings view;
    StoredPicks picks;
    std::optional<Stage> ran;
    bool steps_ran = false;
    std::optional<bool> blank_of_steps = {}; ///< taken for the chain: whether it was polished
    std::filesystem::path recovers;
};

/// Writes the whole file or nothing. @param recovers of an autosave: the project it stands for
/// @throws InputError if no part is open; ExchangeError if the file cannot be written
void save_project(const std::filesystem::path& file, const Document& document, const ViewSettings& view,
                  const std::filesystem::path& recovers = {});

/// @param materials  folder of the built-in grades
/// @throws InputError names the file and the place in it: no project, a newer version, damaged, or
/// its material is missing
Project open_project(const std::filesystem::path& file, const std::filesystem::path& materials);

} // namespace spia::viewer
