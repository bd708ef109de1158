#include "engine/forming/material/material_check.h"

#include <cmath>
#include <fmt/core.h>

namespace spia {
namespace {

constexpr double huge_MPa = 1e5, huge_modulus_MPa = 1e7, huge_density = 1e5, huge_r = 100, huge_rate = 1e3;
constexpr double barely = 1e-12; // for bounds that are allowed themselves

class Check {
public:
    std::vector<MaterialFault> faults;

    /// Both bounds excluded.
    void number(const std::string& key, double x, double above, double below)
    {
        if (!std::isfinite(x))
            faults.push_back({key, "must be a number", {}});
        else if (!(x > above))
            faults.push_back({key, fmt::format("must be above {}", above), x});
        else if (!(x < below))
            faults.push_back({key, fmt::format("must be below {}", below), x});
    }
    void stress(const std::string& key, double x) { number("hardening/" + key, x, 0, huge_MPa); }
    void share(const std::string& key, double x) { number("hardening/" + key, x, 0, 1); }
    void rate(double c) { number("hardening/c", c, 0, huge_rate); }

    void operator()(const Swift& law)
    {
        stress("K_MPa", law.K_MPa);
        share("e0", law.e0);
        share("n", law.n);
    }
    void operator()(const Hollomon& law)
    {
        stress("K_MPa", law.K_MPa);
        share("n", law.n);
    }
    void saturation(double sigma0, double sigma_sat)
    {
        stress("sigma0_MPa", sigma0);
        stress("sigma_sat_MPa", sigma_sat);
        if (sigma_sat > 0 && sigma_sat < sigma0)
            faults.push_back({"hardening/sigma_sat_MPa", "must not be below the initial stress (sigma0_MPa)", {}});
    }
    void operator()(const Voce& law)
    {
        saturation(law.sigma0_MPa, law.sigma_sat_MPa);
        rate(law.c);
    }
    void operator()(const Ludwik& law)
    {
        stress("sigma0_MPa", law.sigma0_MPa);
        stress("K_MPa", law.K_MPa);
        share("n", law.n);
    }
    void operator()(const HockettSherby& law)
    {
        saturation(law.sigma0_MPa, law.sigma_sat_MPa);
        rate(law.c);
        constexpr double least_power = 0.05; // p = 1, Voce's law, is allowed
        if (law.p > 1 && law.p < 1 + barely)
            return;
        number("hardening/p", law.p == 1 ? 0.5 : law.p, least_power, 1);
    }
    void operator()(const SwiftVoce& law)
    {
        share("alpha", law.alpha);
        (*this)(law.swift);
        (*this)(law.voce);
    }
    void operator()(const HardeningTable& table)
    {
        const std::string strain = "hardening/strain", stress = "hardening/stress_MPa";
        if (table.strain.size() != table.stress_MPa.size() || table.strain.size() < 2) {
            faults.push_back({strain, "and \"stress_MPa\" must be lists of the same length, at least two points", {}});
            return;
        }
        const size_t before = faults.size();
        for (size_t i = 0; i < table.strain.size(); ++i) {
            const double e = table.strain[i], s = table.stress_MPa[i];
            const int entry = int(i);
            if (!std::isfinite(e) || e < 0)
                faults.push_back({strain, "must not be below 0", e, entry});
            else if (i > 0 && e <= table.strain[i - 1])
                faults.push_back({strain,
                                  fmt::format("must rise from point to point; {} follows {}", e, table.strain[i - 1]),
                                  {},
                                  entry});
            if (!(s > 0 && s < huge_MPa))
                faults.push_back(
                    {stress, s > 0 ? fmt::format("must be below {}", huge_MPa) : "must be above 0", s, entry});
            else if (i > 0 && s < table.stress_MPa[i - 1])
                faults.push_back({stress, fmt::format("the curve falls at strain {}", e), {}, entry});
        }
        if (faults.size() > before)
            return;
        // Below its first point the table keeps its first slope; Hooke's line has to meet it.
        const double at_zero = flow_stress(table, 0).stress;
        if (!(at_zero > 0))
            faults.push_back({strain,
                              fmt::format("begins at {}, and its first slope leads to {:.4g} MPa at strain 0; add the "
                                          "yield stress at strain 0 as first point",
                                          table.strain[0], at_zero),
                              {},
                              0});
    }

    /// As curve_through() takes them.
    void limit(const GradeLimit& limit)
    {
        const std::string minor = "forming_limit/minor", major = "forming_limit/major";
        if (limit.n)
            number("forming_limit/n", *limit.n, 0, 1);
        if (limit.minor.empty() && limit.major.empty())
            return;
        if (limit.minor.size() != limit.major.size() || limit.minor.size() < 2) {
            faults.push_back({minor, "and \"major\" must be lists of the same length, at least two points", {}});
            return;
        }
        constexpr double least_minor = -0.95, most_minor = 2, most_major = 3; // no sheet bears more
        for (size_t i = 0; i < limit.minor.size(); ++i) {
            const double a = limit.minor[i], b = limit.major[i];
            const int entry = int(i);
            if (!(a > least_minor && a < most_minor))
                faults.push_back({minor, "no sheet bears such a strain; is it in percent?", a, entry});
            else if (i > 0 && !(a > limit.minor[i - 1]))
                faults.push_back({minor, "must rise from point to point", a, entry});
            if (!(b > 0))
                faults.push_back({major, "must be above 0", b, entry});
            else if (!(b < most_major))
                faults.push_back({major, "no sheet bears such a strain; is it in percent?", b, entry});
            else if (b < a)
                faults.push_back({major, "must not be below the minor strain", b, entry});
        }
    }
};

/// A flow stress above Hooke's line at every strain would never yield.
bool yields(const Material& material)
{
    for (double strain = 1e-4; strain < 1; strain *= 1.5)
        if (flow_stress(material.hardening, strain).stress < material.young_MPa * strain)
            return true;
    return false;
}

} // namespace

std::vector<MaterialFault> faults_of(const Material& material)
{
    Check check;
    if (material.name.find_first_not_of(" \t") == std::string::npos)
        check.faults.push_back({"name", "must not be empty", {}});
    check.number("young_MPa", material.young_MPa, 0, huge_modulus_MPa);
    if (material.poisson != 0.5) // allowed itself
        check.number("poisson", material.poisson, -1, 0.5);
    check.number("density_kg_m3", material.density_kg_m3, 0, huge_density);
    std::visit(check, material.hardening);
    check.number("r0", material.r0, 0, huge_r);
    check.number("r45", material.r45, 0, huge_r);
    check.number("r90", material.r90, 0, huge_r);
    check.limit(material.limit);
    if (check.faults.empty() && !yields(material))
        check.faults.push_back(
            {"hardening", "lies above the elastic line everywhere; check the units of stress and modulus (MPa)", {}});
    return std::move(check.faults);
}

} // namespace spia
