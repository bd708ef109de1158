#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/progress.h"
#include "engine/mesh/soup.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// What can be wrong with a mesh as a file gives it; in brackets what `first` of a finding counts.
enum class Fault {
    nothing_there,      ///< no polygon at all
    bad_index,          ///< a polygon names a vertex that does not exist [face]
    bad_coordinate,     ///< not a number, infinite, or beyond any part [vertex]
    coincident_vertex,  ///< several vertices at one place [vertex]
    crack,              ///< open edges so close to others that they seem to be the same [vertex]
    repeated_corner,    ///< a polygon names a vertex twice [face]
    duplicate_face,     ///< the same corners as an earlier face [face]
    polygon,            ///< more than three corners [face]
    crossing_polygon,   ///< cannot be split into triangles [face]
    flat_face,          ///< a triangle without area [face]
    crowded_edge,       ///< an edge of three or more faces: non-manifold [face]
    flipped_face,       ///< turned against its neighbours [face]
    one_sided,          ///< like a Moebius strip [face]
    stray_vertex,       ///< used by no face [vertex]
    touching_fans,      ///< faces that meet in one vertex only: a non-manifold vertex [vertex]
    several_components, ///< [face, the first one outside the largest piece]
    closed_surface,     ///< no boundary [face]
    opening,            ///< of a surface that is closed elsewhere, covered [vertex]
    handle,             ///< genus above 0 [face]
    seam,               ///< cut open, after the examination [vertex, of the seam]
    closed_corner,      ///< cut there, the part would unroll without strain [vertex]
    sliver,             ///< a very small angle [face]
    gap,                ///< between faces of a CAD file, or a sliver of a face, closed [vertex]
    unmeshed_face,      ///< a face of a CAD file that gave no triangle [none]
    damaged_entity,     ///< of a CAD file, which no shape needs [none]
    overlap,            ///< faces of a CAD file that lie on one another [face]
    mark                ///< a shallow place of a skin of a solid, passed over [face]
};
std::string_view name(Fault fault);

/// Whether `first` and `where` of such a finding are vertices; else they are faces.
bool counts_vertices(Fault fault);

/// Counts faults of one kind and remembers where the first ones are.
struct Tally {
    int count = 0, first = -1;
    std::vector<int> where = {}; ///< the first thousand: nobody looks at more
    void add(int which)
    {
        constexpr int most = 1000;
        first = count == 0 ? which : first;
        if (count++ < most)
            where.push_back(which);
    }
};

enum class Severity { note, repaired, fatal };

/// One kind of fault, counted over the whole mesh.
struct Finding {
    Fault fault;
    Severity severity;
    int count;
    int first;                               ///< face or vertex (see Fault) as in the file, counted
                                             ///< from 0; -1 if none can be named
    std::string text;                        ///< what was found and, if repaired, what was done
    std::string advice;                      ///< what to do about it; empty if nothing has to be
                                             ///< done
    std::vector<int> where = {};             ///< as `first`, at most a thousand; empty if none can
                                             ///< be named
    std::vector<Eigen::Vector3d> place = {}; ///< of `where`, as in the soup; also of what was taken
                                             ///< out
    std::vector<std::string> what = {};      ///< of `where`, e.g. how wide; empty if there is
                                             ///< nothing to tell them apart
    std::optional<double> weld_gap = {};     ///< mm, of a crack: what would close it
};

/// What the examination found. The numbers describe the mesh after the repairs; those without a
/// value have no meaning for it (an edge with three faces, a one-sided surface).
struct DoctorReport {
    std::vector<Finding> findings;           ///< in the order of the examination
    int components = 0;                      ///< pieces connected by edges
    std::optional<int> boundary_loops;       ///< 1 for a sheet without holes
    std::optional<int> genus;                ///< number of handles
    std::optional<int> euler_characteristic; ///< vertices - edges + faces

    bool healthy() const;                   ///< no fatal finding
    const Finding* find(Fault fault) const; ///< the first of this kind, nullptr if there is none
    void add(Fault fault, Severity severity, const Tally& tally, std::string text, std::string advice);
};

struct DoctorOptions {
    bool weld = false;                   ///< join vertices at one place; right for files that
                                         ///< repeat a vertex in each face
    double weld_tolerance = 1e-6;        ///< of the diagonal: gaps closed at open edges; 0: equal
                                         ///< coordinates only
    std::optional<double> weld_gap = {}; ///< mm, in its place
    bool keep_largest = false;           ///< leave out all but the largest piece, and what hangs on
                                         ///< edges of three faces
    double sliver_angle_deg = 1;         ///< a triangle with a smaller angle is noted

    friend bool operator==(const DoctorOptions&, const DoctorOptions&) = default;
};

/// A soup turned into a mesh, and what was found on the way.
struct Examination {
    TriMesh mesh;                   ///< repaired as far as possible; a part only if the report is
                                    ///< healthy
    std::vector<int> source_vertex; ///< per vertex of mesh its number in the soup; never decreases,
                                    ///< and repeats only where touching fans were separated
    std::vector<int> source_face;   ///< per triangle of mesh its polygon in the soup; never
                                    ///< decreases
    DoctorReport report;
    std::vector<int> same_as = {}; ///< per vertex of the soup the one that stands for it: itself
                                   ///< unless it was joined
};

/// Makes a triangle mesh of a polygon soup: joins, splits, turns and removes what can be repaired
/// without changing the sheet, and reports every change and every fault that is left. Vertices and
/// faces keep the order of the file. Never throws for what the soup contains (only Cancelled).
Examination examine(const PolygonSoup& soup, const DoctorOptions& options = {}, const Progress& progress = {});

/// The first three fatal findings and what to do about them; nothing if there are none.
std::optional<std::string> refusal(const DoctorReport& report);
/// @throws InputError with the refusal(), if there is one
void require_healthy(const DoctorReport& report);

} // namespace spia
