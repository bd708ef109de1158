#include "engine/exchange/deck/part_shells.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/exchange/sheet_field_list.h"
#include "engine/mesh/doctor/doctor.h"
#include "engine/options/part_options.h"

namespace spia {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// The elements of a file and their nodes, before those without a triangle are left out.
struct FileElements {
    std::vector<std::array<int, 4>> corner;
    std::vector<std::int64_t> element, node;
    std::vector<Vector3d> position;
    std::vector<int> part_of;
    std::vector<DeckPart> parts;
};

FileElements of_deck(const DeckOrigin& deck)
{
    return {deck.corner, deck.element_id, deck.node_id, deck.position, deck.part_of, deck.parts};
}

/// The triangles as elements: polygons and seams of other files stay as the solver had them.
FileElements of_triangles(const TriMesh& mesh, LengthUnit unit)
{
    FileElements all;
    for (int v = 0; v < mesh.vertices(); ++v) {
        all.node.push_back(v + 1);
        all.position.push_back(mesh.position.col(v) / millimetres(unit));
    }
    for (int f = 0; f < mesh.triangles(); ++f) {
        const auto t = mesh.triangle.col(f);
        all.corner.push_back({t[0], t[1], t[2], -1});
        all.element.push_back(f + 1);
    }
    all.part_of.assign(all.element.size(), 0);
    all.parts.push_back({.id = 1});
    return all;
}

/// Neighbouring corners on the same node are one: "7 7 8 9" is a triangle.
std::array<int, 4> without_repetition(const std::array<int, 4>& corner)
{
    std::array<int, 4> result = {-1, -1, -1, -1};
    size_t count = 0;
    for (const int v : corner)
        if (v >= 0 && (count == 0 || (result[count - 1] != v && result[0] != v)))
            result[count++] = v;
    return result;
}

void require_once(std::vector<std::int64_t> ids, const char* what)
{
    std::sort(ids.begin(), ids.end());
    if (const auto twice = std::adjacent_find(ids.begin(), ids.end()); twice != ids.end())
        throw InputError(
            fmt::format("{0} {1} is there more than once in the deck, so results cannot be put onto its {0}s; "
                        "choose one part of it ({2}), or renumber the deck",
                        what, *twice, mention(option::part)));
}

/// The parts in use, all with a number.
void take_parts(const FileElements& all, ShellMesh& mesh)
{
    std::int64_t last = 0;
    for (const DeckPart& part : all.parts)
        last = std::max(last, part.id.value_or(0));
    std::vector<int> number(all.parts.size(), -1);
    for (const int p : mesh.part_of)
        number[size_t(p)] = 0;
    for (size_t p = 0; p < number.size(); ++p) {
        const DeckPart& part = all.parts[p];
        const std::int64_t id = part.id && *part.id > 0 ? *part.id : ++last;
        if (number[p] < 0)
            continue;
        number[p] = int(mesh.parts.size());
        mesh.parts.push_back({.id = id,
                              .name = part.name,
                              .material = part.material,
                              .material_id = std::max<std::int64_t>(part.material_id.value_or(1), 1)});
    }
    for (int& p : mesh.part_of)
        p = number[size_t(p)];
}

/// The vertex of the part at which a corner of an element lies: of copies the one that its
/// triangles use; -1 if they use several or none.
int place_of(int file_vertex, int first, int last, const PartFile& part)
{
    const int wanted = stands_for(part, file_vertex);
    int found = -1;
    for (int f = first; f < last; ++f)
        for (const int v : part.mesh.triangle.col(f))
            if (part.source_vertex[size_t(v)] == wanted) {
                if (found >= 0 && found != v)
                    return -1;
                found = v;
            }
    return found;
}

} // namespace

int stands_for(const PartFile& part, int file_vertex)
{
    return part.same_as.empty() ? file_vertex : part.same_as[size_t(file_vertex)];
}

