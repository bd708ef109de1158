#include "engine/compare/compare.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <new>

#include "engine/compare/abf.h"
#include "engine/compare/arap.h"
#include "engine/compare/lscm.h"
#include "engine/compare/peak_memory.h"
#include "engine/compare/slim.h"
#include "engine/core/error.h"

namespace spia {
namespace {

/// This solver's blank: scaled to the part's area by the measures alone, like the other maps.
FlatMap forming(const TriMesh& part, const FlattenOptions& options, const Progress& progress)
{
    require_sheet(part);
    FlattenResult result = flatten(part, options, progress);
    FlatMap map;
    map.position = std::move(result.blank.position);
    map.iterations = int(result.report.energy.size() + result.report.newton.size());
    map.ended = result.report.reason;
    return map;
}

FlatMap run(FlatMethod method, const TriMesh& part, const CompareOptions& options, const Progress& progress)
{
    switch (method) {
    case FlatMethod::spia: return forming(part, options.flatten, progress);
    case FlatMethod::abf: return abf(part, {}, progress);
    case FlatMethod::arap: return arap(part, {}, progress);
    case FlatMethod::lscm: return lscm(part, {}, progress);
    case FlatMethod::slim: break;
    }
    return slim(part, slim_options, progress);
}

ComparisonRow row(FlatMethod method, const TriMesh& part, const CompareOptions& options, const Progress& progress)
{
    ComparisonRow result{method};
    const PeakMemory memory;
    const auto clock = std::chrono::steady_clock::now();
    const std::clock_t processor = std::clock();
    const auto stop = [&] {
        result.cpu_seconds = double(std::clock() - processor) / CLOCKS_PER_SEC;
        result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
        result.peak_mb = memory.most_mb();
        result.added_mb = memory.added_mb();
    };
    try {
        const FlatMap map = run(method, part, options, progress);
        stop();
        result.iterations = map.iterations;
        result.ended = map.ended;
        if (!map.position.allFinite())
            throw SolveError("the map has coordinates that are not numbers");
        result.quality = map_quality(part, map.position);
    } catch (const Cancelled&) {
        throw;
    } catch (const Error& error) {
        stop();
        result.failure = error.what();
    } catch (const std::bad_alloc&) {
        stop();
        result.failure = "there is not enough memory for this part";
    }
    return result;
}

} // namespace

std::string_view name(FlatMethod method)
{
    switch (method) {
    case FlatMethod::spia: return "spia";
    case FlatMethod::abf: return "abf";
    case FlatMethod::arap: return "arap";
    case FlatMethod::lscm: return "lscm";
    case FlatMethod::slim: return "slim";
    }
    return "";
}

std::string_view title(FlatMethod method)
{
    switch (method) {
    case FlatMethod::spia: return "SPIA";
    case FlatMethod::abf: return "ABF++";
    case FlatMethod::arap: return "ARAP";
    case FlatMethod::lscm: return "LSCM";
    case FlatMethod::slim: return "SLIM";
    }
    return "";
}

FlatMethod flat_method(std::string_view wanted)
{
    std::vector<std::string_view> names;
    for (const FlatMethod method : flat_methods) {
        if (name(method) == wanted)
            return method;
        names.push_back(name(method));
    }
    throw InputError(fmt::format("there is no method \"{}\"; choose from {}", wanted, fmt::join(names, ", ")));
}

std::vector<ComparisonRow> compare(const TriMesh& part, const CompareOptions& options, const Progress& progress)
{
    std::vector<ComparisonRow> rows;
    const double count = double(options.methods.size());
    for (size_t i = 0; i < options.methods.size(); ++i)
        rows.push_back(row(options.methods[i], part, options, progress.part(double(i) / count, double(i + 1) / count)));
    return rows;
}

} // namespace spia
