#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <string>

#include "engine/core/error.h"
#include "tests/support/mesh_file.h"
#include "tests/support/revolved.h"
#include "tests/support/samples.h"

namespace {

namespace fs = std::filesystem;
using namespace spia;

void write(const fs::path& file, const TriMesh& mesh)
{
    shapes::write_mesh(file, mesh);
    fmt::print("{}: {} triangles, {} vertices\n", file.string(), mesh.triangles(), mesh.vertices());
}

void list()
{
    for (const shapes::Sample& sample : shapes::samples())
        fmt::print("{:<20} {}{}\n", sample.name, sample.description, sample.is_sheet ? "" : " (to be refused)");
    fmt::print("{:<20} {}\n", "revolved", "around z from --meridian FILE, a CSV with columns r_mm,z_mm");
}

void write_all(const fs::path& folder, const std::string& ending, int triangles)
{
    fs::create_directories(folder);
    for (const shapes::Sample& sample : shapes::samples())
        if (sample.is_sheet)
            write(folder / (sample.name + "." + ending), sample.make(triangles > 0 ? triangles : sample.small));
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("Writes sample parts: sheet-metal shapes of any size, the same at every call.", "spia-samples");
    std::string name, ending = "obj";
    fs::path out, all, meridian;
    int triangles = 0;
    bool show_list = false;
    app.add_option("name", name, "which part; see --list");
    app.add_option("--triangles", triangles, "about how many; a small number fit for the part if not given")
        ->check(CLI::Range(100, 20000000));
    app.add_option("--out", out, "file to write, .stl (binary) or .obj; NAME.obj if not given");
    app.add_option("--meridian", meridian, "for the part `revolved`: CSV with columns r_mm,z_mm")
        ->check(CLI::ExistingFile);
    app.add_option("--all", all, "write every part that is a sheet into this folder");
    app.add_option("--format", ending, "of the files of --all")->check(CLI::IsMember({"obj", "stl"}));
    app.add_flag("--list", show_list, "show what there is");
    try {
        app.parse(argc, argv);
        if (show_list)
            list();
        else if (!all.empty())
            write_all(all, ending, triangles);
        else if (name.empty())
            throw InputError("name a part, or give --all FOLDER or --list");
        else {
            if (out.empty())
                out = name + ".obj";
            if (name == "revolved") {
                if (meridian.empty())
                    throw InputError("revolved needs --meridian FILE");
                const int number = triangles > 0 ? triangles : 5000;
                write(out, shapes::axisymmetric(shapes::read_meridian(meridian), number).mesh);
            } else {
                const shapes::Sample& sample = shapes::sample(name);
                write(out, sample.make(triangles > 0 ? triangles : sample.small));
            }
        }
        return 0;
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const InputError& error) {
        fmt::print(stderr, "spia-samples: {}\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "spia-samples: {}\n", error.what());
        return 4;
    }
}
