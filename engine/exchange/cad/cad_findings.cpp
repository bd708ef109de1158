#include "engine/exchange/cad/cad_findings.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <iterator>
#include <map>
#include <set>
#include <span>
#include <string>

#include "engine/core/place_text.h"
#include "engine/core/text.h"
#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/doctor/doctor.h"
#include "engine/options/part_options.h"

namespace spia {
namespace {

constexpr size_t shown = 20, // of many faces, in words
    most_places = 1000;      // of a finding

template <class Name> std::string listed(const std::vector<Name>& faces)
{
    const std::vector<Name> first(faces.begin(), faces.begin() + long(std::min(shown, faces.size())));
    return fmt::format("{}{}", fmt::join(first, ", "),
                       faces.size() > shown ? fmt::format(" and {} more", faces.size() - shown) : "");
}

int nearest_vertex(const PolygonSoup& soup, const Eigen::Vector3d& place)
{
    const auto nearer = [&](const auto& a, const auto& b) {
        return (a - place).squaredNorm() < (b - place).squaredNorm();
    };
    return int(std::min_element(soup.position.begin(), soup.position.end(), nearer) - soup.position.begin());
}

Eigen::Vector3d middle_of(const PolygonSoup& soup, int triangle)
{
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const int v : soup.polygon(triangle))
        middle += soup.position[size_t(v)] / 3;
    return middle;
}

/// Gaps narrower than a thousandth of the deflection are rounding, not gaps.
void report_gaps(const CadContent& cad, std::vector<Finding>& findings)
{
    const auto narrow = std::find_if(cad.gaps.begin(), cad.gaps.end(),
                                     [&](const CadGap& gap) { return gap.width < 1e-3 * cad.deflection; });
    const auto count = int(narrow - cad.gaps.begin());
    if (count == 0)
        return;
    const CadGap& widest = cad.gaps.front();
    Finding finding{Fault::gap, Severity::repaired, count, 0, "", "", {}, {}};
    for (auto gap = cad.gaps.begin(); gap != narrow && finding.where.size() < most_places; ++gap) {
        finding.where.push_back(nearest_vertex(cad.soup, gap->place));
        finding.place.push_back(gap->place);
        finding.what.push_back(fmt::format("{:.3g} mm, CAD faces {} and {}", gap->width, gap->face[0], gap->face[1]));
    }
    finding.first = finding.where.front();
    finding.text = fmt::format("{} closed, the widest {:.3g} mm at {} between CAD faces {} and {}",
                               counted(count, "gap between CAD faces was", "gaps between CAD faces were"), widest.width,
                               place_text(widest.place), widest.face[0], widest.face[1]);
    findings.push_back(std::move(finding));
}

void report_unmeshed(const CadContent& cad, std::vector<Finding>& findings)
{
    const auto report = [&](int count, std::string text) {
        findings.push_back({Fault::unmeshed_face,
                            cad.unmeshed_left_out ? Severity::repaired : Severity::fatal,
                            count,
                            -1,
                            cad.unmeshed_left_out ? text + "; left out" : text,
                            cad.unmeshed_left_out
                                ? std::string("check the holes they leave")
                                : fmt::format("repair them in the CAD system, choose the other faces ({}), or leave "
                                              "these out and take the rest ({})",
                                              mention(option::part), mention(option::skip_bad_faces)),
                            {},
                            {}});
    };
    if (!cad.unmeshed.empty())
        report(int(cad.unmeshed.size()),
               fmt::format("{} could not be meshed: {}", counted(cad.unmeshed.size(), "CAD face", "CAD faces"),
                           listed(cad.unmeshed)));
    const auto lost = [](const std::vector<std::string>& labels) {
        return fmt::format("{} of the file could not be read: {}",
                           counted(labels.size(), "face or body", "faces and bodies"), listed(labels));
    };
    if (!cad.lost.empty())
        report(int(cad.lost.size()), lost(cad.lost));
    if (!cad.lost_elsewhere.empty())
        findings.push_back({Fault::unmeshed_face,
                            Severity::note,
                            int(cad.lost_elsewhere.size()),
                            -1,
                            lost(cad.lost_elsewhere) + "; what was chosen does not lack them",
                            "",
                            {},
                            {}});
}

void report_aside(const CadContent& cad, std::vector<Finding>& findings)
{
    if (cad.aside.empty())
        return;
    const int count = int(cad.aside.size());
    findings.push_back({Fault::damaged_entity,
                        Severity::note,
                        count,
                        -1,
                        fmt::format("{} of the file {} damaged and {} passed over: {}; no shape needs {}",
                                    counted(count, "entity", "entities"), count == 1 ? "is" : "are",
                                    count == 1 ? "was" : "were", listed(cad.aside), count == 1 ? "it" : "them"),
                        "",
                        {},
                        {}});
}

void report_slivers(const CadContent& cad, std::vector<Finding>& findings)
{
    if (cad.slivers.empty())
        return;
    const CadSliver& widest = cad.slivers.front();
    Finding finding{Fault::gap, Severity::repaired, int(cad.slivers.size()), -1, "", "", {}, {}};
    for (size_t k = 0; k < std::min(most_places, cad.slivers.size()) && cad.soup.vertices() > 0; ++k) {
        finding.where.push_back(nearest_vertex(cad.soup, cad.slivers[k].place));
        finding.place.push_back(cad.slivers[k].place);
        finding.what.push_back(fmt::format("{:.3g} mm, CAD face {}", cad.slivers[k].width, cad.slivers[k].face));
    }
    finding.first = finding.where.empty() ? -1 : finding.where.front();
    finding.text =
        fmt::format("{} closed, the widest {:.3g} mm at {}: CAD face {}",
                    counted(cad.slivers.size(), "sliver among the CAD faces was", "slivers among the CAD faces were"),
                    widest.width, place_text(widest.place), widest.face);
    findings.push_back(std::move(finding));
}

void report_doubles(const CadContent& cad, std::vector<Finding>& findings)
{
    if (cad.doubled.empty())
        return;
    Finding finding{Fault::overlap, Severity::repaired, int(cad.doubled.size()), -1, "", "", {}, {}};
    std::vector<std::string> pairs;
    for (const auto& [face, on] : cad.doubled) {
        pairs.push_back(fmt::format("{} on {}", face, on));
        const auto t = std::find(cad.face.begin(), cad.face.end(), on);
        if (t == cad.face.end() || finding.where.size() == most_places)
            continue;
        finding.where.push_back(int(t - cad.face.begin()));
        finding.place.push_back(middle_of(cad.soup, finding.where.back()));
        finding.what.push_back(fmt::format("CAD face {} on {}", face, on));
    }
    finding.first = finding.where.empty() ? -1 : finding.where.front();
    finding.text =
        fmt::format("{} left out: {}",
                    counted(cad.doubled.size(), "CAD face lies on another and was", "CAD faces lie on others and were"),
                    listed(pairs));
    findings.push_back(std::move(finding));
}

/// "0-17, 19": ascending numbers as the option takes them.
std::string ranges(const std::set<int>& faces)
{
    std::string text;
    for (auto from = faces.begin(); from != faces.end();) {
        auto to = from;
        while (std::next(to) != faces.end() && *std::next(to) == *to + 1)
            ++to;
        text += fmt::format("{}{}{}", text.empty() ? "" : ",", *from, to == from ? "" : fmt::format("-{}", *to));
        from = std::next(to);
    }
    return text;
}

void report_overlaps(const CadContent& cad, std::vector<Finding>& findings)
{
    if (cad.overlapping.empty())
        return;
    Finding finding{Fault::overlap, Severity::note, int(cad.overlapping.size()), -1, "", "", {}, {}};
    for (const int face : cad.overlapping) {
        const auto t = int(std::find(cad.face.begin(), cad.face.end(), face) - cad.face.begin());
        finding.where.push_back(t);
        finding.place.push_back(middle_of(cad.soup, t));
        finding.what.push_back(fmt::format("CAD face {}", face));
        if (finding.where.size() == most_places)
            break;
    }
    finding.first = finding.where.front();
    finding.text = fmt::format("more than two of these CAD faces meet along an edge or lie on one another: {}",
                               listed(cad.overlapping));
    std::set<int> others(cad.face.begin(), cad.face.end());
    for (const int face : cad.overlapping)
        others.erase(face);
    finding.advice = fmt::format("leave out duplicate or branching faces: choose the others ({})",
                                 mention(option::part, ranges(others)));
    findings.push_back(std::move(finding));
}

/// A piece of the mesh.
struct Piece {
    std::set<int> faces; ///< of the CAD file
    int triangles = 0;
    double area = 0;
    bool closed = true; ///< without a boundary: no sheet
    Eigen::AlignedBox3d box;
};

/// The largest by area first.
std::vector<Piece> pieces(const CadContent& cad, const PartFile& part)
{
    DisjointSets joined(size_t(part.mesh.vertices()));
    std::set<std::pair<int, int>> alone; // sides without their opposite
    for (int f = 0; f < part.mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int from = part.mesh.triangle(k, f), to = part.mesh.triangle((k + 1) % 3, f);
            joined.join(part.mesh.triangle(0, f), from);
            if (alone.erase({to, from}) == 0)
                alone.insert({from, to});
        }
    std::map<int, Piece> found;
    for (int f = 0; f < part.mesh.triangles(); ++f) {
        Piece& piece = found[joined.root(part.mesh.triangle(0, f))];
        const Eigen::Vector3d a = part.mesh.position.col(part.mesh.triangle(0, f));
        const Eigen::Vector3d ab = part.mesh.position.col(part.mesh.triangle(1, f)) - a;
        piece.area += ab.cross(part.mesh.position.col(part.mesh.triangle(2, f)) - a).norm();
        piece.faces.insert(cad.face[size_t(part.source_face[size_t(f)])]);
        ++piece.triangles;
        for (int k = 0; k < 3; ++k)
            piece.box.extend(Eigen::Vector3d(part.mesh.position.col(part.mesh.triangle(k, f))));
    }
    for (const auto& [from, to] : alone)
        found[joined.root(from)].closed = false;
    std::vector<Piece> result;
    for (auto& [root, piece] : found)
        result.push_back(std::move(piece));
    std::stable_sort(result.begin(), result.end(), [](const Piece& a, const Piece& b) { return a.area > b.area; });
    return result;
}

std::string describe(const Piece& piece)
{
    const Eigen::Vector3d size = piece.box.sizes();
    return fmt::format("{} ({}{}, {:.4g} x {:.4g} x {:.4g} mm)", ranges(piece.faces),
                       counted(piece.triangles, "triangle", "triangles"), piece.closed ? ", closed" : "", size[0],
                       size[1], size[2]);
}

/// Bodies of the file that some of the faces taken are of.
std::vector<int> bodies_taken(const CadContent& cad)
{
    std::set<int> bodies;
    for (const int face : cad.face)
        bodies.insert(cad.tree.body_of[size_t(face)]);
    return {bodies.begin(), bodies.end()};
}

/// Several solids are several parts; of a single one a skin was taken (take_skin()), or said why
/// not.
void report_bodies(const CadContent& cad, const PartFile& part, std::vector<Finding>& findings)
{
    if (!cad.solid || part.doctor.components < 2)
        return;
    std::vector<std::string> choices; // as they are given to --part
    if (const std::vector<int> taken = bodies_taken(cad); taken.size() > 1)
        for (const int body : taken)
            choices.push_back(choice(cad.tree.item[size_t(body)]));
    else
        for (const Piece& piece : pieces(cad, part))
            choices.push_back(ranges(piece.faces));
    if (choices.size() < 2) // its triangles are in pieces, of which no name is known
        return;
    const std::span<const std::string> named = std::span(choices).first(std::min(shown, choices.size()));
    findings.push_back({Fault::several_components,
                        Severity::fatal,
                        int(choices.size()),
                        -1,
                        fmt::format("it holds {} bodies that are not connected: {}{}", choices.size(),
                                    fmt::join(named, "; "), choices.size() > shown ? " and more" : ""),
                        fmt::format("choose one of them ({})", mention(option::part, choices.front())),
                        {},
                        {}});
}

/// Pieces of a sheet are told by their CAD faces, which can be chosen; the doctor knows triangles
/// only.
void name_pieces(const CadContent& cad, PartFile& part)
{
    constexpr size_t most = 5; // pieces, in words
    for (Finding& finding : part.doctor.findings) {
        if (finding.fault != Fault::several_components || cad.solid)
            continue;
        const std::vector<Piece> all = pieces(cad, part);
        if (finding.severity == Severity::fatal) {
            std::vector<std::string> choices;
            for (const Piece& piece : std::span(all).first(std::min(most, all.size())))
                choices.push_back(describe(piece));
            // A closed one is no sheet, often a box around the model: nobody wants to keep it.
            finding.advice =
                fmt::format("{} the CAD faces of one piece ({}): {}{}",
                            !all.empty() && all.front().closed
                                ? "choose"
                                : fmt::format("keep the largest ({}), or choose", mention(option::keep_largest)),
                            mention(option::part), fmt::join(choices, " or "), all.size() > most ? ", ..." : "");
            continue;
        }
        std::set<int> left_out(cad.face.begin(), cad.face.end());
        for (const Piece& piece : all)
            for (const int face : piece.faces)
                left_out.erase(face);
        if (!left_out.empty())
            finding.text += fmt::format("; that leaves out CAD faces {}", ranges(left_out));
    }
}

/// As IGES files call it, and STEP files.
bool is_mm(const std::string& unit)
{
    const std::string small = lower_case(unit);
    return small == "mm" || small == "millimetre" || small == "millimeter";
}

} // namespace

