#include <fmt/core.h>

#include <algorithm>

#include "app/cli/commands.h"
#include "engine/core/error.h"
#include "engine/exchange/atomic_file.h"
#include "engine/forming/fit_hardening.h"
#include "engine/forming/material_text.h"
#include "engine/forming/tensile_test.h"

namespace spia::cli {
namespace {

TensileOptions options(const FitArguments& arguments)
{
    TensileOptions result;
    if (!arguments.data.empty())
        result.kind = arguments.data == "true" ? TensileOptions::Kind::truly : TensileOptions::Kind::engineering;
    if (!arguments.strain.empty())
        result.in_percent = arguments.strain == "percent";
    result.young_MPa = arguments.young;
    return result;
}

const LawFit& chosen(const std::vector<LawFit>& fits, const std::string& law)
{
    if (law == "best")
        return best_fit(fits);
    const LawFit& fit = *std::find_if(fits.begin(), fits.end(), [&](const LawFit& f) { return f.name == law; });
    if (!fit.law)
        throw InputError(fmt::format("{} does not fit: {}; choose another law or --law best", law, fit.reason));
    return fit;
}

void print_test(const TensileTest& test)
{
    fmt::print("modulus   {:.0f} MPa, {}\n", test.young_MPa, test.measured_young ? "measured" : "given");
    fmt::print("strength  Rp0.2 {:.1f} MPa, Rm {:.1f} MPa, uniform strain {:.4f} (logarithmic)\n",
               test.proof_stress_MPa, test.tensile_strength_MPa, test.uniform_strain);
    fmt::print("fitted    {} points of plastic strain {:.4f} to {:.4f}\n", test.plastic_strain.size(),
               test.plastic_strain[0], test.plastic_strain[test.plastic_strain.size() - 1]);
    for (const std::string& note : test.notes)
        fmt::print("  note: {}\n", note);
}

void print_fits(const std::vector<LawFit>& fits, const LawFit& taken)
{
    fmt::print("{:<16} {:>8}  {}\n", "law", "rms MPa", "fit");
    for (const LawFit& fit : fits) {
        if (fit.law)
            fmt::print("{:<16} {:>8.3f}  {}{}\n", fit.name, fit.rms_MPa, in_words(*fit.law),
                       &fit == &taken ? "   <- taken" : "");
        else
            fmt::print("{:<16} {:>8}  none: {}\n", fit.name, "-", fit.reason);
    }
}

} // namespace

int fit_material(const FitArguments& arguments)
{
    require_writable(arguments.out);
    std::error_code ignored;
    if (std::filesystem::equivalent(arguments.table, arguments.out, ignored))
        throw InputError(fmt::format("{} would be overwritten; choose another --out", arguments.table.string()));
    const TensileTest test =
        tensile_test(read_two_columns(arguments.table), arguments.table.string(), options(arguments));
    const auto fits = fit_hardening(test.plastic_strain, test.stress_MPa);
    const LawFit& fit = chosen(fits, arguments.law);

    Material material;
    material.name = arguments.name.empty() ? arguments.out.stem().string() : arguments.name;
    material.young_MPa = test.young_MPa;
    material.poisson = arguments.poisson;
    material.density_kg_m3 = arguments.density;
    material.hardening = *fit.law;
    material.r0 = arguments.r[0];
    material.r45 = arguments.r[1];
    material.r90 = arguments.r[2];
    material.source =
        fmt::format("fitted to the tensile test {}: {} with an rms error of {:.2f} MPa, uniform strain {:.3f}",
                    arguments.table.filename().string(), fit.name, fit.rms_MPa, test.uniform_strain);
    write_atomically(arguments.out, material_text(material));

    print_test(test);
    print_fits(fits, fit);
    fmt::print("wrote     {}\n", arguments.out.string());
    return 0;
}

} // namespace spia::cli
