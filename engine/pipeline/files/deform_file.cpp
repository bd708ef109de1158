#include "engine/pipeline/files/deform_file.h"

#include <set>

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/core/json_file.h"
#include "engine/core/vector_json.h"
#include "engine/pipeline/files/file_members.h"

namespace spia {
namespace {

constexpr const char* deformation_schema = "spia.deformation/1";

template <size_t count> std::array<int, count> numbers(const Json& json, const Place& place, int least, int greatest)
{
    if (!json.is_array() || json.size() != count)
        place.fail(fmt::format("must be a list of {} whole numbers", count));
    std::array<int, count> result{};
    for (size_t k = 0; k < count; ++k) {
        if (!json[k].is_number_integer() || json[k].get<double>() < least || json[k].get<double>() > greatest)
            place.entry(k).fail(fmt::format("must be a whole number from {} to {}", least, greatest));
        result[k] = json[k].get<int>();
    }
    return result;
}

constexpr int most = 1'000'000; // control points along a patch

ControlMove control_move(const Json& json, const Place& place)
{
    members::require_object(json, place, {"patch", "at", "by"});
    ControlMove move;
    if (const Json* patch = members::find(json, place, "patch", false))
        move.patch = numbers<1>(Json::array({*patch}), place.member("patch"), 0, most)[0];
    const auto at = numbers<2>(*members::find(json, place, "at", true), place.member("at"), 0, most);
    move.i = at[0];
    move.j = at[1];
    move.move = members::vector(*members::find(json, place, "by", true), place.member("by"));
    return move;
}

void read_lattice(const Json& json, const Place& place, DeformationWish& wish)
{
    members::require_object(json, place, {"count", "degree", "origin", "edges", "moves"});
    Lattice lattice;
    lattice.count = numbers<3>(*members::find(json, place, "count", true), place.member("count"), 2, 64);
    for (size_t k = 0; k < 3; ++k)
        lattice.degree[k] = std::min(3, lattice.count[k] - 1);
    if (const Json* degree = members::find(json, place, "degree", false))
        lattice.degree = numbers<3>(*degree, place.member("degree"), 1, 5);
    const Json *origin = members::find(json, place, "origin", false),
               *edges = members::find(json, place, "edges", false);
    if ((origin == nullptr) != (edges == nullptr))
        place.fail("needs both \"origin\" and \"edges\", or neither: then the box is laid around the surface");
    if (origin) {
        lattice.origin = members::vector(*origin, place.member("origin"));
        if (!edges->is_array() || edges->size() != 3)
            place.member("edges").fail("must be three edges [[x, y, z], ...] of the box");
        for (size_t k = 0; k < 3; ++k)
            lattice.edge.col(Eigen::Index(k)) = members::vector((*edges)[k], place.member("edges").entry(k));
    }
    wish.around = origin == nullptr;
    lattice.move = Eigen::Matrix3Xd::Zero(3, lattice.points());
    std::set<int> moved;
    members::each_of(json, place, "moves", [&](const Json& move, const Place& at, const std::string&) {
        members::require_object(move, at, {"at", "by"});
        const auto index = numbers<3>(*members::find(move, at, "at", true), at.member("at"), 0, 63);
        for (size_t k = 0; k < 3; ++k)
            if (index[k] >= lattice.count[k])
                at.member("at").entry(k).fail(
                    fmt::format("is {} but there are {} points, counted from 0", index[k], lattice.count[k]));
        const int point = lattice.index(index[0], index[1], index[2]);
        if (!moved.insert(point).second)
            at.fail("is of a lattice point that is moved already");
        lattice.move.col(point) = members::vector(*members::find(move, at, "by", true), at.member("by"));
    });
    try {
        require_sound(lattice);
    } catch (const InputError& error) {
        place.fail("is no lattice: " + std::string(error.what()));
    }
    wish.lattice = std::move(lattice);
}

} // namespace

DeformationWish read_deformation(const std::filesystem::path& file)
{
    const Json json = read_json(file, true);
    const std::string name = file.string();
    const Place top(name);
    members::require_object(json, top, {"schema", "moves", "lattice"});
    if (members::text_in(json, top, "schema", "") != deformation_schema)
        top.member("schema").fail(fmt::format("must be \"{}\"", deformation_schema));
    DeformationWish wish;
    members::each_of(json, top, "moves", [&](const Json& move, const Place& at, const std::string&) {
        wish.moves.push_back(control_move(move, at));
    });
    if (const Json* lattice = members::find(json, top, "lattice", false))
        read_lattice(*lattice, top.member("lattice"), wish);
    if (wish.moves.empty() && !wish.lattice)
        top.fail("must have moves of control points or a lattice");
    return wish;
}

Deformation deformation_of(const DeformationWish& wish, const MultiPatch& surface)
{
    Deformation deformation{wish.moves, wish.lattice};
    if (wish.lattice && wish.around) {
        deformation.lattice = lattice_around(surface, wish.lattice->count, wish.lattice->degree);
        deformation.lattice->move = wish.lattice->move;
    }
    return deformation;
}

void write_deformation(const std::filesystem::path& file, const Deformation& deformation)
{
    Json json = {{"schema", deformation_schema}, {"moves", Json::array()}};
    for (const ControlMove& move : deformation.moves)
        json["moves"].push_back(
            {{"patch", move.patch}, {"at", Json::array({move.i, move.j})}, {"by", vector_json(move.move)}});
    if (const auto& lattice = deformation.lattice) {
        Json moves = Json::array();
        for (int k = 0; k < lattice->count[2]; ++k)
            for (int j = 0; j < lattice->count[1]; ++j)
                for (int i = 0; i < lattice->count[0]; ++i)
                    if (const Eigen::Vector3d by = lattice->move.col(lattice->index(i, j, k)); !by.isZero(0))
                        moves.push_back({{"at", Json::array({i, j, k})}, {"by", vector_json(by)}});
        json["lattice"] = {
            {"count", lattice->count},
            {"degree", lattice->degree},
            {"origin", vector_json(lattice->origin)},
            {"edges",
             {vector_json(lattice->edge.col(0)), vector_json(lattice->edge.col(1)), vector_json(lattice->edge.col(2))}},
            {"moves", std::move(moves)}};
    }
    write_atomically(file, lines_of(json, file.string()));
}

} // namespace spia
