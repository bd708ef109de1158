#include "engine/pipeline/unfold_states.h"

#include <bit>
#include <boost/crc.hpp>
#include <cmath>
#include <cstring>
#include <fmt/core.h>

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/core/file_content.h"
#include "engine/core/json_file.h"
#include "engine/exchange/provenance.h"
#include "engine/forming/material/material_text.h"
#include "engine/forming/solver/sheet_fields.h"

namespace spia {
namespace {

constexpr std::string_view states_schema = "spia.unfold-states/2";

template <class Derived> Json numbers(const Eigen::PlainObjectBase<Derived>& values)
{
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(values.data());
    return Json::binary(
        std::vector<std::uint8_t>(bytes, bytes + size_t(values.size()) * sizeof(typename Derived::Scalar)));
}

Json numbers(const std::vector<int>& values)
{
    return numbers(Eigen::VectorXi(Eigen::Map<const Eigen::VectorXi>(values.data(), Eigen::Index(values.size()))));
}

/// What is not as write_unfold_states() writes it.
[[noreturn]] void damaged(std::string_view what)
{
    throw InputError(fmt::format("{} is missing or damaged; run all steps again", what));
}

const Json& member(const Json& object, const char* name)
{
    if (!object.is_object() || !object.contains(name))
        damaged(name);
    return object[name];
}

template <class Derived>
void take(const Json& object, const char* name, Eigen::Index rows, Eigen::Index columns,
          Eigen::PlainObjectBase<Derived>& values)
{
    const Json& array = member(object, name);
    const size_t size = size_t(rows * columns) * sizeof(typename Derived::Scalar);
    if (!array.is_binary() || array.get_binary().size() != size)
        damaged(name);
    values.resize(rows, columns);
    std::memcpy(values.data(), array.get_binary().data(), size);
    if constexpr (std::is_floating_point_v<typename Derived::Scalar>)
        if (!values.array().isFinite().all())
            damaged(name);
}

double number(const Json& object, const char* name)
{
    const Json& value = member(object, name);
    if (!value.is_number() || !std::isfinite(value.get<double>()))
        damaged(name);
    return value.get<double>();
}

int count(const Json& object, const char* name)
{
    const double value = number(object, name);
    if (!(value >= 0 && value <= 1e9))
        damaged(name);
    return int(value);
}

std::string text(const Json& object, const char* name)
{
    const Json& value = member(object, name);
    if (!value.is_string())
        damaged(name);
    return value.get<std::string>();
}

Json face_json(const TargetSurface& face)
{
    if (const auto* plane = std::get_if<PlaneFace>(&face))
        return {{"kind", "plane"}, {"origin", numbers(plane->origin)}, {"axes", numbers(plane->axes)}};
    if (const auto* c = std::get_if<CylinderFace>(&face))
        return {{"kind", "cylinder"},       {"origin", numbers(c->origin)},
                {"axis", numbers(c->axis)}, {"towards", numbers(c->towards)},
                {"radius", c->radius},      {"bulges", c->bulges}};
    if (const auto* c = std::get_if<ConeFace>(&face))
        return {{"kind", "cone"},           {"origin", numbers(c->apex)},
                {"axis", numbers(c->axis)}, {"towards", numbers(c->towards)},
                {"radius", c->half_angle},  {"bulges", c->bulges}};
    const auto& height = std::get<HeightFace>(face);
    return {{"kind", "smooth"},
            {"origin", numbers(height.origin)},
            {"axes", numbers(height.axes)},
            {"corner", numbers(height.corner)},
            {"spacing", height.spacing},
            {"rows", height.coefficient.rows()},
            {"columns", height.coefficient.cols()},
            {"coefficient", numbers(height.coefficient)}};
}

template <class Round> TargetSurface round_face(const Json& json)
{
    Round face{};
    Eigen::Vector3d origin;
    take(json, "origin", 3, 1, origin);
    take(json, "axis", 3, 1, face.axis);
    take(json, "towards", 3, 1, face.towards);
    const double size = number(json, "radius");
    if (!(size > 0) || !member(json, "bulges").is_boolean())
        damaged("radius");
    face.bulges = json["bulges"].get<bool>();
    if constexpr (std::is_same_v<Round, ConeFace>)
        face.apex = origin, face.half_angle = size;
    else
        face.origin = origin, face.radius = size;
    return face;
}

TargetSurface face_of(const Json& json)
{
    const std::string kind = text(json, "kind");
    if (kind == "cylinder")
        return round_face<CylinderFace>(json);
    if (kind == "cone")
        return round_face<ConeFace>(json);
    Eigen::Vector3d origin;
    Eigen::Matrix<double, 3, 2> axes;
    take(json, "origin", 3, 1, origin);
    take(json, "axes", 3, 2, axes);
    if (kind == "plane")
        return PlaneFace{origin, axes};
    HeightFace height{origin, axes, {}, number(json, "spacing"), {}};
    take(json, "corner", 2, 1, height.corner);
    const double rows = number(json, "rows"), columns = number(json, "columns");
    constexpr double least = 4, most = 1e5; // of a bicubic spline
    if (kind != "smooth" || !(height.spacing > 0) || !(rows >= least && rows <= most) ||
        !(columns >= least && columns <= most))
        damaged("kind");
    take(json, "coefficient", Eigen::Index(rows), Eigen::Index(columns), height.coefficient);
    return height;
}

Json part_json(const TriMesh& part)
{
    return {{"position", numbers(part.position)}, {"triangle", numbers(part.triangle)}};
}

Json sheet_json(const FlattenOptions& options)
{
    const StressCurve::Options& curve = options.curve;
    Json pieces = Json::array();
    for (const TailoredPiece& piece : options.process.tailored)
        pieces.push_back({{"faces", numbers(piece.faces)},
                          {"material", material_text(piece.material)},
                          {"thickness", piece.thickness}});
    return {{"material", material_text(options.material)},
            {"thickness", options.thickness},
            {"curve", {curve.trusted_strain, curve.continuation_rate, curve.continuation_width, curve.yield_smoothing}},
            {"tailored", pieces},
            {"rolling", options.process.rolling ? numbers(*options.process.rolling) : Json()},
            {"tolerance", options.tolerance},
            {"steps", {options.most_energy_steps, options.most_newton_steps}}};
}

Json friction_json(const ContactRegion& friction)
{
    const auto or_none = [](const std::optional<double>& value) { return value ? Json(*value) : Json(); };
    return {{"faces", numbers(friction.faces)},
            {"pressure_MPa", or_none(friction.pressure_MPa)},
            {"force_N", or_none(friction.force_N)},
            {"coefficient", friction.friction},
            {"sides", friction.sides}};
}

/// What a step does, without its name.
Json step_json(const PlannedStep& step)
{
    const auto or_none = [](const auto& value) { return value ? Json(*value) : Json(); };
    return {{"kind", name(step.kind)},
            {"freed", numbers(step.pick.freed)},
            {"fixed", numbers(step.pick.fixed)},
            {"carrying", numbers(step.pick.carrying)},
            {"target", step.pick.target ? face_json(*step.pick.target) : Json()},
            {"within_mm", step.within_mm},
            {"offset_mm", step.offset_mm},
            {"extent_mm", or_none(step.extent_mm)},
            {"friction", step.pick.friction ? friction_json(*step.pick.friction) : Json()},
            {"tolerance", or_none(step.tolerance)},
            {"most", {or_none(step.most_energy_steps), or_none(step.most_newton_steps)}}};
}

Json state_json(const UnfoldState& state)
{
    Json json = {{"position", numbers(state.position)},
                 {"direction_major", numbers(state.face.direction_major)},
                 {"necking", numbers(state.face.necking)},
                 {"step", numbers(state.step)},
                 {"plain", state.plain},
                 {"converged", state.converged},
                 {"system", int(state.system)},
                 {"trusted_strain", state.trusted_strain},
                 {"friction_share", state.friction_share},
                 {"reason", state.reason},
                 {"beyond", state.necking},
                 {"overlap", state.overlap.places},
                 {"overlap_landed", state.overlap.landed},
                 {"overlap_first", numbers(state.overlap.first)},
                 {"reach_mm", state.reach.farthest_mm},
                 {"without_room", state.reach.without_room},
                 {"seconds", state.seconds}};
    for (const SheetScalar& field : sheet_scalars)
        json[field.name] = numbers(state.face.*field.values);
    if (state.on)
        json["on"] = {
            {"face", face_json(state.on->face)}, {"distance_mm", state.on->distance_mm}, {"angle", state.on->angle}};
    return json;
}

UnfoldState state_of(const Json& json, const TriMesh& part, const std::string& name)
{
    UnfoldState state;
    state.name = name;
    const Eigen::Index faces = part.triangles();
    take(json, "position", 3, part.vertices(), state.position);
    take(json, "direction_major", 3, faces, state.face.direction_major);
    take(json, "necking", faces, 1, state.face.necking);
    take(json, "step", faces, 1, state.step);
    for (const SheetScalar& field : sheet_scalars)
        take(json, field.name, faces, 1, state.face.*field.values);
    state.plain = text(json, "plain");
    state.reason = text(json, "reason");
    if (!member(json, "converged").is_boolean())
        damaged("converged");
    state.converged = json["converged"].get<bool>();
    const int system = count(json, "system");
    if (system > int(SolvedSystem::energy))
        damaged("system");
    state.system = SolvedSystem(system);
    state.trusted_strain = number(json, "trusted_strain");
    state.friction_share = number(json, "friction_share");
    state.necking = count(json, "beyond");
    state.overlap.places = count(json, "overlap");
    state.overlap.landed = count(json, "overlap_landed");
    take(json, "overlap_first", 3, 1, state.overlap.first);
    state.reach = {number(json, "reach_mm"), count(json, "without_room")};
    state.seconds = number(json, "seconds");
    if (json.contains("on"))
        state.on = TargetFit{face_of(member(json["on"], "face")), number(json["on"], "distance_mm"),
                             number(json["on"], "angle")};
    return state;
}

/// The library reads CBOR by recursion: what is nested deeper than our files ever are is refused
/// first.
class Shallow : public nlohmann::json_sax<Json> {
public:
    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t) override { return true; }
    bool number_unsigned(number_unsigned_t) override { return true; }
    bool number_float(number_float_t, const string_t&) override { return true; }
    bool string(string_t&) override { return true; }
    bool binary(binary_t&) override { return true; }
    bool key(string_t&) override { return true; }
    bool start_object(std::size_t) override { return ++depth_ <= most; }
    bool start_array(std::size_t) override { return ++depth_ <= most; }
    bool end_object() override { return --depth_ >= 0; }
    bool end_array() override { return --depth_ >= 0; }
    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

private:
    static constexpr int most = 8;
    int depth_ = 0;
};

/// Four bytes behind the content: a number in the states that was damaged is a number still.
std::string checksum(std::string_view content)
{
    boost::crc_32_type crc;
    crc.process_bytes(content.data(), content.size());
    const std::uint32_t sum = crc.checksum();
    std::string bytes;
    for (int shift = 0; shift < 32; shift += 8)
        bytes += char((sum >> shift) & 0xff);
    return bytes;
}

Json read_cbor(const std::filesystem::path& file)
{
    if (!std::filesystem::exists(file))
        throw InputError("is not there; run the steps into this folder first");
    std::string bytes = file_content(file);
    constexpr size_t sum = 4;
    if (bytes.size() < sum || checksum(std::string_view(bytes).substr(0, bytes.size() - sum)) !=
                                  std::string_view(bytes).substr(bytes.size() - sum))
        damaged("its end");
    bytes.resize(bytes.size() - sum);
    Shallow shallow;
    if (!Json::sax_parse(bytes, &shallow, Json::input_format_t::cbor))
        damaged("its content");
    Json json = Json::from_cbor(bytes, true, false);
    if (!json.is_object() || text(json, "schema") != states_schema)
        damaged("its schema");
    return json;
}

std::string_view byte_order() { return std::endian::native == std::endian::little ? "little" : "big"; }

} // namespace