void report_cad(const CadContent& cad, PartFile& part)
{
    part.notes.push_back(fmt::format("{} CAD faces{}{}; triangles within {:.3g} mm of them", cad.faces,
                                     cad.taken < cad.faces ? fmt::format(", {} of them taken", cad.taken) : "",
                                     cad.unit.empty()  ? ""
                                     : is_mm(cad.unit) ? ", lengths in mm"
                                                       : fmt::format(", lengths converted from {} to mm", cad.unit),
                                     cad.deflection));
    part.notes.push_back(cad.sewing_tolerance > 0
                             ? fmt::format("sewn with a tolerance of {:.3g} mm: free edges reduced from {} to {}",
                                           cad.sewing_tolerance, cad.free_before, cad.free_after)
                         : cad.free_after > 0 ? "not sewn: " + counted(cad.free_after, "free edge", "free edges")
                                              : "not sewn, as no edge is free");
    if (cad.sewing_tolerance > 0 && cad.sewing_tolerance >= cad.half_an_edge)
        part.notes.push_back(
            fmt::format("the sewing tolerance is half the length of edges or more, the shortest {:.3g} mm: small faces "
                        "may have closed up{}",
                        cad.shortest_edge, cad.sewing_tolerance > cad.half_an_edge ? "" : ", and wider gaps are open"));
    name_pieces(cad, part);
    std::vector<Finding> findings;
    report_bodies(cad, part, findings);
    report_unmeshed(cad, findings);
    report_aside(cad, findings);
    report_doubles(cad, findings);
    report_overlaps(cad, findings);
    report_gaps(cad, findings);
    report_slivers(cad, findings);
    part.doctor.findings.insert(part.doctor.findings.begin(), findings.begin(), findings.end());
}

} // namespace spia
