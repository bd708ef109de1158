#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "app/cli/commands.h"
#include "app/cli/terminal.h"
#include "engine/compare/comparison_report.h"
#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/exchange/read_part.h"
#include "engine/forming/material/material_library.h"
#include "engine/pipeline/flat_thickness.h"
#include "engine/report/json/report_json.h"

namespace spia::cli {

int compare(const CompareArguments& arguments)
{
    if (!arguments.json.empty())
        require_writable(arguments.json);
    ReadOptions read = read_options(arguments.read, arguments.part);
    read.cad.keep_triangles = true; // methods are compared on the triangles of the file
    CompareOptions options;
    options.flatten.material = find_material(arguments.material, assets() / "materials");
    if (const std::vector<double>& d = arguments.direction; !d.empty()) {
        options.flatten.direction = Eigen::Vector3d(d[0], d[1], d[2]);
        if (!options.flatten.direction->allFinite() || !(options.flatten.direction->norm() > 0))
            throw InputError("the stamping direction must be a finite vector that is not zero");
    }
    options.methods.clear();
    for (const std::string& method : arguments.methods)
        options.methods.push_back(flat_method(method));

    JobDisplay reading{"read"};
    const PartFile part = read_part(arguments.part, read, reading.progress());
    options.flatten.thickness = flat_thickness(arguments.thickness, part);
    std::vector<ComparisonRow> rows;
    for (const FlatMethod method : options.methods) {
        CompareOptions one = options;
        one.methods = {method};
        JobDisplay display{std::string(title(method))};
        rows.push_back(spia::compare(part.mesh, one, display.progress()).front());
        display.done(rows.back().seconds);
    }
    if (!arguments.json.empty())
        write_atomically(arguments.json, comparison_json(arguments.part, part.mesh, rows, reading_notes(part)));
    if (!arguments.markdown)
        say("{}: {} triangles, {} vertices\n", arguments.part.string(), part.mesh.triangles(), part.mesh.vertices());
    for (const std::string& line : reading_notes(part))
        say("{}{}\n", arguments.markdown ? "- " : "  ", line);
    if (const std::string text = describe_thickness(arguments.thickness, part); !text.empty())
        say("{}note: {}\n", arguments.markdown ? "- " : "  ", text);
    say("\n");
    say("{}", comparison_table(rows, arguments.markdown ? TableStyle::markdown : TableStyle::text));
    const bool none = std::all_of(rows.begin(), rows.end(), [](const auto& row) { return !row.failure.empty(); });
    return none ? 3 : 0;
}

} // namespace spia::cli
