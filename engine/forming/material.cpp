#include "engine/forming/material.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <fstream>

#include "engine/core/error.h"
#include "engine/core/json_file.h"

namespace spia {
namespace {

/// Reads numbers of one JSON object and says which key of which file is at fault.
class Reader {
public:
    Reader(const Json& object, std::string where) : object_(object), where_(std::move(where)) {}

    double number(const char* key, double above, double below) const
    {
        const Json& value = require(key);
        if (!value.is_number())
            fail(key, "is not a number");
        const double x = value.get<double>();
        if (!(x > above && x < below))
            fail(key, fmt::format("is {} but must lie between {} and {}", x, above, below));
        return x;
    }

    std::string text(const char* key) const
    {
        const Json& value = require(key);
        if (!value.is_string() || value.get<std::string>().empty())
            fail(key, "is not a text");
        return value.get<std::string>();
    }

    std::vector<double> numbers(const char* key) const
    {
        const Json& value = require(key);
        if (!value.is_array())
            fail(key, "is not a list of numbers");
        std::vector<double> result;
        for (const Json& x : value) {
            if (!x.is_number())
                fail(key, "is not a list of numbers");
            result.push_back(x.get<double>());
        }
        return result;
    }

    Reader object(const char* key) const
    {
        const Json& value = require(key);
        if (!value.is_object())
            fail(key, "is not an object");
        return Reader(value, where_ + " in \"" + key + "\"");
    }

    [[noreturn]] void fail(const char* key, const std::string& what) const
    {
        throw InputError(fmt::format("{}: \"{}\" {}", where_, key, what));
    }

private:
    const Json& require(const char* key) const
    {
        const auto found = object_.find(key);
        if (found == object_.end())
            fail(key, "is missing; see assets/materials/README.md for the form");
        return *found;
    }

    const Json& object_;
    std::string where_;
};

HardeningTable read_table(const Reader& in)
{
    HardeningTable table{in.numbers("strain"), in.numbers("stress_MPa")};
    if (table.strain.size() != table.stress_MPa.size() || table.strain.size() < 2)
        in.fail("strain", "and \"stress_MPa\" must be lists of the same length, at least two");
    for (size_t i = 0; i < table.strain.size(); ++i) {
        if (table.strain[i] < 0 || (i > 0 && table.strain[i] <= table.strain[i - 1]))
            in.fail("strain", fmt::format("must rise from 0 or more; entry {} does not", i));
        if (!(table.stress_MPa[i] > 0) || (i > 0 && table.stress_MPa[i] < table.stress_MPa[i - 1]))
            in.fail("stress_MPa", fmt::format("must be positive and never fall; entry {} does not", i));
    }
    // Below its first point the table keeps its first slope; Hooke's line has to meet it.
    const double at_zero = flow_stress(table, 0).stress;
    if (!(at_zero > 0))
        in.fail("strain",
                fmt::format("begins at {}, and its first slope leads to {:.4g} MPa at strain 0; add the yield "
                            "stress at strain 0 as first point",
                            table.strain[0], at_zero));
    return table;
}

Hardening read_hardening(const Reader& in)
{
    constexpr double huge_MPa = 1e5;
    const std::string law = in.text("law");
    const auto swift = [&] {
        return Swift{in.number("K_MPa", 0, huge_MPa), in.number("e0", 0, 1), in.number("n", 0, 1)};
    };
    const auto rising_to = [&](double sigma0) { // the stress of saturation
        const double sigma_sat = in.number("sigma_sat_MPa", 0, huge_MPa);
        if (sigma_sat < sigma0)
            in.fail("sigma_sat_MPa", "is below sigma0_MPa");
        return sigma_sat;
    };
    const auto voce = [&] {
        const double sigma0 = in.number("sigma0_MPa", 0, huge_MPa);
        return Voce{sigma0, rising_to(sigma0), in.number("c", 0, 1e3)};
    };
    if (law == "swift")
        return swift();
    if (law == "hollomon")
        return Hollomon{in.number("K_MPa", 0, huge_MPa), in.number("n", 0, 1)};
    if (law == "voce")
        return voce();
    if (law == "ludwik")
        return Ludwik{in.number("sigma0_MPa", 0, huge_MPa), in.number("K_MPa", 0, huge_MPa), in.number("n", 0, 1)};
    if (law == "hockett_sherby") {
        const double sigma0 = in.number("sigma0_MPa", 0, huge_MPa);
        constexpr double barely = 1e-12; // p = 1, Voce's law, is allowed
        return HockettSherby{sigma0, rising_to(sigma0), in.number("c", 0, 1e3), in.number("p", 0.05, 1 + barely)};
    }
    if (law == "swift_voce")
        return SwiftVoce{in.number("alpha", 0, 1), swift(), voce()};
    if (law == "table")
        return read_table(in);
    in.fail("law",
            fmt::format("is \"{}\"; known are swift, hollomon, voce, ludwik, hockett_sherby, swift_voce, table", law));
}

/// A flow stress above Hooke's line at every strain would never yield.
void require_yield(const Material& material, const Reader& in)
{
    for (double strain = 1e-4; strain < 1; strain *= 1.5)
        if (flow_stress(material.hardening, strain).stress < material.young_MPa * strain)
            return;
    in.fail("hardening", "lies above the elastic line everywhere; check units (MPa)");
}

} // namespace

Material read_material(const std::filesystem::path& file)
{
    std::ifstream stream(file);
    if (!stream)
        throw InputError(
            fmt::format("cannot open the material file {}; `spia materials` lists the built-in grades", file.string()));
    const Json json = read_json(file);
    if (!json.is_object())
        throw InputError(
            fmt::format("{} is no JSON object; see assets/materials/README.md for the form", file.string()));
    const Reader in(json, file.string());
    Material material;
    material.name = in.text("name");
    material.young_MPa = in.number("young_MPa", 0, 1e7);
    material.poisson = in.number("poisson", -1, 0.5 + 1e-12);
    material.density_kg_m3 = in.number("density_kg_m3", 0, 1e5);
    material.hardening = read_hardening(in.object("hardening"));
    material.r0 = in.number("r0", 0, 100);
    material.r45 = in.number("r45", 0, 100);
    material.r90 = in.number("r90", 0, 100);
    if (json.contains("source") && json["source"].is_string())
        material.source = json["source"].get<std::string>();
    require_yield(material, in);
    return material;
}

} // namespace spia
