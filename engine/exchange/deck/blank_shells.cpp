#include <Eigen/Geometry>
#include <cmath>
#include <fmt/core.h>
#include <map>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/exchange/deck/part_shells.h"
#include "engine/exchange/sheet_field_list.h"
#include "engine/mesh/doctor/doctor.h"

namespace spia {
namespace {

using Eigen::Vector3d;

class BlankBuilder {
public:
    BlankBuilder(const PartFile& part, const PartShells& shells) : part_(part), shells_(shells)
    {
        blank_.mesh.unit = shells.mesh.unit;
        blank_.mesh.parts = shells.mesh.parts;
        blank_.mesh.notes = shells.mesh.notes;
        last_node_ = shells.last_node;
        last_element_ = shells.last_element;
    }

    BlankShells build(const Blank& blank)
    {
        const ShellMesh& formed = shells_.mesh;
        for (int e = 0; e < formed.elements(); ++e)
            if (shells_.place[size_t(e)][0] >= 0)
                take_whole(e);
            else
                take_triangles(e);
        number_nodes(blank);
        ShellMesh& mesh = blank_.mesh;
        if (const auto copies = last_node_ - shells_.last_node; copies > 0)
            mesh.notes.push_back(fmt::format("the part was cut open: {}, with ids from {} on",
                                             counted(copies, "node is a copy", "nodes are copies"),
                                             shells_.last_node + 1));
        if (torn_ > 0)
            mesh.notes.push_back(
                fmt::format("{} torn by the cut and written as triangles, further ones with ids from {} on",
                            counted(torn_, "element is", "elements are"), shells_.last_element + 1));
        return std::move(blank_);
    }

private:
    std::int64_t id_of(int file_vertex) const
    {
        return part_.deck ? part_.deck->node_id[size_t(file_vertex)] : file_vertex + 1;
    }

    /// Its number for now, in the order of use.
    int node(int file_vertex, int vertex)
    {
        return node_.try_emplace({file_vertex, vertex}, int(node_.size())).first->second;
    }

    /// In the order of the file. Of the places of one node the first has its id, the others are
    /// copies.
    void number_nodes(const Blank& blank)
    {
        ShellMesh& mesh = blank_.mesh;
        mesh.position.setZero(3, long(node_.size()));
        std::vector<int> number(node_.size());
        int before = -1;
        for (const auto& [place, used] : node_) {
            const auto [file_vertex, vertex] = place;
            number[size_t(used)] = mesh.nodes();
            mesh.position.col(mesh.nodes()).head<2>() = blank.position.col(vertex) / millimetres(mesh.unit);
            mesh.node.push_back(file_vertex == before ? ++last_node_ : id_of(file_vertex));
            blank_.part_node.push_back(id_of(file_vertex));
            before = file_vertex;
        }
        for (auto& corner : mesh.corner)
            for (int& v : corner)
                v = v < 0 ? -1 : number[size_t(v)];
    }

    void add(std::int64_t id, const std::array<int, 4>& corner, int part)
    {
        blank_.mesh.element.push_back(id);
        blank_.mesh.corner.push_back(corner);
        blank_.mesh.part_of.push_back(part);
    }

    void take_whole(int e)
    {
        const ShellMesh& formed = shells_.mesh;
        std::array<int, 4> corner = {-1, -1, -1, -1};
        for (size_t k = 0; k < formed.corners(e); ++k)
            corner[k] = node(file_vertex(e, k), shells_.place[size_t(e)][k]);
        add(formed.element[size_t(e)], corner, formed.part_of[size_t(e)]);
    }

    int file_vertex(int e, size_t k) const { return shells_.file_node[size_t(shells_.mesh.corner[size_t(e)][k])]; }

    /// As the solver had it, on the side that the deck gave it.
    void take_triangles(int e)
    {
        const ShellMesh& formed = shells_.mesh;
        const auto at = [&](size_t k) { return Vector3d(formed.position.col(formed.corner[size_t(e)][k])); };
        const Vector3d normal = formed.corners(e) == 4 ? (at(2) - at(0)).cross(at(3) - at(1)).eval()
                                                       : (at(1) - at(0)).cross(at(2) - at(0)).eval();
        const int first = shells_.first[size_t(e)];
        for (int f = first; f < shells_.first[size_t(e) + 1]; ++f) {
            const auto t = part_.mesh.triangle.col(f);
            std::array<int, 4> corner = {-1, -1, -1, -1};
            for (int k = 0; k < 3; ++k)
                corner[size_t(k)] = node(source_of(e, t[k]), t[k]);
            const Vector3d a = part_.mesh.position.col(t[0]), b = part_.mesh.position.col(t[1]),
                           c = part_.mesh.position.col(t[2]);
            if ((b - a).cross(c - a).dot(normal) < 0)
                std::swap(corner[1], corner[2]);
            add(f == first ? formed.element[size_t(e)] : ++last_element_, corner, formed.part_of[size_t(e)]);
        }
        ++torn_;
    }

    /// The vertex of the file, of joined ones that of the element.
    int source_of(int e, int vertex) const
    {
        const int source = part_.source_vertex[size_t(vertex)];
        for (size_t k = 0; k < shells_.mesh.corners(e); ++k)
            if (const int v = file_vertex(e, k); stands_for(part_, v) == source)
                return v;
        return source;
    }

    const PartFile& part_;
    const PartShells& shells_;
    BlankShells blank_;
    std::map<std::pair<int, int>, int> node_; // vertex of the file and of the part
    std::int64_t last_node_ = 0, last_element_ = 0;
    int torn_ = 0;
};

/// To ten digits: 1 - thinning has lost the last ones.
double rounded(double value)
{
    const double scale = std::pow(10, 9 - std::floor(std::log10(value)));
    return std::round(value * scale) / scale;
}

/// Thickness of the flat sheet, where it is the same in all of a part.
void take_thickness(const PartShells& shells, const SheetFields& face, std::vector<ShellPart>& parts)
{
    std::vector<double> low(parts.size(), 1e300), high(parts.size(), 0);
    for (int e = 0; e < shells.mesh.elements(); ++e)
        for (int f = shells.first[size_t(e)]; f < shells.first[size_t(e) + 1]; ++f) {
            const double flat = face.thickness[f] / (1 - face.thinning[f]);
            const size_t p = size_t(shells.mesh.part_of[size_t(e)]);
            low[p] = std::min(low[p], flat);
            high[p] = std::max(high[p], flat);
        }
    constexpr double rounding = 1e-9;
    for (size_t p = 0; p < parts.size(); ++p)
        if (high[p] - low[p] <= rounding * high[p])
            parts[p].thickness = rounded((low[p] + high[p]) / 2 / millimetres(shells.mesh.unit));
}

} // namespace

BlankShells blank_shells(const PartFile& part, const PartShells& shells, const Blank& blank, const SheetFields& face)
{
    require_blank_of(part.mesh, blank);
    require_fields(face, part.mesh.triangles(), "face");
    BlankShells result = BlankBuilder(part, shells).build(blank);
    take_thickness(shells, face, result.mesh.parts);
    return result;
}

} // namespace spia
