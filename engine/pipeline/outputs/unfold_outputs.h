#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/exchange/lines/dxf_options.h"
#include "engine/part/part_file.h"
#include "engine/unfold/plan/bend_table.h"
#include "engine/unfold/plan/bends.h"
#include "engine/unfold/sheet_lines.h"
#include "engine/unfold/step/unfold_script.h"

namespace spia {

/// By the names the command line uses; all but "states" (unfold_states.h) are endings.
const std::vector<std::string>& unfold_formats();
const std::vector<std::string>&
all_unfold_formats(); ///< also blank_mesh_formats() (deck_outputs.h), written when asked for

/// Makes a folder if need be, and sees that it can be written, before the work. @throws
/// ExchangeError why not
void prepare_folder(const std::filesystem::path& folder);

/// Removes what write_unfolding() wrote there under this name: a blank of an earlier run must not
/// be taken for that of the next.
void remove_unfolding(const std::filesystem::path& folder, const std::string& name);

/// Writes what a run gave into a folder. Of each step its state (NAME-stepN.vtu) and, if it laid
/// faces on others, their developed edge as trim lines on the target (NAME-stepN-trim.dxf, .iges,
/// .step); of the blank its outline and bend lines (NAME-blank.dxf as write_dxf() has it, .iges,
/// .step) and, where asked for, its mesh (NAME-blank.k, .bdf, .inp, .msh).
/// @param polished what the solver of the whole part makes of the blank (NAME-polished.dxf, .vtu);
/// may be null
/// @param formats some of all_unfold_formats(); "states" is not written here
/// @param dxf     of the blank; trim lines are polylines in mm
/// @param table   of the bends on the blank; may be null
/// @returns the files, in the order written
std::vector<std::filesystem::path> write_unfolding(const std::filesystem::path& folder, const std::string& name,
                                                   const PartFile& part, const BendMap& map, const UnfoldScript& steps,
                                                   const UnfoldRun& run, const FlattenResult* polished = nullptr,
                                                   const std::vector<std::string>& formats = unfold_formats(),
                                                   const DxfOptions& dxf = {}, const BendTable* table = nullptr);

/// Outline ("outline"), holes ("hole 1" ...) and bend lines of a blank, in the plane z = 0.
std::vector<SheetLine> blank_lines(const TriMesh& part, const BendMap& map, const Blank& blank);

} // namespace spia
