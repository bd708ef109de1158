#pragma once
#include <Eigen/Core>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/pipeline/session.h"

namespace spia {

/// A scalar of the formed sheet that can be looked at.
enum class Field {
    none,
    thickness,
    thinning,
    strain_major,
    strain_minor,
    strain_equivalent,
    stress_major,
    stress_minor,
    stress_equivalent,
    area_change,
    angle_distortion,
    necking,
    outer_strain_major,
    outer_strain_minor,
    outer_strain_equivalent,
    inner_strain_major,
    inner_strain_minor,
    inner_strain_equivalent,
    curvature,
    zone,
    limit_distance,
    deviation
};

struct FieldInfo {
    Field field;
    std::string_view name;  ///< as in scripts and projects, e.g. "strain_major"
    std::string_view label; ///< for people, e.g. "Major strain"
    std::string_view unit;  ///< "mm", "%", "MPa", "°", "" (a pure number), "zone" (the number of a
                            ///< Zone, told by its name)
    bool diverging;         ///< zero matters: both signs
    std::string_view help;  ///< one sentence: what it is
};

/// All of them, in the order of the menu.
const std::vector<FieldInfo>& all_fields();
const FieldInfo& info(Field field);
/// "thickening", which older projects and scripts have, is thinning: negative where the sheet
/// became thicker. @throws InputError
Field field_by_name(std::string_view name);

/// Whether the session has what the field needs.
bool available(const Session& session, Field field);
/// Whether it belongs to the strains of both skins, which are made only where asked for
/// (FlattenOptions::skins).
bool of_skins(Field field);

/// Values in the unit of the field, one per vertex of the part or one per face; empty for
/// Field::none. The deviation has no values per face of its own: that of the corner where it is
/// greatest. What is said in numbers is face_values().
/// @throws InputError if it is not available
Eigen::VectorXd values(const Session& session, Field field, bool per_face);

/// Whether a state of unfolding step by step has the field.
bool available_in_steps(Field field);
/// Likewise of such a state. @throws InputError if it does not have the field
Eigen::VectorXd values(const TriMesh& part, const SheetFields& of_face, Field field, bool per_face);

} // namespace spia
