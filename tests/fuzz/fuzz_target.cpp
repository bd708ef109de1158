#include "tests/fuzz/fuzz_target.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <unistd.h>

#include "engine/core/error.h"
#include "engine/exchange/deck/deck_choice.h"
#include "engine/exchange/deck/read_deck.h"
#include "engine/exchange/lines/read_dxf.h"
#include "engine/exchange/mesh/checked_file.h"
#include "engine/exchange/mesh/read_gltf.h"
#include "engine/exchange/mesh/read_openmesh.h"
#include "engine/forming/material/two_columns.h"
#include "engine/mesh/halfedges.h"
#include "engine/part/part_file.h"
#include "engine/part/prepare_part.h"
#include "engine/pipeline/files/deform_file.h"
#include "engine/pipeline/files/line_file.h"
#include "engine/pipeline/files/patch_file.h"
#include "engine/pipeline/files/unfold_file.h"
#include "tests/fuzz/require.h"
#include "tests/support/shapes.h"
#include "tests/unit/exchange/sample_compressed.h"
#include "tests/unit/exchange/sample_decks.h"
#include "tests/unit/exchange/sample_meshes.h"

namespace spia::fuzz {
namespace {

namespace fs = std::filesystem;

void require_finite(const std::vector<Eigen::Vector3d>& places)
{
    for (const Eigen::Vector3d& each : places)
        require(each.allFinite(), "a place that is no number was accepted");
}

/// Examines faces of a file; the doctor takes what comes. Larger files are left: they would take
/// the time of the readers, which are what is searched here.
void examine_faces(const PolygonSoup& soup)
{
    constexpr int most = 60;
    if (soup.polygons() > most || soup.vertices() > most)
        return;
    const PartFile part = examine_soup(soup);
    require(part.source_face.size() == size_t(part.mesh.triangles()), "faces that come from none");
    require(part.source_vertex.size() == size_t(part.mesh.vertices()), "vertices that come from none");
    require(part.mesh.position.allFinite(), "a place that is no number was accepted");
    if (part.doctor.healthy())
        halfedges(part.mesh);
}

template <auto Check> bool read_mesh(std::string_view content)
{
    try {
        const PolygonSoup soup = read_openmesh(Check(content));
        examine_faces(soup);
        return soup.polygons() > 0; // the doctor refuses a file without any
    } catch (const InputError&) {
        return false;
    }
}

bool read_gltf_content(std::string_view content)
{
    try {
        examine_faces(read_gltf("/nowhere/a.gltf", content).soup);
        return true;
    } catch (const InputError&) {
        return false;
    }
}

bool read_deck_content(const char* name, std::string_view content)
{
    try {
        const Deck deck = read_deck(fs::path("/nowhere") / name, std::string(content));
        require(deck.elements() > 0, "a deck without shells was accepted");
        require(deck.element.size() == deck.corner.size() && deck.part_of.size() == deck.corner.size(),
                "shells without ids or parts");
        require(deck.node.size() == deck.position.size(), "nodes without ids");
        require_finite(deck.position);
        for (size_t e = 0; e < deck.corner.size(); ++e) {
            for (size_t k = 0; k < 4; ++k)
                require(deck.corner[e][k] >= (k == 3 ? -1 : 0) && deck.corner[e][k] < deck.nodes(),
                        "a corner that is not there");
            require(size_t(deck.part_of[e]) < deck.parts.size(), "a part that is not there");
        }
        for (const DeckSet& set : deck.sets)
            for (const int e : set.elements)
                require(e >= 0 && e < deck.elements(), "a set of shells that are not there");
        examine_faces(choose_parts(deck, {}).soup);
        return true;
    } catch (const InputError&) {
        return false;
    }
}

bool read_k(std::string_view content) { return read_deck_content("a.k", content); }
bool read_bdf(std::string_view content) { return read_deck_content("a.bdf", content); }
bool read_inp(std::string_view content) { return read_deck_content("a.inp", content); }
bool read_msh(std::string_view content) { return read_deck_content("a.msh", content); }
bool read_rad(std::string_view content) { return read_deck_content("a.rad", content); }

/// A file of this process that holds the content, for readers that open files themselves.
class Held {
public:
    Held(const char* ending, std::string_view content)
        : path_(fs::temp_directory_path() / ("spia-fuzz-" + std::to_string(::getpid()) + ending))
    {
        std::ofstream(path_, std::ios::binary) << content;
    }
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
    ~Held() { fs::remove(path_); }
    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

bool read_dxf_content(std::string_view content)
{
    try {
        const Held file(".dxf", content);
        for (const SheetLine& line : read_dxf(file.path()).lines)
            require(line.point.allFinite(), "a line through no place was accepted");
        return true;
    } catch (const InputError&) {
        return false;
    }
}

bool read_json_lines(std::string_view content)
{
    try {
        const Held file(".json", content);
        for (const SheetLine& line : read_line_file(file.path()).lines)
            require(line.point.allFinite(), "a line through no place was accepted");
        return true;
    } catch (const InputError&) {
        return false;
    }
}

bool read_table(std::string_view content)
{
    try {
        parse_two_columns(std::string(content), "a.csv");
        return true;
    } catch (const InputError&) {
        return false;
    }
}

bool read_steps(std::string_view content)
{
    static const PartFile part = [] {
        const TriMesh mesh = shapes::rectangle(40, 20, 4, 2);
        PolygonSoup soup;
        for (int v = 0; v < mesh.vertices(); ++v)
            soup.position.emplace_back(mesh.position(0, v), mesh.position(1, v),
                                       std::max(0., mesh.position(0, v) - 20)); // bent along x = 20
        for (int f = 0; f < mesh.triangles(); ++f)
            soup.add_polygon(std::array{mesh.triangle(0, f), mesh.triangle(1, f), mesh.triangle(2, f)});
        return examine_soup(soup);
    }();
    static const BendMap map = find_bends(part.mesh);
    try {
        const Held file(".json", content);
        read_unfold_script(file.path(), part, map);
        return true;
    } catch (const InputError&) {
        return false;
    }
}

bool read_moves(std::string_view content)
{
    try {
        const Held file(".json", content);
        const DeformationWish wish = read_deformation(file.path());
        require(!wish.moves.empty() || wish.lattice, "a deformation that moves nothing was accepted");
        for (const ControlMove& move : wish.moves)
            require(move.patch >= 0 && move.i >= 0 && move.j >= 0 && move.move.allFinite(),
                    "a move to no place was accepted");
        if (wish.lattice)
            require(wish.lattice->move.cols() == wish.lattice->points() && wish.lattice->move.allFinite(),
                    "a lattice point without a move was accepted");
        return true;
    } catch (const InputError&) {
        return false;
    }
}

bool read_cuts(std::string_view content)
{
    try {
        const Held file(".json", content);
        const std::optional<LayoutOptions> layout = patch_layout(file.path().string());
        require(layout && (!layout->cuts.empty() || !layout->corners.empty() || layout->smooth_joins),
                "a layout of nothing was accepted");
        for (const LayoutCut& cut : layout->cuts)
            for (const int v : cut)
                require(v >= 0, "a cut through no vertex was accepted");
        return true;
    } catch (const InputError&) {
        return false;
    }
}

const std::vector<std::string> numbers = {"-1",
                                          "0",
                                          "99999999",
                                          "4294967296",
                                          "9223372036854775807",
                                          "-9223372036854775808",
                                          "1e999",
                                          "1e300",
                                          "1.5-3",
                                          "nan",
                                          "inf",
                                          "\n",
                                          "\r\n",
                                          "\n\n",
                                          "\t",
                                          "\xff\xfe",
                                          "\xff\xff\xff\xff",
                                          std::string(1, '\0'),
                                          std::string(300, ' '),
                                          std::string(300, '9')};

std::vector<std::string> with_numbers(std::vector<std::string> words)
{
    words.insert(words.end(), numbers.begin(), numbers.end());
    return words;
}

/// Seeds of the deck samples with one of these endings.
std::vector<std::string> decks(std::initializer_list<const char*> endings)
{
    std::vector<std::string> texts;
    for (const auto& [name, text] : sample::decks())
        for (const char* ending : endings)
            if (name.ends_with(ending))
                texts.push_back(text);
    return texts;
}

/// The keywords of all decks in each, so that one reader meets what is meant for another.
const std::vector<std::string> deck_words = {"*",
                                             "*NODE\n",
                                             "*ELEMENT_SHELL_THICKNESS\n",
                                             "*PART_INERTIA\n",
                                             "*PART_COMPOSITE\n",
                                             "*SECTION_SHELL_TITLE\n",
                                             "*INCLUDE\n",
                                             "*INCLUDE\na.k\n",
                                             "*PARAMETER\nR x 1\n",
                                             "*KEYWORD LONG=Y\n",
                                             "*END\n",
                                             "&x",
                                             "-&x",
                                             "$",
                                             "**",
                                             "INCLUDE 'a.bdf'\n",
                                             "INCLUDE '",
                                             "BEGIN BULK\n",
                                             "ENDDATA\n",
                                             "CORD2R,1,1,1.,1.,1.,1.,1.,1.\n",
                                             "GRDSET,,1\n",
                                             "PCOMP,7,,,,,,,SYM\n",
                                             "GRID*",
                                             ",",
                                             ",,,,,,,,,,,,",
                                             "*\n",
                                             "+\n",
                                             "*ELSET, ELSET=A, GENERATE\n",
                                             "1,9000000000000000000,1\n",
                                             "-9223372036854775808,9223372036854775807,9223372036854775807\n",
                                             "*ELSET, ELSET=A\nA, HOOD\n",
                                             "*PART, NAME=\"A\n",
                                             "*INSTANCE\n",
                                             "*SHELL SECTION, ELSET=A, COMPOSITE\n",
                                             "*INCLUDE, INPUT=a.inp\n",
                                             "*ELEMENT, TYPE=STRI65\n",
                                             "CORD1R,1,1,2,3\n",
                                             "*DEFINE_TRANSFORMATION\n1\n",
                                             "ROTATE,0,0,1,0,0,0,90\n",
                                             "POS6P,1,2,3,4,5,6\n",
                                             "MIRROR,0,0,0,1,0,0\n",
                                             "*INCLUDE_TRANSFORM\n",
                                             "/TRANSFORM/ROT/1\n",
                                             "/GRNOD/PART/5\n",
                                             "*NGEN, NSET=A\n",
                                             "*NGEN, LINE=C\n1,2,1,,0,0,0,0,0,1\n",
                                             "*NFILL, BIAS=2, TWO STEP\nA,B,4,10\n",
                                             "*NCOPY, CHANGE NUMBER=9, OLD SET=A, NEW SET=B, POLE\n1\n",
                                             "*NCOPY, CHANGE NUMBER=9, OLD SET=A, REFLECT=MIRROR\n",
                                             "*ELGEN, ELSET=A\n1,3,1,1,2,10,10,2,100,100\n",
                                             "*ELCOPY, OLD SET=A, NEW SET=A, ELEMENT SHIFT=9, SHIFT NODES=9, REFLECT\n",
                                             "*NSET, NSET=A, UNSORTED\n",
                                             "*NSET, NSET=B, GENERATE\n1,999999999,1\n",
                                             "*SYSTEM\n1,1,1,2,1,1\n",
                                             "*END INSTANCE\n",
                                             "999999999",
                                             "*NODE_TRANSFORM\n7,3,1\n",
                                             "*SET_NODE_LIST_GENERATE\n3\n1,9000000000000000000\n",
                                             "*SET_NODE_GENERAL\n3\nPART,1\nDNODE,2\n",
                                             "*SET_NODE_ADD\n3\n3,4\n",
                                             "//SUBMODEL/4\nx\n       100\n",
                                             "//ENDSUB\n",
                                             "*INSTANCE, NAME=A, PART=B\n1,2,3\n",
                                             "$NOD\n",
                                             "$ELM\n",
                                             "$ParametricNodes\n",
                                             "$EndNodes\n",
                                             "$Elements\n",
                                             "$PhysicalNames\n",
                                             "9000000000000000000\n",
                                             "/NODE\n",
                                             "/SHELL/4\n",
                                             "/PROP/SHELL/-1\n",
                                             "/PART/",
                                             "#include a.rad\n"};

std::vector<std::string> with(std::vector<std::string> seeds, const std::string& seed)
{
    seeds.push_back(seed);
    return seeds;
}

const char* const ply_strip =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n1 1 0\n9 0 1 2 3 -1 1 2 3 -1\n";

const char* const moved_k =
    "*KEYWORD\n*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n*ELEMENT_SHELL\n1,1,1,2,3\n*DEFINE_TRANSFORMATION\n7\n"
    "TRANSL,1,2,3\nSCALE,1,2,1\nMIRROR,0,0,0,1,0,0\nROTATE,0,0,1,0,0,0,90\nROTATE,1,2,30\nPOINT,1,5,6,7\n"
    "POS6P,1,2,3,1,2,3\n*SET_NODE_LIST\n3\n1,2\n*SET_NODE_GENERAL\n4\nPART,1\nDNODE,3\n*SET_NODE_ADD\n5\n3,4\n"
    "*NODE_TRANSFORM\n7,3\n7,4,1\n7,5\n*INCLUDE_TRANSFORM\nhalf.k\n1000,1000,0\n0\n,,2\n7\n*END\n";

const char* const made_inp =
    "*NODE, NSET=ENDS\n1,0,0\n5,4,0\n*NODE, SYSTEM=S\n41,9,0,60\n45,9,30,60\n*NGEN, NSET=LOW\n1,5\n"
    "*NGEN, NSET=HIGH, LINE=C\n41,45,1,,0,0,0\n*NFILL, BIAS=2, NSET=ALL\nLOW,HIGH,4,10\n*ELEMENT, TYPE=S4, ELSET=SKIN\n"
    "1,1,2,12,11\n*ELGEN, ELSET=SKIN\n1,4,1,1,4,10,10\n*NCOPY, CHANGE NUMBER=100, OLD SET=ALL, REFLECT=MIRROR\n"
    "0,0,0,1,0,0\n0,0,1\n*ELCOPY, OLD SET=SKIN, NEW SET=COPY, ELEMENT SHIFT=100, SHIFT NODES=100, REFLECT\n"
    "*NSET, NSET=SOME, GENERATE\n1,45,2\n*NCOPY, CHANGE NUMBER=200, OLD SET=SOME, SHIFT, MULTIPLE=2\n1,2,3\n"
    "0,0,0,0,0,1,30\n";

const char* const placed_inp =
    "*PART, NAME=P\n*NODE\n1,0,0\n2,1,0\n3,0,1\n*ELEMENT, TYPE=S3, ELSET=SKIN\n1,1,2,3\n*SHELL SECTION, ELSET=SKIN\n"
    "1.\n*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=P\n*END INSTANCE\n*INSTANCE, NAME=J, PART=P\n1,2,3\n"
    "0,0,0,0,0,1,30\n*END INSTANCE\n*INSTANCE, NAME=K, PART=Q\n4,5,6\n*NODE\n1,0,0\n*END INSTANCE\n*END ASSEMBLY\n";

const char* const moved_bdf =
    "BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nCORD1R,1,1,2,3,2,2,3,1\n"
    "CORD1C,5,1,2,3\nCORD1S,6,1,2,3\nGRID,4,1,1.,1.,0.\nGRID,5,5,1.,30.,0.\nGRID,6,6,1.,30.,9.\n"
    "CQUAD4,1,1,1,2,3,4\nCTRIA3,2,1,4,5,6\nPSHELL,1,1,1.\nENDDATA\n";

const char* const moved_rad =
    "/BEGIN\nmoved\n      2022         0\n/NODE\n         1                   0                   0                   0\n"
    "         2                   1                   0                   0\n"
    "         3                   0                   1                   0\n/SH3N/1\n         1         1         2         3\n"
    "/PART/1\nsheet\n         1         1\n/GRNOD/PART/5\nall\n         1\n/GRNOD/NODE/6\nsome\n         1         2\n"
    "/TRANSFORM/TRA/1\nby\n         5                   1                   2                   3\n"
    "/TRANSFORM/ROT/2\nturn\n         6                   0                   0                   0\n"
    "                            1                   0                   0                  90\n"
    "//SUBMODEL/4\nsub\n         0       100       100\n/BEGIN\nrun\n      2022         0\n"
    "                  Mg                  cm                   s\n/NODE\n"
    "         1                   0                   0                   0\n"
    "         2                   1                   0                   0\n"
    "         3                   0                   1                   0\n/SH3N/1\n         1         1         2         3\n"
    "//SUBMODEL/5\nin it\n        10\n//ENDSUB\n//ENDSUB\n/TRANSFORM/TRA/3\nby\n"
    "                            1                   2                   3         0         0         4\n/END\n";

/// Three nodes and a triangle, of version 2.2.
std::string binary_msh()
{
    std::string text = "$MeshFormat\n2.2 1 8\n";
    const auto ints = [&](std::initializer_list<std::int32_t> values) {
        for (const std::int32_t value : values)
            sample::append(text, value);
    };
    ints({1});
    text += "\n$EndMeshFormat\n$Nodes\n3\n";
    for (int k = 0; k < 3; ++k) {
        ints({k + 1});
        for (const double x : {k == 1 ? 1. : 0., k == 2 ? 1. : 0., 0.})
            sample::append(text, x);
    }
    text += "\n$EndNodes\n$Elements\n1\n";
    ints({2, 1, 2, 1, 5, 7, 1, 2, 3});
    return text + "\n$EndElements\n";
}

std::string dxf_seed()
{
    std::string text = "  0\nSECTION\n  2\nHEADER\n  9\n$INSUNITS\n 70\n4\n  0\nENDSEC\n  0\nSECTION\n  2\nENTITIES\n";
    for (const char* entity :
         {"0 LINE 8 a 10 0 20 0 30 0 11 5 21 6 31 7", "0 CIRCLE 8 b 10 1 20 2 40 3",
          "0 ARC 8 c 10 1 20 2 40 3 50 10 51 300", "0 LWPOLYLINE 8 d 90 3 70 1 10 0 20 0 42 0.5 10 9 20 0 10 9 20 9",
          "0 POLYLINE 8 e 70 8", "0 VERTEX 8 e 10 1 20 1 30 1", "0 VERTEX 8 e 10 2 20 2 30 1", "0 SEQEND",
          "0 ELLIPSE 8 f 10 0 20 0 11 4 21 0 40 0.5 41 0 42 6.2831853",
          "0 SPLINE 8 g 71 2 40 0 40 0 40 0 40 1 40 1 40 1 10 0 20 0 30 0 10 1 20 2 30 0 10 3 20 0 30 0",
          "0 TEXT 8 BEND_UP 10 1 20 2 30 0 40 3 1 UP 1001 SPIA 1000 bend 1000 b 1000 k 1040 0.5", "0 HATCH 8 h"}) {
        std::string lines = entity;
        for (char& c : lines)
            c = c == ' ' ? '\n' : c;
        text += lines + "\n";
    }
    return text + "  0\nENDSEC\n  0\nEOF\n";
}

const char* const steps_seed = R"({"schema": "spia.unfold/1",
 "regions": [{"name": "leg", "kind": "region", "at": [30, 10, 10], "area_mm2": 560}],
 "steps": [{"name": "leg", "kind": "lay", "freed": {"regions": ["leg"], "faces": [15], "box": [[25, -5, 1], [50, 50, 50]]},
   "fixed": {"faces": [0, 1, 8, 9]}, "carrying": {"faces": [0]},
   "target": {"cylinder": {"origin": [0, 0, 0], "axis": [0, 1, 0], "radius": 40}, "offset_mm": 0.01, "extent_mm": 50},
   "friction": {"coefficient": 0.12, "pressure_MPa": 2.5, "sides": 1}, "options": {"tolerance": 1e-9}},
  {"kind": "unroll", "carrying": {"regions": ["region 2"]}}, {"kind": "flatten"}]})";

const char* const lines_seed = R"({"schema": "spia.lines/1", "unit": "cm", "lines": [
 {"name": "hole 1", "closed": true, "points": [[10, 20], [30, 20], [30, 40]]}, {"name": "", "points": [[0, 0, 1], [1, 2, 3]]}]})";

