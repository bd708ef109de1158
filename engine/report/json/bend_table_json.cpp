#include "engine/report/json/bend_table_json.h"

#include "engine/core/angle.h"
#include "engine/core/vector_json.h"
#include "engine/pipeline/blank/bend_report.h"

namespace spia {
namespace {
}

Json bend_table_json(const BendTable& table)
{
    Json bends = Json::array();
    for (const SheetBend& bend : table.bends) {
        Json lines = Json::array();
        for (const BlankSegment& piece : bend.line)
            lines.push_back({piece.from[0], piece.from[1], piece.to[0], piece.to[1]});
        bends.push_back({{"inner_radius_mm", bend.inner_radius},
                         {"angle_deg", bend.angle * degrees_per_radian},
                         {"direction", bend.up ? "up" : "down"},
                         {"k_factor", bend.k},
                         {"allowance_mm", bend.allowance},
                         {"deduction_mm", bend.deduction},
                         {"length_mm", bend.length},
                         {"radius_from", bend.sharp    ? "sharp"
                                         : bend.stated ? "CAD"
                                                       : "mesh"},
                         {"laid_by_k", bend.laid},
                         {"why_not", bend.laid ? Json(nullptr) : Json(bend.why_not)},
                         {"way_out", bend.laid ? Json(nullptr) : Json(bend.way_out)},
                         {"place_mm", vector_json(bend.place)},
                         {"axis", vector_json(bend.axis)},
                         {"lines_mm", std::move(lines)}});
    }
    return {{"surface", table.surface},
            {"thickness_mm", table.thickness},
            {"bends", std::move(bends)},
            {"notes", all_notes(table)}};
}

} // namespace spia
