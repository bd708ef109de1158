#include "engine/exchange/cad/cad_damage.h"

#include <IFSelect_WorkSession.hxx>
#include <IGESData_IGESEntity.hxx>
#include <Interface_CheckIterator.hxx>
#include <Interface_InterfaceModel.hxx>
#include <StepBasic_ConversionBasedUnitAndLengthUnit.hxx>
#include <StepBasic_ConversionBasedUnitAndPlaneAngleUnit.hxx>
#include <StepBasic_LengthMeasureWithUnit.hxx>
#include <StepBasic_LengthUnit.hxx>
#include <StepBasic_MeasureWithUnit.hxx>
#include <StepBasic_PlaneAngleMeasureWithUnit.hxx>
#include <StepBasic_PlaneAngleUnit.hxx>
#include <StepBasic_SiUnitAndLengthUnit.hxx>
#include <StepBasic_SiUnitAndPlaneAngleUnit.hxx>
#include <StepGeom_ConicalSurface.hxx>
#include <StepGeom_TrimmedCurve.hxx>
#include <StepRepr_ItemDefinedTransformation.hxx>
#include <StepRepr_MappedItem.hxx>
#include <StepRepr_RepresentationContext.hxx>
#include <StepRepr_RepresentationRelationship.hxx>
#include <StepShape_ShapeRepresentation.hxx>
#include <StepShape_TopologicalRepresentationItem.hxx>
#include <TCollection_HAsciiString.hxx>
#include <XSControl_WorkSession.hxx>

#include "engine/exchange/cad/cad_holders.h"

namespace spia {
namespace {

bool is_any_of(const Standard_Transient& entity, std::initializer_list<Handle(Standard_Type)> types)
{
    for (const Handle(Standard_Type) & type : types)
        if (entity.IsKind(type))
            return true;
    return false;
}

/// What holds shapes or puts them into their places.
bool makes_shapes(const Standard_Transient& entity)
{
    return is_any_of(
        entity, {STANDARD_TYPE(StepShape_TopologicalRepresentationItem), STANDARD_TYPE(StepShape_ShapeRepresentation),
                 STANDARD_TYPE(StepRepr_ItemDefinedTransformation), STANDARD_TYPE(StepRepr_MappedItem),
                 STANDARD_TYPE(StepRepr_RepresentationRelationship), STANDARD_TYPE(StepRepr_RepresentationContext)});
}

bool is_of_lengths(const Standard_Transient& entity)
{
    return is_any_of(entity, {STANDARD_TYPE(StepBasic_LengthUnit), STANDARD_TYPE(StepBasic_SiUnitAndLengthUnit),
                              STANDARD_TYPE(StepBasic_ConversionBasedUnitAndLengthUnit),
                              STANDARD_TYPE(StepBasic_LengthMeasureWithUnit)});
}

bool is_of_angles(const Standard_Transient& entity)
{
    return is_any_of(entity, {STANDARD_TYPE(StepBasic_PlaneAngleUnit), STANDARD_TYPE(StepBasic_SiUnitAndPlaneAngleUnit),
                              STANDARD_TYPE(StepBasic_ConversionBasedUnitAndPlaneAngleUnit),
                              STANDARD_TYPE(StepBasic_PlaneAngleMeasureWithUnit)});
}

/// Whether it says how many radians it has, whatever else it lacks.
bool has_its_factor(const Standard_Transient& unit)
{
    const auto* angle = dynamic_cast<const StepBasic_ConversionBasedUnitAndPlaneAngleUnit*>(&unit);
    return angle && !angle->ConversionFactor().IsNull() && angle->ConversionFactor()->ValueComponent() > 0;
}

bool has_angles(const Interface_InterfaceModel& model)
{
    for (int i = 1; i <= model.NbEntities(); ++i)
        if (is_any_of(*model.Value(i), {STANDARD_TYPE(StepGeom_ConicalSurface), STANDARD_TYPE(StepGeom_TrimmedCurve)}))
            return true;
    return false;
}

/// Upwards from holder to holder.
bool needed(const Handle(Standard_Transient) & faulty, const XSControl_Reader& read)
{
    if (dynamic_cast<const IGESData_IGESEntity*>(faulty.get()))
        return true;
    if (makes_shapes(*faulty) || is_of_lengths(*faulty))
        return true;
    if (is_of_angles(*faulty) && !has_its_factor(*faulty) && has_angles(*read.Model()))
        return true;
    bool found = false;
    climb_to_holders(faulty, read, [&](const Handle(Standard_Transient) & holder) {
        // all shapes have one
        const bool context = holder->IsKind(STANDARD_TYPE(StepRepr_RepresentationContext));
        found = found || (!context && (makes_shapes(*holder) || is_of_lengths(*holder)));
        return !found && !context;
    });
    return found;
}

} // namespace

CadDamage damage_in(const XSControl_Reader& read)
{
    CadDamage damage;
    Interface_CheckIterator checks = read.WS()->ModelCheckList();
    const Handle(Interface_InterfaceModel) model = read.Model();
    for (checks.Start(); checks.More(); checks.Next()) {
        const Handle(Interface_Check)& check = checks.Value();
        if (!check->HasFailed())
            continue;
        const int number = checks.Number();
        if (number > 0 && number <= model->NbEntities() && !needed(model->Value(number), read))
            damage.aside.push_back(model->StringLabel(model->Value(number))->ToCString());
        else if (damage.fatal.empty())
            damage.fatal = check->CFail(1);
    }
    return damage;
}

} // namespace spia
