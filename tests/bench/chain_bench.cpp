// Seconds and memory per stage on the inner panel, and beside them in the same run one symbolic and
// numeric sparse Cholesky factorisation of a symmetric matrix with the solver's own pattern: the
// yardstick. Absolute times mean little on a shared machine; read the counter `per_factorisation`.
#include <Eigen/Geometry>
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <map>

#include "engine/coons/boundary.h"
#include "engine/forming/flatten.h"
#include "engine/forming/material/material_library.h"
#include "engine/pipeline/run_chain.h"
#include "engine/pipeline/session.h"
#include "engine/unfold/step/unfold_step.h"
#include "tests/support/developable.h"
#include "tests/support/inner_panel.h"
#include "tests/support/revolved.h"
#include "tests/support/square_cup.h"

namespace {

using namespace spia;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

const TriMesh& panel(int triangles)
{
    static std::map<int, TriMesh> made;
    auto& mesh = made[triangles];
    if (mesh.triangles() == 0) {
        shapes::InnerPanel shape;
        shape.triangles = triangles;
        mesh = shapes::inner_panel(shape).mesh;
    }
    return mesh;
}

FlattenOptions mild_steel()
{
    FlattenOptions options;
    options.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    options.thickness = 0.8;
    return options;
}

/// One analysis and one factor of the Laplacian-like stiffness of the flat sheet.
double factorisation_seconds(const TriMesh& part)
{
    BlockMatrix matrix(part.triangle, part.vertices());
    std::vector<Matrix6d> element(size_t(part.triangles()));
    const auto geometry = elements(part);
    for (size_t f = 0; f < element.size(); ++f) {
        const Eigen::Matrix<double, 4, 6> B = gradient_operator(geometry[f]);
        element[f] = geometry[f].area * (B.transpose() * B);
    }
    matrix.assemble(element);
    matrix.add_to_diagonal(0, 1);
    matrix.add_to_diagonal(1, 1);
    const auto start = Clock::now();
    Cholesky cholesky(matrix);
    if (!cholesky.factor(matrix))
        throw std::runtime_error("the yardstick's matrix is not definite");
    return seconds_since(start);
}

void solve(benchmark::State& state)
{
    const TriMesh& part = panel(int(state.range(0)));
    double solving = 0, factoring = 0;
    for (auto _ : state) {
        factoring += factorisation_seconds(part);
        const auto start = Clock::now();
        const FlattenResult result = flatten(part, mild_steel());
        solving += seconds_since(start);
        state.counters["energy_steps"] = double(result.report.energy.size());
        state.counters["newton_steps"] = double(result.report.newton.size());
        state.counters["converged"] = result.report.converged;
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    state.counters["triangles"] = part.triangles();
    state.counters["factorisation_s"] = factoring / double(state.iterations());
    state.counters["solve_s"] = solving / double(state.iterations());
    state.counters["per_factorisation"] = solving / factoring;
    state.counters["peak_MB"] = double(usage.ru_maxrss) / 1024;
}

/// The stages after the solver, on its blank.
void grid_lift_fit(benchmark::State& state)
{
    Session session;
    auto file = std::make_shared<PartFile>();
    file->mesh = panel(int(state.range(0)));
    session.part = file;
    session.blank = std::make_shared<FlattenResult>(flatten(file->mesh, mild_steel()));
    for (auto _ : state)
        session = completed(run_chain(std::move(session), Stage::grid, Stage::fit));
    for (const Stage stage : {Stage::grid, Stage::lift, Stage::fit})
        state.counters[std::string(name(stage)) + "_s"] = session.seconds.at(stage);
    state.counters["triangles"] = file->mesh.triangles();
}

bool in_the_ground(const TriMesh& part, int f)
{
    return part.position.row(2)(part.triangle.col(f)).cwiseAbs().maxCoeff() < 1e-9;
}

bool looks_up(const TriMesh& part, int f)
{
    const Eigen::Matrix3d x = part.position(Eigen::all, part.triangle.col(f));
    return (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).normalized()[2] > 0.7;
}

/// One step of local unfolding onto the face on which the fixed faces lie, beside one factorisation
/// of the matrix of its freed faces.
void unfold_step_of(benchmark::State& state, TriMesh (*part_of)(int), bool (*stays)(const TriMesh&, int))
{
    // So many freed faces.
    TriMesh part;
    UnfoldPick pick;
    double wanted = double(state.range(0));
    for (int tries = 0; tries < 2; ++tries) {
        part = part_of(int(wanted));
        pick = {};
        for (int f = 0; f < part.triangles(); ++f)
            (stays(part, f) ? pick.fixed : pick.freed).push_back(f);
        wanted *= double(state.range(0)) / double(pick.freed.size());
    }
    TriMesh freed{part.position, part.triangle(Eigen::all, pick.freed)};
    std::vector<int> number(size_t(part.vertices()), -1);
    int vertices = 0;
    for (int& v : freed.triangle.reshaped()) {
        int& n = number[size_t(v)];
        if (n < 0)
            n = vertices++;
        freed.position.col(n) = part.position.col(v);
        v = n;
    }
    freed.position.conservativeResize(3, vertices);
    double solving = 0, factoring = 0;
    for (auto _ : state) {
        factoring += factorisation_seconds(freed);
        const auto start = Clock::now();
        const UnfoldStepResult result = unfold_step(part, part.position, pick, mild_steel());
        solving += seconds_since(start);
        state.counters["energy_steps"] = double(result.piece[0].report.energy.size());
        state.counters["newton_steps"] = double(result.piece[0].report.newton.size());
        state.counters["converged"] = result.converged();
    }
    state.counters["freed"] = freed.triangles();
    state.counters["fixed"] = double(pick.fixed.size());
    state.counters["factorisation_s"] = factoring / double(state.iterations());
    state.counters["step_s"] = solving / double(state.iterations());
    state.counters["per_factorisation"] = solving / factoring;
}

TriMesh flange(int triangles) { return shapes::bent_flange({.angle_deg = 135, .triangles = triangles}).mesh; }
TriMesh round_cup(int triangles) { return shapes::sharp_cup({.triangles = triangles}).mesh; }
/// A cup whose bottom is a cap of a sphere: its wall is laid on the smooth face through it.
TriMesh crowned_cup(int triangles)
{
    constexpr double crown = 150, radius = 40, height = 30; // mm
    Eigen::Matrix2Xd meridian(2, 42);
    for (int k = 0; k <= 40; ++k) {
        const double r = radius * k / 40;
        meridian.col(k) << r, std::sqrt(crown * crown - r * r);
    }
    meridian.col(41) << radius, meridian(1, 40) - height;
    return shapes::axisymmetric(meridian, triangles).mesh;
}
TriMesh square_cup(int triangles) { return shapes::square_cup({.triangles = triangles}); }

void step_sizes(benchmark::internal::Benchmark* bench)
{
    for (int triangles : {20000, 100000})
        bench->Arg(triangles);
    bench->Unit(benchmark::kMillisecond)->Iterations(1);
}

void sizes(benchmark::internal::Benchmark* bench)
{
    for (int triangles : {2000, 20000, 50000, 105000, 207000, 500000, 1000000})
        bench->Arg(triangles);
    bench->Unit(benchmark::kMillisecond)->Iterations(1);
}

BENCHMARK(solve)->Apply(sizes);
BENCHMARK(grid_lift_fit)->Apply(sizes);
BENCHMARK_CAPTURE(unfold_step_of, flange, &flange, &in_the_ground)->Apply(step_sizes);
BENCHMARK_CAPTURE(unfold_step_of, round_cup, &round_cup, &in_the_ground)->Apply(step_sizes);
BENCHMARK_CAPTURE(unfold_step_of, square_cup, &square_cup, &in_the_ground)->Apply(step_sizes);
BENCHMARK_CAPTURE(unfold_step_of, crowned_cup, &crowned_cup, &looks_up)->Apply(step_sizes);

} // namespace

BENCHMARK_MAIN();
