#include "engine/exchange/list_items.h"

#include <Eigen/Geometry>
#include <cstdlib>
#include <fmt/core.h>
#include <set>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/file_content.h"
#include "engine/core/text.h"
#include "engine/exchange/cad/read_cad.h"
#include "engine/exchange/deck/deck_choice.h"
#include "engine/exchange/deck/read_deck.h"
#include "engine/exchange/mesh/mesh_file.h"
#include "engine/exchange/part_formats.h"
#include "engine/mesh/doctor/doctor.h"

namespace spia {
namespace {

/// A polygon's from its vector area: of one that is not plane, that of its shadow along its mean
/// normal.
double area_of(const PolygonSoup& soup, int p)
{
    const auto corner = soup.polygon(p);
    for (const int v : corner)
        if (v < 0 || v >= soup.vertices())
            return 0; // the doctor says so
    Eigen::Vector3d twice = Eigen::Vector3d::Zero();
    const auto at = [&](size_t k) -> const Eigen::Vector3d& { return soup.position[size_t(corner[k])]; };
    for (size_t k = 2; k < corner.size(); ++k)
        twice += (at(k - 1) - at(0)).cross(at(k) - at(0));
    return twice.norm() / 2;
}

/// Every polygon counts for its item and for all that hold it.
void add_areas(FileItems& items)
{
    for (int p = 0; p < items.preview.polygons(); ++p)
        for (int i = items.item_of[size_t(p)]; i >= 0; i = items.item[size_t(i)].parent)
            items.item[size_t(i)].area += area_of(items.preview, p);
}

FileItems items_of_cad(const std::filesystem::path& path, const Progress& progress)
{
    CadContent cad = preview_cad(path, progress);
    FileItems items;
    items.kind = FileKind::cad;
    items.format = cad.format;
    items.unit = cad.unit;
    for (const CadItem& each : cad.tree.item) {
        FileItem item;
        item.choice = choice(each);
        item.name = each.name;
        item.kind = name(each.kind);
        item.parent = each.parent;
        item.faces = each.faces;
        item.solid = each.kind == CadItem::Kind::solid;
        items.item.push_back(std::move(item));
    }
    std::vector<char> shown(size_t(cad.faces), 0);
    for (const int face : cad.face) {
        shown[size_t(face)] = 1;
        items.item_of.push_back(cad.tree.body_of[size_t(face)]);
    }
    for (size_t f = 0; f < shown.size(); ++f)
        if (!shown[f])
            items.notes.push_back(fmt::format("no triangles could be made of CAD face {} for the preview", f));
    items.preview = std::move(cad.soup);
    items.face_of = std::move(cad.face);
    add_areas(items);
    return items;
}

/// What parts and sets are asked for by.
std::string choice(const DeckPart& part) { return part.id ? fmt::format("{}", *part.id) : part.name; }

FileItems items_of_deck(const std::filesystem::path& path, const Progress& progress)
{
    Deck deck = read_deck(path, file_content(path), progress);
    FileItems items;
    items.kind = FileKind::deck;
    items.format = deck.format;
    items.unit = deck.unit ? name(*deck.unit) : "";
    items.notes = std::move(deck.notes);
    std::vector<int> item_of_part(deck.parts.size(), -1);
    for (size_t p = 0; p < deck.parts.size(); ++p) {
        const DeckPart& part = deck.parts[p];
        if (part.elements + part.broken == 0)
            continue;
        item_of_part[p] = int(items.item.size());
        items.item.push_back(
            {choice(part), part.name, "part", -1, part.elements, 0, part.thickness, part.material, false});
        if (part.broken > 0)
            items.notes.push_back(fmt::format("part {}: {} nodes that are not in the deck (first: element {}, "
                                              "node {}); it cannot be taken",
                                              title(part), counted(part.broken, "shell names", "shells name"),
                                              part.broken_element, part.missing_node));
    }
    items.preview.position = std::move(deck.position);
    for (int e = 0; e < deck.elements(); ++e) {
        const std::array<int, 4>& corner = deck.corner[size_t(e)];
        items.preview.add_polygon(std::span(corner).first(corner[3] < 0 ? 3 : 4));
        items.item_of.push_back(item_of_part[size_t(deck.part_of[size_t(e)])]);
        items.face_of.push_back(e);
    }
    add_areas(items);
    std::set<std::pair<std::string, int>> parts;
    for (const FileItem& part : items.item)
        parts.emplace(part.name, part.faces);
    for (const DeckSet& set : deck.sets) {
        if (parts.contains({set.name, int(set.elements.size())}))
            continue; // the part that it is
        FileItem item{set.name, set.name, "element set", -1, int(set.elements.size()), 0, {}, {}, false};
        for (const int e : set.elements)
            item.area += area_of(items.preview, e);
        items.item.push_back(std::move(item));
    }
    return items;
}

FileItems items_of_mesh(const std::filesystem::path& path, const Progress& progress)
{
    MeshFile file = read_mesh_file(path, progress);
    FileItems items;
    items.format = std::move(file.format);
    items.unit = file.unit ? name(*file.unit) : "";
    items.notes = std::move(file.notes);
    items.preview = std::move(file.soup);
    const int polygons = items.preview.polygons();
    items.item.push_back({"", "", "mesh", -1, polygons, 0, {}, {}, false});
    items.item_of.assign(size_t(polygons), 0);
    for (int p = 0; p < polygons; ++p)
        items.face_of.push_back(p);
    add_areas(items);
    return items;
}

} // namespace

FileItems list_items(const std::filesystem::path& path, const Progress& progress)
{
    try {
        switch (require_kind_of_file(path)) {
        case FileKind::cad: return items_of_cad(path, progress);
        case FileKind::deck: return items_of_deck(path, progress);
        case FileKind::mesh: return items_of_mesh(path, progress);
        }
        std::abort();
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", path.string(), error.what()));
    }
}

} // namespace spia
