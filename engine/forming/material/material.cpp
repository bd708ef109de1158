#include "engine/forming/material/material.h"

#include <fmt/core.h>
#include <fstream>

#include "engine/core/error.h"
#include "engine/core/json_file.h"
#include "engine/forming/material/material_check.h"

namespace spia {
namespace {

/// Reads numbers of one JSON object and says which key of which file is at fault.
class MaterialReader {
public:
    MaterialReader(const Json& object, std::string where) : object_(object), where_(std::move(where)) {}

    double number(const char* key) const
    {
        const Json& value = require(key);
        if (!value.is_number())
            fail(key, "is not a number");
        return value.get<double>();
    }

    bool has(const char* key) const { return object_.contains(key); }

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

    MaterialReader object(const char* key) const
    {
        const Json& value = require(key);
        if (!value.is_object())
            fail(key, "is not an object");
        return MaterialReader(value, where_ + " in \"" + key + "\"");
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

Hardening read_hardening(const MaterialReader& in)
{
    const std::string law = in.text("law");
    const auto swift = [&] { return Swift{in.number("K_MPa"), in.number("e0"), in.number("n")}; };
    const auto voce = [&] { return Voce{in.number("sigma0_MPa"), in.number("sigma_sat_MPa"), in.number("c")}; };
    if (law == "swift")
        return swift();
    if (law == "hollomon")
        return Hollomon{in.number("K_MPa"), in.number("n")};
    if (law == "voce")
        return voce();
    if (law == "ludwik")
        return Ludwik{in.number("sigma0_MPa"), in.number("K_MPa"), in.number("n")};
    if (law == "hockett_sherby")
        return HockettSherby{in.number("sigma0_MPa"), in.number("sigma_sat_MPa"), in.number("c"), in.number("p")};
    if (law == "swift_voce")
        return SwiftVoce{in.number("alpha"), swift(), voce()};
    if (law == "table")
        return HardeningTable{in.numbers("strain"), in.numbers("stress_MPa")};
    in.fail("law",
            fmt::format("is \"{}\"; known are swift, hollomon, voce, ludwik, hockett_sherby, swift_voce, table", law));
}

GradeLimit read_limit(const MaterialReader& in)
{
    GradeLimit limit;
    if (in.has("n"))
        limit.n = in.number("n");
    if (in.has("minor") || in.has("major")) {
        limit.minor = in.numbers("minor");
        limit.major = in.numbers("major");
    }
    if (!limit.n && limit.minor.empty())
        in.fail("n", "is missing, and so are \"minor\" and \"major\"; see assets/materials/README.md for the form");
    return limit;
}

/// In the words of the file: "dp600.json in "hardening": "K_MPa" must be above 0, but is -3".
[[noreturn]] void fail(const std::string& where, const MaterialFault& fault)
{
    const size_t slash = fault.key.find('/');
    const std::string group = slash == std::string::npos ? "" : fault.key.substr(0, slash),
                      key = slash == std::string::npos ? fault.key : fault.key.substr(slash + 1);
    throw InputError(fmt::format("{}{}: \"{}\"{} {}{}", where, group.empty() ? "" : fmt::format(" in \"{}\"", group),
                                 key, fault.entry < 0 ? "" : fmt::format(", entry {}:", fault.entry), fault.what,
                                 fault.value ? fmt::format(", but is {}", *fault.value) : ""));
}

} // namespace

bool formed_alike(const Material& a, const Material& b)
{
    return a.young_MPa == b.young_MPa && a.poisson == b.poisson && a.density_kg_m3 == b.density_kg_m3 &&
           a.hardening == b.hardening && a.r0 == b.r0 && a.r45 == b.r45 && a.r90 == b.r90;
}

static Material material_of(const Json& json, const std::string& where)
{
    if (!json.is_object())
        throw InputError(fmt::format("{} is no JSON object; see assets/materials/README.md for the form", where));
    const MaterialReader in(json, where);
    Material material;
    material.name = in.text("name");
    material.young_MPa = in.number("young_MPa");
    material.poisson = in.number("poisson");
    material.density_kg_m3 = in.number("density_kg_m3");
    material.hardening = read_hardening(in.object("hardening"));
    material.r0 = in.number("r0");
    material.r45 = in.number("r45");
    material.r90 = in.number("r90");
    if (in.has("forming_limit"))
        material.limit = read_limit(in.object("forming_limit"));
    if (json.contains("source") && json["source"].is_string())
        material.source = json["source"].get<std::string>();
    if (const std::vector<MaterialFault> faults = faults_of(material); !faults.empty())
        fail(where, faults.front());
    return material;
}

Material read_material(const std::filesystem::path& file)
{
    std::ifstream stream(file);
    if (!stream)
        throw InputError(
            fmt::format("cannot open the material file {}; `spia materials` lists the built-in grades", file.string()));
    return material_of(read_json(file), file.string());
}

Material material_from(const std::string& text, const std::string& where)
{
    return material_of(parse_json(text, where), where);
}

} // namespace spia