void write_unfold_states(const std::filesystem::path& file, const TriMesh& part, const FlattenOptions& options,
                         const UnfoldScript& steps, const UnfoldRun& run)
{
    Json json = {{"schema", states_schema}, {"program", program_name()},    {"byte_order", byte_order()},
                 {"part", part_json(part)}, {"sheet", sheet_json(options)}, {"steps", Json::array()},
                 {"states", Json::array()}};
    for (size_t k = 0; k < run.states.size(); ++k) {
        json["steps"].push_back(step_json(steps[k]));
        json["states"].push_back(state_json(run.states[k]));
    }
    const std::vector<std::uint8_t> bytes = Json::to_cbor(json);
    std::string content(bytes.begin(), bytes.end());
    content += checksum(content);
    write_atomically(file, content);
}

KeptStates read_unfold_states(const std::filesystem::path& file, const TriMesh& part, const FlattenOptions& options,
                              const UnfoldScript& steps)
{
    try {
        const Json json = read_cbor(file);
        KeptStates kept;
        if (text(json, "program") != program_name() || text(json, "byte_order") != byte_order())
            kept.why = "they are of another version of the program";
        else if (member(json, "part") != part_json(part))
            kept.why = "the part has changed";
        else if (member(json, "sheet") != sheet_json(options))
            kept.why = "the sheet or the options have changed";
        if (!kept.why.empty())
            return kept;
        const Json &done = member(json, "steps"), &states = member(json, "states");
        if (!done.is_array() || !states.is_array() || done.size() != states.size())
            damaged("steps");
        while (kept.keep < std::min(done.size(), steps.size()) && done[kept.keep] == step_json(steps[kept.keep])) {
            kept.run.states.push_back(state_of(states[kept.keep], part, steps[kept.keep].name));
            ++kept.keep;
        }
        if (kept.keep < steps.size())
            kept.why = kept.keep < done.size() ? fmt::format("step {} has changed", kept.keep + 1)
                                               : fmt::format("step {} was not done", kept.keep + 1);
        return kept;
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", file.string(), error.what()));
    }
}

} // namespace spia
