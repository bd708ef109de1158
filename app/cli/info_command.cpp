#include <fmt/core.h>

#include <algorithm>

#include "app/cli/commands.h"
#include "app/cli/terminal.h"
#include "engine/core/atomic_file.h"
#include "engine/core/text.h"
#include "engine/exchange/deck/deck_choice.h"
#include "engine/exchange/read_part.h"
#include "engine/mesh/topology.h"
#include "engine/part/curved_faces.h"
#include "engine/report/figures/figures.h"
#include "engine/report/json/report_json.h"

namespace spia::cli {
namespace {

/// All parts of a deck, and what else can be chosen.
void print_parts(const DeckOrigin& deck)
{
    for (const DeckPart& part : deck.parts)
        if (part.elements + part.broken > 0)
            say("part            {}\n", describe(part));
    constexpr size_t most = 20;
    for (size_t k = 0; k < std::min(most, deck.sets.size()); ++k)
        say("element set     {}\n", deck.sets[k]);
    if (deck.sets.size() > most)
        say("element sets    and {} more\n", deck.sets.size() - most);
}

/// Assemblies and bodies of a CAD file.
void print_items(const CadTree& tree)
{
    for (size_t i = 0; i < tree.item.size(); ++i)
        say("{:<15} {}\n", i == 0 ? "holds" : "", describe(tree, int(i)));
}

void print_solid(const SolidOrigin& solid)
{
    const auto faces = [](int count) { return counted(count, "face", "faces"); };
    say("solid           {}, {:.6g} mm3; taken: {} skin{}\n", faces(solid.faces), solid.volume, name(solid.skin),
        solid.skin == Skin::middle ? ", between both" : "");
    say("thickness       {:.6g} mm ({:.4g} to {:.4g} mm on 98 % of the skins)\n", solid.thickness, solid.least,
        solid.most);
    say("outer skin      {}, {:.6g} mm2\n", faces(solid.outer_faces), solid.outer_area);
    say("inner skin      {}, {:.6g} mm2\n", faces(solid.inner_faces), solid.inner_area);
    say("rim             {}, {:.6g} mm2\n", faces(solid.faces - solid.outer_faces - solid.inner_faces), solid.rim_area);
}

} // namespace

int info(const InfoArguments& arguments)
{
    const ReadOptions options = read_options(arguments.read, arguments.part);
    JobDisplay display{"read"};
    const PartFile part = examine_part(arguments.part, options, display.progress());
    const DoctorReport& doctor = part.doctor;
    if (!arguments.json.empty())
        write_atomically(arguments.json, doctor_json(arguments.part, part));

    const auto number = [](const std::optional<int>& value) {
        return value ? std::to_string(*value) : "no meaning here";
    };
    if (part.cad && part.cad->unit_stated) // which is converted
        say("file            {} ({})\n", arguments.part.string(), part.format);
    else
        say("file            {} ({}, 1 unit = {} mm)\n", arguments.part.string(), part.format, millimetres(part.unit));
    if (part.cad && part.remeshed) // what is numbered are the new ones
        say("{:<15} {} vertices, {} triangles, remeshed\n", "of its faces", part.remeshed->original->vertices(),
            part.remeshed->original->triangles());
    else
        say("{:<15} {} vertices, {} {}\n",
            part.deck  ? "taken"
            : part.cad ? "of its faces"
                       : "in the file",
            part.file_vertices, part.file_faces, part.cad ? "triangles" : "faces");
    if (part.deck)
        print_parts(*part.deck);
    if (part.cad)
        print_items(part.cad->tree);
    if (part.solid)
        print_solid(*part.solid);
    say("components      {}\n", doctor.components);
    say("boundary loops  {}\n", number(doctor.boundary_loops));
    say("genus           {}\n", number(doctor.genus));
    if (doctor.healthy()) {
        const Eigen::Vector3d size = part_figures(part).size;
        say("part            {}, {:.6g} x {:.6g} x {:.6g} mm, {:.6g} mm2\n",
            counted(part.mesh.triangles(), "triangle", "triangles"), size[0], size[1], size[2], sheet_area(part));
    }
    for (const std::string& note : part.notes)
        say("note            {}\n", note);
    for (const Finding& finding : doctor.findings) {
        const char* severity = finding.severity == Severity::note       ? "note"
                               : finding.severity == Severity::repaired ? "repaired"
                                                                        : "FATAL";
        say("{:<15} {}\n", severity, finding.text);
        if (!finding.advice.empty())
            say("{:<15} -> {}\n", "", finding.advice);
    }
    say("{}\n", doctor.healthy() ? "This part can be unfolded." : "This part is refused for the FATAL reasons above.");
    return doctor.healthy() ? 0 : 2;
}

} // namespace spia::cli
