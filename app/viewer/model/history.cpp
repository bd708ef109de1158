#include "app/viewer/model/history.h"

#include <utility>

namespace spia::viewer {

void History::remember(std::string name, const Document& before, bool merge)
{
    future_.clear();
    const bool same = merge && open_ && !past_.empty() && past_.back().name == name;
    open_ = merge;
    if (same)
        return;
    past_.push_back({std::move(name), before});
    if (past_.size() > most_) {
        past_.erase(past_.begin());
        ++forgotten_;
    }
}

std::string History::undo_name() const { return past_.empty() ? "" : past_.back().name; }
std::string History::redo_name() const { return future_.empty() ? "" : future_.back().name; }

void History::undo(Document& current)
{
    if (past_.empty())
        return;
    open_ = false;
    std::swap(current, past_.back().document);
    future_.push_back(std::move(past_.back()));
    past_.pop_back();
}

void History::redo(Document& current)
{
    if (future_.empty())
        return;
    open_ = false;
    std::swap(current, future_.back().document);
    past_.push_back(std::move(future_.back()));
    future_.pop_back();
}

} // namespace spia::viewer
