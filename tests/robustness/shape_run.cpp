#include "tests/robustness/shape_run.h"

#include <exception>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/exchange/read_part.h"
#include "engine/mesh/orient2d.h"
#include "engine/part/prepare_part.h"

namespace spia {
namespace {

/// What is wrong with the blank, in words; empty if it is one.
std::string fault_of(const FlattenResult& flat, const TriMesh& part)
{
    if (flat.blank.position.cols() != part.vertices() || !flat.blank.position.allFinite())
        return "the blank has places that are no numbers";
    for (int f = 0; f < part.triangles(); ++f) {
        const auto t = part.triangle.col(f);
        if (orient2d(flat.blank.position.col(t[0]), flat.blank.position.col(t[1]), flat.blank.position.col(t[2])) <= 0)
            return fmt::format("face {} of the blank is flipped", f);
    }
    if (!flat.face.thickness.allFinite() || !(flat.face.thickness.minCoeff() > 0))
        return "a thickness is not positive";
    if (!flat.face.strain_major.allFinite() || !flat.face.stress_major.allFinite())
        return "a strain or a stress is no number";
    if (!(flat.volume_error < 1e-6))
        return fmt::format("the volume of a face is off by {:.1e}", flat.volume_error);
    return "";
}

template <class Read> ShapeRun run(const Read& read, const FlattenOptions& flattening)
{
    ShapeRun result;
    try {
        const PartFile part = read();
        require_healthy(part.doctor);
        result.triangles = part.mesh.triangles();
        result.seam_mm = part.seam_length;
        const FlattenResult flat = flatten(part.mesh, flattening);
        result.seconds = flat.report.seconds;
        result.system = flat.report.system;
        result.process_share = flat.report.process_share;
        result.attempts = flat.report.attempts;
        result.most_strain = flat.face.strain_equivalent.maxCoeff();
        result.crossings = int(flat.overlap.crossings.size());
        result.wound = int(flat.overlap.wound.size());
        result.why = fault_of(flat, part.mesh);
        result.end = result.why.empty() ? ShapeRun::End::blank : ShapeRun::End::failure;
    } catch (const InputError& error) {
        result.end = ShapeRun::End::refusal;
        result.why = error.what();
    } catch (const std::exception& error) {
        result.why = error.what();
    }
    return result;
}

} // namespace

ShapeRun run_shape(const PolygonSoup& soup, const ReadOptions& options, const FlattenOptions& flattening)
{
    return run([&] { return examine_soup(soup, options); }, flattening);
}

ShapeRun run_shape(const std::filesystem::path& file, const ReadOptions& options, const FlattenOptions& flattening)
{
    return run([&] { return examine_part(file, options); }, flattening);
}

} // namespace spia
