#include "app/viewer/panels/charts.h"

#include "app/viewer/panels/ui.h"

namespace spia::viewer {

const PartFigures& part_figures(Frame& frame)
{
    const auto& part = frame.state.document.session.part;
    return frame.ui.charts.part.of({part}, [&] { return part_figures(*part); });
}

const PartFigures& examined_figures(Frame& frame)
{
    const auto& refused = frame.state.refused;
    return refused && examined(frame.state) == refused.get()
               ? frame.ui.charts.refused.of({refused}, [&] { return part_figures(*refused); })
               : part_figures(frame);
}

const BlankSize& blank_size(Frame& frame)
{
    const Session& session = frame.state.document.session;
    return frame.ui.charts.blank.of({session.part, session.blank},
                                    [&] { return blank_size(session.part->mesh, session.blank->blank); });
}

const SheetFigures& sheet_figures(Frame& frame)
{
    const auto& blank = frame.state.document.session.blank;
    return frame.ui.charts.sheet.of({blank}, [&] { return without_noise(sheet_figures(blank->face)); });
}

const SurfaceFigures& surface_figures(Frame& frame)
{
    const auto& surface = frame.state.document.session.surface;
    return frame.ui.charts.surface.of({surface}, [&] { return surface_figures(*surface); });
}

const std::array<double, 4>& side_lengths(Frame& frame)
{
    const Session& session = frame.state.document.session;
    return frame.ui.charts.sides.of({session.grid, session.blank},
                                    [&] { return side_lengths(*session.grid, session.blank->blank); });
}

const CrackVerdict& crack_verdict(Frame& frame)
{
    const Session& session = frame.state.document.session;
    return frame.ui.charts.cracks.of({session.blank, session.limits, frame.lengths()},
                                     [&] { return crack_verdict(session, frame.lengths()); });
}

} // namespace spia::viewer
