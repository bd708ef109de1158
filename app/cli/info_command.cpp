#include <fmt/core.h>

#include "app/cli/commands.h"
#include "app/cli/terminal.h"
#include "engine/exchange/atomic_file.h"
#include "engine/mesh/topology.h"
#include "engine/pipeline/report.h"
#include "engine/pipeline/seam_file.h"

namespace spia::cli {

int info(const InfoArguments& arguments)
{
    ReadOptions options;
    if (!arguments.unit.empty())
        options.unit = length_unit(arguments.unit);
    if (arguments.weld)
        options.weld = true;
    options.doctor.keep_largest = arguments.keep_largest;
    options.seam = seam_options(arguments.seam);
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
    fmt::print("in the file     {} vertices, {} faces\n", part.file_vertices, part.file_faces);
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
