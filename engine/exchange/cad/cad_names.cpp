#include "engine/exchange/cad/cad_names.h"

#include <BRep_Builder.hxx>
#include <IGESData_IGESEntity.hxx>
#include <StepBasic_Product.hxx>
#include <StepBasic_ProductDefinition.hxx>
#include <StepBasic_ProductDefinitionFormation.hxx>
#include <StepRepr_NextAssemblyUsageOccurrence.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Iterator.hxx>
#include <TransferBRep.hxx>
#include <Transfer_Binder.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <map>
#include <set>

#include "engine/core/read_number.h"
#include "engine/exchange/text/text_encoding.h"

namespace spia {
namespace {

std::string text_of(const Handle(TCollection_HAsciiString) & text)
{
    const std::string read = text.IsNull() ? "" : readable(text->ToCString());
    const std::string name(trimmed(read));
    return same_letters(name, "NONE") ? "" : name;
}

std::string product_name(const StepBasic_ProductDefinition& definition)
{
    const Handle(StepBasic_ProductDefinitionFormation) formation = definition.Formation();
    if (formation.IsNull() || formation->OfProduct().IsNull())
        return "";
    const std::string name = text_of(formation->OfProduct()->Name());
    return name.empty() ? text_of(formation->OfProduct()->Id()) : name;
}

bool holds_faces(const TopoDS_Shape& shape) { return TopExp_Explorer(shape, TopAbs_FACE).More(); }

TopoDS_Shape unplaced(const TopoDS_Shape& shape) { return shape.Located(TopLoc_Location()); }

bool is_holder(const TopoDS_Shape& shape)
{
    return shape.ShapeType() == TopAbs_COMPOUND || shape.ShapeType() == TopAbs_COMPSOLID;
}

/// Walks through a shape and notes what it meets.
class Walk {
public:
    explicit Walk(const CadNames& names) : names_(names) {}
    CadTree result()
    {
        name_places();
        for (const int body : tree_.body_of)
            for (int item = body; item >= 0; item = tree_.item[size_t(item)].parent)
                ++tree_.item[size_t(item)].faces;
        return std::move(tree_);
    }
    /// @param own  without the place in the assembly, @param name by those around it that hold
    /// nothing else
    void enter(const TopoDS_Shape& own, int parent, std::string name, std::string place)
    {
        if (name.empty())
            name = names_.shape(own);
        if (place.empty())
            place = names_.place(own);
        if (!is_holder(own)) {
            const bool solid = own.ShapeType() == TopAbs_SOLID;
            const int body = add(solid ? CadItem::Kind::solid : CadItem::Kind::sheet_body, parent, name, place);
            for (TopExp_Explorer at(own, TopAbs_FACE); at.More(); at.Next())
                tree_.body_of.push_back(body);
            return;
        }
        std::vector<TopoDS_Shape> parts;
        int loose = 0;
        for (TopoDS_Iterator at(own, false, false); at.More(); at.Next())
            if (holds_faces(at.Value())) {
                parts.push_back(at.Value());
                loose += at.Value().ShapeType() == TopAbs_FACE;
            }
        if (parts.size() == 1 && loose == 0)
            return enter(parts[0], parent, name, place);
        const bool only_faces = loose == int(parts.size());
        if (!name.empty() && !only_faces)
            parent = add(CadItem::Kind::assembly, parent, name, place);
        int faces = -1;
        for (const TopoDS_Shape& part : parts)
            if (part.ShapeType() == TopAbs_FACE) {
                if (faces < 0)
                    faces = add(CadItem::Kind::loose_faces, parent, only_faces ? name : "", only_faces ? place : "");
                tree_.body_of.push_back(faces);
            } else
                enter(part, parent, "", "");
    }

private:
    const CadNames& names_;
    CadTree tree_;
    std::vector<std::string> place_; ///< per item: what its place is called
    int assemblies_ = 0, bodies_ = 0;

    int add(CadItem::Kind kind, int parent, const std::string& name, const std::string& place)
    {
        int& number = kind == CadItem::Kind::assembly ? assemblies_ : bodies_;
        tree_.item.push_back({kind, name, number++, parent, 0});
        place_.push_back(place);
        return int(tree_.item.size()) - 1;
    }
    /// Items of one name get the names of their places, if these tell them apart.
    void name_places()
    {
        std::map<std::string, std::vector<size_t>> same;
        for (size_t i = 0; i < tree_.item.size(); ++i)
            same[tree_.item[i].name].push_back(i);
        for (const auto& [name, items] : same) {
            std::set<std::string> places;
            for (const size_t i : items)
                places.insert(place_[i]);
            if (items.size() > 1 && !places.contains("") && places.size() == items.size())
                for (const size_t i : items)
                    tree_.item[i].name = place_[i];
        }
    }
};

} // namespace

CadNames::CadNames(const XSControl_Reader& read)
{
    const Handle(Transfer_TransientProcess) process = read.WS()->TransferReader()->TransientProcess();
    const auto bind = [&](TopTools_DataMapOfShapeInteger& map, const TopoDS_Shape& shape, std::string name,
                          bool stronger) {
        if (name.empty() || (!stronger && map.IsBound(shape)))
            return;
        map.Bind(shape, int(name_.size()));
        name_.push_back(std::move(name));
    };
    for (int i = 1; i <= process->NbMapped(); ++i) {
        const Handle(Transfer_Binder) result = process->MapItem(i);
        const Handle(Standard_Transient) entity = process->Mapped(i);
        if (result.IsNull() || entity.IsNull())
            continue;
        const TopoDS_Shape shape = TransferBRep::ShapeResult(result);
        if (shape.IsNull() || shape.ShapeType() >= TopAbs_FACE)
            continue;
        if (const auto product = Handle(StepBasic_ProductDefinition)::DownCast(entity); !product.IsNull())
            bind(of_shape_, unplaced(shape), product_name(*product), true);
        else if (const auto use = Handle(StepRepr_NextAssemblyUsageOccurrence)::DownCast(entity); !use.IsNull())
            bind(of_place_, shape, text_of(use->Name()), false);
        else if (const auto body = Handle(StepRepr_RepresentationItem)::DownCast(entity); !body.IsNull())
            bind(of_shape_, unplaced(shape), text_of(body->Name()), false);
        else if (const auto iges = Handle(IGESData_IGESEntity)::DownCast(entity); !iges.IsNull() && iges->HasName())
            bind(of_shape_, unplaced(shape), text_of(iges->NameValue()), false);
    }
}

std::string CadNames::shape(const TopoDS_Shape& shape) const
{
    const int* name = of_shape_.Seek(unplaced(shape));
    return name ? name_[size_t(*name)] : "";
}

std::string CadNames::place(const TopoDS_Shape& placed) const
{
    const int* name = of_place_.Seek(placed);
    return name ? name_[size_t(*name)] : "";
}

CadTree tree_of(const TopoDS_Shape& shape, const CadNames& names)
{
    Walk walk(names);
    if (shape.ShapeType() == TopAbs_FACE) { // a file of one face
        TopoDS_Compound alone;
        const BRep_Builder builder;
        builder.MakeCompound(alone);
        builder.Add(alone, shape);
        walk.enter(alone, -1, names.shape(shape), "");
    } else
        walk.enter(shape, -1, "", "");
    return walk.result();
}

} // namespace spia
