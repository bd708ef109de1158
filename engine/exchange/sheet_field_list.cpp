#include "engine/exchange/sheet_field_list.h"

#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"

namespace spia {

std::vector<NamedField> forming_fields(const SheetFields& fields)
{
    return {{"thickness", &fields.thickness},
            {"thinning", &fields.thinning},
            {"strain_major", &fields.strain_major},
            {"strain_minor", &fields.strain_minor},
            {"strain_equivalent", &fields.strain_equivalent}};
}

std::vector<NamedField> stress_fields(const SheetFields& fields)
{
    return {{"stress_major", &fields.stress_major},
            {"stress_minor", &fields.stress_minor},
            {"stress_equivalent", &fields.stress_equivalent}};
}

std::vector<NamedField> skin_fields(const SkinStrains& skins)
{
    std::vector<NamedField> fields;
    for (const auto& [side, skin] : {std::pair("outer", &skins.outer), {"inner", &skins.inner}}) {
        fields.push_back({fmt::format("{}_strain_major", side), &skin->strain_major});
        fields.push_back({fmt::format("{}_strain_minor", side), &skin->strain_minor});
        fields.push_back({fmt::format("{}_strain_equivalent", side), &skin->strain_equivalent});
    }
    return fields;
}

void require_blank_of(const TriMesh& part, const Blank& blank)
{
    if (part.triangles() == 0)
        throw InputError("there is no part to write; read one first");
    if (blank.position.cols() != part.position.cols())
        throw InputError(
            fmt::format("the blank has {} vertices, the part {}; flatten this part again before writing it",
                        blank.position.cols(), part.position.cols()));
    for (int v = 0; v < part.vertices(); ++v)
        if (!part.position.col(v).allFinite() || !blank.position.col(v).allFinite())
            throw InputError(fmt::format("vertex {} has a coordinate that is not a number; flatten the part again", v));
    if (part.triangle.minCoeff() < 0 || part.triangle.maxCoeff() >= part.vertices())
        throw InputError("a face of the part names a vertex that is not there; read the part again");
}

void require_finite(const NamedField& field, int count, const char* per)
{
    if (field.value->size() != count)
        throw InputError(fmt::format("field {} has {} values for {} ({} each); flatten the part again", field.name,
                                     field.value->size(), count, per));
    for (int i = 0; i < count; ++i)
        if (!std::isfinite((*field.value)[i]))
            throw InputError(fmt::format("{} of {} {} is not a number; flatten the part again", field.name, per, i));
}

void require_zones(const Zones* zones, const TriMesh& part)
{
    if (!zones)
        return;
    const size_t faces = size_t(part.triangles());
    if (zones->zone.size() != faces || (zones->distance.size() != 0 && zones->distance.size() != Eigen::Index(faces)))
        throw InputError(fmt::format("{} zones were given for {} faces; judge the limits of this part again",
                                     zones->zone.size(), faces));
    if (zones->distance.array().isInf().any()) // no number: the sheet has no curve there
        throw InputError("a distance to the forming limit curve is infinite; check the points of the curve");
}

void require_fields(const SheetFields& fields, int count, const char* per)
{
    for (const NamedField& field : forming_fields(fields))
        require_finite(field, count, per);
    for (const NamedField& field : stress_fields(fields))
        require_finite(field, count, per);
    if (fields.direction_major.cols() != count || fields.necking.size() != count || !fields.direction_major.allFinite())
        throw InputError(fmt::format("direction_major or necking does not have {} finite values (one per {}); "
                                     "flatten the part again",
                                     count, per));
}

} // namespace spia
