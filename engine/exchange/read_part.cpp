#include "engine/exchange/read_part.h"

#include <algorithm>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/core/file_content.h"
#include "engine/exchange/cad/cad_findings.h"
#include "engine/exchange/cad/read_cad.h"
#include "engine/exchange/deck/deck_choice.h"
#include "engine/exchange/deck/read_deck.h"
#include "engine/exchange/mesh/mesh_file.h"
#include "engine/exchange/part_formats.h"
#include "engine/options/part_options.h"
#include "engine/part/curved_faces.h"
#include "engine/part/prepare_part.h"
#include "engine/part/remesh_needles.h"
#include "engine/part/remesh_part.h"
#include "engine/part/round_rims.h"

namespace spia {
namespace {

namespace fs = std::filesystem;

/// What leads back to the deck; lengths in its unit.
DeckOrigin origin_of(const Deck& deck, const DeckChoice& choice)
{
    DeckOrigin origin;
    for (const int e : choice.element) {
        origin.element_id.push_back(deck.element[size_t(e)]);
        origin.part_of.push_back(deck.part_of[size_t(e)]);
    }
    for (int f = 0; f < choice.soup.polygons(); ++f) {
        const auto corners = choice.soup.polygon(f);
        origin.corner.push_back({corners[0], corners[1], corners[2], corners.size() > 3 ? corners[3] : -1});
    }
    for (const int v : choice.node)
        origin.node_id.push_back(deck.node[size_t(v)]);
    origin.position = choice.soup.position;
    origin.element = choice.element;
    origin.last_node = *std::max_element(deck.node.begin(), deck.node.end());
    origin.last_element = *std::max_element(deck.element.begin(), deck.element.end());
    origin.parts = deck.parts;
    origin.unit_stated = deck.unit.has_value();
    origin.copies = deck.copies;
    for (const DeckSet& set : deck.sets)
        origin.sets.push_back(set.name);
    return origin;
}

/// Fills all of the part that the deck says, in mm.
PolygonSoup soup_of_deck(const fs::path& path, const ReadOptions& options, PartFile& part, const Progress& progress)
{
    const Deck deck = read_deck(path, file_content(path), progress);
    DeckChoice choice = choose_parts(deck, options.parts);
    part.format = deck.format;
    part.unit = options.unit.value_or(deck.unit.value_or(LengthUnit::mm));
    part.notes = deck.notes;
    part.doubts = deck.doubts;
    part.notes.insert(part.notes.end(), choice.notes.begin(), choice.notes.end());
    if (deck.unit && *deck.unit != part.unit)
        part.notes.push_back(fmt::format("the deck gives its lengths in {}; they are read as {}, as requested",
                                         name(*deck.unit), name(part.unit)));
    part.deck = origin_of(deck, choice);
    for (Eigen::Vector3d& p : choice.soup.position)
        p *= millimetres(part.unit);
    if (choice.thickness)
        part.thickness_mm = *choice.thickness * millimetres(part.unit);
    part.material = choice.material;
    if (part.thickness_mm || !part.material.empty())
        part.notes.push_back(
            fmt::format("the deck gives{}{}{}",
                        part.thickness_mm ? fmt::format(" a thickness of {:.6g} mm", *part.thickness_mm) : "",
                        part.thickness_mm && !part.material.empty() ? " and" : "",
                        part.material.empty() ? "" : " the material " + part.material));
    return std::move(choice.soup);
}

PartFile examine_file(const fs::path& path, const ReadOptions& options, const Progress& progress)
{
    const FileKind kind = require_kind_of_file(path);
    PartFile part;
    if (kind == FileKind::deck) {
        const PolygonSoup soup = soup_of_deck(path, options, part, progress.part(0, 0.5));
        const bool weld = part.deck->copies;
        return prepare_part(std::move(part), soup, options, weld, false, nullptr, progress.part(0.5, 1));
    }
    if (kind == FileKind::cad) {
        const CadContent cad = read_cad(path, options.cad, options.parts, options.unit, progress.part(0, 0.8));
        part.format = cad.format;
        part.cad = CadOrigin{cad.face,          cad.faces, cad.deflection, cad.sewing_tolerance,
                             !cad.unit.empty(), cad.tree,  cad.surface};
        part.unit = options.unit.value_or(LengthUnit::mm);
        const CornerNormals normals(cad.soup, cad.normal);
        part = prepare_part(std::move(part), cad.soup, options, true, cad.solid, &normals, progress.part(0.8, 1));
        part.corner_normal = corner_normals(part, cad.soup, normals);
        part.cad->curves = cad.curves;
        part.cad->curves.renumber(part.same_as);
        round_rims(part);
        report_cad(cad, part);
        return part;
    }
    if (!options.parts.empty())
        throw InputError("parts can be chosen from solver decks and CAD files only; this file is read as a whole");
    MeshFile file = read_mesh_file(path, progress.part(0, 0.5));
    part.unit = options.unit.value_or(file.unit.value_or(LengthUnit::mm));
    part.format = std::move(file.format);
    part.notes = std::move(file.notes);
    if (file.unit && !options.unit)
        part.notes.push_back(
            fmt::format("lengths were read in {}, as the specification of the format says", name(*file.unit)));
    for (Eigen::Vector3d& p : file.soup.position)
        p *= millimetres(part.unit);
    return prepare_part(std::move(part), file.soup, options, file.own_corners, false, nullptr, progress.part(0.5, 1));
}

/// Healthy parts alone can be remeshed.
PartFile remeshed(const fs::path& path, const ReadOptions& options, const Progress& progress)
{
    PartFile part = examine_file(path, options, progress.part(0, 0.4));
    if (!part.doctor.healthy())
        return part;
    if (options.remesh)
        part = remesh_part(std::move(part), *options.remesh, progress.part(0.4, 1));
    else if (part.cad && !options.cad.keep_triangles)
        part = remesh_needles(std::move(part), options.cad.deflection, progress.part(0.4, 1));
    else if (!part.cad)
        part = excuse_needles(std::move(part));
    add(part, on_targets(options.targets, part));
    return part;
}

/// What else could be read of the file, line by line; empty if it holds one part.
std::string choice_of(const PartFile& part)
{
    if (part.cad && part.cad->tree.bodies() > 1)
        return fmt::format("\nThe file has several bodies; choose by number or name ({}):\n{}", mention(option::part),
                           item_list(part.cad->tree));
    if (part.deck && part.deck->parts.size() > 1)
        return fmt::format("\nThe deck has several parts; choose by id or name ({}):\n{}", mention(option::part),
                           part_list(part.deck->parts));
    return "";
}

/// Does the work and puts the file's name before whatever is wrong with it.
template <class Work> PartFile named(const fs::path& path, const Work& work)
{
    try {
        return work();
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", path.string(), error.what()));
    }
}

} // namespace

PartFile examine_part(const std::filesystem::path& path, const ReadOptions& options, const Progress& progress)
{
    return named(path, [&] { return remeshed(path, options, progress); });
}

PartFile read_part(const std::filesystem::path& path, const ReadOptions& options, const Progress& progress)
{
    return named(path, [&] {
        PartFile part = remeshed(path, options, progress);
        if (const auto why = refusal(part.doctor))
            throw InputError(*why + (options.parts.empty() ? choice_of(part) : ""));
        return part;
    });
}

} // namespace spia