const char* const moves_seed =
    R"({"schema": "spia.deformation/1", "moves": [{"patch": 1, "at": [2, 3], "by": [0, 0.5, -1e2]}],
 "lattice": {"count": [3, 4, 2], "degree": [2, 3, 1], "origin": [0, 0, 0], "edges": [[10, 0, 0], [0, 20, 0], [0, 0, 5]],
  "moves": [{"at": [1, 1, 1], "by": [1, 2, 3]}]}})";

const char* const cuts_seed = R"({"cuts": [[12, 40, 77], [1, 2]], "corners": [3, 9, 60, 88], "smooth_joins": true})";

std::vector<FuzzTarget> make_targets()
{
    const TriMesh mesh = shapes::rectangle(10. / 3, 7. / 3, 3, 2);
    const sample::GltfStrip strip;
    const std::vector<std::string> mesh_words = with_numbers(
        {"{", "[", "\"", "/", "\\", "f ", "v ", "OFF\n", "CNOFF\n", "element face 7\n", "property list char int x\n",
         "format binary_big_endian 1.0\n", "outer loop\n", "facet normal", "endfacet\n", "vertex ", "end_header\n"});
    const std::vector<std::string> gltf_words = with_numbers({"{",
                                                              "[",
                                                              "]",
                                                              "}",
                                                              "\"",
                                                              ",",
                                                              ":",
                                                              "\"sparse\":{",
                                                              "\"matrix\":[",
                                                              "\"byteStride\":",
                                                              "\"mode\":6",
                                                              "\"children\":[0]",
                                                              "\"extensionsRequired\":[",
                                                              "\"normalized\":true",
                                                              "5126",
                                                              "5120",
                                                              "\"MAT4\"",
                                                              "\"count\":",
                                                              "\"byteStride\":256",
                                                              "\"INDICES\"",
                                                              "\"filter\":\"EXPONENTIAL\","});
    const std::vector<std::string> words = with_numbers(deck_words);
    return {
        {"obj", {sample::obj_text(mesh)}, mesh_words, read_mesh<check_obj>},
        {"off", {sample::off_text(mesh)}, mesh_words, read_mesh<check_off>},
        {"ply",
         {sample::ply_text(mesh), sample::ply_binary(mesh, false), sample::ply_binary(mesh, true), ply_strip},
         mesh_words,
         read_mesh<check_ply>},
        {"stl", {sample::stl_text(mesh), sample::stl_binary(mesh)}, mesh_words, read_mesh<check_stl>},
        {"gltf",
         {sample::GltfStrip("data:application/octet-stream;base64," + sample::base64(strip.binary)).json,
          sample::glb(strip.json, strip.binary), sample::glb_by_meshopt(mesh, true), sample::glb_by_draco(mesh, 8)},
         gltf_words,
         read_gltf_content},
        {"k", with(decks({".k", ".key", ".dyn"}), moved_k), words, read_k},
        {"bdf", with(decks({".bdf", ".nas", ".dat"}), moved_bdf), words, read_bdf},
        {"inp", with(with(decks({".inp"}), made_inp), placed_inp), words, read_inp},
        {"msh", with(decks({".msh"}), binary_msh()), words, read_msh},
        {"rad", with(decks({".rad"}), moved_rad), words, read_rad},
        {"dxf",
         {dxf_seed()},
         with_numbers(
             {"LINE\n", "SPLINE\n", "ELLIPSE\n", "POLYLINE\n", " 10\n", " 42\n", " 71\n", " 70\n", "230\n-1\n"}),
         read_dxf_content},
        {"csv",
         {"strain;stress\n0;200\n0,1;300\n0,2;350,5\n", "# tensile test\n0.0, 200\n0.1, 300\n"},
         with_numbers({";", ",", "#", "\"", "."}),
         read_table},
        {"lines.json",
         {lines_seed},
         with_numbers({"{", "}", "[", "]", "\"", "null", "\"inch\"", "\"unit\"", "[]", "[[[["}),
         read_json_lines},
        {"steps.json",
         {steps_seed},
         with_numbers(
             {"{", "}", "[", "]", "\"", "\"cylinder\"", "\"smooth\"", "\"faces\":[0]", "\"region 2\"", "null"}),
         read_steps},
        {"deformation.json",
         {moves_seed},
         with_numbers({"{", "}", "[", "]", "\"", "\"moves\"", "\"lattice\"", "\"edges\"", "[]", "[0,0,0]", "null"}),
         read_moves},
        {"patches.json",
         {cuts_seed},
         with_numbers({"{", "}", "[", "]", "\"", "\"cuts\"", "\"corners\"", "[]", "[[[[", "null"}),
         read_cuts},
    };
}

} // namespace

const std::vector<FuzzTarget>& fuzz_targets()
{
    static const std::vector<FuzzTarget> targets = make_targets();
    return targets;
}

const FuzzTarget& fuzz_target(std::string_view name)
{
    for (const FuzzTarget& target : fuzz_targets())
        if (target.name == name)
            return target;
    throw std::out_of_range("no format of this name: " + std::string(name));
}

} // namespace spia::fuzz
