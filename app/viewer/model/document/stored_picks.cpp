#include "app/viewer/model/document/stored_picks.h"

#include <algorithm>
#include <cstdint>
#include <fmt/core.h>
#include <map>

#include "app/viewer/model/document/changed_part.h"
#include "app/viewer/model/document/file_numbers.h"
#include "app/viewer/model/picking/vertex_picking.h"
#include "engine/core/error.h"
#include "engine/mesh/topology.h"
#include "engine/part/vertex_numbers.h"

namespace spia::viewer {
namespace {

void require_triangle(const TriMesh& mesh, int triangle)
{
    if (triangle < 0 || triangle >= mesh.triangles())
        throw InputError(fmt::format("face {} was picked, but the part has faces 0 to {}; pick again", triangle,
                                     mesh.triangles() - 1));
}

std::vector<StoredVertex> store_vertices(const PartFile& part, const std::vector<int>& vertices)
{
    if (vertices.empty())
        return {};
    const TriMesh& mesh = part.mesh;
    const std::vector<int> boundary = boundary_vertices(mesh).vertex;
    const Eigen::Matrix3Xd normal = vertex_normals(mesh);
    std::vector<StoredVertex> stored;
    for (const int v : vertices) {
        if (v < 0 || v >= mesh.vertices())
            throw InputError(fmt::format("vertex {} was picked, but the part has vertices 0 to {}; pick again", v,
                                         mesh.vertices() - 1));
        stored.push_back({part.source_vertex[size_t(v)], std::binary_search(boundary.begin(), boundary.end(), v),
                          mesh.position.col(v), normal.col(v)});
    }
    return stored;
}

/// Faces that all steps treat alike become one patch.
StoredSteps store_steps(const PartFile& part, const StepList& steps)
{
    constexpr char is_fixed = 1, is_freed = 2, is_carrying = 4, is_rubbing = 8;
    const std::vector<int> nowhere;
    const auto rubbing = [&](const PlannedStep& step) {
        return step.pick.friction ? &step.pick.friction->faces : &nowhere;
    };
    // by step
    std::vector<std::string> treated(size_t(part.mesh.triangles()), std::string(steps.size(), '\0'));
    for (size_t k = 0; k < steps.size(); ++k)
        for (const auto& [faces, role] :
             {std::pair(&steps[k]->pick.fixed, is_fixed), std::pair(&steps[k]->pick.freed, is_freed),
              std::pair(&steps[k]->pick.carrying, is_carrying), std::pair(rubbing(*steps[k]), is_rubbing)})
            for (const int f : *faces) {
                require_triangle(part.mesh, f);
                treated[size_t(f)][k] = char(treated[size_t(f)][k] | role);
            }
    std::map<std::string, std::vector<int>> alike;
    const std::string nothing(steps.size(), '\0');
    for (int f = 0; f < part.mesh.triangles(); ++f)
        if (treated[size_t(f)] != nothing)
            alike[treated[size_t(f)]].push_back(f);
    StoredSteps stored;
    for (const auto& step : steps)
        stored.step.push_back({step->kind,
                               step->name,
                               {},
                               {},
                               {},
                               {},
                               step->within_mm,
                               step->offset_mm,
                               step->extent_mm,
                               step->tolerance,
                               step->most_energy_steps,
                               step->most_newton_steps,
                               numbers_of(*step),
                               numbers_of(step->pick.friction),
                               step->carrying_lost});
    for (const auto& [roles, faces] : alike) {
        const int patch = int(stored.patch.size());
        stored.patch.push_back(store_patch(part, faces));
        for (size_t k = 0; k < steps.size(); ++k)
            for (const auto& [list, role] :
                 {std::pair(&stored.step[k].fixed, is_fixed), std::pair(&stored.step[k].freed, is_freed),
                  std::pair(&stored.step[k].carrying, is_carrying), std::pair(&stored.step[k].rubbing, is_rubbing)})
                if (roles[k] & role)
                    list->push_back(patch);
    }
    return stored;
}

} // namespace

StoredPatch store_patch(const PartFile& part, const std::vector<int>& triangles)
{
    const FaceNumbers numbers(part);
    StoredPatch patch;
    std::map<int, int> point; // of the part, to the patch
    patch.triangle.resize(3, Eigen::Index(triangles.size()));
    for (size_t i = 0; i < triangles.size(); ++i) {
        require_triangle(part.mesh, triangles[i]);
        patch.face.push_back(numbers.face(triangles[i]));
        patch.piece.push_back(numbers.piece(triangles[i]));
        for (int k = 0; k < 3; ++k)
            patch.triangle(k, Eigen::Index(i)) =
                point.try_emplace(part.mesh.triangle(k, triangles[i]), int(point.size())).first->second;
    }
    if (std::all_of(patch.piece.begin(), patch.piece.end(), [](int piece) { return piece == 0; }))
        patch.piece.clear();
    patch.point.resize(3, Eigen::Index(point.size()));
    for (const auto& [vertex, i] : point)
        patch.point.col(i) = part.mesh.position.col(vertex);
    return patch;
}

const PartFile& picked_part(const Document& document)
{
    if (!document.session.part)
        throw InputError("picks belong to a part, and none is open; open a part first");
    return *document.session.part;
}

std::string fingerprint(const PartFile& part)
{
    std::uint64_t hash = 0xcbf29ce484222325; // FNV-1a
    const auto add = [&](const void* bytes, size_t count) {
        for (size_t i = 0; i < count; ++i)
            hash = (hash ^ static_cast<const unsigned char*>(bytes)[i]) * 0x100000001b3;
    };
    add(part.mesh.position.data(), sizeof(double) * size_t(part.mesh.position.size()));
    add(part.mesh.triangle.data(), sizeof(int) * size_t(part.mesh.triangle.size()));
    add(part.source_vertex.data(), sizeof(int) * part.source_vertex.size());
    add(part.source_face.data(), sizeof(int) * part.source_face.size());
    return fmt::format("{:016x}", hash);
}

StoredPicks store_picks(const Document& document)
{
    const PartFile& part = picked_part(document);
    const FaceNumbers numbers(part);
    StoredPicks picks;
    picks.fingerprint = fingerprint(part);
    picks.selected = store_patch(part, document.selected);
    picks.vertices = store_vertices(part, document.vertices);
    for (const FaceRegion& region : document.regions)
        picks.regions.push_back(
            {region.name, region.kind, region.colour, store_patch(part, region.faces), region.contact, region.sheet});
    picks.lines = document.lines;
    picks.steps = store_steps(part, document.steps);
    picks.steps.proposed = still_proposed(document);
    if (picks.steps.proposed && document.proposal->root >= 0)
        picks.steps.root = document.proposal->root;
    const auto stored = [&](const Probe& probe) {
        require_triangle(part.mesh, probe.face);
        const Eigen::Matrix3d corners = corners_of(part.mesh, probe.face);
        return StoredProbe{numbers.face(probe.face), numbers.piece(probe.face), probe.barycentric,
                           corners * probe.barycentric, unit_normal(corners)};
    };
    for (const Probe& probe : document.probes)
        picks.probes.push_back(stored(probe));
    for (const Measurement& measurement : document.measurements) {
        if (measurement.on != View::part)
            continue; // of a result, which is not kept either
        picks.measurements.push_back({measurement.kind, {}});
        for (const Probe& probe : measurement.at)
            picks.measurements.back().at.push_back(stored(probe));
    }
    if (document.session.options.corners) {
        auto& corners = picks.corners.emplace();
        for (size_t k = 0; k < 4; ++k) {
            const int number = (*document.session.options.corners)[k];
            const std::vector<int> found = vertices_called(part, number);
            if (found.empty())
                throw InputError(fmt::format("corner {} is vertex {}, which the part does not have; choose it again",
                                             k + 1, number));
            corners[k] = {number, part.mesh.position.col(found[0])};
        }
    }
    return picks;
}

} // namespace spia::viewer
