#pragma once
#include <optional>

#include "engine/part/part_file.h"
#include "engine/unfold/plan/neutral_fibre.h"
#include "engine/unfold/step/unfold_script.h"

namespace spia {

/// The bends of a part and their neutral fibre: radii of CAD cylinders where the file has them,
/// else of circles through the vertices.
/// @param thickness  mm, of the sheet; of a solid its own counts
/// @throws InputError  a K factor for a part of which a skin was taken
NeutralFibre part_bends(const PartFile& part, double thickness, const std::optional<KFactor>& k);

/// Gives the blank of a run the lengths of the neutral fibre, if its steps only bend the sheet;
/// else the table says that it has them not.
void lay_anew(const TriMesh& part, const FlattenOptions& options, NeutralFibre& fibre, UnfoldRun& run,
              const Progress& progress = {});

/// A number, "din6935", or a file with a table (parse_k_table()). @throws InputError
KFactor k_factor(const std::string& text);

} // namespace spia
