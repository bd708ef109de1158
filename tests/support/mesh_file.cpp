#include "tests/support/mesh_file.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>

#include "engine/core/error.h"
#include "engine/mesh/topology.h"

namespace spia::shapes {
namespace {

static_assert(sizeof(float) == 4);

// little-endian machines only, like STL itself
template <class Number> void append(std::string& bytes, Number value)
{
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
}

std::string binary_stl(const TriMesh& mesh)
{
    std::string bytes = "SPIA sample part, mm";
    bytes.resize(80, ' ');
    append(bytes, std::uint32_t(mesh.triangles()));
    const Eigen::Matrix3Xd normal = area_vectors(mesh).colwise().normalized();
    for (int f = 0; f < mesh.triangles(); ++f) {
        for (double n : normal.col(f))
            append(bytes, float(n));
        for (int v : mesh.triangle.col(f))
            for (double x : mesh.position.col(v))
                append(bytes, float(x));
        append(bytes, std::uint16_t(0));
    }
    return bytes;
}

std::string obj(const TriMesh& mesh)
{
    std::string text = "# SPIA sample part, mm\n";
    auto out = std::back_inserter(text);
    const auto rounded = [](double x) { return std::round(x * 1e6) / 1e6 + 0.0; }; // + 0.0: no "-0"
    for (auto x : mesh.position.colwise())
        fmt::format_to(out, "v {} {} {}\n", rounded(x.x()), rounded(x.y()), rounded(x.z()));
    for (auto t : mesh.triangle.colwise())
        fmt::format_to(out, "f {} {} {}\n", t.x() + 1, t.y() + 1, t.z() + 1);
    return text;
}

} // namespace

void write_mesh(const std::filesystem::path& file, const TriMesh& mesh)
{
    std::string content;
    if (file.extension() == ".stl")
        content = binary_stl(mesh);
    else if (file.extension() == ".obj")
        content = obj(mesh);
    else
        throw InputError(fmt::format("{}: the ending must be .stl or .obj", file.string()));
    std::ofstream out(file, std::ios::binary);
    if (!out.write(content.data(), std::streamsize(content.size())).flush())
        throw ExchangeError(fmt::format("{} cannot be written; does its folder exist?", file.string()));
}

} // namespace spia::shapes
