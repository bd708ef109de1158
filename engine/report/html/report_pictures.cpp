#include "engine/report/html/report_pictures.h"

#include "engine/picture/picture.h"
#include "engine/pipeline/outputs/session_scene.h"

namespace spia {

std::vector<ReportPicture> drawn_pictures(const Session& session, LengthUnit lengths)
{
    const SessionScene shown(session, session.file.stem().string());
    std::vector<ReportPicture> pictures = {
        {"Part and flat blank: thinning", picture_png(shown.scene(), Panels::sheet, lengths)}};
    if (session.lifted || session.surface)
        pictures.push_back({!session.surface  ? "Quad mesh on the part"
                            : !session.lifted ? "NURBS surface"
                                              : "Quad mesh on the part, and NURBS surface with its control net",
                            picture_png(shown.scene(), Panels::shape, lengths)});
    return pictures;
}

} // namespace spia
