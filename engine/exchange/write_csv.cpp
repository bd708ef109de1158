#include "engine/exchange/write_csv.h"

#include <fmt/format.h>
#include <iterator>

#include "engine/core/error.h"
#include "engine/exchange/atomic_file.h"
#include "engine/exchange/sheet_field_list.h"

namespace spia {

void write_fields_csv(const std::filesystem::path& path, const TriMesh& part, const Blank& blank,
                      const SheetFields& node_fields, const std::vector<int>& number)
{
    require_blank_of(part, blank);
    if (!number.empty() && int(number.size()) != part.vertices())
        throw InputError(fmt::format("{} vertex numbers were given for {} vertices", number.size(), part.vertices()));
    const auto fields = forming_fields(node_fields);
    std::string content = "vertex,x,y,z,blank_x,blank_y";
    for (const NamedField& field : fields) {
        require_finite(field, part.vertices(), "vertex");
        content += "," + field.name;
    }
    content += '\n';
    auto end = std::back_inserter(content);
    for (int v = 0; v < part.vertices(); ++v) {
        fmt::format_to(end, "{},{},{},{},{},{}", number.empty() ? v : number[size_t(v)], part.position(0, v),
                       part.position(1, v), part.position(2, v), blank.position(0, v), blank.position(1, v));
        for (const NamedField& field : fields)
            fmt::format_to(end, ",{}", (*field.value)[v]);
        content += '\n';
    }
    write_atomically(path, content);
}

void write_outline_csv(const std::filesystem::path& path, const std::vector<OutlineLoop>& loops)
{
    require_outline(loops);
    std::string content = "loop,index,x,y\n";
    for (size_t loop = 0; loop < loops.size(); ++loop)
        for (Eigen::Index i = 0; i < loops[loop].cols(); ++i)
            fmt::format_to(std::back_inserter(content), "{},{},{},{}\n", loop, i, loops[loop](0, i), loops[loop](1, i));
    write_atomically(path, content);
}

} // namespace spia
