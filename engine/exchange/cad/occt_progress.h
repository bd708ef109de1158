#pragma once
#include <Message_ProgressIndicator.hxx>
#include <string>
#include <utility>

#include "engine/core/progress.h"

namespace spia {

/// Tells how far OpenCASCADE is. Nothing is stopped here: who wants no more ends the process in
/// which it works (in_child()). For .cpp files of engine/exchange.
class OcctProgress : public Message_ProgressIndicator {
public:
    OcctProgress(Progress progress, std::string step) : progress_(std::move(progress)), step_(std::move(step)) {}

protected:
    void Show(const Message_ProgressScope&, const Standard_Boolean) override
    {
        progress_.checkpoint(GetPosition(), step_);
    }

private:
    Progress progress_;
    std::string step_;
};

} // namespace spia
