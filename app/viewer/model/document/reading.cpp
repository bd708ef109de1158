#include "app/viewer/model/actions/actions.h"

namespace spia::viewer {

Reading reading_of(const ReadOptions& options)
{
    return {options.weld,
            options.doctor.keep_largest,
            options.parts,
            options.skin,
            options.cad.sewing_tolerance,
            options.cad.deflection,
            options.cad.leave_out_unmeshed,
            options.cad.keep_triangles,
            options.doctor.weld_gap};
}

void set_reading(ReadOptions& options, const Reading& reading)
{
    options.weld = reading.weld;
    options.doctor.weld_gap = reading.weld_gap_mm;
    options.doctor.keep_largest = reading.keep_largest;
    options.parts = reading.parts;
    options.skin = reading.skin;
    options.cad.sewing_tolerance = reading.sewing_mm;
    options.cad.deflection = reading.deflection_mm;
    options.cad.leave_out_unmeshed = reading.leave_out_bad_faces;
    options.cad.keep_triangles = reading.keep_triangles;
}

} // namespace spia::viewer
