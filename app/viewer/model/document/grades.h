#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/forming/material/material.h"
#include "engine/forming/material/material_check.h"

/// The sheet grades that can be chosen: the built-in ones, which are read-only, and the user's own,
/// a file each in own_materials().
namespace spia::viewer {

struct Grade {
    std::filesystem::path file;
    bool own = false;
    std::string reference;            ///< as in Document::material: stem of a built-in one, path of
                                      ///< an own one
    std::optional<Material> material; ///< null: the file is at fault
    std::string problem;              ///< why, in words

    std::string label() const { return file.stem().string(); } ///< as in the lists of the window
};

/// The folder of the user's own, config_folder()/materials; it need not be there. Empty if there is
/// no home folder.
std::filesystem::path own_materials();

/// Built-in ones first, each group by file name. A file at fault is listed with its problem,
/// whatever the group.
std::vector<Grade> read_grades(const std::filesystem::path& built_in, const std::filesystem::path& own);

/// The one that a document names, by its reference, or by stem or name; an own one also by its
/// file. Null: none of the list.
const Grade* grade_called(const std::vector<Grade>& grades, const std::string& name);

/// The stem of the file for a grade of this name: lower case, letters and digits, "_" between them.
/// Empty if it has neither.
std::string stem_for(const std::string& name);

/// A name that no grade has yet: "NAME copy", "NAME copy 2".
std::string copy_name(const std::vector<Grade>& grades, const std::string& name);

/// What keeps a grade from being saved, as faults_of(), and a name that another grade has.
/// @param replaces  reference of the own grade that it was before; empty: it is new
std::vector<MaterialFault> faults_to_save(const std::vector<Grade>& grades, const Material& material,
                                          const std::string& replaces);

/// What a tensile test and a sheet's buyer would call its figures. Strains are logarithmic.
struct GradeFigures {
    double proof_MPa = 0;      ///< Rp0.2
    double strength_MPa = 0;   ///< Rm, engineering
    double uniform_strain = 0; ///< where necking begins [Considere 1885]
    /// slope of ln stress over ln strain between 0.10 and 0.20, or up to the uniform strain if that
    /// is less [ISO 10275]
    double n = 0;
    double normal_anisotropy = 0; ///< (r0 + 2 r45 + r90) / 4
    double planar_anisotropy = 0; ///< (r0 - 2 r45 + r90) / 2
};
GradeFigures grade_figures(const Material& material);

/// True stress, MPa, over the strain from 0 to `most` in even steps.
struct FlowCurve {
    std::vector<double> strain, stress_MPa;
};
FlowCurve flow_curve(const Hardening& law, double most, int pieces);

/// The law of this name that is nearest to another one between the strains 0.002 and 0.5; a table:
/// points of it.
/// @throws InputError if there is none
Hardening as_law(const Hardening& law, const std::string& name);

} // namespace spia::viewer
