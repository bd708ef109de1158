#include <fmt/core.h>

#include <algorithm>

#include "app/cli/commands.h"
#include "app/cli/terminal.h"
#include "engine/exchange/atomic_file.h"
#include "engine/exchange/deck_choice.h"
#include "engine/mesh/topology.h"
#include "engine/pipeline/report.h"
#include "engine/pipeline/seam_file.h"

namespace spia::cli {
namespace {

/// All parts of a deck, and what else can be chosen.
void print_parts(const DeckOrigin& deck)
{
    for (const DeckPart& part : deck.parts)
        if (part.elements + part.broken > 0)
            fmt::print("part            {}\n", in_words(part));
    constexpr size_t most = 20;
    for (size_t k = 0; k < std::min(most, deck.sets.size()); ++k)
        fmt::print("element set     {}\n", deck.sets[k]);
    if (deck.sets.size() > most)
        fmt::print("element sets    and {} more\n", deck.sets.size() - most);
}

} // namespace

int info(const InfoArguments& arguments)
{
    ReadOptions options;
    if (!arguments.unit.empty())
        options.unit = length_unit(arguments.unit);
    if (arguments.weld)
        options.weld = true;
    options.parts = arguments.parts;
    options.doctor.keep_largest = arguments.keep_largest;
    options.seam = seam_options(arguments.seam);
    options.remesh = remesh_options(arguments.remesh);
    JobDisplay display{"read"};
    const PartFile part = examine_part(arguments.part, options, display.progress());
    const DoctorReport& doctor = part.doctor;
    if (!arguments.json.empty())
        write_atomically(arguments.json, doctor_json(arguments.part, part));

    const auto number = [](const std::optional<int>& value) {
        return value ? std::to_string(*value) : "no meaning here";
    };
    fmt::print("file            {} ({}, 1 unit = {} mm)\n", arguments.part.string(), part.format,
               millimetres(part.unit));
    fmt::print("{:<15} {} vertices, {} faces\n", part.deck ? "taken" : "in the file", part.file_vertices,
               part.file_faces);
    if (part.deck)
        print_parts(*part.deck);
    fmt::print("components      {}\n", doctor.components);
    fmt::print("boundary loops  {}\n", number(doctor.boundary_loops));
    fmt::print("genus           {}\n", number(doctor.genus));
    if (doctor.healthy()) {
        const Eigen::Vector3d size = part.mesh.position.rowwise().maxCoeff() - part.mesh.position.rowwise().minCoeff();
        fmt::print("part            {} triangles, {:.6g} x {:.6g} x {:.6g} mm, {:.6g} mm2\n", part.mesh.triangles(),
                   size[0], size[1], size[2], area(part.mesh));
    }
    for (const std::string& note : part.notes)
        fmt::print("note            {}\n", note);
    for (const Finding& finding : doctor.findings) {
        const char* severity = finding.severity == Severity::note       ? "note"
                               : finding.severity == Severity::repaired ? "repaired"
                                                                        : "FATAL";
        fmt::print("{:<15} {}\n", severity, finding.text);
        if (!finding.advice.empty())
            fmt::print("{:<15} -> {}\n", "", finding.advice);
    }
    fmt::print("{}\n",
               doctor.healthy() ? "This part can be unfolded." : "This part is refused for the FATAL reasons above.");
    return doctor.healthy() ? 0 : 2;
}

} // namespace spia::cli
