#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/viewer/model/document/grades.h"
#include "app/viewer/views/scene_cache.h"

namespace spia::viewer {

struct Frame;

/// What the editor of materials remembers; kept until the program ends, so that nothing typed is
/// lost with the window.
struct MaterialEditor {
    using Grades = std::shared_ptr<const std::vector<Grade>>;

    bool appears = false;                  ///< opens in the next frame
    std::string shown;                     ///< reference of a grade, or key of a draft; empty: that
                                           ///< of the part
    std::map<std::string, Material> draft; ///< changed and not saved: by reference, new ones by
                                           ///< "new: NAME"
    std::optional<std::string> hovered;    ///< of the list or the plot, in the last frame
    std::string saving, saved_as;          ///< a draft that was asked to be saved, and its
                                           ///< reference when it is
    bool removing = false;                 ///< asks once more
    bool test_for_editor = false;          ///< the dialog of the tensile test gives its material
                                           ///< back to the editor
    bool curve_for_editor = false;         ///< likewise the file of a forming limit curve
    std::string problem;                   ///< what went wrong in the editor itself

    Memo<std::vector<FlowCurve>, Grades> curves; ///< of every grade, empty for those at fault
    Memo<FlowCurve, Hardening> draft_curve;
    Memo<GradeFigures, Material> figures;
    Memo<std::vector<MaterialFault>, Grades, Material, std::string> faults;
};

void open_material_editor(Frame& frame, std::string shown = {});
/// A grade that is not saved yet, to be edited.
void edit_new_material(Frame& frame, Material material);
/// Points of a file for the forming limit of the grade that is edited.
void take_limit_curve(Frame& frame, const std::filesystem::path& file);
void material_editor(Frame& frame);

} // namespace spia::viewer
