#include <fmt/core.h>

#include "app/cli/commands.h"
#include "app/cli/terminal.h"
#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/forming/material/material_fit.h"
#include "engine/forming/material/material_text.h"

namespace spia::cli {
namespace {

MaterialFitOptions options(const FitArguments& arguments)
{
    MaterialFitOptions result;
    if (!arguments.data.empty())
        result.test.kind = arguments.data == "true" ? TensileOptions::Kind::truly : TensileOptions::Kind::engineering;
    if (!arguments.strain.empty())
        result.test.in_percent = arguments.strain == "percent";
    result.test.young_MPa = arguments.young;
    result.law = arguments.law;
    result.name = arguments.name.empty() ? arguments.out.stem().string() : arguments.name;
    result.poisson = arguments.poisson;
    result.density_kg_m3 = arguments.density;
    result.r0 = arguments.r[0];
    result.r45 = arguments.r[1];
    result.r90 = arguments.r[2];
    return result;
}

void print_test(const TensileTest& test)
{
    say("modulus   {:.0f} MPa, {}\n", test.young_MPa, test.measured_young ? "measured" : "given");
    say("strength  Rp0.2 {:.1f} MPa, Rm {:.1f} MPa, uniform strain {:.4f} (logarithmic)\n", test.proof_stress_MPa,
        test.tensile_strength_MPa, test.uniform_strain);
    say("fitted    {} points of plastic strain {:.4f} to {:.4f}\n", test.plastic_strain.size(), test.plastic_strain[0],
        test.plastic_strain[test.plastic_strain.size() - 1]);
    for (const std::string& note : test.notes)
        say("  note: {}\n", note);
}

void print_fits(const std::vector<LawFit>& fits, const LawFit& taken)
{
    say("{:<16} {:>8}  {}\n", "law", "rms MPa", "fit");
    for (const LawFit& fit : fits) {
        if (fit.law)
            say("{:<16} {:>8.3f}  {}{}\n", fit.name, fit.rms_MPa, describe(*fit.law),
                &fit == &taken ? "   <- taken" : "");
        else
            say("{:<16} {:>8}  none: {}\n", fit.name, "-", fit.reason);
    }
}

} // namespace

int fit_material(const FitArguments& arguments)
{
    require_writable(arguments.out);
    std::error_code ignored;
    if (std::filesystem::equivalent(arguments.table, arguments.out, ignored))
        throw InputError(fmt::format("{} would be overwritten; choose another --out", arguments.table.string()));
    const MaterialFit fit = spia::fit_material(arguments.table, options(arguments));
    write_atomically(arguments.out, material_text(fit.material));

    print_test(fit.test);
    print_fits(fit.fits, fit.fits[fit.taken]);
    say("wrote     {}\n", arguments.out.string());
    return 0;
}

} // namespace spia::cli
