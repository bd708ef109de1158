// Parts of any fineness for measuring the programs: spia-make-part panel|cup|dome TRIANGLES
// OUT.obj|OUT.stl
#include <cstdlib>
#include <fmt/core.h>
#include <string_view>

#include "engine/core/error.h"
#include "tests/support/inner_panel.h"
#include "tests/support/mesh_file.h"
#include "tests/support/revolved.h"
#include "tests/support/square_cup.h"

int main(int argc, char** argv)
try {
    using namespace spia;
    if (argc != 4) {
        fmt::print(stderr, "spia-make-part panel|cup|dome TRIANGLES OUT.obj|OUT.stl\n");
        return 2;
    }
    const std::string_view kind = argv[1];
    const int triangles = std::atoi(argv[2]);
    TriMesh mesh;
    if (kind == "panel") {
        shapes::InnerPanel shape;
        shape.triangles = triangles;
        mesh = shapes::inner_panel(shape).mesh;
    } else if (kind == "cup") {
        mesh = shapes::square_cup({.triangles = triangles});
    } else if (kind == "dome") {
        mesh = shapes::dome({.triangles = triangles}).mesh;
    } else {
        throw InputError("the part is a panel, a cup or a dome");
    }
    shapes::write_mesh(argv[3], mesh);
    fmt::print("{} triangles\n", mesh.triangles());
} catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
}
