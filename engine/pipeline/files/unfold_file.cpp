#include "engine/pipeline/files/unfold_file.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "engine/mesh/box_tree.h"
#include "engine/mesh/closest_point.h"
#include "engine/pipeline/files/file_members.h"
#include "engine/unfold/plan/pick_border.h"
#include "engine/unfold/target/given_face.h"

namespace spia {
namespace {

using namespace members;
constexpr double most_mm = 1e9, degrees = 180 / std::numbers::pi;
constexpr std::string_view schema = "spia.unfold/1";

/// The labels that the names of a script mean on this part; -1: what it had there is not there any
/// more.
class NamedRegions {
public:
    NamedRegions(const Json& json, const Place& place, const PartFile& part, const BendMap& map,
                 std::vector<std::string>& findings)
        : part_(part.mesh), map_(map), tree_(part.mesh)
    {
        for (int label = 0; label <= map.label.maxCoeff(); ++label)
            own_[map.name(label)] = label;
        std::map<int, std::string> taken;
        each_of(json, place, "regions", [&](const Json& each, const Place& at, const std::string&) {
            require_object(each, at, {"name", "at", "area_mm2", "kind"});
            const std::string name = text(*find(each, at, "name", true), at.member("name"));
            if (name.empty() || named_.count(name))
                at.member("name").fail(name.empty() ? "must not be empty" : "names a region for the second time");
            const std::string kind = text_in(each, at, "kind", "region");
            if (kind != "region" && kind != "bend")
                at.member("kind").fail("must be \"region\" or \"bend\"");
            const Eigen::Vector3d where = vector(*find(each, at, "at", true), at.member("at"));
            const std::optional<double> area = number_in(each, at, "area_mm2", 0, 1e18);
            const std::string why = look(name, where, kind, area);
            if (!why.empty()) {
                named_[name] = -1;
                findings.push_back(fmt::format("{}: {}", name, why));
            } else if (const auto [entry, is_new] = taken.try_emplace(named_[name], name); !is_new) {
                findings.push_back(fmt::format("{}: is now the same {} as {}", name, kind, entry->second));
                named_[name] = -1;
            }
        });
        if (!named_.empty() && !findings.empty()) // of a script for this part only some regions may
                                                  // be named
            for (const auto& [name, label] : own_)
                if (!taken.count(label) && label < int(map.regions.size()))
                    findings.push_back(fmt::format("the part has a region at {:.4g}, {:.4g}, {:.4g} mm that the script "
                                                   "does not name ({:.4g} mm2)",
                                                   map.regions[size_t(label)].place[0],
                                                   map.regions[size_t(label)].place[1],
                                                   map.regions[size_t(label)].place[2], map.area_of(label)));
    }

    /// A name of the script's own list, else one of this part.
    int label(const Json& json, const Place& place) const
    {
        const std::string name = text(json, place);
        if (const auto found = named_.find(name); found != named_.end())
            return found->second;
        const auto found = own_.find(name);
        if (found == own_.end())
            place.fail(fmt::format("is \"{}\": neither the list \"regions\" nor the part has such a region", name));
        return found->second;
    }

private:
    /// Of what is near the place and about as large, what is likest. @returns why there is none
    std::string look(const std::string& name, const Eigen::Vector3d& where, const std::string& kind,
                     std::optional<double> area)
    {
        constexpr double near = 0.05, alike = 2; // of the part's side; ratio of areas
        const auto is_kind = [&](int label) { return (label < int(map_.regions.size())) == (kind == "region"); };
        const auto unlike = [&](int label) { // ratio of areas, 1 or more
            const double now = map_.area_of(label), then = area && *area > 0 ? *area : now;
            return std::max(now / then, then / now);
        };
        std::vector<double> distance(size_t(map_.label.maxCoeff() + 1), most_mm);
        int closest = 0;
        for (const int f : faces_around(where, near * map_.side)) {
            const Eigen::Matrix3d x = part_.position(Eigen::all, part_.triangle.col(f));
            double& least = distance[size_t(map_.label[f])];
            least = std::min(least, (x * closest_on_triangle(x, where) - where).norm());
            if (least < distance[size_t(closest)])
                closest = map_.label[f];
        }
        int best = -1;
        double least = most_mm;
        for (int label = 0; label < int(distance.size()); ++label) {
            const double score = distance[size_t(label)] + near * map_.side * std::log(unlike(label));
            if (is_kind(label) && distance[size_t(label)] <= near * map_.side && unlike(label) <= alike &&
                score < least) {
                best = label;
                least = score;
            }
        }
        if (best >= 0) {
            named_[name] = best;
            return {};
        }
        if (distance[size_t(closest)] > near * map_.side)
            return fmt::format("the part has nothing at its place, the nearest is {:.3g} mm away",
                               ClosestPointSearch(part_).nearest(where).distance);
        if (!is_kind(closest))
            return fmt::format("at its place there is a {} now", kind == "bend" ? "region" : "bend");
        return fmt::format("it had {:.4g} mm2, at its place there are {:.4g} mm2 now", *area, map_.area_of(closest));
    }