PartShells part_shells(const PartFile& part, LengthUnit unit)
{
    if (part.deck && int(part.source_face.size()) != part.mesh.triangles())
        throw InputError(
            "the faces of the part are no longer those of its deck, so results cannot be put onto its elements");
    const FileElements all = part.deck ? of_deck(*part.deck) : of_triangles(part.mesh, unit);
    PartShells shells;
    ShellMesh& mesh = shells.mesh;
    mesh.unit = part.deck ? part.unit : unit;
    std::vector<int> number(all.node.size(), -1);
    std::vector<std::int64_t> lost;
    for (size_t e = 0; e < all.element.size(); ++e) {
        int first = int(e), last = first + 1;
        if (part.deck) {
            const auto range = std::equal_range(part.source_face.begin(), part.source_face.end(), int(e));
            first = int(range.first - part.source_face.begin());
            last = int(range.second - part.source_face.begin());
        }
        const std::array<int, 4> corner = without_repetition(all.corner[e]);
        if (first == last || corner[2] < 0) {
            lost.push_back(all.element[e]);
            continue;
        }
        std::array<int, 4> place = {-1, -1, -1, -1};
        for (size_t k = 0; k < 4 && corner[k] >= 0; ++k) {
            number[size_t(corner[k])] = 0;
            place[k] = part.deck ? place_of(corner[k], first, last, part) : corner[k];
        }
        for (size_t k = 0; k < 4 && corner[k] >= 0; ++k)
            if (place[k] < 0) {
                place.fill(-1);
                break;
            }
        shells.first.push_back(first);
        shells.place.push_back(place);
        mesh.corner.push_back(corner);
        mesh.element.push_back(all.element[e]);
        mesh.part_of.push_back(all.part_of[e]);
    }
    shells.first.push_back(part.mesh.triangles());
    for (size_t v = 0; v < number.size(); ++v)
        if (number[v] >= 0) {
            number[v] = mesh.nodes();
            shells.file_node.push_back(int(v));
            mesh.node.push_back(all.node[v]);
        }
    mesh.position.resize(3, mesh.nodes());
    for (int n = 0; n < mesh.nodes(); ++n)
        mesh.position.col(n) = all.position[size_t(shells.file_node[size_t(n)])];
    for (auto& corner : mesh.corner)
        for (int& v : corner)
            v = v < 0 ? -1 : number[size_t(v)];
    if (mesh.element.empty())
        throw InputError("the part has no element of its file left, so there is nothing to put results onto");
    require_once(mesh.node, "node");
    require_once(mesh.element, "element");
    take_parts(all, mesh);
    if (!lost.empty())
        mesh.notes.push_back(fmt::format("{} that the part does not have after its repairs {} left out (first: {})",
                                         counted(lost.size(), "element", "elements"), lost.size() == 1 ? "is" : "are",
                                         lost.front()));
    const auto greatest = [](const std::vector<std::int64_t>& ids) {
        return ids.empty() ? 0 : *std::max_element(ids.begin(), ids.end());
    };
    shells.last_node = part.deck ? part.deck->last_node : greatest(mesh.node);
    shells.last_element = part.deck ? part.deck->last_element : greatest(mesh.element);
    return shells;
}

ElementFields element_fields(const PartShells& shells, const TriMesh& part, const SheetFields& face)
{
    require_fields(face, part.triangles(), "face");
    const ShellMesh& mesh = shells.mesh;
    const double mm = millimetres(mesh.unit);
    const int count = mesh.elements();
    ElementFields result;
    for (Eigen::VectorXd* values : {&result.thickness, &result.thinning, &result.strain_major, &result.strain_minor,
                                    &result.strain_equivalent, &result.area})
        values->setZero(count);
    result.strain.setZero(6, count);
    Eigen::VectorXd flat = Eigen::VectorXd::Zero(count); // h0
    for (int e = 0; e < count; ++e) {
        const int first = shells.first[size_t(e)], last = shells.first[size_t(e) + 1];
        Matrix3d strain = Matrix3d::Zero();
        for (int f = first; f < last; ++f) {
            const auto t = part.triangle.col(f);
            const Vector3d a = part.position.col(t[0]);
            const Vector3d cross = (part.position.col(t[1]) - a).cross(part.position.col(t[2]) - a);
            const double area = cross.norm() / 2;
            const Vector3d n = cross.normalized(), d = face.direction_major.col(f), b = n.cross(d);
            const double major = face.strain_major[f], minor = face.strain_minor[f];
            strain +=
                area * (major * d * d.transpose() + minor * b * b.transpose() - (major + minor) * n * n.transpose());
            result.area[e] += area;
            result.thickness[e] += area * face.thickness[f];
            result.thinning[e] += area * face.thinning[f];
            result.strain_major[e] += area * major;
            result.strain_minor[e] += area * minor;
            result.strain_equivalent[e] += area * face.strain_equivalent[f];
            flat[e] += area * face.thickness[f] / (1 - face.thinning[f]);
        }
        const double area = result.area[e];
        for (Eigen::VectorXd* values : {&result.thickness, &result.thinning, &result.strain_major, &result.strain_minor,
                                        &result.strain_equivalent, &flat})
            (*values)[e] /= area;
        strain /= area;
        result.strain.col(e) << strain(0, 0), strain(1, 1), strain(2, 2), strain(0, 1), strain(1, 2), strain(2, 0);
    }

    Eigen::VectorXd volume = Eigen::VectorXd::Zero(mesh.nodes()), weight = volume;
    for (int e = 0; e < count; ++e)
        for (size_t k = 0; k < mesh.corners(e); ++k) {
            const int v = mesh.corner[size_t(e)][k];
            volume[v] += result.area[e] * result.thickness[e] / double(mesh.corners(e));
            weight[v] += result.area[e] * flat[e] / double(mesh.corners(e));
        }
    result.corner_thickness.setZero(4, count);
    for (int e = 0; e < count; ++e)
        for (size_t k = 0; k < mesh.corners(e); ++k) {
            const int v = mesh.corner[size_t(e)][k];
            result.corner_thickness(int(k), e) = flat[e] * volume[v] / weight[v] / mm;
        }
    result.thickness /= mm;
    result.area /= mm * mm;
    return result;
}

} // namespace spia
