#include "engine/exchange/cad/cad_lost.h"

#include <IFSelect_WorkSession.hxx>
#include <IGESData_IGESEntity.hxx>
#include <Interface_InterfaceModel.hxx>
#include <StepShape_ConnectedFaceSet.hxx>
#include <StepShape_FaceSurface.hxx>
#include <StepShape_SolidModel.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TransferBRep.hxx>
#include <Transfer_Binder.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "engine/exchange/cad/cad_holders.h"

namespace spia {
namespace {

bool is_made_of_faces(const Standard_Transient& entity)
{
    if (const auto* iges = dynamic_cast<const IGESData_IGESEntity*>(&entity)) {
        constexpr std::array types = {108, 114, 118, 120, 122, 128, 140, 143, 144,
                                      186, 190, 192, 194, 196, 198, 510, 514};
        return std::find(types.begin(), types.end(), iges->TypeNumber()) != types.end();
    }
    return entity.IsKind(STANDARD_TYPE(StepShape_FaceSurface)) ||
           entity.IsKind(STANDARD_TYPE(StepShape_ConnectedFaceSet)) ||
           entity.IsKind(STANDARD_TYPE(StepShape_SolidModel));
}

bool is_solid(const Standard_Transient& entity)
{
    constexpr int solid = 186;
    const auto* iges = dynamic_cast<const IGESData_IGESEntity*>(&entity);
    return iges ? iges->TypeNumber() == solid : entity.IsKind(STANDARD_TYPE(StepShape_SolidModel));
}

/// Numbers of the faces that the file was made into, wherever an assembly puts them.
class FaceNumbers {
public:
    explicit FaceNumbers(std::span<const TopoDS_Face> faces)
    {
        for (size_t f = 0; f < faces.size(); ++f)
            numbers_[faces[f].TShape().get()].push_back(int(f));
    }
    void add(const TopoDS_Shape& shape, std::set<int>& to) const
    {
        for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next())
            if (const auto found = numbers_.find(at.Current().TShape().get()); found != numbers_.end())
                to.insert(found->second.begin(), found->second.end());
    }

private:
    std::map<const Standard_Transient*, std::vector<int>> numbers_;
};

TopoDS_Shape made_of(const Handle(Transfer_TransientProcess) & process, const Handle(Standard_Transient) & entity)
{
    const Handle(Transfer_Binder) result = process->Find(entity);
    return result.IsNull() ? TopoDS_Shape() : TransferBRep::ShapeResult(result);
}

/// Up from holder to holder until one has faces, on every way.
std::vector<int> faces_beside(const Handle(Standard_Transient) & lost, const XSControl_Reader& read,
                              const FaceNumbers& numbers)
{
    const Handle(Transfer_TransientProcess) process = read.WS()->TransferReader()->TransientProcess();
    std::set<int> faces;
    climb_to_holders(lost, read, [&](const Handle(Standard_Transient) & holder) {
        std::set<int> held;
        if (const TopoDS_Shape shape = made_of(process, holder); !shape.IsNull())
            numbers.add(shape, held);
        const bool none = held.empty();
        faces.merge(held);
        return none;
    });
    return {faces.begin(), faces.end()};
}

} // namespace

std::vector<LostShape> not_translated(const XSControl_Reader& read, std::span<const TopoDS_Face> faces)
{
    const Handle(Transfer_TransientProcess) process = read.WS()->TransferReader()->TransientProcess();
    const FaceNumbers numbers(faces);
    std::vector<LostShape> lost;
    for (int i = 1; i <= process->NbMapped(); ++i) {
        const Handle(Standard_Transient) entity = process->Mapped(i);
        if (!entity.IsNull() && is_made_of_faces(*entity) && made_of(process, entity).IsNull())
            lost.push_back({read.WS()->Model()->StringLabel(entity)->ToCString(), faces_beside(entity, read, numbers),
                            is_solid(*entity)});
    }
    return lost;
}

bool may_lack(std::span<const int> chosen, const LostShape& lost)
{
    const auto is_chosen = [&](int face) { return std::binary_search(chosen.begin(), chosen.end(), face); };
    if (lost.solid)
        return std::all_of(lost.beside.begin(), lost.beside.end(), is_chosen);
    return lost.beside.empty() || std::any_of(lost.beside.begin(), lost.beside.end(), is_chosen);
}

} // namespace spia
