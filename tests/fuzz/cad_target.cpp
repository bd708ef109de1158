#include "tests/fuzz/cad_target.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <unistd.h>

#include "engine/core/error.h"
#include "engine/exchange/cad/cad_findings.h"
#include "engine/exchange/cad/read_cad.h"
#include "engine/exchange/cad/write_iges.h"
#include "engine/exchange/cad/write_step.h"
#include "engine/part/part_file.h"
#include "engine/part/prepare_part.h"
#include "tests/fuzz/require.h"
#include "tests/support/known_surfaces.h"
#include "tests/unit/exchange/sample_faces.h"

namespace spia::fuzz {
namespace {

namespace fs = std::filesystem;

void require_sound(const CadContent& cad)
{
    require(cad.face.size() == size_t(cad.soup.polygons()), "triangles of no face");
    for (const int face : cad.face)
        require(face >= 0 && face < cad.faces, "a triangle of a face that is not there");
    for (int t = 0; t < cad.soup.polygons(); ++t)
        for (const int v : cad.soup.polygon(t))
            require(v >= 0 && v < cad.soup.vertices(), "a corner that is not there");
    for (const Eigen::Vector3d& place : cad.soup.position)
        require(place.allFinite(), "a place that is no number");
    require(cad.tree.body_of.size() == size_t(cad.faces), "faces of no body");
    for (const CadGap& gap : cad.gaps)
        for (const int face : gap.face)
            require(face >= 0 && face < cad.faces, "a gap between faces that are not there");
    for (const CadSliver& sliver : cad.slivers)
        require(sliver.face >= 0 && sliver.face < cad.faces, "a sliver that is no face");
}

TrimLoop triangular_hole()
{
    PlaneCurve curve{1, {0, 0, 0.3, 0.6, 1, 1}, Eigen::Matrix2Xd(2, 4)};
    curve.control << 0.3, 0.5, 0.7, 0.3, 0.3, 0.7, 0.3, 0.3;
    return {curve};
}

/// A plane square of 20 mm, as short as STEP can be.
const char* const step_square = R"(ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('','',(''),(''),'','','');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));
ENDSEC;
DATA;
#1=APPLICATION_CONTEXT('');
#2=PRODUCT_CONTEXT('',#1,'');
#3=PRODUCT('a','a','',(#2));
#4=PRODUCT_DEFINITION_FORMATION('','',#3);
#5=PRODUCT_DEFINITION_CONTEXT('',#1,'');
#6=PRODUCT_DEFINITION('','',#4,#5);
#7=PRODUCT_DEFINITION_SHAPE('','',#6);
#8=SHAPE_DEFINITION_REPRESENTATION(#7,#9);
#9=MANIFOLD_SURFACE_SHAPE_REPRESENTATION('',(#10),#50);
#10=SHELL_BASED_SURFACE_MODEL('',(#11));
#11=OPEN_SHELL('',(#12));
#12=ADVANCED_FACE('',(#13),#40,.T.);
#13=FACE_OUTER_BOUND('',#14,.T.);
#14=EDGE_LOOP('',(#15,#16,#17,#18));
#15=ORIENTED_EDGE('',*,*,#19,.T.);
#16=ORIENTED_EDGE('',*,*,#20,.T.);
#17=ORIENTED_EDGE('',*,*,#21,.F.);
#18=ORIENTED_EDGE('',*,*,#22,.F.);
#19=EDGE_CURVE('',#23,#24,#31,.T.);
#20=EDGE_CURVE('',#24,#25,#32,.T.);
#21=EDGE_CURVE('',#26,#25,#33,.T.);
#22=EDGE_CURVE('',#23,#26,#34,.T.);
#23=VERTEX_POINT('',#27);
#24=VERTEX_POINT('',#28);
#25=VERTEX_POINT('',#29);
#26=VERTEX_POINT('',#30);
#27=CARTESIAN_POINT('',(0.,0.,0.));
#28=CARTESIAN_POINT('',(20.,0.,0.));
#29=CARTESIAN_POINT('',(20.,20.,0.));
#30=CARTESIAN_POINT('',(0.,20.,0.));
#31=LINE('',#27,#35);
#32=LINE('',#28,#36);
#33=LINE('',#30,#35);
#34=LINE('',#27,#36);
#35=VECTOR('',#37,1.);
#36=VECTOR('',#38,1.);
#37=DIRECTION('',(1.,0.,0.));
#38=DIRECTION('',(0.,1.,0.));
#39=DIRECTION('',(0.,0.,1.));
#40=PLANE('',#41);
#41=AXIS2_PLACEMENT_3D('',#27,#39,#37);
#50=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#51,#52,#53))REPRESENTATION_CONTEXT('',''));
#51=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));
#52=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));
#53=(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT());
ENDSEC;
END-ISO-10303-21;
)";

/// The same every time: neither the date nor the name of the file are those of this run.
template <class Write> std::string written(const char* ending, const Write& write)
{
    const fs::path folder = fs::temp_directory_path() / ("spia-seeds-" + std::to_string(::getpid()));
    const fs::path path = folder / (std::string("seed") + ending);
    fs::create_directories(folder);
    ::setenv("SOURCE_DATE_EPOCH", "0", 1);
    write(path);
    std::ifstream file(path, std::ios::binary);
    std::string content{std::istreambuf_iterator<char>(file), {}};
    fs::remove_all(folder);
    return content;
}

const std::vector<std::string> numbers = {"-1",    "0",          "7",   "99999999", "4294967296", "1e999", "1e300",
                                          "-1e-9", "1.5",        "nan", "inf",      "\n",         "\t",    "\xff\xfe",
                                          "1e9",   "2147483648", " ",   ",",        ";",          "(",     ")"};

std::vector<std::string> with_numbers(std::vector<std::string> words)
{
    words.insert(words.end(), numbers.begin(), numbers.end());
    return words;
}

std::vector<CadTarget> make_targets()
{
    const std::vector<NurbsSurface> arch = {surfaces::quarter_cylinder(
        20, 10)}; // as short as can be: the longer, the fewer can be
                  // tried
    const std::vector<NurbsSurface> square = {surfaces::bilinear({0, 0, 0}, {20, 0, 0}, {0, 20, 0}, {20, 20, 0})};
    const std::vector<std::vector<TrimLoop>> hole = {{triangular_hole()}};
    const auto step = [&](const fs::path& path) { write_step(path, arch); };
    const auto step_hole = [&](const fs::path& path) { write_step(path, square, "a", LengthUnit::inch, hole); };
    const auto iges = [&](const fs::path& path) { write_iges(path, arch); };
    const auto iges_hole = [&](const fs::path& path) { write_iges(path, square, "a", LengthUnit::inch, hole); };
    return {
        {"step",
         {step_square, written(".step", step), step_square,
          written(".step", step_hole)}, // half of them the shortest one
         with_numbers({"#1", "#99", "$", "*", ".T.", ".UNSPECIFIED.", "PLANE", "CARTESIAN_POINT", "EDGE_LOOP", "(#12)",
                       "B_SPLINE_CURVE_WITH_KNOTS", "ENDSEC;\n", "DATA;\n", "SI_UNIT(.MILLI.,.METRE.)", "/*", "'"})},
        {"igs",
         {written(".igs", iges), written(".igs", iges_hole)},
         with_numbers({"128", "144,", "142,", "102,", "126,", "314", "S      1\n", "P      2\n", "D      3\n", "1H,,",
                       "4HINCH", "99999999999999H", "     128", "1.D0", "0D0"})},
        {"brep",
         {written(".brep", [](const fs::path& path) { write_two_squares(path, ThirdFace::sliver); }),
          written(".brep", [](const fs::path& path) { write_swept_cylinder(path, Swept::line_up); }),
          written(".brep", [](const fs::path& path) { write_tube(path, 3, true); })},
         with_numbers({"CASCADE Topology V1, (c) Matra-Datavision\n", "Locations 0\n", "Curves 1\n", "Surfaces 9\n",
                       "Polygon3D 1\n", "TShapes 5\n", "Fa\n", "Ed\n", "Ve\n", "+1 0", "-7 0", "i2 0", "2CN", "*\n",
                       "1111111\n"})},
    };
}

} // namespace

bool is_cad_target(std::string_view name) { return name == "step" || name == "igs" || name == "brep"; }

const CadTarget& cad_target(std::string_view name)
{
    static const std::vector<CadTarget> targets = make_targets();
    for (const CadTarget& target : targets)
        if (target.name == name)
            return target;
    throw std::out_of_range("no CAD format of this name: " + std::string(name));
}

bool read_and_examine(const fs::path& file)
{
    constexpr int most = 100; // larger ones would take the time of the readers, which are what is
                              // searched here
    try {
        const CadContent cad = read_cad_unguarded(file);
        require_sound(cad);
        if (cad.soup.polygons() <= most) {
            PartFile part = examine_soup(cad.soup);
            report_cad(cad, part);
            if (!part.doctor.healthy())
                return false;
            require(part.mesh.triangles() > 0, "a part without a triangle was accepted");
            require(part.mesh.position.allFinite(), "a place that is no number was accepted");
        }
        return true;
    } catch (const InputError&) {
        return false;
    }
}

} // namespace spia::fuzz
