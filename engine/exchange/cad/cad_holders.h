#pragma once
#include <Standard_Transient.hxx>
#include <TColStd_HSequenceOfTransient.hxx>
#include <XSControl_Reader.hxx>
#include <XSControl_WorkSession.hxx>
#include <set>
#include <vector>

namespace spia {

/// Goes from an entity of a file up to those that refer to it, to those that refer to these, and so
/// on, each once. For .cpp files of engine/exchange that hold an OcctSession.
/// @param goes_on  goes_on(holder): whether to look for what refers to the holder, too
template <class GoesOn>
void climb_to_holders(const Handle(Standard_Transient) & entity, const XSControl_Reader& read, const GoesOn& goes_on)
{
    std::set<const Standard_Transient*> seen = {entity.get()};
    std::vector<Handle(Standard_Transient)> open = {entity};
    while (!open.empty()) {
        const Handle(TColStd_HSequenceOfTransient) holders = read.WS()->Sharings(open.back());
        open.pop_back();
        for (int i = 1; !holders.IsNull() && i <= holders->Length(); ++i) {
            const Handle(Standard_Transient)& holder = holders->Value(i);
            if (seen.insert(holder.get()).second && goes_on(holder))
                open.push_back(holder);
        }
    }
}

} // namespace spia
