#include "engine/exchange/deck/write_element_results.h"

#include <fmt/format.h>
#include <iterator>

#include "engine/core/atomic_file.h"
#include "engine/exchange/deck/write_shell_mesh.h"
#include "engine/exchange/text/fixed_number.h"

// Card layouts: LS-DYNA Keyword User's Manual, volume I: *ELEMENT_SHELL_THICKNESS (a second card of
// THIC1 to THIC4, 4 E16), *INITIAL_STRESS_SHELL (EID, NPLANE, NTHICK, NHISV, NTENSR, LARGE in 6
// I10; with LARGE = 1 each point T, SIGXX, SIGYY, SIGZZ, SIGXY in 5 E16 and SIGYZ, SIGZX, EPS in 3
// E16), *INITIAL_STRAIN_SHELL (EID, NPLANE, NTHICK, LARGE in 4 I10; EPSXX, EPSYY, EPSZZ, EPSXY,
// EPSYZ and EPSZX, T). MSC Nastran Quick Reference Guide: CQUAD4, CTRIA3.
namespace spia {
namespace {

std::string in(LengthUnit unit) { return unit == LengthUnit::mm ? "" : fmt::format("_{}", name(unit)); }

std::int64_t part_id(const ShellMesh& mesh, int e) { return mesh.parts[size_t(mesh.part_of[size_t(e)])].id; }

/// One point in the plane and in the thickness: all layers of the element get it.
std::string plastic_strain_cards(std::int64_t id, double plastic_strain)
{
    std::string text;
    for (const int number : {1, 1, 0, 0, 1}) // NPLANE, NTHICK, NHISV, NTENSR, LARGE
        text += fixed_number(number, 10);
    text = fixed_number(id, 10) + text + '\n';
    for (int k = 0; k < 7; ++k) // T, and six stresses
        text += fixed_number(0.0, 16) + (k == 4 ? "\n" : "");
    return text + fixed_number(plastic_strain, 16) + '\n';
}

/// The inner and the outer skin.
std::string strain_cards(std::int64_t id, const Eigen::Matrix<double, 6, 1>& strain)
{
    std::string text = fixed_number(id, 10);
    for (const int number : {1, 2, 1}) // NPLANE, NTHICK, LARGE
        text += fixed_number(number, 10);
    text += '\n';
    for (const double skin : {-1.0, 1.0}) {
        for (int k = 0; k < 6; ++k)
            text += fixed_number(strain[k], 16) + (k == 4 ? "\n" : "");
        text += fixed_number(skin, 16) + '\n';
    }
    return text;
}

} // namespace

void write_dynain(const std::filesystem::path& path, const ElementResults& results, std::string_view title)
{
    const ShellMesh& mesh = results.shells->mesh;
    const ElementFields& fields = *results.fields;
    const int w = dyna_id_width(mesh);
    std::string text =
        dyna_keyword(w) + shell_mesh_head(mesh, title, "$") + dyna_nodes(mesh, w) + "*ELEMENT_SHELL_THICKNESS\n";
    for (int e = 0; e < mesh.elements(); ++e) {
        text += dyna_shell(mesh, e, w);
        for (size_t k = 0; k < 4; ++k)
            text += fixed_number(fields.corner_thickness(long(std::min(k, mesh.corners(e) - 1)), e), 16);
        text += '\n';
    }
    text += "*INITIAL_STRESS_SHELL\n";
    for (int e = 0; e < mesh.elements(); ++e)
        text += plastic_strain_cards(mesh.element[size_t(e)], fields.strain_equivalent[e]);
    text += "*INITIAL_STRAIN_SHELL\n";
    for (int e = 0; e < mesh.elements(); ++e)
        text += strain_cards(mesh.element[size_t(e)], fields.strain.col(e));
    write_atomically(path, text + "*END\n");
}

void write_nastran_thickness(const std::filesystem::path& path, const ElementResults& results, std::string_view title)
{
    const ShellMesh& mesh = results.shells->mesh;
    std::string text = shell_mesh_head(mesh, title, "$") + nastran_grids(mesh);
    for (int e = 0; e < mesh.elements(); ++e)
        text += nastran_shell(mesh, e, results.fields->corner_thickness.col(e).data());
    write_atomically(path, text);
}

void write_strains_csv(const std::filesystem::path& path, const ElementResults& results)
{
    const ShellMesh& mesh = results.shells->mesh;
    const ElementFields& fields = *results.fields;
    std::string text = "element,part,plastic_strain,strain_major,strain_minor\n";
    for (int e = 0; e < mesh.elements(); ++e)
        fmt::format_to(std::back_inserter(text), "{},{},{},{},{}\n", mesh.element[size_t(e)], part_id(mesh, e),
                       fields.strain_equivalent[e], fields.strain_major[e], fields.strain_minor[e]);
    write_atomically(path, text);
}

void write_elements_csv(const std::filesystem::path& path, const ElementResults& results)
{
    const ShellMesh& mesh = results.shells->mesh;
    const ElementFields& fields = *results.fields;
    std::string text =
        fmt::format("element,part,thickness{},thinning,plastic_strain,strain_major,strain_minor\n", in(mesh.unit));
    for (int e = 0; e < mesh.elements(); ++e)
        fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{}\n", mesh.element[size_t(e)], part_id(mesh, e),
                       fields.thickness[e], fields.thinning[e], fields.strain_equivalent[e], fields.strain_major[e],
                       fields.strain_minor[e]);
    write_atomically(path, text);
}

void write_nodes_csv(const std::filesystem::path& path, const BlankShells& blank)
{
    const ShellMesh& mesh = blank.mesh;
    std::string text = fmt::format("node,blank_node,blank_x{0},blank_y{0}\n", in(mesh.unit));
    for (int n = 0; n < mesh.nodes(); ++n)
        fmt::format_to(std::back_inserter(text), "{},{},{},{}\n", blank.part_node[size_t(n)], mesh.node[size_t(n)],
                       mesh.position(0, n), mesh.position(1, n));
    write_atomically(path, text);
}

} // namespace spia
