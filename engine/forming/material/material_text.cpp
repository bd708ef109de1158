#include "engine/forming/material/material_text.h"

#include <nlohmann/json.hpp>

namespace spia {
namespace {

using Json = nlohmann::ordered_json;

struct KeysOf {
    Json operator()(const Swift& s) const { return {{"K_MPa", s.K_MPa}, {"e0", s.e0}, {"n", s.n}}; }
    Json operator()(const Hollomon& h) const { return {{"K_MPa", h.K_MPa}, {"n", h.n}}; }
    Json operator()(const Voce& v) const
    {
        return {{"sigma0_MPa", v.sigma0_MPa}, {"sigma_sat_MPa", v.sigma_sat_MPa}, {"c", v.c}};
    }
    Json operator()(const HardeningTable& t) const { return {{"strain", t.strain}, {"stress_MPa", t.stress_MPa}}; }
    Json operator()(const Ludwik& l) const { return {{"sigma0_MPa", l.sigma0_MPa}, {"K_MPa", l.K_MPa}, {"n", l.n}}; }
    Json operator()(const HockettSherby& h) const
    {
        return {{"sigma0_MPa", h.sigma0_MPa}, {"sigma_sat_MPa", h.sigma_sat_MPa}, {"c", h.c}, {"p", h.p}};
    }
    Json operator()(const SwiftVoce& m) const
    {
        Json keys = {{"alpha", m.alpha}};
        keys.update((*this)(m.swift));
        keys.update((*this)(m.voce));
        return keys;
    }
};

Json hardening_json(const Hardening& law)
{
    Json json = {{"law", law_name(law)}};
    json.update(std::visit(KeysOf{}, law));
    return json;
}

} // namespace

std::string hardening_text(const Hardening& law) { return hardening_json(law).dump(); }

std::string material_text(const Material& material)
{
    Json json = {{"name", material.name},
                 {"young_MPa", material.young_MPa},
                 {"poisson", material.poisson},
                 {"density_kg_m3", material.density_kg_m3},
                 {"hardening", hardening_json(material.hardening)},
                 {"r0", material.r0},
                 {"r45", material.r45},
                 {"r90", material.r90},
                 {"source", material.source}};
    const GradeLimit& limit = material.limit;
    if (limit.n || !limit.minor.empty()) {
        Json& written = json["forming_limit"];
        if (limit.n)
            written["n"] = *limit.n;
        if (!limit.minor.empty()) {
            written["minor"] = limit.minor;
            written["major"] = limit.major;
        }
    }
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace spia
