#include <fmt/core.h>

#include <algorithm>
#include <chrono>

#include "app/cli/commands.h"
#include "app/cli/terminal.h"
#include "engine/compare/comparison_report.h"
#include "engine/exchange/atomic_file.h"
#include "engine/exchange/read_part.h"
#include "engine/forming/material_library.h"

namespace spia::cli {

int compare(const CompareArguments& arguments)
{
    if (!arguments.json.empty())
        require_writable(arguments.json);
    ReadOptions read;
    if (!arguments.unit.empty())
        read.unit = length_unit(arguments.unit);
    if (arguments.weld)
        read.weld = true;
    read.doctor.keep_largest = arguments.keep_largest;
    CompareOptions options;
    options.flatten.material = find_material(arguments.material, assets() / "materials");
    options.flatten.thickness = arguments.thickness;
    options.methods.clear();
    for (const std::string& method : arguments.methods)
        options.methods.push_back(flat_method(method));

    JobDisplay reading{"read"};
    const PartFile part = read_part(arguments.part, read, reading.progress());
    std::vector<ComparisonRow> rows;
    for (const FlatMethod method : options.methods) {
        CompareOptions one = options;
        one.methods = {method};
        JobDisplay display{std::string(title(method))};
        rows.push_back(spia::compare(part.mesh, one, display.progress()).front());
        display.done(rows.back().seconds);
    }
    if (!arguments.json.empty())
        write_atomically(arguments.json, comparison_json(arguments.part, part.mesh, rows));
    if (!arguments.markdown)
        fmt::print("{}: {} triangles, {} vertices\n\n", arguments.part.string(), part.mesh.triangles(),
                   part.mesh.vertices());
    fmt::print("{}", comparison_table(rows, arguments.markdown ? TableStyle::markdown : TableStyle::text));
    const bool none = std::all_of(rows.begin(), rows.end(), [](const auto& row) { return !row.failure.empty(); });
    return none ? 3 : 0;
}

} // namespace spia::cli
