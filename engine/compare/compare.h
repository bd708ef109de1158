#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/compare/isometric.h"
#include "engine/compare/map_quality.h"
#include "engine/forming/flatten.h"

namespace spia {

enum class FlatMethod { spia, abf, arap, lscm, slim };
inline constexpr FlatMethod flat_methods[] = {FlatMethod::spia, FlatMethod::abf, FlatMethod::arap, FlatMethod::lscm,
                                              FlatMethod::slim};

std::string_view name(FlatMethod method);  ///< "spia", "abf", "arap", "lscm", "slim"
std::string_view title(FlatMethod method); ///< as in a table: "SPIA", "ABF++", "ARAP", "LSCM",
                                           ///< "SLIM"

/// @throws InputError naming the methods there are
FlatMethod flat_method(std::string_view name);

struct CompareOptions {
    /// in the order of the rows
    std::vector<FlatMethod> methods{std::begin(flat_methods), std::end(flat_methods)};
    /// for this solver
    FlattenOptions flatten;
};

/// One method on one part.
struct ComparisonRow {
    FlatMethod method;
    std::string failure = {};            ///< why there is no map; empty: there is one
    double seconds = 0;                  ///< wall clock, from the mesh in memory to the map, its
                                         ///< start included
    double cpu_seconds = 0;              ///< of the processor, all threads together: on a busy
                                         ///< machine the fairer figure
    std::optional<double> peak_mb = {};  ///< of the whole program meanwhile
    std::optional<double> added_mb = {}; ///< of that, what the method took
    int iterations = 0;
    std::string ended = {}; ///< how the method ended, in words
    MapQuality quality = {};
};

/// Runs the methods one after the other on the same mesh and measures their maps with the same
/// ruler (the paper's Table 3). A method that cannot do the part gets a row that says why.
/// @throws Cancelled at the next checkpoint of a method after a request to stop
std::vector<ComparisonRow> compare(const TriMesh& part, const CompareOptions& options, const Progress& progress = {});

} // namespace spia
