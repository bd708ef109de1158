#pragma once
#include <Message_ProgressIndicator.hxx>
#include <exception>
#include <string>
#include <utility>

#include "engine/core/progress.h"

namespace spia {

/// Tells how far OpenCASCADE is, and it when the owner of the job wants no more. No exception may pass through its
/// algorithms, so `Cancelled` is kept until rethrow(). For .cpp files of engine/exchange.
class OcctProgress : public Message_ProgressIndicator {
public:
    OcctProgress(Progress progress, std::string step) : progress_(std::move(progress)), step_(std::move(step)) {}

    /// Call after each algorithm that was given Start(): what it made is worthless if it was stopped.
    void rethrow() const
    {
        if (stopped_)
            std::rethrow_exception(stopped_);
    }

protected:
    Standard_Boolean UserBreak() override { return stopped_ != nullptr; }
    void Show(const Message_ProgressScope&, const Standard_Boolean) override
    {
        try {
            if (!stopped_)
                progress_.checkpoint(GetPosition(), step_);
        } catch (...) {
            stopped_ = std::current_exception();
        }
    }

private:
    Progress progress_;
    std::string step_;
    std::exception_ptr stopped_;
};

} // namespace spia
