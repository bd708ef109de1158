#include "app/viewer/model/document/step_friction.h"

#include <utility>

#include "engine/core/error.h"

namespace spia::viewer {

ContactRegion friction_of(const StepFriction& friction, std::vector<int> faces)
{
    const auto amount = friction.force_N ? friction.force_N : friction.pressure_MPa;
    if (friction.force_N.has_value() == friction.pressure_MPa.has_value() || !(*amount > 0))
        throw InputError("The force or pressure on the target of a step must be above 0.");
    if (!(friction.friction >= 0) || friction.sides < 1 || friction.sides > 2)
        throw InputError("The friction coefficient of a step must be 0 or more, on 1 or 2 sides.");
    return {"the target", std::move(faces), friction.pressure_MPa, friction.force_N, friction.friction, friction.sides};
}

std::optional<StepFriction> numbers_of(const std::optional<ContactRegion>& friction)
{
    if (!friction)
        return std::nullopt;
    return StepFriction{friction->force_N, friction->pressure_MPa, friction->friction, friction->sides};
}

} // namespace spia::viewer