    /// Those whose boxes are within a distance, ascending.
    FaceSet faces_around(const Eigen::Vector3d& where, double mm) const
    {
        constexpr double rounding = 1e-9;
        const double reach = mm * (1 + rounding) + rounding * where.cwiseAbs().maxCoeff();
        FaceSet faces;
        std::vector<int> open = {0};
        while (!open.empty()) {
            const int k = open.back();
            open.pop_back();
            const BoxTree::Node& node = tree_.node[size_t(k)];
            if (node.box.squaredExteriorDistance(where) > reach * reach)
                continue;
            for (int i = node.first; i < node.first + node.count; ++i)
                faces.push_back(tree_.face[size_t(i)]);
            if (node.count == 0) {
                open.push_back(node.second);
                open.push_back(k + 1);
            }
        }
        std::sort(faces.begin(), faces.end());
        return faces;
    }

    const TriMesh& part_;
    const BendMap& map_;
    BoxTree tree_;
    std::map<std::string, int> named_, own_;
};

/// Faces by "regions", "faces" and "box", united. What is not there any more picks nothing.
struct Pick {
    FaceSet faces;
    std::vector<int> labels;
    std::vector<std::string> missing;
};

Pick pick_in(const Json& json, const Place& place, const PartFile& part, const BendMap& map,
             const NamedRegions& regions)
{
    require_object(json, place, {"regions", "faces", "box"});
    const Json *names = find(json, place, "regions", false), *faces = find(json, place, "faces", false),
               *box = find(json, place, "box", false);
    if (!names && !faces && !box)
        place.fail("needs the member \"regions\", \"faces\" or \"box\"");
    Pick pick;
    std::vector<char> chosen(size_t(part.mesh.triangles()), 0);
    if (faces)
        choose_faces(*faces, place.member("faces"), part, chosen);
    if (box)
        choose_box(*box, place.member("box"), part, chosen);
    if (names) {
        const Place at = place.member("regions");
        if (!names->is_array())
            at.fail("must be a list of names");
        for (size_t i = 0; i < names->size(); ++i) {
            const int label = regions.label((*names)[i], at.entry(i));
            if (label < 0)
                pick.missing.push_back((*names)[i].get<std::string>());
            else
                pick.labels.push_back(label);
        }
        std::vector<char> named(size_t(map.label.maxCoeff() + 1), 0);
        for (const int label : pick.labels)
            named[size_t(label)] = 1;
        for (int f = 0; f < part.mesh.triangles(); ++f)
            chosen[size_t(f)] |= named[size_t(map.label[f])];
    }
    pick.faces = chosen_faces(chosen);
    if (pick.faces.empty() && pick.missing.empty())
        place.fail("picks no face of the part");
    return pick;
}

Eigen::Vector3d direction(const Json& json, const Place& place)
{
    const Eigen::Vector3d v = vector(json, place);
    if (!(v.norm() > 0))
        place.fail("must not be zero");
    return v.normalized();
}

/// {"plane": {...}}, {"cylinder": {...}} or {"cone": {...}}. @param towards a place on the side
/// where the face is to be
TargetSurface face_in(const Json& json, const Place& place, const Eigen::Vector3d& towards)
{
    require_object(json, place, {"plane", "cylinder", "cone"});
    if (json.size() != 1)
        place.fail("needs one of the members \"plane\", \"cylinder\" and \"cone\"");
    const auto vector_of = [](const Json& object, const Place& at, std::string_view name) {
        return vector(*find(object, at, name, true), at.member(name));
    };
    const auto direction_of = [](const Json& object, const Place& at, std::string_view name) {
        return direction(*find(object, at, name, true), at.member(name));
    };
    const std::string kind = json.begin().key();
    const Json& object = json.begin().value();
    const Place at = place.member(kind);
    if (kind == "plane") {
        require_object(object, at, {"origin", "normal"});
        return given_plane(vector_of(object, at, "origin"), direction_of(object, at, "normal"));
    }
    if (kind == "cylinder") {
        require_object(object, at, {"origin", "axis", "radius"});
        return given_cylinder(vector_of(object, at, "origin"), direction_of(object, at, "axis"),
                              *number_in(object, at, "radius", 1e-9, most_mm, true), towards);
    }
    require_object(object, at, {"apex", "axis", "half_angle_deg"});
    return given_cone(vector_of(object, at, "apex"), direction_of(object, at, "axis"),
                      *number_in(object, at, "half_angle_deg", 1e-3, 89.999, true) / degrees, towards);
}

void read_target(const Json& json, const Place& place, const PartFile& part, PlannedStep& step)
{
    if (json.is_string()) {
        if (text(json, place) != "fitted")
            place.fail("must be \"fitted\" or an object { }");
        return;
    }
    require_object(json, place, {"plane", "cylinder", "cone", "within_mm", "offset_mm", "extent_mm"});
    step.within_mm = number_in(json, place, "within_mm", 0, most_mm).value_or(0);
    step.offset_mm = number_in(json, place, "offset_mm", -most_mm, most_mm).value_or(0);
    step.extent_mm = number_in(json, place, "extent_mm", 1e-9, most_mm);
    Json face = json;
    for (const char* other : {"within_mm", "offset_mm", "extent_mm"})
        face.erase(other);
    if (face.empty())
        return;
    step.pick.target = face_in(face, place, middle_of_pick(part.mesh, step.pick));
}

void read_options(const Json& json, const Place& place, PlannedStep& step)
{
    require_object(json, place, {"tolerance", "most_energy_steps", "most_newton_steps"});
    const auto whole = [&](std::string_view name) -> std::optional<int> {
        const std::optional<double> value = number_in(json, place, name, 1, 100000);
        if (value && *value != std::floor(*value))
            place.member(name).fail("must be a whole number");
        return value ? std::optional(int(*value)) : std::nullopt;
    };
    step.tolerance = number_in(json, place, "tolerance", least_step_tolerance, most_step_tolerance);
    step.most_energy_steps = whole("most_energy_steps");
    step.most_newton_steps = whole("most_newton_steps");
}

/// What rubs, on all that is freed or on what its own picks name. @returns the names of these that
/// are not there
std::vector<std::string> read_friction(const Json& json, const Place& place, const PartFile& part, const BendMap& map,
                                       const NamedRegions& regions, PlannedStep& step)
{
    require_object(json, place, {"coefficient", "pressure_MPa", "force_N", "sides", "regions", "faces", "box"});
    ContactRegion rubs;
    rubs.name = "the target";
    rubs.friction = *number_in(json, place, "coefficient", 0, 10, true);
    rubs.pressure_MPa = number_in(json, place, "pressure_MPa", 1e-9, 1e5);
    rubs.force_N = number_in(json, place, "force_N", 1e-9, 1e9);
    if (rubs.force_N.has_value() == rubs.pressure_MPa.has_value())
        place.fail("needs either the member \"pressure_MPa\" or \"force_N\"");
    const double sides = number_in(json, place, "sides", 1, 2).value_or(2);
    if (sides != 1 && sides != 2)
        place.member("sides").fail("must be 1 or 2");
    rubs.sides = int(sides);
    Json picks = Json::object();
    for (const char* member : {"regions", "faces", "box"})
        if (const Json* pick = find(json, place, member, false))
            picks[member] = *pick;
    Pick picked;
    if (!picks.empty()) {
        picked = pick_in(picks, place, part, map, regions);
        for (const int f : picked.faces)
            if (!std::binary_search(step.pick.freed.begin(), step.pick.freed.end(), f))
                place.fail(fmt::format("picks face {}, which is not freed", part.source_face[size_t(f)]));
        if (picked.faces.empty()) // on nothing that is there; no faces would mean all of them
            return picked.missing;
    }
    rubs.faces = picked.faces;
    step.pick.friction = std::move(rubs);
    return picked.missing;
}

/// What a pick names, as it names it: "region 4, lip" or "3 faces".
std::string describe(const Json& pick)
{
    std::vector<std::string> words;
    if (pick.contains("regions"))
        words = pick["regions"].get<std::vector<std::string>>();
    constexpr size_t most = 6;
    if (words.size() > most)
        words = {words[0], words[1], words[2], fmt::format("{} more", words.size() - 3)};
    if (pick.contains("faces"))
        words.push_back(pick["faces"].size() == 1 ? fmt::format("face {}", pick["faces"][0].get<double>())
                                                  : fmt::format("{} faces", pick["faces"].size()));
    if (pick.contains("box"))
        words.emplace_back("what is in a box");
    return fmt::format("{}", fmt::join(words, ", "));
}

/// What a step without a name is called: what it does. @param json with the members of its kind
std::string describe_step(const Json& json, UnfoldKind kind)
{
    switch (kind) {
    case UnfoldKind::flatten: return "flatten the whole part";
    case UnfoldKind::unroll: return "unroll from " + describe(json["carrying"]);
    case UnfoldKind::lay: break;
    }
    return fmt::format("{} onto {}", describe(json["freed"]),
                       describe(json.contains("carrying") ? json["carrying"] : json["fixed"]));
}

UnfoldKind kind_in(const Json& json, const Place& place)
{
    const std::string wanted = text_in(json, place, "kind", "lay");
    for (const UnfoldKind kind : {UnfoldKind::lay, UnfoldKind::unroll, UnfoldKind::flatten})
        if (wanted == name(kind))
            return kind;
    place.member("kind").fail("must be \"lay\", \"unroll\" or \"flatten\"");
}

/// A step of the script on this part. @returns why it makes no sense there, or nothing
std::string read_step(const Json& json, const Place& place, const PartFile& part, const BendMap& map,
                      const NamedRegions& regions, PlannedStep& step, std::vector<std::string>& left_out)
{
    require_object(json, place, {"name", "kind", "freed", "fixed", "carrying", "target", "friction", "options"});
    step.kind = kind_in(json, place);
    const auto read = [&](std::string_view name, bool required) -> std::optional<Pick> {
        const Json* pick = find(json, place, name, required);
        if (!pick)
            return std::nullopt;
        Pick picked = pick_in(*pick, place.member(name), part, map, regions);
        for (const std::string& missing : picked.missing)
            left_out.push_back(fmt::format("{} without {}", name, missing));
        return picked;
    };
    const bool lays = step.kind == UnfoldKind::lay;
    if (!lays)
        for (const std::string_view member : {"freed", "fixed", "friction"})
            if (find(json, place, member, false))
                place.member(member).fail(fmt::format("has no meaning: {} moves the whole part", name(step.kind)));
    const auto freed = read("freed", lays), fixed = read("fixed", lays),
               carrying = read("carrying", step.kind == UnfoldKind::unroll);
    if (step.kind == UnfoldKind::flatten && carrying)
        place.member("carrying").fail("has no meaning: nothing stays when the whole part is flattened");
    step.name = text_in(json, place, "name", {});
    if (step.name.empty())
        step.name = describe_step(json, step.kind);
    if (lays) {
        step.pick.freed = freed->faces;
        step.pick.fixed = fixed->faces;
        step.freed = freed->labels;
        step.fixed = fixed->labels;
        if (step.fixed.size() == 1)
            step.carrier = step.fixed[0];
        for (const int f : step.pick.freed)
            if (std::binary_search(step.pick.fixed.begin(), step.pick.fixed.end(), f))
                place.fail(fmt::format("picks face {} both to stay and to move", part.source_face[size_t(f)]));
    } else {
        step.pick.freed.resize(size_t(part.mesh.triangles()));
        std::iota(step.pick.freed.begin(), step.pick.freed.end(), 0);
    }
    step.pick.carrying = carrying ? carrying->faces : step.pick.fixed;
    if (const Json* target = find(json, place, "target", false))
        read_target(*target, place.member("target"), part, step);
    if (const Json* friction = find(json, place, "friction", false))
        for (const std::string& missing : read_friction(*friction, place.member("friction"), part, map, regions, step))
            left_out.push_back("friction without " + missing);
    if (const Json* options = find(json, place, "options", false)) {
        if (step.kind == UnfoldKind::unroll)
            place.member("options").fail("has no meaning: nothing is solved when a face is unrolled");
        read_options(*options, place.member("options"), step);
    }
    if (step.pick.freed.empty())
        return "nothing of what it moves is there";
    if (step.pick.carrying.empty() && step.kind != UnfoldKind::flatten)
        return "nothing of what it lays on is there";
    if (lays) {
        for (const int f : step.pick.carrying)
            if (!std::binary_search(step.pick.fixed.begin(), step.pick.fixed.end(), f))
                place.member("carrying")
                    .fail(fmt::format("picks face {}, which is not fixed", part.source_face[size_t(f)]));
        const PickBorder border = pick_border(part.mesh, step.pick.fixed, step.pick.freed);
        if (!border.torn.empty())
            return fmt::format("it would tear off face {} ({}), which it neither moves nor holds",
                               part.source_face[size_t(border.torn[0])], map.name(map.label[border.torn[0]]));
        step.pick.fixed = united(step.pick.fixed, border.held);
    }
    return {};
}

} // namespace

ReadScript read_unfold_script(const std::filesystem::path& file, const PartFile& part, const BendMap& map)
{
    const Json json = read_json(file, true);
    const std::string file_name = file.string();
    const Place top(file_name);
    require_object(json, top, {"schema", "regions", "steps"});
    if (text_in(json, top, "schema", std::string(schema)) != schema)
        top.member("schema").fail(fmt::format("must be \"{}\"", schema));
    ReadScript script;
    const NamedRegions regions(json, top, part, map, script.findings);
    find(json, top, "steps", true);
    each_of(json, top, "steps", [&](const Json& each, const Place& place, const std::string&) {
        PlannedStep step;
        std::vector<std::string> left_out;
        const std::string why = read_step(each, place, part, map, regions, step, left_out);
        if (!why.empty())
            script.findings.push_back(fmt::format("step \"{}\" is left out: {}", step.name, why));
        else {
            if (!left_out.empty())
                script.findings.push_back(fmt::format("step \"{}\": {}", step.name, fmt::join(left_out, ", ")));
            script.steps.push_back(std::move(step));
        }
    });
    if (script.steps.empty() && script.findings.empty())
        top.member("steps").fail("has no step; there is nothing to unfold");
    return script;
}

} // namespace spia
