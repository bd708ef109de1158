#include "engine/forming/material/material_fit.h"

#include <algorithm>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/forming/material/two_columns.h"

namespace spia {
namespace {

const LawFit& chosen(const std::vector<LawFit>& fits, const std::string& law)
{
    if (law == "best")
        return best_fit(fits);
    const auto fit = std::find_if(fits.begin(), fits.end(), [&](const LawFit& each) { return each.name == law; });
    if (fit == fits.end())
        throw InputError(fmt::format("there is no hardening law \"{}\"", law));
    if (!fit->law)
        throw InputError(fmt::format("{} does not fit: {}; choose another law or the best one", law, fit->reason));
    return *fit;
}

} // namespace

MaterialFit fit_material(const std::filesystem::path& table, const MaterialFitOptions& options)
{
    MaterialFit result;
    result.test = tensile_test(read_two_columns(table), table.string(), options.test);
    result.fits = fit_hardening(result.test.plastic_strain, result.test.stress_MPa);
    const LawFit& fit = chosen(result.fits, options.law);
    result.taken = size_t(&fit - result.fits.data());
    result.material = {
        options.name,
        result.test.young_MPa,
        options.poisson,
        options.density_kg_m3,
        *fit.law,
        options.r0,
        options.r45,
        options.r90,
        fmt::format("fitted to the tensile test {}: {} with an rms error of {:.2f} MPa, uniform strain {:.3f}",
                    table.filename().string(), fit.name, fit.rms_MPa, result.test.uniform_strain)};
    return result;
}

} // namespace spia
