#include "engine/part/mark_findings.h"

#include <algorithm>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/place_text.h"
#include "engine/core/text.h"

namespace spia {
namespace {

/// Something on a skin of the sheet.
struct MarkedPlace {
    int face; ///< of the file
    Eigen::Vector3d place;
    std::string what;
};

/// @param text  to be followed by the place of the first
Finding note_on(const std::vector<MarkedPlace>& marked, const std::string& text)
{
    Tally where;
    for (const MarkedPlace& each : marked)
        where.add(each.face);
    const Eigen::Vector3d& first = marked.front().place;
    Finding finding{
        Fault::mark, Severity::note, where.count, where.first, fmt::format("{} at {} mm", text, place_text(first)),
        "",          where.where,    {}};
    for (size_t i = 0; i < finding.where.size(); ++i) {
        finding.place.push_back(marked[i].place);
        finding.what.push_back(marked[i].what);
    }
    return finding;
}

/// "countersink 12 mm wide, 3 mm deep"
std::string recess(const SunkHole& hole)
{
    const char* const kind = hole.depth < 0 ? "boss" : hole.counterbore ? "counterbore" : "countersink";
    if (!(hole.diameter > 0))
        return kind;
    if (hole.depth < 0)
        return fmt::format("{} {:.4g} mm wide, {:.4g} mm high", kind, hole.diameter, -hole.depth);
    return fmt::format("{} {:.4g} mm wide, {:.4g} mm deep{}", kind, hole.diameter, hole.depth,
                       hole.stepped ? " in all, in steps" : "");
}

/// "countersink 12 mm wide, 3 mm deep, of a hole of 6 mm, on the inner skin". @param sunk at one
/// skin or both of one hole
std::string words(const std::vector<const SunkHole*>& sunk)
{
    const SunkHole &first = *sunk.front(), &last = *sunk.back();
    const bool both = sunk.size() > 1, alike = both && recess(first) == recess(last);
    std::string text = fmt::format("{}, of a hole{}, on {}", recess(first),
                                   first.least > 0 ? fmt::format(" of {:.4g} mm", first.least) : " that is not round",
                                   alike ? "both skins" : fmt::format("the {} skin", of_skin(first.skin)));
    if (both && !alike)
        text += fmt::format(", and {} on the {} skin", recess(last), of_skin(last.skin));
    if (first.cut_off || last.cut_off)
        text += "; a bend, a border or another hole cuts it off";
    return text;
}

/// What is sunk of each hole, at one skin or both.
std::vector<std::vector<const SunkHole*>> by_hole(const std::vector<SunkHole>& holes)
{
    std::vector<std::vector<const SunkHole*>> result;
    for (const SunkHole& hole : holes) {
        if (result.empty() || result.back().front()->hole != hole.hole)
            result.emplace_back();
        result.back().push_back(&hole);
    }
    return result;
}

/// "the least diameter of each"
std::string laid_flat(const std::vector<SunkHole>& holes, int count, Skin taken, SheetSide side, double thickness)
{
    if (taken != Skin::middle)
        return fmt::format("the diameters at the {} skin", name(taken));
    const int wider = int(wider_in_middle(holes, side, thickness).size()), bent = int(sunk_in_bends(holes).size()),
              crossed = wider - bent;
    if (wider == 0)
        return "the least diameter of each";
    std::vector<std::pair<int, std::string>> kinds;
    if (count > wider)
        kinds.emplace_back(count - wider, "the least diameter");
    if (crossed > 0)
        kinds.emplace_back(crossed, crossed == 1 ? "the edge where the wall crosses the middle of the sheet"
                                                 : "the edges where the walls cross the middle of the sheet");
    if (bent > 0)
        kinds.emplace_back(bent, fmt::format("the {} at the {} skin", bent == 1 ? "edge" : "edges", of_skin(side)));
    if (kinds.size() == 1)
        return kinds.front().second;
    std::vector<std::string> texts;
    for (const auto& [number, what] : kinds)
        texts.push_back(fmt::format("of {} {}", number, what));
    return fmt::format("{}", fmt::join(texts, ", "));
}

/// "up to 0.2 mm deep and up to 0.1 mm high"
std::string depths(const std::vector<SheetMark>& marks)
{
    double engraved = 0, raised = 0;
    for (const SheetMark& mark : marks)
        (mark.raised ? raised : engraved) = std::max(mark.raised ? raised : engraved, mark.depth);
    std::vector<std::string> kinds;
    if (engraved > 0)
        kinds.push_back(fmt::format("up to {:.4g} mm deep", engraved));
    if (raised > 0)
        kinds.push_back(fmt::format("up to {:.4g} mm high", raised));
    return fmt::format("{}", fmt::join(kinds, " and "));
}

} // namespace

const char* of_skin(SheetSide side) { return side == SheetSide::inner ? "inner" : "outer"; }

Finding finding_of(const std::vector<SheetMark>& marks, const ThinSolid& sheet, const std::vector<int>& source_face)
{
    std::vector<MarkedPlace> marked;
    for (const SheetMark& mark : marks)
        marked.push_back({source_face[size_t(mark.face)], mark.place,
                          fmt::format("{:.4g} mm {} on the {} skin", mark.depth, mark.raised ? "high" : "deep",
                                      of_skin(sheet.side[size_t(mark.face)]))});
    return note_on(marked,
                   fmt::format("{} of the sheet, {}, {} ignored: the skin is laid flat without {} (as are marks of up "
                               "to {:.2g} of the thickness, {:.4g} mm); the first is",
                               counted(marks.size(), "mark or step on a skin", "marks or steps on the skins"),
                               depths(marks), marks.size() == 1 ? "is" : "are", marks.size() == 1 ? "it" : "them",
                               deepest_mark, deepest_mark * sheet.thickness));
}

Finding finding_of(const std::vector<SunkHole>& holes, Skin taken, SheetSide side, double thickness,
                   const std::vector<int>& source_face)
{
    std::vector<MarkedPlace> marked;
    for (const auto& sunk : by_hole(holes))
        marked.push_back({source_face[size_t(sunk.front()->face)], sunk.front()->centre, words(sunk)});
    const bool drawn = taken == Skin::middle || wider_at(holes, side) < int(holes.size());
    return note_on(marked,
                   fmt::format("{} at a skin than inside (a countersink, a counterbore or a chamfer): what is laid "
                               "flat has {}{}; the first is a {}",
                               counted(marked.size(), "hole is wider", "holes are wider"),
                               laid_flat(holes, int(marked.size()), taken, side, thickness),
                               drawn ? ", and circles among the marks show where to countersink or counterbore" : "",
                               marked.front().what));
}

} // namespace spia
